"""A service that a node provides, as the graph sees it."""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import Mapping
from typing import Any, Protocol

from aioros1.connection import ConnectionInfo
from aioros1.core.context import Context
from aioros1.core.shared import Shared
from aioros1.core.stats import RoleStats
from aioros1.core.user_errors import described
from aioros1.errors import ClosedError, ServiceError
from aioros1.net.service_link import ServiceLink
from aioros1.net.tcpros import Stream, connection_info, take_over
from aioros1.services.call import ServiceCall
from aioros1.services.provider_connection import Handler, ProviderConnection
from aioros1.services.side import Side
from aioros1.waiting import Waiters
from aioros1.wire.handshake import Server, ServiceOffer
from aioros1.wire.service import REQUEST_HEAD

__all__ = ["Provision"]


class Providing(Protocol):
    """What a provision needs of a provider."""

    stats: RoleStats

    @property
    def is_open(self) -> bool: ...

    async def close(self) -> None: ...

    def _start_closing(self) -> None: ...


class Provision(Shared[Providing]):
    """One provided service of one node, and the connections of its callers.

    ``offer`` is sent to callers; ``side`` reads requests and writes responses. Without
    ``handler``, calls wait in :attr:`calls`. At most ``max_concurrency`` calls of the handler
    run at a time.
    """

    kind = "service"

    def __init__(
        self,
        context: Context,
        table: dict[str, Provision],
        offer: ServiceOffer,
        side: Side,
        handler: Handler[Any, Any] | None,
        max_concurrency: int | None,
    ) -> None:
        super().__init__(context, offer.service, table)
        self.side = side
        self.handler = handler
        self.slots = None if max_concurrency is None else asyncio.Semaphore(max_concurrency)
        """Held by each running call of the handler, if their number is bounded."""
        self.provider: Providing | None = None
        """The one provider that uses this, or has used it."""
        self.stats = RoleStats()
        self.bytes_received = 0
        self.bytes_sent = 0
        self.running = 0
        """Calls whose handler is a coroutine that has not returned."""
        self.idle = Waiters()
        """Woken when no such call is left."""
        self.has_left = Waiters()
        """Woken when the last provider has left and the master was told."""
        self.is_at_master = True
        self.calls: deque[ServiceCall[Any, Any]] = deque()
        """Calls that wait to be taken."""
        self.arrived = Waiters()
        """Woken when a call arrives, and when no more will."""
        self._offer = offer
        self._unanswered: set[ServiceCall[Any, Any]] = set()
        self._links: dict[ServiceLink, ConnectionInfo] = {}
        self._served = Waiters()

    @property
    def is_open(self) -> bool:
        """Whether calls are answered."""
        return self.provider is not None and self.provider.is_open

    @property
    def patience(self) -> float:
        """Seconds in which a caller that is not persistent has to send its request."""
        return self._context.timeouts.handshake

    @property
    def connections(self) -> tuple[ConnectionInfo, ...]:
        """The connections of its callers."""
        return tuple(self._links.values())

    async def serve(self, stream: Stream, server: Server) -> None:
        """Answer the calls of one connection; ``server`` holds its header.

        Raises :class:`~aioros1.HandshakeError`, :class:`ConnectionError` and
        :class:`TimeoutError` when it fails.
        """
        context = self._context
        timeouts = context.timeouts
        header = server.accept_service(context.name, self._offer)
        await stream.write(header, stall=timeouts.stall)
        if server.probe:
            return
        link = ServiceLink(
            stream,
            head=REQUEST_HEAD,
            max_bytes=context.limits.message_bytes,
            patience=timeouts.handshake,
            stall=timeouts.stall,
            budget=context.budget,
        )
        rest = await take_over(stream, link)
        if rest:
            link.data_received(rest)
        server.header = context.connections.kept(server.header)
        info = connection_info(stream, self.name, "b", server.caller_id, server.header)
        self._links[link] = info
        context.connections.add(self.kind, link, info)
        reason = ""
        try:
            await ProviderConnection(self, link, server, info).run()
        except (OSError, TimeoutError) as error:
            reason = str(error)
        finally:
            del self._links[link]
            self._served.wake()
            context.connections.remove(link, reason)

    async def defer(self, request: Any, header: Mapping[str, str]) -> bytes:
        """Queue a call for whoever iterates over the provider; returns the response's frame.

        Raises :class:`~aioros1.ServiceError` when the answer is an error, or none comes.
        """
        if not self.is_open:
            raise ServiceError("the service is shut down")
        call: ServiceCall[Any, Any] = ServiceCall(self.name, request, header, self.side)
        self.calls.append(call)
        self._unanswered.add(call)
        self.arrived.wake()
        try:
            answer = await call._answer
        finally:
            self._unanswered.discard(call)
        if isinstance(answer, ServiceError):
            raise answer
        return answer

    @property
    def owner(self) -> object:
        """The node."""
        return self._context.node

    def handler_failed(self, error: BaseException) -> BaseException:
        """Report what the handler raised, which is no :class:`Exception`."""
        return self._context.handler_error(error, f"the handler of service {self.name}")

    async def end_running(self) -> None:
        """Let handlers that run return, and answer no further calls."""
        if self.provider is not None:
            self.provider._start_closing()
        while self.running:
            await self.idle.wait()
        # The caller may be another role of this node, which has to read the answer.
        while self._links:
            await self._served.wait()

    def log_error(self, what: str, error: Exception) -> None:
        """Log what failed, with the traceback; callers can make it fail as often as they like."""
        about = (self.name, what, type(error), described(error))
        self._context.log.complain("service %s: %s", self.name, what, about=about, error=error)

    def end_calls(self, error: ClosedError) -> None:
        """End all waiting calls; answering one later raises ``error``."""
        self.calls.clear()
        self.arrived.wake()
        for call in self._unanswered:
            call._close(error)

    def abort(self) -> None:
        for link in self._links:
            link.abort()

    def _join(self, role: Providing) -> None:
        super()._join(role)
        self.provider = role
        self.stats = role.stats

    async def _disconnect(self) -> None:
        """Close connections as they become idle; close the rest when that takes too long."""
        self.is_at_master = False
        self.has_left.wake()
        for link in self._links:
            link.stop_reading()
        try:
            async with asyncio.timeout(self._context.timeouts.close):
                while self._links:
                    await self._served.wait()
        except TimeoutError:
            pass
        finally:
            self.abort()

    # at the master

    async def _register(self) -> None:
        context = self._context
        address = context.address
        await context.registrar.register_service(self.name, address.tcpros_uri, address.uri)

    async def _unregister(self) -> None:
        context = self._context
        await context.registrar.unregister_service(self.name, context.address.tcpros_uri)
