"""How long something takes that is done again and again."""

from __future__ import annotations

__all__ = ["TimeTaken"]

_TYPICAL = 0.02
"""Seconds, until it is known better."""

_LEAST = 0.001
"""Seconds. The clock of uvloop counts milliseconds, and what took none of them must be able to
grow again."""


class TimeTaken:
    """How long something takes, of which a single slow one says little."""

    __slots__ = ("seconds",)

    def __init__(self) -> None:
        self.seconds = _TYPICAL

    def add(self, seconds: float) -> None:
        """Note how long it took this time: at most twice as long as before counts."""
        self.seconds = max(min(seconds, 2 * self.seconds), _LEAST)

    def __repr__(self) -> str:
        return f"<TimeTaken {self.seconds:g} s>"
