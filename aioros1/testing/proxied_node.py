"""Proxies between a node and everything that connects to it."""

from __future__ import annotations

import contextlib
import ipaddress
import sys
from collections.abc import AsyncIterator
from dataclasses import dataclass
from typing import TYPE_CHECKING
from urllib.parse import urlsplit

from aioros1._public import public
from aioros1.testing.flaky_proxy import FlakyProxy, Script

if TYPE_CHECKING:
    from aioros1 import Node

__all__ = ["NodeProxies", "proxies_before"]

_NETWORK = ipaddress.ip_network("127.0.0.0/8")


@public("aioros1.testing")
@dataclass(frozen=True, slots=True)
class NodeProxies:
    """The two proxies in front of a node; for both, "up" is towards the node."""

    slave_api: FlakyProxy
    """Requests of the master and other nodes (XML-RPC over HTTP)."""

    tcpros: FlakyProxy
    """Topics that the node publishes and services that it provides."""

    def cut(self) -> None:
        """Reset every connection of both proxies."""
        self.slave_api.cut()
        self.tcpros.cut()


@public("aioros1.testing")
@contextlib.asynccontextmanager
async def proxies_before(node: Node, *, script: Script | None = None) -> AsyncIterator[NodeProxies]:
    """Put proxies between ``node`` and everything that connects to it.

    The node has to be started, and made with two addresses of this machine, as in
    ``Node(name, host="127.0.0.2", bind="127.0.0.1")``: it listens at ``bind``, and announces
    ``host`` with the same port numbers, where the proxies listen. So no message has to be
    rewritten.

    ``script`` is called for the connections of both proxies. Connections that the node itself
    opens do not go through them. Only on Linux does all of 127.0.0.0/8 belong to the machine.

    Raises :class:`ValueError` for a node with other addresses, :class:`RuntimeError` for one
    that is not started or on another system, and :class:`OSError` if a port is taken.
    """
    if not sys.platform.startswith("linux"):
        raise RuntimeError(f"proxies_before() needs Linux with its 127.0.0.0/8, not {sys.platform}")
    if not node.is_open:
        raise RuntimeError(f"proxies_before() needs a node that is started, not {node!r}")
    host, port = node.tcpros_address
    bind = "127.0.0.1" if node.options.bind == "localhost" else node.options.bind
    if bind is None or bind == host or not (_is_ours(host) and _is_ours(bind)):
        raise ValueError(
            f"expected a node whose host and bind are two addresses of 127.0.0.0/8, as in "
            f"Node({node.base_name!r}, host='127.0.0.2', bind='127.0.0.1'), "
            f"got host={host!r} and bind={node.options.bind!r}"
        )
    api_port = urlsplit(node.uri).port
    assert api_port is not None
    async with (
        FlakyProxy(bind, api_port, listen_host=host, listen_port=api_port, script=script) as api,
        FlakyProxy(bind, port, listen_host=host, listen_port=port, script=script) as tcpros,
    ):
        yield NodeProxies(api, tcpros)


def _is_ours(host: str) -> bool:
    try:
        return ipaddress.ip_address(host) in _NETWORK
    except ValueError:
        return False
