"""Connections that come in: who they want, and why not."""

from __future__ import annotations

from collections.abc import Awaitable, Callable

from aioros1.core.context import Context
from aioros1.errors import HandshakeError
from aioros1.net.admission import Admission
from aioros1.net.allow import AllowList
from aioros1.net.local_transports import LocalTransports
from aioros1.net.tcpros import Listener, Stream
from aioros1.wire.handshake import Server

__all__ = ["Acceptor"]

Serve = Callable[[Stream, Server], Awaitable[None]]


class Acceptor:
    """The TCPROS port of a node, for its topics and its services alike.

    Each connection has a task of its own, so one that sends nothing, or half a header,
    holds up no other; and it has ``timeouts.handshake`` seconds for its header.
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
        """How else than over TCP topics connect, on both sides."""
        self._serve_topic: Serve | None = None
        self._serve_service: Serve | None = None

    @property
    def admission(self) -> Admission:
        """Who was let in, and who was not."""
        return self._listener.admission

    async def start(self, host: str, port: int, *, topics: Serve, services: Serve) -> int:
        """Listen, and hand over whoever wants a topic or a service; the port.

        Raises :class:`OSError` when the address or the port is not to be had.
        """
        self._serve_topic, self._serve_service = topics, services
        await self._listener.start(host, port)
        await self.local.start()
        return self._listener.port

    def close(self) -> None:
        """Take no more connections; those that are open stay so."""
        self.local.close()
        self._listener.close()

    async def _serve(self, stream: Stream) -> None:
        context = self._context
        server = Server(
            stream.peer,
            max_bytes=context.limits.header_bytes,
            max_fields=context.limits.header_fields,
        )
        try:
            await stream.receive_header(server, timeout=context.timeouts.handshake)
            serve = self._serve_topic if server.service is None else self._serve_service
            assert serve is not None
            await serve(stream, server)
        except HandshakeError as error:
            # Who comes while the node closes has not heard of it yet.
            log = context.log.warning if context.is_open else context.log.debug
            log("refused a connection of %s", error)
            await self._refuse(stream, server.refuse(error.text))
        except TimeoutError as error:
            context.log.warning("refused a connection: %s", error)
            await self._refuse(stream, server.refuse(str(error)))
        except OSError:
            pass  # gone before it was served
        finally:
            # What was written is still sent; nobody has to wait for it.
            stream.writer.close()

    async def _refuse(self, stream: Stream, header: bytes) -> None:
        try:
            await stream.write(header, stall=self._context.timeouts.handshake)
        except (OSError, TimeoutError):
            pass  # it does not want to know
