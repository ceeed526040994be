"""Limits how often something happens, for each of many keys, in bounded memory. No clock."""

from __future__ import annotations

__all__ = ["RateLimit", "Seldom"]


class RateLimit:
    """A token bucket for each key: it gains ``rate`` tokens a second and holds ``burst``.

    Time is in seconds of any monotonic clock. If you take more tokens than there are, you
    have to wait, behind those who wait already. At most ``capacity`` keys are kept; beyond
    that the oldest are forgotten, and start with a full bucket.
    """

    def __init__(self, rate: float, burst: int, *, capacity: int = 4096) -> None:
        self._rate = rate
        self._burst = burst
        self._capacity = capacity
        # When each bucket will be full. From then on its key need not be kept.
        self._full_at: dict[str, float] = {}

    def take(self, key: str, now: float, count: int = 1) -> float:
        """Take ``count`` tokens, and return the seconds to wait until they are there."""
        full_at = self._full_at.get(key)
        if full_at is None:
            self._make_room(now)
            full_at = now
        full_at = max(full_at, now) + count / self._rate
        self._full_at[key] = full_at
        wait = full_at - now - self._burst / self._rate
        # Less is a rounding error, which grows with the time that the machine has been up.
        return wait if wait > 1e-6 else 0.0

    def give_back(self, key: str, count: int = 1) -> None:
        """Undo a :meth:`take`."""
        if key in self._full_at:
            self._full_at[key] -= count / self._rate

    def _make_room(self, now: float) -> None:
        if len(self._full_at) < self._capacity:
            return
        kept = {key: full_at for key, full_at in self._full_at.items() if full_at > now}
        if len(kept) >= self._capacity:
            # Forget half of them, so that this does not happen for each new key.
            kept = dict(list(kept.items())[self._capacity // 2 :])
        self._full_at = kept


class Seldom:
    """Says whether to log something about a key: once in ``period`` seconds for each, and for
    at most ``capacity`` keys in that time."""

    def __init__(self, period: float = 60.0, *, capacity: int = 256) -> None:
        self._period = period
        self._capacity = capacity
        self._spoken: dict[str, float] = {}

    def __call__(self, key: str, now: float) -> bool:
        last = self._spoken.get(key)
        if last is not None and now - last < self._period:
            return False
        if last is None and len(self._spoken) >= self._capacity:
            oldest = next(iter(self._spoken))
            if now - self._spoken[oldest] < self._period:
                return False
            del self._spoken[oldest]
        self._spoken.pop(key, None)
        self._spoken[key] = now  # at the end: the first is always the oldest
        return True
