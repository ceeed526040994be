"""An XML-RPC server: the slave API of a node, and the master.

It runs on aiohttp's low-level HTTP server. Keep-alive matters: rospy, rosmaster and our own
client send one request after the other over the same connection.
"""

from __future__ import annotations

import asyncio
import contextlib
import inspect
import logging
import zlib
from collections.abc import Awaitable, Callable, Generator, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

from aiohttp import web

from aioros1.net.accepting import ListeningSocket
from aioros1.net.admission import Admission
from aioros1.net.allow import AllowList
from aioros1.net.budget import FREE, Budget, Share
from aioros1.net.hosts import bind_sockets
from aioros1.net.loop_state import loop_state
from aioros1.net.rate_limit import RateLimit
from aioros1.net.turns import Turn
from aioros1.options import Limits
from aioros1.waiting import Mutex, Waiters
from aioros1.wire.carriage_returns import with_references
from aioros1.wire.xmlrpc import (
    PIECE,
    XmlRpcError,
    XmlRpcFault,
    decode_call,
    decoding_call,
    encode_fault,
    response_pieces,
)
from aioros1.wire.xmlrpc_scalars import brief
from aioros1.wire.xmlrpc_size import Size
from aioros1.xmlrpc.server_http import Answer, Connection, LongDocument, Quiet, plain

__all__ = ["Method", "Reply", "XmlRpcServer"]

Method = Callable[..., Any]
"""Called with the parameters of a request; returns the value to answer with, a
:class:`Reply`, or an awaitable of either."""

KEEP_ALIVE = 3600.0
"""Seconds before an idle connection is closed.

This is long, because a client that sends a request just when the server closes gets a reset
and cannot know whether the request was executed; the servers of ROS 1 never close first. It
is not infinite, because peers can vanish without closing.
"""

CLOSING = 5.0
"""Seconds in which event loops must have told the end of connections that were aborted."""

# The codes of faults are those of the "Specification for Fault Code Interoperability".
FAULT_PARSE = -32700
FAULT_NO_METHOD = -32601
FAULT_PARAMS = -32602
FAULT_APPLICATION = -32500

_LOG = logging.getLogger("aioros1.xmlrpc")

_Afters = list[Callable[[], object]]

# Bytes of gzip data that are unpacked at a time.
_INFLATED = 64 << 10


@dataclass(frozen=True, slots=True)
class Reply:
    """An answer with a consequence: ``after``, a plain function, is called once ``value``
    has been sent, or when the client turns out to be gone."""

    value: Any
    after: Callable[[], object]


