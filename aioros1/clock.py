"""The time of a node: the wall clock, or the simulated time of ``/clock``."""

from __future__ import annotations

import asyncio
import math
import time
from collections.abc import Awaitable, Callable
from typing import TYPE_CHECKING, Any, Self

from aioros1.errors import ClosedError, MasterUnreachable
from aioros1.time import Duration, Time
from aioros1.waiting import Waiters

if TYPE_CHECKING:
    from aioros1.node import Node

__all__ = ["Clock", "Rate", "Timer"]

_RETRY = 1.0

_SILENCE = 5.0
"""Seconds without any time on ``/clock`` after which that is worth a warning."""


class Clock:
    """Tells the time and waits for it.

    While time is simulated it is what ``/clock`` said last, zero before that, and
    waiting goes by it. When it jumps backwards, because a simulation or a bag starts
    over, whoever waits goes on at once: the time waited for may never come. The same
    holds when a node that waits by the wall clock learns that time is simulated.
    """

    def __init__(self) -> None:
        self.is_simulated = False
        self._simulated = 0
        self._changed = Waiters()
        self._awaited: list[int] = []  # by those who wait for simulated time

    def nanoseconds(self) -> int:
        """Nanoseconds since the epoch, or of the simulation."""
        return self._simulated if self.is_simulated else time.time_ns()

    def simulate(self) -> None:
        """From now on the time is what :meth:`set` says."""
        if not self.is_simulated:
            self.is_simulated = True
            self._changed.wake()

    def set(self, now: Time) -> None:
        """Simulated time has come to ``now``."""
        self._simulated = now.to_nsec()
        self._changed.wake()

    @property
    def next_awaited(self) -> int | None:
        """The earliest moment of simulated time that somebody waits for, in nanoseconds."""
        return min(self._awaited, default=None)

    async def wait_until_shows(self, moment: int, *, timeout: float) -> None:
        """Wait until simulated time is exactly ``moment`` nanoseconds."""
        await self._changed.wait_until(
            lambda: self._simulated == moment, timeout=timeout, what=f"no time {moment} ns"
        )

    async def follow(self, node: Node) -> None:
        """Take the time from ``/clock``, as soon as the master lets us."""
        subscriber = None
        while subscriber is None:
            try:
                subscriber = await node.subscribe("/clock", "rosgraph_msgs/Clock", queue_size=1)
            except MasterUnreachable:
                await node._pause(_RETRY)
        try:
            self.set((await subscriber.get(timeout=_SILENCE)).clock)
        except TimeoutError:
            node.log.warning(
                "time is simulated, but nothing came on /clock in %g s: it stands at zero, and "
                "nothing that waits for it goes on",
                _SILENCE,
            )
        async for message in subscriber:
            self.set(message.clock)

    def fail(self, error: BaseException) -> None:
        """No more time comes; whoever waits for it gets ``error``."""
        self._changed.fail(error)

    def check(self) -> None:
        """Raise what :meth:`fail` was given, if it was."""
        self._changed.check()

    async def sleep(self, duration: float | Duration) -> None:
        """Wait for ``duration`` seconds of this clock."""
        nanoseconds = _nanoseconds(duration)
        await self.wait_until(await self.begin() + nanoseconds)

    def rate(self, hz: float) -> Rate:
        """Gives the time, ``hz`` times a second, until the node is closed."""
        if not 0 < hz < math.inf or not math.isfinite(period := 1e9 / float(hz)):
            raise ValueError(f"a rate must be positive, got {hz!r}")
        return Rate(self, round(period))

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
                while last <= self._simulated < moment:
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


class Rate:
    """An iterator over the times at which a period begins; made by :meth:`Node.rate`.

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


class Timer:
    """Calls a function again and again; made by :meth:`Node.timer`."""

    def __init__(
        self,
        node: Node,
        period: float | Duration,
        callback: Callable[[Time], Any] | Callable[[Time], Awaitable[Any]],
        *,
        oneshot: bool,
    ) -> None:
        nanoseconds = _nanoseconds(period)
        if not nanoseconds > 0:
            raise ValueError(f"the period of a timer must be positive, got {period!r}")
        self._node = node
        self._rate = Rate(node._clock, nanoseconds)
        self._callback = callback
        self._oneshot = oneshot
        self._task = node._spawn(self._run, name=f"{node.name} timer")

    def cancel(self) -> None:
        """Call the function no more; a call that runs is cancelled."""
        self._task.cancel()

    async def _run(self) -> None:
        async for now in self._rate:
            try:
                result = self._callback(now)
                if asyncio.iscoroutine(result) or asyncio.isfuture(result):
                    await result
            except Exception as error:  # the user's code; what becomes of it is an option
                self._node._user_error(error, "the callback of a timer")
            if self._oneshot:
                return


def _nanoseconds(duration: float | Duration) -> int:
    """To the nearest one; exactly for a :class:`~aioros1.Duration`."""
    if isinstance(duration, Duration):
        return duration.to_nsec()
    if not math.isfinite(duration):
        raise ValueError(f"a time to wait must be finite, got {duration!r}")
    return Duration(duration).to_nsec()
