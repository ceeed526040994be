"""Waiting within one event loop: for a change, with a deadline, or for a lock."""

from __future__ import annotations

import asyncio
from asyncio import _get_running_loop
from collections import deque
from collections.abc import Callable
from typing import Self

__all__ = ["Deadlines", "Mutex", "Obstacle", "Waiters", "deadline"]

_LOOK = 0.001
"""Seconds that a block gets at least when its time is over, for what has arrived already."""

_TURNS = 10
"""Iterations of the event loop in which what has arrived reaches the task that waits for it."""


class Waiters:
    """Tasks that wait for a state to change.

    Unlike a condition it has no lock, because in one event loop nothing changes between two
    awaits; unlike an event it needs no reset.
    """

    __slots__ = ("_error", "_futures", "_loop")

    def __init__(self) -> None:
        # Looked up once, because that is slow. Waiting in another loop raises an error.
        self._loop = _get_running_loop()
        self._futures: set[asyncio.Future[None]] = set()
        self._error: BaseException | None = None

    def wake(self) -> None:
        """Let all waiting tasks check again."""
        futures = self._futures
        if futures:
            for future in futures:  # nothing else runs now that could change the set
                _resolve(future)
            futures.clear()

    def fail(self, error: BaseException) -> None:
        """Raise ``error`` in every task that waits, now or later."""
        self._error = error
        self.wake()

    def check(self) -> None:
        """Raise the error given to :meth:`fail`, if there was one."""
        if self._error is not None:
            raise self._error

    async def wait(self, seconds: float | None = None) -> None:
        """Wait for the next :meth:`wake`, at most for ``seconds``. Raises the error given to
        :meth:`fail`."""
        if self._error is None:
            if self._loop is None:
                self._loop = asyncio.get_running_loop()
            future = self._loop.create_future()
            self._futures.add(future)
            # Not asyncio.timeout(), which cancels the task and takes that back: 5 µs.
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
        """Wait until ``predicate()`` is true, checking again after each :meth:`wake`.

        Raises :class:`TimeoutError` saying ``what`` did not happen.
        """
        if predicate():
            return
        async with deadline(timeout, what):
            while not predicate():
                await self.wait()


def _resolve(future: asyncio.Future[None]) -> None:
    if not future.done():
        future.set_result(None)


class deadline:  # noqa: N801 - it is used like asyncio.timeout
    """A time limit for a block, whose error says what took too long.

    ``async with deadline(seconds, "what"):`` cancels the block after ``seconds`` (``None``
    sets no limit) and raises :class:`TimeoutError`: "what within N s". A cancellation from
    elsewhere, and a timeout of a caller further up, pass unchanged.

    Time in which the event loop is blocked does not count, up to ``seconds``. What arrives
    meanwhile waits in the sockets, and the loop looks at its timers before it has read all of
    it.

    It does not wrap :func:`asyncio.timeout`, because that doubles a cost that every request
    pays.
    """

    __slots__ = (
        "_cancelling",
        "_has_expired",
        "_owner",
        "_seconds",
        "_task",
        "_timer",
        "_turns",
        "_what",
        "_when",
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
        """The obstacle so far, for the text of the error."""

    async def __aenter__(self) -> Self:
        self._task = task = asyncio.current_task()
        if task is None:
            raise RuntimeError("a deadline can only be used inside a task")
        self._cancelling = task.cancelling()
        seconds = self._seconds
        if seconds is not None:
            loop = task.get_loop()
            if seconds > 0:
                self._when = loop.time() + seconds
                self._timer = loop.call_at(self._when, self._time_is_over)
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
            # More cancellations than before the block: something else wants the task to end.
            and task.uncancel() <= self._cancelling
            and exc_type is not None
            and issubclass(exc_type, asyncio.CancelledError)
        ):
            within = "" if self._seconds is None else f" within {self._seconds:g} s"
            why = f": {self.why}" if self.why else ""
            raise TimeoutError(f"{self._what}{within}{why}") from None

    def expire(self) -> None:
        """End the block now, as if its time was over. Does nothing once it has ended."""
        if self._task is not None and not self._has_expired:
            if self._timer is not None:
                self._timer.cancel()
            # Not at once: a task that cancels itself would notice only after the block.
            self._timer = self._task.get_loop().call_soon(self._cancel)

    def _time_is_over(self) -> None:
        """Prolong the block by the time in which the loop was blocked, and a little."""
        if self._task is not None:
            assert self._seconds is not None
            loop = self._task.get_loop()
            late = min(loop.time() - self._when, self._seconds)
            self._turns = _TURNS
            self._timer = loop.call_later(max(late, _LOOK), self._look)

    def _look(self) -> None:
        """Let the loop pass on what it has read, from one callback to the next."""
        if self._task is not None:
            if not self._turns:
                self._cancel()
                return
            self._turns -= 1
            self._timer = self._task.get_loop().call_soon(self._look)

    def _cancel(self) -> None:
        if self._task is not None:
            self._has_expired = True
            self._task.cancel()


class Obstacle:
    """What is in the way, for :attr:`deadline.why`. Its text is made when it is asked for."""

    def __init__(self, what: Callable[[], str]) -> None:
        self._what = what

    def __str__(self) -> str:
        return self._what()

    def __bool__(self) -> bool:
        return bool(str(self))


class Deadlines:
    """The running deadlines of one object, so that closing it can end them all.

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
        """End every running block, as if its time was over."""
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
    """A lock for the tasks of one event loop: first come, first served.

    Unlike :class:`asyncio.Lock`, a plain function can take it without waiting, for the cost
    of an attribute access. Only tasks that wait need an event loop.
    """

    __slots__ = ("_waiters", "is_held")

    def __init__(self) -> None:
        self.is_held = False
        """Whether the lock is held. While it is False nobody waits either, and setting it to
        True takes the lock without a call."""
        # Each future is resolved when its task gets the lock. While any task waits the lock
        # is held: it is handed over, and never free in between.
        self._waiters: deque[asyncio.Future[None]] = deque()

    async def acquire(self) -> None:
        """Take the lock, as soon as all who came earlier have released it."""
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
            elif not future.cancelled():  # handed over just as the task was cancelled
                self.release()
            raise

    def release(self) -> None:
        """Give the lock to the task that has waited longest.

        Raises :class:`RuntimeError` when the lock is not held.
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
