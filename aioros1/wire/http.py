"""Reads HTTP answers of XML-RPC servers, without any I/O.

Servers of ROS 1 differ in how an answer ends: most announce its length, those in Node.js
send it in chunks, and those of HTTP/1.0 may just close the connection. They differ in
the case of field names, and some send an interim answer first. Whatever is not needed to
find the body is skipped.
"""

from __future__ import annotations

import re
import zlib

__all__ = ["MAX_HEAD", "MAX_URI", "AnswerReader", "HttpError"]

MAX_URI = 2_048
"""Characters of the longest URI. Those of ROS 1 have some thirty."""

MAX_HEAD = 16 << 10
"""The most bytes of a head, of a line between chunks, and of the fields after the last chunk.
The programs of ROS 1 send about 150."""

# Lines end with CR LF; small hand-written servers send LF alone.
_HEAD_END = re.compile(rb"\r?\n\r?\n")
# A line that begins with white space continues the one before.
_LINE_END = re.compile(rb"\r?\n(?![ \t])")
_BEGIN = b"HTTP/1."
_STATUS = re.compile(rb"HTTP/1\.([0-9]) +([0-9]{3})(?: +(.*))?")
_LENGTH = re.compile(rb"[0-9]{1,15}")
_CHUNK = re.compile(rb"([0-9A-Fa-f]{1,12})[ \t]*(?:;.*)?")

# What comes next.
_HEAD, _BODY, _CHUNK_SIZE, _CHUNK_DATA, _CHUNK_END, _TRAILER, _END = range(7)


class HttpError(ValueError):
    """The received bytes are not an HTTP answer, or not an acceptable one."""


