"""Exceptions from the user's code where nobody awaits it."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any

from aioros1.errors import ClosedError
from aioros1.log.node_log import NodeLog
from aioros1.options import OnError

__all__ = ["UserErrors", "is_end", "reportable"]


def reportable(error: BaseException) -> Exception | None:
    """Return the error to report for an exception from the user's code, or None to re-raise it.

    A cancellation is genuine only if somebody cancelled the task. Otherwise it comes from
    something the task awaited, and is an error like any other.
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
    """Whether the error, alone or as a group, only says that something is closed."""
    if isinstance(error, ExceptionGroup):
        return error.split(ClosedError)[1] is None
    return isinstance(error, ClosedError)


class UserErrors:
    """Handles exceptions from the user's code as the node's ``on_error`` says.

    ``"raise"`` ends the node, cancels the task in its ``async with`` block, and raises the
    exception there in place of the cancellation, as :class:`asyncio.TaskGroup` does.
    """

    def __init__(self, policy: OnError, log: NodeLog, end: Callable[[str], None]) -> None:
        self._policy = policy
        self._log = log
        self._end = end
        self._user: asyncio.Task[Any] | None = None
        self._has_cancelled_user = False
        self.failure: Exception | None = None
        """The exception that ended the node, if one did."""

    def handle(self, error: Exception, what: str) -> None:
        """Handle ``error``, which ``what`` raised."""
        if callable(self._policy):
            try:
                self._policy(error)
            except Exception as second:  # it must not break our caller
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
        """Record that the running task entered the node's ``async with`` block."""
        self._user = asyncio.current_task()

    def leave_block(self) -> bool:
        """Record the end of the block; return whether only a failure cancelled it."""
        user, self._user = self._user, None
        return self._has_cancelled_user and user is not None and user.uncancel() <= 0
