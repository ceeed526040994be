"""Calling a function periodically."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from typing import TYPE_CHECKING, Any, Protocol, Self

from aioros1._public import public
from aioros1.clock.clock import Clock, to_nanoseconds
from aioros1.clock.rate import Rate
from aioros1.hints import check_takes
from aioros1.net.loop_state import loop_state
from aioros1.time import Duration, Time

__all__ = ["Timer"]


class Spawn(Protocol):
    """Runs a coroutine function in a task that ends with the node."""

    def __call__(
        self, function: Callable[[], Awaitable[None]], /, *, name: str
    ) -> asyncio.Task[None]: ...


@public
class Timer:
    """Calls a function periodically; made by :meth:`aioros1.Node.timer`."""

    if not TYPE_CHECKING:

        def __new__(cls, *args: Any, **kwargs: Any) -> Self:
            if not (args and isinstance(args[0], Clock)):
                raise TypeError(
                    "a timer needs a node: use node.timer(period, callback) in place of Timer(...)"
                )
            return super().__new__(cls)

    def __init__(
        self,
        clock: Clock,
        spawn: Spawn,
        on_error: Callable[[BaseException, str], object],
        period: float | Duration,
        callback: Callable[[Time], Any] | Callable[[Time], Awaitable[Any]],
        *,
        oneshot: bool = False,
    ) -> None:
        check_takes(callback, "the callback of a timer", "the time")
        nanoseconds = to_nanoseconds(period)
        if not nanoseconds > 0:
            raise ValueError(f"the period of a timer must be positive, got {period!r}")
        self._period = Duration.from_nsec(nanoseconds)
        self._rate = Rate(clock, nanoseconds)
        self._callback = callback
        self._oneshot = oneshot
        self._on_error = on_error
        self._task = spawn(self._run, name="timer")
        self._loop_state = loop_state()

    def cancel(self) -> None:
        """Stop calling the function, and cancel a call that is running."""
        self._loop_state.check_thread("Timer.cancel()")
        self._task.cancel()

    async def _run(self) -> None:
        async for now in self._rate:
            try:
                result = self._callback(now)
                if asyncio.iscoroutine(result) or asyncio.isfuture(result):
                    await result
            except BaseException as error:  # of the user's code
                self._on_error(error, "the callback of a timer")
            if self._oneshot or self._task.cancelling():
                return  # a callback may have caught its cancellation

    def __repr__(self) -> str:
        what = "once after" if self._oneshot else "every"
        state = "ended" if self._task.done() else "running"
        return f"<Timer {what} {self._period.to_sec():g} s, {state}>"
