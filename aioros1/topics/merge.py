"""Several subscribers as one iteration."""

from __future__ import annotations

import asyncio
from typing import Any, Generic, Self, TypeVar, overload

from aioros1.topics.subscriber import Subscriber
from aioros1.waiting import wait_for_any

__all__ = ["Merge", "merge"]

A = TypeVar("A")
B = TypeVar("B")
C = TypeVar("C")
M = TypeVar("M")


class Merge(Generic[M]):
    """An asynchronous iterator over the messages of several subscribers; made by :func:`merge`.

    It has no queue of its own: each message stays in its subscriber's until it is taken, and
    so whoever is cancelled has lost none.
    """

    def __init__(self, subscribers: tuple[Subscriber[Any], ...]) -> None:
        self._subscribers = subscribers

    def __aiter__(self) -> Self:
        return self

    async def __anext__(self) -> tuple[str, M]:
        while True:
            subscribers = [sub for sub in self._subscribers if sub.is_open]
            if not subscribers:
                raise StopAsyncIteration
            waiting = [sub for sub in subscribers if sub.queued]
            if not waiting:
                await wait_for_any([sub._arrived for sub in subscribers])
                continue
            first = min(waiting, key=_received)
            try:
                return first.name, first.get_nowait()
            except asyncio.QueueEmpty:
                pass  # what was there could not be decoded


@overload
def merge(first: Subscriber[A], second: Subscriber[B], /) -> Merge[A | B]: ...
@overload
def merge(
    first: Subscriber[A], second: Subscriber[B], third: Subscriber[C], /
) -> Merge[A | B | C]: ...
@overload
def merge(*subscribers: Subscriber[Any]) -> Merge[Any]: ...
def merge(*subscribers: Subscriber[Any]) -> Merge[Any]:
    """Iterate over the messages of several subscribers, of one node or of several.

    ::

        async for topic, message in aioros1.merge(odometry, scans):
            ...

    The messages come in the order in which they were received, each with the resolved name
    of its topic. What was taken here is not handed out by the subscriber again. Subscribers
    that are closed are left out from then on, and the iteration ends with the last of them.
    Raises :class:`TypeError` for anything that is no :class:`Subscriber`.
    """
    for each in subscribers:
        if not isinstance(each, Subscriber):
            raise TypeError(f"merge takes subscribers, got {each!r}")
    return Merge(subscribers)


def _received(subscriber: Subscriber[Any]) -> int:
    """When its next message came, in nanoseconds."""
    return subscriber._queue[0][0].received
