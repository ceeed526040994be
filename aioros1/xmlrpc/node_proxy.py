"""The Slave API of another node, called by this one (https://wiki.ros.org/ROS/Slave_API)."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable, Sequence
from typing import Any, Literal, NamedTuple, TypeVar

from aioros1._public import public
from aioros1.errors import PeerError, PeerUnreachable
from aioros1.xmlrpc.client import SHORT_ANSWER, XmlRpcClient, as_it_is, call_triple
from aioros1.xmlrpc.master_proxy import TopicType, topic_types

__all__ = [
    "BusInfo",
    "BusStats",
    "NodeProxy",
    "PublishConnection",
    "PublishStats",
    "ServiceStats",
    "SubscribeConnection",
    "SubscribeStats",
]

T = TypeVar("T")


@public
class PublishConnection(NamedTuple):
    """Counters of the connection to one subscriber."""

    connection_id: int
    """The id of the connection, unique within the node."""
    bytes_sent: int
    """Bytes sent."""
    num_sent: int
    """Messages sent."""
    connected: bool
    """Whether the connection is open."""


@public
class PublishStats(NamedTuple):
    """Counters of one published topic."""

    topic: str
    """The topic."""
    bytes_published: int
    """Bytes of messages, counted once however many subscribers there are."""
    connections: list[PublishConnection]
    """One row for each subscriber."""


@public
class SubscribeConnection(NamedTuple):
    """Counters of the connection to one publisher."""

    connection_id: int
    """The id of the connection, unique within the node."""
    bytes_received: int
    """Bytes received."""
    num_received: int
    """Messages received; -1 when the node does not report them, as in the documented answer."""
    drop_estimate: int
    """Messages dropped, estimated; -1 when unknown, as always from rospy and roscpp."""
    connected: bool
    """Whether the connection is open."""


@public
class SubscribeStats(NamedTuple):
    """Counters of one subscribed topic."""

    topic: str
    """The topic."""
    connections: list[SubscribeConnection]
    """One row for each publisher."""


@public
class ServiceStats(NamedTuple):
    """Counters of all services of a node together."""

    num_requests: int
    """Requests answered."""
    bytes_received: int
    """Bytes of requests."""
    bytes_sent: int
    """Bytes of responses."""


@public
class BusStats(NamedTuple):
    """Counters of a node: the answer of ``getBusStats``."""

    publish: list[PublishStats]
    """One row for each topic that the node publishes."""
    subscribe: list[SubscribeStats]
    """One row for each topic that the node receives."""
    service: ServiceStats | None
    """None when the node does not report them; rospy and roscpp do not."""


@public
class BusInfo(NamedTuple):
    """One connection of a node."""

    connection_id: int
    """The id of the connection, unique within the node."""
    destination: str
    """The name or the URI of the other node."""
    direction: Literal["i", "o", "b"]
    """Whether messages come in, go out, or both."""
    transport: str
    """``TCPROS``, or another transport of the node."""
    topic: str
    """The topic or service."""
    connected: bool
    """Whether the connection is open."""
    info: str = ""
    """A description for people; empty when the node gives none."""


@public
class NodeProxy:
    """Another node.

    Every method raises :class:`~aioros1.PeerUnreachable` when the node does not answer
    within ``timeouts.xmlrpc``, and :class:`~aioros1.PeerError` when it refuses.
    """

    def __init__(self, client: XmlRpcClient, uri: str, caller_id: str, name: str = "") -> None:
        self._client = client
        self._caller_id = caller_id
        self.uri = uri
        """The URI of the node's slave API."""
        self.name = name
        """The name by which the node was looked up; empty if it was not."""

    def __repr__(self) -> str:
        return f"<NodeProxy of {self.name or 'a node'} at {self.uri}>"

    async def call(
        self,
        method: str,
        *params: Any,
        bare: bool = False,
        read: Callable[[Any], T] = as_it_is,
        max_bytes: int | None = None,
    ) -> T:
        """Call any method of the node, with the caller id as the first parameter.

        ``read`` converts the value in the node's answer to what this returns; with ``bare``
        the answer need not be ``[code, status, value]``. It has at most ``max_bytes``, if that
        is less than ``limits.xmlrpc_bytes``.
        """
        params = (self._caller_id, *params)
        return await call_triple(
            *(self._client, self.uri, method, params, PeerError, _unreachable),
            bare=bare,
            read=read,
            max_bytes=max_bytes,
        )

    async def get_bus_stats(self) -> BusStats:
        """Counters of all connections. Rows that cannot be read are left out."""
        return await self.call("getBusStats", bare=True, read=_bus_stats)

    async def get_bus_info(self) -> list[BusInfo]:
        """All connections. Rows that cannot be read are left out."""
        return await self.call("getBusInfo", read=_bus_info)

    async def get_master_uri(self) -> str:
        """The URI of the node's master. roscpp has no such method, and refuses."""
        return await self.call("getMasterUri", read=str)

    async def shutdown(self, reason: str = "") -> None:
        """Ask the node to end.

        rospy obeys without answering, so a lost connection counts as an answer.
        """
        try:
            await self.call("shutdown", reason)
        except PeerUnreachable as error:
            if not error.was_lost:
                raise

    async def get_pid(self) -> int:
        """The process id of the node."""
        return await self.call("getPid", read=int)

    async def get_subscriptions(self) -> list[TopicType]:
        """The topics that the node receives, with their types."""
        return await self.call("getSubscriptions", read=topic_types)

    async def get_publications(self) -> list[TopicType]:
        """The topics that the node publishes, with their types."""
        return await self.call("getPublications", read=topic_types)

    async def request_topic(self, topic: str, protocols: Sequence[Sequence[Any]]) -> list[Any]:
        """Ask a publisher how to connect; returns its choice of ``protocols``, with parameters."""
        # Anybody can name publishers, many at once.
        return await self.call("requestTopic", topic, protocols, read=_list, max_bytes=SHORT_ANSWER)

    async def ping(self) -> float:
        """Seconds that one round trip to the node takes."""
        start = time.perf_counter()
        await self.get_pid()
        return time.perf_counter() - start


