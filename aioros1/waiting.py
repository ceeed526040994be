"""Waiting, within one event loop: for a change, for a limited time, for one's turn."""

from __future__ import annotations

import asyncio
from asyncio import _get_running_loop
from collections import deque
from collections.abc import Callable, Sequence
from typing import Self

__all__ = ["Deadlines", "Mutex", "Waiters", "deadline", "wait_for_any"]


class Waiters:
    """Tasks that wait for a state to change.

    Unlike a condition it has no lock, because in one loop nothing changes between two
    awaits; unlike an event it needs no resetting.
    """

    __slots__ = ("_error", "_futures", "_loop")

    def __init__(self) -> None:
        # Asked for once, as it takes a while. Who waits in another loop gets an error.
        self._loop = _get_running_loop()
        self._futures: set[asyncio.Future[None]] = set()
        self._error: BaseException | None = None

    def wake(self) -> None:
        """Let all who wait look again."""
        futures = self._futures
        if futures:
            for future in futures:  # nobody runs now, and changes the set
                _resolve(future)
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
            timer = None if seconds is None else self._loop.call_later(seconds, _resolve, future)
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


def _resolve(future: asyncio.Future[None]) -> None:
    if not future.done():
        future.set_result(None)


class deadline:  # noqa: N801 - it is used as asyncio.timeout is
    """A limit of time for a block, whose error says what took too long.

    ``async with deadline(seconds, "what"):`` cancels the block after ``seconds`` (``None``
    sets no limit) and raises :class:`TimeoutError`: "what within N s". A cancellation from
    elsewhere, and a timeout of a caller further up, pass unchanged.

    Written without :func:`asyncio.timeout`, because a wrapper of that doubles the cost of
    something that each request pays for.
    """

    __slots__ = (
        "_cancelling",
        "_has_expired",
        "_owner",
        "_seconds",
        "_task",
        "_timer",
        "_what",
        "why",
    )

    def __init__(
        self, seconds: float | None, what: str, _owner: Deadlines | None = None, /
    ) -> None:
        self._seconds = seconds
        self._what = what
        self._owner = _owner
        self._task: asyncio.Task[object] | None = None  # while the block runs
        self._timer: asyncio.Handle | None = None
        self._has_expired = False
        self.why: object = ""
        """What has been in the way so far, for the text of the error."""

    async def __aenter__(self) -> Self:
        self._task = task = asyncio.current_task()
        if task is None:
            raise RuntimeError("a deadline can only be used inside a task")
        self._cancelling = task.cancelling()
        seconds = self._seconds
        if seconds is not None:
            loop = task.get_loop()
            if seconds > 0:
                self._timer = loop.call_at(loop.time() + seconds, self._cancel)
            else:
                self._timer = loop.call_soon(self._cancel)
        if self._owner is not None:
            self._owner._running.add(self)
        return self

    async def __aexit__(self, exc_type: type[BaseException] | None, *exc_info: object) -> None:
        task, self._task = self._task, None
        assert task is not None
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
        if self._owner is not None:
            self._owner._ended(self)
        if (
            self._has_expired
            # More cancellations than before the block: somebody else wants the task to end.
            and task.uncancel() <= self._cancelling
            and exc_type is not None
            and issubclass(exc_type, asyncio.CancelledError)
        ):
            within = "" if self._seconds is None else f" within {self._seconds:g} s"
            why = f": {self.why}" if self.why else ""
            raise TimeoutError(f"{self._what}{within}{why}") from None

    def expire(self) -> None:
        """End the block now, as if the time was over. Once it has ended this does nothing."""
        if self._task is not None and not self._has_expired:
            if self._timer is not None:
                self._timer.cancel()
            # Not at once: a task that cancels itself would learn of it after the block.
            self._timer = self._task.get_loop().call_soon(self._cancel)

    def _cancel(self) -> None:
        if self._task is not None:
            self._has_expired = True
            self._task.cancel()


class Deadlines:
    """The deadlines of one object that run now, so that its end can end them all.

    ::

        async with self._limits.limit(seconds, "no answer"):
            ...

        self._limits.expire()  # when the object is closed
    """

    __slots__ = ("_none_left", "_running")

    def __init__(self) -> None:
        self._running: set[deadline] = set()
        self._none_left: Waiters | None = None

    def limit(self, seconds: float | None, what: str) -> deadline:
        """A :class:`deadline` that :meth:`expire` ends as well."""
        return deadline(seconds, what, self)

    def expire(self) -> None:
        """End every block that runs now, as if its time was over."""
        for limit in self._running:
            limit.expire()

    async def wait_ended(self) -> None:
        """Wait until no block is running."""
        if self._none_left is None:
            self._none_left = Waiters()
        while self._running:
            await self._none_left.wait()

    def _ended(self, limit: deadline) -> None:
        self._running.discard(limit)
        if self._none_left is not None and not self._running:
            self._none_left.wake()


class Mutex:
    """A lock for the tasks of one event loop: whoever came first gets it first.

    Unlike :class:`asyncio.Lock` it can be taken without waiting, in a plain function, for as
    much as it costs to look at an attribute. Only tasks that wait need an event loop.
    """

    __slots__ = ("_waiters", "is_held")

    def __init__(self) -> None:
        self.is_held = False
        """Whether somebody has the lock. While it is False nobody waits either, and setting it
        to True takes the lock, without a call."""
        # Each is resolved when the lock is its own. While anyone waits the lock is held: it
        # is handed over, and never free in between.
        self._waiters: deque[asyncio.Future[None]] = deque()

    async def acquire(self) -> None:
        """Take the lock, as soon as all who came before have released it."""
        if not self.is_held:
            self.is_held = True
            return
        future = asyncio.get_running_loop().create_future()
        self._waiters.append(future)
        try:
            await future
        except BaseException:
            if future in self._waiters:
                self._waiters.remove(future)
            elif not future.cancelled():  # handed over in the moment of the cancellation
                self.release()
            raise

    def release(self) -> None:
        """Give the lock to whoever has waited longest.

        Raises :class:`RuntimeError` when nobody has it.
        """
        if not self.is_held:
            raise RuntimeError("released a mutex that nobody holds")
        waiters = self._waiters
        while waiters:
            future = waiters.popleft()
            if not future.done():  # or else its task was cancelled
                future.set_result(None)
                return
        self.is_held = False

    async def __aenter__(self) -> None:
        await self.acquire()

    async def __aexit__(self, *exc_info: object) -> None:
        self.release()
