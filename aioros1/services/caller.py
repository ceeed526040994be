"""Calling a service."""

from __future__ import annotations

import asyncio
import itertools
from collections.abc import Mapping
from dataclasses import dataclass
from types import EllipsisType
from typing import TYPE_CHECKING, Any, Generic, TypeVar, cast

from aioros1.core.role import Role
from aioros1.errors import (
    ClosedError,
    DeserializationError,
    HandshakeError,
    MasterError,
    ServiceError,
    ServiceUnavailable,
)
from aioros1.events import PeerConnected, PeerDisconnected
from aioros1.idl.message_from import message_from
from aioros1.net.backoff import Backoff
from aioros1.net.service_link import ServiceLink
from aioros1.net.tcpros import Stream, connection_info, take_over
from aioros1.services.lookup import agree, look_up, probe
from aioros1.waiting import Waiters, deadline
from aioros1.wire.handshake import ServiceOffer
from aioros1.wire.service import ANSWER_HEAD, SUCCESS, ServiceFrameError

if TYPE_CHECKING:
    from aioros1.connection import ConnectionInfo
    from aioros1.idl import Service
    from aioros1.idl.genpy_types import GenpyMessage
    from aioros1.node import Node

__all__ = ["PendingCall", "ServiceCaller", "ServiceCallerOptions"]

Q = TypeVar("Q")
A = TypeVar("A")


@dataclass(frozen=True, slots=True, kw_only=True)
class ServiceCallerOptions:
    """How a caller was opened; the defaults are those of :meth:`Node.service_caller`."""

    persistent: bool = False
    """Keep one connection for all calls, which then happen one after the other.
    Otherwise every call makes its own, and calls may overlap."""

    timeout: float | None = None
    """Seconds for a call that does not say; None waits for ever."""

    tcp_nodelay: bool = True
    """Ask the provider to send small answers at once."""


class PendingCall(asyncio.Task[A]):
    """A call on its way, from :meth:`ServiceCaller.send_request`; await it for the response."""

    sequence: int
    """Counts the calls of one caller. Local: nothing of it is on the wire."""


