"""Registrations of publishers, subscribers and providers. Pure: no I/O, no event loop.

Every change returns the answer for the node that asked, and the notifications to send to
other nodes. Registrations are removed only on request: a master cannot tell a dead node from
a slow one.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from aioros1.master.parameters import ParamUpdate

__all__ = ["Answer", "Changed", "Notification", "PublisherUpdate", "Registry", "Shutdown"]

Answer = tuple[int, str, Any]
"""Code, status and value: the answer of every method of the master API."""

ANY_TYPE = "*"


class PublisherUpdate(NamedTuple):
    """A notification to the subscriber of ``topic`` at ``api``: the topic's publishers now."""

    api: str
    topic: str
    publishers: list[str]


class Shutdown(NamedTuple):
    """A notification to the node ``caller_id`` at ``api``: another of its name replaced it."""

    api: str
    caller_id: str
    reason: str


Notification = PublisherUpdate | ParamUpdate | Shutdown

Changed = tuple[Answer, list[Notification]]


@dataclass(slots=True)
class _Node:
    """One node: the URI of its slave API, and the keys of its registrations."""

    api: str
    publications: set[str] = field(default_factory=set)
    subscriptions: set[str] = field(default_factory=set)
    services: set[str] = field(default_factory=set)
    params: set[str] = field(default_factory=set)

    @property
    def count(self) -> int:
        return (
            len(self.publications) + len(self.subscriptions) + len(self.services) + len(self.params)
        )

    @property
    def is_empty(self) -> bool:
        return not (self.publications or self.subscriptions or self.services or self.params)


class _Service(NamedTuple):
    caller_id: str
    service_api: str


