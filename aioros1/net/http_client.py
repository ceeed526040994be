"""An HTTP client with keep-alive connections: as much of one as XML-RPC needs.

aiohttp's session would make the small calls between nodes and their master twice as
expensive; docs/design/xmlrpc.md has the figures.
"""

from __future__ import annotations

import asyncio
import contextlib
import math
from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple, cast
from urllib.parse import quote, urlsplit

from aioros1.net.connecting import connect, reason_of
from aioros1.net.ending import shut_down
from aioros1.net.hosts import set_keepalive, uri_host
from aioros1.waiting import Waiters
from aioros1.wire.carriage_returns import with_references
from aioros1.wire.http import MAX_URI, AnswerReader, HttpError

__all__ = ["HttpClient", "Server", "server_at"]

PER_SERVER = 8
"""The most connections to one server. Enough for a node that registers many roles at once,
and few enough for a server that starts a thread for each."""

IDLE = 15.0
"""Seconds after which an idle connection is closed; it may take up to twice as long."""

CLOSING = 5.0
"""Seconds in which event loops must have told the end of connections that were aborted."""

# Seconds idle, seconds between probes, probes: half a minute in all.
_KEEPALIVE = (15, 5, 3)

# Bytes written in one piece. A larger body is written as fast as the server takes it, so
# that the transport does not have to buffer all of it.
_PIECE = 256 << 10


class Server(NamedTuple):
    """Where requests go, and how each of them begins."""

    host: str
    port: int
    head: bytes
    """The head of a request, up to the length of its body."""


@lru_cache(maxsize=1024)
def server_at(uri: str, *, any_path: bool = False) -> Server:
    """Parse ``uri``. Raises :class:`ValueError` if it is not an HTTP URI, or a very long one.

    Whoever registers a node chooses the URI to which its master and other nodes send
    requests. They serve XML-RPC at ``/`` and ``/RPC2`` alone, so that any other path, and any
    query, becomes ``/``: otherwise one could have requests sent to the pages of any HTTP
    server. With ``any_path`` the path is kept.
    """
    if len(uri) > MAX_URI:
        raise ValueError(f"a URI of {len(uri)} characters, more than {MAX_URI}")
    parts = urlsplit(uri)
    host, port = parts.hostname, 80 if parts.port is None else parts.port
    if parts.scheme != "http" or not host or not port:
        raise ValueError(f"not an HTTP URI: {uri!r}")
    if not host.isascii():
        host = host.encode("idna").decode()
    # No path means /RPC2, as for Python's own client. Characters are quoted that are not
    # ASCII, or that would end the request line.
    path = quote(parts.path or "/RPC2", safe="/%:@!$&'()*+,;=~")
    if parts.query:
        path += "?" + quote(parts.query, safe="/%:@!$&'()*+,;=~?")
    if path != "/RPC2" and not any_path:
        path = "/"
    head = (
        f"POST {path} HTTP/1.1\r\nHost: {uri_host(quote(host, safe=':%'))}:{port}\r\n"
        "Content-Type: text/xml\r\nUser-Agent: aioros1\r\nContent-Length: "
    )
    return Server(host, port, head.encode())


