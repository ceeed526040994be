"""The task that owns a node: from its start to its end, and everything in between."""

from __future__ import annotations

import asyncio
import warnings
from collections.abc import Awaitable, Callable
from typing import Any, Literal, Protocol

from aioros1.errors import ClosedError

__all__ = ["Life", "State", "Supervisor"]


State = Literal["new", "starting", "open", "closing", "closed"]


class Life(Protocol):
    """What a node does when. Each part may count on the former having been called."""

    async def begin(self) -> None:
        """Come to be. The node can be used when this returns."""

    async def finish(self) -> None:
        """Tell others of the end, as far as they listen."""

    async def free(self) -> None:
        """Let go of all that is shared with others, whatever has become of it. This comes
        also after a :meth:`begin` that has failed, or was cancelled half-way."""

    def drop(self) -> None:
        """Let go of the rest, without waiting for anybody. This always comes last."""


class Supervisor:
    """Leads a node through its life, in one task, when it is told to begin and to end.

    Whoever asks for the end, and may be cancelled while waiting for it, does not do it: this
    task does. All other tasks of the node are in its task group. What goes wrong in them is
    given to ``report``.
    """

    def __init__(self, name: str, life: Life, report: Callable[[BaseException, str], None]) -> None:
        self._name = name
        self._life = life
        self._report = report
        self.state: State = "new"
        """Where the node is in its life; the steps of that set it."""
        self._group: asyncio.TaskGroup | None = None
        self._task: asyncio.Task[None] | None = None
        self._end: asyncio.Event = asyncio.Event()
        self.reason: str | None = None
        """Why the node ends; None while nothing says that it should."""

    async def start(self) -> None:
        """Return when the node has begun; raise what it raises."""
        begun = asyncio.get_running_loop().create_future()
        self._task = asyncio.create_task(self._run(begun), name=f"{self._name} supervisor")
        try:
            await asyncio.shield(begun)
        except asyncio.CancelledError:
            self.end("its start was cancelled")
            # What has begun ends as it always does: it may have told others already.
            if not begun.done():
                begun.cancel()
                self._task.cancel()
            await asyncio.wait({self._task})
            raise

    def end(self, reason: str) -> None:
        """Begin to end, for the first ``reason`` given."""
        if self.reason is None:
            self.reason = reason
            self._end.set()

    async def wait(self) -> None:
        """Wait until everything has ended."""
        if self._task is not None:
            await asyncio.wait({self._task})

    async def pause(self, seconds: float) -> None:
        """Sleep. Raises :class:`~aioros1.ClosedError` as soon as the end begins."""
        try:
            async with asyncio.timeout(seconds):
                await self._end.wait()
        except TimeoutError:
            return
        raise ClosedError(f"{self._name} is closed ({self.reason})")

    def spawn(
        self, function: Callable[..., Awaitable[Any]], *args: Any, name: str
    ) -> asyncio.Task[None]:
        """Run ``function(*args)`` in a task of the group. What it raises is reported.

        Raises :class:`~aioros1.ClosedError` once the end has come.
        """
        # The function and not a coroutine: one that is never started would be warned of.
        if self._group is None:
            raise ClosedError(f"{self._name} is closed")
        return self._group.create_task(self._guarded(function, args, name), name=name)

    async def _guarded(
        self, function: Callable[..., Awaitable[Any]], args: tuple[Any, ...], name: str
    ) -> None:
        try:
            await function(*args)
        except ClosedError:
            pass  # it was doing something with what was closed meanwhile
        except Exception as error:  # one broken task must not take the others with it
            self._report(error, name)

    async def _run(self, begun: asyncio.Future[None]) -> None:
        try:
            async with asyncio.TaskGroup() as self._group:
                try:
                    await self._life.begin()
                    if not begun.done():
                        begun.set_result(None)
                    await self._end.wait()
                    await self._life.finish()
                finally:
                    self._group = None
                    await self._life.free()
                raise _TheEndError
        except* _TheEndError:
            pass
        except* Exception as errors:
            error = errors.exceptions[0] if len(errors.exceptions) == 1 else errors
            self.end(str(error))
            if begun.done():
                self._report(error, self._name)
            else:
                begun.set_exception(error)
        finally:
            forgotten = self.reason is None
            self.end("the event loop has ended")
            self._life.drop()
            if forgotten:  # last, because a warning may be an exception
                warnings.warn(f"{self._name} was never closed", ResourceWarning, stacklevel=1)


class _TheEndError(Exception):
    """Ends the task group with all that is still in it."""
