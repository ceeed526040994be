"""Transports without a socket, beside those with one: what a protocol sees must be the same."""

from __future__ import annotations

import asyncio
import contextlib
import socket
from collections.abc import AsyncIterator, Callable
from typing import Any

import pytest

from aioros1.net.in_process import CAPACITY, connect_in_memory
from aioros1.net.tcpros import Stream, take_over

Pair = tuple[Any, Any]  # of transports


class Recorder(asyncio.Protocol):
    """Keeps what it is told, in order."""

    keeps_open = False

    def __init__(self) -> None:
        self.events: list[str] = []
        self.data = bytearray()
        self.error: Exception | None = None
        self.transport: Any = None

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        self.transport = transport
        self.events.append("made")

    def data_received(self, data: bytes) -> None:
        self.data += data

    def eof_received(self) -> bool:
        self.events.append("eof")
        return self.keeps_open

    def pause_writing(self) -> None:
        self.events.append("pause")

    def resume_writing(self) -> None:
        self.events.append("resume")

    def connection_lost(self, exc: Exception | None) -> None:
        self.error = exc
        self.events.append("lost")


class Buffered(Recorder, asyncio.BufferedProtocol):
    """The same, with memory of its own to receive into."""

    def __init__(self) -> None:
        super().__init__()
        self._buffer = bytearray(1000)

    def get_buffer(self, sizehint: int) -> bytearray:
        return self._buffer

    def buffer_updated(self, nbytes: int) -> None:
        self.data_received(bytes(self._buffer[:nbytes]))


async def over_sockets(one: asyncio.BaseProtocol, other: asyncio.BaseProtocol) -> Pair:
    loop = asyncio.get_running_loop()
    transports = []
    for sock, protocol in zip(socket.socketpair(), (one, other), strict=True):
        # uvloop's `lambda` would be called later, when `protocol` is another one.
        def factory(protocol: asyncio.BaseProtocol = protocol) -> asyncio.BaseProtocol:
            return protocol

        sock.setblocking(False)
        transport, _ = await loop.create_unix_connection(factory, sock=sock)
        transports.append(transport)
    return transports[0], transports[1]


async def over_memory(one: asyncio.BaseProtocol, other: asyncio.BaseProtocol) -> Pair:
    return connect_in_memory(one, other)


@pytest.fixture(params=[over_sockets, over_memory])
async def join(request) -> AsyncIterator[Callable[..., Any]]:
    """``await join(protocol, other)``: the two transports, over each kind of connection."""
    made: list[Any] = []

    async def join(one: asyncio.BaseProtocol, other: asyncio.BaseProtocol) -> Pair:
        pair = await request.param(one, other)
        made.extend(pair)
        return pair

    yield join
    for transport in made:
        if not transport.is_closing():
            transport.abort()
    await settle()


async def settle() -> None:
    for _ in range(5):
        await asyncio.sleep(0)


async def eventually(condition: Callable[[], object]) -> None:
    async with asyncio.timeout(30):
        while not condition():
            await asyncio.sleep(0.001)


# the same over both


@pytest.mark.parametrize("kind", [Recorder, Buffered])
async def test_what_is_written_arrives_in_order(join, kind):
    a, b = Recorder(), kind()
    transport, _ = await join(a, b)
    parts = [bytes([i % 256]) * (i * 7 % 5000) for i in range(300)]
    for part in parts:
        transport.write(part)
    transport.writelines([b"last ", bytearray(b"of "), memoryview(b"-all")[1:]])
    expected = b"".join(parts) + b"last of all"
    await eventually(lambda: len(b.data) == len(expected))
    assert b.data == expected


async def test_both_ways_at_a_time(join):
    a, b = Recorder(), Recorder()
    one, other = await join(a, b)
    for i in range(100):
        one.write(b"%d," % i)
        other.write(b"%d;" % i)
    await eventually(lambda: b.data.endswith(b"99,") and a.data.endswith(b"99;"))
    assert bytes(a.data).replace(b";", b",") == b.data