class HttpClient:
    """Posts documents to servers, in one event loop."""

    def __init__(self, *, max_bytes: int) -> None:
        self._max_bytes = max_bytes
        self._pools: dict[tuple[str, int], _Pool] = {}
        self._open: set[_Connection] = set()
        self._none_open = Waiters()  # woken when the last connection has ended
        self._sweeper: asyncio.TimerHandle | None = None

    async def post(
        self, server: Server, body: bytes, *, counts: bool = True, max_bytes: int | None = None
    ) -> AnswerReader:
        """Send ``body`` and return the answer, of at most ``max_bytes``. Unless it ``counts``,
        the request gets a connection even if PER_SERVER requests are in progress. Raises

        - :class:`ConnectionError` if the server cannot be reached,
        - :class:`ConnectionResetError` if the connection is lost before the answer,
        - :class:`.HttpError` if the answer is not HTTP, or too large.
        """
        pool = self._pools.get(server[:2])
        if pool is None:
            pool = self._pools[server[:2]] = _Pool()
            if self._sweeper is None:
                self._sweeper = asyncio.get_running_loop().call_later(IDLE, self._sweep)
        pool.users += 1
        try:
            async with pool.slots if counts else contextlib.nullcontext():
                answer = await self._post(pool, server, body, max_bytes or self._max_bytes)
            pool.is_python = b"Python/" in answer.server
            return answer
        finally:
            pool.users -= 1

    def losses(self, server: Server) -> int:
        """How many kept connections to ``server`` were lost since it was first asked, or asked
        after a long time."""
        pool = self._pools.get(server[:2])
        return 0 if pool is None else pool.losses

    def close_idle(self) -> None:
        """Close the connections that no request is using."""
        for pool in self._pools.values():
            pool.close_idle()

    async def close(self) -> None:
        """Close every connection. No request may be in progress."""
        if self._sweeper is not None:
            self._sweeper.cancel()
        for connection in self._open:
            connection.abort()
        with contextlib.suppress(TimeoutError):  # nobody can use them any more, at least
            await self._none_open.wait_until(
                lambda: not self._open, timeout=CLOSING, what="connections did not close"
            )

    async def _post(self, pool: _Pool, server: Server, body: bytes, max_bytes: int) -> AnswerReader:
        lost: ConnectionResetError | None = None
        if pool.is_python:
            body = with_references(body)
        answer = AnswerReader(max_bytes=max_bytes)
        connection = pool.take()
        if connection is not None:
            try:
                await connection.exchange(server.head, body, answer)
            except asyncio.CancelledError:
                # Most likely a timeout. If the network path is gone, all kept connections
                # are dead, and each would cost a timeout of its own.
                pool.close_idle()
                raise
            except ConnectionResetError as error:
                # The server may have closed the kept connection while the request was on
                # its way. Only then is it sent once more, on a new connection, because the
                # other kept ones may be just as stale.
                if answer.has_begun:
                    raise
                pool.losses += 1
                lost = error
            else:
                pool.put(connection)
                return answer
        try:
            connection = await self._connect(pool, server)
            await connection.exchange(server.head, body, answer)
        except ConnectionError as error:
            if lost is None:
                raise
            # The server may have received the first one, whatever happened to the second.
            raise ConnectionResetError(str(error)) from lost
        pool.put(connection)
        return answer

    async def _connect(self, pool: _Pool, server: Server) -> _Connection:
        try:
            _, connection = await connect(
                lambda: _Connection(self._ended, pool), server.host, server.port
            )
        except OSError as error:
            raise ConnectionError(f"cannot connect: {reason_of(error)}") from None
        # Not in connection_made(): uvloop never calls connection_lost() for a connection
        # that was cancelled at that moment, and close() would wait for it.
        if not connection.is_closing:
            self._open.add(connection)
            connection.keep_alive()
        return connection

    def _ended(self, connection: _Connection) -> None:
        self._open.discard(connection)
        if not self._open:
            self._none_open.wake()

    def _sweep(self) -> None:
        """Close connections that were idle for long, and forget servers without any."""
        loop = asyncio.get_running_loop()
        for address, pool in list(self._pools.items()):
            pool.close_idle(loop.time() - IDLE)
            if not pool.idle and not pool.users:
                del self._pools[address]
        self._sweeper = loop.call_later(IDLE, self._sweep) if self._pools else None


class _Pool:
    """The connections to one server."""

    __slots__ = ("idle", "is_python", "losses", "slots", "users")

    def __init__(self) -> None:
        self.is_python = False
        """Whether the server is Python's, by its last answer."""
        self.idle: list[_Connection] = []
        self.slots = asyncio.Semaphore(PER_SERVER)
        self.users = 0  # requests in progress or waiting for a slot
        self.losses = 0  # connections that the server, or the network, has closed

    def take(self) -> _Connection | None:
        """Take the idle connection that was used last."""
        while self.idle:
            connection = self.idle.pop()
            if connection.is_usable:
                return connection
        return None

    def put(self, connection: _Connection) -> None:
        """Keep a connection, if the server keeps it."""
        if connection.is_usable:
            connection.idle_since = asyncio.get_running_loop().time()
            self.idle.append(connection)
        else:
            connection.abort()

    def close_idle(self, since: float = math.inf) -> None:
        for connection in self.idle:
            if connection.idle_since <= since:
                connection.abort()


