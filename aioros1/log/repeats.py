"""Counts complaints that recur, in bounded memory. No clock."""

from __future__ import annotations

from collections.abc import Hashable, Iterator
from dataclasses import dataclass

__all__ = ["Repeats"]

_LONGEST = 3600.0


@dataclass(slots=True)
class _Complaint:
    """Something that was said, and how often it came again since."""

    args: tuple[object, ...]
    since: float
    period: float
    count: int = 0


class Repeats:
    """Decides which complaints to log, and counts the others.

    A complaint is logged when it comes for the first time. What comes again within ``period``
    seconds is counted, and logged together when they are over. While it goes on, the period
    doubles each time, up to an hour. At most ``capacity`` complaints of a kind are told apart,
    so that whoever invents new ones cannot fill the log; one kind never displaces another.
    """

    def __init__(self, period: float = 60.0, *, capacity: int = 32) -> None:
        self.period = period
        self._capacity = capacity
        self._kinds: dict[str, dict[Hashable, _Complaint]] = {}
        self._others: dict[str, int] = {}

    def __bool__(self) -> bool:
        """Whether there is anything to ask :meth:`due` for later."""
        return bool(self._kinds)

    def is_new(self, kind: str, about: Hashable, args: tuple[object, ...], now: float) -> bool:
        """Count a complaint; return whether to log it.

        ``about`` tells it from others of its kind, and ``args`` are the words that it is
        logged with.
        """
        complaints = self._kinds.setdefault(kind, {})
        known = complaints.get(about)
        if known is not None:
            known.count += 1
            known.args = args
            return False
        if len(complaints) >= self._capacity:
            self._others[kind] = self._others.get(kind, 0) + 1
            return False
        complaints[about] = _Complaint(args, now, self.period)
        return True

    def due(self, now: float) -> Iterator[tuple[str, tuple[object, ...], str]]:
        """Yield the kind, the words and the count of what came again, where the time is over."""
        for kind, complaints in list(self._kinds.items()):
            for about, complaint in list(complaints.items()):
                seconds = now - complaint.since
                if seconds < complaint.period:
                    continue
                if not complaint.count:
                    del complaints[about]
                    continue
                yield kind, complaint.args, _often(complaint.count, complaint.period)
                complaint.count = 0
                complaint.since = now
                complaint.period = min(2 * complaint.period, _LONGEST)
            if others := self._others.pop(kind, 0):
                often = f"{others} others in the last {_words(self.period)}"
                yield kind.replace("%s", "…"), (), often
            if not complaints:
                del self._kinds[kind]


def _often(count: int, seconds: float) -> str:
    times = "once more" if count == 1 else f"{count} more times"
    return f"{times} in the last {_words(seconds)}"


def _words(seconds: float) -> str:
    if seconds < 60:
        return f"{seconds:g} s"
    minutes = round(seconds / 60)
    if minutes >= 60:
        return "hour"
    return "minute" if minutes == 1 else f"{minutes} minutes"