class XmlRpcServer:
    """Serves ``methods`` by name, and ``system.multicall`` over them.

    Only methods of the mapping can be called. A request with the wrong number of parameters
    is answered with ``[-1, text, 0]``, as by the programs of ROS 1. An exception that a
    method raises is logged and answered with a fault.
    """

    def __init__(
        self,
        methods: Mapping[str, Method],
        *,
        limits: Limits | None = None,
        allow: AllowList | None = None,
        log: logging.Logger | logging.LoggerAdapter[Any] | None = None,
    ) -> None:
        self._methods = {name: (method, *_arity(method)) for name, method in methods.items()}
        self._limits = limits = limits if limits is not None else Limits()
        self._log = log if log is not None else _LOG
        self.admission = Admission(
            "the XML-RPC port",
            allow=allow,
            total=("xmlrpc_connections", limits.xmlrpc_connections),
            per_host=limits.connections_per_host,
            log=self._log,
        )
        self._rate: RateLimit | None = None
        if limits.requests_per_second is not None:
            self._rate = RateLimit(limits.requests_per_second, limits.requests_burst)
        self.budget = Budget(limits.bytes_in_flight)
        """What requests that arrive and answers that are not read hold together."""
        # Values take several times as much memory as their document while it is read, so one
        # large one is read at a time.
        self._reading = Mutex()
        self.delayed = 0
        """Requests that had to wait so far, because their host had sent too many."""
        self._http: web.Server | None = None
        self._listeners: list[ListeningSocket] = []
        self._connections: set[Connection] = set()
        self._connection_ended = Waiters()
        # The requests in progress, and the connections that have had one.
        self._running: set[asyncio.Task[Any]] = set()
        self._serving: set[asyncio.Task[Any]] = set()
        self._waiting: set[asyncio.Task[Any]] = set()
        self._sweeper: asyncio.TimerHandle | None = None
        self._port = 0

    @property
    def port(self) -> int:
        """The TCP port; 0 before the start."""
        return self._port

    async def start(self, host: str = "0.0.0.0", port: int = 0) -> None:
        """Listen on the numeric address ``host``; see :func:`.hosts.bind_sockets`.

        Raises :class:`OSError` if the address or the port is not available.
        """
        if self._http is not None:
            raise RuntimeError("the server was started before")
        loop = asyncio.get_running_loop()
        sockets = bind_sockets(host, port)
        self._port = int(sockets[0].getsockname()[1])
        self._http = http = web.Server(self._handle)
        self._sweep()
        quiet: Any = Quiet(self._log)

        def connection(host: str) -> Connection:
            return Connection(
                self._connections,
                self._connection_ended,
                self.admission,
                host,
                http,
                loop=loop,
                keepalive_timeout=KEEP_ALIVE,
                lingering_time=1.0,
                access_log=None,
                auto_decompress=False,
                logger=quiet,
            )

        self._listeners = [
            ListeningSocket(sock, connection, admission=self.admission, log=self._log)
            for sock in sockets
        ]

    async def close(self, *, timeout: float = 1.0) -> None:
        """Stop listening, give requests in progress ``timeout`` seconds to finish, and close
        every connection. A method must not call this, because it would wait for itself."""
        if asyncio.current_task() in self._running:
            raise RuntimeError("a method cannot close its own server: use Reply(after=...)")
        listeners, self._listeners = self._listeners, []
        for listener in listeners:
            listener.close()
        http = self._http
        if http is None:
            return
        if self._sweeper is not None:
            self._sweeper.cancel()
        for listener in listeners:
            await listener.wait_closed()
        http.pre_shutdown()
        # aiohttp loses track of the tasks of a connection whose peer has gone, so they are
        # ended here.
        await _cancel(self._waiting)  # their requests have not begun
        if self._running:
            await asyncio.wait(self._running, timeout=timeout)
        await _cancel(self._running)
        await http.shutdown(0.1)
        for connection in list(self._connections):
            connection.abort()
        await _cancel(self._serving)
        # A transport tells its protocol of the end in a later iteration of the loop.
        with contextlib.suppress(TimeoutError):
            await self._connection_ended.wait_until(
                lambda: not self._connections, timeout=CLOSING, what="connections did not close"
            )

    def _sweep(self) -> None:
        """Close connections whose request head is late. One timer serves them all."""
        loop = asyncio.get_running_loop()
        patience = self._limits.xmlrpc_timeout
        for connection in list(self._connections):
            connection.close_if_late(loop.time() - patience)
        self._sweeper = loop.call_later(patience / 4, self._sweep)

    # ------------------------------------------------------------------ one request

    async def _handle(self, request: web.BaseRequest) -> web.StreamResponse:
        connection = request.protocol
        task = asyncio.current_task()
        assert isinstance(connection, Connection)
        assert task is not None
        self._running.add(task)
        connection.request_begins(request.content)
        if request.task not in self._serving:
            self._serving.add(request.task)
            request.task.add_done_callback(self._serving.discard)
        try:
            if self._rate is not None:
                await self._take_turn(self._rate, connection, task)
            refusal = self._refuse(request)
            if refusal is not None:
                return refusal
            share = self.budget.share(partial(_cut, connection, task))
            try:
                return await self._serve(request, connection, share)
            except asyncio.CancelledError:
                if not share.is_cut or task.uncancel():
                    raise
                raise ConnectionResetError("it held too much for too long") from None
            finally:
                share.close()
        finally:
            connection.request_ends()
            self._running.discard(task)

    async def _serve(
        self, request: web.BaseRequest, connection: Connection, share: Share
    ) -> web.StreamResponse:
        content = request.content
        if content.is_eof() and "Content-Encoding" not in request.headers:
            body = [content.read_nowait()]  # it is all there already
        else:
            try:
                async with asyncio.timeout(self._limits.xmlrpc_timeout):
                    read = await self._read(request, share)
            except TimeoutError:
                return plain(408, "the request did not arrive in time", close=True)
            if isinstance(read, web.Response):
                return read
            body = read
        turn = await loop_state().turns.take()
        try:
            return await self._answer(request, connection.host, body, share, turn)
        finally:
            turn.end()

    async def _take_turn(
        self, rate: RateLimit, connection: Connection, task: asyncio.Task[Any]
    ) -> None:
        """Wait if the host has sent too many requests. Meanwhile no more is read from the
        connection than fits into its buffers.

        Raises :class:`ConnectionResetError` if the peer closes the connection, so that a host
        never has more requests waiting than connections.
        """
        host = connection.host
        delay = rate.take(host, asyncio.get_running_loop().time())
        if not delay:
            return
        self.delayed += 1
        self._waiting.add(task)
        try:
            if await connection.is_gone_after(delay):
                rate.give_back(host)
                raise ConnectionResetError("the client has gone")
        finally:
            self._waiting.discard(task)

    def _refuse(self, request: web.BaseRequest) -> web.Response | None:
        headers = request.headers
        if request.method != "POST":
            return plain(405, "XML-RPC is sent with POST", {"Allow": "POST"})
        if "Origin" in headers:
            # From a web page in somebody's browser. The page could not read the answer, but
            # it would not have to in order to shut a node down.
            return plain(403, "XML-RPC is not for web pages", close=True)
        if "Transfer-Encoding" in headers:
            return None
        length = headers.get("Content-Length")
        if length is None:
            return plain(411, "a Content-Length is needed", close=True)
        if int(length) > self._limits.xmlrpc_bytes:
            return self._too_large()
        return None

    def _too_large(self) -> web.Response:
        return plain(413, f"more than {self._limits.xmlrpc_bytes} bytes", close=True)

    async def _read(self, request: web.BaseRequest, share: Share) -> list[bytes] | web.Response:
        """Return the body, decompressed if needed, or the answer that refuses it."""
        if request.headers.get("Expect", "").lower() == "100-continue":
            await request.writer.write(b"HTTP/1.1 100 Continue\r\n\r\n")
            request.writer.output_size = 0
        coding = request.headers.get("Content-Encoding", "identity").strip().lower()
        if coding not in ("", "identity", "gzip", "x-gzip"):
            return plain(415, f"unknown Content-Encoding: {coding[:80]}", close=True)
        is_zipped = coding.endswith("gzip")
        inflate = zlib.decompressobj(wbits=31)
        limit = self._limits.xmlrpc_bytes
        size = 0
        chunks: list[bytes] = []
        content = request.content
        while came := await content.readany():
            for chunk in _inflated(inflate, came) if is_zipped else (came,):
                if chunk is None:
                    return plain(400, "not gzip, or more than that", close=True)
                size += len(chunk)
                if size > limit:
                    return self._too_large()
                share.grow_to(size)
                if share.is_cut:
                    raise ConnectionResetError("it held too much for too long")
                chunks.append(chunk)
                if is_zipped:
                    await asyncio.sleep(0)
        if is_zipped and not inflate.eof:
            return plain(400, "the gzip data ends early", close=True)
        return chunks

    # ------------------------------------------------------------------ one call

    async def _answer(
        self,
        request: web.BaseRequest,
        host: str,
        body: list[bytes],
        share: Share,
        turn: Turn,
    ) -> web.StreamResponse:
        afters: _Afters = []
        try:
            name, params = await self._decode(body, turn)
        except XmlRpcError as error:
            return await self._send(request, encode_fault(FAULT_PARSE, str(error)), afters)
        try:
            if name == "system.multicall":
                if self._rate is not None and host and params and isinstance(params[0], list):
                    # Each call in it is a request; one of them was counted before.
                    now = asyncio.get_running_loop().time()
                    self._rate.take(host, now, max(len(params[0]) - 1, 0))
                value: Any = await self._multicall(params, afters, turn)
            else:
                value = await self._call(name, params, afters, turn)
            body.clear()
            pieces = self._pieces(request, value)
            document = next(pieces)
            more = next(pieces, None)
            if more is None:
                share.grow_to(len(document))
                return await self._send(request, document, afters)
            # Count first, then write while the peer reads: what a peer does not read takes no
            # memory. What a method returns does not change.
            length = len(document) + len(more) + await turn.run(_lengths(pieces))
            pieces = self._pieces(request, value)
            # Nobody else may hold the value any more.
            share.grow_to(length)
            return await self._send(request, LongDocument(length, pieces, turn), afters)
        except XmlRpcFault as fault:
            return await self._send(request, encode_fault(fault.code, fault.text), afters)
        except (TypeError, ValueError, OverflowError) as error:
            self._log.error("the result of %s cannot be sent: %s", brief(name), error)
            fault_text = f"{brief(name)}: {error}"
            return await self._send(request, encode_fault(FAULT_APPLICATION, fault_text), afters)

    def _pieces(self, request: web.BaseRequest, value: Any) -> Iterator[bytes]:
        """The answer with ``value``, in pieces."""
        pieces = response_pieces(value, max_depth=self._limits.xmlrpc_depth)
        return map(with_references, pieces) if _is_python(request) else pieces

    async def _send(
        self, request: web.BaseRequest, document: bytes | LongDocument, afters: _Afters
    ) -> Answer:
        answer = Answer(document, patience=self._limits.xmlrpc_timeout, flush=bool(afters))
        if not afters and isinstance(document, bytes) and len(document) <= FREE:
            return answer
        try:
            await answer.prepare(request)
        finally:
            for after in afters:
                try:
                    after()
                except Exception:
                    self._log.exception("a consequence of an XML-RPC request failed")
        return answer

    async def _decode(self, body: list[bytes], turn: Turn) -> tuple[str, tuple[Any, ...]]:
        """Raises :class:`.XmlRpcError`, and leaves nothing of a large ``body``."""
        depth, values = self._limits.xmlrpc_depth, self._limits.xmlrpc_values
        if len(body) == 1 and len(body[0]) <= PIECE:
            return decode_call(body[0], max_depth=depth, max_values=values)
        if self._reading.is_held:
            turn.end()
        async with self._reading:
            await turn.next()
            return await turn.run(decoding_call(body, max_depth=depth, max_values=values))

    async def _call(self, name: str, params: tuple[Any, ...], afters: _Afters, turn: Turn) -> Any:
        """Return what the method returned. Raises only :class:`XmlRpcFault`."""
        entry = self._methods.get(name)
        if entry is None:
            raise XmlRpcFault(FAULT_NO_METHOD, f'method "{name[:200]}" is not supported')
        method, least, most = entry
        if not least <= len(params) <= most:
            if not params:
                return [-1, "missing required caller_id parameter", 0]
            return [-1, f"Error: bad call arity: {name} takes {_range(least, most)} parameters", 0]
        try:
            value = method(*params)
            if isinstance(value, Awaitable):
                value = await value
                turn.resume()
        except XmlRpcFault:
            raise
        except Exception as error:
            self._log.exception("XML-RPC method %s failed", name)
            raise XmlRpcFault(FAULT_APPLICATION, f"{type(error).__name__}: {error}") from error
        if isinstance(value, Reply):
            afters.append(value.after)
            return value.value
        return value

    async def _multicall(self, params: tuple[Any, ...], afters: _Afters, turn: Turn) -> list[Any]:
        """Many calls in one request; each has its own result or fault.

        The results have to fit an answer together, as those of a single call.
        """
        if len(params) != 1 or not isinstance(params[0], list):
            raise XmlRpcFault(FAULT_PARAMS, "system.multicall takes one array")
        limits = self._limits
        results: list[Any] = []
        too_large = XmlRpcFault(FAULT_APPLICATION, "the answer would be too large")
        size = Size()
        for call in params[0]:
            try:
                if size.exceeds(limits.xmlrpc_bytes, limits.xmlrpc_values):
                    raise too_large
                result = await self._call(*_multicall_entry(call), afters, turn)
                await turn.run(size.adding(result))
                if size.exceeds(limits.xmlrpc_bytes, limits.xmlrpc_values):
                    raise too_large
                results.append([result])
            except XmlRpcFault as fault:
                results.append({"faultCode": fault.code, "faultString": fault.text})
            if turn.is_over:
                await turn.next()
        return results


