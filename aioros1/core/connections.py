"""The TCPROS connections of one node: those of topics, and those of services."""

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
    """Every connection that carries messages, whatever uses it."""

    def __init__(self, emit: Callable[[Event], None]) -> None:
        self._emit = emit
        self._links: dict[Link, tuple[str, ConnectionInfo]] = {}

    @property
    def infos(self) -> tuple[ConnectionInfo, ...]:
        """What there is to know of each, the oldest first."""
        return tuple(info for _, info in self._links.values())

    def add(self, kind: str, link: Link, info: ConnectionInfo) -> None:
        """A connection carries messages from now on. ``kind`` is that of the role."""
        self._links[link] = kind, info
        self._emit(PeerConnected(kind, info.name, info))

    def remove(self, link: Link, reason: str = "") -> None:
        """A connection has ended. Does nothing for one that was removed before."""
        entry = self._links.pop(link, None)
        if entry is not None:
            kind, info = entry
            self._emit(PeerDisconnected(kind, info.name, info, reason))

    def abort_at(self, host: str) -> None:
        """Close the connections of an address that this machine has lost: nothing comes
        there any more, not even their end."""
        for link, (_, info) in tuple(self._links.items()):
            if info.local[0] == host:
                link.abort()
