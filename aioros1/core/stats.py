"""Counters of roles and nodes."""

from __future__ import annotations

from dataclasses import dataclass

from aioros1._public import public

__all__ = ["NodeStats", "RoleStats"]


@public
@dataclass(slots=True)
class RoleStats:
    """Counters of one role since it was opened. They only ever grow."""

    messages: int = 0
    """Messages published or received, or calls made or answered."""

    bytes: int = 0
    """Bytes of those messages, counted once however many peers there are."""

    dropped: int = 0
    """Messages dropped from a full queue; a message for three peers counts once per peer."""

    errors: int = 0
    """Messages that could not be decoded, or calls that failed."""


@public
@dataclass(frozen=True, slots=True)
class NodeStats:
    """Sums over the open roles of a node."""

    messages: int
    """Messages published or received, and calls made or answered."""
    bytes: int
    """Bytes of those messages, counted once however many peers there are."""
    dropped: int
    """Messages dropped from full queues."""
    errors: int
    """Messages that could not be decoded, and calls that failed."""
    roles: int
    """Open roles."""
    connections: int
    """Open TCPROS connections."""
    connections_refused: int
    """Connections closed at once because they exceeded ``connections``,
    ``xmlrpc_connections`` or ``connections_per_host`` of ``limits``."""
    connections_forbidden: int
    """Connections closed at once because their address is not in ``allow``."""
    requests_delayed: int
    """XML-RPC requests that had to wait for ``limits.requests_per_second``."""
    bytes_in_flight: int = 0
    """Bytes of what is arriving, or waits to be read by others, that count for
    ``limits.bytes_in_flight``."""
    connections_cut: int = 0
    """Connections closed because all together held more than ``limits.bytes_in_flight``."""
    publishers_followed: int = 0
    """Publishers that the node is connected to, or tries to connect to."""
