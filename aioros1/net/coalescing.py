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
from threading import RLock, get_ident
from time import perf_counter

__all__ = ["Coalescer"]

BURST_GAP = 5e-6
"""The longest time between two messages of a burst, in seconds. A burst has a message every
microsecond; who waits for an answer in between needs ten at least."""

MAX_ALONE = 16
"""Messages that are written one by one before other tasks should run."""


class Coalescer:
    """Decides for all publishers of one event loop; part of :class:`.LoopState`.

    ``check_thread(what)`` raises if it is called outside the loop's thread.
    """

    __slots__ = (
        "_alone",
        "_check_thread",
        "_functions",
        "_lock",
        "_loop",
        "_sent_at",
        "collects_here",
        "is_collecting",
        "should_yield",
        "thread_id",
    )

    def __init__(
        self, loop: asyncio.AbstractEventLoop, check_thread: Callable[[str], None]
    ) -> None:
        self._loop = loop
        self._check_thread = check_thread
        self.thread_id = get_ident()
        """The thread that ran the loop when somebody looked last."""
        self.is_collecting = False
        """Whether messages are collected until the end of the iteration. A plain attribute,
        as it is looked at for each message."""
        self.collects_here: Callable[[], bool]
        """Whether messages are collected, and this is the thread that does it.

        One question, because it is asked for each message: a method of a lock answers it in
        20 to 30 ns, while :func:`threading.get_ident` and a comparison take 40 to 60.
        """
        self._new_lock()
        self.should_yield = False
        """Whether so much was sent in this iteration that other tasks should run."""
        self._alone = 0  # messages sent alone in this iteration
        self._sent_at = 0.0
        self._functions: list[Callable[[], object]] = []

    def begin(self) -> None:
        """A message is about to be encoded: find out whether it belongs to a burst.

        To be called unless :attr:`collects_here`. Raises :class:`RuntimeError` outside the
        loop's thread, and then has changed nothing.
        """
        if get_ident() != self.thread_id:
            self._check_thread("publish()")
        if not self.is_collecting and perf_counter() - self._sent_at < BURST_GAP:
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
        if not self.is_collecting:
            self._loop.call_soon(self._end)  # first: if this fails, nothing is collected
            self._lock.acquire()
            self.is_collecting = True

    def call_at_end(self, function: Callable[[], object]) -> None:
        """Call ``function`` at the end of the iteration; only while messages are collected.

        An exception that it raises goes to the loop's exception handler, and the other
        functions are called nevertheless.
        """
        self._functions.append(function)

    def _end(self) -> None:
        self._alone = 0
        self.should_yield = self.is_collecting = False
        if self.collects_here():
            self._lock.release()
        else:  # the loop was stopped in between, and runs in another thread now
            self._new_lock()
        functions, self._functions = self._functions, []
        rest = iter(functions)
        try:
            for function in rest:
                function()
        except BaseException:
            for function in rest:
                self._loop.call_soon(function)
            raise  # to the loop, which reports it

    def _new_lock(self) -> None:
        # It protects nothing, and only remembers which thread collects. The method is the one
        # that threading.Condition asks; typeshed does not know it.
        self._lock = RLock()
        self.collects_here = self._lock._is_owned  # type: ignore[attr-defined]
