"""Carriage returns in XML-RPC documents.

XML turns a carriage return into a line feed, unless it is written as ``&#13;``. roscpp reads
XML-RPC without an XML parser: it keeps carriage returns, and does not know ``&#13;``. So we
write them as they are, as rosmaster does, and keep them when we read. Peers that are known to
be Python's XML-RPC, as rosmaster and rospy are, get references, and with them what was meant.
"""

from __future__ import annotations

__all__ = ["CarriageReturns", "with_references"]

_REFERENCE = b"&#13;"
_BEFORE_TEXT = frozenset({b"methodName", b"value", b"string", b"name"})


def with_references(document: bytes) -> bytes:
    """A document that :mod:`aioros1.wire.xmlrpc` made, for a peer that has an XML parser."""
    return document.replace(b"\r", _REFERENCE) if b"\r" in document else document


class CarriageReturns:
    """Puts references for the carriage returns in strings, in the pieces of a document."""

    def __init__(self) -> None:
        self._tag: bytes | None = None  # the beginning of the tag that has not ended
        self._is_text = False

    def keep(self, piece: bytes) -> bytes:
        """Return the next piece as an XML parser has to have it."""
        parts = piece.split(b"<")
        for index, part in enumerate(parts):
            if index:
                self._tag = b""
            if self._tag is None:
                text, before = part, b""
            else:
                tag, end, text = part.partition(b">")
                self._tag = (self._tag + tag)[:16]
                if not end:
                    continue
                before = tag + end
                self._is_text = self._tag.rstrip() in _BEFORE_TEXT
                self._tag = None
            if self._is_text:
                parts[index] = before + text.replace(b"\r", _REFERENCE)
        return b"<".join(parts)
