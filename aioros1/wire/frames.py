"""Frames: the length-prefixed messages of a TCPROS topic connection.

:class:`FrameReceiver` is the receiving half of a ``BufferedProtocol`` without the
protocol: it says where the next bytes should go and, told how many came, which
frames are complete.

Small frames are taken in batches. What one read of the socket brought is copied out
of the receive buffer once, as one ``bytes``, and a frame is a position in it; so a
read that brings thousands of messages costs one copy, not thousands. A frame larger
than :data:`DIRECT` is received straight into memory of its own. That memory grows
with the data that came and not with the length announced, so a peer that announces
a gigabyte and sends nothing costs nothing.
"""

from __future__ import annotations

import struct
from itertools import repeat
from typing import Any, Protocol

from aioros1.wire.allocation import keep_memory

__all__ = ["DIRECT", "READ", "FrameError", "FrameReceiver", "FrameSink", "frame_parts"]

READ = 256 * 1024
"""Bytes asked of the socket at a time. Larger reads gain nothing on loopback."""

DIRECT = 4 * 1024
"""A frame with more than this still to come gets memory of its own. Less is kept and
put in front of the next read: small, so that a peer that sends byte by byte makes us
copy little, and that a read of many small messages is not cut short for one of them."""

_MANY = 1024
"""Bytes from which on it is worth a look whether all frames in them are of one length."""

_FIRST_GUESS = 1 << 20
"""Bytes reserved at first for a frame of its own, when no frame as large was seen yet."""

_U32 = struct.Struct("<I")
_unpack = _U32.unpack_from


class FrameError(ValueError):
    """A frame longer than the limit."""


class FrameSink(Protocol):
    """Takes the frames of one connection, in order.

    A frame is ``(batch, start, stop)``: ``batch`` is what :meth:`batch` returned for
    the data it lies in, so that what belongs to many frames (their bytes, where they
    came from, when) is stored once.
    """

    def batch(self, data: bytes | memoryview) -> Any:
        """Wrap data that holds one or more whole frames."""

    def frames(self, frames: list[tuple[Any, int, int]]) -> None:
        """Take the next frames."""


def frame_parts(body: bytes | bytearray | memoryview, *, join: int) -> bytes | list[bytes]:
    """``body`` with its length in front: in one piece if shorter than ``join`` bytes.

    A long one is not copied to be prefixed. One that its owner can change is copied.
    """
    view = memoryview(body)
    prefix = _U32.pack(view.nbytes)
    if view.nbytes < join:
        return b"".join((prefix, view))
    return [prefix, body if type(body) is bytes else bytes(view)]