class AnswerReader:
    """Takes the bytes of one answer as they arrive, and returns its status and its body.

    If the status is not 200, the answer is complete after its head, because its body is not
    needed. ``max_bytes`` limits the body, before memory is used for it.
    """

    __slots__ = (
        "_body",
        "_is_gzip",
        "_left",
        "_max_bytes",
        "_next",
        "_rest",
        "body",
        "has_begun",
        "keeps_alive",
        "reason",
        "server",
        "status",
    )

    def __init__(self, *, max_bytes: int) -> None:
        self._max_bytes = max_bytes
        self._next = _HEAD
        self._rest = b""  # of a head or a line that is not complete
        self._left = -1  # bytes of the body, the chunk or the trailer; -1 for no limit
        self._body = bytearray()
        self._is_gzip = False
        self.has_begun = False
        """Whether any byte has come, so that the server must have read the request."""
        self.status = 0
        """The status code; 0 before the head is complete."""
        self.reason = ""
        """The text behind the status code."""
        self.server = b""
        """The program that answers, if it says so."""
        self.body = b""
        """The body, once the answer is complete."""
        self.keeps_alive = False
        """Whether the connection can be used again, once the answer is complete."""

    def __repr__(self) -> str:
        state = "complete" if self._next == _END else "incomplete"
        what = f"{self.status} {self.reason}".rstrip() if self.status else "no status yet"
        return f"<AnswerReader: {what}, {state}>"

    def receive_data(self, data: bytes) -> bool:
        """Take bytes; whether the answer is complete now. Raises :class:`HttpError`."""
        self.has_begun = True
        if self._rest:
            data = self._rest + data
            self._rest = b""
        position = 0
        if self._next == _HEAD:
            position = self._head(data)
            if self._next == _HEAD:
                return False
        if self._next == _BODY:
            return self._take_body(data, position)
        return self._next == _END or self._take_chunks(data, position)

    def receive_eof(self) -> bool:
        """Note the end of the connection; whether that completes the answer."""
        if self._next == _BODY and self._left < 0:
            self._complete(bytes(self._body))
        return self._next == _END

    # the head

    def _head(self, data: bytes) -> int:
        """Return where the body begins; 0 while the head is incomplete."""
        position = 0
        while True:
            if not data.startswith(_BEGIN[: len(data) - position], position):
                raise _not_http(data[position:])
            end = _HEAD_END.search(data, position, position + MAX_HEAD)
            if end is None:
                self._rest = _bounded(data[position:], "head")
                return 0
            lines = _LINE_END.split(data[position : end.start()])
            position = end.end()
            status = _STATUS.fullmatch(lines[0])
            if status is None:
                raise _not_http(lines[0])
            minor, code, reason = status.groups(b"")
            self.status = int(code)
            if self.status >= 200 or self.status == 101:
                break
            # An interim answer; the final one follows.
        self.reason = reason.decode("latin-1")
        if self.status != 200:
            self._next = _END
            return position
        self._fields(lines[1:], minor != b"0")
        return position

    def _fields(self, lines: list[bytes], keeps_alive: bool) -> None:
        length: bytes | None = None
        chunked = False
        options: list[bytes] = []
        for line in lines:
            name, colon, value = line.partition(b":")
            if not colon:
                raise _not_http(line)
            name, value = name.strip().lower(), value.strip()
            if name == b"content-length":
                if _LENGTH.fullmatch(value) is None or length not in (None, value):
                    raise _not_http(line)
                length = value
            elif name == b"transfer-encoding":
                coding = value.lower()
                if coding not in (b"chunked", b"identity"):
                    raise _not_http(line)
                chunked = coding == b"chunked"
            elif name == b"server":
                self.server = value
            elif name == b"content-encoding":
                if value.lower() not in (b"gzip", b"x-gzip", b"identity", b""):
                    raise _not_http(line)
                self._is_gzip = value.lower().endswith(b"gzip")
            elif name == b"connection":
                options += (option.strip() for option in value.lower().split(b","))
        self.keeps_alive = b"close" not in options and (keeps_alive or b"keep-alive" in options)
        if chunked:  # whatever length is announced as well
            self._next = _CHUNK_SIZE
            return
        self._next = _BODY
        if length is None:
            self.keeps_alive = False
        else:
            self._left = self._within_limit(int(length))

    # the body

    def _take_body(self, data: bytes, position: int) -> bool:
        came = len(data) - position
        if self._left < 0:
            self._within_limit(came)
            self._body += data[position:]
            return False
        if came < self._left:
            self._left -= came
            self._body += data[position:]
            return False
        if came > self._left:
            self.keeps_alive = False  # what else is this?
        body = data[position : position + self._left]
        if self._body:
            self._body += body
            body = bytes(self._body)
        self._complete(body)
        return True

    def _take_chunks(self, data: bytes, position: int) -> bool:
        while True:
            if self._next == _CHUNK_DATA:
                piece = data[position : position + self._left]
                self._body += piece
                self._left -= len(piece)
                if self._left:
                    return False
                position += len(piece)
                self._next = _CHUNK_END
            end = data.find(b"\n", position)
            # Complete and incomplete lines have the same limit, so that it does not matter
            # in which pieces a line arrives.
            line = _bounded(data[position : end if end >= 0 else len(data)], "line")
            if self._next == _TRAILER and len(line) > self._left:
                raise HttpError(f"not an HTTP answer: a trailer of more than {MAX_HEAD} bytes")
            if end < 0:
                self._rest = line
                return False
            position = end + 1
            text = line.removesuffix(b"\r")
            if self._next == _CHUNK_SIZE:
                size = _CHUNK.fullmatch(text)
                if size is None:
                    raise _not_http(text)
                self._left = self._within_limit(int(size[1], 16))
                self._next = _CHUNK_DATA
                if not self._left:
                    self._left = MAX_HEAD
                    self._next = _TRAILER
            elif self._next == _TRAILER:
                if not text:
                    self.keeps_alive = self.keeps_alive and position == len(data)
                    self._complete(bytes(self._body))
                    return True
                self._left -= len(line)
            elif text:
                raise _not_http(text)
            else:
                self._next = _CHUNK_SIZE

    def _within_limit(self, more: int) -> int:
        if len(self._body) + more > self._max_bytes:
            raise HttpError(f"an answer of more than {self._max_bytes} bytes")
        return more

    def _complete(self, body: bytes) -> None:
        self._body.clear()
        self.body = self._inflated(body) if self._is_gzip else body
        self._next = _END

    def _inflated(self, body: bytes) -> bytes:
        """Inflate a body that was compressed although nobody asked for it."""
        inflate = zlib.decompressobj(wbits=31)
        try:
            inflated = inflate.decompress(body, self._max_bytes + 1)
        except zlib.error as error:
            raise HttpError(f"not gzip: {error}") from None
        self._within_limit(len(inflated))
        if not inflate.eof:
            raise HttpError("the gzip data ends early")
        return inflated


def _bounded(data: bytes, what: str) -> bytes:
    if len(data) >= MAX_HEAD:
        raise HttpError(f"not an HTTP answer: a {what} of more than {MAX_HEAD} bytes")
    return data


def _not_http(data: bytes) -> HttpError:
    text = repr(data[:60].decode("latin-1"))
    return HttpError(f"not an HTTP answer: {text}")
