"""Tasks that run the user's code: timers, callbacks, and what ``create_task`` was given.

They are not in the task group of their node. A task group waits for ever for a task that
ignores its cancellation, and a ``SystemExit`` in one of its tasks ends all others.
"""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import Awaitable, Callable
from typing import Any, Literal

from aioros1.core.awaited import Awaited
from aioros1.errors import ClosedError

__all__ = ["Stage", "UserTasks"]

_LAST = 1.0
"""Seconds that tasks have to end when they are cancelled after everything is closed."""

Guard = Callable[[Callable[..., Awaitable[Any]], tuple[Any, ...], str], Awaitable[None]]

Stage = Literal["told", "closing", "closed"]
"""When the tasks are cancelled: as soon as the node is told to end, right before its roles are
closed, or afterwards, unless an owner has done it."""


class UserTasks:
    """The tasks of one node that run the user's code.

    ``guard`` calls a function and reports its exceptions; ``owner`` is the node, as for
    :func:`.awaits_caller`.
    """

    def __init__(self, name: str, guard: Guard, owner: object) -> None:
        self._name = name
        self._guard = guard
        self._owner = owner
        self._tasks: dict[asyncio.Task[None], tuple[Stage, Awaited]] = {}
        self._cancelled: set[asyncio.Task[None]] = set()
        self._closers: set[asyncio.Task[None]] = set()
        self._is_closed = False

    def spawn(
        self,
        function: Callable[..., Awaitable[Any]],
        *args: Any,
        name: str,
        until: Stage = "told",
    ) -> asyncio.Task[None]:
        """Run ``function(*args)`` in a task. Raises :class:`~aioros1.ClosedError` once the
        node is closed."""
        if self._is_closed:
            raise ClosedError(f"{self._name} is closed")
        code = Awaited(self._owner, is_awaited=False)
        task = asyncio.create_task(self._run(code, function, args, name), name=name)
        self._tasks[task] = until, code
        task.add_done_callback(self._ended)
        return task

    async def _run(
        self,
        code: Awaited,
        function: Callable[..., Awaitable[Any]],
        args: tuple[Any, ...],
        name: str,
    ) -> None:
        code.enter()
        try:
            await self._guard(function, args, name)
        finally:
            code.leave()

    def _ended(self, task: asyncio.Task[None]) -> None:
        del self._tasks[task]
        self._cancelled.discard(task)
        self._closers.discard(task)

    def exempt_caller(self) -> None:
        """Leave the running task alone: it closes the node itself, and waits for that."""
        task = asyncio.current_task()
        if task in self._tasks:
            self._closers.add(task)

    def cancel(self, until: Stage) -> None:
        """Cancel the tasks of a stage once, but not the running one, which may be about to
        end."""
        current = asyncio.current_task()
        for task in self.running(until):
            self._tasks[task][1].is_awaited = True
            if task is not current and task not in self._cancelled:
                self._cancelled.add(task)
                task.cancel()

    def running(self, until: Stage) -> list[asyncio.Task[None]]:
        """The tasks of a stage whose end the node waits for."""
        tasks = self._tasks.items()
        return [task for task, (when, _) in tasks if when == until and task not in self._closers]

    async def end(self) -> list[str]:
        """Cancel all tasks once more. Return the names of those that do not end."""
        self.cancel_all()
        left = self._tasks.keys() - self._closers
        if left:
            _, left = await asyncio.wait(left, timeout=_LAST)
        return sorted(task.get_name() for task in left)

    def cancel_all(self) -> None:
        """Cancel all tasks, without waiting for their end, and take no more of them."""
        self._is_closed = True
        current = None
        with contextlib.suppress(RuntimeError):  # the event loop may have ended
            current = asyncio.current_task()
        for task in self._tasks.keys() - self._closers - {current}:
            task.cancel()