def _list(value: Any) -> list[Any]:
    if not isinstance(value, list):
        raise TypeError("expected a list")
    return value


def _readable(rows: Any, read: Callable[[Any], T]) -> list[T]:
    """Read rows, and leave out those that cannot be read: the others are right."""
    found = []
    for row in _list(rows):
        with contextlib.suppress(TypeError, ValueError, LookupError, OverflowError):
            found.append(read(row))
    return found


def _bus_info(rows: Any) -> list[BusInfo]:
    return _readable(rows, _connection)


def _connection(row: Any) -> BusInfo:
    number, destination, direction, transport, topic = _list(row)[:5]
    # The rows of rosjava and roslisp end here. rosnode takes what is listed for connected.
    connected = bool(row[5]) if len(row) > 5 else True
    info = str(row[6]) if len(row) > 6 else ""
    return BusInfo(
        int(number), str(destination), direction, str(transport), str(topic), connected, info
    )


def _bus_stats(answer: Sequence[Any]) -> BusStats:
    publish, subscribe, service = (*answer, [], [], [])[:3]
    return BusStats(
        _readable(publish, _published),
        _readable(subscribe, _subscribed),
        # rospy and roscpp report nothing here.
        ServiceStats(*service) if isinstance(service, list) and len(service) == 3 else None,
    )


def _subscribed(row: Any) -> SubscribeStats:
    topic, rows = row
    return SubscribeStats(topic, _readable(rows, _received))


def _published(row: Any) -> PublishStats:
    if len(row) == 2:  # roscpp counts the bytes of the messages for each connection instead
        topic, rows = row
        connections = _readable(rows, lambda each: _sent((each[0], each[1], each[3], each[4])))
        return PublishStats(topic, sum(_readable(rows, lambda each: int(each[2]))), connections)
    topic, count, rows = row
    return PublishStats(topic, count, _readable(rows, _sent))


def _sent(row: Any) -> PublishConnection:
    number, sent, messages, connected = row
    return PublishConnection(number, sent, messages, bool(connected))


def _received(row: Any) -> SubscribeConnection:
    if len(row) == 4:  # as documented; rospy and roscpp put the number of messages second
        return SubscribeConnection(row[0], row[1], -1, row[2], bool(row[3]))
    return SubscribeConnection(row[0], row[1], row[2], row[3], bool(row[4]))


def _unreachable(method: str, error: OSError) -> PeerUnreachable:
    return PeerUnreachable(str(error), was_lost=isinstance(error, ConnectionResetError))
