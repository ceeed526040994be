"""A stream of ours and a bare socket, and what to do with them."""

from __future__ import annotations

import asyncio
import socket

from aioros1.net.tcpros import Stream

__all__ = ["drop", "hear", "say"]


async def drop(*streams: Stream) -> None:
    for stream in streams:
        stream.abort()
    for _ in range(5):  # event loops close things in a later turn
        await asyncio.sleep(0)


async def say(sock: socket.socket, data: bytes) -> None:
    await asyncio.get_running_loop().sock_sendall(sock, data)


async def hear(sock: socket.socket) -> bytes:
    return await asyncio.get_running_loop().sock_recv(sock, 1 << 20)
