"""Exceptions from the user's code where nobody awaits it."""

from __future__ import annotations

import asyncio
from asyncio import _get_running_loop
from collections.abc import Callable
from typing import Any

from aioros1.errors import ClosedError
from aioros1.log.node_log import NodeLog
from aioros1.options import OnError

__all__ = ["UserErrors", "described", "is_end", "leave_loop", "reportable"]


def reportable(error: BaseException) -> Exception | None:
    """Return the error to report for an exception from the user's code, or None to re-raise it.

    A cancellation is genuine only if somebody cancelled the task. Otherwise it comes from
    something the task awaited, and is an error like any other.
    """
    if isinstance(error, Exception):
        return error
    if isinstance(error, (SystemExit, KeyboardInterrupt)):
        return None
    # Python raises GeneratorExit where it drops a coroutine, for the event loop has ended.
    if _get_running_loop() is None:
        return None
    task = asyncio.current_task()
    if isinstance(error, asyncio.CancelledError) and task is not None and task.cancelling():
        return None
    reported = RuntimeError(f"{type(error).__name__} was raised: {described(error)}")
    reported.__cause__ = error
    return reported


def leave_loop(error: BaseException) -> None:
    """End the program with ``error``: the event loop raises it, outside of any task."""
    asyncio.get_running_loop().call_soon(_raise, error)


def _raise(error: BaseException) -> None:
    raise error


def is_end(error: BaseException) -> bool:
    """Whether the error, alone or as a group, only says that something is closed."""
    if isinstance(error, BaseExceptionGroup):
        return error.split(ClosedError)[1] is None
    return isinstance(error, ClosedError)


def described(error: BaseException) -> str:
    """The text of an exception, or its type if it has none or cannot say it."""
    try:
        return str(error) or type(error).__name__
    except Exception:
        return type(error).__name__


def _shown(error: BaseException) -> str:
    try:
        return repr(error)
    except Exception:
        return f"{type(error).__name__}(...)"


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
        self._left: asyncio.Future[None] | None = None
        self.failure: Exception | None = None
        """The exception that ended the node, if one did."""

    def handle(self, error: Exception, what: str) -> None:
        """Handle ``error``, which ``what`` raised."""
        if callable(self._policy):
            try:
                self._policy(error)
            except (SystemExit, KeyboardInterrupt) as end:
                leave_loop(end)
            except BaseException as second:  # it must not break our caller
                self._log.error("on_error failed with %s", _shown(error), exc_info=second)
        elif self._policy == "log":
            self._log.error("%s failed", what, exc_info=error)
        elif self.failure is None:
            self.failure = error
            if self._user is not None:
                self._has_cancelled_user = True
                self._user.cancel()
            self._end(f"{what} failed: {_shown(error)}")

    def handle_answered(self, error: Exception, what: str) -> None:
        """Handle ``error``, which ``what`` raised and a caller in the graph is told of.

        It does not end the node: any caller might then end it.
        """
        if callable(self._policy):
            self.handle(error, what)
        else:
            self._log.error("%s failed", what, exc_info=error)

    def enter_block(self) -> None:
        """Record that the running task entered the node's ``async with`` block."""
        self._user = asyncio.current_task()
        self._left = asyncio.get_running_loop().create_future()

    def cancelled_block(self) -> tuple[asyncio.Future[None], ...]:
        """What ends when the user leaves the block, if a failure has cancelled it."""
        if self._left is None or self._left.done() or not self._has_cancelled_user:
            return ()
        return (self._left,)

    def closing(self) -> None:
        """Record that the running task closes the node; in the block, that ends the block."""
        if self._left is not None and self._user is asyncio.current_task():
            _resolve(self._left)

    def leave_block(self) -> bool:
        """Record the end of the block; return whether only a failure cancelled it."""
        user, self._user = self._user, None
        if self._left is not None:
            _resolve(self._left)
        return self._has_cancelled_user and user is not None and user.uncancel() <= 0


def _resolve(future: asyncio.Future[None]) -> None:
    if not future.done():
        future.set_result(None)
