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
from aioros1.net.accepting import ListeningSocket
from aioros1.net.admission import Admission
from aioros1.net.allow import AllowList
from aioros1.net.budget import Share
from aioros1.net.connecting import connect as connect_tcp
from aioros1.net.connecting import reason_of
from aioros1.net.ending import abort, shut_down
from aioros1.net.hosts import bind_sockets, set_keepalive
from aioros1.options import Limits, Timeouts

__all__ = ["Listener", "Stream", "StreamProtocol", "connect", "connection_info", "take_over"]

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


class StreamProtocol(asyncio.StreamReaderProtocol):
    """asyncio's protocol of a stream, which ends the connection for forked processes, too."""

    _connection: asyncio.BaseTransport | None = None

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        self._connection = transport
        super().connection_made(transport)

    def connection_lost(self, exc: Exception | None) -> None:
        shut_down(self._connection)
        self._connection = None
        super().connection_lost(exc)


class Stream:
    """A connection during the handshake: a reader, a writer, and what both need.

    Raises :class:`OSError` if the connection is lost already.
    """

    __slots__ = ("local", "peer", "reader", "remote", "transport_name", "writer")

    def __init__(
        self,
        reader: asyncio.StreamReader,
        writer: asyncio.StreamWriter,
        timeouts: Timeouts = Timeouts(),  # noqa: B008 - frozen
    ) -> None:
        self.reader = reader
        self.writer = writer
        self.local = self.remote = ("", 0)
        sock = writer.get_extra_info("socket")
        if sock is None:
            self.transport_name = "INTRAPROCESS"
            self.peer = "this process"
        elif sock.family in (socket.AF_INET, socket.AF_INET6):
            self.transport_name = "TCPROS"
            # Now, because uvloop asks the system, which forgets them when the peer resets
            # the connection.
            self.local = _address(writer, "sockname")
            self.remote = _address(writer, "peername")
            self.peer = _address_text(self.remote)
            _tune(sock, timeouts)
        else:
            self.transport_name = "UNIXROS"
            self.peer = "this host"
            sock.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, _UNIX_BUFFER)

    @property
    def transport(self) -> asyncio.Transport:
        return cast("asyncio.Transport", self.writer.transport)

    async def receive_header(
        self, side: Side, *, timeout: float, share: Share | None = None
    ) -> None:
        """Read until ``side`` has its header, and not a byte more. Meanwhile ``share`` holds
        what has come.

        Raises :class:`~aioros1.HandshakeError`, :class:`TimeoutError`, and
        :class:`ConnectionError` when the connection ends before.
        """
        try:
            size = 0
            async with asyncio.timeout(timeout):
                while True:
                    data = await self.reader.read(side.missing)
                    if share is not None:
                        size += len(data)
                        share.grow_to(size)
                        if share.is_cut:
                            raise ConnectionResetError("all connections together held too much")
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
        abort(self.writer.transport)


async def connect(host: str, port: int, timeouts: Timeouts) -> Stream:
    """Connect to whichever address of ``host`` answers first; see :mod:`.connecting`.

    Raises :class:`ConnectionError` or :class:`TimeoutError`, both naming host and port.
    """
    loop = asyncio.get_running_loop()
    readers: dict[asyncio.BaseProtocol, asyncio.StreamReader] = {}  # a protocol does not keep it

    def stream_protocol() -> StreamProtocol:
        reader = asyncio.StreamReader(loop=loop)
        protocol = StreamProtocol(reader, loop=loop)
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
    try:
        return Stream(reader, asyncio.StreamWriter(transport, protocol, reader, loop), timeouts)
    except OSError as error:
        transport.abort()
        raise ConnectionError(f"cannot connect to {host}:{port}: {error}") from error


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
    sock = stream.writer.get_extra_info("socket")
    return ConnectionInfo(
        name=name,
        direction=direction,
        peer=peer,
        local=stream.local,
        remote=stream.remote,
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
        self._log = log if log is not None else _LOG
        self.admission = Admission(
            "the TCPROS port",
            allow=allow,
            total=("connections", limits.connections),
            per_host=limits.connections_per_host,
            log=self._log,
        )
        self._sockets: list[ListeningSocket] = []
        self.port = 0

    async def start(self, host: str, port: int) -> None:
        """Listen. Raises :class:`OSError` if the address is in use, or not of this machine."""
        # One socket: bind_sockets gives several only for a name with several addresses.
        sock = bind_sockets(host, port)[0]
        self.port = sock.getsockname()[1]
        self._listen(sock)

    async def listen_unix(self, address: str) -> None:
        """Listen on a Unix socket as well. Raises :class:`OSError`."""
        sock = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        try:
            sock.setblocking(False)
            sock.bind(address)
            sock.listen(512)
        except BaseException:
            sock.close()
            raise
        self._listen(sock)

    def _listen(self, sock: socket.socket) -> None:
        self._sockets.append(
            ListeningSocket(sock, self._new_protocol, admission=self.admission, log=self._log)
        )

    def new_protocol(self) -> asyncio.StreamReaderProtocol:
        """Make a protocol for our side of a connection that needs no socket.

        Raises :class:`ConnectionRefusedError` if there are too many connections.
        """
        host = self.admission.enter()
        if host is None:
            raise ConnectionRefusedError("the node has too many connections")
        return self._new_protocol(host)

    def _new_protocol(self, host: str) -> asyncio.StreamReaderProtocol:
        loop = asyncio.get_running_loop()
        reader = asyncio.StreamReader(loop=loop)
        return StreamProtocol(reader, partial(self._accepted, host), loop=loop)

    def _accepted(
        self, host: str, reader: asyncio.StreamReader, writer: asyncio.StreamWriter
    ) -> None:
        try:
            stream = Stream(reader, writer, self._timeouts)
            self._spawn(partial(self._run, host), stream, name=f"tcpros {stream.peer}")
        except (ClosedError, OSError):  # the node is closed, or the peer has gone
            self.admission.leave(host)
            abort(writer.transport)

    async def _run(self, host: str, stream: Stream) -> None:
        try:
            await self._serve(stream)
        finally:
            self.admission.leave(host)

    def close(self) -> None:
        """Stop listening; open connections stay open."""
        for sock in self._sockets:
            sock.close()

    async def wait_closed(self) -> None:
        """Wait until each connection that was being accepted is served or closed."""
        while self._sockets:
            await self._sockets.pop().wait_closed()


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


def _address(writer: asyncio.StreamWriter, name: str) -> tuple[str, int]:
    address = writer.get_extra_info(name)
    if not address:
        raise ConnectionResetError("connection lost before the handshake")
    return address[0], address[1]


def _address_text(address: tuple[str, int]) -> str:
    host, port = address
    return f"[{host}]:{port}" if ":" in host else f"{host}:{port}"
