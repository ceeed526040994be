"""Connections on asyncio streams, and how a protocol takes them over."""

from __future__ import annotations

import asyncio
import contextlib
import errno
import math
import socket
import struct
from collections.abc import AsyncIterator

import pytest

from aioros1.errors import ClosedError, HandshakeError
from aioros1.net import connecting, tcpros
from aioros1.net.tcpros import Listener, Stream, connect, connection_info, take_over
from aioros1.options import Limits, Timeouts
from aioros1.wire.handshake import Server
from aioros1.wire.header import encode_header

from .sockets import drop, say

HEADER = encode_header({"callerid": "/x", "md5sum": "*", "topic": "/chatter"})


def server_side() -> Server:
    return Server("peer", max_bytes=1000, max_fields=10)


# the handshake


async def test_a_header_is_read_and_not_a_byte_beyond_it(pair):
    stream, peer = pair
    await say(peer, HEADER + b"first messages")
    side = server_side()
    await stream.receive_header(side, timeout=30)
    assert side.topic == "/chatter"
    assert await stream.reader.readexactly(14) == b"first messages"


async def test_a_header_byte_by_byte(pair):
    stream, peer = pair
    side = server_side()
    receiving = asyncio.create_task(stream.receive_header(side, timeout=30))
    for byte in HEADER:
        await say(peer, bytes([byte]))
        await asyncio.sleep(0)
    await receiving
    assert side.topic == "/chatter"


async def test_a_header_that_does_not_come_in_time(pair):
    stream, peer = pair
    await say(peer, HEADER[:-1])
    with pytest.raises(TimeoutError, match=r"sent no whole connection header in 0.05 s"):
        await stream.receive_header(server_side(), timeout=0.05)


async def test_the_end_instead_of_a_header(pair):
    stream, peer = pair
    await say(peer, HEADER[:-1])
    peer.close()
    with pytest.raises(ConnectionError, match="connection lost in the handshake"):
        await stream.receive_header(server_side(), timeout=30)


async def test_a_length_beyond_the_limit_is_not_waited_for(pair):
    stream, peer = pair
    await say(peer, struct.pack("<I", 1001))
    with pytest.raises(HandshakeError, match="1001 bytes"):
        await stream.receive_header(server_side(), timeout=30)


async def test_a_cancelled_handshake_is_a_cancellation(pair):
    stream, _ = pair
    receiving = asyncio.create_task(stream.receive_header(server_side(), timeout=30))
    await asyncio.sleep(0.01)
    receiving.cancel()
    with pytest.raises(asyncio.CancelledError):
        await receiving


# writing


async def test_writing_to_a_peer_that_takes_nothing_is_given_up(pair):
    stream, _ = pair
    with pytest.raises(TimeoutError, match=r"took nothing for 0.05 s"):
        await stream.write(bytes(5_000_000), stall=0.05)


async def test_writing_to_a_peer_that_is_slow_is_not_given_up(pair):
    stream, peer = pair
    writing = asyncio.create_task(stream.write(bytes(6_000_000), stall=1))
    taken = 0
    loop = asyncio.get_running_loop()
    while not writing.done():
        taken += len(await loop.sock_recv(peer, 100_000))
        await asyncio.sleep(0.02)
    await writing
    assert taken > 2_000_000


async def test_what_was_written_is_sent_before_the_stream_closes(pair):
    stream, peer = pair
    await stream.write(b"goodbye", stall=1)
    await stream.close()
    assert await asyncio.get_running_loop().sock_recv(peer, 100) == b"goodbye"
    assert await asyncio.get_running_loop().sock_recv(peer, 100) == b""


# connecting


async def test_connecting_sets_what_roscpp_sets(listening):
    stream = await connect("127.0.0.1", listening.getsockname()[1], Timeouts())
    sock = stream.writer.get_extra_info("socket")
    assert sock.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY)
    assert sock.getsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE)
    if hasattr(socket, "TCP_USER_TIMEOUT"):
        assert keepalive(sock) == (60, 10, 9, 150_000)
    info = connection_info(stream, "/chatter", "i", "/x", {})
    assert info.local[0] == "127.0.0.1"
    assert info.remote == ("127.0.0.1", listening.getsockname()[1])
    assert info.fileno == sock.fileno()
    await drop(stream)


def keepalive(sock: socket.socket) -> tuple[int, ...]:
    names = ("TCP_KEEPIDLE", "TCP_KEEPINTVL", "TCP_KEEPCNT", "TCP_USER_TIMEOUT")
    return tuple(sock.getsockopt(socket.IPPROTO_TCP, getattr(socket, name)) for name in names)


