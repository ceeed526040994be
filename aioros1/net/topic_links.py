"""The data phase of topics: the protocols that carry messages after the handshake.

:class:`IncomingLink` is one connection of a subscriber, :class:`OutgoingLink` one of
a publisher. Neither knows what a message is.
"""

from __future__ import annotations

import asyncio
import sys
from collections import deque
from collections.abc import Callable, Sequence
from typing import Any, Protocol, cast

from aioros1.connection import ConnectionInfo
from aioros1.net.budget import Budget
from aioros1.net.ending import abort, shut_down
from aioros1.net.tcpros import Stream
from aioros1.wire.frames import FrameError, FrameReceiver
from aioros1.wire.handshake import TopicOffer

__all__ = ["JOIN", "Batch", "Frame", "IncomingLink", "LinkOwner", "OutgoingLink", "Received"]

Frame = bytes | Sequence[bytes | memoryview]
"""A message with its length prefix: in one piece or, if large, in several."""

JOIN = 64 * 1024
"""Bytes joined into one write. Copying more would cost more than the system call it saves."""


_PIECE = 4 * 1024 * 1024
"""Bytes written at a time of a larger message. A transport copies what the kernel does not take,
for each subscriber. This is how much of a message each of them may have of its own. With pieces
of 256 KiB, images of 6 MB took a tenth longer; with these they do not."""


class Batch:
    """Data that holds complete frames, and what they have in common."""

    __slots__ = ("data", "link", "received")

    def __init__(self, data: bytes | memoryview, link: IncomingLink, received: int) -> None:
        self.data = data
        self.link = link
        self.received = received  # nanoseconds, by the node's clock


Received = tuple[Batch, int, int]
"""A received frame: its batch, and where it starts and stops in the batch's data."""


class IncomingLink(asyncio.BufferedProtocol):
    """One connection to a publisher.

    ``deliver(frames)`` is called with every batch of complete frames. Whoever calls
    :meth:`pause` has to call :meth:`resume` as often. While a link is paused its socket is
    not read, and TCP makes the publisher wait.
    """

    def __init__(
        self,
        stream: Stream,
        info: ConnectionInfo,
        offer: TopicOffer,
        deliver: Callable[[list[Received]], None],
        on_closed: Callable[[], None],
        clock: Callable[[], int],
        buffer: memoryview,
        *,
        max_bytes: int,
        budget: Budget | None = None,
    ) -> None:
        self.info = info
        self.offer = offer
        """What the publisher announced in the handshake."""
        self.is_closed = False
        self.latched: Received | None = None
        """The last message of a latching publisher, for subscribers that are opened later."""
        self.failure: str | None = None
        """Why the connection was lost, or why this side closed it."""
        self._deliver = deliver
        self._on_closed = on_closed
        self._clock = clock
        self._stream = stream  # a StreamWriter that is collected closes its transport
        self._transport: asyncio.Transport | None = None
        self._share = None if budget is None else budget.share(self._cut_off)
        on_large = None if budget is None else self._hold
        self._receiver = FrameReceiver(self, buffer, max_bytes=max_bytes, on_large=on_large)
        self._pauses = 0
        self._seen = 0

    # the sink of the receiver

    def batch(self, data: bytes | memoryview) -> Batch:
        return Batch(data, self, self._clock())

    def frames(self, frames: list[Received]) -> None:
        stats, receiver = self.info.stats, self._receiver
        stats.bytes = receiver.bytes_received
        stats.messages = receiver.frames_received
        self._deliver(frames)

    # asyncio.BufferedProtocol

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        self._transport = cast("asyncio.Transport", transport)

    def get_buffer(self, sizehint: int) -> memoryview:
        return self._receiver.buffer()

    def buffer_updated(self, nbytes: int) -> None:
        try:
            self._receiver.received(nbytes)
        except FrameError as error:
            self._refuse(error)

    def connection_lost(self, exc: Exception | None) -> None:
        if exc is not None and self.failure is None:
            self.failure = str(exc)
        self.is_closed = True
        self._hold(0)
        shut_down(self._transport)
        self._on_closed()

    def block_received(self, data: bytes | memoryview) -> None:
        """Take bytes that followed the connection header, or that a transport has in memory.
        They must not change."""
        try:
            self._receiver.block(data)
        except FrameError as error:
            self._refuse(error)

    # for the subscription

    def pause(self) -> None:
        self._pauses += 1
        if self._pauses == 1 and self._transport is not None:
            self._transport.pause_reading()

    def resume(self) -> None:
        self._pauses -= 1
        if not self._pauses and self._transport is not None and not self._transport.is_closing():
            self._transport.resume_reading()

    def abort(self) -> None:
        """Close at once."""
        if self._transport is not None:
            abort(self._transport)

    def has_progressed(self) -> bool:
        """Whether bytes came since the last call, or none could because of a pause."""
        seen, self._seen = self._seen, self._receiver.bytes_received
        return self._pauses > 0 or seen != self._seen

    def _hold(self, size: int) -> None:
        """Note how much memory an incomplete message takes."""
        if self._share is not None:
            if size:
                self._share.grow_to(size)
            else:
                self._share.close()

    def _cut_off(self) -> None:
        self.failure = "all connections together held too much"
        self.abort()

    def _refuse(self, error: FrameError) -> None:
        self.failure = str(error)
        self.abort()


class LinkOwner(Protocol):
    """The publication an :class:`OutgoingLink` belongs to."""

    def link_paused(self, link: OutgoingLink) -> None:
        """The link takes no more now; messages for it have to wait in its queue."""

    def link_opened(self, link: OutgoingLink) -> None:
        """The link takes messages again, its queue is empty."""

    def messages_lost(self, link: OutgoingLink) -> None:
        """The messages in the link's queue will not be sent."""

    def link_closed(self, link: OutgoingLink) -> None:
        """The connection is gone."""

    def room_made(self) -> None:
        """A queue got shorter."""


