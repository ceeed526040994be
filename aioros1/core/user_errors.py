"""Exceptions of the user's code, where nobody awaits it."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any

from aioros1.errors import ClosedError
from aioros1.log.node_log import NodeLog
from aioros1.options import OnError

__all__ = ["UserErrors", "is_end", "reportable"]


def reportable(error: BaseException) -> Exception | None:
    """What to report of an exception of the user's code; None if it is to be raised on.

    A cancellation is the task's own only if somebody has cancelled that; otherwise it comes
    out of something that was awaited, and is an error like others.
    """
    if isinstance(error, Exception):
        return error
    if isinstance(error, (SystemExit, KeyboardInterrupt, GeneratorExit)):
        return None
    task = asyncio.current_task()
    if isinstance(error, asyncio.CancelledError) and task is not None and task.cancelling():
        return None
    reported = RuntimeError(f"{type(error).__name__} was raised: {error}")
    reported.__cause__ = error
    return reported


def is_end(error: Exception) -> bool:
    """Whether it says only that something is closed, alone or in a group."""
    if isinstance(error, ExceptionGroup):
        return error.split(ClosedError)[1] is None
    return isinstance(error, ClosedError)


class UserErrors:
    """Does with them what ``on_error`` of the node says.

    ``"raise"`` ends the node, cancels whoever is in its ``async with`` block, and raises the
    exception there in place of the cancellation, as :class:`asyncio.TaskGroup` does.
    """

    def __init__(self, policy: OnError, log: NodeLog, end: Callable[[str], None]) -> None:
        self._policy = policy
        self._log = log
        self._end = end
        self._user: asyncio.Task[Any] | None = None
        self._has_cancelled_user = False
        self.failure: Exception | None = None
        """What has ended the node, if an exception did."""

    def handle(self, error: Exception, what: str) -> None:
        """Treat ``error``, which ``what`` has raised."""
        if callable(self._policy):
            try:
                self._policy(error)
            except Exception as second:  # it must not end what called us
                self._log.error("on_error failed with %r", error, exc_info=second)
        elif self._policy == "log":
            self._log.error("%s failed", what, exc_info=error)
        elif self.failure is None:
            self.failure = error
            self._end(f"{what} failed: {error!r}")
            if self._user is not None:
                self._has_cancelled_user = True
                self._user.cancel()

    def enter_block(self) -> None:
        """The running task is in the ``async with`` block of the node."""
        self._user = asyncio.current_task()

    def leave_block(self) -> bool:
        """The block has ended. Whether it was cancelled for a failure and by nobody else."""
        user, self._user = self._user, None
        return self._has_cancelled_user and user is not None and user.uncancel() <= 0