@pytest.mark.parametrize("kind", [Recorder, Buffered])
async def test_who_does_not_read_makes_the_writer_pause(join, kind):
    a, b = Recorder(), kind()
    writing, reading = await join(a, b)
    writing.set_write_buffer_limits(high=0)
    reading.pause_reading()
    assert not reading.is_reading()
    block = bytes(range(256)) * 256
    count = 0
    while "pause" not in a.events:
        writing.write(block)
        count += 1
        await asyncio.sleep(0)
        assert count < 200
    assert count > 1  # something is held for who does not read
    assert writing.get_write_buffer_size() > 0
    assert not b.data
    reading.resume_reading()
    await eventually(lambda: len(b.data) == count * len(block))
    assert b.data == block * count
    await eventually(lambda: "resume" in a.events)
    assert writing.get_write_buffer_size() == 0
    assert a.events == ["made", "pause", "resume"]


async def test_writing_on_in_resume_writing_keeps_the_order(join):
    class Pump(Recorder):
        left = 100
        paused = False

        def pause_writing(self) -> None:
            self.paused = True

        def resume_writing(self) -> None:
            self.paused = False
            self.pump()

        def pump(self) -> None:
            while self.left and not self.paused:
                self.left -= 1
                self.transport.write(bytes([self.left]) * 100_000)

    a, b = Pump(), Recorder()
    writing, reading = await join(a, b)
    writing.set_write_buffer_limits(high=0)
    reading.pause_reading()
    a.pump()
    assert a.left
    reading.resume_reading()
    await eventually(lambda: len(b.data) == 100 * 100_000)
    assert bytes(b.data[::100_000]) == bytes(range(99, -1, -1))


async def test_the_limits_of_the_write_buffer(join):
    transport, _ = await join(Recorder(), Recorder())
    transport.set_write_buffer_limits(high=100)
    assert transport.get_write_buffer_limits() == (25, 100)
    transport.set_write_buffer_limits(low=100)
    assert transport.get_write_buffer_limits() == (100, 400)
    transport.set_write_buffer_limits()
    assert transport.get_write_buffer_limits() == (16 * 1024, 64 * 1024)
    with pytest.raises(ValueError, match="high"):
        transport.set_write_buffer_limits(high=1, low=2)


async def test_pausing_while_data_is_received(join):
    class Cautious(Recorder):
        def data_received(self, data: bytes) -> None:
            super().data_received(data)
            self.transport.pause_reading()

    a, b = Recorder(), Cautious()
    writing, reading = await join(a, b)
    writing.write(b"first")
    await eventually(lambda: b.data == b"first")
    writing.write(b"second")
    await asyncio.sleep(0.01)
    assert b.data == b"first"
    reading.resume_reading()
    await eventually(lambda: b.data == b"firstsecond")


async def test_closing_sends_what_waits_and_then_the_end(join):
    a, b = Recorder(), Recorder()
    writing, reading = await join(a, b)
    reading.pause_reading()
    for _ in range(10):  # more than anybody holds
        writing.write(bytes(1_000_000))
    writing.close()
    writing.close()
    assert writing.is_closing()
    await settle()
    assert a.events[-1] != "lost"
    reading.resume_reading()
    await eventually(lambda: b.events[-1] == "lost")
    assert bytes(b.data) == bytes(10_000_000)
    await eventually(lambda: a.events[-1] == "lost")
    assert (a.error, b.error) == (None, None)
    assert b.events == ["made", "eof", "lost"]
    assert a.events.count("lost") == 1


async def test_the_side_that_closes_gets_nothing_more(join):
    a, b = Recorder(), Recorder()
    one, other = await join(a, b)
    one.close()
    other.write(b"late")
    await eventually(lambda: a.events[-1] == "lost" and b.events[-1] == "lost")
    assert not a.data


async def test_the_end_waits_behind_what_was_sent_before(join):
    a, b = Recorder(), Recorder()
    writing, reading = await join(a, b)
    reading.pause_reading()
    writing.write(b"goodbye")
    writing.close()
    await eventually(lambda: a.events[-1] == "lost")
    await settle()
    assert b.events == ["made"]
    reading.resume_reading()
    await eventually(lambda: b.events[-1] == "lost")
    assert b.data == b"goodbye"


async def test_aborting(join):
    a, b = Recorder(), Recorder()
    one, _ = await join(a, b)
    one.abort()
    one.abort()
    assert one.is_closing()
    assert a.events == ["made"]  # not at once
    await eventually(lambda: a.events[-1] == "lost" and b.events[-1] == "lost")
    assert a.error is None
    assert a.events == ["made", "lost"]


