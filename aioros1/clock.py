"""The time of a node: the wall clock, or the simulated time of ``/clock``."""

from __future__ import annotations

import asyncio
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


class Clock:
    """Tells the time and waits for it.

    While time is simulated it is what ``/clock`` said last, zero before that, and
    waiting goes by it. When it jumps backwards, because a simulation or a bag starts
    over, whoever waits goes on at once: the time waited for may never come.
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
        self.is_simulated = True

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
        seconds = duration.to_sec() if isinstance(duration, Duration) else duration
        await self.wait_until(await self.begin() + round(seconds * 1e9))

    def rate(self, hz: float) -> Rate:
        """Gives the time, ``hz`` times a second, until the node is closed."""
        return Rate(self, hz)

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

    def __init__(self, clock: Clock, hz: float) -> None:
        if not hz > 0:
            raise ValueError(f"a rate must be positive, got {hz!r}")
        self._clock = clock
        self._period = round(1e9 / hz)
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
            if self._tick is None:
                self._tick = await clock.begin() + self._period
            elif self._was_given:
                self._tick = self._next(self._tick)
            self._was_given = False
            await clock.wait_until(self._tick)
            clock.check()  # no tick for a node whose roles are closed already
        except ClosedError:
            raise StopAsyncIteration from None
        self._was_given = True
        return Time.from_nsec(clock.nanoseconds())

    async def aclose(self) -> None:
        """End the iteration. There is no need to: nothing is held."""
        self._has_ended = True

    def _next(self, tick: int) -> int:
        clock, period = self._clock, self._period
        now = clock.steady()
        if now < tick - period:  # a jump backwards: a new phase
            tick = now
        missed = (now - tick) // period
        if missed == 1 and not clock.is_simulated:
            missed = 0
        return tick + period * max(1, missed + 1)


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
        seconds = period.to_sec() if isinstance(period, Duration) else period
        if not seconds > 0:
            raise ValueError(f"the period of a timer must be positive, got {period!r}")
        self._node = node
        self._seconds = seconds
        self._callback = callback
        self._oneshot = oneshot
        self._task = node._spawn(self._run, name=f"{node.name} timer")

    def cancel(self) -> None:
        """Call the function no more; a call that runs is cancelled."""
        self._task.cancel()

    async def _run(self) -> None:
        async for now in self._node.rate(1 / self._seconds):
            try:
                result = self._callback(now)
                if asyncio.iscoroutine(result) or asyncio.isfuture(result):
                    await result
            except Exception as error:  # the user's code; what becomes of it is an option
                self._node._user_error(error, "the callback of a timer")
            if self._oneshot:
                return
