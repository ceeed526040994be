"""An XML-RPC client for masters and nodes: one session, kept connections.

What the servers of ROS 1 demand of a client: a Content-Length, never a chunked body; a
path, ``/RPC2`` when the URI has none; and patience with answers that are no XML-RPC.
"""

from __future__ import annotations

import asyncio
from types import SimpleNamespace
from typing import Any

import aiohttp
from aiohttp.abc import AbstractStreamWriter
from yarl import URL

from aioros1.net.hosts import HostResolver
from aioros1.options import Limits, Timeouts
from aioros1.wire.xmlrpc import XmlRpcError, decode_response, encode_call

__all__ = ["XmlRpcClient"]

# Enough for a node that registers many roles at once; few enough that a server with a
# thread per connection is not flooded.
_PER_HOST = 8

_LARGE = 256 << 10

_HEADERS = {"Content-Type": "text/xml", "User-Agent": "aioros1"}


class XmlRpcClient:
    """Calls methods of XML-RPC servers. Made without a loop; connects when it is used."""

    def __init__(self, *, timeouts: Timeouts | None = None, limits: Limits | None = None) -> None:
        self._timeouts = timeouts if timeouts is not None else Timeouts()
        self._limits = limits if limits is not None else Limits()
        self._session: aiohttp.ClientSession | None = None
        self._closed = False

    async def call(self, uri: str, method: str, *params: Any, timeout: float | None = None) -> Any:
        """The answer of ``method(*params)`` at ``uri``, whatever it is.

        ``timeout`` is for the whole call, in seconds; ``Timeouts.xmlrpc`` by default. Raises

        - :class:`TimeoutError` when it is over,
        - :class:`ConnectionError` when nobody can be reached at ``uri``, and
          :class:`ConnectionResetError` when the connection is lost before the answer,
        - :class:`.XmlRpcFault` when the server answers with a fault,
        - :class:`.XmlRpcError` when what it answers is not XML-RPC, or too much,
        - :class:`TypeError`, :class:`ValueError` or :class:`OverflowError` for parameters
          that cannot be sent (see :func:`.encode_call`), before anything is sent,
        - :class:`RuntimeError` after :meth:`close`.
        """
        body = encode_call(method, params, max_depth=self._limits.xmlrpc_depth)
        url = _url(uri)
        seconds = self._timeouts.xmlrpc if timeout is None else timeout
        try:
            async with asyncio.timeout(seconds):
                answer = await self._exchange(url, body, f"{method} at {uri}")
        except TimeoutError:
            raise TimeoutError(f"{method} at {uri}: no answer within {seconds:g} s") from None
        try:
            return decode_response(answer, max_depth=self._limits.xmlrpc_depth)
        except XmlRpcError as error:
            raise XmlRpcError(f"{method} at {uri}: {error}") from None

    async def close(self) -> None:
        """Close every connection. Calls in progress fail with :class:`ConnectionError`."""
        self._closed = True
        session, self._session = self._session, None
        if session is not None:
            await session.close()

    async def _exchange(self, url: URL, body: bytes, what: str) -> bytes:
        if self._closed:
            raise RuntimeError("the XML-RPC client is closed")
        if self._session is None:
            self._session = _new_session()
        attempt = _Attempt()
        try:
            return await self._post(self._session, url, body, what, attempt)
        except ConnectionError as error:
            lost = error
            # Perhaps the server closed the kept connection while the request was on its
            # way. Then, and only then, it is sent once more, on a connection that is
            # certainly new: the others that are kept may be as stale.
            if not attempt.reused or self._closed:
                raise
        async with _new_session() as fresh:
            try:
                return await self._post(fresh, url, body, what, attempt)
            except ConnectionError as error:
                # It may have been received the first time, whatever happened now.
                raise ConnectionResetError(str(error)) from lost

    async def _post(
        self, session: aiohttp.ClientSession, url: URL, body: bytes, what: str, attempt: _Attempt
    ) -> bytes:
        try:
            data = body if len(body) <= _LARGE else _LargeBody(body)
            async with session.post(
                url, data=data, allow_redirects=False, trace_request_ctx=attempt
            ) as response:
                attempt.reused = False  # what is lost from here on is not sent again
                return await self._read(response, what)
        except aiohttp.ClientConnectorError as error:
            raise ConnectionError(f"{what}: cannot connect: {_cause(error.os_error)}") from error
        except aiohttp.ClientResponseError as error:
            raise XmlRpcError(f"{what}: not an HTTP answer: {error.message}") from error
        except (aiohttp.ClientError, OSError) as error:
            raise ConnectionResetError(f"{what}: connection lost: {_cause(error)}") from error

    async def _read(self, response: aiohttp.ClientResponse, what: str) -> bytes:
        if response.status != 200:
            raise XmlRpcError(f"{what}: HTTP status {response.status} {response.reason or ''}")
        limit = self._limits.xmlrpc_bytes
        size = 0
        chunks: list[bytes] = []
        if (response.content_length or 0) <= limit:
            while chunk := await response.content.readany():
                size += len(chunk)
                if size > limit:
                    break
                chunks.append(chunk)
            else:
                return b"".join(chunks)
        response.close()
        raise XmlRpcError(f"{what}: an answer of more than {limit} bytes")


def _new_session() -> aiohttp.ClientSession:
    trace = aiohttp.TraceConfig()
    trace.on_connection_reuseconn.append(_note_reuse)
    return aiohttp.ClientSession(
        connector=aiohttp.TCPConnector(
            limit=0, limit_per_host=_PER_HOST, resolver=HostResolver(), ttl_dns_cache=10
        ),
        # One timeout around everything is ours; see call().
        timeout=aiohttp.ClientTimeout(total=None, sock_connect=None),
        cookie_jar=aiohttp.DummyCookieJar(),
        headers=_HEADERS,
        # Compressed answers save nothing worth their time, and would have to be bounded
        # once more while they are inflated.
        skip_auto_headers=("Accept", "Accept-Encoding"),
        auto_decompress=False,
        trust_env=False,
        trace_configs=[trace],
    )


class _LargeBody(aiohttp.Payload):
    """A body that is sent piece by piece; aiohttp warns of large ones in one piece."""

    _value: bytes

    def __init__(self, value: bytes) -> None:
        super().__init__(value, content_type=_HEADERS["Content-Type"])
        self._size = len(value)

    def decode(self, encoding: str = "utf-8", errors: str = "strict") -> str:
        return self._value.decode(encoding, errors)

    async def write(self, writer: AbstractStreamWriter) -> None:
        view = memoryview(self._value)
        for begin in range(0, len(view), _LARGE):
            await writer.write(view[begin : begin + _LARGE])


class _Attempt:
    """One call's way through the connection pool."""

    __slots__ = ("reused",)

    def __init__(self) -> None:
        self.reused = False


async def _note_reuse(
    session: aiohttp.ClientSession,
    context: SimpleNamespace,
    params: aiohttp.TraceConnectionReuseconnParams,
) -> None:
    context.trace_request_ctx.reused = True


def _url(uri: str) -> URL:
    try:
        url = URL(uri)
        if url.scheme == "http" and url.host and url.port:
            # As Python's own client does: no path means /RPC2.
            return url if url.raw_path != "/" or uri.endswith("/") else url.with_path("/RPC2")
    except ValueError:
        pass
    raise ConnectionError(f"{uri!r} is not the URI of a ROS node or master (http://host:port/)")


def _cause(error: BaseException) -> str:
    return str(error) or type(error).__name__
