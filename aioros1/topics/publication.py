"""A topic that a node publishes: its subscribers' connections, and how messages reach them.

The publishers of one topic in one node share a :class:`Publication`, because the rest of
the graph sees them as one. This is the sending half of the data path:

* The publisher encodes a message once, and it is written to all connections.
* A message on its own is written at once. Messages in quick succession
  (:mod:`aioros1.net.coalescing`) are collected and written as one block, at 64 KiB or at the
  end of the iteration of the event loop: one system call per message reaches 0.4 million
  messages a second, blocks reach 4 million.
* The block is joined once for all connections that keep up. A connection that falls behind
  leaves this fast path and gets a queue of its own until it has caught up.
"""

from __future__ import annotations

import asyncio
from collections import Counter
from typing import TYPE_CHECKING, Protocol

from aioros1.connection import ConnectionInfo
from aioros1.core.context import Context
from aioros1.core.shared import Shared
from aioros1.errors import HandshakeError, Md5MismatchError
from aioros1.net.tcpros import Stream, connection_info, take_over
from aioros1.net.topic_links import JOIN, Frame, OutgoingLink
from aioros1.quoting import printable
from aioros1.waiting import Waiters
from aioros1.wire.allocation import keep_memory
from aioros1.wire.handshake import Server, TopicOffer

if TYPE_CHECKING:
    from aioros1.core.stats import RoleStats
    from aioros1.idl import Message
    from aioros1.topics.options import PublisherOptions

__all__ = ["Publication"]


class Publishing(Protocol):
    """What a publication needs of a publisher."""

    options: PublisherOptions
    stats: RoleStats
    _latched: Frame | None
    """The message that every new subscriber gets first."""
    _warns: bool
    """Whether to warn of the first message that is dropped."""

    @property
    def is_open(self) -> bool: ...


