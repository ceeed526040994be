"""Decides whether an incoming connection may stay, before a byte of it is read."""

from __future__ import annotations

import asyncio
import logging
import os
import socket
import struct
from contextlib import suppress
from typing import Any

from aioros1.net.allow import THIS_MACHINE, Address, AllowList, host_of, parse_address
from aioros1.net.hosts import is_local
from aioros1.net.rate_limit import Seldom

__all__ = ["THIS_HOST", "Admission"]

THIS_HOST = ""
"""The host of a peer that connected over a Unix socket or within the process. It is on this
machine, is allowed if it belongs to the same user or to root, and does not count against
``connections_per_host``."""

_CREDENTIALS = struct.Struct("3i")  # process, user, group
_INTERNET = (socket.AF_INET, socket.AF_INET6)


class Admission:
    """Guards one port: checks peers against an allow-list and limits their connections.

    ``what`` names the port in the log; ``total`` is a field of ``Limits`` and its value.
    A refusal is logged once a minute for each address, and for at most 256 addresses a
    minute.
    """

    def __init__(
        self,
        what: str,
        *,
        allow: AllowList | None = None,
        total: tuple[str, int],
        per_host: int,
        log: logging.Logger | logging.LoggerAdapter[Any],
    ) -> None:
        self.what = what
        self._allow = allow if allow is not None else AllowList(None)
        self._total_name, self._total = total
        self._per_host = per_host
        self._log = log
        self._seldom = Seldom()
        self._hosts: dict[str, int] = {}
        self.open = 0
        """Connections that are open now."""
        self.refused = 0
        """Connections refused so far because there were too many."""
        self.forbidden = 0
        """Connections refused so far because their address, or their user, is not allowed."""

    def enter(self, sock: socket.socket | None = None, peername: Any = None) -> str | None:
        """Decide about a new connection, of which ``accept()`` has given ``sock`` and
        ``peername``. A connection within the process has neither.

        Returns the host it comes from, as :func:`.host_of` names it, or ``None`` if you must
        close it at once. :meth:`leave` needs the host when the connection ends.
        """
        host = THIS_HOST
        if sock is not None and sock.family in _INTERNET:
            try:
                address = parse_address(peername[0])
            except (TypeError, ValueError):
                return None  # the peer has gone already, and its address is unknown
            host = self._host_of(address)
            if address not in self._allow:
                self.forbidden += 1
                self._tell(str(address), "it is not in allow")
                return None
        elif sock is not None and (user := _user_of(sock)) not in (0, os.geteuid()):
            # An abstract socket has no permissions, and everybody on the host can list its name.
            self.forbidden += 1
            self._tell(host, f"it belongs to user {user}, and this process to {os.geteuid()}")
            return None
        if self.open >= self._total:
            self.refused += 1
            self._tell(host, f"there are {self._total} already (limits.{self._total_name})")
            return None
        if host:
            count = self._hosts.get(host, 0)
            if count >= self._per_host:
                self.refused += 1
                self._tell(
                    host, f"there are {count} from there already (limits.connections_per_host)"
                )
                return None
            self._hosts[host] = count + 1
        self.open += 1
        return host

    def leave(self, host: str) -> None:
        """Note that a connection which :meth:`enter` admitted has ended."""
        self.open -= 1
        if host:
            count = self._hosts.pop(host) - 1
            if count:
                self._hosts[host] = count

    def _host_of(self, address: Address) -> str:
        host = host_of(address)
        if host not in self._hosts:  # as the system has to tell
            with suppress(OSError):  # without a free descriptor it cannot
                if is_local(str(address)):
                    return THIS_MACHINE
        return host

    def _tell(self, host: str, why: str) -> None:
        if self._seldom(host, asyncio.get_running_loop().time()):
            self._log.warning(
                "refused a connection from %s to %s: %s", host or "this host", self.what, why
            )


def _user_of(sock: socket.socket) -> int:
    """The user who opened the other end of a Unix socket."""
    option: int = socket.SO_PEERCRED  # on Linux, and nowhere else are there abstract sockets
    credentials = sock.getsockopt(socket.SOL_SOCKET, option, _CREDENTIALS.size)
    return int(_CREDENTIALS.unpack(credentials)[1])
