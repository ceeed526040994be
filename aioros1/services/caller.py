"""Calling a service."""

from __future__ import annotations

import asyncio
import itertools
from collections.abc import Mapping
from dataclasses import dataclass
from numbers import Real
from threading import get_ident
from types import EllipsisType
from typing import Any, Generic, TypeVar, cast

from aioros1._public import public
from aioros1.connection import ConnectionInfo
from aioros1.core.context import Context
from aioros1.core.obstacles import Hint, similar_service
from aioros1.core.role import Role
from aioros1.errors import (
    ClosedError,
    DeserializationError,
    HandshakeError,
    MasterError,
    SerializationError,
    ServiceError,
    ServiceNotFound,
    ServiceUnavailable,
)
from aioros1.hints import check_kinds
from aioros1.idl import Service
from aioros1.idl.genpy_types import GenpyMessage
from aioros1.net.backoff import Backoff
from aioros1.services.caller_connection import CallerConnection, connect_to
from aioros1.services.lookup import look_up, reach
from aioros1.services.side import Side, callers_side, raw_side
from aioros1.waiting import Deadlines, Mutex
from aioros1.wire.handshake import ServiceOffer
from aioros1.wire.service import ANSWER_HEAD, SUCCESS, ServiceFrameError

__all__ = ["PendingCall", "ServiceCaller", "ServiceCallerOptions"]

Q = TypeVar("Q")
A = TypeVar("A")


@public
@dataclass(frozen=True, slots=True, kw_only=True)
class ServiceCallerOptions:
    """Options of a caller; the defaults are those of :meth:`aioros1.Node.service_caller`."""

    persistent: bool = False
    """Keep one connection for all calls, which then run one after the other.
    Otherwise every call opens its own connection, and calls may overlap."""

    timeout: float | None = None
    """Seconds for a call without a timeout of its own; None waits for ever."""

    tcp_nodelay: bool = True
    """Send each request at once. Otherwise the system may hold one back while it waits for
    the acknowledgement of an earlier one (``TCP_NODELAY``)."""

    raw: bool = False
    """Send requests and return responses as serialised bytes."""

    def __post_init__(self) -> None:
        flag = (bool, "True or False")
        check_kinds(
            self,
            {
                "persistent": flag,
                "timeout": (Real | None, "a number of seconds or None"),
                "tcp_nodelay": flag,
                "raw": flag,
            },
        )


@public
class PendingCall(asyncio.Task[A]):
    """A running call, from :meth:`ServiceCaller.send_request`; await it for the response."""

    sequence: int
    """The number of the call within its caller. It is local and never sent."""


