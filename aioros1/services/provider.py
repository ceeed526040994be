"""Providing a service."""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Generic, Self, TypeAlias, TypeVar

from aioros1.core.role import Role
from aioros1.errors import ClosedError, ServiceError
from aioros1.events import PeerConnected, PeerDisconnected
from aioros1.idl.message_from import message_from
from aioros1.net.service_link import ServiceLink
from aioros1.net.tcpros import Stream, connection_info, take_over
from aioros1.services.provider_connection import Serving
from aioros1.waiting import Waiters
from aioros1.wire.handshake import Server, ServiceOffer
from aioros1.wire.service import REQUEST_HEAD

if TYPE_CHECKING:
    from aioros1.connection import ConnectionInfo
    from aioros1.idl import Message, Service
    from aioros1.idl.genpy_types import GenpyMessage
    from aioros1.node import Node

__all__ = ["ServiceCall", "ServiceProvider", "ServiceProviderOptions"]

Q = TypeVar("Q")
A = TypeVar("A")

Answer: TypeAlias = A | Mapping[str, Any] | None
Handler: TypeAlias = Callable[[Q], Answer[A] | Awaitable[Answer[A]]]


@dataclass(frozen=True, slots=True, kw_only=True)
class ServiceProviderOptions:
    """How a provider was opened; the defaults are those of :meth:`Node.advertise_service`."""

    max_concurrency: int | None = None
    """Calls that are worked on at a time; further ones wait, in the order they came."""

    def __post_init__(self) -> None:
        if self.max_concurrency is not None and self.max_concurrency < 1:
            raise ValueError(f"max_concurrency must be at least 1, got {self.max_concurrency!r}")


class ServiceCall(Generic[Q, A]):
    """A call that waits for its answer; an item of ``async for call in provider``."""

    __slots__ = ("_answer", "_closed", "header", "request", "response_class")

    def __init__(
        self, request: Q, header: Mapping[str, str], response_class: type[Message]
    ) -> None:
        self.request = request
        self.header = header
        """The caller's connection header; ``header["callerid"]`` is its name."""
        self.response_class = response_class
        self._answer: asyncio.Future[Any] = asyncio.get_running_loop().create_future()
        self._closed: ClosedError | None = None

    @property
    def caller_id(self) -> str:
        """The name of the calling node."""
        return self.header["callerid"]

    async def reply(
        self, response: A | GenpyMessage | Mapping[str, Any] | None = None, /, **fields: Any
    ) -> None:
        """Answer with a response, a dict of its fields, or its ``fields``.

        Raises :class:`~aioros1.SerializationError` for values that do not fit; the call
        then still waits. Raises :class:`~aioros1.ClosedError` once the provider is closed,
        which has answered for it, and :class:`RuntimeError` for a second answer. A call
        whose caller is gone is answered like any other.
        """
        message = message_from(self.response_class, response, fields)
        self._settle(self.response_class._frame(message))

    async def fail(self, text: str) -> None:
        """Answer that the call has failed; the caller gets ``text``."""
        self._settle(ServiceError(text))

    def _settle(self, answer: object) -> None:
        if self._answer.done():
            raise self._closed or RuntimeError("the call is answered already")
        self._answer.set_result(answer)

    def _close(self, error: ClosedError) -> None:
        """The provider will not wait for an answer."""
        if not self._answer.done():
            self._closed = error
            self._answer.set_result(ServiceError("the service is shut down"))


