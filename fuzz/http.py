"""HTTP answers, cut into pieces: the same answer whatever the pieces, or the documented error."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from aioros1.wire import http
from aioros1.wire.http import AnswerReader, HttpError

__all__ = ["check", "seeds"]

TOKENS = [
    *(b"HTTP/1.1 200 OK\r\n", b"HTTP/1.0 ", b"HTTP/1.1 100 Continue\r\n\r\n", b" 404 no", b"\r\n"),
    *(b"\r\n\r\n", b"\n\n", b"\n ", b"Content-Length: 5\r\n", b"content-length:0", b"Connection: "),
    *(b"close", b"keep-alive", b"Transfer-Encoding: chunked\r\n", b"identity", b"0\r\n\r\n"),
    *(b"5\r\nhello\r\n", b"a;x=y\r\n", b"A: b\r\n", b"999999999999"),
]
MAX_LEN = 500
SHARE = 5

_MAX_BYTES = 60
_MAX_HEAD = 150
"""In place of the real figure, so that inputs of a few hundred octets exceed it."""

_DIGITS = frozenset(b"0123456789")
_HEX = frozenset(b"0123456789abcdefABCDEF")


class _Wrong(Exception):
    """Not an answer, or too much."""


class _More(Exception):
    """Not all of an answer."""


class _Answer(NamedTuple):
    status: int
    reason: str
    body: bytes
    keeps_alive: bool
    size: int | None  # of the answer; None for one that only the end of the stream ends


def check(data: bytes) -> None:
    """Two octets are the sizes of the pieces; the others are what a server sends."""
    if len(data) < 2:
        return
    sizes, stream = (data[0] or 1 << 30, data[1] + 1), data[2:]
    most, http.MAX_HEAD = http.MAX_HEAD, _MAX_HEAD
    try:
        expected: _Answer | type[Exception]
        try:
            expected = _read(stream)
        except (_Wrong, _More) as error:
            expected = type(error)
        for pieces in (sizes, (1, 1), (1 << 30, 1)):
            _check_pieces(stream, pieces, expected)
    finally:
        http.MAX_HEAD = most


def _check_pieces(
    stream: bytes, sizes: tuple[int, int], expected: _Answer | type[Exception]
) -> None:
    reader = AnswerReader(max_bytes=_MAX_BYTES)
    position, turn, done = 0, 0, False
    try:
        while position < len(stream) and not done:
            piece = stream[position : position + sizes[turn % 2]]
            position, turn = position + len(piece), turn + 1
            done = reader.receive_data(piece)
            assert reader.has_begun
            assert len(reader._body) <= min(_MAX_BYTES, position), "more in memory than allowed"
            assert len(reader._rest) < _MAX_HEAD, "more of a head in memory than allowed"
    except HttpError as error:
        assert 0 < len(str(error)) < 400
        assert expected is _Wrong, f"refused: {error}"
        return
    if not done:
        assert position == len(stream)
        ended = reader.receive_eof()
        by_end = isinstance(expected, _Answer) and expected.size is None
        assert ended is by_end, f"{expected}, at its end"
        if not ended:
            assert expected is _More, f"waits for more, where it is {expected}"
            return
    assert isinstance(expected, _Answer), f"accepted, where it is {expected}"
    size = len(stream) if expected.size is None else expected.size
    assert position >= size, "complete before its end"
    assert reader.receive_eof()
    assert (reader.status, reader.reason, reader.body) == expected[:3]
    # Bytes that nobody asked for make the connection useless.
    assert reader.keeps_alive is (expected.keeps_alive and position == size)


def _read(stream: bytes) -> _Answer:
    """The answer in a stream that ends, as a slow and simple reader sees it."""
    position = 0
    while True:
        lines, position = _head(stream, position)
        version, status, reason = _status(lines[0])
        if status >= 200 or status == 101:
            break
    if status != 200:
        return _Answer(status, reason, b"", False, position)
    lengths, codings, options = [], [b"identity"], []
    for line in lines[1:]:
        if b":" not in line:
            raise _Wrong
        name, value = line.split(b":", 1)
        name, value = name.strip().lower(), value.strip()
        if name == b"content-length":
            if not 1 <= len(value) <= 15 or not _DIGITS.issuperset(value):
                raise _Wrong
            lengths.append(value)
        if name == b"transfer-encoding":
            codings.append(value.lower())
        if name == b"connection":
            options += [option.strip() for option in value.lower().split(b",")]
    if len(set(lengths)) > 1 or not {b"identity", b"chunked"}.issuperset(codings):
        raise _Wrong
    alive = b"close" not in options and (version != 0 or b"keep-alive" in options)
    if codings[-1] == b"chunked":
        body, position = _chunks(stream, position)
        return _Answer(status, reason, body, alive, position)
    if not lengths:
        body = stream[position:]
        if len(body) > _MAX_BYTES:
            raise _Wrong
        return _Answer(status, reason, body, False, None)
    length = int(lengths[0])
    if length > _MAX_BYTES:
        raise _Wrong
    if len(stream) - position < length:
        raise _More
    return _Answer(status, reason, stream[position : position + length], alive, position + length)


def _head(stream: bytes, position: int) -> tuple[list[bytes], int]:
    """The lines of a head without their ends, and where it ends; a line may be folded."""
    begin = b"HTTP/1."
    if stream[position : position + len(begin)] != begin[: len(stream) - position]:
        raise _Wrong
    lines: list[bytes] = []
    here = position
    while True:
        end = stream.find(b"\n", here)
        if end < 0 or end + 1 - position > _MAX_HEAD:
            raise _Wrong if len(stream) - position >= _MAX_HEAD else _More
        line = stream[here:end].removesuffix(b"\r")
        is_empty = end == here or stream[here : end + 1] == b"\r\n"
        here = end + 1
        if is_empty and lines:
            return lines, here
        if lines and line[:1] in (b" ", b"\t"):
            lines[-1] += b"\n" + line
        else:
            lines.append(line)


def _status(line: bytes) -> tuple[int, int, str]:
    words = line.removeprefix(b"HTTP/1.")
    version, words = words[:1], words[1:]
    code = words.lstrip(b" ")[:3]
    after = words.lstrip(b" ")[3:]
    if (
        not (version and _DIGITS.issuperset(version))
        or words[:1] != b" "
        or len(code) != 3
        or not _DIGITS.issuperset(code)
        or after[:1] not in (b"", b" ")
        or b"\n" in line
    ):
        raise _Wrong
    return int(version), int(code), after.lstrip(b" ").decode("latin-1")


def _line(stream: bytes, position: int, most: int = 1 << 30) -> tuple[bytes, int]:
    """A line without its end, and where the next begins. It is bounded, whole or not."""
    end = stream.find(b"\n", position)
    size = (len(stream) if end < 0 else end) - position
    if size >= _MAX_HEAD or size > most:
        raise _Wrong
    if end < 0:
        raise _More
    return stream[position:end].removesuffix(b"\r"), end + 1


def _chunks(stream: bytes, position: int) -> tuple[bytes, int]:
    body = b""
    while True:
        line, position = _line(stream, position)
        digits, _, _ = line.partition(b";")
        digits = digits.rstrip(b" \t")
        if not 1 <= len(digits) <= 12 or not _HEX.issuperset(digits):
            raise _Wrong
        size = int(digits, 16)
        if len(body) + size > _MAX_BYTES:
            raise _Wrong
        if size == 0:
            break
        body += stream[position : position + size]
        position += size
        if position > len(stream):
            raise _More
        line, position = _line(stream, position)
        if line:
            raise _Wrong
    left = _MAX_HEAD
    while True:
        line, after = _line(stream, position, left)
        left -= after - 1 - position
        position = after
        if not line:
            return body, position


def seeds() -> Iterator[bytes]:
    head = b"HTTP/1.1 200 OK\r\nServer: x\r\n"
    chunked = head + b"Transfer-Encoding: chunked\r\n\r\n"
    answers = [
        head + b"Content-Length: 5\r\n\r\nhello",
        head + b"Content-Length: 5\r\n\r\nhello, and more",
        head + b"Content-Length: 5\r\ncontent-length:5\r\nConnection: close\r\n\r\nhello",
        head + b"Content-Length: 61\r\n\r\n",
        head + b"\r\nuntil the end",
        head + b"\r\n" + b"x" * 61,
        b"HTTP/1.0 200\nContent-Length: 2\nConnection: a,\n keep-alive\n\nhi",
        b"HTTP/1.1 100 Continue\r\n\r\nHTTP/1.1 102 Wait\r\n\r\n"
        + head
        + b"Content-Length:0\r\n\r\n",
        b"HTTP/1.0 200 OK\r\nContent-Length: 2\r\n\r\nhi",
        b"HTTP/1.1 404 Not Found\r\nContent-Length: 5\r\n\r\nsorry",
        b"HTTP/1.1 101 Switching\r\n\r\n",
        chunked + b"5\r\nhello\r\n3;a=b\r\nyou\r\n0\r\n\r\n",
        chunked + b"5 \nhello\n0\nA: b\nC: d\n\nmore",
        chunked + b"fff\r\n",
        chunked + b"1\r\nab\r\n",
        chunked + b"0\r\n" + b"A: 4567890\r\n" * 16 + b"\r\n",
        head + b"A: " + b"b" * 150,
        b"SSH-2.0-OpenSSH\r\n",
    ]
    for answer in answers:
        for sizes in (b"\0\0", b"\3\x10", b"\x28\0"):
            yield sizes + answer
            yield sizes + answer[:-1]
