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

    Simulated time is the latest time from ``/clock``, zero before the first. Waiting follows
    it. When it jumps backwards, because a simulation or a bag starts over, all waits end at
    once: the time they wait for may never come. The same happens when time starts or stops
    being simulated. ``on_jump`` is called with the nanoseconds before and after each jump.
    """

    def __init__(self, on_jump: Callable[[int, int], object] | None = None) -> None:
        self.is_simulated = False
        """Whether the clock follows ``/clock``."""
        self._simulated = 0
        self._changed = Waiters()
        self._awaited: list[int] = []  # the simulated times that are waited for
        self._on_jump = on_jump

    def nanoseconds(self) -> int:
        """The time in nanoseconds since the epoch, or of the simulation."""
        return self._simulated if self.is_simulated else time.time_ns()

    def simulate(self) -> None:
        """Follow the time given to :meth:`set` from now on."""
        if not self.is_simulated:
            before = self.nanoseconds()
            self.is_simulated = True
            self._jumped(before)

    def stop_simulating(self) -> None:
        """Follow the wall clock from now on."""
        before = self.nanoseconds()
        self.is_simulated = False
        self._simulated = 0
        self._jumped(before)

    def set(self, now: Time) -> None:
        """Set the simulated time."""
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
        """The earliest simulated time that is waited for, in nanoseconds; None if none is."""
        return min(self._awaited, default=None)

    async def wait_until_shows(self, moment: int, *, timeout: float | None) -> None:
        """Wait until simulated time is exactly ``moment`` nanoseconds."""
        await self._changed.wait_until(
            lambda: self.is_simulated and self._simulated == moment,
            timeout=timeout,
            what=f"no time {moment} ns",
        )

    def fail(self, error: BaseException) -> None:
        """Stop the clock: everyone who waits for it gets ``error``."""
        self._changed.fail(error)

    def check(self) -> None:
        """Raise the error given to :meth:`fail`, if any."""
        self._changed.check()

    async def sleep(self, duration: float | Duration) -> None:
        """Wait for ``duration`` seconds of this clock."""
        nanoseconds = to_nanoseconds(duration)
        await self.wait_until(await self.begin() + nanoseconds)

    def steady(self) -> int:
        """The nanoseconds that waiting follows: not the wall clock's, which can be set."""
        return self._simulated if self.is_simulated else time.monotonic_ns()

    async def begin(self) -> int:
        """Return the time from which to wait, as soon as there is any."""
        while self.is_simulated and not self._simulated:
            await self._changed.wait()
        return self.steady()

    async def wait_until(self, moment: int) -> None:
        """Wait until :meth:`steady` reaches ``moment``."""
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
            await asyncio.sleep(0)  # let other tasks run
        while not self.is_simulated and (left := moment - self.steady()) > 0:
            # While time is not simulated, only the end of the node wakes this up early. Timers
            # of event loops are a millisecond coarse; uvloop's end at once below half of one.
            await self._changed.wait(max(left / 1e9, 1e-3))


def to_nanoseconds(duration: float | Duration) -> int:
    """Round to the nearest nanosecond; exact for a :class:`~aioros1.Duration`."""
    if isinstance(duration, Duration):
        return duration.to_nsec()
    if not hasattr(duration, "__float__"):
        raise TypeError(
            f"a time to wait is a Duration or a number of seconds, got {duration!r:.200}"
        )
    if not math.isfinite(duration):
        raise ValueError(f"a time to wait must be finite, got {duration!r}")
    return Duration(duration).to_nsec()