class OutgoingLink(asyncio.Protocol):
    """One connection to a subscriber, and the messages that wait for it.

    As long as the kernel takes what is written, the link is *open* and its queue empty, and
    the publication writes the same blocks to all open links. The high-water mark of the
    transport's write buffer is zero: once the kernel takes no more, the link is no longer
    open, and messages wait in :attr:`queue`, where they can still be dropped.
    """

    def __init__(
        self, stream: Stream, info: ConnectionInfo, owner: LinkOwner, *, stall: float
    ) -> None:
        self.info = info
        self.is_open = True
        self.is_closed = False
        self.queue: deque[tuple[Frame, Any]] = deque()
        """The messages that wait: each frame, and the publisher whose limits apply to it."""
        self.stalled = False
        """Whether the connection was cut off because the subscriber read nothing."""
        self.failure = ""
        """Why the connection ended, if neither side closed it."""
        self._owner = owner
        # Of a large message that is being written. Memory of this process is not copied.
        self._rest: deque[bytes | memoryview] = deque()
        self._piece = sys.maxsize if stream.transport_name == "INTRAPROCESS" else _PIECE
        self._stall = stall
        self._closing = False
        self._stream = stream  # a StreamWriter that is collected closes its transport
        self._transport: asyncio.Transport | None = None
        self._watch: asyncio.TimerHandle | None = None
        self._closed = asyncio.get_running_loop().create_future()

    # asyncio.Protocol

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        self._transport = cast("asyncio.Transport", transport)
        self._transport.set_write_buffer_limits(high=0)
        if self.unsent() and self.is_open:
            # The header alone was more than the kernel took. The transport has told the
            # protocol of the handshake, and does not tell it again.
            self.pause_writing()

    def data_received(self, data: bytes) -> None:
        """Drop it: a subscriber has nothing to send. rospy drops it, too."""

    def pause_writing(self) -> None:
        if self.is_open:
            self.is_open = False
            self._owner.link_paused(self)
        self._watch_progress(-1)

    def resume_writing(self) -> None:
        self._unwatch()
        self._write_rest()
        while self.queue and not self._is_stuck:
            self._write_some()
        if not self._is_stuck and not self.is_closed:
            self.is_open = True
            self._owner.link_opened(self)
            if self._closing and self._transport is not None:
                # Not now: asyncio's transport is calling this method, and would report the
                # end of the connection twice.
                asyncio.get_running_loop().call_soon(self._transport.close)
        self._owner.room_made()

    def connection_lost(self, exc: Exception | None) -> None:
        if exc is not None and not self.failure:
            self.failure = str(exc)
        self.is_open = False
        self.is_closed = True
        shut_down(self._transport)
        self._owner.messages_lost(self)
        self.queue.clear()
        self._rest.clear()
        self._unwatch()
        if not self._closed.done():
            self._closed.set_result(None)
        self._owner.link_closed(self)

    # for the publication

    def write(self, frame: Frame, messages: int) -> None:
        """Write to an open link, which may no longer be open afterwards."""
        transport = self._transport
        if transport is None or transport.is_closing():
            return
        stats = self.info.stats
        if isinstance(frame, bytes) and len(frame) <= self._piece:
            transport.write(frame)
            stats.bytes += len(frame)
        else:
            parts = (frame,) if isinstance(frame, bytes) else frame
            self._rest.extend(parts)
            stats.bytes += sum(map(len, parts))
            self._write_rest()
        stats.messages += messages

    def close(self) -> None:
        """Send the messages that wait, then close. A peer that stalls is still cut off."""
        self._closing = True
        if self._transport is not None and not self.queue and not self._rest:
            self._transport.close()

    def abort(self) -> None:
        if self._transport is not None:
            abort(self._transport)

    async def wait_closed(self) -> None:
        # A shield, so that cancelling this wait does not cancel those of others.
        await asyncio.shield(self._closed)

    def unsent(self) -> int:
        """Bytes that were written and the kernel has not taken yet."""
        return 0 if self._transport is None else self._transport.get_write_buffer_size()

    @property
    def _is_stuck(self) -> bool:
        """Whether something was begun that the kernel has not taken."""
        return bool(self._rest) or self.unsent() > 0

    def _write_rest(self) -> None:
        """Write of a large message what the kernel takes, and one piece beyond that."""
        rest, transport, most = self._rest, self._transport, self._piece
        while rest and transport is not None and not transport.get_write_buffer_size():
            if transport.is_closing():
                rest.clear()
                return
            part = rest.popleft()
            if len(part) > most:
                view = memoryview(part)
                rest.appendleft(view[most:])
                part = view[:most]
            transport.write(part)

    def _write_some(self) -> None:
        queue = self.queue
        frame, _ = queue.popleft()
        if not isinstance(frame, bytes):
            self.write(frame, 1)
            return
        block = [frame]
        size = len(frame)
        while queue and size < JOIN:
            frame = queue[0][0]
            if not isinstance(frame, bytes):
                break
            queue.popleft()
            block.append(frame)
            size += len(frame)
        self.write(b"".join(block), len(block))

    def _watch_progress(self, unsent: int) -> None:
        """Cut the peer off if it takes no byte for a whole period."""
        now = self.unsent()
        if now == unsent:
            self.stalled = True
            self.failure = "it took nothing for too long"
            self.abort()
            return
        loop = asyncio.get_running_loop()
        self._watch = loop.call_later(self._stall, self._watch_progress, now)

    def _unwatch(self) -> None:
        if self._watch is not None:
            self._watch.cancel()
            self._watch = None
