"""Connects to whichever address of a host answers first."""

from __future__ import annotations

import asyncio
import errno
import os
import socket
from collections.abc import Callable
from typing import TypeVar

from aioros1.net.hosts import all_loopback, resolve

__all__ = ["connect", "is_exhausted", "reason_of"]

P = TypeVar("P", bound=asyncio.BaseProtocol)

_Address = tuple[socket.AddressFamily, str]

# What the system answers when this process, or the whole machine, has none left.
_EXHAUSTED = frozenset({errno.EMFILE, errno.ENFILE, errno.ENOBUFS, errno.ENOMEM})

STAGGER = 0.25
"""Seconds before the next address is tried in parallel, as RFC 8305 recommends."""


async def connect(factory: Callable[[], P], host: str, port: int) -> tuple[asyncio.Transport, P]:
    """Connect to ``host`` and return the transport and the protocol that ``factory`` made.

    If an address refuses, the next is tried at once; if it does not answer, after a quarter
    of a second and in parallel. (A host may have an IPv6 address that leads nowhere.)
    Raises :class:`OSError`.
    """
    addresses = await resolve(host)
    if len(addresses) > 1 and not all_loopback(addresses):
        return await _race(factory, host, addresses, port)
    failures: list[OSError] = []
    for address in addresses:  # this machine answers at once
        try:
            return await _attempt(factory, address, port)
        except OSError as error:
            failures.append(error)
    raise _failure(host, failures)


async def _attempt(
    factory: Callable[[], P], address: _Address, port: int
) -> tuple[asyncio.Transport, P]:
    family, host = address
    loop = asyncio.get_running_loop()
    numeric, _, zone = host.partition("%")
    if zone:
        sock = socket.socket(family, socket.SOCK_STREAM)
        try:
            await _connect_in_zone(sock, numeric, port, zone)
            return await loop.create_connection(factory, sock=sock)
        except BaseException:
            sock.close()
            raise
    # A numeric address with its family needs no look-up. uvloop would look up the address of
    # a socket that is passed to it unconnected, and would start four threads for that.
    return await loop.create_connection(factory, host, port, family=family)


async def _connect_in_zone(sock: socket.socket, host: str, port: int, zone: str) -> None:
    """Connect to a link-local address, as event loops do not without looking it up."""
    loop = asyncio.get_running_loop()
    sock.setblocking(False)
    index = int(zone) if zone.isdecimal() else socket.if_nametoindex(zone)
    error = sock.connect_ex((host, port, 0, index))
    if error == errno.EINPROGRESS:
        is_writable: asyncio.Future[None] = loop.create_future()
        loop.add_writer(sock, _settle, is_writable)
        try:
            await is_writable
        finally:
            loop.remove_writer(sock)
        error = sock.getsockopt(socket.SOL_SOCKET, socket.SO_ERROR)
    if error:
        raise OSError(error, f"{os.strerror(error)} ([{host}%{zone}]:{port})")


def _settle(future: asyncio.Future[None]) -> None:
    if not future.done():
        future.set_result(None)


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
            # As a callback, because the wait below may be cancelled.
            task.add_done_callback(_abort)
            task.cancel()
        if running:
            await asyncio.wait(running)
    raise _failure(host, failures)


def _abort(task: asyncio.Task[tuple[asyncio.Transport, P]]) -> None:
    """Close a connection that another one has beaten."""
    if not task.cancelled() and task.exception() is None:
        task.result()[0].abort()


def _failure(host: str, failures: list[OSError]) -> OSError:
    if not failures:
        return OSError(f"{host} has no address")
    if len({error.errno for error in failures}) == 1:
        return failures[0]  # the same for each address
    return OSError(", ".join(dict.fromkeys(map(reason_of, failures))))


def reason_of(error: OSError) -> str:
    """Why a connection failed, in the words of the system, without numbers and addresses.

    The same failure then has the same text, with either event loop and on each address.
    """
    number = error.errno
    if number is not None and number > 0:  # those of gaierror are negative, and its own
        return os.strerror(number)
    return error.strerror or str(error)


def is_exhausted(error: BaseException | None) -> bool:
    """Whether this side had no descriptor or memory left, which says nothing of the other."""
    while error is not None:
        if isinstance(error, OSError) and error.errno in _EXHAUSTED:
            return True
        error = error.__context__  # its cause is hidden from users
    return False
