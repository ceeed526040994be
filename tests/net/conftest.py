"""Fixtures for what is made of asyncio's streams."""

from __future__ import annotations

import asyncio
import socket
from collections.abc import AsyncIterator, Iterator

import pytest

from aioros1.net.tcpros import Stream

from .sockets import drop


@pytest.fixture
async def pair() -> AsyncIterator[tuple[Stream, socket.socket]]:
    """A stream, and the bare socket at its other end."""
    ours, theirs = socket.socketpair(socket.AF_UNIX)
    theirs.setblocking(False)
    stream = Stream(*await asyncio.open_connection(sock=ours))
    yield stream, theirs
    theirs.close()
    await drop(stream)


@pytest.fixture
def listening() -> Iterator[socket.socket]:
    with socket.socket() as sock:
        sock.bind(("127.0.0.1", 0))
        sock.listen()
        sock.setblocking(False)
        yield sock
