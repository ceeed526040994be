"""A server, a proxy before it, and connections through it."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator

import pytest

from aioros1.testing import FlakyProxy

from .ends import Ends, Pair, Server


@pytest.fixture
async def server() -> AsyncIterator[Server]:
    server = Server()
    listening = await asyncio.start_server(server.came, "127.0.0.1", 0)
    server.port = listening.sockets[0].getsockname()[1]
    yield server
    listening.close()
    for end in server.all:
        end.writer.transport.abort()
    await asyncio.sleep(0)


@pytest.fixture
async def ends(server) -> AsyncIterator[Ends]:
    ends = Ends(server)
    yield ends
    for end in (*ends.clients, *server.all):
        end.writer.transport.abort()
    for _ in range(5):  # event loops close things in a later turn
        await asyncio.sleep(0)


@pytest.fixture
async def proxy(server) -> AsyncIterator[FlakyProxy]:
    async with FlakyProxy("127.0.0.1", server.port) as proxy:
        yield proxy


@pytest.fixture
async def pair(proxy, ends) -> Pair:
    return await ends.pair(proxy)