@pytest.mark.skipif(not hasattr(socket, "TCP_USER_TIMEOUT"), reason="only Linux has all of it")
@pytest.mark.parametrize(
    ("timeouts", "expected"),
    [
        (Timeouts(keepalive=12, stall=1), (12, 2, 9, 30_000)),
        (Timeouts(keepalive=2.4, stall=40), (2, 1, 9, 40_000)),
        (Timeouts(keepalive=0.1, stall=0.5), (1, 1, 9, 2_500)),
        (Timeouts(keepalive=math.inf, stall=math.inf), (32767, 5461, 9, 98_301_000)),
    ],
)
async def test_both_sides_look_after_a_silent_peer(listening, timeouts, expected):
    stream = await connect("127.0.0.1", listening.getsockname()[1], timeouts)
    assert keepalive(stream.writer.get_extra_info("socket")) == expected
    await drop(stream)
    async with serving(timeouts) as (listener, served):
        stream = await connect("127.0.0.1", listener.port, Timeouts())
        await eventually(lambda: served.count == 1)
        assert keepalive(served.streams[0].writer.get_extra_info("socket")) == expected
        await drop(stream)


async def test_a_refused_connection_names_host_and_port():
    with socket.socket() as deaf:  # bound, so that nobody takes the port, but not listening
        deaf.bind(("127.0.0.1", 0))
        port = deaf.getsockname()[1]
        with pytest.raises(ConnectionError, match=rf"127.0.0.1:{port}"):
            await connect("127.0.0.1", port, Timeouts())


async def test_a_connection_that_takes_too_long_names_host_and_port():
    with socket.socket() as full, contextlib.ExitStack() as stack:
        full.bind(("127.0.0.1", 0))
        full.listen(0)
        port = full.getsockname()[1]
        for _ in range(4):  # from now on the system drops requests to connect
            waiting = stack.enter_context(socket.socket())
            waiting.setblocking(False)
            waiting.connect_ex(("127.0.0.1", port))
        with pytest.raises(TimeoutError, match=rf"127.0.0.1:{port} within 0.1 s"):
            await connect("127.0.0.1", port, Timeouts(connect=0.1))


async def test_every_address_of_a_host_is_tried(listening, monkeypatch):
    async def two(host, port=0):
        return [(socket.AF_INET, "127.0.0.3"), (socket.AF_INET, "127.0.0.1")]

    monkeypatch.setattr(connecting, "resolve", two)
    stream = await connect("robot", listening.getsockname()[1], Timeouts())
    assert stream.peer.startswith("127.0.0.1:")
    await drop(stream)


async def test_an_address_that_is_silent_does_not_hold_up_the_next(listening, monkeypatch):
    loop = asyncio.get_running_loop()
    create_connection = loop.create_connection

    async def two(host: str) -> list[tuple[socket.AddressFamily, str]]:
        return [(socket.AF_INET, "192.0.2.1"), (socket.AF_INET, "127.0.0.1")]

    async def connection(factory, host, *args, **kwargs):
        if host == "192.0.2.1":
            await asyncio.Event().wait()
        return await create_connection(factory, host, *args, **kwargs)

    monkeypatch.setattr(connecting, "resolve", two)
    monkeypatch.setattr(connecting, "STAGGER", 0.01)
    monkeypatch.setattr(loop, "create_connection", connection, raising=False)
    stream = await connect("robot", listening.getsockname()[1], Timeouts())
    peer, _ = await loop.sock_accept(listening)
    with peer:
        await say(peer, HEADER)
        await stream.receive_header(server_side(), timeout=5)
    await drop(stream)


async def test_a_timeout_of_the_system_is_a_connection_error(monkeypatch):
    async def connection(*args, **kwargs):
        raise OSError(errno.ETIMEDOUT, "Connection timed out")

    monkeypatch.setattr(asyncio.get_running_loop(), "create_connection", connection, raising=False)
    with pytest.raises(ConnectionError, match=r"cannot connect to 127\.0\.0\.1:1: .*timed out"):
        await connect("127.0.0.1", 1, Timeouts())


@pytest.mark.parametrize("host", ["a..b", "a" * 70, "no such host", ""])
async def test_a_host_that_is_no_name_is_a_connection_error(host):
    with pytest.raises(ConnectionError, match="cannot connect to"):
        await connect(host, 1, Timeouts())


# taking over


class Taker(asyncio.Protocol):
    """Keeps what comes."""

    def __init__(self) -> None:
        self.data = bytearray()
        self.lost = asyncio.get_running_loop().create_future()
        self.transport: asyncio.BaseTransport | None = None

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        self.transport = transport

    def data_received(self, data: bytes) -> None:
        self.data += data

    def connection_lost(self, exc: Exception | None) -> None:
        self.lost.set_result(exc)


@pytest.mark.parametrize("behind", [0, 10, 70_000, 150_000])
async def test_no_byte_is_lost_when_a_protocol_takes_over(pair, behind):
    """Also not when the reader held so much that it had stopped reading."""
    stream, peer = pair
    data = bytes(range(256)) * 2000
    saying = asyncio.create_task(say(peer, HEADER + data[:behind]))
    await stream.receive_header(server_side(), timeout=30)
    if behind <= 100_000:  # else the system cannot hold it
        await saying
    await asyncio.sleep(0.01)
    taker = Taker()
    rest = await take_over(stream, taker)
    assert taker.transport is stream.transport
    await saying
    await say(peer, data[behind:])
    peer.shutdown(socket.SHUT_WR)
    await asyncio.wait_for(taker.lost, 30)
    assert rest + bytes(taker.data) == data