class FrameReceiver:
    """Cuts a stream of bytes into frames for one ``sink``.

    ``scratch`` is the receive buffer; connections served by one loop may share one,
    because between :meth:`buffer` and :meth:`received` nothing else runs.
    """

    __slots__ = (
        "_filled",
        "_large",
        "_largest",
        "_max_bytes",
        "_scratch",
        "_sink",
        "_tail",
        "_view",
        "_wanted",
        "bytes_received",
        "frames_received",
    )

    def __init__(self, sink: FrameSink, scratch: memoryview, *, max_bytes: int) -> None:
        self._sink = sink
        self._scratch = scratch
        self._max_bytes = max_bytes
        self._tail = b""
        self._large: bytearray | None = None
        self._view: memoryview | None = None
        self._filled = 0
        self._wanted = 0
        self._largest = _FIRST_GUESS
        self.bytes_received = 0
        """Bytes so far, the lengths of frames included."""
        self.frames_received = 0
        """Whole frames so far."""

    def __repr__(self) -> str:
        missing = 0 if self._large is None else self._wanted - self._filled
        within = f", {missing} bytes of the next are missing" if missing else ""
        return (
            f"<FrameReceiver, {self.frames_received} frames in {self.bytes_received} bytes{within}>"
        )

    def buffer(self) -> memoryview:
        """Where the next bytes go."""
        large = self._large
        if large is None:
            return self._scratch
        if self._filled == len(large):
            # Not extended in place: who received into it last may still look at it.
            grown = bytearray(min(2 * len(large), self._wanted))
            grown[: self._filled] = large
            self._large = large = grown
            self._view = None
        if self._view is None:
            self._view = memoryview(large)
        return self._view[self._filled :]

    def received(self, count: int) -> None:
        """Take note of ``count`` bytes written to :meth:`buffer`.

        Raises :class:`FrameError` for a frame beyond the limit; the frames before
        it have been handed over by then, and the connection is of no more use.
        """
        self.bytes_received += count
        if self._large is None:
            data = bytes(self._scratch[:count])
            if self._tail or count < 4 or _unpack(data)[0] + 4 != count or count > self._max_bytes:
                self._cut(data)
            else:  # one message alone: what comes now and then comes like that
                self.frames_received += 1
                self._sink.frames([(self._sink.batch(data), 4, count)])
            return
        self._filled += count
        if self._filled == self._wanted:
            whole = memoryview(self._large).toreadonly()
            self._large = self._view = None
            self._largest = max(self._largest, self._wanted)
            keep_memory(self._wanted)
            self.frames_received += 1
            self._sink.frames([(self._sink.batch(whole), 0, self._wanted)])

    def block(self, data: bytes | memoryview) -> None:
        """Take bytes that were received elsewhere, and will not change: without a copy,
        where they are whole frames."""
        if self._large is None and isinstance(data, bytes):
            self.bytes_received += len(data)
            self._cut(data)
        else:
            self.feed(data)

    def feed(self, data: bytes | memoryview) -> None:
        """Take bytes that were received elsewhere, behind the connection header."""
        while data:
            room = self.buffer()
            count = min(len(room), len(data))
            room[:count] = data[:count]
            self.received(count)
            data = data[count:]

    def _cut(self, data: bytes) -> None:
        if self._tail:
            data = self._tail + data
            self._tail = b""
        batch = self._sink.batch(data)
        limit = self._max_bytes
        frames, position = _uniform(data, batch, limit) if len(data) >= _MANY else ([], 0)
        add, end = frames.append, len(data)
        failure = None
        while end - position >= 4:
            start = position + 4
            length = _unpack(data, position)[0]
            if length > limit:
                failure = FrameError(f"a message of {length} bytes, more than {limit}")
                break
            stop = start + length
            if stop > end:
                self._keep(data, start, length)
                break
            add((batch, start, stop))
            position = stop
        else:
            self._tail = data[position:]
        if frames:
            self.frames_received += len(frames)
            self._sink.frames(frames)
        if failure is not None:
            raise failure

    def _keep(self, data: bytes, start: int, length: int) -> None:
        """Keep what came of a frame whose end has not come yet."""
        have = len(data) - start
        if length - have <= DIRECT:
            self._tail = data[start - 4 :]
            return
        # Not bytearray(length): that would be memory on the word of a peer.
        self._large = bytearray(min(length, max(self._largest, 2 * have)))
        self._large[:have] = memoryview(data)[start:]
        self._filled = have
        self._wanted = length


def _uniform(data: bytes, batch: Any, limit: int) -> tuple[list[tuple[Any, int, int]], int]:
    """The frames at the beginning of ``data`` if all there have the same length; and how far
    they go.

    The messages of a topic mostly have the same length. To compare the lengths of a whole
    read at once, octet by octet, and to make the list without a loop takes 45 ns a frame;
    the loop takes 90.
    """
    prefix = data[:4]
    length = _unpack(prefix)[0]
    stride = 4 + length
    count = len(data) // stride
    stop = count * stride
    if count < 8 or length > limit:
        return [], 0
    for place in range(4):
        if data[place:stop:stride] != prefix[place : place + 1] * count:
            return [], 0
    ends = range(stride, stop + 1, stride)
    return list(zip(repeat(batch), range(4, stop, stride), ends, strict=False)), stop
