"""The time of a node: the wall clock, or the simulated time of ``/clock``."""

from __future__ import annotations

import asyncio
import math
import time
from collections.abc import Callable

from aioros1.time import Duration, Time
from aioros1.waiting import Waiters

__all__ = ["Clock", "to_nanoseconds"]


class Clock:
    """Tells the time and waits for it.

    While time is simulated it is what ``/clock`` said last, zero before that, and
    waiting goes by it. When it jumps backwards, because a simulation or a bag starts
    over, whoever waits goes on at once: the time waited for may never come. The same
    holds when time becomes simulated, or is so no more. Of each of these jumps ``on_jump`` is
    told, with the nanoseconds before and after.
    """

    def __init__(self, on_jump: Callable[[int, int], object] | None = None) -> None:
        self.is_simulated = False
        """Whether the time is that of ``/clock``."""
        self._simulated = 0
        self._changed = Waiters()
        self._awaited: list[int] = []  # by those who wait for simulated time
        self._on_jump = on_jump

    def nanoseconds(self) -> int:
        """Nanoseconds since the epoch, or of the simulation."""
        return self._simulated if self.is_simulated else time.time_ns()

    def simulate(self) -> None:
        """From now on the time is what :meth:`set` says."""
        if not self.is_simulated:
            before = self.nanoseconds()
            self.is_simulated = True
            self._jumped(before)

    def stop_simulating(self) -> None:
        """From now on the time is that of the wall clock."""
        before = self.nanoseconds()
        self.is_simulated = False
        self._simulated = 0
        self._jumped(before)

    def set(self, now: Time) -> None:
        """Simulated time has come to ``now``."""
        before, self._simulated = self._simulated, now.to_nsec()
        if self.is_simulated and self._simulated < before:
            self._jumped(before)
        else:
            self._changed.wake()

    def _jumped(self, before: int) -> None:
        self._changed.wake()
        if self._on_jump is not None:
            self._on_jump(before, self.nanoseconds())

    @property
    def next_awaited(self) -> int | None:
        """The earliest moment of simulated time that somebody waits for, in nanoseconds."""
        return min(self._awaited, default=None)

    async def wait_until_shows(self, moment: int, *, timeout: float | None) -> None:
        """Wait until simulated time is exactly ``moment`` nanoseconds."""
        await self._changed.wait_until(
            lambda: self.is_simulated and self._simulated == moment,
            timeout=timeout,
            what=f"no time {moment} ns",
        )

    def fail(self, error: BaseException) -> None:
        """No more time comes; whoever waits for it gets ``error``."""
        self._changed.fail(error)

    def check(self) -> None:
        """Raise what :meth:`fail` was given, if it was."""
        self._changed.check()

    async def sleep(self, duration: float | Duration) -> None:
        """Wait for ``duration`` seconds of this clock."""
        nanoseconds = to_nanoseconds(duration)
        await self.wait_until(await self.begin() + nanoseconds)

    def steady(self) -> int:
        """What waiting goes by. Not the wall clock, which can be set."""
        return self._simulated if self.is_simulated else time.monotonic_ns()

    async def begin(self) -> int:
        """The time from which to wait: not before there is any."""
        while self.is_simulated and not self._simulated:
            await self._changed.wait()
        return self.steady()

    async def wait_until(self, moment: int) -> None:
        """Wait until :meth:`steady` has come to ``moment``."""
        if self.is_simulated:
            last = self._simulated
            self._awaited.append(moment)
            try:
                while self.is_simulated and last <= self._simulated < moment:
                    last = self._simulated
                    await self._changed.wait()
            finally:
                self._awaited.remove(moment)
            return
        if moment <= self.steady():
            await asyncio.sleep(0)  # others want to run all the same
        while not self.is_simulated and (left := moment - self.steady()) > 0:
            # Nothing changes the wall clock but the end of the node. The timers of loops are
            # a millisecond coarse; uvloop's end at once if there is less than half of one.
            await self._changed.wait(max(left / 1e9, 1e-3))


def to_nanoseconds(duration: float | Duration) -> int:
    """To the nearest one; exactly for a :class:`~aioros1.Duration`."""
    if isinstance(duration, Duration):
        return duration.to_nsec()
    if not math.isfinite(duration):
        raise ValueError(f"a time to wait must be finite, got {duration!r}")
    return Duration(duration).to_nsec()
