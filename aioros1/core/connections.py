"""The TCPROS connections of one node, for topics and services."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Protocol

from aioros1.connection import ConnectionInfo
from aioros1.events import Event, PeerConnected, PeerDisconnected

__all__ = ["Connections", "Link"]


class Link(Protocol):
    """One connection."""

    def abort(self) -> None:
        """Close it at once."""


_NAMES = frozenset({"callerid", "md5sum", "service", "topic", "type"})  # bounded by the handshake
_FLAGS = frozenset({"latching", "persistent", "probe", "tcp_nodelay"})
_FLAG = 8  # characters
_FIELD = 100  # bytes that a field takes beside its text


class Connections:
    """Every connection that carries messages, whichever role uses it.

    Each keeps the header of the other side, for as long as it lasts. ``header_bytes`` is how
    much they keep in sum; see :meth:`kept`.
    """

    def __init__(self, emit: Callable[[Event], None], header_bytes: int) -> None:
        self._emit = emit
        self._links: dict[Link, tuple[str, ConnectionInfo, int]] = {}
        self._header_room = header_bytes

    def kept(self, header: dict[str, str]) -> dict[str, str]:
        """What a connection keeps of the header that came: all, as long as there is room.

        Without room it keeps the names and flags that ROS 1 defines.
        """
        if _size(header) <= self._header_room:
            return header
        names = {name: value for name, value in header.items() if name in _NAMES}
        flags = {name: value[:_FLAG] for name, value in header.items() if name in _FLAGS}
        return names | flags

    @property
    def infos(self) -> tuple[ConnectionInfo, ...]:
        """Information about each connection, oldest first."""
        return tuple(info for _, info, _ in self._links.values())

    def add(self, kind: str, link: Link, info: ConnectionInfo) -> None:
        """Add a connection that now carries messages. ``kind`` is the role's kind."""
        size = _size(info.header)
        self._links[link] = kind, info, size
        self._header_room -= size
        self._emit(PeerConnected(kind, info.name, info))

    def remove(self, link: Link, reason: str = "") -> None:
        """Remove a connection that has ended. Does nothing if it was removed before."""
        entry = self._links.pop(link, None)
        if entry is not None:
            kind, info, size = entry
            self._header_room += size
            self._emit(PeerDisconnected(kind, info.name, info, reason))

    def abort_at(self, host: str) -> None:
        """Close the connections of an address that this machine has lost. Nothing arrives
        there any more, not even the end of a connection."""
        for link, (_, info, _) in tuple(self._links.items()):
            if info.local[0] == host:
                link.abort()


def _size(header: Mapping[str, str]) -> int:
    return sum(map(len, header)) + sum(map(len, header.values())) + _FIELD * len(header)