class _Connection(asyncio.Protocol):
    """A connection: one request and its answer after the other."""

    __slots__ = (
        "_answer",
        "_ended",
        "_failure",
        "_is_aborted",
        "_is_paused",
        "_keeps_alive",
        "_pool",
        "_transport",
        "_waiter",
        "idle_since",
    )

    _transport: asyncio.Transport

    def __init__(self, ended: Callable[[_Connection], None], pool: _Pool) -> None:
        self._ended = ended
        self._pool = pool
        self._answer: AnswerReader | None = None  # while it is not complete
        self._failure: Exception | None = None
        self._waiter: asyncio.Future[None] | None = None
        self._is_aborted = False  # by this side
        self._is_paused = False
        self._keeps_alive = False
        self.idle_since = 0.0

    @property
    def is_usable(self) -> bool:
        """Whether another request may be sent."""
        return self._keeps_alive and not self._transport.is_closing()

    @property
    def is_closing(self) -> bool:
        """Whether it is closed, or about to be."""
        return self._transport.is_closing()

    def keep_alive(self) -> None:
        """Let the system find out if the server's machine is gone, because a request may wait
        for its answer without a timeout."""
        set_keepalive(self._transport.get_extra_info("socket"), *_KEEPALIVE)

    async def exchange(self, head: bytes, body: bytes, answer: AnswerReader) -> None:
        """Send a request, and wait until ``answer`` is complete.

        If this raises, the connection is closed, so that half a request or half an answer
        never precedes another.
        """
        self._answer = answer
        self._failure = None
        self._keeps_alive = False
        try:
            is_sent = await self._send(b"%b%d\r\n\r\n" % (head, len(body)), body)
            while not self._is_over:
                await self._wait()
            if self._failure is not None:
                raise self._failure
            self._keeps_alive = is_sent and answer.keeps_alive
        except BaseException:
            self._answer = None
            self.abort()
            raise

    def abort(self) -> None:
        """Close at once."""
        self._is_aborted = True
        self._transport.abort()

    async def _send(self, head: bytes, body: bytes) -> bool:
        """Send a request; False if the server answered before it had all of the body."""
        if len(body) <= _PIECE:
            self._transport.write(head + body)
            return True
        self._transport.write(head)
        view = memoryview(body)
        for begin in range(0, len(view), _PIECE):
            while self._is_paused and not self._is_over:
                await self._wait()
            if self._is_over:
                return False
            self._transport.write(view[begin : begin + _PIECE])
        return True

    @property
    def _is_over(self) -> bool:
        return self._answer is None

    async def _wait(self) -> None:
        self._waiter = asyncio.get_running_loop().create_future()
        await self._waiter

    def _wake(self) -> None:
        if self._waiter is not None and not self._waiter.done():
            self._waiter.set_result(None)

    def _end(self, failure: Exception | None) -> None:
        if self._answer is not None:
            self._answer = None
            self._failure = failure
            self._wake()

    # what the transport calls

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        self._transport = cast("asyncio.Transport", transport)

    def connection_lost(self, exc: Exception | None) -> None:
        shut_down(self._transport)
        self._ended(self)
        if self in self._pool.idle:
            self._pool.idle.remove(self)
            if not self._is_aborted:
                self._pool.losses += 1
        self._is_paused = False
        why = "the server closed it" if exc is None else str(exc)
        if isinstance(exc, OSError):
            why = reason_of(exc)
        self._end(ConnectionResetError(f"connection lost: {why}"))

    def data_received(self, data: bytes) -> None:
        if self._answer is None:
            self.abort()  # an answer without a request; perhaps it says why it closes
            return
        try:
            if self._answer.receive_data(data):
                self._end(None)
        except HttpError as error:
            self._end(error)

    def eof_received(self) -> None:
        if self._answer is not None and self._answer.receive_eof():
            self._end(None)

    def pause_writing(self) -> None:
        self._is_paused = True

    def resume_writing(self) -> None:
        self._is_paused = False
        self._wake()
