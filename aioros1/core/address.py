"""The addresses a node announces to others."""

from __future__ import annotations

from aioros1.net.hosts import uri_host

__all__ = ["Address"]


class Address:
    """The host and ports of one node. The node fills them in while it starts."""

    def __init__(self, node_name: str, host: str | None) -> None:
        self._node_name = node_name
        self.known_host = host
        """The host the node announces; None until the node has found it."""
        self.xmlrpc_port = 0
        self.tcpros_port = 0

    @property
    def host(self) -> str:
        """The host the node announces to others.

        Raises :class:`RuntimeError` before the node has found it.
        """
        if self.known_host is None:
            raise RuntimeError(f"node {self._node_name} has no address before it is started")
        return self.known_host

    @property
    def uri(self) -> str:
        """The URI of the slave API."""
        return f"http://{uri_host(self.host)}:{self._open(self.xmlrpc_port)}/"

    @property
    def tcpros(self) -> tuple[str, int]:
        """The host and port for topics and services."""
        return self.host, self._open(self.tcpros_port)

    @property
    def tcpros_uri(self) -> str:
        """The URI the node registers its services with."""
        return f"rosrpc://{uri_host(self.host)}:{self._open(self.tcpros_port)}"

    def _open(self, port: int) -> int:
        if not port:
            raise RuntimeError(f"node {self._node_name} has no address before it is started")
        return port
