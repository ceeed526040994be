"""How long to wait before trying again."""

from __future__ import annotations

import random

__all__ = ["Backoff"]


class Backoff:
    """Delays that double, with jitter: nodes that lost the same peer at the same moment do
    not all come back at the same moment."""

    __slots__ = ("_first", "_next", "longest")

    def __init__(self, first: float = 0.1, longest: float = 10.0) -> None:
        self.longest = longest
        self._first = first
        self._next = first

    def reset(self) -> None:
        """Start over with the shortest delay, after a success."""
        self._next = self._first

    def delay(self) -> float:
        """Seconds to wait before the next try: a random part, from half to all, of the delay."""
        current = self._next
        self._next = min(self.longest, 2 * current)
        return current * random.uniform(0.5, 1.0)
