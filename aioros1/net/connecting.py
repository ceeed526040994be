"""TCP connections to whichever address of a host answers first."""

from __future__ import annotations

import asyncio
import socket
from collections.abc import Callable
from typing import TypeVar

from aioros1.net.hosts import is_loopback, resolve

__all__ = ["connect"]

P = TypeVar("P", bound=asyncio.BaseProtocol)

_Address = tuple[socket.AddressFamily, str]

STAGGER = 0.25
"""Seconds one address has before the next is tried beside it, as RFC 8305 proposes."""


async def connect(factory: Callable[[], P], host: str, port: int) -> tuple[asyncio.Transport, P]:
    """A new connection to ``host``, and the protocol that ``factory`` made for it.

    When an address refuses, the next is tried at once, and when it is silent, soon: a
    host may have an IPv6 address that leads nowhere. Raises :class:`OSError`.
    """
    addresses = await resolve(host, port)
    if len(addresses) > 1 and not all(is_loopback(address) for _, address in addresses):
        return await _race(factory, host, addresses, port)
    failures: list[OSError] = []
    for address in addresses:  # this machine is never silent
        try:
            return await _attempt(factory, address, port)
        except OSError as error:
            failures.append(error)
    raise _failure(host, failures)


async def _attempt(
    factory: Callable[[], P], address: _Address, port: int
) -> tuple[asyncio.Transport, P]:
    family, host = address
    # By number and family, which no loop has to look up. Given a socket that is yet to be
    # connected, uvloop would, and starts four threads for it.
    loop = asyncio.get_running_loop()
    return await loop.create_connection(factory, host, port, family=family)


async def _race(
    factory: Callable[[], P], host: str, addresses: list[_Address], port: int
) -> tuple[asyncio.Transport, P]:
    waiting = addresses[::-1]
    running: set[asyncio.Task[tuple[asyncio.Transport, P]]] = set()
    failures: list[OSError] = []
    try:
        while waiting or running:
            if waiting:
                attempt = _attempt(factory, address := waiting.pop(), port)
                task = asyncio.create_task(attempt, name=f"connect {address[1]}:{port}")
                running.add(task)
            done, _ = await asyncio.wait(
                running,
                timeout=STAGGER if waiting else None,
                return_when=asyncio.FIRST_COMPLETED,
            )
            for task in done:
                running.discard(task)
                try:
                    return task.result()
                except OSError as error:
                    failures.append(error)
    finally:
        for task in running:
            # Each by itself: the waiting below may be cancelled.
            task.add_done_callback(_abort)
            task.cancel()
        if running:
            await asyncio.wait(running)
    raise _failure(host, failures)


def _abort(task: asyncio.Task[tuple[asyncio.Transport, P]]) -> None:
    """Nobody wants the connection any more."""
    if not task.cancelled() and task.exception() is None:
        task.result()[0].abort()


def _failure(host: str, failures: list[OSError]) -> OSError:
    if not failures:
        return OSError(f"{host} has no address")
    if len({error.errno for error in failures}) == 1:
        return failures[0]  # the same for each address
    return OSError(", ".join(map(str, failures)))
