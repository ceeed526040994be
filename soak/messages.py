"""The message that the scenarios send: who sent it, and which of its messages it is."""

from __future__ import annotations

from typing import Any

import aioros1

__all__ = ["Numbered", "Question", "Run"]

_store = aioros1.MessageStore()
_store.add_text("soak/Numbered", "uint64 life\nuint64 number\nuint8[] padding")
_store.add_text("soak/Question", "uint64 life\nuint64 number\n---\nuint64 life\nuint64 number")

Numbered: Any = _store.load_msg("soak/Numbered")
"""``life`` is one publisher from its opening to its end; ``number`` counts its messages."""

Question: Any = _store.load_srv("soak/Question")
"""Answered with the same two numbers."""


class Run:
    """The messages of one publisher, as one subscriber gets them: in order, none missing.

    The first may be any: a subscriber sees what is sent from when it is connected.
    """

    def __init__(self) -> None:
        self.first: int | None = None
        self.last = -1
        self.problems: list[str] = []

    @property
    def count(self) -> int:
        return 0 if self.first is None else self.last - self.first + 1

    def got(self, number: int) -> None:
        if self.first is None:
            self.first = number
        elif number != self.last + 1:
            self.problems.append(f"{number} came after {self.last}")
        self.last = number
