"""The events of a node: the items of ``async for event in node.events()``."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from typing import Any, Generic, Self, TypeVar
from weakref import WeakSet

from aioros1._public import public
from aioros1.connection import ConnectionInfo
from aioros1.time import Time
from aioros1.waiting import Waiters

__all__ = [
    "Broadcast",
    "ClockJumped",
    "Event",
    "EventStream",
    "MasterLost",
    "MasterRestarted",
    "ParamUpdate",
    "PeerConnected",
    "PeerDisconnected",
    "RoleRegistered",
    "RoleUnregistered",
]


@public
@dataclass(frozen=True, slots=True)
class Event:
    """The base of all events of a node."""


@public
@dataclass(frozen=True, slots=True)
class RoleRegistered(Event):
    """The master has accepted a role, for the first time or again."""

    kind: str
    """``publisher``, ``subscriber``, ``service`` or ``parameter``."""
    name: str
    """The resolved name of its topic, service or parameter."""


@public
@dataclass(frozen=True, slots=True)
class RoleUnregistered(Event):
    """A role was unregistered from the master, or the master could not be told."""

    kind: str
    """What the role is: ``publisher``, ``subscriber``, ``service`` or ``parameter``."""
    name: str
    """The resolved name of its topic, service or parameter."""


@public
@dataclass(frozen=True, slots=True)
class PeerConnected(Event):
    """A TCPROS connection now carries messages."""

    kind: str
    """The role on our side: ``publisher``, ``subscriber`` or ``service``."""
    name: str
    """The resolved name of the topic or service."""
    connection: ConnectionInfo
    """The new connection."""


@public
@dataclass(frozen=True, slots=True)
class PeerDisconnected(Event):
    """A TCPROS connection ended."""

    kind: str
    """The role on our side: ``publisher``, ``subscriber`` or ``service``."""
    name: str
    """The resolved name of the topic or service."""
    connection: ConnectionInfo
    """The connection that ended, with its final counters."""
    reason: str = ""
    """Why it ended, if known."""


@public
@dataclass(frozen=True, slots=True)
class ParamUpdate(Event):
    """A followed parameter, or a part of it, was set or deleted.

    ROS 1 announces a deleted parameter as ``{}``, like one that is set to ``{}``.
    """

    key: str
    """The resolved name of the parameter that was set or deleted."""
    value: Any
    """Its new value; ``{}`` for a deleted parameter."""


@public
@dataclass(frozen=True, slots=True)
class MasterLost(Event):
    """The master has not answered a heartbeat. Connected topics keep working."""

    uri: str
    """The URI of the master."""
    reason: str
    """The error that the heartbeat got."""


@public
@dataclass(frozen=True, slots=True)
class MasterRestarted(Event):
    """The master is back, was replaced, had forgotten this node, or was told its new address.
    It has all registrations again, except those that it refuses."""

    uri: str
    """The URI of the master."""
    run_id: str
    """Its ``/run_id``, which tells one run of a master from another."""


@public
@dataclass(frozen=True, slots=True)
class ClockJumped(Event):
    """The time of the node has jumped. ``/clock`` went backwards, as when a simulation or a
    bag starts over, or the node started or stopped following it.

    Discard any stamped data you keep.
    """

    before: Time
    """The last time before the jump."""
    now: Time
    """The first time after it."""


T = TypeVar("T")


class Broadcast(Generic[T]):
    """Gives every item to all current iterators.

    Each has its own queue of ``size`` items and drops the oldest when it is full. When the
    broadcast closes, the iterations end after the items that came before.
    """

    def __init__(self, size: int = 1000) -> None:
        self._size = size
        # Weak references, so that a loop that was left need not unsubscribe.
        self._streams: WeakSet[EventStream[T]] = WeakSet()
        self._closed = False

    def publish(self, item: T) -> None:
        for stream in self._streams:
            stream._put(item)

    def close(self) -> None:
        self._closed = True
        for stream in self._streams:
            stream._close()

    def subscribe(self) -> EventStream[T]:
        """Return an iterator over the items published from now on."""
        stream: EventStream[T] = EventStream(self._size)
        self._streams.add(stream)
        if self._closed:
            stream._close()
        return stream


@public
class EventStream(Generic[T]):
    """An asynchronous iterator over events; made by :meth:`aioros1.Node.events`.

    It queues up to a thousand events, then drops the oldest. It ends with the node, after the
    events that came before.
    """

    def __init__(self, size: int) -> None:
        self.dropped = 0
        """Items dropped because the queue was full."""
        self._queue: deque[T] = deque(maxlen=size)
        self._waiters = Waiters()
        self._closed = False

    def __aiter__(self) -> Self:
        return self

    async def __anext__(self) -> T:
        while not self._queue:
            if self._closed:
                raise StopAsyncIteration
            await self._waiters.wait()
        return self._queue.popleft()

    def __repr__(self) -> str:
        state = "ended" if self._closed else "open"
        return f"<EventStream, {len(self._queue)} waiting, {self.dropped} dropped, {state}>"

    def _put(self, item: T) -> None:
        self.dropped += len(self._queue) == self._queue.maxlen
        self._queue.append(item)
        self._waiters.wake()

    def _close(self) -> None:
        self._closed = True
        self._waiters.wake()