class ServiceCaller(Role, Generic[Q, A]):
    """Calls one service; made by :meth:`Node.service_caller`.

    A caller is not registered at the master, and opening one does not ask whether the
    service is there. A request is sent once: when its connection is lost before the
    answer came, the call fails, because the provider may have acted on it.
    """

    kind = "service caller"

    def __init__(
        self,
        node: Node,
        name: str,
        service_class: type[Service[Any, Any]],
        options: ServiceCallerOptions,
    ) -> None:
        super().__init__(node, name)
        self.options = options
        self.service_class = service_class
        self.provider_uri: str | None = None
        """The ``rosrpc://host:port`` that was called last."""
        self._turn = asyncio.Lock()
        self._is_busy = False  # with a call that did not take the lock
        self._idle = Waiters()
        self._kept: _Connection | None = None
        self._open: set[_Connection] = set()
        self._limits: set[deadline] = set()
        self._sequence = itertools.count(1)

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
        return tuple(connection.info for connection in self._open)

    @property
    def links(self) -> tuple[tuple[ServiceLink, ConnectionInfo], ...]:
        return tuple((connection.link, connection.info) for connection in self._open)

    def request(self, **fields: Any) -> Q:
        """A new request."""
        return cast("Q", self.service_class._request_class(**fields))

    async def call(
        self,
        request: Q | GenpyMessage | Mapping[str, Any] | None = None,
        /,
        *,
        timeout: float | EllipsisType | None = ...,
        **fields: Any,
    ) -> A:
        """Call with a request, a dict of its fields, or its ``fields``; the response.

        ``timeout`` is in seconds, None waits for ever, and without it the caller's own
        counts. It covers everything: the look-up, the connection, the turn on a
        persistent connection, and the answer.

        Raises :class:`~aioros1.ServiceError` with the provider's text when it answers
        that the call failed, :class:`~aioros1.ServiceNotFound` when there is none,
        :class:`~aioros1.ServiceUnavailable` when it cannot be reached or is lost,
        :class:`~aioros1.HandshakeError` when it means another type,
        :class:`~aioros1.SerializationError` for values that do not fit,
        :class:`TimeoutError` and :class:`~aioros1.ClosedError`. After a timeout and
        when it is cancelled the connection is closed, so that an answer that comes late
        is never taken for another call's.
        """
        self._check_open()
        request_class = self.service_class._request_class
        if fields or request.__class__ is not request_class:
            request = message_from(request_class, request, fields, "request")
        frame = request_class._frame(request)
        seconds = self.options.timeout if timeout is ... else timeout
        kept = self._kept
        if (
            seconds is None
            and kept is not None
            and kept.link.is_fresh
            and not (self._is_busy or self._turn.locked())
        ):
            # The quick way of most calls: there is nothing to wait for but the answer, and
            # that ends when the connection is closed. A deadline would cost 3 µs, to take
            # the lock 1.
            self._is_busy = True
            try:
                return await self._exchange(kept, frame)
            finally:
                self._is_busy = False
                self._idle.wake()
        try:
            async with deadline(seconds, f"service {self.name}: no answer") as limit:
                self._limits.add(limit)
                try:
                    if not self.options.persistent:
                        return await self._call_once(frame)
                    async with self._turn:
                        while self._is_busy:
                            await self._idle.wait()
                        return await self._call_kept(frame)
                finally:
                    self._limits.discard(limit)
        except TimeoutError:
            self._check_open()  # closing has ended it, and not the time
            raise

    __call__ = call

    def send_request(
        self,
        request: Q | GenpyMessage | Mapping[str, Any] | None = None,
        /,
        *,
        timeout: float | EllipsisType | None = ...,
        **fields: Any,
    ) -> PendingCall[A]:
        """Begin a call and return at once; awaiting the result gives what :meth:`call` does.

        Cancelling the result cancels the call.
        """
        self._check_open()
        number = next(self._sequence)
        call: PendingCall[A] = PendingCall(
            self.call(request, timeout=timeout, **fields),
            loop=asyncio.get_running_loop(),
            name=f"{self._node.name} calls {self.name} ({number})",
        )
        call.sequence = number
        return call

    async def is_available(self) -> bool:
        """Whether the service is registered and its provider answers for it."""
        return await self._obstacle() is None

    async def wait_for_service(self, *, timeout: float | None = None) -> None:
        """Wait until :meth:`is_available`.

        Raises :class:`TimeoutError`, which says what was in the way, after ``timeout``
        seconds, and :class:`~aioros1.ClosedError`.
        """
        # The master tells nobody of new services, so there is nothing but to ask.
        backoff = Backoff(first=0.02, longest=0.5)
        async with deadline(timeout, f"service {self.name} did not appear") as limit:
            while (obstacle := await self._obstacle()) is not None:
                limit.why = obstacle
                await self._node._pause(backoff.delay())

    async def _obstacle(self) -> Exception | None:
        """Why the service is not available; None when it is."""
        self._check_open()
        try:
            await probe(self._node, self.name)
        except (ServiceError, HandshakeError, MasterError) as error:
            return error
        return None

    # one call

    async def _call_once(self, frame: bytes) -> A:
        connection = await self._connect()
        try:
            return await self._exchange(connection, frame)
        finally:
            self._drop(connection)

    async def _call_kept(self, frame: bytes) -> A:
        connection = self._kept
        # Bytes that nobody asked for must not be taken for the answer to this call.
        if connection is not None and not connection.link.is_fresh:
            self._drop(connection)
            connection = None
        if connection is None:
            connection = self._kept = await self._connect()
        return await self._exchange(connection, frame)

    async def _exchange(self, connection: _Connection, frame: bytes) -> A:
        """Send a request and take the answer; without one the connection is closed."""
        link = connection.link
        self._count(connection, len(frame))
        try:
            link.write(frame)
            if link.is_full:
                await link.drain()
            answer = await link.receive(patience=None)
        except (OSError, ServiceFrameError, TimeoutError) as error:
            self._drop(connection)
            raise self._lost(str(error) or type(error).__name__) from error
        except BaseException:
            self._drop(connection)
            raise
        if answer is None:
            self._drop(connection)
            raise self._lost("the provider closed the connection before it answered")
        connection.info.stats.bytes += len(answer)
        if answer[:1] != SUCCESS:
            self.stats.errors += 1
            raise ServiceError(answer[ANSWER_HEAD:].decode("utf-8", "surrogateescape"))
        try:
            response: A = self.service_class._response_class._decode(
                answer, ANSWER_HEAD, len(answer)
            )
        except DeserializationError as error:
            self.stats.errors += 1
            self._drop(connection)
            raise self._lost(f"the provider's answer cannot be read: {error}") from error
        return response

    def _count(self, connection: _Connection, size: int) -> None:
        for stats in (connection.info.stats, self.stats):
            stats.messages += 1
            stats.bytes += size

    def _lost(self, why: str) -> ServiceUnavailable | ClosedError:
        if not self._is_open:
            return self._closed_error()
        return ServiceUnavailable(f"service {self.name} at {self.provider_uri}: {why}")

    # connections

    async def _connect(self) -> _Connection:
        node = self._node
        uri = self.provider_uri = await look_up(node, self.name)
        stream, header = await agree(
            node,
            uri,
            ServiceOffer(self.name, self.type, self.md5sum),
            persistent=self.options.persistent,
            tcp_nodelay=self.options.tcp_nodelay,
        )
        try:
            link = ServiceLink(
                stream,
                head=ANSWER_HEAD,
                max_bytes=node.limits.message_bytes,
                patience=node.timeouts.stall,
                stall=node.timeouts.stall,
            )
            try:
                rest = await take_over(stream, link)
                if rest:
                    link.data_received(rest)
            except OSError as error:
                raise ServiceUnavailable(f"service {self.name}: {error}") from error
            self._check_open()
        except BaseException:
            stream.abort()
            raise
        return self._opened(stream, link, header)

    def _opened(self, stream: Stream, link: ServiceLink, header: Mapping[str, str]) -> _Connection:
        peer = header.get("callerid", stream.peer)
        info = connection_info(stream, self.name, "b", peer, header)
        connection = _Connection(link, info)
        self._open.add(connection)
        link.ended = lambda: self._drop(connection)  # also while nobody calls
        self._node._emit(PeerConnected("service caller", self.name, info))
        return connection

    def _drop(self, connection: _Connection) -> None:
        connection.link.ended = None  # which would keep it until a collection of garbage
        connection.link.abort()
        if connection is self._kept:
            self._kept = None
        if connection in self._open:
            self._open.discard(connection)
            self._node._emit(PeerDisconnected("service caller", self.name, connection.info))

    def _abort(self) -> None:
        super()._abort()
        for limit in self._limits:
            limit.expire()
        for connection in tuple(self._open):
            self._drop(connection)

    async def _close(self) -> None:
        self._abort()


class _Connection:
    __slots__ = ("info", "link")

    def __init__(self, link: ServiceLink, info: ConnectionInfo) -> None:
        self.link = link
        self.info = info
