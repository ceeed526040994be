"""Waiting for something that another part of the same loop brings about."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Self

__all__ = ["Waiters", "deadline"]


class Waiters:
    """Tasks that wait for a state to change.

    Unlike a condition it has no lock, because in one loop nothing changes between two
    awaits; unlike an event it needs no resetting.
    """

    __slots__ = ("_error", "_futures")

    def __init__(self) -> None:
        self._futures: set[asyncio.Future[None]] = set()
        self._error: BaseException | None = None

    def __bool__(self) -> bool:
        return bool(self._futures)

    def wake(self) -> None:
        """Let all who wait look again."""
        futures, self._futures = self._futures, set()
        for future in futures:
            if not future.done():
                future.set_result(None)

    def fail(self, error: BaseException) -> None:
        """Everyone who waits, now or later, gets ``error``."""
        self._error = error
        self.wake()

    def check(self) -> None:
        """Raise what :meth:`fail` was given, if it was."""
        if self._error is not None:
            raise self._error

    async def wait(self) -> None:
        """Wait for the next :meth:`wake`. Raises what :meth:`fail` was given."""
        if self._error is None:
            future = asyncio.get_running_loop().create_future()
            self._futures.add(future)
            try:
                await future
            finally:
                self._futures.discard(future)
        self.check()

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
