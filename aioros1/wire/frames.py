"""Frames: the length-prefixed messages of a TCPROS topic connection.

:class:`FrameReceiver` is the receiving half of a ``BufferedProtocol`` without the
protocol: it says where the next bytes should go and, told how many came, which
frames are complete.

Small frames are taken in batches: what one read of the socket brought is copied out of the
receive buffer once, as one ``bytes``, and a frame is a position in it. So a read that brings
thousands of messages costs one copy. A frame larger than :data:`DIRECT` is received directly
into memory of its own. That memory grows with the data received, not with the length
announced, so a peer that announces a gigabyte and sends nothing costs nothing.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from itertools import repeat
from typing import Any, Protocol

from aioros1.wire.allocation import keep_memory

__all__ = ["DIRECT", "READ", "FrameError", "FrameReceiver", "FrameSink", "frame_parts"]

READ = 256 * 1024
"""Bytes read from a socket at a time. Larger reads gain nothing on loopback."""

DIRECT = 4 * 1024
"""A frame with more bytes than this still missing gets memory of its own. Otherwise its
beginning is kept and put in front of the next read. This is small, so that little is copied
for a peer that sends byte by byte."""

_MANY = 1024
"""The least number of bytes for which :func:`_uniform` is worth a try."""

_FIRST_GUESS = 1 << 20
"""Bytes allocated at first for a large frame, until a larger frame was seen."""

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
    """Return ``body`` with its length in front, in one piece if it is shorter than ``join``
    bytes. A longer one is in two pieces, and copied only if its owner can change it."""
    view = memoryview(body)
    prefix = _U32.pack(view.nbytes)
    if view.nbytes < join:
        return b"".join((prefix, view))
    return [prefix, body if type(body) is bytes else bytes(view)]


class FrameReceiver:
    """Cuts a stream of bytes into frames for one ``sink``.

    ``scratch`` is the receive buffer. The connections of one event loop may share it,
    because no other code runs between :meth:`buffer` and :meth:`received`. ``on_large(size)`` is
    called when a large frame takes that much memory, with 0 once it is complete.
    """

    __slots__ = (
        "_filled",
        "_large",
        "_largest",
        "_max_bytes",
        "_on_large",
        "_scratch",
        "_sink",
        "_tail",
        "_view",
        "_wanted",
        "bytes_received",
        "frames_received",
    )

    def __init__(
        self,
        sink: FrameSink,
        scratch: memoryview,
        *,
        max_bytes: int,
        on_large: Callable[[int], object] | None = None,
    ) -> None:
        self._sink = sink
        self._scratch = scratch
        self._max_bytes = max_bytes
        self._on_large = on_large
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
        """Return the memory that the next bytes go into."""
        large = self._large
        if large is None:
            return self._scratch
        if self._filled == len(large):
            # Not extended in place, because whoever wrote to it may still have a view of it.
            grown = bytearray(min(2 * len(large), self._wanted))
            grown[: self._filled] = large
            self._large = large = grown
            self._view = None
            if self._on_large is not None:
                self._on_large(len(grown))
        if self._view is None:
            self._view = memoryview(large)
        return self._view[self._filled :]

    def received(self, count: int) -> None:
        """Process ``count`` bytes that were written to :meth:`buffer`.

        Raises :class:`FrameError` for a frame beyond the limit. The frames before it have
        been handed over by then, and the connection cannot be used any more.
        """
        self.bytes_received += count
        if self._large is None:
            data = bytes(self._scratch[:count])
            if self._tail or count < 4 or _unpack(data)[0] + 4 != count or count > self._max_bytes:
                self._cut(data)
            else:  # one whole message: the usual case at low rates
                self.frames_received += 1
                self._sink.frames([(self._sink.batch(data), 4, count)])
            return
        self._filled += count
        if self._filled == self._wanted:
            whole = memoryview(self._large).toreadonly()
            self._large = self._view = None
            if self._on_large is not None:
                self._on_large(0)
            self._largest = max(self._largest, self._wanted)
            keep_memory(self._wanted)
            self.frames_received += 1
            self._sink.frames([(self._sink.batch(whole), 0, self._wanted)])

    def block(self, data: bytes | memoryview) -> None:
        """Take bytes that were received elsewhere and will not change. Complete frames are
        not copied."""
        if self._large is None and isinstance(data, bytes):
            self.bytes_received += len(data)
            self._cut(data)
        else:
            self.feed(data)

    def feed(self, data: bytes | memoryview) -> None:
        """Take bytes that were received elsewhere, and copy them."""
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
        """Keep the beginning of a frame whose end has not come yet."""
        have = len(data) - start
        if length - have <= DIRECT:
            self._tail = data[start - 4 :]
            return
        # Not bytearray(length), which would let a peer decide how much memory is used.
        self._large = bytearray(min(length, max(self._largest, 2 * have)))
        self._large[:have] = memoryview(data)[start:]
        self._filled = have
        self._wanted = length
        if self._on_large is not None:
            self._on_large(len(self._large))


def _uniform(data: bytes, batch: Any, limit: int) -> tuple[list[tuple[Any, int, int]], int]:
    """Return the frames of ``data`` if all of them have the same length, and where they end.

    The messages of a topic mostly have the same length. Comparing all lengths at once, byte
    by byte, and making the list without a loop takes 45 ns a frame; the loop takes 90.
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
