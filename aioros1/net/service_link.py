"""The data phase of service connections: requests one way, answers the other.

After the handshake on streams, a protocol takes the transport over, as for topics. A
``StreamReader`` would wake its reader for the length and again for the rest, each time with
a timeout of its own. Here data is parsed where it arrives, one future is resolved for a
whole frame, and a timer runs only while a frame is incomplete.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any, cast

from aioros1.net.budget import Budget
from aioros1.net.ending import abort, shut_down
from aioros1.net.tcpros import Stream
from aioros1.wire.service import ServiceFrameError, frame_length

__all__ = ["ServiceLink"]

_AHEAD = 64 * 1024
"""Bytes that are read ahead while nobody receives."""


class ServiceLink(asyncio.Protocol):
    """One side of a service connection; it receives the frames of the other one by one.

    ``head`` is the number of bytes up to the end of a frame's length: 4 in a request, 5 in
    an answer. Memory grows with the bytes received, not with the length announced.
    ``patience`` is how many seconds may pass without a byte while a frame is incomplete,
    ``stall`` how many while the other side takes nothing of what was written. What is
    incomplete, not answered or not read by the other side counts in ``budget``.
    """

    def __init__(
        self,
        stream: Stream,
        *,
        head: int,
        max_bytes: int,
        patience: float,
        stall: float,
        budget: Budget | None = None,
    ) -> None:
        self.peer = stream.peer
        self._stream = stream  # a StreamWriter that is collected closes its transport
        self._head = head
        self._max_bytes = max_bytes
        self._patience = patience
        self._stall = stall
        self._transport: asyncio.Transport = stream.transport
        self._loop = asyncio.get_running_loop()
        self._buffer = bytearray()
        self._share = None if budget is None else budget.share(self._cut_off)
        self._wanted = 0  # bytes of the frame in the buffer, once its length is there
        self._receiver: asyncio.Future[Any] | None = None
        self.at_once: Callable[[bytes], Any] | None = None
        """Called with each frame that :meth:`receive` waits for, unless data waits to be sent.
        :meth:`receive` returns its result in place of the frame, or waits on if it is None."""
        self.ended: Callable[[], None] | None = None
        """Called when the other side will send no more."""
        self._timer: asyncio.TimerHandle | None = None
        self._is_paused = False
        self._has_ended = False
        self._failure: Exception | None = None
        self._writable: asyncio.Future[None] | None = None

    # asyncio.Protocol

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        self._transport = cast("asyncio.Transport", transport)

    def data_received(self, data: bytes) -> None:
        """Take bytes, including those that followed the connection header."""
        receiver = self._receiver
        if receiver is None or receiver.done():
            self._buffer += data
            self._hold()
            if len(self._buffer) > _AHEAD and not self._is_paused:
                self._is_paused = True
                self._transport.pause_reading()
            return
        try:
            if not self._buffer and self._size_of(data) == len(data):
                frame: bytes | None = data  # the usual case of small ones: no copy
            else:
                self._buffer += data
                self._hold()
                frame = self._next()
        except ServiceFrameError as error:
            receiver.set_exception(error)
            return
        if frame is None:
            self._set_timer(self._patience)
            return
        if self._timer is not None:
            self._set_timer(None)
        # Last, because the function that is called may do anything.
        if self.at_once is None or self._buffer or self._writable is not None:
            receiver.set_result(frame)
        elif (result := self.at_once(frame)) is not None:
            receiver.set_result(result)
        elif self._share is not None and self._share.size and self._writable is None:
            self._share.close()  # it was answered

    def eof_received(self) -> bool:
        self._end()
        return True  # it may still wait for its answer

    def connection_lost(self, exc: Exception | None) -> None:
        if self._failure is None:
            self._failure = exc
        if self._share is not None:
            self._share.close()
        shut_down(self._transport)
        self._end()
        if self._writable is not None and not self._writable.done():
            self._writable.set_result(None)

    def pause_writing(self) -> None:
        self._writable = self._loop.create_future()

    def resume_writing(self) -> None:
        if self._writable is not None and not self._writable.done():
            self._writable.set_result(None)
        self._writable = None

    # for roles

    @property
    def is_full(self) -> bool:
        """Whether the other side takes data more slowly than it is written."""
        return self._writable is not None

    @property
    def is_fresh(self) -> bool:
        """Whether the next bytes can only be the answer to the next request: the connection is
        open, and no bytes are left that nobody asked for."""
        return not (self._buffer or self._has_ended or self._transport.is_closing())

    async def receive(self, *, patience: float | None) -> Any:
        """Return the next frame with its head; None if the connection ends before it.

        ``patience`` is how many seconds its first byte may take. Raises
        :class:`TimeoutError`, :class:`OSError` when the connection fails, and
        :class:`~aioros1.wire.service.ServiceFrameError` for a frame beyond the limit.
        """
        if self._buffer and (frame := self._next()) is not None:
            return frame
        if self._failure is not None:
            raise self._failure
        if self._has_ended:
            return None
        if self._is_paused:
            self._is_paused = False
            self._transport.resume_reading()
        if self._share is not None and self._share.size and self._writable is None:
            self._share.close()  # the last request was answered
            self._hold()
        self._receiver = self._loop.create_future()
        self._set_timer(self._patience if self._buffer else patience)
        try:
            return await self._receiver
        finally:
            self._receiver = None
            if self._timer is not None:
                self._set_timer(None)

    def write(self, data: bytes) -> None:
        """Write ``data``; call :meth:`drain` afterwards if :attr:`is_full`.

        Raises :class:`OSError` when the connection is lost.
        """
        if self._transport.is_closing():
            raise self._failure or ConnectionResetError(f"{self.peer}: connection lost")
        self._transport.write(data)
        if self._writable is not None:
            self._hold()

    async def drain(self) -> None:
        """Wait until the other side has taken enough of what was written.

        Raises :class:`TimeoutError` when it takes nothing, and :class:`OSError` when the
        connection is lost.
        """
        while self._writable is not None:
            left = self._transport.get_write_buffer_size()
            await asyncio.wait((self._writable,), timeout=self._stall)
            if self._transport.is_closing():
                raise self._failure or ConnectionResetError(f"{self.peer}: connection lost")
            if self._writable is not None and self._transport.get_write_buffer_size() >= left:
                raise TimeoutError(f"{self.peer} took nothing for {self._stall} s")

    def stop_reading(self) -> None:
        """End :meth:`receive` as if the other side had closed."""
        self._transport.pause_reading()
        self._end()

    def abort(self) -> None:
        """Close at once; what was written may be lost."""
        abort(self._transport)

    def _hold(self) -> None:
        """Note what is held of the other side's data, and for it."""
        if self._share is not None:
            unread = self._transport.get_write_buffer_size()
            self._share.grow_to(len(self._buffer) + unread)

    def _cut_off(self) -> None:
        self._failure = ConnectionResetError(
            f"{self.peer} was cut off: all connections together held too much"
        )
        self._buffer.clear()
        self._wanted = 0
        abort(self._transport)

    # frames

    def _size_of(self, data: bytes | bytearray) -> int:
        """Return the size of the first frame in ``data``; 0 while its length is incomplete."""
        head = self._head
        if len(data) < head:
            return 0
        return head + frame_length(data[head - 4 : head], self._max_bytes)

    def _next(self) -> bytes | None:
        """Take the first frame out of the buffer, if it is complete."""
        buffer = self._buffer
        if not self._wanted:
            self._wanted = self._size_of(buffer)
        size = self._wanted
        if not size or len(buffer) < size:
            return None
        self._wanted = 0
        with memoryview(buffer) as view:
            frame = bytes(view[:size])
        del buffer[:size]
        return frame

    # waiting

    def _end(self) -> None:
        self._has_ended = True
        receiver = self._receiver
        if receiver is not None and not receiver.done():
            if self._failure is not None:
                receiver.set_exception(self._failure)
            else:
                receiver.set_result(None)
        if self.ended is not None:
            self.ended()

    def _set_timer(self, seconds: float | None) -> None:
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
        if seconds is not None:
            self._timer = self._loop.call_later(seconds, self._expired, seconds)

    def _expired(self, seconds: float) -> None:
        if self._receiver is not None and not self._receiver.done():
            self._receiver.set_exception(TimeoutError(f"{self.peer} sent nothing for {seconds} s"))
