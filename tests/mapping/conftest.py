"""What the tests of the mapping share.

These tests are named after the functions of cROS and rcl, so that searching for such a
name finds what stands for it here.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
import socket
import struct
from collections.abc import AsyncIterator, Awaitable, Callable, Iterator
from typing import Any, Protocol

import aiohttp
import pytest
from aiohttp import web

import aioros1
from aioros1.wire.xmlrpc import decode_call


@pytest.fixture
def until() -> Callable[[Callable[[], object]], Awaitable[None]]:
    """``await until(lambda: ...)``: for counters, which nobody announces."""

    async def until(holds: Callable[[], object]) -> None:
        async with asyncio.timeout(30):
            while not holds():
                await asyncio.sleep(0.001)

    return until


@pytest.fixture
def unused_port() -> Iterator[int]:
    """A port where nobody listens, and nobody else will: it is taken, but not listened on."""
    with socket.socket() as sock:
        sock.bind(("127.0.0.1", 0))
        yield sock.getsockname()[1]


@pytest.fixture
def silent_port() -> Iterator[int]:
    """A port where every connection is made, and nobody ever says a word."""
    with socket.socket() as sock:
        sock.bind(("127.0.0.1", 0))
        sock.listen()
        yield sock.getsockname()[1]


@pytest.fixture
def keep_log_level() -> Iterator[Callable[[logging.Logger], None]]:
    """``keep_log_level(logger)``: what the test does to its level is undone."""
    with contextlib.ExitStack() as stack:
        yield lambda logger: stack.callback(logger.setLevel, logger.level) and None


class Recorder:
    """A stop on the way to a master, that knows who asked for what."""

    def __init__(self, master_uri: str) -> None:
        self.uri = ""
        self.calls: list[tuple[Any, ...]] = []
        """``(method, caller_id, *parameters)`` of every request."""
        self._master_uri = master_uri

    def count(self, *call: Any) -> int:
        """How many requests began like that."""
        return sum(1 for seen in self.calls if seen[: len(call)] == call)

    async def forward(self, request: web.BaseRequest) -> web.Response:
        body = await request.read()
        method, params = decode_call(body)
        self.calls.append((method, *params))
        headers = {"Content-Type": "text/xml"}
        async with (
            aiohttp.ClientSession() as session,
            session.post(self._master_uri, data=body, headers=headers) as answer,
        ):
            return web.Response(body=await answer.read(), content_type="text/xml")


@pytest.fixture
async def recorder(master: aioros1.Master) -> AsyncIterator[Recorder]:
    """``make_node(master_uri=recorder.uri)``: a node whose requests are written down."""
    recorder = Recorder(master.uri)
    server = web.Server(recorder.forward)
    runner = web.ServerRunner(server)
    await runner.setup()
    try:
        await web.TCPSite(runner, "127.0.0.1", 0).start()
        recorder.uri = f"http://127.0.0.1:{runner.addresses[0][1]}/"
        yield recorder
    finally:
        await runner.cleanup()


class MakeNode(Protocol):
    async def __call__(self, name: str = "node", **options: Any) -> aioros1.Node: ...


@pytest.fixture
async def pair(make_node: MakeNode) -> tuple[aioros1.Node, aioros1.Node]:
    """Two nodes, ``/talker`` and ``/listener``."""
    return await make_node("talker"), await make_node("listener")


class TcprosPeer:
    """A TCPROS client that shares no code with the library."""

    def __init__(
        self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter, header: dict[str, str]
    ) -> None:
        self.header = header
        self._reader = reader
        self._writer = writer

    async def frame(self) -> bytes:
        """What follows the next length."""
        return await read_frame(self._reader)

    async def call(self, request: bytes) -> tuple[int, bytes]:
        """Send a request; the byte that says whether it went well, and the answer."""
        self._writer.write(struct.pack("<I", len(request)) + request)
        async with asyncio.timeout(30):
            [ok] = await self._reader.readexactly(1)
        return ok, await self.frame()

    async def is_closed(self) -> bool:
        """Whether the other side closes without another word."""
        async with asyncio.timeout(30):
            return await self._reader.read(1) == b""


async def read_frame(reader: asyncio.StreamReader) -> bytes:
    async with asyncio.timeout(30):
        (length,) = struct.unpack("<I", await reader.readexactly(4))
        return await reader.readexactly(length)


@pytest.fixture
def tcpros() -> Callable[..., contextlib.AbstractAsyncContextManager[TcprosPeer]]:
    """``async with tcpros(address, fields) as peer``: connected, and hands shaken."""

    @contextlib.asynccontextmanager
    async def tcpros(address: tuple[str, int], fields: dict[str, str]) -> AsyncIterator[TcprosPeer]:
        rows = [f"{name}={value}".encode() for name, value in fields.items()]
        body = b"".join(struct.pack("<I", len(row)) + row for row in rows)
        reader, writer = await asyncio.open_connection(*address)
        try:
            writer.write(struct.pack("<I", len(body)) + body)
            answer = await read_frame(reader)
            header = {}
            while answer:
                (length,) = struct.unpack_from("<I", answer)
                name, _, value = answer[4 : 4 + length].decode().partition("=")
                header[name] = value
                answer = answer[4 + length :]
            yield TcprosPeer(reader, writer, header)
        finally:
            writer.close()
            await writer.wait_closed()

    return tcpros
