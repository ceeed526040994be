"""The tunable numbers of a node: how long to wait, and how much to accept."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, fields
from typing import Any, Literal, get_args

from aioros1._public import public

__all__ = [
    "DEFAULT_QUEUE_SIZE",
    "LOCAL_TRANSPORTS",
    "Limits",
    "LocalTransport",
    "NodeOptions",
    "OnError",
    "Overflow",
    "Timeouts",
    "check_queue",
]

Overflow = Literal["drop_oldest", "drop_newest", "block"]
"""What happens to a message when a queue is full."""

OnError = Literal["raise", "log"] | Callable[[Exception], object]
"""What becomes of an exception that a user's callback raises where nobody awaits it."""

LocalTransport = Literal["intraprocess", "unix"]
"""A way for messages between nodes of this library: within one event loop, within one host."""

LOCAL_TRANSPORTS: tuple[LocalTransport, ...] = ()
"""The default of the option ``local_transports``."""

DEFAULT_QUEUE_SIZE = 10
"""Messages that wait in the queue of a publisher or a subscriber by default."""


@public
@dataclass(frozen=True, slots=True, kw_only=True)
class Timeouts:
    """How long a node waits for others, in seconds."""

    connect: float = 5.0
    """For a TCP connection to a peer to be established."""

    handshake: float = 10.0
    """For a peer to send its whole connection header."""

    xmlrpc: float = 5.0
    """For the answer of a master or a node to one XML-RPC request."""

    close: float = 3.0
    """For everything :meth:`Node.close` has to say to others, in all."""

    stall: float = 30.0
    """For a peer that takes nothing of what is sent to it, before it is cut off."""

    keepalive: float = 60.0
    """For a peer that is silent, before TCP asks it for a sign of life, and then again and
    again. One that gives none for two and a half times as long, or for ``stall`` if that is
    longer, is taken for dead. Whole seconds, at least 1."""


@public
@dataclass(frozen=True, slots=True, kw_only=True)
class Limits:
    """How much a node or a master accepts from others.

    A host is an address: of the machines behind one router, only the router's is seen. What
    comes over Unix sockets, or from the same event loop, counts in ``connections`` alone.

    Raises :class:`ValueError` for a limit that is not a positive number.
    """

    header_bytes: int = 1 << 20
    """A connection header. It carries the full message definition, which is over
    100 kB for the largest types in use."""

    header_fields: int = 256
    """Fields of a connection header; the programs of ROS 1 send about eight."""

    message_bytes: int = 1_000_000_000
    """One message or service request; the limit of roscpp."""

    connections: int = 10_000
    """TCPROS connections accepted at a time; those beyond are closed at once. More than any
    node of a real graph has, and few enough for their memory."""

    connections_per_host: int = 5_000
    """The same for those that come from one host, for TCPROS and for XML-RPC each: half of
    ``connections``, so that no single host can shut out all others. A graph of hundreds of
    nodes on one machine stays far below."""

    xmlrpc_connections: int = 10_000
    """XML-RPC connections accepted at a time. A master has one or two with each node, and
    these are kept for an hour after their last request."""

    xmlrpc_bytes: int = 64 << 20
    """The body of an XML-RPC request or answer: robot descriptions and maps travel
    through the parameter server."""

    xmlrpc_depth: int = 100
    """Arrays and structs inside one another in an XML-RPC value. Parameters of robots have
    up to ten."""

    xmlrpc_values: int = 250_000
    """Values in one XML-RPC request or answer, arrays and structs included. Reading one
    takes 1 to 8 µs whatever its size, during which the event loop does nothing else:
    ``xmlrpc_bytes`` of the smallest would be ten seconds of it, this is one or two. All
    parameters of a large robot are some ten thousand, the state of a graph of a thousand
    nodes a hundred thousand, and a robot description, of whatever size, is one."""

    xmlrpc_timeout: float = 30.0
    """Seconds for the whole of one XML-RPC request to arrive: enough for the largest over
    a slow network."""

    requests_per_second: float | None = None
    """XML-RPC requests of one host that are answered, on the average; each call in a
    ``system.multicall`` is one. Those beyond wait for their turn, and are not refused,
    since a node whose registration is refused gives up; those whose sender has gone
    meanwhile are dropped. By default there is no such limit: roslaunch starts hundreds of
    nodes on one host, and each asks for dozens of things at its start."""

    requests_burst: int = 2_000
    """Requests of one host that are answered at once before ``requests_per_second`` holds,
    after a time of rest: what a hundred nodes ask for when they are started."""

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            if field.name == "requests_per_second" and value is None:
                continue
            whole = field.name not in ("xmlrpc_timeout", "requests_per_second")
            kinds = int if whole else (int, float)
            if not isinstance(value, kinds) or isinstance(value, bool) or not value > 0:
                expected = "a positive whole number" if whole else "a positive number"
                raise ValueError(f"limits.{field.name} must be {expected}, got {value!r}")


