"""Repeating a loop at a fixed rate."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Self

from aioros1._public import public
from aioros1.clock.clock import Clock
from aioros1.errors import ClosedError
from aioros1.hints import RATE_HABITS, explained_attributes
from aioros1.time import Time

__all__ = ["Rate", "period_of"]


@public
class Rate:
    """Iterates over the times at which periods begin; made by :meth:`aioros1.Node.rate`.

    The rate keeps its phase: a slow loop body shortens the pause after it, and a body that
    takes longer than a period skips the ticks it missed. With the wall clock, a tick missed by
    less than a period comes late instead, as in rospy: timers are a millisecond coarse, so a
    rate of 1 kHz would lose every tenth tick.
    """

    # Not a generator: the first cancellation, or a timeout around one tick, would end it.

    if not TYPE_CHECKING:

        def __new__(cls, *args: Any, **kwargs: Any) -> Self:
            if not (args and isinstance(args[0], Clock)):
                raise TypeError("a rate needs a node: use node.rate(hz) in place of Rate(...)")
            return super().__new__(cls)

        __getattr__ = explained_attributes(RATE_HABITS)

    def __init__(self, clock: Clock, period: int) -> None:
        self.missed = 0
        """Ticks skipped so far. Those skipped by the current loop body are counted when it
        asks for the next tick."""
        self._clock = clock
        self._period = max(1, period)
        self._is_simulated = clock.is_simulated
        self._tick: int | None = None
        """The start of the period that runs or that is waited for."""
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
            clock.check()  # no tick once the roles of the node are closed
        except ClosedError:
            raise StopAsyncIteration from None
        self._was_given = True
        return Time.from_nsec(clock.nanoseconds())

    async def aclose(self) -> None:
        """End the iteration. You need not call this: the iterator holds no resources."""
        self._has_ended = True

    def __repr__(self) -> str:
        return f"<Rate of {1e9 / self._period:g} Hz, {self.missed} ticks missed>"

    async def _wait(self) -> None:
        clock = self._clock
        while True:
            if self._is_simulated is not clock.is_simulated:  # the clock changed: start over
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
        if now < tick:  # a jump backwards: start a new phase
            tick = now
        missed = (now - tick) // period
        if missed == 1 and not clock.is_simulated:
            missed = 0
        self.missed += missed
        return tick + period * (missed + 1)


def period_of(hz: float) -> int:
    """The period in nanoseconds. Raises :class:`ValueError` for a rate that is not positive."""
    if not hasattr(hz, "__float__") or not hasattr(hz, "__lt__"):
        raise TypeError(f"a rate is a number of Hz, got {hz!r:.200}")
    if not 0 < hz < math.inf or not math.isfinite(period := 1e9 / float(hz)):
        raise ValueError(f"a rate must be positive, got {hz!r}")
    return round(period)
