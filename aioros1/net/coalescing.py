"""Whether a message is sent at once, or together with those that follow it.

A message that comes alone is written at once. One that follows another within
:data:`BURST_GAP` belongs to a burst, be it of one topic or of a hundred: it is collected with
those behind it until the end of the event loop's iteration, and they are written as one
block. The end of an iteration is a callback, and so costs one more iteration; a message that
comes alone does without it, which saves 9 of the 35 µs that a short one takes to another
process and back.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from threading import get_ident
from time import perf_counter

__all__ = ["Coalescer"]

BURST_GAP = 5e-6
"""The longest time between two messages of a burst, in seconds. A burst has a message every
microsecond; who waits for an answer in between needs ten at least."""

MAX_ALONE = 16
"""Messages that are written one by one before other tasks should run."""


class Coalescer:
    """Decides for all publishers of one event loop; part of :class:`.LoopState`.

    ``collecting_in`` and ``should_yield`` are plain attributes, because they are looked at
    for each message. ``check_thread(what)`` raises if it is called outside the loop's thread.
    """

    __slots__ = (
        "_alone",
        "_check_thread",
        "_functions",
        "_loop",
        "_sent_at",
        "collecting_in",
        "should_yield",
    )

    def __init__(
        self, loop: asyncio.AbstractEventLoop, check_thread: Callable[[str], None]
    ) -> None:
        self._loop = loop
        self._check_thread = check_thread
        self.collecting_in = 0
        """While messages are collected until the end of the iteration: the loop's thread, as
        :func:`threading.get_ident` names it. Otherwise 0.

        So one comparison says both whether :meth:`begin` has to be called, and whether this
        is the right thread.
        """
        self.should_yield = False
        """Whether so much was sent in this iteration that other tasks should run."""
        self._alone = 0  # messages sent alone in this iteration
        self._sent_at = 0.0
        self._functions: list[Callable[[], object]] = []

    def begin(self) -> None:
        """A message is about to be encoded: find out whether it belongs to a burst.

        To be called unless :attr:`collecting_in` is this thread. Raises
        :class:`RuntimeError` outside the loop's thread, and then has changed nothing.
        """
        self._check_thread("publish()")
        if self.collecting_in:
            self.collecting_in = get_ident()  # another thread goes on running the loop
        elif perf_counter() - self._sent_at < BURST_GAP:
            self.collect()

    def sent_alone(self) -> None:
        """A message was written by itself."""
        self._alone += 1
        if self._alone >= MAX_ALONE:
            self.sent_much()
        self._sent_at = perf_counter()

    def sent_much(self) -> None:
        """A whole block or a large message was written."""
        self.collect()
        self.should_yield = True

    def collect(self) -> None:
        """Collect messages from now on, until the end of the loop's iteration.

        Raises :class:`RuntimeError` when the loop is closed.
        """
        if not self.collecting_in:
            self._loop.call_soon(self._end)  # first: if this fails, nothing is collected
            self.collecting_in = get_ident()

    def call_at_end(self, function: Callable[[], object]) -> None:
        """Call ``function`` at the end of the iteration; only while messages are collected.

        An exception that it raises goes to the loop's exception handler, and the other
        functions are called nevertheless.
        """
        self._functions.append(function)

    def _end(self) -> None:
        self._alone = 0
        self.collecting_in = 0
        self.should_yield = False
        functions, self._functions = self._functions, []
        rest = iter(functions)
        try:
            for function in rest:
                function()
        except BaseException:
            for function in rest:
                self._loop.call_soon(function)
            raise  # to the loop, which reports it
