"""Peers that say exactly what a test tells them to, right or wrong.

They speak TCPROS with bytes made here, not by the library: what both got wrong in the
same way would not be seen otherwise.
"""

from __future__ import annotations

import asyncio
import contextlib
import os
import socket
import stat
import struct
from collections.abc import AsyncIterator, Callable, Iterator
from typing import Any, Self

import aioros1
from aioros1.msg.std_msgs import String
from aioros1.srv.std_srvs import SetBool
from aioros1.xmlrpc.client import XmlRpcClient
from aioros1.xmlrpc.master_proxy import MasterProxy
from aioros1.xmlrpc.server import XmlRpcServer

PATIENCE = 30.0
"""Seconds until a test that waits gives up; never reached when all is well."""

STRING_MD5 = "992ce8a1687cec8c8bd883ec73ca41d1"
SET_BOOL_MD5 = "09fb03525b03e7ea1fd3992bafd87e16"
WRONG_MD5 = "0" * 32

STRING_REPLY = {
    "callerid": "/fake",
    "latching": "0",
    "md5sum": STRING_MD5,
    "message_definition": "string data\n",
    "topic": "/chatter",
    "type": "std_msgs/String",
}
"""What a publisher of strings answers."""


def frame(body: bytes) -> bytes:
    """``body`` with its length in front."""
    return struct.pack("<I", len(body)) + body


def header(fields: dict[str, str]) -> bytes:
    """A connection header."""
    texts = (f"{name}={value}" for name, value in fields.items())
    return frame(b"".join(frame(text.encode("utf-8", "surrogateescape")) for text in texts))


def string(text: str) -> bytes:
    """A std_msgs/String with its length in front, as it goes over the wire."""
    return frame(frame(text.encode()))


def subscriber_header(topic: str = "/chatter", **changes: str | None) -> bytes:
    """What a subscriber to strings sends; None leaves a field out."""
    fields: dict[str, str | None] = {
        "callerid": "/fake",
        "md5sum": STRING_MD5,
        "topic": topic,
        "type": "std_msgs/String",
        **changes,
    }
    return header({name: value for name, value in fields.items() if value is not None})


def caller_header(service: str = "/flip", **changes: str | None) -> bytes:
    """What a caller of a std_srvs/SetBool sends; None leaves a field out."""
    fields: dict[str, str | None] = {
        "callerid": "/fake",
        "md5sum": SET_BOOL_MD5,
        "service": service,
        "type": "std_srvs/SetBool",
        **changes,
    }
    return header({name: value for name, value in fields.items() if value is not None})


async def until(condition: Callable[[], Any], what: str = "", *, seconds: float = PATIENCE) -> Any:
    """Wait for ``condition()`` to hold, and return it."""
    try:
        async with asyncio.timeout(seconds):
            while not (found := condition()):
                await asyncio.sleep(0.002)
    except TimeoutError:
        raise AssertionError(f"did not come true in {seconds} s: {what or condition}") from None
    return found


@contextlib.contextmanager
def refusing() -> Iterator[int]:
    """A port that refuses connections, and that nobody else can take meanwhile."""
    with socket.socket() as sock:
        sock.bind(("127.0.0.1", 0))
        yield sock.getsockname()[1]


def listening_ports() -> set[int]:
    """The ports on which this process listens."""
    ports = set()
    for entry in os.listdir("/proc/self/fd"):
        with contextlib.suppress(OSError):
            if not stat.S_ISSOCK(os.fstat(int(entry)).st_mode):
                continue
            with socket.socket(fileno=os.dup(int(entry))) as sock:
                if sock.getsockopt(socket.SOL_SOCKET, socket.SO_ACCEPTCONN):
                    ports.add(sock.getsockname()[1])
    return ports


