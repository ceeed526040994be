"""The Master and Parameter Server API, called by a node (https://wiki.ros.org/ROS/Master_API)."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any, NamedTuple

from aioros1.errors import MasterError, MasterUnreachable
from aioros1.triple import call_triple

if TYPE_CHECKING:
    from aioros1.net.xmlrpc_client import XmlRpcClient

__all__ = ["MasterProxy", "SystemState", "TopicType"]


class TopicType(NamedTuple):
    """A topic and the type that its publishers announced."""

    name: str
    type: str


class SystemState(NamedTuple):
    """Who does what: topic or service name to the names of the nodes."""

    publishers: dict[str, list[str]]
    subscribers: dict[str, list[str]]
    services: dict[str, list[str]]


class MasterProxy:
    """The master that a node belongs to.

    Every method raises :class:`~aioros1.MasterUnreachable` when nobody answers within
    ``timeouts.xmlrpc``, and :class:`~aioros1.MasterError` when the master refuses.
    """

    def __init__(self, client: XmlRpcClient, uri: str, caller_id: str) -> None:
        self._client = client
        self.uri = uri
        self.caller_id = caller_id
        self.last_seen: float | None = None
        """When the master last answered, by :func:`time.monotonic`."""

    async def call(self, method: str, *params: Any) -> Any:
        """Any method of the master's; the caller id is put in front."""
        params = (self.caller_id, *params)
        value = await call_triple(
            self._client, self.uri, method, params, MasterError, MasterUnreachable
        )
        self.last_seen = time.monotonic()
        return value

    # look-ups

    async def lookup_node(self, name: str) -> str:
        """The URI of a node's slave API."""
        return str(await self.call("lookupNode", name))

    async def lookup_service(self, name: str) -> str:
        """The ``rosrpc://host:port`` of a service's provider."""
        return str(await self.call("lookupService", name))

    async def get_published_topics(self, subgraph: str = "") -> list[TopicType]:
        """Topics with a publisher, all or those below a namespace."""
        return [TopicType(*row) for row in await self.call("getPublishedTopics", subgraph)]

    async def get_topic_types(self) -> list[TopicType]:
        """Every topic whose type was ever announced, published or not."""
        return [TopicType(*row) for row in await self.call("getTopicTypes")]

    async def get_system_state(self) -> SystemState:
        """All registrations."""
        return SystemState(*({row[0]: row[1] for row in part} for part in await self._state()))

    async def _state(self) -> list[list[list[Any]]]:
        state: list[list[list[Any]]] = await self.call("getSystemState")
        return state

    async def get_uri(self) -> str:
        """The URI that the master knows itself by."""
        return str(await self.call("getUri"))

    async def get_pid(self) -> int:
        """The master's process id."""
        return int(await self.call("getPid"))

    async def ping(self) -> float:
        """Seconds that one round trip to the master takes."""
        start = time.perf_counter()
        await self.get_pid()
        return time.perf_counter() - start

    # registrations: roles make them; they are public for tools

    async def register_publisher(self, topic: str, type: str, uri: str) -> list[str]:
        """Announce a publisher; the URIs of the topic's subscribers."""
        return list(await self.call("registerPublisher", topic, type, uri))

    async def unregister_publisher(self, topic: str, uri: str) -> int:
        return int(await self.call("unregisterPublisher", topic, uri))

    async def register_subscriber(self, topic: str, type: str, uri: str) -> list[str]:
        """Announce a subscriber; the URIs of the topic's publishers."""
        return list(await self.call("registerSubscriber", topic, type, uri))

    async def unregister_subscriber(self, topic: str, uri: str) -> int:
        return int(await self.call("unregisterSubscriber", topic, uri))

    async def register_service(self, service: str, service_uri: str, uri: str) -> None:
        """Announce a provider at ``service_uri``, which is ``rosrpc://host:port``."""
        await self.call("registerService", service, service_uri, uri)

    async def unregister_service(self, service: str, service_uri: str) -> int:
        return int(await self.call("unregisterService", service, service_uri))

    # parameters

    async def get_param(self, key: str) -> Any:
        return await self.call("getParam", key)

    async def set_param(self, key: str, value: Any) -> None:
        await self.call("setParam", key, value)

    async def has_param(self, key: str) -> bool:
        return bool(await self.call("hasParam", key))

    async def delete_param(self, key: str) -> None:
        await self.call("deleteParam", key)

    async def search_param(self, key: str) -> str:
        return str(await self.call("searchParam", key))

    async def get_param_names(self) -> list[str]:
        return list(await self.call("getParamNames"))

    async def subscribe_param(self, key: str, uri: str) -> Any:
        """Ask for updates of ``key``; its value now, ``{}`` when it is not set."""
        return await self.call("subscribeParam", uri, key)

    async def unsubscribe_param(self, key: str, uri: str) -> int:
        return int(await self.call("unsubscribeParam", uri, key))
