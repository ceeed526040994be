"""How a stream of bytes is cut into frames, without a socket."""

from __future__ import annotations

import struct
import tracemalloc
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from aioros1.wire.frames import DIRECT, FrameError, FrameReceiver, frame_parts

SCRATCH = 4 * DIRECT
"""A receive buffer much smaller than the real one, so that little data overflows it."""


def frame(body: bytes) -> bytes:
    return struct.pack("<I", len(body)) + body


class Sink:
    """Keeps the frames, and how many came together."""

    def __init__(self) -> None:
        self.bodies: list[bytes] = []
        self.calls: list[int] = []

    def batch(self, data: bytes | memoryview) -> Any:
        return data

    def frames(self, frames: list[tuple[Any, int, int]]) -> None:
        self.calls.append(len(frames))
        self.bodies += [bytes(data[start:stop]) for data, start, stop in frames]


class Receiver:
    """A :class:`FrameReceiver` that is given bytes as a socket would."""

    def __init__(self, *, max_bytes: int = 1 << 30, scratch: int = SCRATCH) -> None:
        self.sink = Sink()
        self.receiver = FrameReceiver(
            self.sink, memoryview(bytearray(scratch)), max_bytes=max_bytes
        )

    def read(self, data: bytes, *, piece: int = 1 << 30) -> None:
        """Reads of at most ``piece`` bytes, each into whatever buffer there is for it."""
        view = memoryview(data)
        while view:
            view = view[self._read_once(view[:piece]) :]

    def _read_once(self, data: memoryview) -> int:
        # A function of its own, because event loops let go of the buffer after each read.
        buffer = self.receiver.buffer()
        assert len(buffer), "a socket cannot read into an empty buffer"
        count = min(len(buffer), len(data))
        buffer[:count] = data[:count]
        self.receiver.received(count)
        return count

    @property
    def bodies(self) -> list[bytes]:
        return self.sink.bodies


def bodies_of(*lengths: int) -> list[bytes]:
    return [bytes([index % 251]) * length for index, length in enumerate(lengths)]


SMALL_AND_LARGE = bodies_of(1, 0, DIRECT, 3, DIRECT + 1, 0, SCRATCH, SCRATCH - 4, 10 * SCRATCH, 7)


def test_many_frames_in_one_read_are_handed_over_at_once():
    receiver = Receiver()
    bodies = bodies_of(*range(100))
    receiver.read(b"".join(map(frame, bodies)))
    assert receiver.bodies == bodies
    assert receiver.sink.calls == [100]


@pytest.mark.parametrize("piece", [1, 2, 3, 5, DIRECT - 1, DIRECT + 3, 1 << 30])
def test_pieces_of_any_size_give_the_same_frames(piece):
    receiver = Receiver()
    stream = b"".join(map(frame, SMALL_AND_LARGE))
    receiver.read(stream, piece=piece)
    assert receiver.bodies == SMALL_AND_LARGE
    assert receiver.receiver.frames_received == len(SMALL_AND_LARGE)
    assert receiver.receiver.bytes_received == len(stream)


def test_frames_of_no_bytes_are_frames():
    # std_msgs/Empty
    receiver = Receiver()
    receiver.read(frame(b"") * 5, piece=3)
    assert receiver.bodies == [b""] * 5


@pytest.mark.parametrize("over", [-5, -4, -1, 0, 1])
def test_a_frame_as_large_as_the_receive_buffer_and_around_it(over):
    receiver = Receiver()
    bodies = bodies_of(2, SCRATCH + over, 3)
    receiver.read(b"".join(map(frame, bodies)))
    assert receiver.bodies == bodies


def test_a_large_frame_is_received_into_memory_of_its_own():
    receiver = Receiver()
    body = bytes(10 * SCRATCH)
    receiver.read(frame(body)[:SCRATCH])
    # Nothing of the next frame can be read by mistake: the buffer ends with this one.
    assert len(receiver.receiver.buffer()) == 4 + len(body) - SCRATCH
    receiver.read(frame(body)[SCRATCH:] + frame(b"next"))
    assert receiver.bodies == [body, b"next"]


