"""The time in which the user's code ends, between a node's last reason to live and its closing.

Whoever ends a node, the code that uses it may have something to put in order: a robot to stop,
a goal to take back. It needs the roles of the node for that. So the node first lets that code
end, and closes its roles afterwards.
"""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from typing import Any

from aioros1.core.awaited import Awaited
from aioros1.core.context import Context
from aioros1.core.user_errors import UserErrors
from aioros1.core.user_tasks import UserTasks
from aioros1.errors import ClosedError

__all__ = ["WindingDown"]

_LAST = 0.1
"""Seconds that a callback has to clean up when it is cancelled because its time is over."""


class WindingDown:
    """Ends the user's code: first its tasks and block, then the callbacks of ``on_shutdown``,
    then what handlers and callbacks of roles are in the middle of."""

    def __init__(
        self,
        context: Context,
        tasks: UserTasks,
        errors: UserErrors,
        end_calls: Callable[[], Awaitable[None]],
    ) -> None:
        self._context = context
        self._tasks = tasks
        self._errors = errors
        self._end_calls = end_calls
        self._callbacks: list[Callable[[], object]] = []
        self._has_called = False
        self._limit: asyncio.Timeout | None = None
        self._seconds: float | None = None
        """How long each step may take; None for what :meth:`run` was given."""

    def add(self, callback: Callable[[], object]) -> None:
        """Call ``callback`` before the roles of the node are closed."""
        if not callable(callback):
            raise TypeError(f"on_shutdown takes a function, got {callback!r}")
        if self._has_called:
            raise ClosedError(f"node {self._context.name} is closing: it calls nothing more")
        self._callbacks.append(callback)

    def begin(self) -> None:
        """Cancel the tasks at once, so that they do nothing more behind the back of others
        that clean up."""
        self._tasks.cancel("told")

    def limit(self, seconds: float) -> None:
        """Let each step take ``seconds`` at most, the running one included."""
        self._seconds = seconds
        if self._limit is not None and not self._limit.expired():
            self._limit.reschedule(asyncio.get_running_loop().time() + seconds)

    async def run(self, seconds: float) -> None:
        """Let everything end. Each step takes ``seconds`` at most."""
        if self._seconds is not None:
            seconds = self._seconds
        if not await self._wait(self._end_tasks(), seconds):
            names = ", ".join(task.get_name() for task in self._tasks.running("told"))
            self._log_late(names or "the block of the node")
        self._has_called = True
        await self._call_all(seconds)
        if not await self._wait(self._end_roles(), seconds):
            self._log_late("a service handler or callback")

    async def _wait(self, step: Awaitable[None], seconds: float) -> bool:
        """Return whether ``step`` ends within ``seconds``."""
        try:
            async with asyncio.timeout(self._left(seconds)) as self._limit:
                await step
        except TimeoutError:
            return False
        else:
            return True
        finally:
            self._limit = None

    def _log_late(self, what: str) -> None:
        self._context.log.warning("closing, although this has not ended in time: %s", what)

    def _left(self, seconds: float) -> float:
        return seconds if self._seconds is None else min(seconds, self._seconds)

    async def _end_tasks(self) -> None:
        # Again, because a task may start another one to clean up.
        while waited := [*self._tasks.running("told"), *self._errors.cancelled_block()]:
            self._tasks.cancel("told")
            await asyncio.wait(waited)

    async def _end_roles(self) -> None:
        """Let handlers return, and cancel callbacks of topics."""
        await self._end_calls()
        self._tasks.cancel("closing")
        if waited := self._tasks.running("closing"):
            await asyncio.wait(waited)

    async def _call_all(self, seconds: float) -> None:
        loop = asyncio.get_running_loop()
        end = loop.time() + self._left(seconds)
        while self._callbacks and self._context.is_open:  # unless it is aborted
            # A task for each: one that does not end must not keep the next one from its turn.
            callback = self._callbacks.pop()
            task = self._tasks.spawn(
                self._call, callback, name="callback of on_shutdown", until="closed"
            )
            if not await self._wait(_end_of(task), max(0.0, end - loop.time())):
                self._log_late(f"{callback!r} of on_shutdown")
                task.cancel()
                await asyncio.wait((task,), timeout=_LAST)

    async def _call(self, callback: Callable[[], object]) -> None:
        code = Awaited(self._context.node, is_awaited=True)
        code.enter()
        try:
            result: Any = callback()
            if isinstance(result, Awaitable):
                await result
        except BaseException as error:
            self._context.user_error(error, f"{callback!r} of on_shutdown")
        finally:
            code.leave()


async def _end_of(task: asyncio.Task[None]) -> None:
    await asyncio.wait((task,))
