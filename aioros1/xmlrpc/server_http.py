"""What the XML-RPC server needs beyond aiohttp's low-level HTTP server.

It needs a limit on how long the head of a request may take, and cheaper answers: a master
answers thousands of small requests a second, and of the 107 µs for each, 35 went into a
general HTTP response and into timers that hardly ever expire.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from aiohttp import web

from aioros1.net.ending import shut_down
from aioros1.wire.http_heads import MAX_HEAD, Heads

if TYPE_CHECKING:
    from collections.abc import Iterator

    from aiohttp import StreamReader
    from aiohttp.abc import AbstractStreamWriter
    from aiohttp.typedefs import LooseHeaders

    from aioros1.net.admission import Admission
    from aioros1.net.turns import Turn
    from aioros1.waiting import Waiters

__all__ = ["Answer", "Connection", "LongDocument", "Quiet", "plain"]

MAX_LINE = 32 << 10
"""The most bytes of a line of a head; aiohttp's own limit is 8,190, and the reference's 65,536.
All of a head has at most :data:`.MAX_HEAD`."""

# Bytes that a transport may buffer, of one answer or of many, before the writer waits.
_SMALL = 48 << 10


# Bytes of a long document that are written at a time.
_BLOCK = 64 << 10


@dataclass(frozen=True, slots=True)
class LongDocument:
    """A document that is made while it is written."""

    length: int
    """All its bytes."""
    pieces: Iterator[bytes]
    turn: Turn
    """Of the request that it answers."""


class Answer(web.StreamResponse):
    """A ``200 OK`` with an XML document, written by hand, and at once unless it is long.

    ``patience`` is how many seconds the peer may read nothing; aiohttp would wait forever
    for a peer that requests megabytes and reads nothing. With ``flush``, the kernel has every
    byte of the answer when :meth:`prepare` returns.
    """

    def __init__(
        self, document: bytes | LongDocument, *, patience: float, flush: bool = False
    ) -> None:
        super().__init__()
        self._document = document
        self._patience = patience
        self._flush = flush
        self._sent = False
        self._keep = False

    @property
    def keep_alive(self) -> bool:
        """Whether the connection serves another request."""
        return self._keep

    async def prepare(self, request: web.BaseRequest) -> AbstractStreamWriter | None:
        if self._sent:
            return None
        self._sent = True
        transport = request.transport
        if transport is None:
            raise ConnectionResetError("the client has gone")
        self._keep = keep = request.keep_alive
        document = self._document
        transport.write(
            b"HTTP/1.1 200 OK\r\nContent-Type: text/xml\r\nContent-Length: %d\r\n%s\r\n%s"
            % (
                document.length if isinstance(document, LongDocument) else len(document),
                b"" if keep else b"Connection: close\r\n",
                b"" if isinstance(document, LongDocument) else document,
            )
        )
        if isinstance(document, LongDocument):
            await self._write_long(document, request, transport)
        if self._flush:
            # From now on drain() waits until the kernel has taken every byte.
            transport.set_write_buffer_limits(high=0)
        if self._flush or transport.get_write_buffer_size() > _SMALL:
            await self._drain(request, transport)
        return None

    async def _write_long(
        self, document: LongDocument, request: web.BaseRequest, transport: asyncio.Transport
    ) -> None:
        turn = document.turn
        block: list[bytes] = []
        size = 0
        for piece in document.pieces:
            block.append(piece)
            size += len(piece)
            if size >= _BLOCK:
                transport.write(b"".join(block))
                block.clear()
                size = 0
                if transport.get_write_buffer_size() > _SMALL:
                    await self._drain(request, transport)
                    turn.resume()
            if turn.is_over:
                await turn.next()
        transport.write(b"".join(block))

    async def _drain(self, request: web.BaseRequest, transport: asyncio.Transport) -> None:
        try:
            async with asyncio.timeout(self._patience):
                await request.writer.drain()
        except TimeoutError:
            transport.abort()
            raise ConnectionResetError("the client reads no answer") from None

    async def write_eof(self, data: bytes = b"") -> None:
        """Everything was written by :meth:`prepare`."""


def plain(
    status: int, text: str, headers: LooseHeaders | None = None, *, close: bool = False
) -> web.Response:
    """Make an answer that refuses a request, in one line of text."""
    response = web.Response(status=status, text=text + "\n", headers=headers)
    if close:
        response.force_close()
    return response


class Connection(web.RequestHandler):
    """aiohttp's connection, which also limits how long the head of a request may take.

    aiohttp waits for the rest of a request line as long as for the next request.
    ``connections`` holds those that are open, and ``ended`` wakes whoever waits for the end
    of one. ``admission`` has let it in as ``host``. A client that closes its side behind its
    last request gets the answer all the same.
    """

    __slots__ = (
        "_admission",
        "_answered",
        "_busy",
        "_connection",
        "_connections",
        "_content",
        "_ended",
        "_gone",
        "_head_bytes",
        "_heads",
        "_is_half_closed",
        "_waits_since",
        "host",
    )

    def __init__(
        self,
        connections: set[Connection],
        ended: Waiters,
        admission: Admission,
        host: str,
        manager: web.Server,
        **options: Any,
    ) -> None:
        super().__init__(manager, max_line_size=MAX_LINE, max_field_size=MAX_LINE, **options)
        self._connections = connections
        self._ended = ended
        self._admission = admission
        self.host = host
        """The host it comes from, as ``admission`` has named it."""
        self._connection: asyncio.BaseTransport | None = None  # aiohttp forgets it early
        self._gone: asyncio.Future[bool] | None = None
        self._busy = False
        self._content: StreamReader | None = None  # of the request in progress
        self._waits_since: float | None = None
        self._heads: Heads | None = Heads()  # until the first head turns out to be in order
        self._head_bytes = 0  # of a head that is not complete
        self._answered = 0
        self._is_half_closed = False

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        self._connection = transport
        self._connections.add(self)
        super().connection_made(transport)

    def connection_lost(self, exc: BaseException | None) -> None:
        shut_down(self._connection)
        self._connection = None
        super().connection_lost(exc)
        self._connections.discard(self)
        self._ended.wake()
        self._admission.leave(self.host)
        if self._gone is not None and not self._gone.done():
            self._gone.set_result(True)

    def data_received(self, data: bytes) -> None:
        if self._heads is not None:
            data = self._heads.feed(data)
            if self._heads.is_plain:
                self._heads = None
        super().data_received(data)
        if not self._busy and self._waits_since is None:
            self._waits_since = self._loop.time()
        if self._has_answered:
            self._head_bytes += len(data)
            if self._head_bytes > MAX_HEAD:
                self._refuse(b"431 Request Header Fields Too Large")

    def eof_received(self) -> bool:  # type: ignore[override] # asyncio allows it
        """The client sends no more: stay open for the answers that it still waits for."""
        if self._gone is not None and not self._gone.done():
            self._gone.set_result(True)
            return False
        self._is_half_closed = True
        if self._content is not None and not self._content.is_eof():
            return False  # the rest of the request never comes
        return not self._has_answered

    @property
    def _has_answered(self) -> bool:
        """Whether every request that has come has its answer."""
        return self._answered >= self._request_count

    def request_begins(self, content: StreamReader) -> None:
        """The head of a request is complete."""
        self._busy = True
        self._waits_since = None
        self._head_bytes = 0
        self._content = content
        if self._is_half_closed and not content.is_eof():
            self.force_close()  # the rest never comes

    def request_ends(self) -> None:
        """The request has been answered, or is about to be."""
        self._busy = False
        self._content = None
        self._answered += 1
        if self._is_half_closed and self._has_answered:
            self.close()  # behind the answer

    async def is_gone_after(self, seconds: float) -> bool:
        """Wait ``seconds``, or until the peer has gone; whether it has."""
        if self.transport is None:
            return True
        gone: asyncio.Future[bool] = self._loop.create_future()
        self._gone = gone
        timer = self._loop.call_later(seconds, _settle, gone)
        try:
            return await gone
        finally:
            timer.cancel()
            self._gone = None

    def close_if_late(self, deadline: float) -> None:
        """Close the connection if a head that began before ``deadline`` is still incomplete."""
        if self._waits_since is None or self._waits_since > deadline:
            return
        self._waits_since = None
        self._refuse(b"408 Request Timeout")

    def _refuse(self, status: bytes) -> None:
        """Answer half a head, and close."""
        if self.transport is not None:
            self.transport.write(
                b"HTTP/1.1 %s\r\nContent-Length: 0\r\nConnection: close\r\n\r\n" % status
            )
        self.force_close()

    def abort(self) -> None:
        """Close at once; what was not sent is lost."""
        if self.transport is not None:
            self.transport.abort()


def _settle(future: asyncio.Future[bool]) -> None:
    if not future.done():
        future.set_result(False)


class Quiet(logging.LoggerAdapter[Any]):
    """Logs what aiohttp calls exceptions for debugging only: peers that sent garbage or went."""

    def __init__(self, log: logging.Logger | logging.LoggerAdapter[Any]) -> None:
        super().__init__(log, {})

    def exception(self, msg: object, *args: object, **kwargs: Any) -> None:
        with contextlib.suppress(Exception):
            self.debug(msg, *args, **kwargs)
