"""Connections within one event loop: two transports that pass each other what is written.

To a protocol a :class:`MemoryTransport` behaves like that of a socket:

* Data arrives in order, in a later iteration of the loop: no code of the other side runs
  inside :meth:`~MemoryTransport.write`. While the other side does not read, the transport
  holds :data:`CAPACITY` bytes for it, as the system does for a socket; more stays in the
  write buffer, with ``pause_writing`` and ``resume_writing`` as usual.
* Closing sends the remaining data, then the other side sees the end. Writing to a closed
  side loses the connection, with an error. The end is reported in a later iteration, too.

Immutable data is not copied. A protocol that has a method ``block_received(data)`` is given
``bytes`` as they were written, or a memoryview of them. Other protocols get copies in pieces
of the usual size, through ``data_received`` or ``get_buffer`` and ``buffer_updated``.
"""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import Callable
from typing import Any, cast

__all__ = ["CAPACITY", "MemoryTransport", "connect_in_memory"]

CAPACITY = 4 << 20
"""Bytes that are held for a side that does not read. TCP on loopback holds as many, so a
burst that loses nothing there loses nothing here. The write that passes this limit is taken
as a whole, since it is only a reference."""

_PIECE = 256 * 1024
"""Bytes given to a protocol at a time, as asyncio reads them from a socket."""

_Data = bytes | memoryview


