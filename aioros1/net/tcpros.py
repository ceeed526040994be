"""TCPROS connections on asyncio streams: made, accepted, and handed over to a protocol.

Streams carry the handshake. Then a protocol takes the transport over (:func:`take_over`),
because reading messages through a ``StreamReader`` costs three to five times as much.
"""

from __future__ import annotations

import asyncio
import logging
import socket
from collections.abc import Awaitable, Callable, Mapping
from functools import partial
from typing import Any, Literal, Protocol, cast

from aioros1.connection import ConnectionInfo
from aioros1.errors import ClosedError
from aioros1.net.admission import Admission
from aioros1.net.allow import AllowList
from aioros1.net.connecting import connect as connect_tcp
from aioros1.net.connecting import reason_of
from aioros1.net.hosts import bind_sockets, set_keepalive
from aioros1.options import Limits, Timeouts

__all__ = ["Listener", "Stream", "connect", "connection_info", "take_over"]

_LOG = logging.getLogger("aioros1.tcpros")

# TCP sends its first keepalive probe after some idle time, then one after each sixth of
# that time, nine in all. With an idle time of a minute this is what roscpp sets, so that a
# peer that lost its power is noticed at all.
_PARTS, _PROBES = 6, 9
_LONGEST = 32767  # seconds; no kernel takes more

# The send buffer of a Unix socket. With the usual 200 KiB a message of 1 MB takes twice as
# long, because sender and receiver have to take turns.
_UNIX_BUFFER = 1 << 20


class Side(Protocol):
    """One side of a handshake of :mod:`aioros1.wire.handshake`."""

    @property
    def missing(self) -> int: ...

    def receive_data(self, data: bytes) -> bool: ...


class Stream:
    """A connection during the handshake: a reader, a writer, and what both need."""

    __slots__ = ("peer", "reader", "transport_name", "writer")

    def __init__(
        self,
        reader: asyncio.StreamReader,
        writer: asyncio.StreamWriter,
        timeouts: Timeouts = Timeouts(),  # noqa: B008 - frozen
    ) -> None:
        self.reader = reader
        self.writer = writer
        sock = writer.get_extra_info("socket")
        if sock is None:
            self.transport_name = "INTRAPROCESS"
            self.peer = "this process"
        elif sock.family in (socket.AF_INET, socket.AF_INET6):
            self.transport_name = "TCPROS"
            self.peer = _address_text(writer.get_extra_info("peername"))
            _tune(sock, timeouts)
        else:
            self.transport_name = "UNIXROS"
            self.peer = "this host"
            sock.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, _UNIX_BUFFER)

    @property
    def transport(self) -> asyncio.Transport:
        return cast("asyncio.Transport", self.writer.transport)

    async def receive_header(self, side: Side, *, timeout: float) -> None:
        """Read until ``side`` has its header, and not a byte more.

        Raises :class:`~aioros1.HandshakeError`, :class:`TimeoutError`, and
        :class:`ConnectionError` when the connection ends before.
        """
        try:
            async with asyncio.timeout(timeout):
                while True:
                    data = await self.reader.read(side.missing)
                    if not data:
                        raise ConnectionResetError("the other side closed it")
                    if side.receive_data(data):
                        return
        except TimeoutError:
            raise TimeoutError(
                f"{self.peer} sent no whole connection header in {timeout} s"
            ) from None
        except ConnectionError as error:
            raise ConnectionResetError(
                f"{self.peer}: connection lost in the handshake: {error}"
            ) from error

    async def write(self, data: bytes, *, stall: float) -> None:
        """Write ``data``, and wait until the other side has taken enough of it.

        Raises :class:`TimeoutError` if it takes nothing for ``stall`` seconds.
        """
        self.writer.write(data)
        transport = self.writer.transport
        while left := transport.get_write_buffer_size():
            try:
                async with asyncio.timeout(stall):
                    await self.writer.drain()
                    return
            except TimeoutError:
                if transport.get_write_buffer_size() >= left:
                    raise TimeoutError(f"{self.peer} took nothing for {stall} s") from None

    async def close(self) -> None:
        """Send what was written, then close."""
        self.writer.close()
        try:
            await self.writer.wait_closed()
        except OSError:
            pass  # lost before it was closed: closed all the same

    def abort(self) -> None:
        """Close at once; what was written may be lost."""
        self.writer.transport.abort()


async def connect(host: str, port: int, timeouts: Timeouts) -> Stream:
    """Connect to whichever address of ``host`` answers first; see :mod:`.connecting`.

    Raises :class:`ConnectionError` or :class:`TimeoutError`, both naming host and port.
    """
    loop = asyncio.get_running_loop()
    readers: dict[asyncio.BaseProtocol, asyncio.StreamReader] = {}  # a protocol does not keep it

    def stream_protocol() -> asyncio.StreamReaderProtocol:
        reader = asyncio.StreamReader(loop=loop)
        protocol = asyncio.StreamReaderProtocol(reader, loop=loop)
        readers[protocol] = reader
        return protocol

    # The limit may pass while no address has failed yet, and then the kernel's own timeout
    # of a connection (which is an OSError, too) must not be taken for it.
    limit = asyncio.timeout(timeouts.connect)
    try:
        async with limit:
            transport, protocol = await connect_tcp(stream_protocol, host, port)
    except OSError as error:
        if limit.expired():
            raise TimeoutError(
                f"no connection to {host}:{port} within {timeouts.connect} s"
            ) from None
        raise ConnectionError(f"cannot connect to {host}:{port}: {reason_of(error)}") from None
    reader = readers[protocol]
    return Stream(reader, asyncio.StreamWriter(transport, protocol, reader, loop), timeouts)


