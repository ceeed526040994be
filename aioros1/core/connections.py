"""The TCPROS connections of one node, for topics and services."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from aioros1.connection import ConnectionInfo
from aioros1.events import Event, PeerConnected, PeerDisconnected

__all__ = ["Connections", "Link"]


class Link(Protocol):
    """One connection."""

    def abort(self) -> None:
        """Close it at once."""


class Connections:
    """Every connection that carries messages, whichever role uses it."""

    def __init__(self, emit: Callable[[Event], None]) -> None:
        self._emit = emit
        self._links: dict[Link, tuple[str, ConnectionInfo]] = {}

    @property
    def infos(self) -> tuple[ConnectionInfo, ...]:
        """Information about each connection, oldest first."""
        return tuple(info for _, info in self._links.values())

    def add(self, kind: str, link: Link, info: ConnectionInfo) -> None:
        """Add a connection that now carries messages. ``kind`` is the role's kind."""
        self._links[link] = kind, info
        self._emit(PeerConnected(kind, info.name, info))

    def remove(self, link: Link, reason: str = "") -> None:
        """Remove a connection that has ended. Does nothing if it was removed before."""
        entry = self._links.pop(link, None)
        if entry is not None:
            kind, info = entry
            self._emit(PeerDisconnected(kind, info.name, info, reason))

    def abort_at(self, host: str) -> None:
        """Close the connections of an address that this machine has lost. Nothing arrives
        there any more, not even the end of a connection."""
        for link, (_, info) in tuple(self._links.items()):
            if info.local[0] == host:
                link.abort()
