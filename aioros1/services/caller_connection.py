"""One connection of a service caller."""

from __future__ import annotations

import socket
from typing import TYPE_CHECKING

from aioros1.connection import ConnectionInfo
from aioros1.errors import ServiceUnavailable
from aioros1.net.service_link import ServiceLink
from aioros1.net.tcpros import connection_info, take_over
from aioros1.services.lookup import agree
from aioros1.wire.handshake import ServiceOffer
from aioros1.wire.service import ANSWER_HEAD

if TYPE_CHECKING:
    from aioros1.core.context import Context

__all__ = ["CallerConnection", "connect_to"]


class CallerConnection:
    """A connection after its handshake: requests go out, answers come in."""

    __slots__ = ("info", "link")

    def __init__(self, link: ServiceLink, info: ConnectionInfo) -> None:
        self.link = link
        self.info = info


async def connect_to(
    context: Context, uri: str, wanted: ServiceOffer, *, persistent: bool, tcp_nodelay: bool
) -> CallerConnection:
    """Connect to the provider at ``uri``, ``rosrpc://host:port``.

    Raises :class:`~aioros1.ServiceUnavailable`, and :class:`~aioros1.HandshakeError` when the
    provider refuses or has another type.
    """
    stream, header = await agree(context, uri, wanted, persistent=persistent)
    try:
        if not tcp_nodelay:
            sock = stream.writer.get_extra_info("socket")
            sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 0)
        stall = context.timeouts.stall
        link = ServiceLink(
            stream,
            head=ANSWER_HEAD,
            max_bytes=context.limits.message_bytes,
            patience=stall,
            stall=stall,
        )
        try:
            rest = await take_over(stream, link)
            if rest:
                link.data_received(rest)
        except OSError as error:
            raise ServiceUnavailable(f"service {wanted.service}: {error}") from error
    except BaseException:
        stream.abort()
        raise
    peer = header.get("callerid", stream.peer)
    return CallerConnection(link, connection_info(stream, wanted.service, "b", peer, header))
