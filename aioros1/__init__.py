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
    "connection": ("ConnectionInfo", "ConnectionStats"),
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
        "PeerError",
        "PeerUnreachable",
        "RosError",
        "SerializationError",
        "ServiceError",
        "ServiceNotFound",
        "ServiceUnavailable",
    ),
    "events": (
        "Event",
        "MasterLost",
        "MasterRestarted",
        "ParamUpdate",
        "PeerConnected",
        "PeerDisconnected",
        "RoleRegistered",
        "RoleUnregistered",
    ),
    "idl": ("MessageStore", "load_action", "load_msg", "load_srv"),
    "idl.importer": ("install_importer", "uninstall_importer"),
    "master": ("Master",),
    "topics.merge": ("merge",),
    "node": ("Node",),
    "options": ("Limits", "Timeouts"),
    "params.subscriber": ("ParamSubscriber",),
    "xmlrpc.node_proxy": ("NodeProxy",),
    "topics.publisher": ("Publisher",),
    "node.wait_for_master": ("wait_for_master",),
    "script": ("run",),
    "services.caller": ("ServiceCaller",),
    "services.call": ("ServiceCall",),
    "services.provider": ("ServiceProvider",),
    "topics.subscriber": ("MessageEvent", "Subscriber"),
    "time": ("Duration", "Time"),
}
_HOMES = {name: module for module, names in _MODULES.items() for name in names}

__all__ = ["__version__", *_HOMES]


def __getattr__(name: str) -> Any:
    home = _HOMES.get(name)
    if home is None:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f"{__name__}.{home}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
