"""A proxy that misbehaves on purpose: what both sides of it see."""

from __future__ import annotations

import asyncio
import socket
from collections.abc import AsyncIterator

import pytest

from aioros1.testing import FlakyConnection, FlakyProxy

PATIENCE = 10.0
"""Seconds until a test that waits gives up; never reached when all is well."""

WAYS = pytest.mark.parametrize("way", ["up", "down"])
MEGABYTE = bytes(range(256)) * 4096


class End:
    """One end of a connection."""

    def __init__(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self.reader = reader
        self.writer = writer
        writer.get_extra_info("socket").setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)

    def write(self, data: bytes) -> None:
        self.writer.write(data)

    async def send(self, data: bytes) -> None:
        self.writer.write(data)
        async with asyncio.timeout(PATIENCE):
            await self.writer.drain()

    async def take(self, count: int) -> bytes:
        async with asyncio.timeout(PATIENCE):
            return await self.reader.readexactly(count)

    async def rest(self) -> bytes:
        """Everything until the end, which has to be in good order."""
        async with asyncio.timeout(PATIENCE):
            return await self.reader.read()

    async def until_reset(self) -> bytes:
        """Everything until the connection is reset."""
        data = b""
        with pytest.raises(ConnectionResetError):
            async with asyncio.timeout(PATIENCE):
                while True:
                    piece = await self.reader.read(1 << 16)
                    assert piece, "it was closed, not reset"
                    data += piece
        return data

    async def hears_nothing(self) -> bool:
        """Whether nothing comes, while the loop and the system do all they have to do."""
        try:
            async with asyncio.timeout(0.05):
                await self.reader.readexactly(1)
        except TimeoutError:
            return True
        return False


class Server:
    """Listens, and hands out its ends of the connections, in their order."""

    def __init__(self) -> None:
        self.ends: asyncio.Queue[End] = asyncio.Queue()
        self.all: list[End] = []
        self.port = 0

    def came(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self.all.append(End(reader, writer))
        self.ends.put_nowait(self.all[-1])

    async def end(self) -> End:
        async with asyncio.timeout(PATIENCE):
            return await self.ends.get()


@pytest.fixture
async def server() -> AsyncIterator[Server]:
    server = Server()
    listening = await asyncio.start_server(server.came, "127.0.0.1", 0)
    server.port = listening.sockets[0].getsockname()[1]
    yield server
    listening.close()
    for end in server.all:
        end.writer.transport.abort()
    await turns()


@pytest.fixture
async def clients() -> AsyncIterator[list[End]]:
    clients: list[End] = []
    yield clients
    for end in clients:
        end.writer.transport.abort()
    await turns()


async def turns() -> None:
    for _ in range(5):  # event loops close things in a later turn
        await asyncio.sleep(0)


@pytest.fixture
def client_of(clients):
    async def connect(proxy: FlakyProxy) -> End:
        async with asyncio.timeout(PATIENCE):
            end = End(*await asyncio.open_connection(proxy.host, proxy.port))
        clients.append(end)
        return end

    return connect


@pytest.fixture
async def proxy(server) -> AsyncIterator[FlakyProxy]:
    async with FlakyProxy("127.0.0.1", server.port) as proxy:
        yield proxy


class Pair:
    """Both ends of a connection through a proxy, and the connection in it."""

    def __init__(self, client: End, server: End, connection: FlakyConnection) -> None:
        self.client, self.server, self.connection = client, server, connection

    def ends(self, way: str) -> tuple[End, End]:
        """Who sends, and who receives."""
        both = self.client, self.server
        return both if way == "up" else both[::-1]

    def passed(self, way: str) -> int:
        return self.connection.bytes_up if way == "up" else self.connection.bytes_down


@pytest.fixture
def pair_of(server, client_of):
    async def make(proxy: FlakyProxy) -> Pair:
        client = await client_of(proxy)
        end = await server.end()
        return Pair(client, end, proxy.connections[-1])

    return make


@pytest.fixture
async def pair(proxy, pair_of) -> Pair:
    return await pair_of(proxy)


def other(way: str) -> str:
    return "down" if way == "up" else "up"


# without a fault


@WAYS
async def test_everything_passes_as_it_was_sent(pair, way):
    sender, receiver = pair.ends(way)
    sender.write(MEGABYTE * 8)
    assert await receiver.take(8 << 20) == MEGABYTE * 8
    assert (pair.passed(way), pair.passed(other(way))) == (8 << 20, 0)


async def test_the_proxy_tells_of_its_connections(proxy, client_of):
    assert (proxy.connections, proxy.accepted) == ((), 0)
    first = await client_of(proxy)
    await client_of(proxy)
    async with asyncio.timeout(PATIENCE):
        await proxy.wait_accepted(2)
    assert proxy.accepted == 2
    assert [each.number for each in proxy.connections] == [1, 2]
    connection = proxy.connections[0]
    assert connection.client == first.writer.get_extra_info("sockname")
    assert repr(connection).endswith("open>")
    first.writer.close()
    await first.rest()
