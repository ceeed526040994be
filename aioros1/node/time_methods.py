"""The time methods of a node."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from typing import Any

from aioros1.clock.rate import Rate, period_of
from aioros1.clock.timer import Timer
from aioros1.core.context import Context
from aioros1.hints import explained, methods_of
from aioros1.time import Duration, Time

__all__ = ["TimeMethods"]


@methods_of("Node")
class TimeMethods:
    """The time methods of :class:`~aioros1.Node`."""

    _context: Context

    def now(self) -> Time:
        """The current time: that of ``/clock`` if the node follows it, else the wall clock's."""
        return Time.from_nsec(self._context.clock.nanoseconds())

    @property
    def uses_sim_time(self) -> bool:
        """Whether the node follows the time of ``/clock``."""
        return self._context.clock.is_simulated

    async def sleep(self, duration: float | Duration) -> None:
        """Sleep for ``duration`` seconds of this node's time.

        Raises :class:`~aioros1.ClosedError`.
        """
        self._context.check_loop()
        await self._context.clock.sleep(duration)

    @explained
    def rate(self, hz: float) -> Rate:
        """Iterate ``hz`` times per second of this node's time; ends with the node.

        Raises :class:`ValueError` for a rate that is not positive.
        """
        self._context.check_iterator()
        return Rate(self._context.clock, period_of(hz))

    @explained
    def timer(
        self,
        period: float | Duration,
        callback: Callable[[Time], Any] | Callable[[Time], Awaitable[Any]],
        *,
        oneshot: bool = False,
    ) -> Timer:
        """Call a function or coroutine function with the time, every ``period`` seconds.

        The timer ends with the node, or when you call :meth:`aioros1.Timer.cancel`. Exceptions
        in the function are handled as ``on_error`` says.
        """
        context = self._context
        context.check_open()
        return Timer(
            *(context.clock, context.spawn_user, context.user_error, period, callback),
            oneshot=oneshot,
        )

    @property
    def next_wakeup(self) -> Time | None:
        """The earliest simulated time that anything in this node waits for; None if nothing
        does. This is for programs that step ``/clock``."""
        moment = self._context.clock.next_awaited
        return None if moment is None else Time.from_nsec(moment)

    async def wait_for_time(self, time: Time, *, timeout: float | None = None) -> None:
        """Wait until the simulated time is exactly ``time``, a step of ``/clock``.

        This is for programs that step ``/clock``. Raises :class:`TimeoutError` after
        ``timeout`` seconds, and :class:`~aioros1.ClosedError`.
        """
        self._context.check_loop()
        if not isinstance(time, Time):
            raise TypeError(f"wait_for_time() takes a Time, as in Time(5), got {time!r:.200}")
        await self._context.clock.wait_until_shows(time.to_nsec(), timeout=timeout)
