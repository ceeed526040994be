"""What the library keeps for an event loop, in one object for each.

Programs may run several event loops in several threads. Nothing here is shared between them,
and so nothing needs a lock.
"""

from __future__ import annotations

import asyncio
import os
import threading
from asyncio import _get_running_loop
from collections.abc import Callable
from threading import get_ident

from aioros1.net.coalescing import Coalescer
from aioros1.net.lookups import Lookups
from aioros1.net.turns import Turns
from aioros1.wire.allocation import keep_memory
from aioros1.wire.frames import READ

__all__ = ["LoopState", "loop_state"]

_KEY = "aioros1.net.loop_state"

_SMALL = 32 << 10
"""Bytes to keep memory for from the start. asyncio reads each piece of a connection that has no
buffer of its own into a new block of 256 KiB, which the system would otherwise map and unmap
every time: two thirds of what a call takes."""


class LoopState:
    """The state of one event loop; :func:`loop_state` gives that of the running one."""

    __slots__ = (
        "__weakref__",
        "coalescer",
        "listeners",
        "lookups",
        "loop",
        "receive_buffer",
        "thread_id",
        "token",
        "turns",
    )

    def __init__(self, loop: asyncio.AbstractEventLoop) -> None:
        keep_memory(_SMALL)
        self.loop = loop
        self.thread_id = get_ident()
        """The thread that ran the loop when somebody looked last. A program may stop a loop
        and go on with it in another thread, so this does not decide; see
        :meth:`check_thread`."""
        self.coalescer = Coalescer(loop, self.check_thread)
        """Decides which messages are sent together."""
        self.turns = Turns(loop)
        """Shares the loop between requests that take long."""
        self.token = os.urandom(16).hex()
        """Names the loop to its own nodes. Nobody outside can guess it."""
        self.listeners: dict[str, Callable[[], asyncio.BaseProtocol]] = {}
        """The nodes of the loop that take connections within it: by a key, what makes the
        protocol of their side of one."""
        self.lookups = Lookups(loop)
        """Looks up the names of hosts."""
        self.receive_buffer = memoryview(bytearray(READ))  # pages come when they are used
        """Where sockets are read into; one for all connections of the loop.

        It is in use only between a protocol's ``get_buffer()`` and its ``buffer_updated()``,
        where the bytes are copied out before anything else is called. Every kind of
        transport calls the two in one go, without running other code in between:

        - asyncio's selector loop calls ``get_buffer()``, ``recv_into()`` and
          ``buffer_updated()`` in one function. Its proactor loop reads into memory of its
          own and copies from there.
        - uvloop is asked for a buffer by libuv right before each ``read()``, and calls
          ``buffer_updated()`` right after it.
        - Connections within a process hand over what was written, or copy it in one go.

        Neither protocols over TLS nor loops that leave a read to the kernel while they run
        other code (as io_uring can) are used; the latter would need a buffer for each link.
        """

    def check_thread(self, what: str) -> None:
        """Refuse a call from another thread than the one that runs the loop.

        ``what`` names the function in the error. While nobody runs the loop, the thread in
        which it was last seen running may call. Raises :class:`RuntimeError`.
        """
        if _get_running_loop() is self.loop:
            # Those who look compare only the thread, which takes a fifth of the time.
            self.thread_id = self.coalescer.thread_id = get_ident()
            return
        is_known = self.thread_id != get_ident()
        if is_known or self.loop.is_running():
            owner = f"thread {_thread_name(self.thread_id)!r}" if is_known else "another thread"
            raise RuntimeError(
                f"{what} was called in thread {threading.current_thread().name!r}, but belongs "
                f"to the event loop in {owner}: use loop.call_soon_threadsafe(...) there, "
                "or NodeThread.call"
            )


def loop_state() -> LoopState:
    """The state of the running event loop. Raises :class:`RuntimeError` without one."""
    loop = asyncio.get_running_loop()
    # Kept by the loop itself. In a dictionary of ours it would live for ever: connections
    # refer to the loop, so that the value would keep its own (weak) key alive.
    attributes = vars(loop)
    state: LoopState | None = attributes.get(_KEY)
    if state is None:
        state = attributes[_KEY] = LoopState(loop)
    state.thread_id = state.coalescer.thread_id = get_ident()
    return state


def _thread_name(ident: int) -> str:
    for thread in threading.enumerate():
        if thread.ident == ident:
            return thread.name
    return f"{ident} (ended)"
