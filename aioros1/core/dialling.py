"""How many publishers a node follows, and to how many it connects at a time."""

from __future__ import annotations

import asyncio

__all__ = ["Dialling"]

AT_ONCE = 200
"""Connections that are being made at a time. A process has 1,024 descriptors on most systems."""


class Dialling:
    """Bounds what a list of publishers does to a node, since anybody may send one.

    ``limit`` is how many publishers it follows at most, in sum over its topics.
    """

    def __init__(self, limit: int) -> None:
        self._limit = limit
        self.slots = asyncio.Semaphore(AT_ONCE)
        """Held while a connection is being made."""
        self.followed = 0
        """Publishers that are followed now."""

    def admit(self) -> bool:
        """Whether one more may be followed; :meth:`leave` gives that back."""
        if self.followed >= self._limit:
            return False
        self.followed += 1
        return True

    def leave(self) -> None:
        """Note that one is no longer followed."""
        self.followed -= 1
