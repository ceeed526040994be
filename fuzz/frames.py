"""A stream of octets cut into frames, whatever the sizes of the reads."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from aioros1.wire import frames
from aioros1.wire.frames import FrameError, FrameReceiver, frame_parts
from aioros1.wire.service import ServiceFrameError, encode_failure, frame_length

__all__ = ["check", "seeds"]

TOKENS = [b"\x01\0\0\0", b"\0\0\0\0", b"\xff\xff\xff\xff", b"\0\1\0\0", b"\0\4\0\0"]
MAX_LEN = 600
SHARE = 12

_MAX_BYTES = 400
_DIRECT = 64
"""In place of the real figure, so that inputs of a few hundred octets exceed it."""


class _Sink:
    def __init__(self) -> None:
        self.bodies: list[bytes] = []

    def batch(self, data: bytes | memoryview) -> Any:
        return data

    def frames(self, found: list[tuple[Any, int, int]]) -> None:
        assert found, "called for nothing"
        self.bodies += [bytes(data[start:stop]) for data, start, stop in found]


def check(data: bytes) -> None:
    """The first two octets are the sizes of the reads; the others are the stream."""
    if len(data) < 2:
        return
    sizes = (data[0] or 1 << 30, data[1] + 1)
    stream = data[2:]
    bodies, broken = _expected(stream)
    direct, frames.DIRECT = frames.DIRECT, _DIRECT
    try:
        _check_reads(stream, sizes, bodies, broken)
        _check_feed(stream, bodies, broken)
    finally:
        frames.DIRECT = direct
    for body in bodies:
        for join in (0, 1 << 20):
            parts = frame_parts(body, join=join)
            whole = parts if isinstance(parts, bytes) else b"".join(parts)
            assert whole == len(body).to_bytes(4, "little") + body
    if len(stream) >= 4:
        try:
            assert 0 <= frame_length(stream[:4], _MAX_BYTES) <= _MAX_BYTES
        except ServiceFrameError:
            assert broken
    failure = encode_failure(stream.decode("utf-8", "surrogateescape"))
    assert failure == b"\0" + len(stream).to_bytes(4, "little") + stream


def _expected(stream: bytes) -> tuple[list[bytes], bool]:
    bodies, position = [], 0
    while len(stream) - position >= 4:
        length = int.from_bytes(stream[position : position + 4], "little")
        if length > _MAX_BYTES:
            return bodies, True
        stop = position + 4 + length
        if stop > len(stream):
            break
        bodies.append(stream[position + 4 : stop])
        position = stop
    return bodies, False


def _check_reads(stream: bytes, sizes: tuple[int, int], bodies: list[bytes], broken: bool) -> None:
    sink = _Sink()
    receiver = FrameReceiver(sink, memoryview(bytearray(256)), max_bytes=_MAX_BYTES)
    position, turn = 0, 0
    try:
        while position < len(stream):
            buffer = receiver.buffer()
            assert len(buffer) > 0, "a socket cannot read into an empty buffer"
            assert len(buffer) <= frames._FIRST_GUESS, "memory on the word of a peer"
            count = min(len(buffer), sizes[turn % 2], len(stream) - position)
            buffer[:count] = stream[position : position + count]
            position, turn = position + count, turn + 1
            receiver.received(count)
    except FrameError:
        assert broken, "refused a stream that is fine"
    else:
        assert not broken, "took a frame beyond the limit"
    assert sink.bodies == bodies
    assert receiver.frames_received == len(bodies)
    assert receiver.bytes_received == position


def _check_feed(stream: bytes, bodies: list[bytes], broken: bool) -> None:
    sink = _Sink()
    receiver = FrameReceiver(sink, memoryview(bytearray(256)), max_bytes=_MAX_BYTES)
    try:
        receiver.feed(stream)
    except FrameError:
        assert broken
    else:
        assert not broken
    assert sink.bodies == bodies


def seeds() -> Iterator[bytes]:
    def frame(size: int) -> bytes:
        return size.to_bytes(4, "little") + bytes(size)

    for sizes in (b"\0\0", b"\1\1", b"\5\x40", b"\x40\3", b"\xff\xff"):
        yield sizes + frame(0) + frame(1) + frame(5)
        yield sizes + frame(300) + frame(2) + frame(70) + frame(120)
        yield sizes + frame(3) + b"\xff\xff\xff\xff"
        yield sizes + frame(200)[:-1]
        yield sizes + frame(400)
        yield sizes + frame(80) + frame(401)
