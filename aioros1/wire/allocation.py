"""Memory for large messages that is kept from one message to the next.

A megabyte that was freed goes back to the operating system, as C libraries do it, and
comes anew for the next message, page by page: that is four fifths of the time that a string
of 1 MB takes from one process to another and back (2.3 ms against 0.5). glibc adapts: it
keeps blocks as large as the largest it was ever given back, and about twice as much in all.
So one larger than what is needed is made and given back, once, without being touched.
"""

from __future__ import annotations

__all__ = ["keep_memory"]

_TIMES = 16
"""Several messages are under way at a time: in a queue, being decoded, in the application."""

_MOST = 31 << 20
"""glibc adapts to blocks of up to 32 MiB."""

_kept = 0


def keep_memory(size: int) -> None:
    """Have memory at hand for messages of ``size`` bytes; of no effect but on speed.

    It concerns the whole process. What it holds back is bounded: twice sixteen messages,
    and 62 MiB whatever their size.
    """
    global _kept
    if size > _kept < _MOST:
        # Not a little more with each of many growing messages.
        _kept = max(size, 2 * _kept)
        # Zeroed by the operating system, page by page when used: as long as nobody
        # does, it costs nothing.
        bytes(min(_TIMES * _kept, _MOST))