async def take_over(stream: Stream, protocol: asyncio.BaseProtocol) -> bytes:
    """Give the stream's transport to ``protocol`` and return what the reader still holds.

    No byte is lost: no other code runs inside this function, because a reader at its end
    returns what it holds without waiting. If the end of the connection was seen already,
    ``protocol`` sees it again once reading is resumed.

    Raises :class:`ConnectionError` if the connection is lost already, because ``protocol``
    would never be told.
    """
    transport = stream.transport
    if transport.is_closing():
        raise ConnectionError(f"{stream.peer}: connection lost in the handshake")
    transport.pause_reading()
    transport.set_protocol(protocol)
    stream.reader.feed_eof()
    rest = await stream.reader.read()
    protocol.connection_made(transport)
    transport.resume_reading()
    return rest


def connection_info(
    stream: Stream,
    name: str,
    direction: Literal["i", "o", "b"],
    peer: str,
    header: Mapping[str, str],
) -> ConnectionInfo:
    """Describe a connection whose handshake is done."""
    writer = stream.writer
    sock = writer.get_extra_info("socket")
    over_ip = stream.transport_name == "TCPROS"
    return ConnectionInfo(
        name=name,
        direction=direction,
        peer=peer,
        local=writer.get_extra_info("sockname")[:2] if over_ip else ("", 0),
        remote=writer.get_extra_info("peername")[:2] if over_ip else ("", 0),
        fileno=sock.fileno() if sock is not None else -1,
        header=header,
        transport=stream.transport_name,
    )


class Listener:
    """Accepts the TCPROS connections of a node, over TCP and by other transports.

    ``spawn(function, stream, name=...)`` must run ``function(stream)`` in a task that the
    caller owns. A connection from an address that is not in ``allow``, or beyond the
    limits, is closed at once, before anything is read from it.
    """

    def __init__(
        self,
        serve: Callable[[Stream], Awaitable[None]],
        spawn: Callable[..., object],
        *,
        limits: Limits,
        timeouts: Timeouts = Timeouts(),  # noqa: B008 - frozen
        allow: AllowList | None = None,
        log: logging.Logger | logging.LoggerAdapter[Any] | None = None,
    ) -> None:
        self._serve = serve
        self._spawn = spawn
        self._timeouts = timeouts
        self.admission = Admission(
            "the TCPROS port",
            allow=allow,
            total=("connections", limits.connections),
            per_host=limits.connections_per_host,
            log=log if log is not None else _LOG,
        )
        self._servers: list[asyncio.Server] = []
        self.port = 0

    async def start(self, host: str, port: int) -> None:
        """Listen. Raises :class:`OSError` if the address is in use, or not of this machine."""
        sockets = bind_sockets(host, port)
        self.port = sockets[0].getsockname()[1]
        # One socket: bind_sockets gives several only for a name with several addresses.
        await self._listen(
            await asyncio.start_server(self._accepted, sock=sockets[0], start_serving=False)
        )

    async def listen_unix(self, address: str) -> None:
        """Listen on a Unix socket as well. Raises :class:`OSError`."""
        sock = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        try:
            sock.setblocking(False)
            sock.bind(address)
            sock.listen(512)
            server = await asyncio.start_unix_server(self._accepted, sock=sock, start_serving=False)
        except BaseException:
            sock.close()
            raise
        await self._listen(server)

    async def _listen(self, server: asyncio.Server) -> None:
        # Not in one step with creating it: starting to serve lets other tasks run, and if
        # this one was cancelled then, nobody would have the server to close it.
        self._servers.append(server)
        await server.start_serving()

    def new_protocol(self) -> asyncio.StreamReaderProtocol:
        """Make a protocol for our side of a connection that needs no socket."""
        loop = asyncio.get_running_loop()
        reader = asyncio.StreamReader(loop=loop)
        return asyncio.StreamReaderProtocol(reader, self._accepted, loop=loop)

    def _accepted(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        host = self.admission.enter(writer.transport)
        if host is None:
            writer.transport.abort()
            return
        try:
            stream = Stream(reader, writer, self._timeouts)
            self._spawn(partial(self._run, host), stream, name=f"tcpros {stream.peer}")
        except (ClosedError, OSError):  # the node is closed, or the peer has gone
            self.admission.leave(host)
            writer.transport.abort()

    async def _run(self, host: str, stream: Stream) -> None:
        try:
            await self._serve(stream)
        finally:
            self.admission.leave(host)

    def close(self) -> None:
        """Stop listening; open connections stay open."""
        while self._servers:
            self._servers.pop().close()


def _tune(sock: socket.socket, timeouts: Timeouts) -> None:
    sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    idle = min(max(timeouts.keepalive, 1), _LONGEST)
    set_keepalive(sock, round(idle), round(max(idle / _PARTS, 1)), _PROBES)
    # While data is unacknowledged TCP does not probe but retransmits, for a quarter of an
    # hour. This limits both. In milliseconds.
    option = getattr(socket, "TCP_USER_TIMEOUT", None)  # Linux has it
    if option is not None:
        given_up = max(idle + _PROBES * idle / _PARTS, timeouts.stall)
        sock.setsockopt(socket.IPPROTO_TCP, option, round(1000 * min(given_up, 3 * _LONGEST)))


def _address_text(address: object) -> str:
    if isinstance(address, tuple) and len(address) >= 2:
        host, port = address[0], address[1]
        return f"[{host}]:{port}" if ":" in str(host) else f"{host}:{port}"
    return str(address)
