"""Waiting for something that another part of the same loop brings about."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from contextvars import Context
from typing import Any, Self, TypeVar

__all__ = ["Waiter", "Waiters", "deadline"]

T = TypeVar("T")


class Waiter(asyncio.Future[T]):
    """A future whose one task can be run at once, and not in the next turn of the loop.

    For what comes from a socket: the loop is between two tasks, and runs the protocol of a
    connection. To schedule the task that waits, look at all sockets again and then run it
    takes a fifth of the time that a short message needs to another process and back.

    asyncio runs whatever it finds registered with :meth:`add_done_callback`, always later;
    so the one callback that a task registers is kept here, and called.
    """

    _wake_up: tuple[Callable[[Any], object], Context | None] | None = None

    def add_done_callback(
        self, fn: Callable[[Any], object], /, *, context: Context | None = None
    ) -> None:
        if self._wake_up is None and not self.done():
            self._wake_up = fn, context
        else:
            super().add_done_callback(fn, context=context)

    def remove_done_callback(self, fn: Callable[[Any], object], /) -> int:
        if self._wake_up is not None and self._wake_up[0] == fn:
            self._wake_up = None
            return 1
        return super().remove_done_callback(fn)

    def set_result(self, result: T, /) -> None:
        super().set_result(result)
        self._schedule()

    def set_exception(self, exception: type[BaseException] | BaseException, /) -> None:
        super().set_exception(exception)
        self._schedule()

    def cancel(self, msg: object = None) -> bool:
        cancelled = super().cancel(msg)
        self._schedule()
        return cancelled

    def resume(self, result: T) -> None:
        """Set the result and run the task that waits for it.

        To be called last in a callback of the loop: what the task does, it does before
        this returns. Where a task runs already, this one has to wait for the next turn.
        """
        if self._wake_up is None or asyncio.current_task(self.get_loop()) is not None:
            self.set_result(result)
            return
        super().set_result(result)
        callback, context = self._wake_up
        self._wake_up = None
        if context is None:
            callback(self)
        else:
            context.run(callback, self)

    def _schedule(self) -> None:
        if self._wake_up is not None:
            callback, context = self._wake_up
            self._wake_up = None
            self.get_loop().call_soon(callback, self, context=context)


class Waiters:
    """Tasks that wait for a state to change.

    Unlike a condition it has no lock, because in one loop nothing changes between two
    awaits; unlike an event it needs no resetting.
    """

    __slots__ = ("_error", "_loop", "_waiters")

    def __init__(self) -> None:
        self._loop: asyncio.AbstractEventLoop | None = None  # asked for once: it takes a while
        self._waiters: set[Waiter[None]] = set()
        self._error: BaseException | None = None

    def wake(self) -> None:
        """Let all who wait look again."""
        waiters = self._waiters
        if waiters:
            for waiter in waiters:  # none of them runs now, and changes the set
                if not waiter.done():
                    waiter.set_result(None)
            waiters.clear()

    def resume(self) -> None:
        """The same at once, see :meth:`Waiter.resume`."""
        waiters = self._waiters
        if waiters:
            self._waiters = set()  # who is resumed may be back before the others were
            for waiter in waiters:
                if not waiter.done():
                    waiter.resume(None)

    def fail(self, error: BaseException) -> None:
        """Everyone who waits, now or later, gets ``error``."""
        self._error = error
        self.wake()

    def check(self) -> None:
        """Raise what :meth:`fail` was given, if it was."""
        if self._error is not None:
            raise self._error

    async def wait(self, seconds: float | None = None) -> None:
        """Wait for the next :meth:`wake`, at most for ``seconds``. Raises what :meth:`fail`
        was given."""
        if self._error is None:
            if self._loop is None:
                self._loop = asyncio.get_running_loop()
            waiter: Waiter[None] = Waiter(loop=self._loop)
            self._waiters.add(waiter)
            # No asyncio.timeout(), which cancels the task and takes that back: 5 µs.
            timer = None if seconds is None else self._loop.call_later(seconds, _end, waiter)
            try:
                await waiter
            finally:
                self._waiters.discard(waiter)
                if timer is not None:
                    timer.cancel()
        if self._error is not None:
            raise self._error

    async def wait_until(
        self, predicate: Callable[[], bool], *, timeout: float | None, what: str
    ) -> None:
        """Wait until ``predicate()`` holds, looking again after each :meth:`wake`.

        Raises :class:`TimeoutError` saying ``what`` did not happen.
        """
        if predicate():
            return
        async with deadline(timeout, what):
            while not predicate():
                await self.wait()


def _end(waiter: Waiter[None]) -> None:
    if not waiter.done():
        waiter.resume(None)


class deadline:  # noqa: N801 - it is used as asyncio.timeout is
    """:func:`asyncio.timeout` whose error says what took too long.

    A timeout that is not ours, of a caller further up, passes unchanged.
    """

    __slots__ = ("_seconds", "_timeout", "_what")

    def __init__(self, seconds: float | None, what: str) -> None:
        self._seconds = seconds
        self._what = what

    async def __aenter__(self) -> Self:
        self._timeout = asyncio.timeout(self._seconds)
        await self._timeout.__aenter__()
        return self

    def expire(self) -> None:
        """End the block now, as if the time was over."""
        self._timeout.reschedule(asyncio.get_running_loop().time())

    async def __aexit__(self, *exc_info: object) -> None:
        try:
            await self._timeout.__aexit__(*exc_info)  # type: ignore[arg-type]
        except TimeoutError:
            raise TimeoutError(f"{self._what} within {self._seconds} s") from None
