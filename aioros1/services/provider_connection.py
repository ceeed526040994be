"""One connection of a service provider: requests come in, answers go out.

A request of a persistent connection is handled as soon as it arrives, if the connection's
task waits for one and no answer is stuck: a handler that is a plain function then answers
without any task. That takes a quarter off the time of a call. Whatever takes longer continues
in the task of the connection, one call after the other.
"""

from __future__ import annotations

import inspect
from collections.abc import Awaitable, Callable, Coroutine, Mapping
from typing import TYPE_CHECKING, Any, Protocol, TypeAlias, TypeVar

from aioros1.core.awaited import Awaited
from aioros1.core.user_errors import described
from aioros1.errors import DeserializationError, SerializationError, ServiceError
from aioros1.wire.service import REQUEST_HEAD, SUCCESS, ServiceFrameError, encode_failure

if TYPE_CHECKING:
    import asyncio

    from aioros1.connection import ConnectionInfo
    from aioros1.core.stats import RoleStats
    from aioros1.net.service_link import ServiceLink
    from aioros1.services.side import Side
    from aioros1.waiting import Waiters
    from aioros1.wire.handshake import Server

__all__ = ["Handler", "ProviderConnection"]

Q = TypeVar("Q")
A = TypeVar("A")

Answer: TypeAlias = A | Mapping[str, Any] | None
Handler: TypeAlias = Callable[[Q], Answer[A] | Awaitable[Answer[A]]]
"""A function or a coroutine function that answers a request."""

Work: TypeAlias = Coroutine[Any, Any, bytes]
"""A coroutine that returns the answer to a call that has begun."""


class Provided(Protocol):
    """What a connection needs of its service."""

    name: str
    side: Side
    handler: Handler[Any, Any] | None
    slots: asyncio.Semaphore | None
    stats: RoleStats
    bytes_received: int
    bytes_sent: int
    running: int
    idle: Waiters

    @property
    def is_open(self) -> bool:
        """Whether calls are answered."""
        ...

    @property
    def patience(self) -> float:
        """Seconds in which a caller that is not persistent has to send its request."""
        ...

    async def defer(self, request: Any, header: Mapping[str, str]) -> bytes:
        """Queue a call for somebody who answers it later."""
        ...

    @property
    def owner(self) -> object:
        """The node, for :class:`.Awaited`."""
        ...

    def log_error(self, what: str, error: Exception) -> None:
        """Log what failed."""

    def handler_failed(self, error: BaseException) -> BaseException:
        """Report what the handler raised, which is no :class:`Exception`. Returns the error for
        the caller. Raises a cancellation of the running task."""
        ...


class ProviderConnection:
    """Answers the calls of one caller, over a connection after its handshake."""

    def __init__(
        self, provision: Provided, link: ServiceLink, server: Server, info: ConnectionInfo
    ) -> None:
        self._provision = provision
        self._link = link
        self._server = server
        self._info = info
        self._is_lost = False  # the next bytes may be anything
        self._side = provision.side
        # Whoever closes the provider, or its node, in a handler must not wait for the handler.
        self._code = Awaited(provision.owner, provision, is_awaited=False)

    async def run(self) -> None:
        """Answer calls until the connection ends.

        Raises :class:`OSError` and :class:`TimeoutError` when it fails.
        """
        self._code.enter()
        persistent = self._server.persistent
        if persistent:
            self._link.at_once = self._at_once
        while self._provision.is_open and await self._serve_call() and persistent:
            pass

    async def _serve_call(self) -> bool:
        """Answer one call. Returns False when there are no more."""
        work = await self._next()
        if work is None:
            return False
        if isinstance(work, bytes):
            work = self._begin(work)
        self._answer(work if isinstance(work, bytes) else await work)
        if self._link.is_full:
            await self._link.drain()
        return not self._is_lost

    async def _next(self) -> bytes | Work | None:
        """The next request, or the remaining work of one that has begun; None when no further
        request can be read."""
        patience = self._provision.patience
        try:
            # A persistent connection may be idle for days. A caller that connects for one
            # call and never makes it is as stuck as one that stops in the middle.
            work: bytes | Work | None = await self._link.receive(
                patience=None if self._server.persistent else patience
            )
            return work
        except ServiceFrameError as error:
            why = str(error)
        except TimeoutError:
            why = f"no whole request came in {patience} s"
        self._link.write(encode_failure(f"bad request: {why}"))
        await self._link.drain()
        return None

    def _at_once(self, frame: bytes) -> Work | None:
        """Answer a request as it arrives, or return the work that is left."""
        work = self._begin(frame)
        if isinstance(work, bytes):
            self._answer(work)
            return None
        return work

    def _begin(self, frame: bytes) -> bytes | Work:
        """Begin to handle a request; returns the answer, or the work that is left."""
        provision, stats, side, size = self._provision, self._info.stats, self._side, len(frame)
        stats.messages += 1
        stats.bytes += size
        provision.bytes_received += size
        counters = provision.stats
        counters.messages += 1
        counters.bytes += size
        try:
            request = side.decode(frame, REQUEST_HEAD, size)
        except DeserializationError as error:
            # The length tells where the request ends. But a caller that sends bad requests
            # and one that is out of step look the same.
            self._is_lost = True
            self._link.stop_reading()
            return encode_failure(f"bad request: {error}")
        handler = provision.handler
        if handler is None:
            return self._defer(request)
        if provision.slots is not None:
            return self._finish(self._in_turn(request))
        try:
            result = handler(request)
            if result.__class__ is not side.outgoing_class:
                if inspect.isawaitable(result):
                    return self._finish(result)
                result = side.outgoing(result, {})
            return SUCCESS + side.frame(result)
        except BaseException as error:  # whatever the handler raises is for the caller
            return self._failure(error)

    async def _finish(self, result: Awaitable[Any]) -> bytes:
        side, provision = self._side, self._provision
        self._code.is_awaited = True
        provision.running += 1
        try:
            return SUCCESS + side.frame(side.outgoing(await result, {}))
        except BaseException as error:  # whatever the handler raises is for the caller
            return self._failure(error)
        finally:
            self._code.is_awaited = False
            provision.running -= 1
            if not provision.running:
                provision.idle.wake()

    async def _defer(self, request: Any) -> bytes:
        try:
            return SUCCESS + await self._provision.defer(request, self._server.header)
        except ServiceError as error:
            return self._failure(error)

    async def _in_turn(self, request: Any) -> Any:
        provision = self._provision
        assert provision.handler is not None
        assert provision.slots is not None
        async with provision.slots:
            result = provision.handler(request)
            return await result if inspect.isawaitable(result) else result

    def _failure(self, error: BaseException) -> bytes:
        """The answer for an exception. Raises a cancellation of the running task."""
        if isinstance(error, ServiceError):
            return encode_failure(described(error))
        if not isinstance(error, Exception):
            return encode_failure(described(self._provision.handler_failed(error)))
        if isinstance(error, SerializationError):
            error.locate(self._side.outgoing_type, f"from {self._provision.name}")
            self._provision.log_error("bad response", error)
            return encode_failure(f"the service made a bad response: {described(error)}")
        self._provision.log_error("the handler failed", error)
        return encode_failure(described(error))

    def _answer(self, answer: bytes) -> None:
        provision = self._provision
        provision.bytes_sent += len(answer)
        if answer[0] == 0:
            provision.stats.errors += 1
        self._link.write(answer)