# Of these a wrong value would be noticed late, or never: "no" is true.
_KINDS: dict[str, tuple[Any, str]] = {
    "host": (str | None, "a str or None"),
    "bind": (str | None, "a str or None"),
    "remap": (Mapping | None, "a mapping of names or None"),
    "anonymous": (bool, "True or False"),
    "logger_services": (bool, "True or False"),
    "use_sim_time": (bool | None, "True, False or None"),
    "heartbeat": (int | float | None, "a number of seconds or None"),
    "timeouts": (Timeouts, "aioros1.Timeouts"),
    "limits": (Limits, "aioros1.Limits"),
}


@public
@dataclass(frozen=True, slots=True, kw_only=True)
class NodeOptions:
    """What a node was made with; see :class:`Node` for the meaning of each."""

    namespace: str | None = None
    """The namespace; None for ``ROS_NAMESPACE``."""
    master_uri: str | None = None
    """The master; None for ``ROS_MASTER_URI``."""
    host: str | None = None
    """What others are told to connect to; None to find out."""
    bind: str | None = None
    """The address to listen on; None for what ``host`` implies."""
    allow: Collection[str] | None = None
    """The networks from which connections are taken; None for all."""
    xmlrpc_port: int = 0
    """The port of the slave API; 0 takes a free one."""
    tcpros_port: int = 0
    """The port for topics and services; 0 takes a free one."""
    argv: tuple[str, ...] | None = None
    """The command line; None for none."""
    remap: Mapping[str, str] | None = None
    """Names to be replaced, and by what."""
    anonymous: bool = False
    """Whether the name was made unique."""
    rosout: bool | Collection[str] = True
    """Whether ``node.log`` goes to ``/rosout``; or the names of loggers that go there too."""
    logger_services: bool = True
    """Whether the node provides ``~get_loggers`` and ``~set_logger_level``."""
    use_sim_time: bool | None = None
    """Whether the node follows ``/clock``; None for what the parameter says."""
    heartbeat: float | None = 1.0
    """Seconds between two looks after the master; None for none."""
    timeouts: Timeouts = Timeouts()
    """How long the node waits for others."""
    limits: Limits = Limits()
    """How much the node accepts from others."""
    on_error: OnError = "raise"
    """What becomes of an exception in a callback."""
    local_transports: Collection[LocalTransport] = LOCAL_TRANSPORTS
    """How topics may go past TCP."""

    def __post_init__(self) -> None:
        for name, (kind, expected) in _KINDS.items():
            if not isinstance(value := getattr(self, name), kind):
                raise TypeError(f"{name} must be {expected}, got {value!r}")
        for name, port in (("xmlrpc_port", self.xmlrpc_port), ("tcpros_port", self.tcpros_port)):
            if not isinstance(port, int) or isinstance(port, bool) or not 0 <= port <= 65535:
                raise ValueError(f"{name} must be a whole number from 0 to 65535, got {port!r}")
        if self.on_error not in ("raise", "log") and not callable(self.on_error):
            raise ValueError(f"on_error must be 'raise', 'log' or callable, got {self.on_error!r}")
        if self.heartbeat is not None and not self.heartbeat > 0:
            raise ValueError(f"heartbeat must be positive or None, got {self.heartbeat!r}")
        _check_rosout(self.rosout)
        known = get_args(LocalTransport)
        named = self.local_transports
        if isinstance(named, str) or any(each not in known for each in named):
            choices = ", ".join(map(repr, known))
            raise ValueError(f"local_transports must be some of {choices}, got {named!r}")


def _check_rosout(rosout: object) -> None:
    if isinstance(rosout, bool):
        return
    if isinstance(rosout, str) or not isinstance(rosout, Collection):
        raise ValueError(f"rosout must be True, False or names of loggers, got {rosout!r}")
    for name in rosout:
        if not isinstance(name, str) or name in ("", "root"):
            # All that anybody in the process logs: not for the graph to hear, nor to set.
            raise ValueError(f"rosout must name loggers other than the root, got {name!r}")


def check_queue(queue_size: int, overflow: str) -> None:
    """Raise :class:`ValueError` for options of a queue that mean nothing."""
    if not isinstance(queue_size, int) or queue_size < 1:
        raise ValueError(
            f"queue_size must be a whole number of messages, at least 1, got {queue_size!r}"
        )
    if overflow not in get_args(Overflow):
        choices = ", ".join(map(repr, get_args(Overflow)))
        raise ValueError(f"overflow must be one of {choices}, got {overflow!r}")