async def test_who_has_unsent_data_learns_that_the_other_side_is_gone(join):
    a, b = Recorder(), Recorder()
    writing, reading = await join(a, b)
    reading.pause_reading()
    for _ in range(10):
        writing.write(bytes(1_000_000))
    reading.abort()
    await eventually(lambda: a.events[-1] == "lost")
    assert isinstance(a.error, ConnectionError)
    assert a.events.count("lost") == 1


async def test_writing_to_a_side_that_is_gone(join):
    a, b = Recorder(), Recorder()
    one, other = await join(a, b)
    one.pause_reading()  # so that it does not see the end
    other.abort()
    await eventually(lambda: b.events[-1] == "lost")
    await settle()
    one.write(b"anybody?")
    await eventually(lambda: a.events[-1] == "lost")
    assert isinstance(a.error, ConnectionError)


async def test_half_a_connection(join):
    a, b = Recorder(), Recorder()
    b.keeps_open = True
    one, other = await join(a, b)
    one.write(b"question")
    assert one.can_write_eof()
    one.write_eof()
    with pytest.raises(RuntimeError, match=r"write.* after write_eof"):
        one.write(b"more")
    await eventually(lambda: b.events == ["made", "eof"])
    assert b.data == b"question"
    other.write(b"answer")
    other.close()
    await eventually(lambda: a.events[-1] == "lost")
    assert a.data == b"answer"


async def test_another_protocol_in_the_middle(join):
    a, b, c = Recorder(), Recorder(), Buffered()
    writing, reading = await join(a, b)
    writing.write(b"for the first")
    await eventually(lambda: b.data == b"for the first")
    reading.set_protocol(c)
    assert reading.get_protocol() is c
    writing.write(b"for the second")
    await eventually(lambda: c.data == b"for the second")
    writing.close()
    await eventually(lambda: c.events == ["eof", "lost"])
    assert b.events == ["made"]


async def test_what_a_protocol_raises_is_reported_and_ends_the_connection(join):
    class Broken(Recorder):
        def data_received(self, data: bytes) -> None:
            raise LookupError("broken")

    reported: list[dict[str, Any]] = []
    asyncio.get_running_loop().set_exception_handler(lambda _, context: reported.append(context))
    a, b = Recorder(), Broken()
    one, _ = await join(a, b)
    one.write(b"x")  # does not raise here
    await eventually(lambda: a.events[-1] == "lost" and b.events[-1] == "lost")
    assert [type(each["exception"]) for each in reported] == [LookupError]
    assert isinstance(b.error, LookupError)


async def test_streams(join):
    """With all that asyncio's own protocol needs of a transport."""
    loop = asyncio.get_running_loop()
    readers = asyncio.StreamReader(limit=1000), asyncio.StreamReader(limit=1000)
    protocols = [asyncio.StreamReaderProtocol(reader) for reader in readers]
    transports = await join(*protocols)
    one, other = [
        asyncio.StreamWriter(*parts, loop)
        for parts in zip(transports, protocols, readers, strict=True)
    ]
    sent = bytes(range(256)) * 20_000

    async def send() -> None:
        for start in range(0, len(sent), 10_000):
            one.write(sent[start : start + 10_000])
            await one.drain()
        one.close()
        await one.wait_closed()

    sending = asyncio.create_task(send())
    received = bytearray()
    while data := await readers[1].read(3000):
        received += data
    await sending
    assert received == sent
    other.close()
    await other.wait_closed()


async def test_taking_a_stream_over(join):
    """Not a byte is lost, and the end is seen again by who takes over."""
    reader = asyncio.StreamReader(limit=100)
    protocol = asyncio.StreamReaderProtocol(reader)
    a = Recorder()
    writing, reading = await join(a, protocol)
    stream = Stream(
        reader, asyncio.StreamWriter(reading, protocol, reader, asyncio.get_running_loop())
    )
    writing.write(b"head" + bytes(3000) + b"end")
    writing.close()
    assert await reader.readexactly(4) == b"head"
    await settle()
    b = Recorder()
    rest = await take_over(stream, b)
    await eventually(lambda: b.events[-1] == "lost")
    assert rest + b.data == bytes(3000) + b"end"


# what is different without a socket


async def test_nothing_is_received_inside_of_writing():
    a, b = Recorder(), Recorder()
    one, _ = connect_in_memory(a, b)
    one.write(b"later")
    assert not b.data
    await asyncio.sleep(0)
    assert b.data == b"later"


