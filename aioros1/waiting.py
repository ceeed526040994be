"""Waiting for something that another part of the same loop brings about."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Sequence
from typing import Self

__all__ = ["Waiters", "deadline", "wait_for_any"]


class Waiters:
    """Tasks that wait for a state to change.

    Unlike a condition it has no lock, because in one loop nothing changes between two
    awaits; unlike an event it needs no resetting.
    """

    __slots__ = ("_error", "_futures", "_loop")

    def __init__(self) -> None:
        self._loop: asyncio.AbstractEventLoop | None = None  # asked for once: it takes a while
        self._futures: set[asyncio.Future[None]] = set()
        self._error: BaseException | None = None

    def wake(self) -> None:
        """Let all who wait look again."""
        futures = self._futures
        if futures:
            for future in futures:  # nobody runs now, and changes the set
                _end(future)
            futures.clear()

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
            future = self._loop.create_future()
            self._futures.add(future)
            # No asyncio.timeout(), which cancels the task and takes that back: 5 µs.
            timer = None if seconds is None else self._loop.call_later(seconds, _end, future)
            try:
                await future
            finally:
                self._futures.discard(future)
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


async def wait_for_any(waiters: Sequence[Waiters]) -> None:
    """Wait for the next :meth:`Waiters.wake` of any of them."""
    future = asyncio.get_running_loop().create_future()
    for each in waiters:
        each._futures.add(future)
    try:
        await future
    finally:
        for each in waiters:
            each._futures.discard(future)


def _end(future: asyncio.Future[None]) -> None:
    if not future.done():
        future.set_result(None)


class deadline:  # noqa: N801 - it is used as asyncio.timeout is
    """:func:`asyncio.timeout` whose error says what took too long.

    A timeout that is not ours, of a caller further up, passes unchanged.
    """

    __slots__ = ("_seconds", "_timeout", "_what", "why")

    def __init__(self, seconds: float | None, what: str) -> None:
        self._seconds = seconds
        self._what = what
        self.why: object = ""
        """What has been in the way so far, for the text of the error."""

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
            why = f": {self.why}" if self.why else ""
            raise TimeoutError(f"{self._what} within {self._seconds} s{why}") from None
