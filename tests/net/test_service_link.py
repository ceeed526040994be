"""The data phase of service connections."""

from __future__ import annotations

import asyncio
import contextlib
import socket
import struct
import tracemalloc

import pytest

from aioros1.net.service_link import ServiceLink
from aioros1.net.tcpros import Stream, take_over
from aioros1.wire.service import ANSWER_HEAD, REQUEST_HEAD, ServiceFrameError

from .sockets import drop, hear, say

Pair = tuple[ServiceLink, socket.socket]
LIMIT = 2_000_000


def request(body: bytes) -> bytes:
    return struct.pack("<I", len(body)) + body


async def make_link(stream: Stream, head: int = REQUEST_HEAD) -> ServiceLink:
    link = ServiceLink(stream, head=head, max_bytes=LIMIT, patience=0.2, stall=0.2)
    link.data_received(await take_over(stream, link))
    return link


async def write(link: ServiceLink, data: bytes) -> None:
    link.write(data)
    await link.drain()


@pytest.fixture
async def linked(pair: tuple[Stream, socket.socket]) -> Pair:
    """The side of a provider, and the bare socket of a caller."""
    stream, peer = pair
    return await make_link(stream), peer


@pytest.mark.parametrize("count", [0, 1, 65_535, 65_536, 65_537, 1_000_000])
async def test_frames_come_whole_whatever_their_size(linked: Pair, count: int) -> None:
    link, peer = linked
    frame = request((bytes(range(256)) * (count // 256 + 1))[:count])
    saying = asyncio.create_task(say(peer, frame + frame + request(b"rest")))
    for expected in (frame, frame, request(b"rest")):
        assert await link.receive(patience=5) == expected
    assert link.is_fresh
    await saying


async def test_a_frame_byte_by_byte(linked: Pair) -> None:
    link, peer = linked
    receiving = asyncio.create_task(link.receive(patience=5))
    for byte in request(b"abc"):
        await say(peer, bytes([byte]))
        await asyncio.sleep(0)
    assert await receiving == request(b"abc")


async def test_the_head_of_an_answer_has_one_byte_more(
    pair: tuple[Stream, socket.socket],
) -> None:
    stream, peer = pair
    link = await make_link(stream, ANSWER_HEAD)
    await say(peer, b"\1" + request(b"yes") + b"\0" + request(b"no"))
    assert await link.receive(patience=5) == b"\1" + request(b"yes")
    assert await link.receive(patience=5) == b"\0" + request(b"no")


async def test_what_came_behind_the_header_is_not_lost(
    pair: tuple[Stream, socket.socket],
) -> None:
    stream, peer = pair
    await say(peer, b"head" + request(b"abc"))
    assert await stream.reader.readexactly(4) == b"head"
    link = await make_link(stream)
    assert await link.receive(patience=5) == request(b"abc")


async def test_the_end_between_frames_and_inside_one(linked: Pair) -> None:
    link, peer = linked
    await say(peer, request(b"abc") + request(b"def")[:-1])
    peer.shutdown(socket.SHUT_WR)
    assert await link.receive(patience=5) == request(b"abc")
    assert await link.receive(patience=5) is None
    assert not link.is_fresh
    # It has closed its own direction only, and still gets its answer.
    await write(link, b"answer")
    assert await hear(peer) == b"answer"


async def test_a_frame_beyond_the_limit_is_not_waited_for(linked: Pair) -> None:
    link, peer = linked
    await say(peer, struct.pack("<I", LIMIT + 1))
    with pytest.raises(ServiceFrameError, match=f"{LIMIT + 1} bytes"):
        await link.receive(patience=5)


@pytest.mark.parametrize("data", [b"", b"\1", request(b"abc")[:-1], request(bytes(200_000))[:-1]])
async def test_what_does_not_come_is_not_waited_for(linked: Pair, data: bytes) -> None:
    link, peer = linked
    saying = asyncio.create_task(say(peer, data))
    with pytest.raises(TimeoutError, match=r"sent nothing for 0\.\d+ s"):
        await link.receive(patience=0.05)
    await saying


async def test_without_patience_the_first_byte_may_take_its_time(linked: Pair) -> None:
    link, peer = linked
    receiving = asyncio.create_task(link.receive(patience=None))
    await asyncio.sleep(0.3)  # longer than anything inside a frame may take
    await say(peer, request(b"abc"))
    assert await receiving == request(b"abc")


async def test_patience_is_for_the_next_piece_and_not_for_the_whole(linked: Pair) -> None:
    link, peer = linked

    async def trickle() -> None:
        await say(peer, struct.pack("<I", 200_000))
        for _ in range(10):
            await asyncio.sleep(0.03)
            await say(peer, bytes(20_000))

    trickling = asyncio.create_task(trickle())
    assert await link.receive(patience=5) == request(bytes(200_000))
    await trickling


async def test_memory_is_not_taken_on_the_word_of_a_length(linked: Pair) -> None:
    link, peer = linked
    await say(peer, struct.pack("<I", LIMIT) + bytes(50_000))
    tracemalloc.start()
    try:
        with pytest.raises(TimeoutError):
            await link.receive(patience=0.05)
        assert tracemalloc.get_traced_memory()[1] < 1_000_000
    finally:
        tracemalloc.stop()


async def test_what_nobody_asks_for_is_not_read_without_end(linked: Pair) -> None:
    link, peer = linked
    flood = asyncio.create_task(say(peer, request(b"x" * 1000) * 5000))
    async with asyncio.timeout(30):
        while link.is_fresh:
            await asyncio.sleep(0)
    for _ in range(100):
        await asyncio.sleep(0)
    assert not flood.done()
    for _ in range(5000):
        assert await link.receive(patience=5) == request(b"x" * 1000)
    await flood


async def test_a_cancelled_wait_leaves_the_frame_to_the_next(linked: Pair) -> None:
    link, peer = linked
    receiving = asyncio.create_task(link.receive(patience=5))
    await asyncio.sleep(0)
    receiving.cancel()
    with pytest.raises(asyncio.CancelledError):
        await receiving
    await say(peer, request(b"abc"))
    assert await link.receive(patience=5) == request(b"abc")


async def test_a_peer_that_takes_nothing_is_given_up(linked: Pair) -> None:
    link, _ = linked
    with pytest.raises(TimeoutError, match=r"took nothing for 0\.2 s"):
        await write(link, bytes(5_000_000))


async def test_a_peer_that_is_slow_is_not_given_up(linked: Pair) -> None:
    link, peer = linked
    writing = asyncio.create_task(write(link, bytes(3_000_000)))
    taken = 0
    while not writing.done():
        taken += len(await hear(peer))
        await asyncio.sleep(0.03)
    await writing
    assert taken > 2_000_000


async def test_a_connection_that_is_lost_while_writing_or_waiting(linked: Pair) -> None:
    link, peer = linked
    writing = asyncio.create_task(write(link, bytes(5_000_000)))
    receiving = asyncio.create_task(link.receive(patience=5))
    await asyncio.sleep(0)
    link.abort()
    with pytest.raises(OSError, match="connection lost"):
        await writing
    assert await receiving is None
    with pytest.raises(OSError, match="connection lost"):
        await write(link, b"more")
    assert not link.is_fresh
    peer.close()


async def test_whoever_receives_sees_the_end_when_reading_is_stopped(linked: Pair) -> None:
    link, peer = linked
    receiving = asyncio.create_task(link.receive(patience=None))
    await asyncio.sleep(0)
    link.stop_reading()
    assert await receiving is None
    await write(link, b"but it can still be written to")
    assert (await hear(peer)).startswith(b"but")


async def test_a_reset_is_an_error(listening: socket.socket) -> None:
    loop = asyncio.get_running_loop()
    stream = Stream(*await asyncio.open_connection(*listening.getsockname()[:2]))
    peer, _ = await loop.sock_accept(listening)
    link = await make_link(stream)
    receiving = asyncio.create_task(link.receive(patience=None))
    await asyncio.sleep(0)
    peer.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
    peer.close()
    with contextlib.suppress(OSError):  # a reset is an error or, to some systems, an end
        assert await receiving is None
    assert not link.is_fresh
    await drop(stream)


async def test_frames_that_are_answered_at_once_need_nobody_to_receive_them(linked: Pair) -> None:
    link, peer = linked
    link.at_once = lambda frame: link.write(frame[4:])  # None: there is nothing left to do
    receiving = asyncio.create_task(link.receive(patience=None))
    await asyncio.sleep(0)
    for body in (b"abc", b"def"):
        await say(peer, request(body))
        assert await hear(peer) == body
    assert not receiving.done()
    link.at_once = lambda frame: ("begun", frame)
    await say(peer, request(b"ghi"))
    assert await receiving == ("begun", request(b"ghi"))
