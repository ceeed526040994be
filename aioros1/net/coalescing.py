"""Turns of an event loop, as far as sending needs to know of them.

A message that comes alone is written at once. What follows on its heels belongs to a flood,
be it of one topic or of a hundred, and is collected until the turn of the loop is over. The
end of a turn is a callback, and so one more round of the loop; a message that comes alone
does without it, which saves 9 of the 35 µs that a short one takes to another process and
back.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from time import perf_counter
from weakref import WeakKeyDictionary

__all__ = ["Turn", "this_loops_turn"]

HEELS = 5e-6
"""Seconds between two messages of a flood at the most. A flood has one every microsecond;
who waits for an answer in between needs ten at least."""

AT_ONCE = 16
"""Messages that are written one by one until others get their turn."""


class Turn:
    """The turn that a loop is in. ``collects`` and ``is_long`` are looked at for every
    message, and so are plain attributes."""

    __slots__ = ("_at_end", "_written", "_written_at", "collects", "is_long")

    def __init__(self) -> None:
        self.collects = False
        """Whether messages are collected until the end of the turn."""
        self.is_long = False
        """Whether much was sent in this turn: it is time to let others run."""
        self._written = 0
        self._written_at = 0.0
        self._at_end: list[Callable[[], object]] = []

    def begin(self) -> None:
        """Before a message is encoded, unless :attr:`collects`: is it one of a flood?"""
        if perf_counter() - self._written_at < HEELS:
            self.note()

    def wrote(self) -> None:
        """A message was written by itself."""
        self._written += 1
        if self._written >= AT_ONCE:
            self.lengthen()
        self._written_at = perf_counter()

    def lengthen(self) -> None:
        """A whole block or a large message went out."""
        self.note()
        self.is_long = True

    def note(self) -> None:
        """Have the end of the turn noticed."""
        if not self.collects:
            self.collects = True
            asyncio.get_running_loop().call_soon(self._end)

    def at_end(self, function: Callable[[], object]) -> None:
        """Call ``function`` when the turn is over, which somebody has noted."""
        self._at_end.append(function)

    def _end(self) -> None:
        self._written = 0
        self.collects = self.is_long = False
        functions, self._at_end = self._at_end, []
        for function in functions:
            function()


_turns: WeakKeyDictionary[asyncio.AbstractEventLoop, Turn] = WeakKeyDictionary()


def this_loops_turn() -> Turn:
    """The turns of the running loop; one object for all that is sent in it."""
    loop = asyncio.get_running_loop()
    turn = _turns.get(loop)
    if turn is None:
        turn = _turns[loop] = Turn()
    return turn