@public
class ServiceCaller(Role, Generic[Q, A]):
    """Calls one service; made by :meth:`aioros1.Node.service_caller`.

    A caller is not registered at the master, and opening one does not check that the
    service exists. A request is sent only once: if the connection is lost before the
    answer comes, the call fails, because the provider may have acted on the request.
    """

    kind = "service caller"
    _factory = "service_caller"

    def __init__(
        self,
        context: Context,
        name: str,
        service_class: type[Service[Any, Any]] | None,
        options: ServiceCallerOptions,
    ) -> None:
        super().__init__(context, name)
        self.options = options
        """The options it was opened with."""
        self.service_class = service_class
        """The class of the service; None for a raw caller of any type."""
        self.provider_uri: str | None = None
        """The ``rosrpc://host:port`` of the last call."""
        self._raw_side = raw_side(f"service {name}")
        is_raw = options.raw or service_class is None
        self._side = self._raw_side if is_raw else callers_side(cast("Any", service_class))
        self._mutex = Mutex()  # for the persistent connection: one call after the other
        self._kept: CallerConnection | None = None
        self._open: set[CallerConnection] = set()
        self._limits = Deadlines()
        self._sequence = itertools.count(1)

    @property
    def type(self) -> str:
        return "*" if self.service_class is None else self.service_class._type

    @property
    def md5sum(self) -> str:
        return "*" if self.service_class is None else self.service_class._md5sum

    @property
    def definition(self) -> str:
        return "" if self.service_class is None else self.service_class._full_text

    @property
    def connections(self) -> tuple[ConnectionInfo, ...]:
        return tuple(connection.info for connection in self._open)

    def request(self, **fields: Any) -> Q:
        """Make a new request. Raises :class:`TypeError` for a raw caller of any type."""
        if self.service_class is None:
            raise TypeError(f"service {self.name}: a caller of any type cannot make requests")
        return cast("Q", self.service_class._request_class(**fields))

    async def call(
        self,
        request: Q | GenpyMessage | Mapping[str, Any] | None = None,
        /,
        *,
        timeout: float | EllipsisType | None = ...,
        **fields: Any,
    ) -> A:
        """Call with a request, a dict of its fields, or its ``fields``; returns the response.

        ``timeout`` is in seconds, and None waits for ever; the default is the caller's own.
        It covers everything: the look-up, the connection, the wait for a persistent
        connection, and the answer.

        Raises :class:`~aioros1.ServiceError` with the provider's text when the provider
        answers that the call failed, :class:`~aioros1.ServiceNotFound` when there is no
        provider, :class:`~aioros1.ServiceUnavailable` when it cannot be reached or the
        connection is lost, :class:`~aioros1.HandshakeError` when its type differs,
        :class:`~aioros1.SerializationError` for values that do not fit,
        :class:`TimeoutError` and :class:`~aioros1.ClosedError`. A timeout or a cancellation
        closes the connection, so that a late answer is never taken for another call's.
        """
        if not self._is_open or get_ident() != self._loop_state.thread_id:
            self._check_open()
        side = self._side
        if fields or request.__class__ is not side.outgoing_class:
            try:
                request = side.outgoing(request, fields)
            except SerializationError as error:
                raise error.locate(side.outgoing_type, f"to {self.name}")  # noqa: B904 - the same
        answer = await self._call(side, request, timeout)
        return cast("A", answer)

    async def call_raw(
        self,
        buffer: bytes | bytearray | memoryview = b"",
        /,
        *,
        timeout: float | EllipsisType | None = ...,
    ) -> bytes:
        """Call with a serialised request, unchecked; returns the serialised response.

        Raises as :meth:`call`.
        """
        self._check_open()
        side = self._raw_side
        answer = await self._call(side, side.outgoing(buffer, {}), timeout)
        return cast("bytes", answer)

    async def _call(self, side: Side, request: Any, timeout: float | EllipsisType | None) -> Any:
        try:
            frame = side.frame(request)
        except SerializationError as error:
            raise error.locate(side.outgoing_type, f"to {self.name}")  # noqa: B904 - the same
        seconds = self.options.timeout if isinstance(timeout, EllipsisType) else timeout
        kept, mutex = self._kept, self._mutex
        if seconds is None and kept is not None and not mutex.is_held and kept.link.is_fresh:
            # The fast path of most calls: only the answer is left to wait for, and closing
            # the connection ends that wait. A deadline would cost 3 µs.
            mutex.is_held = True
            try:
                return await self._exchange(kept, side, frame)
            finally:
                mutex.release()
        try:
            async with self._limits.limit(seconds, f"service {self.name}: no answer") as limit:
                limit.why = self._context.contact.obstacle
                if not self.options.persistent:
                    return await self._call_once(side, frame)
                async with mutex:
                    return await self._call_kept(side, frame)
        except TimeoutError:
            self._check_open()  # closing ended it, not the timeout
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
        """Start a call and return at once; await the result for what :meth:`call` returns.

        Cancelling the result cancels the call.
        """
        self._check_open()
        number = next(self._sequence)
        call: PendingCall[A] = PendingCall(
            self.call(request, timeout=timeout, **fields),
            loop=asyncio.get_running_loop(),
            name=f"{self._context.name} calls {self.name} ({number})",
        )
        call.sequence = number
        return call

    async def is_available(self) -> bool:
        """Whether the service is registered, and its provider takes connections.

        This asks the provider with a probe, as rospy and roscpp do. A provider that says
        nothing counts as available after half a second, because some never answer a probe.
        """
        return await self._obstacle() is None

    async def wait_for_service(self, *, timeout: float | None = None) -> None:
        """Wait until :meth:`is_available`.

        Raises :class:`TimeoutError`, whose text gives the reason, after ``timeout`` seconds,
        and :class:`~aioros1.ClosedError`.
        """
        # The master announces no new services, so we have to poll.
        backoff = Backoff(first=0.02, longest=0.5)
        obstacle: Exception | None = None
        seen = f"service {self.name}: "
        what = f"service {self.name} did not appear"
        async with self._limits.limit(timeout, what) as limit:
            with Hint(
                *(self._context, "services", self.name),
                lambda: _in_short(obstacle).removeprefix(seen),
                timeout,
            ) as limit.why:
                while (obstacle := await self._obstacle()) is not None:
                    await self._context.pause(backoff.delay())

    async def _obstacle(self) -> Exception | None:
        """Why the service is not available; None when it is."""
        self._check_open()
        try:
            await reach(self._context, self.name, self._limits)
        except (ServiceError, HandshakeError, MasterError) as error:
            return error
        return None

    # one call

    async def _call_once(self, side: Side, frame: bytes) -> Any:
        connection = await self._connect()
        try:
            return await self._exchange(connection, side, frame)
        finally:
            self._drop(connection)

    async def _call_kept(self, side: Side, frame: bytes) -> Any:
        connection = self._kept
        # Unsolicited bytes must not be taken for the answer to this call.
        if connection is not None and not connection.link.is_fresh:
            self._drop(connection)
            connection = None
        if connection is None:
            connection = self._kept = await self._connect()
        return await self._exchange(connection, side, frame)

    async def _exchange(self, connection: CallerConnection, side: Side, frame: bytes) -> Any:
        """Send a request and take the answer; close the connection if none comes."""
        link = connection.link
        size = len(frame)
        counters, stats = connection.info.stats, self.stats
        counters.messages += 1
        counters.bytes += size
        stats.messages += 1
        stats.bytes += size
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
        counters.bytes += len(answer)
        if answer[:1] != SUCCESS:
            stats.errors += 1
            raise ServiceError(answer[ANSWER_HEAD:].decode("utf-8", "surrogateescape"))
        try:
            return side.decode(answer, ANSWER_HEAD, len(answer))
        except DeserializationError as error:
            stats.errors += 1
            self._drop(connection)
            raise self._lost(f"the provider's answer cannot be read: {error}") from error

    def _lost(self, why: str) -> ServiceUnavailable | ClosedError:
        if not self._is_open:
            return self._closed_error()
        return ServiceUnavailable(f"service {self.name} at {self.provider_uri}: {why}")

    # connections

    async def _connect(self) -> CallerConnection:
        context, options = self._context, self.options
        self.provider_uri = await context.contact.reach(self._look_up)
        connection = await connect_to(
            context,
            self.provider_uri,
            ServiceOffer(self.name, self.type, self.md5sum),
            persistent=options.persistent,
            tcp_nodelay=options.tcp_nodelay,
        )
        if not self._is_open:
            connection.link.abort()
            raise self._closed_error()
        self._open.add(connection)
        connection.link.ended = lambda: self._drop(connection)  # also between calls
        context.connections.add(self.kind, connection.link, connection.info)
        return connection

    async def _look_up(self) -> str:
        try:
            return await look_up(self._context, self.name)
        except ServiceNotFound as error:
            similar = await similar_service(self._context, self.name)
            raise ServiceNotFound(f"{error.text}{similar}") from error.__cause__

    def _drop(self, connection: CallerConnection) -> None:
        connection.link.ended = None  # breaks a reference cycle
        connection.link.abort()
        if connection is self._kept:
            self._kept = None
        self._open.discard(connection)
        self._context.connections.remove(connection.link)

    def _abort(self) -> None:
        super()._abort()
        self._limits.expire()
        for connection in tuple(self._open):
            self._drop(connection)

    async def _close(self) -> None:
        self._abort()


def _in_short(obstacle: Exception | None) -> str:
    if isinstance(obstacle, MasterError):
        return obstacle.in_short
    return "" if obstacle is None else str(obstacle)
