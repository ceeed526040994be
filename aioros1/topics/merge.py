"""Iterating over several subscribers at once."""

from __future__ import annotations

import asyncio
from typing import Any, Generic, Self, TypeVar, overload

from aioros1._public import public
from aioros1.time import Time
from aioros1.topics.subscriber import Subscriber

__all__ = ["Merge", "merge"]

A = TypeVar("A")
B = TypeVar("B")
C = TypeVar("C")
M = TypeVar("M")


@public
class Merge(Generic[M]):
    """An asynchronous iterator over the messages of several subscribers; made by
    :func:`aioros1.merge`.

    It has no queue of its own: each message stays in its subscriber's queue until you take
    it, so cancelling loses none.
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
            first: tuple[Time, Subscriber[Any]] | None = None
            for sub in subscribers:
                received = sub.next_received
                if received is not None and (first is None or received < first[0]):
                    first = received, sub
            if first is None:
                await _wait_for_any(subscribers)
                continue
            try:
                return first[1].name, first[1].get_nowait()
            except asyncio.QueueEmpty:
                pass  # the message could not be decoded

    def __repr__(self) -> str:
        return f"<Merge of {', '.join(sub.name for sub in self._subscribers) or 'nothing'}>"


async def _wait_for_any(subscribers: list[Subscriber[Any]]) -> None:
    """Wait until one of ``subscribers`` has a message or is closed."""
    arrived = asyncio.get_running_loop().create_future()

    def wake() -> None:
        if not arrived.done():
            arrived.set_result(None)

    for sub in subscribers:
        sub.add_arrival_callback(wake)
    try:
        await arrived
    finally:
        for sub in subscribers:
            sub.remove_arrival_callback(wake)


@overload
def merge(first: Subscriber[A], second: Subscriber[B], /) -> Merge[A | B]: ...
@overload
def merge(
    first: Subscriber[A], second: Subscriber[B], third: Subscriber[C], /
) -> Merge[A | B | C]: ...
@overload
def merge(*subscribers: Subscriber[Any]) -> Merge[Any]: ...
@public
def merge(*subscribers: Subscriber[Any]) -> Merge[Any]:
    """Iterate over the messages of several subscribers, of one node or of several.

    ::

        async for topic, message in aioros1.merge(odometry, scans):
            ...

    Messages come in the order in which they were received, each with the resolved name of
    its topic. A message taken here is gone from its subscriber. A closed subscriber drops
    out, and the iteration ends when all are closed. Raises :class:`TypeError` for anything
    that is not a :class:`~aioros1.Subscriber`, and for a subscriber with a callback.
    """
    for each in subscribers:
        if not isinstance(each, Subscriber):
            raise TypeError(f"merge takes subscribers, got {each!r}")
        if each.callback is not None:
            raise TypeError(f"merge: {each!r} has a callback, which gets all messages")
    return Merge(subscribers)