def test_the_frames_before_one_beyond_the_limit_are_delivered_first():
    receiver = Receiver(max_bytes=100)
    good = bodies_of(1, 100, 0)
    with pytest.raises(FrameError, match="a message of 4294967295 bytes, more than 100"):
        receiver.read(b"".join(map(frame, good)) + b"\xff\xff\xff\xff" + b"more")
    assert receiver.bodies == good
    assert receiver.receiver.frames_received == 3


def test_the_limit_itself_is_allowed_and_one_more_is_not():
    receiver = Receiver(max_bytes=2 * SCRATCH)
    receiver.read(frame(bytes(2 * SCRATCH)))
    with pytest.raises(FrameError):
        receiver.read(struct.pack("<I", 2 * SCRATCH + 1))
    assert receiver.bodies == [bytes(2 * SCRATCH)]


def test_memory_grows_with_the_bytes_that_come_and_not_with_the_length():
    receiver = Receiver(max_bytes=1_000_000_000)
    announced = struct.pack("<I", 900_000_000)
    tracemalloc.start()
    try:
        receiver.read(announced + bytes(100_000))
        little = tracemalloc.get_traced_memory()[1]
        receiver.read(bytes(8_000_000))
        more = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert little < 8_000_000
    assert more < 50_000_000  # growing means copying, so some times what came is needed
    assert receiver.bodies == []


def test_bytes_that_came_behind_the_connection_header_are_fed():
    receiver = Receiver()
    stream = b"".join(map(frame, SMALL_AND_LARGE))
    half = len(stream) // 2
    receiver.receiver.feed(stream[:half])
    receiver.read(stream[half:])
    assert receiver.bodies == SMALL_AND_LARGE
    assert receiver.receiver.bytes_received == len(stream)


def test_a_frame_larger_than_what_was_reserved_for_it_is_fed():
    receiver = Receiver()
    body = bytes(range(256)) * 20_000  # more than is reserved for a first large frame
    receiver.receiver.feed(frame(body) + frame(b"next"))
    assert receiver.bodies == [body, b"next"]


@given(
    st.lists(
        st.one_of(st.binary(max_size=40), st.integers(0, 3 * DIRECT).map(lambda n: b"\x5a" * n)),
        max_size=12,
    ),
    st.data(),
)
def test_any_frames_cut_anywhere_arrive_identical_and_in_order(bodies, data):
    stream = b"".join(map(frame, bodies))
    cuts = sorted(data.draw(st.lists(st.integers(0, len(stream)), max_size=12)))
    fed = data.draw(st.booleans())
    receiver = Receiver(scratch=2 * DIRECT)
    for index, (begin, end) in enumerate(zip([0, *cuts], [*cuts, len(stream)], strict=True)):
        if fed and not index:
            receiver.receiver.feed(stream[begin:end])
        else:
            receiver.read(stream[begin:end])
    assert receiver.bodies == bodies


# what is sent


@pytest.mark.parametrize("kind", [bytes, bytearray, memoryview])
def test_a_short_body_is_joined_with_its_length(kind):
    assert frame_parts(kind(b"abc"), join=4) == b"\x03\x00\x00\x00abc"


def test_a_long_body_is_not_copied():
    body = bytes(100)
    parts = frame_parts(body, join=100)
    assert parts == [b"\x64\x00\x00\x00", body]
    assert parts[1] is body


@pytest.mark.parametrize("kind", [bytearray, lambda data: memoryview(bytearray(data))])
def test_a_long_body_that_its_owner_can_change_is_copied(kind):
    body = kind(bytes(100))
    parts = frame_parts(body, join=10)
    body[0] = 1
    assert parts == [b"\x64\x00\x00\x00", bytes(100)]


def test_a_body_of_wide_items_counts_bytes():
    assert frame_parts(memoryview(bytes(8)).cast("d"), join=100) == b"\x08\x00\x00\x00" + bytes(8)
