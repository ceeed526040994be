"""Both ends of a connection through a proxy, as plain streams."""

from __future__ import annotations

import asyncio
import socket
import struct

import pytest

from aioros1.testing import FlakyConnection, FlakyProxy

PATIENCE = 30.0
"""Seconds until a test that waits gives up; never reached when all is well."""


class End:
    """One end of a connection."""

    def __init__(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self.reader = reader
        self.writer = writer
        writer.get_extra_info("socket").setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)

    def write(self, data: bytes) -> None:
        self.writer.write(data)

    def reset(self) -> None:
        sock = self.writer.get_extra_info("socket")
        sock.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        self.writer.transport.abort()

    async def take(self, count: int) -> bytes:
        async with asyncio.timeout(PATIENCE):
            return await self.reader.readexactly(count)

    async def rest(self) -> bytes:
        """Everything until the end, which has to come in good order."""
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
        """Whether nothing comes, in a while in which it could."""
        try:
            async with asyncio.timeout(0.05):
                await self.reader.read(1)
        except TimeoutError:
            return True
        return False


class Server:
    """Listens, and hands out its ends of the connections, in their order."""

    def __init__(self) -> None:
        self.port = 0
        self.all: list[End] = []
        self._new: asyncio.Queue[End] = asyncio.Queue()

    def came(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self.all.append(End(reader, writer))
        self._new.put_nowait(self.all[-1])

    async def end(self) -> End:
        async with asyncio.timeout(PATIENCE):
            return await self._new.get()


class Pair:
    """Both ends of a connection through a proxy, and the connection in it."""

    def __init__(self, client: End, server: End, connection: FlakyConnection) -> None:
        self.client, self.server, self.connection = client, server, connection

    def ends(self, way: str) -> tuple[End, End]:
        """Who sends, and who receives."""
        return (self.client, self.server) if way == "up" else (self.server, self.client)

    def passed(self, way: str) -> int:
        return self.connection.bytes_up if way == "up" else self.connection.bytes_down

    async def is_whole(self) -> bool:
        """Whether bytes still pass, both ways."""
        for way in ("up", "down"):
            sender, receiver = self.ends(way)
            sender.write(b"ping")
            if await receiver.take(4) != b"ping":
                return False
        return True


class Ends:
    """Makes connections to a server, through proxies; all are dropped in the end."""

    def __init__(self, server: Server) -> None:
        self.server = server
        self.clients: list[End] = []

    async def client(self, proxy: FlakyProxy) -> End:
        """A client of the proxy, which need not get through."""
        async with asyncio.timeout(PATIENCE):
            end = End(*await asyncio.open_connection(proxy.host, proxy.port))
        self.clients.append(end)
        return end

    async def pair(self, proxy: FlakyProxy) -> Pair:
        """A client that has got through."""
        client = await self.client(proxy)
        server = await self.server.end()
        return Pair(client, server, proxy.connections[-1])


def other(way: str) -> str:
    return "down" if way == "up" else "up"
