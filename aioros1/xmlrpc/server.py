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
from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass
from typing import Any

from aiohttp import web

from aioros1.net.admission import Admission
from aioros1.net.allow import AllowList
from aioros1.net.hosts import bind_sockets
from aioros1.net.rate_limit import RateLimit
from aioros1.options import Limits
from aioros1.waiting import Waiters
from aioros1.wire.xmlrpc import (
    XmlRpcError,
    XmlRpcFault,
    decode_call,
    encode_fault,
    encode_response,
)
from aioros1.xmlrpc.server_http import Answer, Connection, Quiet, plain

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
_YIELD_EVERY = 32

_ACCEPTING = 3
"""Iterations of the event loop until an accepted connection has its protocol, at most: the
task of asyncio that makes the transport, and a callback of that."""


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
        self.delayed = 0
        """Requests that had to wait so far, because their host had sent too many."""
        self._http: web.Server | None = None
        self._listeners: list[asyncio.Server] = []
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

        def connection() -> Connection:
            return Connection(
                self._connections,
                self._connection_ended,
                self.admission,
                http,
                loop=loop,
                keepalive_timeout=KEEP_ALIVE,
                lingering_time=1.0,
                access_log=None,
                auto_decompress=False,
                logger=quiet,
            )

        try:
            for sock in sockets:
                # Not in one step with serving, which lets other tasks run: if this one was
                # cancelled then, nobody would have the server to close it.
                listener = await loop.create_server(
                    connection, sock=sock, backlog=512, start_serving=False
                )
                self._listeners.append(listener)
                await listener.start_serving()
        except BaseException:
            await self.close()
            for sock in sockets:
                sock.close()
            raise

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
        # asyncio tells a protocol of a connection it has just accepted some iterations of the
        # event loop later. Until then nobody could close that connection.
        for _ in range(_ACCEPTING):
            await asyncio.sleep(0)
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
            content = request.content
            if content.is_eof() and "Content-Encoding" not in request.headers:
                body: bytes | web.Response = content.read_nowait()  # it is all there already
            else:
                try:
                    async with asyncio.timeout(self._limits.xmlrpc_timeout):
                        body = await self._read(request)
                except TimeoutError:
                    return plain(408, "the request did not arrive in time", close=True)
            if not isinstance(body, bytes):
                return body
            document, afters = await self._answer(body, connection.host)
            return await self._send(request, document, afters)
        finally:
            connection.request_ends()
            self._running.discard(task)

    async def _take_turn(
        self, rate: RateLimit, connection: Connection, task: asyncio.Task[Any]
    ) -> None:
        """Wait if the host has sent too many requests. Meanwhile no more is read from the
        connection than fits into its buffers.

        Raises :class:`ConnectionResetError` if the peer closes the connection, so that a host
        never has more requests waiting than connections.
        """
        host = connection.host
        assert host is not None
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

    async def _read(self, request: web.BaseRequest) -> bytes | web.Response:
        """Return the body, decompressed if needed, or the answer that refuses it."""
        if request.headers.get("Expect", "").lower() == "100-continue":
            await request.writer.write(b"HTTP/1.1 100 Continue\r\n\r\n")
            request.writer.output_size = 0
        coding = request.headers.get("Content-Encoding", "identity").strip().lower()
        if coding not in ("", "identity", "gzip", "x-gzip"):
            return plain(415, f"unknown Content-Encoding: {coding}", close=True)
        inflate = zlib.decompressobj(wbits=31) if coding.endswith("gzip") else None
        room = self._limits.xmlrpc_bytes
        chunks: list[bytes] = []
        content = request.content
        while chunk := await content.readany():
            if inflate is not None:
                try:
                    chunk = inflate.decompress(chunk, room + 1)  # no more, whatever it expands to
                except zlib.error as error:
                    return plain(400, f"not gzip: {error}", close=True)
            room -= len(chunk)
            if room < 0:
                return self._too_large()
            chunks.append(chunk)
        if inflate is not None and not inflate.eof:
            return plain(400, "the gzip data ends early", close=True)
        return chunks[0] if len(chunks) == 1 else b"".join(chunks)

    async def _send(
        self, request: web.BaseRequest, document: bytes, afters: list[Callable[[], object]]
    ) -> Answer:
        answer = Answer(document, patience=self._limits.xmlrpc_timeout, flush=bool(afters))
        if not afters:
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

    # ------------------------------------------------------------------ one call

    async def _answer(
        self, body: bytes, host: str | None
    ) -> tuple[bytes, list[Callable[[], object]]]:
        afters: list[Callable[[], object]] = []
        limits = self._limits
        try:
            name, params = decode_call(
                body, max_depth=limits.xmlrpc_depth, max_values=limits.xmlrpc_values
            )
        except XmlRpcError as error:
            return encode_fault(FAULT_PARSE, str(error)), afters
        try:
            if name == "system.multicall":
                if self._rate is not None and host and params and isinstance(params[0], list):
                    # Each call in it is a request; one of them was counted before.
                    now = asyncio.get_running_loop().time()
                    self._rate.take(host, now, max(len(params[0]) - 1, 0))
                value = await self._multicall(params, afters)
            else:
                value = await self._call(name, params, afters)
            return encode_response(value, max_depth=limits.xmlrpc_depth), afters
        except XmlRpcFault as fault:
            return encode_fault(fault.code, fault.text), afters
        except (TypeError, ValueError, OverflowError) as error:
            self._log.error("the result of %s cannot be sent: %s", name, error)
            return encode_fault(FAULT_APPLICATION, f"{name}: {error}"), afters

    async def _call(
        self, name: str, params: tuple[Any, ...], afters: list[Callable[[], object]]
    ) -> Any:
        """Return what the method returned. Raises only :class:`XmlRpcFault`."""
        entry = self._methods.get(name)
        if entry is None:
            raise XmlRpcFault(FAULT_NO_METHOD, f'method "{name}" is not supported')
        method, least, most = entry
        if not least <= len(params) <= most:
            if not params:
                return [-1, "missing required caller_id parameter", 0]
            return [-1, f"Error: bad call arity: {name} takes {_range(least, most)} parameters", 0]
        try:
            value = method(*params)
            if isinstance(value, Awaitable):
                value = await value
        except XmlRpcFault:
            raise
        except Exception as error:
            self._log.exception("XML-RPC method %s failed", name)
            raise XmlRpcFault(FAULT_APPLICATION, f"{type(error).__name__}: {error}") from error
        if isinstance(value, Reply):
            afters.append(value.after)
            return value.value
        return value

    async def _multicall(
        self, params: tuple[Any, ...], afters: list[Callable[[], object]]
    ) -> list[Any]:
        """Many calls in one request; each has its own result or fault."""
        if len(params) != 1 or not isinstance(params[0], list):
            raise XmlRpcFault(FAULT_PARAMS, "system.multicall takes one array")
        results: list[Any] = []
        for count, call in enumerate(params[0], 1):
            try:
                results.append([await self._call(*_multicall_entry(call), afters)])
            except XmlRpcFault as fault:
                results.append({"faultCode": fault.code, "faultString": fault.text})
            if count % _YIELD_EVERY == 0:
                await asyncio.sleep(0)
        return results


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
