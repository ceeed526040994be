"""How far a run has come, and how long it will take."""

from __future__ import annotations

import sys
import time

__all__ = ["Progress"]


class Progress:
    """Says on standard error what is being measured; ``seconds`` is what all is expected to take.

    The rest is estimated from what was expected and what it took so far.
    """

    def __init__(self, seconds: float) -> None:
        self._expected = seconds
        self._done = 0.0
        self._start = time.monotonic()
        if seconds > 60:
            print(f"this takes about {minutes(seconds)}", file=sys.stderr)

    def measuring(self, title: str, seconds: float) -> None:
        """What comes next, and what it is expected to take."""
        passed = time.monotonic() - self._start
        # What was expected counts as well, as if a minute of it had been measured already.
        pace = (passed + 60) / (self._done + 60)
        left = (self._expected - self._done) * pace
        self._done += seconds
        print(f"{title}; {minutes(left)} left", file=sys.stderr)


def minutes(seconds: float) -> str:
    whole = max(1, round(seconds / 60))
    return f"{whole} minute{'s' * (whole > 1)}"