class Publication(Shared[Publishing]):
    """One published topic of one node."""

    kind = "publisher"

    def __init__(
        self,
        context: Context,
        topic: str,
        table: dict[str, Publication],
        message_class: type[Message],
    ) -> None:
        super().__init__(context, topic, table)
        self.message_class = message_class
        self.changed = Waiters()
        """Woken when a connection opens or closes, and when a queue gets shorter."""
        self._bytes_of_closed = 0
        # Tuples, replaced rather than changed: writing to a connection may end it or slow
        # it down while we iterate over them.
        self._open: tuple[OutgoingLink, ...] = ()
        self._slow: tuple[OutgoingLink, ...] = ()
        # Connections that are closed once the last messages of closed publishers have gone
        # out. A publisher that is opened meanwhile has nothing to do with them.
        self._closing: set[OutgoingLink] = set()
        self._pending: list[bytes] = []
        self._pending_bytes = 0
        # Plain attributes, because every message reads them.
        self.coalescer = context.loop_state.coalescer
        self.is_congested = False
        """Whether any connection has messages in its queue."""
        self.has_subscribers = False
        self.known_subscribers = 0
        """How many subscribers the master named when this was last registered."""
        self._refusal = ""  # of the last subscriber that was refused

    @property
    def connections(self) -> tuple[ConnectionInfo, ...]:
        """The connections of its subscribers."""
        return tuple(link.info for link in self._open + self._slow)

    @property
    def subscriber_count(self) -> int:
        """How many subscribers are connected."""
        return len(self._open) + len(self._slow)

    @property
    def bytes_published(self) -> int:
        """Bytes that all publishers have published so far, including closed ones."""
        return self._bytes_of_closed + sum(each.stats.bytes for each in self.roles)

    @property
    def obstacle(self) -> str:
        """What keeps subscribers from being connected, as far as it is known here."""
        if self._refusal or self.registration.is_established:
            return self._refusal
        return f"the master does not know of publisher {self.name} yet"

    @property
    def is_drained(self) -> bool:
        """Whether the kernel has taken everything that was published."""
        self._flush()
        return not self._slow

    @property
    def _links(self) -> tuple[OutgoingLink, ...]:
        return self._open + self._slow + tuple(self._closing)

    def check_type(self, message_class: type[Message]) -> None:
        """Raise :class:`~aioros1.Md5MismatchError` for a type other than the published one."""
        ours = self.message_class
        is_used = any(publisher.is_open for publisher in self.roles)
        if is_used and ours._md5sum != message_class._md5sum:
            raise Md5MismatchError(
                f"{self._context.name} publishes {self.name} as {ours._type} with md5sum "
                f"{ours._md5sum} already, not as {message_class._type} with md5sum "
                f"{message_class._md5sum}"
            )

    # sending

    def send(self, frame: Frame, publisher: Publishing) -> None:
        """Write ``frame`` to every connection or its queue, by the options of ``publisher``."""
        stats = publisher.stats
        stats.messages += 1
        coalescer = self.coalescer
        if coalescer.is_collecting and isinstance(frame, bytes):
            size = len(frame)
            stats.bytes += size
            for link in self._slow:
                self._enqueue(link, frame, publisher)
            if not self._pending:
                coalescer.call_at_end(self._flush)
            self._pending.append(frame)
            self._pending_bytes += size
            if self._pending_bytes >= JOIN:
                self._flush()
                coalescer.sent_much()
            return
        size = len(frame) if isinstance(frame, bytes) else sum(map(len, frame))
        stats.bytes += size
        # This comes first: it may fill a connection, and the frame is then queued for that
        # connection too.
        self._flush()
        for link in self._slow:
            self._enqueue(link, frame, publisher)
        for link in self._open:
            link.write(frame, 1)
        coalescer.sent_alone()
        if size >= JOIN:
            coalescer.sent_much()
            keep_memory(size)  # for the next one to be encoded

    def has_room(self, publisher: Publishing) -> bool:
        """Whether every queue can take one more message without dropping any."""
        size = publisher.options.queue_size
        return not self._slow or all(self._waiting(link, publisher) < size for link in self._slow)

    def _waiting(self, link: OutgoingLink, publisher: Publishing) -> int:
        """How many of the publisher's messages wait for one connection."""
        if len(self.roles) == 1:
            return len(link.queue)
        return sum(1 for _, owner in link.queue if owner is publisher)

    def _enqueue(self, link: OutgoingLink, frame: Frame, publisher: Publishing) -> None:
        """Queue a message for a slow connection; ``overflow`` decides if the queue is full."""
        if self._waiting(link, publisher) < publisher.options.queue_size:
            link.queue.append((frame, publisher))
            return
        if not publisher.stats.dropped:
            self._first_drop(
                publisher,
                "publisher %s: a message for %s was dropped, because %s wait for it already "
                "(queue_size, with overflow=%s). `await send()` waits for room. Further drops are "
                "only counted, in `dropped`",
                *(self.name, link.info.peer, publisher.options.queue_size),
                repr(publisher.options.overflow),
            )
        publisher.stats.dropped += 1
        link.info.stats.dropped += 1
        if publisher.options.overflow == "drop_oldest":
            for index, (_, owner) in enumerate(link.queue):
                if owner is publisher:
                    del link.queue[index]
                    break
            link.queue.append((frame, publisher))

    def _first_drop(self, publisher: Publishing, text: str, *args: object) -> None:
        if publisher._warns:
            self._context.log.warning(text, *args)

    def _flush(self) -> None:
        pending = self._pending
        if pending:
            self._pending = []
            self._pending_bytes = 0
            block = b"".join(pending) if len(pending) > 1 else pending[0]
            for link in self._open:
                link.write(block, len(pending))

    def _look(self) -> None:
        """Update the attributes that depend on the connections."""
        self.is_congested = bool(self._slow)
        self.has_subscribers = bool(self._open or self._slow)

    # connections

    async def serve(self, stream: Stream, server: Server) -> None:
        """Serve a subscriber's connection, from the handshake until it closes.

        Raises :class:`~aioros1.HandshakeError` and :class:`ConnectionError`.
        """
        context, cls = self._context, self.message_class
        is_latching = any(publisher.options.latch for publisher in self.roles)
        offer = TopicOffer(self.name, cls._type, cls._md5sum, cls._full_text, is_latching)
        headers: dict[str, str] = {}
        for publisher in self.roles:
            headers.update(publisher.options.headers or {})
        try:
            answer = server.accept_topic(context.name, offer, headers)
        except HandshakeError as error:
            self._refusal = f"{server.peer} was refused: {printable(error.text)}"
            raise
        theirs = server.header.get("type", "*")
        if theirs not in ("*", offer.type):
            context.log.complain(
                "%s subscribes to %s as %s, but it is %s; accepted, as their md5sums are the same",
                *(server.caller_id, offer.topic, theirs, offer.type),
            )
        server.header = context.connections.kept(server.header)
        info = connection_info(stream, self.name, "o", server.caller_id, server.header)
        link = OutgoingLink(stream, info, self, stall=context.timeouts.stall)
        stream.writer.write(answer)
        await take_over(stream, link)
        self._add(link)
        if not self.roles:
            # The last publisher is closing, and the master has not told the subscriber yet.
            # Nothing is wrong, but there is nothing to send.
            self._begin_to_close(link)
        try:
            await link.wait_closed()
        finally:
            link.abort()

    def _add(self, link: OutgoingLink) -> None:
        """Add a new connection: it gets the latched messages, then what is published."""
        self._flush()
        if link.is_open:  # or its own handshake paused it, and it is among the slow ones
            self._open += (link,)
        self._look()
        for publisher in self.roles:
            if publisher._latched is not None:
                if link.is_open:
                    link.write(publisher._latched, 1)
                else:
                    link.queue.append((publisher._latched, publisher))
        self._context.connections.add(self.kind, link, link.info)
        self.changed.wake()

    def _begin_to_close(self, link: OutgoingLink) -> None:
        """Close a connection once what waits for it has gone out; it gets nothing else."""
        self._remove(link)
        self._closing.add(link)
        self._look()
        link.close()

    def _remove(self, link: OutgoingLink) -> None:
        self._open = tuple(other for other in self._open if other is not link)
        self._slow = tuple(other for other in self._slow if other is not link)

    def link_paused(self, link: OutgoingLink) -> None:
        if link in self._closing:
            return
        self._open = tuple(other for other in self._open if other is not link)
        self._slow += (link,)
        self._look()

    def link_opened(self, link: OutgoingLink) -> None:
        if link in self._closing:
            return
        # The common block holds messages of this iteration that the link has already sent
        # from its own queue, so the block must go out before the link rejoins.
        self._flush()
        self._slow = tuple(other for other in self._slow if other is not link)
        self._open += (link,)
        self._look()

    def messages_lost(self, link: OutgoingLink) -> None:
        lost = Counter(publisher for _, publisher in link.queue)
        for publisher, count in lost.items():
            # A subscriber may go while the publisher closes, and leave what waits for it.
            if publisher.is_open and not publisher.stats.dropped:
                self._first_drop(
                    publisher,
                    "publisher %s: the connection to %s has ended, and with it %s of its messages "
                    "(queue_size=%s, overflow=%s) that waited there. Further losses are only "
                    "counted, in `dropped`",
                    *(self.name, link.info.peer, count, publisher.options.queue_size),
                    repr(publisher.options.overflow),
                )
        for _, publisher in link.queue:
            publisher.stats.dropped += 1
            link.info.stats.dropped += 1

    def link_closed(self, link: OutgoingLink) -> None:
        self._remove(link)
        self._closing.discard(link)
        self._look()
        if link.stalled:
            self._context.log.complain(
                "publisher %s: %s was cut off, because %s; what waited for it is lost",
                *(self.name, link.info.peer, link.failure),
            )
        self._context.connections.remove(link, link.failure)
        self.changed.wake()

    def room_made(self) -> None:
        self.changed.wake()

    # the end

    def abort(self) -> None:
        for link in self._links:
            link.abort()

    def _part(self, role: Publishing) -> None:
        """Remove a publisher; what it has published still goes out."""
        super()._part(role)
        self._bytes_of_closed += role.stats.bytes
        self.changed.wake()

    async def _let_go(self) -> None:
        """Close all connections once everything published has gone out; cut off the rest.

        This happens before the master knows: some subscribers close the connection as soon
        as it tells them. Connections that are made meanwhile, as a publisher may be opened
        again, are none of them.
        """
        self._flush()
        links = self._links
        for link in links:
            self._begin_to_close(link)
        try:
            async with asyncio.timeout(self._context.timeouts.close):
                for link in links:
                    await link.wait_closed()
        except TimeoutError:
            for link in self._slow:
                self._context.log.warning(
                    "publisher %s: closed, and %s messages that waited for %s are lost: it did not "
                    "take them within %s s",
                    *(self.name, len(link.queue), link.info.peer, self._context.timeouts.close),
                )
        finally:
            for link in links:
                link.abort()

    # at the master

    async def _register(self) -> None:
        context = self._context
        uris = await context.registrar.register_publisher(
            self.name, self.message_class._type, context.address.uri
        )
        self.known_subscribers = len(uris)

    async def _unregister(self) -> None:
        context = self._context
        await context.registrar.unregister_publisher(self.name, context.address.uri)