def _is_python(request: web.BaseRequest) -> bool:
    """Whether the client is Python's, as that of rospy and of the tools is."""
    return request.headers.get("User-Agent", "").startswith(("Python-xmlrpc/", "xmlrpclib.py/"))


def _cut(connection: Connection, task: asyncio.Task[Any]) -> None:
    connection.abort()
    task.cancel()


def _inflated(inflate: Any, data: bytes) -> Iterator[bytes | None]:
    """Unpack ``data`` in small pieces; None if that is not possible, or if it is the last."""
    try:
        while data:
            if inflate.eof:
                yield None  # whatever comes behind the end
                return
            piece = inflate.decompress(data, _INFLATED)
            data = inflate.unconsumed_tail or inflate.unused_data
            yield piece
    except zlib.error:
        yield None


def _lengths(pieces: Iterator[bytes]) -> Generator[None, None, int]:
    length = 0
    for piece in pieces:
        length += len(piece)
        yield
    return length


async def _cancel(tasks: set[asyncio.Task[Any]]) -> None:
    ended = list(tasks)
    for task in ended:
        task.cancel()
    if ended:
        await asyncio.wait(ended)


def _multicall_entry(call: Any) -> tuple[str, tuple[Any, ...]]:
    if not isinstance(call, dict):
        raise XmlRpcFault(FAULT_PARAMS, "an entry of system.multicall is a struct")
    name, params = call.get("methodName"), call.get("params")
    if not isinstance(name, str) or not isinstance(params, list):
        raise XmlRpcFault(FAULT_PARAMS, "an entry of system.multicall has methodName and params")
    if name == "system.multicall":
        raise XmlRpcFault(FAULT_PARAMS, "system.multicall inside system.multicall")
    return name, tuple(params)


def _arity(method: Method) -> tuple[int, float]:
    """Return the least and the greatest number of positional arguments of ``method``."""
    least, most = 0, 0.0
    for parameter in inspect.signature(method).parameters.values():
        if parameter.kind is parameter.VAR_POSITIONAL:
            most = float("inf")
        elif parameter.kind in (parameter.POSITIONAL_ONLY, parameter.POSITIONAL_OR_KEYWORD):
            most += 1
            least += parameter.default is parameter.empty
    return least, most


def _range(least: int, most: float) -> str:
    return f"{least}" if least == most else f"{least} to {most:g}"
