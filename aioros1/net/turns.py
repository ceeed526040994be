"""Shares an event loop between requests, so that none of them holds it up for long.

Reading a request of the largest size that is allowed, or writing such an answer, takes seconds.
A thousand small requests that arrive at once take as long. So whoever works on a request takes a
:class:`Turn`, and others run in between:

* A short request is worked on at once, unless such requests have used up their share of the
  time, which is one half. Then it waits, and a few are let go in each iteration of the loop.
* A long one is worked on in steps. When its turn is over it waits, and one of those that wait
  is let go in each iteration.
"""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import Generator
from time import perf_counter
from typing import TypeVar

__all__ = ["SLICE", "Turn", "Turns"]

SLICE = 0.01
"""Seconds of work after which others have their turn."""

_SHARE = 0.5
"""The part of the time that short requests may use before they have to wait."""

_AT_ONCE = 16
"""Short requests that are let go in one iteration, if they are as short as most."""

T = TypeVar("T")

_Queue = deque[asyncio.Future[None]]


class Turns:
    """The turns of one event loop."""

    def __init__(self, loop: asyncio.AbstractEventLoop) -> None:
        self._loop = loop
        self._short: _Queue = deque()
        self._long: _Queue = deque()
        self._is_due = False
        self._used = 0.0  # seconds of work, less the share of the time that has passed since
        self._at = 0.0

    async def take(self) -> Turn:
        """Return a turn, as soon as there is time for one."""
        now = perf_counter()
        if self._short or self._used - _SHARE * (now - self._at) > SLICE:
            await self._wait(self._short)
            while self._used > SLICE:  # those that were let go before were not so short
                await self._wait(self._short, first=True)
            now = perf_counter()
        return Turn(self, now)

    async def next_step(self) -> None:
        """Wait until it is one's turn among those that take long."""
        await self._wait(self._long)

    def use(self, begin: float, end: float) -> None:
        """Note that a short request was worked on between these times."""
        self._used = max(self._used - _SHARE * (begin - self._at), 0.0) + end - begin
        self._at = end

    async def _wait(self, queue: _Queue, *, first: bool = False) -> None:
        future = self._loop.create_future()
        if first:
            queue.appendleft(future)
        else:
            queue.append(future)
        if not self._is_due:
            self._is_due = True
            self._loop.call_soon(self._let_go)
        await future

    def _let_go(self) -> None:
        """Let some of those that wait go. Called in each iteration while there are any."""
        self._used, self._at = 0.0, perf_counter()
        _release(self._long, 1)
        _release(self._short, _AT_ONCE)
        self._is_due = bool(self._long or self._short)
        if self._is_due:
            self._loop.call_soon(self._let_go)


class Turn:
    """One request's use of the event loop."""

    __slots__ = ("_begin", "_is_long", "_turns")

    def __init__(self, turns: Turns, begin: float | None = None) -> None:
        self._turns = turns
        self._begin = perf_counter() if begin is None else begin
        self._is_long = False

    @property
    def is_over(self) -> bool:
        """Whether others should have their turn now."""
        return perf_counter() - self._begin > SLICE

    async def next(self) -> None:
        """Let others have their turn."""
        self.end()
        self._is_long = True
        await self._turns.next_step()
        self._begin = perf_counter()

    async def run(self, steps: Generator[None, None, T]) -> T:
        """Do all of ``steps``, in as many turns as that takes, and return their result."""
        while True:
            try:
                next(steps)
            except StopIteration as end:
                result: T = end.value
                return result
            if perf_counter() - self._begin > SLICE:
                await self.next()

    def resume(self) -> None:
        """Go on after waiting for something else."""
        self._begin = perf_counter()

    def end(self) -> None:
        """Note that the work is done, or goes on later."""
        if not self._is_long:
            self._turns.use(self._begin, perf_counter())


def _release(queue: _Queue, count: int) -> None:
    while queue and count:
        future = queue.popleft()
        if not future.done():  # or whoever waited was cancelled
            future.set_result(None)
            count -= 1
