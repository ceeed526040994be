"""The task that owns a node from its start to its end."""

from __future__ import annotations

import asyncio
import warnings
from collections.abc import Awaitable, Callable
from typing import Any, Literal, Protocol

from aioros1.core.user_errors import described, leave_loop, reportable
from aioros1.errors import ClosedError

__all__ = ["Life", "State", "Supervisor"]


State = Literal["new", "starting", "open", "closing", "closed"]


class Life(Protocol):
    """The steps of a node's life. Each step may rely on the previous one having been called."""

    async def begin(self) -> None:
        """Start. The node is usable when this returns."""

    async def wind_down(self) -> None:
        """Let the user's code end, while everything can still be used."""

    async def finish(self) -> None:
        """Tell others that the node ends, as far as they respond."""

    async def free(self) -> None:
        """Release everything shared with others, in whatever state it is. This is also called
        after a :meth:`begin` that failed or was cancelled halfway."""

    def drop(self) -> None:
        """Release the rest without waiting. This is always called last."""


class Supervisor:
    """Runs the steps of a node's life in one task, which starts and ends on request.

    Callers who request the end may be cancelled while they wait, so this task does the work.
    All other tasks of the node are in its task group. It passes their errors to ``report``.
    """

    def __init__(self, name: str, life: Life, report: Callable[[BaseException, str], None]) -> None:
        self._name = name
        self._life = life
        self._report = report
        self.state: State = "new"
        """The state of the node, which the steps of its life set."""
        self._group: asyncio.TaskGroup | None = None
        self._loop: asyncio.AbstractEventLoop | None = None
        self._task: asyncio.Task[None] | None = None
        self._end: asyncio.Event = asyncio.Event()
        self._is_closing: asyncio.Event = asyncio.Event()
        self.reason: str | None = None
        """Why the node ends; None until something ends it."""

    async def start(self) -> None:
        """Return when the node has started; raise what that raises."""
        self._loop = asyncio.get_running_loop()
        begun = self._loop.create_future()
        self._task = asyncio.create_task(self._run(begun), name=f"{self._name} supervisor")
        try:
            await asyncio.shield(begun)
        except asyncio.CancelledError:
            self.end("its start was cancelled")
            # Run the usual end of a started node: it may have told others already.
            if not begun.done():
                begun.cancel()
                self._task.cancel()
            await asyncio.wait({self._task})
            raise

    def end(self, reason: str) -> None:
        """Start to end the node. Only the first ``reason`` counts."""
        if self.reason is None:
            self.reason = reason
            self._end.set()

    async def wait(self) -> None:
        """Wait until everything has ended."""
        if self._task is not None:
            await asyncio.wait({self._task})

    async def pause(self, seconds: float) -> None:
        """Sleep. Raises :class:`~aioros1.ClosedError` as soon as the node is closing."""
        try:
            async with asyncio.timeout(seconds):
                await self._is_closing.wait()
        except TimeoutError:
            return
        raise ClosedError(f"{self._name} is closed ({self.reason})")

    def spawn(
        self, function: Callable[..., Awaitable[Any]], *args: Any, name: str
    ) -> asyncio.Task[None]:
        """Run ``function(*args)`` in a task of the group. Its exceptions are reported.

        Raises :class:`~aioros1.ClosedError` once the node has ended.
        """
        # Takes a function: Python would warn of a coroutine that is never started.
        if self._group is None:
            raise ClosedError(f"{self._name} is closed")
        return self._group.create_task(self.guard(function, args, name), name=name)

    async def guard(
        self, function: Callable[..., Awaitable[Any]], args: tuple[Any, ...], name: str
    ) -> None:
        """Await ``function(*args)``, and report its exceptions: one broken task must not stop
        the others, nor end without a word.

        Only a cancellation of the task passes. The end of the program goes to the event loop
        itself: in a task it would cancel all others of the group.
        """
        try:
            await function(*args)
        except ClosedError:
            pass  # it used something that closed meanwhile
        except BaseException as error:
            if self._is_forgotten:
                if isinstance(error, GeneratorExit):
                    raise
                return  # it could not clean up
            if isinstance(error, (SystemExit, KeyboardInterrupt)):
                leave_loop(error)
                return
            reported = reportable(error)
            if reported is None:
                raise
            self._report(reported, name)

    @property
    def _is_forgotten(self) -> bool:
        """Whether the event loop was closed, and Python drops the tasks. Nothing can be awaited
        or scheduled then."""
        return self._loop is not None and self._loop.is_closed()

    async def _run(self, begun: asyncio.Future[None]) -> None:
        try:
            async with asyncio.TaskGroup() as self._group:
                try:
                    await self._life.begin()
                    if not begun.done():
                        begun.set_result(None)
                    await self._end.wait()
                    await self._life.wind_down()
                    self._is_closing.set()
                    await self._life.finish()
                finally:
                    self._group = None
                    if not self._is_forgotten:
                        self._is_closing.set()
                        await self._life.free()
                raise _TheEndError
        except* _TheEndError:
            pass
        except* Exception as errors:
            error = errors.exceptions[0] if len(errors.exceptions) == 1 else errors
            if self._is_forgotten:
                pass  # the task group could not cancel its tasks
            elif begun.done():
                self.end(described(error))
                self._report(error, self._name)
            else:
                self.end(described(error))
                begun.set_exception(error)
        finally:
            was_closed = self.reason is not None
            if not was_closed:
                self.reason = "the event loop has ended"
            self._life.drop()
            if not was_closed:  # last, because a warning may be an exception
                warnings.warn(f"{self._name} was never closed", ResourceWarning, stacklevel=1)


class _TheEndError(Exception):
    """Ends the task group and every task still in it."""