class Wire:
    """One end of a TCP connection."""

    def __init__(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self.reader = reader
        self.writer = writer
        self.header: dict[str, str] = {}
        """What the other side sent first, once it was read."""

    async def send(self, *parts: bytes) -> None:
        self.writer.write(b"".join(parts))
        async with asyncio.timeout(PATIENCE):
            await self.writer.drain()

    async def take(self, count: int) -> bytes:
        async with asyncio.timeout(PATIENCE):
            return await self.reader.readexactly(count)

    async def frame(self) -> bytes:
        """The next thing with a length in front: a header, a message, a request."""
        (length,) = struct.unpack("<I", await self.take(4))
        return await self.take(length)

    async def read_header(self) -> dict[str, str]:
        body = await self.frame()
        self.header = {}
        while body:
            (length,) = struct.unpack_from("<I", body)
            name, _, value = body[4 : 4 + length].decode().partition("=")
            self.header[name] = value
            body = body[4 + length :]
        return self.header

    async def string(self) -> str:
        """The text of the next std_msgs/String."""
        body = await self.frame()
        return body[4:].decode()

    async def answer(self) -> tuple[int, bytes]:
        """The answer to a service call: whether it went well, and with what."""
        return (await self.take(1))[0], await self.frame()

    async def is_closed(self) -> bool:
        """Wait for the other side to close; whether it did so without another byte."""
        try:
            async with asyncio.timeout(PATIENCE):
                return await self.reader.read() == b""
        except ConnectionError:
            return True

    def pause(self) -> None:
        """Take nothing more: what is sent to us fills the buffers of the system."""
        self.writer.transport.pause_reading()  # type: ignore[attr-defined]

    def resume(self) -> None:
        self.writer.transport.resume_reading()  # type: ignore[attr-defined]

    async def close(self) -> None:
        self.writer.close()
        with contextlib.suppress(OSError, TimeoutError):
            async with asyncio.timeout(PATIENCE):
                await self.writer.wait_closed()

    def abort(self) -> None:
        """Close as a killed process with unread data does: with a reset."""
        self.writer.transport.abort()


@contextlib.asynccontextmanager
async def dialled(node: aioros1.Node, *parts: bytes) -> AsyncIterator[Wire]:
    """A connection to the TCPROS port of ``node``, over which ``parts`` were sent."""
    host, port = node.tcpros_address
    wire = Wire(*await asyncio.open_connection(host, port))
    try:
        await wire.send(*parts)
        yield wire
    finally:
        wire.abort()
        await wire.close()


class FakePeer:
    """A TCP port whose connections the test answers by hand."""

    def __init__(self, master_uri: str, name: str) -> None:
        self.name = name
        self._client = XmlRpcClient()
        self.master = MasterProxy(self._client, master_uri, name)
        self.dials = 0
        """Connections so far."""
        self.dial_times: list[float] = []
        self._server: asyncio.Server | None = None
        self._wires: list[Wire] = []
        self._waiting: asyncio.Queue[Wire] = asyncio.Queue()

    async def start(self) -> None:
        self._server = await asyncio.start_server(self._dialled, "127.0.0.1", 0)

    @property
    def port(self) -> int:
        assert self._server is not None
        return int(self._server.sockets[0].getsockname()[1])

    def _dialled(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self.dials += 1
        self.dial_times.append(asyncio.get_running_loop().time())
        wire = Wire(reader, writer)
        self._wires.append(wire)
        self._waiting.put_nowait(wire)

    async def accept(self) -> Wire:
        """The next connection, of which nothing was read yet."""
        async with asyncio.timeout(PATIENCE):
            return await self._waiting.get()

    async def greeted(self) -> Wire:
        """The next connection; what it says first is its ``header``."""
        wire = await self.accept()
        await wire.read_header()
        return wire

    async def close(self) -> None:
        if self._server is not None:
            self._server.close()
        for wire in self._wires:
            wire.abort()
            await wire.close()
        await self._client.close()


class FakePublisher(FakePeer):
    """A publisher: a slave API that answers ``requestTopic``, and a TCP port."""

    def __init__(self, master_uri: str, name: str, topic: str, type: str) -> None:
        super().__init__(master_uri, name)
        self.topic = topic
        self.type = type
        self.requests = 0
        """How often it was asked how to connect."""
        self.ready: Any = None
        """What it answers then; None is the right thing, an exception is raised."""
        self.hold: asyncio.Event | None = None
        """What it waits for before it answers."""
        self._slave = XmlRpcServer({"requestTopic": self._request_topic})

    @property
    def uri(self) -> str:
        return f"http://127.0.0.1:{self._slave.port}/"

    async def start(self) -> None:
        await super().start()
        await self._slave.start("127.0.0.1")

    async def _request_topic(self, *params: Any) -> Any:
        self.requests += 1
        if self.hold is not None:
            await self.hold.wait()
        if self.ready is None:
            return [1, "ready", ["TCPROS", "127.0.0.1", self.port]]
        return self.ready() if callable(self.ready) else self.ready

    async def register(self) -> None:
        await self.master.register_publisher(self.topic, self.type, self.uri)

    async def unregister(self) -> None:
        await self.master.unregister_publisher(self.topic, self.uri)

    async def subscribed(self, reply: dict[str, str] | None = None) -> Wire:
        """The next subscriber that connects, greeted back."""
        wire = await self.greeted()
        await wire.send(header({**STRING_REPLY, **(reply or {})}))
        return wire

    async def close(self) -> None:
        if self.hold is not None:
            self.hold.set()
        await super().close()
        await self._slave.close(timeout=0.05)


class FakeProvider(FakePeer):
    """A provider of a std_srvs/SetBool: a TCP port that the master knows."""

    def __init__(self, master_uri: str, name: str, service: str) -> None:
        super().__init__(master_uri, name)
        self.service = service

    async def register(self, service_uri: str | None = None) -> None:
        uri = service_uri or f"rosrpc://127.0.0.1:{self.port}"
        await self.master.register_service(self.service, uri, "http://127.0.0.1:1/")

    async def called(self) -> Wire:
        """The next caller, greeted back."""
        wire = await self.greeted()
        await wire.send(header({"callerid": self.name, "md5sum": SET_BOOL_MD5}))
        return wire


def flip_request(data: bool) -> bytes:
    """A request of std_srvs/SetBool, which is one byte."""
    return frame(bytes([data]))


def flip_answer(success: bool, message: str = "") -> bytes:
    """The answer that a call of std_srvs/SetBool went well."""
    return b"\x01" + frame(bytes([success]) + frame(message.encode()))


class Bystander:
    """Somebody who uses a node all along, and must never notice what others do to it."""

    def __init__(self, stack: contextlib.AsyncExitStack) -> None:
        self._stack = stack
        self._rounds = 0

    async def start(self, node: aioros1.Node, other: aioros1.Node) -> Self:
        enter = self._stack.enter_async_context
        self._out = await enter(node.advertise("calm/out", String))
        self._in = await enter(node.subscribe("calm/in", String))
        await enter(node.advertise_service("calm/flip", SetBool, lambda q: {"success": q.data}))
        self._listener = await enter(other.subscribe("calm/out", String))
        self._talker = await enter(other.advertise("calm/in", String))
        self._caller = await enter(other.service_caller("calm/flip", SetBool))
        await self._out.wait_for_subscribers(timeout=PATIENCE)
        await self._talker.wait_for_subscribers(timeout=PATIENCE)
        return self

    async def is_served(self) -> bool:
        """Whether topics in both directions work, and a call with a connection of its own."""
        self._rounds += 1
        text = f"round {self._rounds}"
        self._out.publish(data=text)
        self._talker.publish(data=text)
        assert (await self._listener.get(timeout=30)).data == text
        assert (await self._in.get(timeout=30)).data == text
        assert (await self._caller.call(data=True, timeout=30)).success
        return True
