"""Puts the heads of HTTP requests into the form that strict parsers take, without any I/O.

The servers of ROS 1 take more than the standard allows: lines that end with a line feed
alone, lines that continue on the next one, blanks in front of a colon, no host. Small
hand-written clients send such heads.
"""

from __future__ import annotations

import re

__all__ = ["MAX_HEAD", "Heads"]

MAX_HEAD = 64 << 10
"""The most bytes of a head. The servers of ROS 1 allow as many for a single line."""

_END = re.compile(rb"\r?\n\r?\n")
_BEGIN = re.compile(rb"[A-Z]{0,20}(?: |\Z)")
_ODD = re.compile(rb"(?<!\r)\n|\n[ \t]|\n[^:\r\n]*[ \t]:|\A[^\n]*[\x80-\xff]")
_HOST = re.compile(rb"\nhost:", re.IGNORECASE)
_NOT_ASCII = re.compile(rb"[\x80-\xff]")
_FOLD = re.compile(rb"\r?\n[ \t]+")
_LINE_END = re.compile(rb"\r?\n")
_LENGTH = re.compile(rb"\s*[0-9]{1,15}\s*")


class Heads:
    """The requests of one connection.

    Whoever sends one odd head sends more, and nobody else does: if the first head is in
    order, the connection needs no further look.
    """

    __slots__ = ("_buffer", "_is_decided", "_left", "is_plain")

    def __init__(self) -> None:
        self._buffer = bytearray()  # the beginning of a head
        self._left = 0  # bytes of a body
        self._is_decided = False
        self.is_plain = False
        """Whether everything that follows can be given to the parser as it comes."""

    def __repr__(self) -> str:
        state = "plain" if self.is_plain else "odd" if self._is_decided else "undecided"
        return f"<Heads: {state}, {len(self._buffer)} bytes waiting>"

    def feed(self, data: bytes) -> bytes:
        """Take bytes as they arrive; returns what to give to the parser."""
        out = bytearray()
        buffer = self._buffer
        buffer += data
        begin = max(0, len(buffer) - len(data) - 3)  # an end may be in pieces
        while buffer and not self.is_plain:
            if self._left:
                body = buffer[: self._left]
                self._left -= len(body)
                out += body
                del buffer[: len(body)]
                begin = 0
                continue
            if buffer[0] in b"\r\n":  # empty lines in front of a head
                blank = len(buffer) - len(buffer.lstrip(b"\r\n"))
                del buffer[:blank]
                begin = max(0, begin - blank)
                continue
            end = _END.search(buffer, begin)
            if end is None:
                # Not a head at all, or too long for one: the parser says so.
                self.is_plain = len(buffer) > MAX_HEAD or _BEGIN.match(buffer) is None
                break
            head = bytes(buffer[: end.start()])
            if not self._is_decided:
                self._is_decided = True
                if end[0] == b"\r\n\r\n" and _HOST.search(head) and not _ODD.search(head):
                    self.is_plain = True
                    break
            del buffer[: end.end()]
            begin = 0
            out += self._in_order(head)
        if self.is_plain:
            out += buffer
            buffer.clear()
        return bytes(out)

    def _in_order(self, head: bytes) -> bytes:
        request, *fields = _LINE_END.split(_FOLD.sub(b" ", head))
        lines = [_NOT_ASCII.sub(_quoted, request.rstrip())]
        if _HOST.search(head) is None:
            lines.append(b"Host: unknown")
        for field in fields:
            name, colon, value = field.partition(b":")
            name = name.rstrip()
            lines.append(name + colon + value)
            if name.lower() == b"content-length" and _LENGTH.fullmatch(value):
                self._left = int(value)
            elif name.lower() == b"transfer-encoding":
                self.is_plain = True  # what follows has a form that only the parser knows
        return b"\r\n".join(lines) + b"\r\n\r\n"


def _quoted(character: re.Match[bytes]) -> bytes:
    return b"%%%02X" % character[0][0]
