"""Text that others wrote, made fit for a line of a log or the text of an error."""

from __future__ import annotations

import reprlib

__all__ = ["LONGEST", "printable"]

LONGEST = 300
"""Characters of one thing that a peer said: enough for every name, type and sentence."""


def printable(text: object, limit: int = LONGEST) -> str:
    r"""Return ``text`` as one line of at most ``limit`` characters.

    Everything that is not a visible character or a space becomes an escape such as ``\n``,
    ``\x1b`` or ``\u202e``, so that nobody can end a line, start another, or make a terminal
    do something. A text that is too long is cut, and says how long it was. Doing it twice
    changes nothing more.
    """
    whole = text if isinstance(text, str) else _text_of(text, limit)
    if len(whole) <= limit and whole.isprintable():
        return whole
    # Every character gives at least one: what is beyond the limit need not be looked at.
    shown = "".join(map(_escape, whole[: limit + 1]))
    if len(whole) <= limit and len(shown) <= limit:
        return shown
    end = f"… ({len(whole)} characters)"
    return shown[: max(0, limit - len(end))] + end


def _text_of(value: object, limit: int) -> str:
    """The text of a value that is none, without that of everything in it: it may be large."""
    if isinstance(value, bytes | bytearray):
        return repr(bytes(value[:limit]))
    if isinstance(value, list | tuple | dict):
        return _BRIEF.repr(value)
    return str(value)


_BRIEF = reprlib.Repr()
_BRIEF.maxlist = _BRIEF.maxtuple = _BRIEF.maxdict = 20
_BRIEF.maxstring = 100


def _escape(char: str) -> str:
    if char.isprintable():
        return char
    code = ord(char)
    if 0xDC80 <= code <= 0xDCFF:  # a byte that is not UTF-8, kept by surrogateescape
        return f"\\x{code - 0xDC00:02x}"
    return char.encode("unicode_escape").decode("ascii")
