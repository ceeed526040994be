"""Doing something so many times a second."""

from __future__ import annotations

import math
from typing import Self

from aioros1._public import public
from aioros1.clock.clock import Clock
from aioros1.errors import ClosedError
from aioros1.time import Time

__all__ = ["Rate", "period_of"]


@public
class Rate:
    """An iterator over the times at which a period begins; made by :meth:`aioros1.Node.rate`.

    The phase is kept: a body that takes a while shortens the pause after it, and one
    that takes longer than a period makes the ticks it missed be skipped. By the wall
    clock one that is missed by less than a period comes late instead, as in rospy:
    timers are a millisecond coarse, and a kilohertz would lose every tenth tick.
    """

    # Not a generator: the first cancellation, or a time limit of one tick, would end that.

    def __init__(self, clock: Clock, period: int) -> None:
        self.missed = 0
        """Ticks that were skipped so far. Those of the latest pause are counted when the
        next tick is asked for."""
        self._clock = clock
        self._period = max(1, period)
        self._is_simulated = clock.is_simulated
        self._tick: int | None = None
        """When the period that is waited for, or that runs, has begun or will begin."""
        self._was_given = False
        self._has_ended = False

    def __aiter__(self) -> Self:
        return self

    async def __anext__(self) -> Time:
        clock = self._clock
        try:
            clock.check()
            if self._has_ended:
                raise StopAsyncIteration
            await self._wait()
            clock.check()  # no tick for a node whose roles are closed already
        except ClosedError:
            raise StopAsyncIteration from None
        self._was_given = True
        return Time.from_nsec(clock.nanoseconds())

    async def aclose(self) -> None:
        """End the iteration. There is no need to: nothing is held."""
        self._has_ended = True

    def __repr__(self) -> str:
        return f"<Rate of {1e9 / self._period:g} Hz, {self.missed} ticks missed>"

    async def _wait(self) -> None:
        clock = self._clock
        while True:
            if self._is_simulated is not clock.is_simulated:  # another time: begin again
                self._is_simulated = clock.is_simulated
                self._tick = None
            if self._tick is None:
                self._tick = await clock.begin() + self._period
            elif self._was_given:
                self._tick = self._next(self._tick)
            self._was_given = False
            await clock.wait_until(self._tick)
            if self._is_simulated is clock.is_simulated:
                return

    def _next(self, tick: int) -> int:
        clock, period = self._clock, self._period
        now = clock.steady()
        if now < tick:  # a jump backwards: a new phase
            tick = now
        missed = (now - tick) // period
        if missed == 1 and not clock.is_simulated:
            missed = 0
        self.missed += missed
        return tick + period * (missed + 1)


def period_of(hz: float) -> int:
    """The nanoseconds of one. Raises :class:`ValueError` for a rate that is not positive."""
    if not 0 < hz < math.inf or not math.isfinite(period := 1e9 / float(hz)):
        raise ValueError(f"a rate must be positive, got {hz!r}")
    return round(period)
