"""How long to wait before trying again."""

from __future__ import annotations

import random

__all__ = ["Backoff"]


class Backoff:
    """Delays that double, with jitter, so that peers that lost each other in the same
    moment do not come back in the same moment."""

    __slots__ = ("_first", "_next", "longest")

    def __init__(self, first: float = 0.1, longest: float = 10.0) -> None:
        self.longest = longest
        self._first = first
        self._next = first

    def reset(self) -> None:
        """Start over: the last try went well."""
        self._next = self._first

    def delay(self) -> float:
        """Seconds to wait now: between half of the current delay and all of it."""
        current = self._next
        self._next = min(self.longest, 2 * current)
        return current * random.uniform(0.5, 1.0)
