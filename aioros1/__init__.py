"""ROS 1 as an ordinary asyncio library.

::

    async with aioros1.Node("demo") as node:
        async with node.advertise("chatter", "std_msgs/String") as pub:
            pub.publish(data="hello")

Names are imported when they are first used, so that a program that only reads message
definitions does not load an HTTP server. What type checkers see is ``__init__.pyi``.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

from aioros1._version import __version__

_MODULES = {
    "clock.rate": ("Rate",),
    "clock.timer": ("Timer",),
    "connection": ("ConnectionInfo", "ConnectionStats"),
    "core.opening": ("Opening",),
    "core.role": ("Role",),
    "core.stats": ("NodeStats", "RoleStats"),
    "errors": (
        "ClosedError",
        "DeserializationError",
        "HandshakeError",
        "InvalidNameError",
        "MasterError",
        "MasterUnreachable",
        "Md5MismatchError",
        "MessageError",
        "MessageNotFoundError",
        "MessageSpecError",
        "NodeNotFound",
        "PeerError",
        "PeerUnreachable",
        "RosError",
        "SerializationError",
        "ServiceError",
        "ServiceNotFound",
        "ServiceUnavailable",
    ),
    "events": (
        "ClockJumped",
        "Event",
        "EventStream",
        "MasterLost",
        "MasterRestarted",
        "ParamUpdate",
        "PeerConnected",
        "PeerDisconnected",
        "RoleRegistered",
        "RoleUnregistered",
    ),
    "graph": ("Graph", "GraphChange", "GraphChanges", "GraphNode", "GraphSnapshot"),
    "idl.genpy_types": ("GenpyMessage", "GenpyService"),
    "idl.importer": ("install_importer", "uninstall_importer"),
    "idl.message": ("AnyMessage", "Message"),
    "idl.service": ("Action", "AnyAction", "AnyService", "Service"),
    "idl.store": ("MessageStore", "load_action", "load_msg", "load_srv"),
    "log.node_log": ("NodeLog", "SparseLog"),
    "master.server": ("Master", "MasterStats"),
    "node.composite": ("Composite",),
    "node.node": ("Node",),
    "node.wait_for_master": ("wait_for_master",),
    "options": ("Limits", "NodeOptions", "Timeouts"),
    "params.subscriber": ("ParamSubscriber",),
    "script": ("run",),
    "services.call": ("ServiceCall",),
    "services.caller": ("PendingCall", "ServiceCaller", "ServiceCallerOptions"),
    "services.provider": ("ServiceProvider", "ServiceProviderOptions"),
    "time": ("Duration", "Time"),
    "topics.merge": ("Merge", "merge"),
    "topics.options": ("PublisherOptions", "SubscriberOptions"),
    "topics.publisher": ("Publisher",),
    "topics.subscriber": ("MessageEvent", "Subscriber"),
    "xmlrpc.master_proxy": ("MasterProxy", "SystemState", "TopicType"),
    "xmlrpc.node_proxy": (
        "BusInfo",
        "BusStats",
        "NodeProxy",
        "PublishConnection",
        "PublishStats",
        "ServiceStats",
        "SubscribeConnection",
        "SubscribeStats",
    ),
}
_HOMES = {name: module for module, names in _MODULES.items() for name in names}

__all__ = ["__version__", *_HOMES]


def __getattr__(name: str) -> Any:
    home = _HOMES.get(name)
    if home is None:
        from aioros1.hints import MODULE_HABITS, no_attribute

        raise no_attribute(f"module {__name__!r}", name, MODULE_HABITS)
    value = getattr(import_module(f"{__name__}.{home}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
