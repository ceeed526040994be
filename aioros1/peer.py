"""The Slave API of another node, called by this one (https://wiki.ros.org/ROS/Slave_API)."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

from aioros1.errors import PeerError, PeerUnreachable
from aioros1.master_proxy import TopicType
from aioros1.triple import call_triple

if TYPE_CHECKING:
    from aioros1.net.xmlrpc_client import XmlRpcClient

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


class PublishConnection(NamedTuple):
    connection_id: int
    bytes_sent: int
    num_sent: int
    connected: bool


class PublishStats(NamedTuple):
    """What was published on one topic."""

    topic: str
    bytes_published: int
    connections: list[PublishConnection]


class SubscribeConnection(NamedTuple):
    connection_id: int
    bytes_received: int
    num_received: int
    """-1 when the node does not say; the documented answer has no such number."""
    drop_estimate: int
    """-1 when the node does not know, as the reference programs never do."""
    connected: bool


class SubscribeStats(NamedTuple):
    """What was received on one topic."""

    topic: str
    connections: list[SubscribeConnection]


class ServiceStats(NamedTuple):
    num_requests: int
    bytes_received: int
    bytes_sent: int


class BusStats(NamedTuple):
    publish: list[PublishStats]
    subscribe: list[SubscribeStats]
    service: ServiceStats | None
    """None when the node does not say, as the reference programs do not."""


class BusInfo(NamedTuple):
    """One connection of a node."""

    connection_id: int
    destination: str
    direction: Literal["i", "o", "b"]
    transport: str
    topic: str
    connected: bool
    info: str = ""


class NodeProxy:
    """Another node.

    Every method raises :class:`~aioros1.PeerUnreachable` when the node does not answer
    within ``timeouts.xmlrpc``, and :class:`~aioros1.PeerError` when it refuses.
    """

    def __init__(self, client: XmlRpcClient, uri: str, caller_id: str, name: str = "") -> None:
        self._client = client
        self._caller_id = caller_id
        self.uri = uri
        self.name = name

    async def call(self, method: str, *params: Any, bare: bool = False) -> Any:
        """Any method of the node's; the caller id is put in front."""
        return await call_triple(
            self._client,
            self.uri,
            method,
            (self._caller_id, *params),
            PeerError,
            PeerUnreachable,
            bare=bare,
        )

    async def get_bus_stats(self) -> BusStats:
        """Counters of all connections."""
        answer = await self.call("getBusStats", bare=True)
        try:
            return _bus_stats(answer)
        except (TypeError, ValueError, IndexError) as error:
            raise PeerError(-1, f"getBusStats at {self.uri}: cannot read {answer!r}") from error

    async def get_bus_info(self) -> list[BusInfo]:
        """All connections."""
        return [BusInfo(*row[:7]) for row in await self.call("getBusInfo")]

    async def get_master_uri(self) -> str:
        return str(await self.call("getMasterUri"))

    async def shutdown(self, reason: str = "") -> None:
        """Ask the node to end; it answers first."""
        await self.call("shutdown", reason)

    async def get_pid(self) -> int:
        return int(await self.call("getPid"))

    async def get_subscriptions(self) -> list[TopicType]:
        return [TopicType(*row) for row in await self.call("getSubscriptions")]

    async def get_publications(self) -> list[TopicType]:
        return [TopicType(*row) for row in await self.call("getPublications")]

    async def request_topic(self, topic: str, protocols: Sequence[Sequence[Any]]) -> list[Any]:
        """Ask a publisher how to connect; its choice among ``protocols``, with parameters."""
        return list(await self.call("requestTopic", topic, protocols))

    async def ping(self) -> float:
        """Seconds that one round trip to the node takes."""
        start = time.perf_counter()
        await self.get_pid()
        return time.perf_counter() - start


def _bus_stats(answer: Sequence[Any]) -> BusStats:
    publish, subscribe, service = (*answer, [], [], [])[:3]
    return BusStats(
        [
            PublishStats(topic, count, [PublishConnection(*row) for row in rows])
            for topic, count, rows in publish
        ],
        [SubscribeStats(topic, [_received(row) for row in rows]) for topic, rows in subscribe],
        # roscpp gives the counters in one row, rospy an empty list.
        ServiceStats(*service) if len(service) == 3 and not isinstance(service, Mapping) else None,
    )


def _received(row: Sequence[Any]) -> SubscribeConnection:
    if len(row) == 4:  # as documented; rospy and roscpp put the number of messages second
        return SubscribeConnection(row[0], row[1], -1, row[2], row[3])
    return SubscribeConnection(*row)