async def test_an_end_that_came_before_is_seen_after_taking_over(pair):
    stream, peer = pair
    await say(peer, HEADER + b"rest")
    peer.shutdown(socket.SHUT_WR)
    await stream.receive_header(server_side(), timeout=30)
    await asyncio.sleep(0.01)
    taker = Taker()
    assert await take_over(stream, taker) == b"rest"
    await asyncio.wait_for(taker.lost, 30)


async def test_a_connection_that_is_lost_already_cannot_be_taken_over(pair):
    stream, peer = pair
    await say(peer, HEADER)
    await stream.receive_header(server_side(), timeout=30)
    stream.abort()
    with pytest.raises(ConnectionError, match="lost in the handshake"):
        await take_over(stream, Taker())


# the listener


class Served:
    """What a listener was given to serve, each in a task."""

    def __init__(self) -> None:
        self.tasks: set[asyncio.Task[None]] = set()
        self.streams: list[Stream] = []
        self.is_closed = False

    @property
    def count(self) -> int:
        return len(self.streams)

    def spawn(self, function, *args, name: str) -> None:
        if self.is_closed:
            raise ClosedError("too late")
        self.tasks.add(asyncio.create_task(function(*args), name=name))

    async def serve(self, stream: Stream) -> None:
        self.streams.append(stream)
        try:
            await stream.reader.read()
        finally:
            await drop(stream)


@contextlib.asynccontextmanager
async def serving(
    timeouts: Timeouts = Timeouts(),  # noqa: B008 - frozen
    **limits: int,
) -> AsyncIterator[tuple[Listener, Served]]:
    served = Served()
    listener = Listener(served.serve, served.spawn, limits=Limits(**limits), timeouts=timeouts)
    await listener.start("127.0.0.1", 0)
    try:
        yield listener, served
    finally:
        listener.close()
        for task in served.tasks:
            task.cancel()
        if served.tasks:
            await asyncio.wait(served.tasks)


async def is_closed_at_once(stream: Stream) -> bool:
    try:
        async with asyncio.timeout(30):
            return await stream.reader.read() == b""
    except ConnectionError:
        return True


async def eventually(condition) -> None:
    async with asyncio.timeout(30):
        while not condition():
            await asyncio.sleep(0.002)


async def test_every_connection_is_served_in_a_task_named_after_its_peer():
    async with serving() as (listener, served):
        streams = [await connect("127.0.0.1", listener.port, Timeouts()) for _ in range(3)]
        await eventually(lambda: served.count == 3)
        local = streams[0].writer.get_extra_info("sockname")
        assert f"tcpros 127.0.0.1:{local[1]}" in {task.get_name() for task in served.tasks}
        await drop(*streams)


async def test_connections_beyond_the_limit_are_closed_and_counted():
    async with serving(connections=2) as (listener, served):
        first, second = [await connect("127.0.0.1", listener.port, Timeouts()) for _ in range(2)]
        await eventually(lambda: served.count == 2)
        third = await connect("127.0.0.1", listener.port, Timeouts())
        assert await is_closed_at_once(third)
        assert (listener.admission.refused, served.count) == (1, 2)
        first.abort()
        await eventually(lambda: any(task.done() for task in served.tasks))
        fourth = await connect("127.0.0.1", listener.port, Timeouts())
        await eventually(lambda: served.count == 3)
        await drop(first, second, third, fourth)


async def test_a_connection_that_comes_too_late_is_closed():
    async with serving() as (listener, served):
        served.is_closed = True
        stream = await connect("127.0.0.1", listener.port, Timeouts())
        assert await is_closed_at_once(stream)
        await drop(stream)


async def test_a_connection_that_is_lost_while_it_is_accepted_takes_no_place(monkeypatch):
    def gone(sock: socket.socket, timeouts: Timeouts) -> None:
        raise OSError("not connected any more")

    async with serving(connections=1) as (listener, served):
        stream = await connect("127.0.0.1", listener.port, Timeouts())
        await eventually(lambda: served.count == 1)
        await drop(stream)
        await eventually(lambda: listener.admission.open == 0)
        monkeypatch.setattr(tcpros, "_tune", gone)
        with socket.create_connection(("127.0.0.1", listener.port)) as sock:
            sock.setblocking(False)
            with contextlib.suppress(ConnectionError):
                async with asyncio.timeout(30):
                    assert await asyncio.get_running_loop().sock_recv(sock, 1) == b""
        assert (served.count, listener.admission.open) == (1, 0)


async def test_closing_the_listener_leaves_connections_open():
    async with serving() as (listener, served):
        stream = await connect("127.0.0.1", listener.port, Timeouts())
        await eventually(lambda: served.count == 1)
        port = listener.port
        listener.close()
        listener.close()
        with pytest.raises(ConnectionError):
            await connect("127.0.0.1", port, Timeouts())
        assert not any(task.done() for task in served.tasks)
        await drop(stream)


async def test_a_port_that_is_taken_is_named():
    async with serving() as (listener, _):
        served = Served()
        other = Listener(served.serve, served.spawn, limits=Limits())
        with pytest.raises(OSError, match=f"127.0.0.1:{listener.port}"):
            await other.start("127.0.0.1", listener.port)