@pytest.mark.parametrize("data", [b"bytes", memoryview(b"a view of bytes")[2:]])
async def test_a_block_is_taken_as_it_was_written(data):
    class Blocks(Recorder):
        def __init__(self) -> None:
            super().__init__()
            self.blocks: list[bytes | memoryview] = []

        def block_received(self, data: bytes | memoryview) -> None:
            self.blocks.append(data)

    a, b = Recorder(), Blocks()
    one, _ = connect_in_memory(a, b)
    one.write(data)
    await asyncio.sleep(0)
    assert b.blocks == [data]
    assert getattr(b.blocks[0], "obj", b.blocks[0]) is getattr(data, "obj", data)


@pytest.mark.parametrize("view", [False, True])
@pytest.mark.parametrize("reads", [False, True])
async def test_what_can_change_is_copied(view, reads):
    a, b = Recorder(), Recorder()
    one, other = connect_in_memory(a, b)
    if not reads:
        other.pause_reading()
    data = bytearray(b"before")
    one.write(memoryview(data) if view else data)
    data[:] = b"behind"
    other.resume_reading()
    await eventually(lambda: b.data == b"before")


async def test_an_answer_inside_of_a_question_is_no_recursion():
    class Echo(Recorder):
        inside = 0
        deepest = 0

        def data_received(self, data: bytes) -> None:
            self.inside += 1
            self.deepest = max(self.deepest, self.inside)
            super().data_received(data)
            if len(self.data) < 5000:
                self.transport.write(data)
            self.inside -= 1

    a, b = Echo(), Echo()
    one, _ = connect_in_memory(a, b)
    one.write(b"x")
    await eventually(lambda: len(a.data) == 5000 or len(b.data) == 5000)
    assert a.deepest == b.deepest == 1


async def test_what_is_written_to_a_protocol_at_work_comes_later_and_in_order():
    class Talkative(Recorder):
        def data_received(self, data: bytes) -> None:
            if data == b"1":
                one.write(b"2")
                one.write(b"3")
                assert not self.data
            super().data_received(data)

    a, b = Recorder(), Talkative()
    one, _ = connect_in_memory(a, b)
    one.write(b"1")
    one.write(b"4")
    await eventually(lambda: len(b.data) == 4)
    assert b.data == b"1423"


@pytest.mark.parametrize("end", ["close", "abort"])
@pytest.mark.parametrize("kind", [Recorder, Buffered])
async def test_ending_while_data_is_received(end, kind):
    class Fed(kind):  # type: ignore[misc, valid-type]
        def data_received(self, data: bytes) -> None:
            super().data_received(data)
            getattr(self.transport, end)()

    a, b = Recorder(), Fed()
    one, _ = connect_in_memory(a, b)
    one.write(bytes(1000))
    one.write(b"more")
    assert b.events == ["made"]
    await eventually(lambda: a.events[-1] == "lost" and b.events[-1] == "lost")
    assert len(b.data) == 1000


async def test_writing_before_the_other_side_knows_of_its_connection():
    class Greeting(Recorder):
        def connection_made(self, transport: asyncio.BaseTransport) -> None:
            super().connection_made(transport)
            self.transport.write(b"hello")

    class Strict(Recorder):
        def data_received(self, data: bytes) -> None:
            assert self.transport is not None
            super().data_received(data)

    a, b = Greeting(), Strict()
    connect_in_memory(a, b)
    await eventually(lambda: b.data == b"hello")


async def test_what_a_side_holds_is_bounded():
    a, b = Recorder(), Recorder()
    one, other = connect_in_memory(a, b)
    other.pause_reading()
    for _ in range(CAPACITY // 1024):
        one.write(bytes(1024))
    assert one.get_write_buffer_size() == 0
    one.write(bytes(1024))
    assert one.get_write_buffer_size() == 1024


async def test_a_long_queue_does_not_keep_the_loop_from_others():
    a, b = Recorder(), Recorder()
    one, other = connect_in_memory(a, b)
    other.pause_reading()
    for _ in range(8):
        one.write(bytes(CAPACITY))
    other.resume_reading()
    turns = 0
    while len(b.data) < 8 * CAPACITY:
        await asyncio.sleep(0)
        turns += 1
    assert turns > 3


async def test_an_unforeseen_end_of_the_loop_leaves_nothing_to_warn_of():
    with contextlib.closing(asyncio.new_event_loop()) as loop:

        async def connect() -> None:
            one, _ = connect_in_memory(Recorder(), Recorder())
            one.write(b"x")

        await asyncio.to_thread(loop.run_until_complete, connect())
