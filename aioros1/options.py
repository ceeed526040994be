"""The tunable numbers of a node: how long to wait, and how much to accept."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, fields
from typing import Any, Literal, get_args

from aioros1._public import public
from aioros1.hints import check_kinds

__all__ = [
    "DEFAULT_QUEUE_SIZE",
    "LOCAL_TRANSPORTS",
    "Limits",
    "LocalTransport",
    "NodeOptions",
    "OnError",
    "Overflow",
    "Timeouts",
    "WithoutMaster",
    "check_queue",
]

Overflow = Literal["drop_oldest", "drop_newest", "block"]
"""What happens to a message when a queue is full."""

OnError = Literal["raise", "log"] | Callable[[Exception], object]
"""What happens to an exception in a user's callback that nobody awaits."""

WithoutMaster = Literal["raise", "wait", "later"]
"""What opening a role does while no master answers."""

LocalTransport = Literal["intraprocess", "unix"]
"""A transport between nodes of this library, within one event loop or within one host."""

LOCAL_TRANSPORTS: tuple[LocalTransport, ...] = ()
"""The default of the option ``local_transports``."""

DEFAULT_QUEUE_SIZE = 10
"""The default queue size of a publisher or subscriber, in messages."""


@public
@dataclass(frozen=True, slots=True, kw_only=True)
class Timeouts:
    """How long a node waits for others, in seconds."""

    connect: float = 5.0
    """For connecting to a peer over TCP."""

    handshake: float = 10.0
    """For a peer to send its whole connection header."""

    xmlrpc: float = 5.0
    """For the answer of a master or a node to one XML-RPC request."""

    close: float = 3.0
    """For everything that :meth:`Node.close` has to tell others, in total."""

    stall: float = 30.0
    """For a peer that reads nothing of what is sent to it, before it is disconnected."""

    keepalive: float = 60.0
    """For a silent peer, before TCP starts to send it keepalive probes. A peer that does not
    answer for two and a half times as long, or for ``stall`` if that is longer, is considered
    dead. Whole seconds, at least 1."""


@public
@dataclass(frozen=True, slots=True, kw_only=True)
class Limits:
    """How much a node or a master accepts from others.

    A host is an IPv4 address or an IPv6 network of 64 bits: all machines behind one NAT router
    count as one host. All addresses of this machine are one host. Connections over Unix
    sockets, or within one event loop, count only in ``connections``.

    Raises :class:`ValueError` for a limit that is not a positive number.
    """

    header_bytes: int = 1 << 20
    """Bytes of a connection header. It carries the full message definition, which is over
    100 kB for the largest types in use."""

    header_fields: int = 256
    """Fields of a connection header. ROS 1 programs send about eight."""

    kept_header_bytes: int = 32 << 20
    """Bytes of connection headers that a node keeps in sum, while their connections last.
    Beyond that it keeps only the names and flags that ROS 1 defines, so that
    ``ConnectionInfo.header`` lacks the rest."""

    message_bytes: int = 1_000_000_000
    """Bytes of one message or service request; the same limit as in roscpp."""

    connections: int = 10_000
    """TCPROS connections open at a time; further ones are closed at once. The default is more
    than any node of a real graph has, and few enough to fit in memory."""

    connections_per_host: int = 5_000
    """Connections from one host, separately for TCPROS and XML-RPC. The default is half of
    ``connections``, so that no single host can shut out all others. A graph of hundreds of
    nodes on one machine stays far below it."""

    publishers: int = 10_000
    """Publishers that a node follows, in sum over its topics. Anybody can send a node a list
    of them; further ones wait until others have gone."""

    xmlrpc_connections: int = 10_000
    """XML-RPC connections open at a time. A master has one or two with each node, and keeps
    them for an hour after their last request."""

    xmlrpc_bytes: int = 64 << 20
    """Bytes of the body of an XML-RPC request or answer. Robot descriptions and maps go
    through the parameter server."""

    bytes_in_flight: int = 512 << 20
    """Bytes that a node or a master holds of what is still arriving, or waits to be read by
    others, in sum over all connections, separately for TCPROS and XML-RPC. Beyond that it
    closes the connections that have held most for longest. The first 16 KiB of each connection
    do not count, and one that is alone may hold more, up to its own limit."""

    xmlrpc_depth: int = 100
    """Nesting depth of arrays and structs in an XML-RPC value. Parameters of robots reach up
    to ten."""

    xmlrpc_values: int = 250_000
    """Values in one XML-RPC request or answer, including arrays and structs. Reading a value
    blocks the event loop for 1 to 8 µs, whatever its size: ``xmlrpc_bytes`` of the smallest
    values would block it for ten seconds, this limit for one or two. All parameters of a large
    robot are some ten thousand values, the state of a graph of a thousand nodes is a hundred
    thousand, and a robot description of any size is one."""

    xmlrpc_timeout: float = 30.0
    """Seconds for one whole XML-RPC request to arrive. The default is enough for the largest
    request over a slow network."""

    parameter_bytes: int = 256 << 20
    """Bytes of all parameters of a master, about as many as their XML has. A parameter beyond
    that cannot be set."""

    parameter_values: int = 500_000
    """Values of all parameters of a master, namespaces included."""

    registrations: int = 50_000
    """Publishers, subscribers, services and followed parameters that a master keeps, and the
    types of topics, which it never forgets. Further ones are refused. A graph of a thousand
    nodes has some ten thousand."""

    requests_per_second: float | None = None
    """XML-RPC requests answered per host and second, on average. Each call in a
    ``system.multicall`` counts as one. Further requests wait and are not refused, since a
    node gives up when its registration is refused. Requests whose sender has disconnected
    meanwhile are dropped. By default there is no such limit: roslaunch starts hundreds of
    nodes on one host, and each sends dozens of requests when it starts."""

    requests_burst: int = 2_000
    """Requests from an idle host that are answered at once before ``requests_per_second``
    applies. The default is what a hundred nodes send when they start."""

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


