"""A node's answers to its master and to other nodes (https://wiki.ros.org/ROS/Slave_API).

Every answer is ``[code, status, value]``. Code -1 means that the request was wrong, 0
that it failed. rosnode, roswtf and the master read the values.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from aioros1.core.context import Context
from aioros1.names import canonicalize
from aioros1.net.local_transports import LocalTransports
from aioros1.params.params import Params
from aioros1.quoting import printable
from aioros1.services.services import Services
from aioros1.topics.topics import Topics
from aioros1.wire.handshake import MAX_NAME
from aioros1.wire.xmlrpc import carriable
from aioros1.wire.xmlrpc_scalars import brief
from aioros1.xmlrpc.server import Reply

if TYPE_CHECKING:
    from aioros1.connection import ConnectionInfo

__all__ = ["SlaveApi"]

Triple = list[Any]

_REPLACED = re.compile(r"\[(/[^\]\s]*)\] Reason: ")
"""How the reason of a shutdown begins that a master sends: with the node that it is for."""


class SlaveApi:
    """The ten methods of the slave API, and the two that rospy adds."""

    def __init__(
        self,
        context: Context,
        topics: Topics,
        services: Services,
        params: Params,
        local: LocalTransports,
        shut_down: Callable[[str], None],
    ) -> None:
        self._context = context
        self._topics = topics
        self._services = services
        self._params = params
        self._local = local
        self._shut_down = shut_down

    @property
    def methods(self) -> Mapping[str, Callable[..., Any]]:
        return {
            "getBusInfo": self.get_bus_info,
            "getBusStats": self.get_bus_stats,
            "getMasterUri": self.get_master_uri,
            "getName": self.get_name,
            "getPid": self.get_pid,
            "getPublications": self.get_publications,
            "getSubscriptions": self.get_subscriptions,
            "getUri": self.get_uri,
            "paramUpdate": self.param_update,
            "publisherUpdate": self.publisher_update,
            "requestTopic": self.request_topic,
            "shutdown": self.shutdown,
        }

    def get_bus_stats(self, caller_id: Any) -> Triple:
        """Return [publish, subscribe, service] counters in rospy's format."""
        publish = [
            [
                publication.name,
                _int32(publication.bytes_published),
                [
                    [info.id, _int32(info.stats.bytes), _int32(info.stats.messages), True]
                    for info in publication.connections
                ],
            ]
            for publication in self._topics.publications.values()
        ]
        subscribe = [
            [
                subscription.name,
                [
                    # We lose nothing that reaches us, and cannot know what did not: -1.
                    [info.id, _int32(info.stats.bytes), _int32(info.stats.messages), -1, True]
                    for info in subscription.connections
                ],
            ]
            for subscription in self._topics.subscriptions.values()
        ]
        provisions = self._services.provisions.values()
        service = [
            _int32(sum(provision.stats.messages for provision in provisions)),
            _int32(sum(provision.bytes_received for provision in provisions)),
            _int32(sum(provision.bytes_sent for provision in provisions)),
        ]
        return [1, "bus stats", [publish, subscribe, service]]

    def get_bus_info(self, caller_id: Any) -> Triple:
        return [1, "bus info", [_bus_info(info) for info in self._context.connections.infos]]

    def get_master_uri(self, caller_id: Any) -> Triple:
        return [1, "master URI", self._context.master.uri]

    def get_name(self, caller_id: Any) -> Triple:
        return [1, "node name", self._context.name]

    def get_uri(self, caller_id: Any) -> Triple:
        return [1, "node URI", self._context.address.uri]

    def get_pid(self, caller_id: Any) -> Triple:
        return [1, "process id", os.getpid()]

    def get_subscriptions(self, caller_id: Any) -> Triple:
        rows = [[each.name, each.type] for each in self._topics.subscriptions.values()]
        return [1, "subscriptions", rows]

    def get_publications(self, caller_id: Any) -> Triple:
        publications = self._topics.publications.values()
        rows = [[each.name, each.message_class._type] for each in publications]
        return [1, "publications", rows]

    def shutdown(self, caller_id: Any, reason: Any = "") -> Triple | Reply:
        """Answer, then close the node. Anyone may call this, as rosnode kill does.

        A master names the node that another one of the same name replaces, and calls the
        address at which that node was. If its process is gone, we may have its port now.
        """
        if not isinstance(reason, str):
            return _wrong("msg", reason, "a string")
        addressee = _REPLACED.match(reason)
        if addressee is not None and canonicalize(addressee[1]) != self._context.name:
            self._context.log.info("ignored a shutdown that is meant for %s", addressee[1])
            text = f"this is {self._context.name}, not {printable(addressee[1])}"
            return [-1, text, 0]
        who = printable(caller_id) if isinstance(caller_id, str) else "unknown caller"
        why = f"[{who}] {printable(reason)}"
        return Reply([1, "shutdown", 0], after=lambda: self._shut_down(why))

    def param_update(self, caller_id: Any, key: Any, value: Any) -> Triple:
        if not _is_name(key) or not key.startswith("/"):
            return _wrong("parameter_key", key, "a string that starts with '/'")
        # The master sends the key with a trailing slash, tools without.
        if not self._params.announced(canonicalize(key), value):
            return [-1, f"not subscribed to parameter {printable(key)}", 0]
        return [1, "", 0]

    def publisher_update(self, caller_id: Any, topic: Any, publishers: Any) -> Triple:
        if not _is_name(topic):
            return _wrong("topic", topic, "the name of a topic")
        if not isinstance(publishers, list) or not all(map(_is_http_uri, publishers)):
            return _wrong("publishers", publishers, "a list of http:// URIs")
        subscription = self._topics.subscriptions.get(canonicalize(topic))
        if subscription is not None:
            subscription.update(publishers)
        return [1, "", 0]

    def request_topic(self, caller_id: Any, topic: Any, protocols: Any) -> Triple:
        if not _is_name(topic):
            return _wrong("topic", topic, "the name of a topic")
        if not isinstance(protocols, list) or not protocols:
            return _wrong("protocols", protocols, "a list of [protocol, parameter, ...]")
        if self._topics.published(canonicalize(topic)) is None:
            return [-1, f"{self._context.name} does not publish {printable(topic)}", []]
        # Skip other protocols, whatever they look like: the caller may well support this
        # one too.
        readable = [each for each in protocols if _is_protocol(each)]
        local = self._local.answer(readable)
        if local is not None:
            return [1, "ready", local]
        if any(protocol[0] == "TCPROS" for protocol in readable):
            host, port = self._context.address.tcpros
            return [1, "ready", ["TCPROS", host, port]]
        if len(readable) < len(protocols):
            return _wrong("protocols", protocols, "a list of [protocol, parameter, ...]")
        return [0, "no protocol in common: this node speaks TCPROS", []]


def _bus_info(info: ConnectionInfo) -> list[Any]:
    return [
        info.id,
        carriable(info.peer),  # it chose its own name, which may be any bytes
        info.direction,
        info.transport,
        info.name,
        True,
        info.description,
    ]


def _wrong(parameter: str, value: object, expected: str) -> Triple:
    return [-1, f"{parameter} must be {expected}, got {printable(brief(value), 100)}", 0]


def _is_name(value: object) -> bool:
    return isinstance(value, str) and 0 < len(value) <= MAX_NAME


def _is_protocol(value: object) -> bool:
    return isinstance(value, list) and bool(value) and isinstance(value[0], str)


def _is_http_uri(value: object) -> bool:
    return isinstance(value, str) and value.startswith("http://") and len(value) > len("http://")


def _int32(count: int) -> int:
    """Wrap a count to 32 bits, the size of XML-RPC integers, as C counters do."""
    return (count + 0x80000000) % 0x100000000 - 0x80000000
