"""When a followed parameter is read at the master, beyond what the master announces."""

from __future__ import annotations

import asyncio
import math
import random
from collections.abc import Awaitable, Callable, Sized
from typing import TYPE_CHECKING

from aioros1.core.time_taken import TimeTaken
from aioros1.errors import MasterError, MasterUnreachable
from aioros1.waiting import Waiters

if TYPE_CHECKING:
    from aioros1.core.context import Context

__all__ = ["Rereading"]

_GAP = 0.02
"""The least number of seconds between two readings, so that a burst of notices is one."""

_MOST_BEATS = 4
"""Heartbeats between two readings of a value about which nothing is heard."""

_SHARE = 50
"""While nothing is heard, the time between two readings is at least that many times as long as
a reading takes, so that large values are seldom read. The same holds for all that a node
follows together: a master has many nodes, and each may follow hundreds of parameters."""

_LONGEST = 60.0
"""Seconds between two readings for the sake of the other parameters, at most."""


class Rereading:
    """Reads one value: at once, some time after a notice, and ever more seldom after that.

    Notices may be lost, or overtaken by changes. And rosmaster sends none to the followers of
    ``/a/b`` when ``/a`` is set to a plain value. ``read`` returns whether the value was
    another than the one known. ``followed`` is all that the node follows.
    """

    def __init__(
        self, context: Context, name: str, read: Callable[[], Awaitable[bool]], followed: Sized
    ) -> None:
        self._context = context
        self._name = name
        self._read = read
        self._followed = followed
        self._beat = context.options.heartbeat or 1.0
        self._reads_idly = context.options.heartbeat is not None
        self._interval = self._beat
        self._took = TimeTaken()
        self._due = math.inf
        self._not_before = -math.inf
        self._is_refused = False
        self._woken = Waiters()
        self._task: asyncio.Task[None] | None = None

    def begin(self) -> None:
        """Begin to read, unless it has begun."""
        if self._task is None or self._task.done():
            self._task = self._context.spawn(
                self._run, name=f"{self._context.name} reads parameter {self._name}"
            )
            self.later()

    def end(self) -> None:
        """Stop."""
        if self._task is not None:
            self._task.cancel()
            self._task = None

    def soon(self) -> None:
        """Read as soon as possible, from now on."""
        self._interval = self._beat
        self._plan(-math.inf)

    def later(self) -> None:
        """Read within a heartbeat."""
        self._interval = self._beat
        self._plan(asyncio.get_running_loop().time() + self._beat)

    def _plan(self, due: float) -> None:
        if due < self._due:
            self._due = due
            self._woken.wake()

    async def _run(self) -> None:
        loop = asyncio.get_running_loop()
        while True:
            while (left := max(self._due, self._not_before) - loop.time()) > 0:
                await self._woken.wait(None if left == math.inf else left)
            began, self._due = loop.time(), math.inf
            rest = 0.0
            try:
                if await self._read():
                    self._interval = self._beat
                else:
                    rest = self._rest(loop.time() - began)
                self._is_refused = False
            except MasterUnreachable:
                pass
            except MasterError as error:  # of what is no master, or larger than the limits
                if not self._is_refused:
                    self._is_refused = True
                    self._context.log.warning("cannot read parameter %s: %s", self._name, error)
            now = loop.time()
            self._not_before = now + max(_GAP, now - began)
            # Nodes that were started together need not read together for ever.
            self._plan(now + max(rest, self._interval) * random.uniform(0.9, 1.1))
            self._interval = min(self._interval * 2, self._beat * _MOST_BEATS)

    def _rest(self, took: float) -> float:
        """How long not to read a value of which nothing is heard, and which is the same."""
        if not self._reads_idly:
            return math.inf
        self._took.add(took)
        all_of_them = self._took.seconds * _SHARE * len(self._followed)
        return max(took * _SHARE, min(all_of_them, _LONGEST))
