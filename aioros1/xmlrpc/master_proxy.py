"""The Master and Parameter Server API, called by a node (https://wiki.ros.org/ROS/Master_API)."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any, NamedTuple, TypeVar
from urllib.parse import urlsplit

from aioros1._public import public
from aioros1.errors import MasterError, MasterUnreachable, NodeNotFound
from aioros1.net.connecting import is_exhausted
from aioros1.xmlrpc.client import XmlRpcClient, as_it_is, call_triple

__all__ = ["MasterProxy", "SystemState", "TopicType", "identify", "port_advice", "topic_types"]

T = TypeVar("T")


@public
class TopicType(NamedTuple):
    """A topic and the type that its publishers announced."""

    name: str
    """The full name of the topic."""
    type: str
    """``pkg/Type``, or ``*`` when only subscribers to any type announced it."""


@public
class SystemState(NamedTuple):
    """All registrations: topic or service name to the names of the nodes."""

    publishers: dict[str, list[str]]
    """Topic to the nodes that publish it."""
    subscribers: dict[str, list[str]]
    """Topic to the nodes that receive it."""
    services: dict[str, list[str]]
    """Service to the nodes that provide it."""


def port_advice(uri: str) -> str:
    """What to say first when no master is at ``uri``, if the URI has no port; or nothing."""
    parts = urlsplit(uri)
    if parts.port is not None:
        return ""
    named = f"http://{parts.netloc}:11311"
    return f"a URI without a port means port 80, did you mean {named}? If not, "


@public
class MasterProxy:
    """The master that a node belongs to.

    Every method raises :class:`~aioros1.MasterUnreachable` when nobody answers within
    ``timeouts.xmlrpc``, and :class:`~aioros1.MasterError` when the master refuses.
    """

    def __init__(
        self, client: XmlRpcClient, uri: str, caller_id: str, *, timeout: float | None = None
    ) -> None:
        self._client = client
        self._timeout = timeout
        self.uri = uri
        """The URI of the master."""
        self.caller_id = caller_id
        """The name of the node that asks."""
        self.last_seen: float | None = None
        """When the master last answered, by :func:`time.monotonic`."""

    def __repr__(self) -> str:
        return f"<MasterProxy of {self.uri} for {self.caller_id}>"

    async def call(self, method: str, *params: Any, read: Callable[[Any], T] = as_it_is) -> T:
        """Call any method of the master, with the caller id as the first parameter.

        ``read`` converts the value in the master's answer to what this returns.
        """
        params = (self.caller_id, *params)
        try:
            value = await call_triple(
                *(self._client, self.uri, method, params, MasterError, self._unreachable),
                read=read,
                timeout=self._timeout,
                any_path=True,  # the user chose this URI
            )
        except MasterError as error:
            if error.is_answer:
                self.last_seen = time.monotonic()
            raise
        self.last_seen = time.monotonic()
        return value

    def _unreachable(self, method: str, error: OSError) -> MasterUnreachable:
        # Only then was nothing sent; the other errors are more special ones.
        if type(error) is not ConnectionError:
            return MasterUnreachable(str(error))
        if is_exhausted(error):
            return MasterUnreachable(str(error), was_sent=False)
        advice = (
            "no master is there: start one with `aioros1 master`, set ROS_MASTER_URI to the one "
            'you have, or let the node wait for it with without_master="wait"'
        )
        advice = port_advice(self.uri) + advice
        return MasterUnreachable(str(error), advice=advice, was_sent=False)

    # look-ups

    async def lookup_node(self, name: str) -> str:
        """The URI of a node's slave API.

        Raises :class:`~aioros1.NodeNotFound` if the master knows no node of that name.
        """
        try:
            return await self.call("lookupNode", name, read=str)
        except MasterError as error:
            if not error.is_refusal:
                raise
            text = f"no node {name}: the master at {self.uri} knows none of that name"
            raise NodeNotFound(error.code, text) from None

    async def lookup_service(self, name: str) -> str:
        """The ``rosrpc://host:port`` of a service's provider."""
        return await self.call("lookupService", name, read=str)

    async def get_published_topics(self, subgraph: str = "") -> list[TopicType]:
        """Topics with a publisher, all or those below a namespace."""
        return await self.call("getPublishedTopics", subgraph, read=topic_types)

    async def get_topic_types(self) -> list[TopicType]:
        """Every topic whose type was ever announced, published or not."""
        return await self.call("getTopicTypes", read=topic_types)

    async def get_system_state(self) -> SystemState:
        """All registrations."""
        return await self.call("getSystemState", read=_system_state)

    async def get_uri(self) -> str:
        """The URI that the master has for itself."""
        return await self.call("getUri", read=str)

    async def get_pid(self) -> int:
        """The master's process id."""
        return await self.call("getPid", read=int)

    async def ping(self) -> float:
        """Seconds that one round trip to the master takes. Any answer will do."""
        start = time.perf_counter()
        await identify(self)
        return time.perf_counter() - start

    # registrations: roles make them; these methods are public for tools

    async def register_publisher(self, topic: str, type: str, uri: str) -> list[str]:
        """Register a publisher; returns the URIs of the topic's subscribers."""
        return await self.call("registerPublisher", topic, type, uri, read=_strings)

    async def unregister_publisher(self, topic: str, uri: str) -> int:
        """Unregister a publisher; returns 1 if it was registered, else 0."""
        return await self.call("unregisterPublisher", topic, uri, read=int)

    async def register_subscriber(self, topic: str, type: str, uri: str) -> list[str]:
        """Register a subscriber; returns the URIs of the topic's publishers."""
        return await self.call("registerSubscriber", topic, type, uri, read=_strings)

    async def unregister_subscriber(self, topic: str, uri: str) -> int:
        """Unregister a subscriber; returns 1 if it was registered, else 0."""
        return await self.call("unregisterSubscriber", topic, uri, read=int)

    async def register_service(self, service: str, service_uri: str, uri: str) -> None:
        """Register a provider at ``service_uri``, which is ``rosrpc://host:port``."""
        await self.call("registerService", service, service_uri, uri)

    async def unregister_service(self, service: str, service_uri: str) -> int:
        """Unregister a provider; returns 1 if it was registered, else 0."""
        return await self.call("unregisterService", service, service_uri, read=int)

    # parameters

    async def get_param(self, key: str) -> Any:
        """The value of a parameter, or everything below it as a dict."""
        return await self.call("getParam", key)

    async def set_param(self, key: str, value: Any) -> None:
        """Set a parameter; a dict sets everything below it."""
        await self.call("setParam", key, value)

    async def has_param(self, key: str) -> bool:
        """Whether a parameter is set."""
        return await self.call("hasParam", key, read=bool)

    async def delete_param(self, key: str) -> None:
        """Delete a parameter and everything below it."""
        await self.call("deleteParam", key)

    async def search_param(self, key: str) -> str:
        """The full name of the parameter found by searching up the namespaces."""
        return await self.call("searchParam", key, read=str)

    async def get_param_names(self) -> list[str]:
        """The full names of all parameters."""
        return await self.call("getParamNames", read=_strings)

    async def subscribe_param(self, key: str, uri: str) -> Any:
        """Subscribe to updates of ``key``; returns its value now, ``{}`` when it is not set."""
        return await self.call("subscribeParam", uri, key)

    async def unsubscribe_param(self, key: str, uri: str) -> int:
        """End :meth:`subscribe_param`; returns 1 if ``key`` was subscribed to, else 0."""
        return await self.call("unsubscribeParam", uri, key, read=int)


async def identify(master: MasterProxy) -> int:
    """The master's process id; 0 if there is a master that does not tell.

    Not every master has ``getPid``. One that answers anything else that only masters answer
    is one, too. Raises :class:`~aioros1.MasterError` if nobody does.
    """
    try:
        return await master.get_pid()
    except MasterUnreachable:
        raise
    except MasterError as error:
        if error.is_answer:
            return 0
        for method, *params in (("getUri",), ("lookupNode", master.caller_id)):
            try:
                await master.call(method, *params)
            except MasterError as another:
                if not another.is_answer:
                    continue
            return 0
        raise


def topic_types(rows: Any) -> list[TopicType]:
    """Convert the [[topic, type], ...] that several methods answer. What is no such row is
    left out, and whatever else a row has."""
    return [TopicType(*row[:2]) for row in rows if isinstance(row, list) and len(row) >= 2]


def _strings(values: Any) -> list[str]:
    if not isinstance(values, list) or not all(isinstance(value, str) for value in values):
        raise TypeError("expected a list of strings")
    return values


def _system_state(parts: Any) -> SystemState:
    return SystemState(*({name: list(nodes) for name, nodes in part} for part in parts))
