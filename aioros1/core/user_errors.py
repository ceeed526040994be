"""Exceptions of the user's code, where nobody awaits it."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any

from aioros1.log.node_log import NodeLog
from aioros1.options import OnError

__all__ = ["UserErrors"]


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
            self._policy(error)
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
