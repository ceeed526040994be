"""What a node does while no master answers."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from typing import TypeVar

from aioros1.errors import MasterUnreachable
from aioros1.log.library_log import LibraryLog
from aioros1.net.backoff import Backoff
from aioros1.options import WithoutMaster
from aioros1.waiting import Obstacle
from aioros1.xmlrpc.master_proxy import port_advice

__all__ = ["Contact"]

T = TypeVar("T")

_FIRST, _LONGEST = 0.05, 1.0
"""Seconds between two attempts to reach a master: at first, and after a while."""

_ADVICE = "start one with `aioros1 master`, or set ROS_MASTER_URI to the one you have"


class Contact:
    """Applies the option ``without_master`` to what users ask for.

    The parts of a node that open roles for themselves do not use it: they try again on their
    own. ``pause`` sleeps, and raises :class:`~aioros1.ClosedError` when the node closes.
    """

    def __init__(
        self,
        policy: WithoutMaster,
        master_uri: str,
        log: LibraryLog,
        pause: Callable[[float], Awaitable[None]],
    ) -> None:
        self.policy: WithoutMaster = policy
        """The option ``without_master``."""
        self._master_uri = master_uri
        self._log = log
        self._pause = pause
        self._missing = ""  # why no master is reached now
        self.obstacle = Obstacle(lambda: self._missing)
        """Why no master is reached now; empty if one is, or if none was needed."""

    async def reach(self, ask: Callable[[], Awaitable[T]]) -> T:
        """Return ``await ask()``; with ``"wait"``, ask again until a master answers."""
        if self.policy != "wait":
            return await ask()
        backoff = Backoff(first=_FIRST, longest=_LONGEST)
        while True:
            try:
                answer = await ask()
            except MasterUnreachable as error:
                advice = port_advice(self._master_uri) + _ADVICE
                self._say(f"waiting for a master: {error.in_short}; {advice}")
                self._missing = error.in_short
            else:
                self.reached()
                return answer
            await self._pause(backoff.delay())

    def reached(self) -> None:
        """Note that a master has answered."""
        self._missing = ""

    def deferred(self) -> None:
        """Say that what was opened is registered later."""
        self._say(
            f"no master answers at {self._master_uri}: {port_advice(self._master_uri)}"
            "what is opened now is registered as soon as one does"
        )

    def _say(self, text: str) -> None:
        """Log ``text``, once until a master has answered."""
        if not self._missing:
            self._missing = text
            self._log.warning("%s", text)