class ServiceProvider(Role, Generic[Q, A]):
    """Answers calls of one service; made by :meth:`Node.advertise_service`.

    With a handler, that is called with each request. Without one, the provider is
    iterated, and every :class:`ServiceCall` it gives is answered whenever its time has
    come, in any order.
    """

    kind = "service"

    def __init__(
        self,
        node: Node,
        name: str,
        service_class: type[Service[Any, Any]],
        handler: Handler[Q, A] | None,
        options: ServiceProviderOptions,
    ) -> None:
        super().__init__(node, name)
        self.options = options
        self.service_class = service_class
        self.registration = node._roles.registration(
            "service", name, self._register, self._unregister
        )
        self.handler = handler
        self._calls: deque[ServiceCall[Q, A]] = deque()
        self._unanswered: set[ServiceCall[Q, A]] = set()
        self._arrived = Waiters()
        self._served = Waiters()
        self._connections: dict[ServiceLink, ConnectionInfo] = {}
        self.slots = (
            None if options.max_concurrency is None else asyncio.Semaphore(options.max_concurrency)
        )
        """What calls of the handler have to get hold of, if their number is bounded."""
        self.bytes_received = 0
        self.bytes_sent = 0

    @property
    def type(self) -> str:
        return self.service_class._type

    @property
    def md5sum(self) -> str:
        return self.service_class._md5sum

    @property
    def definition(self) -> str:
        return self.service_class._full_text

    @property
    def connections(self) -> tuple[ConnectionInfo, ...]:
        return tuple(self._connections.values())

    @property
    def links(self) -> tuple[tuple[ServiceLink, ConnectionInfo], ...]:
        return tuple(self._connections.items())

    @property
    def uri(self) -> str:
        """The ``rosrpc://host:port`` that callers are given by the master."""
        return self._node.tcpros_uri

    def offer(self) -> ServiceOffer:
        """What a caller is told when it connects."""
        return ServiceOffer(self.name, self.type, self.md5sum)

    # without a handler

    def __aiter__(self) -> Self:
        if self.handler is not None:
            raise TypeError(f"service {self.name} has a handler, which takes all calls")
        return self

    async def __anext__(self) -> ServiceCall[Q, A]:
        while not self._calls:
            if not self._is_open:
                raise StopAsyncIteration
            await self._arrived.wait()
        return self._calls.popleft()

    # connections

    async def serve(self, stream: Stream, server: Server) -> None:
        """Answer the calls that come over one connection, whose header is ``server``'s."""
        header = server.accept_service(self._node.name, self.offer())
        await stream.write(header, stall=self._node.timeouts.stall)
        if server.probe:
            return
        node = self._node
        link = ServiceLink(
            stream,
            head=REQUEST_HEAD,
            max_bytes=node.limits.message_bytes,
            patience=node.timeouts.handshake,
            stall=node.timeouts.stall,
        )
        rest = await take_over(stream, link)
        if rest:
            link.data_received(rest)
        info = connection_info(stream, self.name, "b", server.caller_id, server.header)
        self._connections[link] = info
        self._node._emit(PeerConnected("service", self.name, info))
        reason = ""
        try:
            await Serving(self, link, server, info).run()
        except (OSError, TimeoutError) as error:
            reason = str(error)
        finally:
            del self._connections[link]
            self._served.wake()
            self._node._emit(PeerDisconnected("service", self.name, info, reason))

    async def defer(self, request: Any, header: Mapping[str, str]) -> bytes:
        """Leave a call to whoever iterates the provider; the response, as a frame."""
        if not self._is_open:
            raise ServiceError("the service is shut down")
        call: ServiceCall[Q, A] = ServiceCall(request, header, self.service_class._response_class)
        self._calls.append(call)
        self._unanswered.add(call)
        self._arrived.wake()
        try:
            answer = await call._answer
        finally:
            self._unanswered.discard(call)
        if isinstance(answer, ServiceError):
            raise answer
        return bytes(answer)

    # at the master

    async def _register(self) -> None:
        node = self._node
        await node._registrar.register_service(self.name, self.uri, node.uri)

    async def _unregister(self) -> None:
        await self._node._registrar.unregister_service(self.name, self.uri)

    def _abort(self) -> None:
        super()._abort()
        self._end_iteration()
        for link in self._connections:
            link.abort()

    async def _close(self) -> None:
        """Let calls that are being worked on be answered, and no further ones begin."""
        self._end_iteration()
        await self._node._roles.close_provider(self)

    def _end_iteration(self) -> None:
        self._calls.clear()
        self._arrived.wake()
        for call in self._unanswered:
            call._close(self._closed_error())

    async def close_connections(self, timeout: float) -> None:
        """Close connections as they become idle, and after ``timeout`` seconds the rest."""
        for link in self._connections:
            link.stop_reading()
        try:
            async with asyncio.timeout(timeout):
                while self._connections:
                    await self._served.wait()
        except TimeoutError:
            pass
        finally:
            for link in self._connections:
                link.abort()