class Registry:
    """The state of a master, without its parameters. All names are resolved."""

    def __init__(self) -> None:
        self._nodes: dict[str, _Node] = {}
        # topic or key -> node -> its XML-RPC URI, in the order of registration
        self._publishers: dict[str, dict[str, str]] = {}
        self._subscribers: dict[str, dict[str, str]] = {}
        self._param_subscribers: dict[str, dict[str, str]] = {}
        self._services: dict[str, _Service] = {}
        self._types: dict[str, str] = {}
        # How many nodes share a URI; a process may hold several.
        self._apis: dict[str, int] = {}

    # ------------------------------------------------------------------ topics

    def register_publisher(self, caller_id: str, topic: str, topic_type: str, api: str) -> Changed:
        """The value is the URIs of the subscribers, which are told of the publisher even if
        it was registered before."""
        node, notifications = self._node(caller_id, api)
        node.publications.add(topic)
        self._publishers.setdefault(topic, {})[caller_id] = api
        if topic_type != ANY_TYPE or topic not in self._types:
            self._types[topic] = topic_type
        notifications += self._publisher_updates(topic)
        subscribers = list(self._subscribers.get(topic, {}).values())
        return (
            1,
            f"Registered [{caller_id}] as publisher of [{topic}]",
            subscribers,
        ), notifications

    def unregister_publisher(self, caller_id: str, topic: str, api: str) -> Changed:
        """The value is how many registrations this has ended, 0 or 1."""
        answer = self._unregister(self._publishers, "publications", caller_id, topic, api)
        return answer, self._publisher_updates(topic) if answer[2] else []

    def register_subscriber(self, caller_id: str, topic: str, topic_type: str, api: str) -> Changed:
        """The value is the URIs of the publishers."""
        node, notifications = self._node(caller_id, api)
        node.subscriptions.add(topic)
        self._subscribers.setdefault(topic, {})[caller_id] = api
        if topic_type != ANY_TYPE:
            self._types.setdefault(topic, topic_type)
        return (1, f"Subscribed to [{topic}]", self._publisher_apis(topic)), notifications

    def unregister_subscriber(self, caller_id: str, topic: str, api: str) -> Changed:
        """The value is how many registrations this has ended, 0 or 1."""
        return self._unregister(self._subscribers, "subscriptions", caller_id, topic, api), []

    # ------------------------------------------------------------------ services

    def register_service(self, caller_id: str, service: str, service_api: str, api: str) -> Changed:
        """Register a provider; callers get the provider that was registered last."""
        node, notifications = self._node(caller_id, api)
        node.services.add(service)
        self._services[service] = _Service(caller_id, service_api)
        return (1, f"Registered [{caller_id}] as provider of [{service}]", 1), notifications

    def unregister_service(self, caller_id: str, service: str, service_api: str) -> Changed:
        """The value is how many registrations this has ended, 0 or 1.

        A provider that another has replaced ends nothing.
        """
        node = self._nodes.get(caller_id)
        if node is None:
            return (1, f"[{caller_id}] is not a registered node", 0), []
        current = self._services.get(service)
        if current == (caller_id, service_api):
            del self._services[service]
            self._drop(caller_id, node, node.services, service)
            return (1, f"Unregistered [{caller_id}] as provider of [{service}]", 1), []
        if current is None or current.caller_id != caller_id:
            self._drop(caller_id, node, node.services, service)
        text = f"[{service_api}] is no longer the current service api handle for [{service}]"
        return (1, text, 0), []

    def lookup_service(self, service: str) -> Answer:
        """The value is the ``rosrpc://`` URI of the provider."""
        found = self._services.get(service)
        if found is None:
            return -1, "no provider", ""
        return 1, f"rosrpc URI: [{found.service_api}]", found.service_api

    # ------------------------------------------------------------------ parameters

    @property
    def param_subscribers(self) -> Mapping[str, Mapping[str, str]]:
        """The subscribers of each parameter, for :func:`.param_updates`."""
        return self._param_subscribers

    def register_param_subscriber(self, caller_id: str, key: str, api: str) -> list[Notification]:
        """Register a subscription to ``key``, which is a :func:`.subscription_key`."""
        node, notifications = self._node(caller_id, api)
        node.params.add(key)
        self._param_subscribers.setdefault(key, {})[caller_id] = api
        return notifications

    def unregister_param_subscriber(self, caller_id: str, key: str, api: str) -> None:
        """End a subscription, if there is one."""
        self._unregister(self._param_subscribers, "params", caller_id, key, api)

    # ------------------------------------------------------------------ the graph

    def lookup_node(self, name: str) -> Answer:
        """The value is the URI of the node's slave API."""
        node = self._nodes.get(name)
        if node is None:
            return -1, f"unknown node [{name}]", ""
        return 1, "node api", node.api

    def published_topics(self, subgraph: str) -> Answer:
        """Topics with a publisher below the namespace ``subgraph`` (``""``: all), each
        with its type."""
        if subgraph and not subgraph.endswith("/"):
            subgraph += "/"
        topics = [
            [name, self._types[name]] for name in self._publishers if name.startswith(subgraph)
        ]
        return 1, "current topics", topics

    def topic_types(self) -> Answer:
        """Every topic that ever existed, each with its type."""
        return 1, "current system state", [list(pair) for pair in self._types.items()]

    def system_state(self) -> Answer:
        """Publishers, subscribers and services, each with the names of the nodes."""
        return (
            1,
            "current system state",
            [
                [[topic, list(nodes)] for topic, nodes in self._publishers.items()],
                [[topic, list(nodes)] for topic, nodes in self._subscribers.items()],
                [[service, [provider.caller_id]] for service, provider in self._services.items()],
            ],
        )

    def count(self) -> int:
        """How many registrations there are, the types of topics included."""
        return len(self._types) + sum(node.count for node in self._nodes.values())

    def has_registered(self, caller_id: str, name: str) -> bool:
        """Whether that node has registered anything under ``name``, or follows it."""
        node = self._nodes.get(caller_id)
        return node is not None and any(
            name in kind
            for kind in (node.publications, node.subscriptions, node.services, node.params)
        )

    def knows_api(self, api: str) -> bool:
        """Whether any registered node is at the URI ``api``."""
        return api in self._apis

    def is_wanted(self, message: Notification) -> bool:
        """Whether the node at ``message.api`` still needs to be told."""
        if isinstance(message, PublisherUpdate):
            return message.api in self._subscribers.get(message.topic, {}).values()
        if isinstance(message, Shutdown):
            return not self.knows_api(message.api)
        node = self._nodes.get(message.caller_id)
        if node is None or node.api != message.api:
            return False
        key = message.key
        return any(key.startswith(each) or each.startswith(key) for each in node.params)

    # ------------------------------------------------------------------ inside

    def _node(self, caller_id: str, api: str) -> tuple[_Node, list[Notification]]:
        """The entry of a node that registers something from ``api``.

        A node of the same name at another URI counts as an old one: it is told to end, if no
        other node is at its URI, and loses all its registrations.
        """
        node = self._nodes.get(caller_id)
        notifications: list[Notification] = []
        if node is not None:
            if node.api == api:
                return node, notifications
            reason = f"[{caller_id}] Reason: new node registered with same name"
            notifications += self._forget(caller_id, node)
            # Unless the old one has gone without a word, and another node has its port now.
            if not self.knows_api(node.api):
                notifications.insert(0, Shutdown(node.api, caller_id, reason))
        self._nodes[caller_id] = node = _Node(api)
        self._apis[api] = self._apis.get(api, 0) + 1
        return node, notifications

    def _forget(self, caller_id: str, node: _Node) -> list[Notification]:
        """End every registration of a node, and notify the subscribers of its topics."""
        for topic in node.subscriptions:
            _discard(self._subscribers, topic, caller_id)
        for key in node.params:
            _discard(self._param_subscribers, key, caller_id)
        for service in node.services:
            provider = self._services.get(service)
            if provider is not None and provider.caller_id == caller_id:
                del self._services[service]
        for topic in node.publications:
            _discard(self._publishers, topic, caller_id)
        self._remove(caller_id, node)
        return [update for topic in node.publications for update in self._publisher_updates(topic)]

    def _unregister(
        self, table: dict[str, dict[str, str]], kind: str, caller_id: str, key: str, api: str
    ) -> Answer:
        node = self._nodes.get(caller_id)
        if node is None:
            return 1, f"[{caller_id}] is not a registered node", 0
        if table.get(key, {}).get(caller_id) != api:
            return 1, f"[{caller_id}] is not a known provider of [{key}]", 0
        _discard(table, key, caller_id)
        self._drop(caller_id, node, getattr(node, kind), key)
        return 1, f"Unregistered [{caller_id}] as provider of [{key}]", 1

    def _drop(self, caller_id: str, node: _Node, keys: set[str], key: str) -> None:
        keys.discard(key)
        if node.is_empty:
            self._remove(caller_id, node)

    def _remove(self, caller_id: str, node: _Node) -> None:
        del self._nodes[caller_id]
        self._apis[node.api] -= 1
        if not self._apis[node.api]:
            del self._apis[node.api]

    def _publisher_apis(self, topic: str) -> list[str]:
        return list(self._publishers.get(topic, {}).values())

    def _publisher_updates(self, topic: str) -> list[Notification]:
        publishers = self._publisher_apis(topic)
        # Two nodes of one process share a URI, and need only one notification.
        apis = dict.fromkeys(self._subscribers.get(topic, {}).values())
        return [PublisherUpdate(api, topic, publishers) for api in apis]


def _discard(table: dict[str, dict[str, str]], key: str, caller_id: str) -> None:
    nodes = table.get(key)
    if nodes is not None and nodes.pop(caller_id, None) is not None and not nodes:
        del table[key]
