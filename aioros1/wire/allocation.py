"""Makes the C library keep the memory of large messages for the next ones.

Normally it returns a freed megabyte to the operating system, and gets it again for the next
message, page by page. That is four fifths of the time a string of 1 MB takes to another
process and back (2.3 ms instead of 0.5). glibc adapts: it keeps blocks as large as the
largest one that was freed, and about twice as much in all. So a block larger than needed is
allocated and freed once, without being touched.
"""

from __future__ import annotations

__all__ = ["keep_memory"]

_TIMES = 16
"""Messages that exist at a time: in a queue, being decoded, in the application."""

_MOST = 31 << 20
"""glibc adapts to blocks of up to 32 MiB."""

_kept = 0


def keep_memory(size: int) -> None:
    """Keep memory ready for messages of ``size`` bytes. This only affects speed.

    It applies to the whole process, which keeps at most twice sixteen messages, and never
    more than 62 MiB.
    """
    global _kept
    if size > _kept < _MOST:
        # Doubled, so that slowly growing messages do not cause this each time.
        _kept = max(size, 2 * _kept)
        # The operating system provides a page when it is used first. None of these is, so
        # this costs nothing.
        bytes(min(_TIMES * _kept, _MOST))
