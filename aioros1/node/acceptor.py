"""Connections that come in: who they want, and why not."""

from __future__ import annotations

from typing import TYPE_CHECKING

from aioros1.errors import HandshakeError
from aioros1.net.admission import Admission
from aioros1.net.local_transports import LocalTransports
from aioros1.net.tcpros import Listener, Stream, connection_info, take_over
from aioros1.net.topic_links import OutgoingLink
from aioros1.wire.handshake import Server

if TYPE_CHECKING:
    from aioros1.node import Node
    from aioros1.services.provider import ServiceProvider
    from aioros1.topics.publication import Publication

__all__ = ["Acceptor"]


class Acceptor:
    """The TCPROS port of a node, for its topics and its services alike.

    Each connection has a task of its own, so one that sends nothing, or half a header,
    holds up no other; and it has ``timeouts.handshake`` seconds for its header.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._listener = Listener(
            self._serve,
            node._spawn,
            limits=node.limits,
            timeouts=node.timeouts,
            allow=node._allow,
            log=node.log,
        )
        self.local = LocalTransports(node.options.local_transports, self._listener)
        """How else than over TCP topics connect, on both sides."""

    @property
    def admission(self) -> Admission:
        """Who was let in, and who was not."""
        return self._listener.admission

    @property
    def port(self) -> int:
        return self._listener.port

    async def start(self, host: str, port: int) -> None:
        await self._listener.start(host, port)

    def close(self) -> None:
        self.local.close()
        self._listener.close()

    async def _serve(self, stream: Stream) -> None:
        node = self._node
        server = Server(
            stream.peer,
            max_bytes=node.limits.header_bytes,
            max_fields=node.limits.header_fields,
        )
        try:
            await stream.receive_header(server, timeout=node.timeouts.handshake)
            if server.service is not None:
                await self._provider(server.service).serve(stream, server)
            else:
                assert server.topic is not None
                await self._serve_topic(stream, server, self._publication(server.topic))
        except HandshakeError as error:
            node.log.warning("refused a connection of %s", error)
            await self._refuse(stream, server.refuse(error.text))
        except TimeoutError as error:
            node.log.warning("refused a connection: %s", error)
            await self._refuse(stream, server.refuse(str(error)))
        except OSError:
            pass  # gone before it was served
        finally:
            # What was written is still sent; nobody has to wait for it.
            stream.writer.close()

    async def _refuse(self, stream: Stream, header: bytes) -> None:
        try:
            await stream.write(header, stall=self._node.timeouts.handshake)
        except (OSError, TimeoutError):
            pass  # it does not want to know

    def _provider(self, service: str) -> ServiceProvider[object, object]:
        provider = self._node._roles.providers.get(service)
        if provider is None:
            raise HandshakeError(self._node.name, f"{self._node.name} has no service {service}")
        return provider

    def _publication(self, topic: str) -> Publication:
        publication = self._node._roles.publications.get(topic)
        if publication is None or not publication.publishers:
            raise HandshakeError(self._node.name, f"{self._node.name} does not publish {topic}")
        return publication

    async def _serve_topic(self, stream: Stream, server: Server, publication: Publication) -> None:
        node = self._node
        offer = publication.offer()
        header = server.accept_topic(node.name, offer, publication.headers())
        theirs = server.header.get("type", "*")
        if theirs not in ("*", offer.type):
            node.log.warning(
                "%s subscribes to %s as %s, but it is %s; accepted, as their md5sums are the same",
                *(server.caller_id, offer.topic, theirs, offer.type),
            )
        info = connection_info(stream, publication.name, "o", server.caller_id, server.header)
        link = OutgoingLink(stream, info, publication, stall=node.timeouts.stall)
        stream.writer.write(header)
        await take_over(stream, link)
        publication.add(link)
        try:
            await link.wait_closed()
        finally:
            link.abort()
