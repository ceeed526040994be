"""What roles and nodes have counted."""

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
    """Bytes of those, counted once however many peers there are."""

    dropped: int = 0
    """Messages dropped from a full queue; a message for three peers counts for each."""

    errors: int = 0
    """Messages that could not be decoded, or calls that failed."""


@public
@dataclass(frozen=True, slots=True)
class NodeStats:
    """Sums over the open roles of a node."""

    messages: int
    """Messages published or received, and calls made or answered."""
    bytes: int
    """Bytes of those, counted once however many peers there are."""
    dropped: int
    """Messages dropped from full queues."""
    errors: int
    """Messages that could not be decoded, and calls that failed."""
    roles: int
    """Roles that are open."""
    connections: int
    """TCPROS connections that are open."""
    connections_refused: int
    """Connections closed at once because there were too many: ``connections``,
    ``xmlrpc_connections`` and ``connections_per_host`` of ``limits``."""
    connections_forbidden: int
    """Connections closed at once because their address is not in ``allow``."""
    requests_delayed: int
    """XML-RPC requests that had to wait for ``limits.requests_per_second``."""
