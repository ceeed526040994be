"""Information about one connection, for users and for the slave API."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from aioros1._public import public
from aioros1.quoting import printable

__all__ = ["ConnectionInfo", "ConnectionStats"]

# Connection ids need only be unique within a node. One counter for all nodes of a process
# costs nothing and makes logs easier to read.
_ids = itertools.count(1)


@public
@dataclass(slots=True)
class ConnectionStats:
    """Counters of one connection. They only ever grow."""

    messages: int = 0
    """Messages or service calls that the connection has carried."""

    bytes: int = 0
    """Bytes of those messages, their length prefixes included."""

    dropped: int = 0
    """Messages dropped because the other side was too slow."""


@public
@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class ConnectionInfo:
    """One connection of a role.

    ``stats`` keeps counting; everything else is fixed when the connection is made.
    """

    id: int = field(default_factory=_ids.__next__)
    """Unique within the node; the id that ``getBusInfo`` and ``getBusStats`` show."""

    name: str
    """The topic or service."""

    direction: Literal["i", "o", "b"]
    """Whether messages come in, go out, or both (services)."""

    peer: str
    """The caller id of the other side, which may be any text; if that is a publisher, the URI
    of its node."""

    local: tuple[str, int]
    """The address and port on our side; ``("", 0)`` if the transport is not TCP."""

    remote: tuple[str, int]
    """The address and port on the other side, likewise."""

    fileno: int
    """The file descriptor of the socket; -1 if there is none."""

    header: Mapping[str, str]
    """The connection header that the other side sent."""

    transport: str = "TCPROS"
    """``TCPROS``, or ``UNIXROS`` or ``INTRAPROCESS`` between nodes of this library."""

    stats: ConnectionStats = field(default_factory=ConnectionStats)

    def __repr__(self) -> str:
        ours = {name: getattr(self, name) for name in ("id", "name", "direction")}
        # Without the header, which holds a whole definition.
        words = [f"{name}={value!r}" for name, value in ours.items()]
        words += [f"peer='{printable(self.peer)}'", f"transport={self.transport!r}"]
        words += [f"local={self.local!r}", f"remote={self.remote!r}", f"stats={self.stats!r}"]
        return f"ConnectionInfo({', '.join(words)})"

    @property
    def description(self) -> str:
        """The text from which ``rosnode info`` takes the port numbers."""
        if self.transport != "TCPROS":
            return f"{self.transport} connection"
        return (
            f"{self.transport} connection on port {self.local[1]} to "
            f"[{self.remote[0]}:{self.remote[1]} on socket {self.fileno}]"
        )