class MemoryTransport(asyncio.Transport):
    """One side of a connection; :func:`connect_in_memory` makes both."""

    def __init__(self, loop: asyncio.AbstractEventLoop) -> None:
        super().__init__()
        self._loop = loop
        self._protocol: asyncio.BaseProtocol | None = None
        self._block_received: Callable[[_Data], None] | None = None
        self._other: MemoryTransport | None = None
        self._inbox: deque[_Data] = deque()  # taken by us, not handed to the protocol yet
        self._inbox_size = 0
        self._outbox: deque[_Data] = deque()  # written by our protocol, not taken by the other
        self._outbox_size = 0
        self._high, self._low = 64 * 1024, 16 * 1024
        self._writing_paused = False
        self._reading = True
        self._due = False  # whether _hand_on will be called
        self._eof_written = False
        self._eof_came = False
        self._eof_told = False
        self._closing = False
        self._lost = False

    def __repr__(self) -> str:
        state = "closed" if self._lost else "closing" if self._closing else "open"
        return f"<{type(self).__name__} {state}>"

    # asyncio.BaseTransport

    def set_protocol(self, protocol: asyncio.BaseProtocol) -> None:
        self._protocol = protocol
        self._block_received = getattr(protocol, "block_received", None)

    def get_protocol(self) -> asyncio.BaseProtocol:
        return cast("asyncio.BaseProtocol", self._protocol)

    def is_closing(self) -> bool:
        return self._closing

    def close(self) -> None:
        if not self._closing:
            self._closing = True
            self._reading = False
            if not self._outbox:
                self._loop.call_soon(self._lose, None)

    # asyncio.ReadTransport

    def is_reading(self) -> bool:
        return self._reading

    def pause_reading(self) -> None:
        self._reading = False

    def resume_reading(self) -> None:
        if not self._reading and not self._closing:
            self._reading = True
            self._eof_told = False  # as a socket that is at its end says so again
            if self._inbox or self._eof_came:
                self._hand_on_soon()

    # asyncio.WriteTransport

    def set_write_buffer_limits(self, high: int | None = None, low: int | None = None) -> None:
        if high is None:
            high = 64 * 1024 if low is None else 4 * low
        if low is None:
            low = high // 4
        if not high >= low >= 0:
            raise ValueError(f"high must be at least low, and low at least 0, got {high}, {low}")
        self._high, self._low = high, low
        self._pause_writing()

    def get_write_buffer_limits(self) -> tuple[int, int]:
        return self._low, self._high

    def get_write_buffer_size(self) -> int:
        return self._outbox_size

    def write(self, data: Any) -> None:
        if self._eof_written:
            raise RuntimeError("write() called after write_eof()")
        if self._closing or not data:
            return
        if data.__class__ is not bytes:
            data = _unchanging(data)
        other = self._other
        if other is None or other._lost:
            self._fail(BrokenPipeError("the other side is closed"))
        elif self._outbox or not other._take(data):
            self._outbox.append(data)
            self._outbox_size += len(data)
            self._pause_writing()

    def can_write_eof(self) -> bool:
        return True

    def write_eof(self) -> None:
        if not self._closing and not self._eof_written:
            self._eof_written = True
            if not self._outbox and self._other is not None:
                self._other._end_of_data()

    def abort(self) -> None:
        self._fail(None)

    # writing, the rest

    def _pause_writing(self) -> None:
        if self._outbox_size > self._high and not self._writing_paused:
            self._writing_paused = True
            self._call("pause_writing")

    def _taken(self) -> None:
        """The other side has taken data out of the outbox."""
        if self._writing_paused and self._outbox_size <= self._low:
            self._writing_paused = False
            self._call("resume_writing")
        if not self._outbox:
            if self._closing:
                self._loop.call_soon(self._lose, None)
            elif self._eof_written and self._other is not None:
                self._other._end_of_data()

    # reading, the rest

    def _take(self, data: _Data) -> bool:
        """Hold ``data`` for the protocol; False if there is no room."""
        if self._inbox_size >= CAPACITY:
            return False
        self._inbox.append(data)
        self._inbox_size += len(data)
        if self._reading:
            self._hand_on_soon()
        return True

    def _hand(self, data: _Data) -> None:
        try:
            if self._block_received is not None:
                self._block_received(data)
            else:
                self._hand_in_pieces(data)
        except (SystemExit, KeyboardInterrupt):
            raise
        except BaseException as error:
            self._broken(error)

    def _hand_in_pieces(self, data: _Data) -> None:
        rest = memoryview(data)
        while rest:
            if not self._reading:
                if not self._closing:
                    self._inbox.appendleft(rest)
                    self._inbox_size += len(rest)
                return
            protocol = self._protocol
            if isinstance(protocol, asyncio.BufferedProtocol):
                room = memoryview(protocol.get_buffer(-1)).cast("B")
                count = min(len(room), len(rest))
                room[:count] = rest[:count]
                protocol.buffer_updated(count)
            else:
                count = min(_PIECE, len(rest))
                cast("asyncio.Protocol", protocol).data_received(bytes(rest[:count]))
            rest = rest[count:]

    def _hand_on_soon(self) -> None:
        if not self._due:
            self._due = True
            self._loop.call_soon(self._hand_on)

    def _hand_on(self) -> None:
        """Hand over the data that waits, and then the end."""
        self._due = False
        for _ in range(len(self._inbox)):  # not what comes meanwhile, so that others can run
            if not self._reading:
                break
            data = self._inbox.popleft()
            self._inbox_size -= len(data)
            self._hand(data)
        self._take_from_outbox()
        if not self._reading:
            return
        if self._inbox:
            self._hand_on_soon()
        elif self._eof_came and not self._eof_told:
            self._eof_told = True
            if not self._call("eof_received"):
                self.close()

    def _take_from_outbox(self) -> None:
        other = self._other
        if other is None or not other._outbox or self._closing:
            return
        outbox = other._outbox
        while outbox and self._inbox_size < CAPACITY:
            data = outbox.popleft()
            other._outbox_size -= len(data)
            self._inbox.append(data)
            self._inbox_size += len(data)
        other._taken()

    def _end_of_data(self) -> None:
        self._eof_came = True
        if self._reading:
            self._hand_on_soon()

    # the end

    def _fail(self, error: Exception | None) -> None:
        """Lose the connection, and the data that the other side has not taken."""
        self._closing = True
        self._reading = False
        self._outbox.clear()
        self._outbox_size = 0
        if not self._lost:
            self._loop.call_soon(self._lose, error)

    def _lose(self, error: Exception | None) -> None:
        if self._lost:
            return
        self._lost = True
        self._inbox.clear()
        other, self._other = self._other, None
        self._call("connection_lost", error)
        self._protocol = self._block_received = None
        if other is not None and not other._lost:
            if other._outbox:
                other._fail(ConnectionResetError("the other side has closed"))
            else:
                other._end_of_data()

    def _call(self, method: str, *arguments: object) -> object:
        """Call the protocol; an exception goes to the loop's exception handler."""
        try:
            return getattr(self._protocol, method)(*arguments)
        except (SystemExit, KeyboardInterrupt):
            raise
        except BaseException as error:
            self._broken(error)
            return None

    def _broken(self, error: BaseException) -> None:
        self._loop.call_exception_handler(
            {
                "message": f"a protocol failed: {error!r}",
                "exception": error,
                "transport": self,
                "protocol": self._protocol,
            }
        )
        self._fail(error if isinstance(error, Exception) else None)


def connect_in_memory(
    protocol: asyncio.BaseProtocol, other: asyncio.BaseProtocol
) -> tuple[MemoryTransport, MemoryTransport]:
    """Connect two protocols of the running loop, and return their transports."""
    loop = asyncio.get_running_loop()
    pair = MemoryTransport(loop), MemoryTransport(loop)
    for transport, opposite, attached in zip(pair, reversed(pair), (protocol, other), strict=True):
        transport._other = opposite
        transport.set_protocol(attached)
    for transport, attached in zip(pair, (protocol, other), strict=True):
        attached.connection_made(transport)
    return pair


def _unchanging(data: bytes | bytearray | memoryview) -> _Data:
    """Return the same bytes in memory that nobody can change, without a copy if possible."""
    view = memoryview(data)
    if view.obj.__class__ is bytes and view.c_contiguous:
        return view.cast("B")
    return bytes(view)