# A wrong value of these would be noticed late or never: "no" is true.
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
    """The options a node was created with; :class:`Node` explains each of them."""

    namespace: str | None = None
    """The namespace; None for ``ROS_NAMESPACE``."""
    master_uri: str | None = None
    """The master; None for ``ROS_MASTER_URI``."""
    host: str | None = None
    """The host to announce to others; None to find it."""
    bind: str | None = None
    """The address to listen on; None for what ``host`` implies."""
    allow: Collection[str] | None = None
    """The networks from which connections are accepted; None for all."""
    xmlrpc_port: int = 0
    """The port of the slave API; 0 for a free one."""
    tcpros_port: int = 0
    """The port for topics and services; 0 for a free one."""
    argv: tuple[str, ...] | None = None
    """The command line; None for none."""
    remap: Mapping[str, str] | None = None
    """Names to replace, and their replacements."""
    anonymous: bool = False
    """Whether the name was made unique."""
    rosout: bool | Collection[str] = True
    """Whether ``node.log`` goes to ``/rosout``, or the names of loggers that go there too."""
    logger_services: bool = True
    """Whether the node provides ``~get_loggers`` and ``~set_logger_level``."""
    use_sim_time: bool | None = None
    """Whether the node follows ``/clock``; None for what the parameter says."""
    heartbeat: float | None = 1.0
    """Seconds between two checks of the master; None for no checks."""
    without_master: WithoutMaster = "raise"
    """What opening a role does while no master answers."""
    timeouts: Timeouts = Timeouts()
    """How long the node waits for others."""
    limits: Limits = Limits()
    """How much the node accepts from others."""
    on_error: OnError = "raise"
    """What happens to an exception in a callback."""
    local_transports: Collection[LocalTransport] = LOCAL_TRANSPORTS
    """The transports that topics may use instead of TCP."""

    def __post_init__(self) -> None:
        check_kinds(self, _KINDS)
        for name, port in (("xmlrpc_port", self.xmlrpc_port), ("tcpros_port", self.tcpros_port)):
            if not isinstance(port, int) or isinstance(port, bool) or not 0 <= port <= 65535:
                raise ValueError(f"{name} must be a whole number from 0 to 65535, got {port!r}")
        if self.on_error not in ("raise", "log") and not callable(self.on_error):
            raise ValueError(f"on_error must be 'raise', 'log' or callable, got {self.on_error!r}")
        if inspect.iscoroutinefunction(self.on_error):
            raise TypeError(f"on_error is called, not awaited: use `def`, got {self.on_error!r}")
        if self.heartbeat is not None and not self.heartbeat > 0:
            raise ValueError(f"heartbeat must be positive or None, got {self.heartbeat!r}")
        _check_without_master(self.without_master, self.heartbeat)
        _check_rosout(self.rosout)
        known = get_args(LocalTransport)
        named = self.local_transports
        if isinstance(named, str) or any(each not in known for each in named):
            choices = ", ".join(map(repr, known))
            raise ValueError(f"local_transports must be some of {choices}, got {named!r}")


def _check_without_master(policy: object, heartbeat: float | None) -> None:
    if policy not in get_args(WithoutMaster):
        choices = ", ".join(map(repr, get_args(WithoutMaster)))
        raise ValueError(f"without_master must be one of {choices}, got {policy!r}")
    if policy == "later" and heartbeat is None:
        raise ValueError(
            "without_master='later' needs a heartbeat, which registers what was opened; "
            "got heartbeat=None"
        )


def _check_rosout(rosout: object) -> None:
    if isinstance(rosout, bool):
        return
    if isinstance(rosout, str) or not isinstance(rosout, Collection):
        raise ValueError(f"rosout must be True, False or names of loggers, got {rosout!r}")
    for name in rosout:
        if not isinstance(name, str) or name in ("", "root"):
            # The graph must not read everything the process logs, nor set its level.
            raise ValueError(f"rosout must name loggers other than the root, got {name!r}")


def check_queue(queue_size: int, overflow: str) -> None:
    """Raise :class:`ValueError` for invalid queue options."""
    if not isinstance(queue_size, int) or isinstance(queue_size, bool) or queue_size < 1:
        # rospy takes None and 0: to publish in the caller's thread, or without a bound.
        habit = queue_size is None or (isinstance(queue_size, int) and queue_size <= 0)
        raise ValueError(
            f"queue_size must be a whole number of messages, at least 1, got {queue_size!r:.200}"
            + (
                f": every queue is bounded, and publish() never waits. Leave it out for "
                f"{DEFAULT_QUEUE_SIZE}, or use overflow='block' and send() to lose nothing"
                if habit
                else ""
            )
        )
    if overflow not in get_args(Overflow):
        choices = ", ".join(map(repr, get_args(Overflow)))
        raise ValueError(f"overflow must be one of {choices}, got {overflow!r}")
