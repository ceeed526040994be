"""Accepting connections: one loop for every listening socket of a node or a master.

``loop.create_server`` would do, but for two things. Without free file descriptors it tries
again as often as its backlog is long, each time with a traceback. And a connection that it has
accepted while it is closed, it forgets.
"""

from __future__ import annotations

import asyncio
import logging
import socket
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from typing import Any

from aioros1.net.admission import Admission
from aioros1.net.connecting import is_exhausted

__all__ = ["ListeningSocket"]

_BATCH = 64
"""Connections accepted in one iteration of the event loop. Others have to have their turn."""

_PAUSE = 0.5
"""Seconds until it tries again when the system has no room for a connection."""


class ListeningSocket:
    """Accepts connections on ``sock``, and makes a transport for each that may stay.

    ``admission`` decides before anything is made for a connection. ``protocol`` makes the
    protocol of one; it is called with the host that the admission has named, and must give
    that back with :meth:`.Admission.leave` when the connection ends.
    """

    def __init__(
        self,
        sock: socket.socket,
        protocol: Callable[[str], asyncio.BaseProtocol],
        *,
        admission: Admission,
        log: logging.Logger | logging.LoggerAdapter[Any],
    ) -> None:
        self._sock = sock
        self._protocol = protocol
        self._admission = admission
        self._log = log
        self._loop = asyncio.get_running_loop()
        self._connecting: set[asyncio.Task[None]] = set()
        self._pause: asyncio.TimerHandle | None = None
        self._is_closed = False
        self._told = False
        self._loop.add_reader(sock.fileno(), self._accept)

    def close(self) -> None:
        """Accept no more connections. Those that have a protocol stay open."""
        if self._is_closed:
            return
        self._is_closed = True
        if self._pause is not None:
            self._pause.cancel()
        self._loop.remove_reader(self._sock.fileno())
        # A forked process may have the socket as well. This ends it there, too.
        with suppress(OSError):
            self._sock.shutdown(socket.SHUT_RDWR)
        self._sock.close()

    async def wait_closed(self) -> None:
        """Wait until each connection that was accepted has its protocol, or is closed."""
        if self._connecting:
            await asyncio.wait(self._connecting)

    def _accept(self) -> None:
        for _ in range(_BATCH):
            try:
                conn, address = self._sock.accept()
            except OSError as error:
                if is_exhausted(error):
                    self._wait_for_room(error)
                # Else there are no more, or this one has gone again; or its network is down.
                return
            self._told = False
            conn.setblocking(False)
            host = self._admission.enter(conn, address)
            if host is None:
                conn.close()
                continue
            task = self._loop.create_task(self._connect(conn, host))
            self._connecting.add(task)
            task.add_done_callback(self._connecting.discard)

    def _wait_for_room(self, error: OSError) -> None:
        self._loop.remove_reader(self._sock.fileno())
        self._pause = self._loop.call_later(_PAUSE, self._resume)
        if not self._told:
            self._told = True
            self._log.error(
                "%s: cannot accept connections: %s; new ones wait until there is room",
                self._admission.what,
                error.strerror,
            )

    def _resume(self) -> None:
        self._pause = None
        self._loop.add_reader(self._sock.fileno(), self._accept)

    async def _connect(self, conn: socket.socket, host: str) -> None:
        """Make the transport. The sockets of connections that come too late are closed here."""
        transport: Any = None  # an asyncio.Transport, of which asyncio's types say less
        if not self._is_closed:
            with suppress(OSError):  # the peer has gone
                transport, _ = await self._loop.connect_accepted_socket(
                    partial(self._protocol, host), conn
                )
        if transport is None:
            conn.close()
            self._admission.leave(host)
        elif self._is_closed:
            transport.abort()
