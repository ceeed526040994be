"""Incoming TCPROS connections: hand them over, or refuse them."""

from __future__ import annotations

from collections.abc import Awaitable, Callable

from aioros1.core.context import Context
from aioros1.errors import HandshakeError
from aioros1.log.library_log import ROSOUT
from aioros1.net.admission import Admission
from aioros1.net.allow import AllowList
from aioros1.net.local_transports import LocalTransports
from aioros1.net.tcpros import Listener, Stream
from aioros1.topics.topics import NotPublishedError
from aioros1.wire.handshake import Server

__all__ = ["Acceptor"]

Serve = Callable[[Stream, Server], Awaitable[None]]


class Acceptor:
    """The TCPROS port of a node, for its topics and its services alike.

    Each connection has its own task, so one that sends nothing, or half a header, delays no
    other. It has ``timeouts.handshake`` seconds to send its header.
    """

    def __init__(self, context: Context, allow: AllowList) -> None:
        self._context = context
        self._listener = Listener(
            self._serve,
            context.spawn,
            limits=context.limits,
            timeouts=context.timeouts,
            allow=allow,
            log=context.log,
        )
        self.local = LocalTransports(context.options.local_transports, self._listener)
        """The transports other than TCP that topics use, on both sides."""
        self._serve_topic: Serve | None = None
        self._serve_service: Serve | None = None

    @property
    def admission(self) -> Admission:
        """Which connections were accepted and which were refused."""
        return self._listener.admission

    async def start(self, host: str, port: int, *, topics: Serve, services: Serve) -> int:
        """Listen, pass connections to ``topics`` and ``services``, and return the port.

        Raises :class:`OSError` when the address or port is not available.
        """
        self._serve_topic, self._serve_service = topics, services
        await self._listener.start(host, port)
        await self.local.start()
        return self._listener.port

    def close(self) -> None:
        """Accept no more connections; open ones stay open."""
        self.local.close()
        self._listener.close()

    async def wait_closed(self) -> None:
        """Wait until each connection that was being accepted is served or closed."""
        await self._listener.wait_closed()

    async def _serve(self, stream: Stream) -> None:
        context, log = self._context, self._context.log
        server = Server(
            stream.peer,
            max_bytes=context.limits.header_bytes,
            max_fields=context.limits.header_fields,
        )
        share = context.budget.share(stream.abort)
        try:
            await stream.receive_header(server, timeout=context.timeouts.handshake, share=share)
            share.close()
            serve = self._serve_topic if server.service is None else self._serve_service
            assert serve is not None
            await serve(stream, server)
        except HandshakeError as error:
            # A peer that comes while the topic, or the node, closes does not know that yet.
            is_news = not isinstance(error, NotPublishedError)
            if context.is_open and is_news and server.header.get("topic") != ROSOUT:
                host = stream.peer.rpartition(":")[0]
                about = (server.caller_id, host, error.text)
                log.complain("refused a connection of %s: %s", server.peer, error.text, about=about)
            await self._refuse(stream, server.refuse(error.text))
        except TimeoutError as error:
            log.complain("refused a connection: %s", error, about=stream.peer.rpartition(":")[0])
            await self._refuse(stream, server.refuse(str(error)))
        except OSError:
            pass  # it closed before it was served
        finally:
            share.close()
            # Buffered bytes are still sent; there is no need to wait for that.
            stream.writer.close()

    async def _refuse(self, stream: Stream, header: bytes) -> None:
        try:
            await stream.write(header, stall=self._context.timeouts.handshake)
        except (OSError, TimeoutError):
            pass  # it has already closed
