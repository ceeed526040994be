"""Bounds what many connections hold in memory together.

Each connection is bounded by itself, but thousands of them within their bounds would fill any
memory. They do not wait for each other: one that takes its time would stop all others. Instead
the one that has held most for longest has to go when there is no more room.
"""

from __future__ import annotations

from collections.abc import Callable
from time import monotonic

__all__ = ["FREE", "Budget", "Share"]

FREE = 16 << 10
"""Bytes of each share that do not count. Whoever needs no more is always served."""

_MAKE_ROOM = 16
"""One part of so many of the limit is freed at once, so that it is not looked for each time."""


class Budget:
    """``limit`` bytes, for all shares together."""

    def __init__(self, limit: int) -> None:
        self._limit = limit
        self._shares: set[Share] = set()
        self.used = 0
        """Bytes in use."""
        self.cut = 0
        """Shares that had to go so far."""

    def share(self, cut: Callable[[], object]) -> Share:
        """Open a share, which holds nothing yet. ``cut`` must end its owner, without waiting."""
        return Share(self, cut)

    def _take(self, share: Share, size: int) -> None:
        if self.used + size > self._limit:
            self._make_room(share, size)
        if not share.is_cut:
            self.used += size
            self._shares.add(share)

    def _give_back(self, share: Share, size: int) -> None:
        self.used -= size
        self._shares.discard(share)

    def _make_room(self, share: Share, size: int) -> None:
        """Cut the shares that have held most for longest, ``share`` itself perhaps.

        One that is alone may hold more than the limit: its own bound holds for it.
        """
        goal = self._limit - self._limit // _MAKE_ROOM - size
        now = monotonic()
        heaviest_first = sorted(self._shares, key=lambda each: each.weight(now), reverse=True)
        if heaviest_first == [share]:
            return
        for other in heaviest_first:
            other.end()
            if self.used <= goal or other is share:
                return


class Share:
    """What one owner holds of a :class:`Budget`."""

    __slots__ = ("_budget", "_cut", "_since", "is_cut", "size")

    def __init__(self, budget: Budget, cut: Callable[[], object]) -> None:
        self._budget = budget
        self._cut = cut
        self._since = 0.0
        self.size = 0
        """Bytes that count."""
        self.is_cut = False
        """Whether its owner had to go."""

    def grow_to(self, size: int) -> None:
        """Note that the owner holds ``size`` bytes now. Check :attr:`is_cut` afterwards."""
        more = size - FREE - self.size
        if more <= 0 or self.is_cut:
            return
        if not self._since:
            self._since = monotonic()
        self._budget._take(self, more)
        if not self.is_cut:
            self.size += more

    def close(self) -> None:
        """Give everything back."""
        if self.size:
            self._budget._give_back(self, self.size)
            self.size = 0
        self._since = 0.0

    def weight(self, now: float) -> float:
        """How much it has held, and for how long."""
        return self.size * (now - self._since)

    def end(self) -> None:
        """Give everything back, and end the owner."""
        self.close()
        self.is_cut = True
        self._budget.cut += 1
        self._cut()
