"""Transports faster than TCP between nodes of this library: on one host, in one event loop.

With ``requestTopic`` a subscriber asks a publisher for TCPROS and, after it, for the other
transports it knows; other libraries ignore those. Each request names where the subscriber
is, so that only a publisher in the same place accepts it:

* ``["INTRAPROCESS", loop]``: a random token of the event loop. Answered with the key of a
  node in it. Two loops of one process, in two threads, are two places.
* ``["UNIXROS", host]``: a digest that identifies a running kernel and one of its network
  namespaces, which is as far as abstract Unix sockets reach. Host names do not identify
  them, because containers share them. Answered with the name of a socket.

On both, the handshake and the messages are those of TCPROS.
"""

from __future__ import annotations

import asyncio
import functools
import os
import re
import socket
import sys
from collections.abc import Collection, Mapping, Sequence
from typing import Any

from aioros1.net.loop_state import LoopState, loop_state
from aioros1.net.tcpros import Listener, Stream, StreamProtocol
from aioros1.options import LocalTransport

__all__ = ["INTRAPROCESS", "UNIXROS", "LocalTransports"]

INTRAPROCESS = "INTRAPROCESS"
UNIXROS = "UNIXROS"

_SOCKET_NAME = re.compile(r"aioros1\.[0-9a-f]{32}")


@functools.lru_cache(1)
def _host_key() -> str | None:
    """Identify the host and network namespace, within which abstract Unix sockets work.

    A digest, so that the parts are not disclosed. ``None`` where there are no such sockets,
    or the parts cannot be read.
    """
    if not sys.platform.startswith("linux"):
        return None
    try:
        with open("/proc/sys/kernel/random/boot_id", encoding="ascii") as file:
            boot = file.read().strip()
        namespace = os.stat("/proc/self/ns/net")
    except (OSError, ValueError):
        return None
    import hashlib  # here, as most programs need neither this nor what it imports

    parts = f"aioros1 {boot} {namespace.st_dev} {namespace.st_ino}"
    return hashlib.sha256(parts.encode()).hexdigest()[:32]


class LocalTransports:
    """The local transports of one node, for both sides of its topics.

    ``wanted`` names those to use. ``listener`` serves their connections together with those
    over TCP, and under the same limits.
    """

    def __init__(self, wanted: Collection[LocalTransport], listener: Listener) -> None:
        self._in_process = "intraprocess" in wanted
        self._unix = "unix" in wanted
        self._listener = listener
        self._loop_state: LoopState | None = None  # while others may connect within the loop
        self._key = os.urandom(16).hex()
        self._name: str | None = None

    async def start(self) -> None:
        """Let others connect. A transport that the system does not offer is left out."""
        if self._in_process:
            self._loop_state = loop_state()
            self._loop_state.listeners[self._key] = self._listener.new_protocol
        if self._unix and _host_key() is not None:
            name = f"aioros1.{self._key}"
            try:
                await self._listener.listen_unix(f"\0{name}")
            except OSError:
                return  # forbidden, perhaps by a sandbox
            self._name = name

    def close(self) -> None:
        """Accept no more connections; open ones stay open."""
        self._name = None
        if self._loop_state is not None:
            self._loop_state.listeners.pop(self._key, None)
            self._loop_state = None

    # a subscriber's side

    def offers(self) -> list[list[str]]:
        """Return what to ask a publisher for, besides TCPROS."""
        offers = []
        if self._in_process:
            offers.append([INTRAPROCESS, loop_state().token])
        if self._unix and (host := _host_key()) is not None:
            offers.append([UNIXROS, host])
        return offers

    async def connect(self, answer: Sequence[Any]) -> Stream:
        """Connect to the publisher that answered a request with ``answer``.

        Raises :class:`ConnectionError`.
        """
        match answer:
            case ["INTRAPROCESS", str(key)] if self._in_process:
                return _connect_in_process(key)
            case ["UNIXROS", str(name)] if self._unix and _SOCKET_NAME.fullmatch(name):
                # Only sockets of this library: a publisher must not be able to send us
                # to any other service of the host.
                return await _connect_unix(name)
        raise ConnectionError(f"cannot use {answer!r:.200}")

    # a publisher's side

    def answer(self, protocols: Sequence[Sequence[Any]]) -> list[str] | None:
        """Return the answer to a subscriber that asks for ``protocols``; None means TCPROS."""
        wanted: Mapping[str, Any] = {each[0]: each[1] for each in protocols if len(each) == 2}
        state = self._loop_state
        if state is not None and wanted.get(INTRAPROCESS) == state.token:
            return [INTRAPROCESS, self._key]
        if self._name is not None and wanted.get(UNIXROS) == _host_key():
            return [UNIXROS, self._name]
        return None


def _connect_in_process(key: str) -> Stream:
    their_protocol = loop_state().listeners.get(key)
    if their_protocol is None:
        raise ConnectionRefusedError("no such node in this event loop")
    from aioros1.net.in_process import connect_in_memory

    loop = asyncio.get_running_loop()
    reader = asyncio.StreamReader(loop=loop)
    protocol = asyncio.StreamReaderProtocol(reader, loop=loop)
    transport, _ = connect_in_memory(protocol, their_protocol())
    return Stream(reader, asyncio.StreamWriter(transport, protocol, reader, loop))


async def _connect_unix(name: str) -> Stream:
    loop = asyncio.get_running_loop()
    reader = asyncio.StreamReader(loop=loop)
    sock = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    try:
        sock.setblocking(False)
        # This never waits, and fails if too many others are waiting to be accepted. asyncio
        # would take that failure for a connection in progress, as it is with TCP.
        sock.connect(f"\0{name}")
        transport, protocol = await loop.create_unix_connection(
            lambda: StreamProtocol(reader, loop=loop), sock=sock
        )
    except BaseException:
        sock.close()
        raise
    return Stream(reader, asyncio.StreamWriter(transport, protocol, reader, loop))
