"""A topic that a node publishes: its subscribers' connections, and how messages reach them.

The publishers of one topic in one node share a :class:`Publication`, because to the
rest of the graph they are one. This is the sending half of the data path:

* A message is encoded once, by the publisher, and written to all connections.
* One that comes alone is written at once. One that follows on the heels of another
  (:mod:`aioros1.net.coalescing`) is collected with those behind it and written as one block, at
  64 KiB or at the end of the turn of the event loop: one system call per message reaches
  0.4 million messages a second, blocks reach 4 million.
* The block is joined once for all connections that keep up. One that does not leaves
  the fast lane and gets a queue of its own until it has caught up.
"""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any

from aioros1.connection import ConnectionInfo
from aioros1.events import PeerConnected, PeerDisconnected
from aioros1.net.loop_state import loop_state
from aioros1.net.topic_links import JOIN, Frame, OutgoingLink
from aioros1.waiting import Waiters
from aioros1.wire.allocation import keep_memory
from aioros1.wire.handshake import TopicOffer

if TYPE_CHECKING:
    from aioros1.idl import Message
    from aioros1.node import Node
    from aioros1.topics.publisher import Publisher

__all__ = ["Publication"]


class Publication:
    """One published topic of one node."""

    def __init__(self, node: Node, topic: str, message_class: type[Message]) -> None:
        self.name = topic
        self.message_class = message_class
        self.publishers: list[Publisher[Any]] = []
        self.changed = Waiters()
        """Woken when a connection comes or goes, and when a queue gets shorter."""
        self._bytes_of_closed = 0
        self._node = node
        # Tuples that are replaced, not changed: writing to a connection may end it or
        # slow it down while we walk through them.
        self._open: tuple[OutgoingLink, ...] = ()
        self._slow: tuple[OutgoingLink, ...] = ()
        self._pending: list[bytes] = []
        self._pending_bytes = 0
        # Plain attributes, for they are looked at for every message.
        self.coalescer = loop_state().coalescer
        self.is_congested = False
        """Whether messages wait in the queue of any connection."""
        self.has_subscribers = False
        self.known_subscribers = 0
        """Those that the master named when it was last told."""
        self.registration = node._roles.registration(
            "publisher", topic, self._register, self._unregister
        )

    @property
    def is_used(self) -> bool:
        return bool(self.publishers)

    @property
    def links(self) -> tuple[OutgoingLink, ...]:
        return self._open + self._slow

    @property
    def connections(self) -> tuple[ConnectionInfo, ...]:
        return tuple(link.info for link in self.links)

    @property
    def subscriber_count(self) -> int:
        return len(self._open) + len(self._slow)

    @property
    def bytes_published(self) -> int:
        """What all publishers have published so far, closed ones too."""
        return self._bytes_of_closed + sum(each.stats.bytes for each in self.publishers)

    @property
    def is_drained(self) -> bool:
        """Whether the kernel has taken everything that was published."""
        self._flush()
        return not self._slow

    @property
    def latching(self) -> bool:
        return any(publisher.options.latch for publisher in self.publishers)

    def offer(self) -> TopicOffer:
        """What a subscriber is told when it connects."""
        cls = self.message_class
        return TopicOffer(self.name, cls._type, cls._md5sum, cls._full_text, self.latching)

    def headers(self) -> dict[str, str]:
        """Fields that the publishers want in the connection header besides the usual."""
        fields: dict[str, str] = {}
        for publisher in self.publishers:
            fields.update(publisher.options.headers or {})
        return fields

    def remove(self, publisher: Publisher[Any]) -> None:
        """One publisher less; what it has published still goes out."""
        self.publishers.remove(publisher)
        self._bytes_of_closed += publisher.stats.bytes
        self.changed.wake()

    # sending

    def send(self, frame: Frame, publisher: Publisher[Any]) -> None:
        """Give ``frame`` to every connection, or to its queue, as ``publisher`` wants."""
        stats = publisher.stats
        stats.messages += 1
        coalescer = self.coalescer
        if coalescer.is_collecting and isinstance(frame, bytes):
            size = len(frame)
            stats.bytes += size
            for link in self._slow:
                _enqueue(link, frame, publisher)
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
        # Before anything else: a connection may fill up with what is sent here, and then
        # belongs to those for whom the frame is queued.
        self._flush()
        for link in self._slow:
            _enqueue(link, frame, publisher)
        for link in self._open:
            link.write(frame, 1)
        coalescer.sent_alone()
        if size >= JOIN:
            coalescer.sent_much()
            keep_memory(size)  # for the next one to be encoded

    def has_room(self, publisher: Publisher[Any]) -> bool:
        """Whether every queue would take one more message without dropping any."""
        size = publisher.options.queue_size
        return not self._slow or all(_waiting(link, publisher) < size for link in self._slow)

    def _flush(self) -> None:
        pending = self._pending
        if pending:
            self._pending = []
            self._pending_bytes = 0
            block = b"".join(pending) if len(pending) > 1 else pending[0]
            for link in self._open:
                link.write(block, len(pending))

    def _look(self) -> None:
        """Set what depends on the connections."""
        self.is_congested = bool(self._slow)
        self.has_subscribers = bool(self._open or self._slow)

    # connections

    def add(self, link: OutgoingLink) -> None:
        """A subscriber has connected: it gets what is latched, then what is published."""
        self._flush()
        self._open += (link,)
        self._look()
        for publisher in self.publishers:
            if publisher.latched is not None:
                if link.is_open:
                    link.write(publisher.latched, 1)
                else:
                    link.queue.append((publisher.latched, publisher))
        self._node._emit(PeerConnected("publisher", self.name, link.info))
        self.changed.wake()

    def link_paused(self, link: OutgoingLink) -> None:
        self._open = tuple(other for other in self._open if other is not link)
        self._slow += (link,)
        self._look()

    def link_opened(self, link: OutgoingLink) -> None:
        # Messages of this turn that wait in the common block have gone through the
        # link's own queue already, so the block must go out before the link is back.
        self._flush()
        self._slow = tuple(other for other in self._slow if other is not link)
        self._open += (link,)
        self._look()

    def messages_lost(self, link: OutgoingLink) -> None:
        for _, publisher in link.queue:
            publisher.stats.dropped += 1
            link.info.stats.dropped += 1

    def link_closed(self, link: OutgoingLink) -> None:
        self._open = tuple(other for other in self._open if other is not link)
        self._slow = tuple(other for other in self._slow if other is not link)
        self._look()
        if link.stalled:
            self._node.log.warning(
                "publisher %s: %s was cut off, because %s",
                *(self.name, link.info.peer, link.failure),
            )
        self._node._emit(PeerDisconnected("publisher", self.name, link.info, link.failure))
        self.changed.wake()

    def room_made(self) -> None:
        self.changed.wake()

    # the end

    async def close_links(self, timeout: float) -> None:
        """Close all connections once what was published has gone out; cut off the rest."""
        self._flush()
        links = self.links
        for link in links:
            link.close()
        try:
            async with asyncio.timeout(timeout):
                for link in links:
                    await link.wait_closed()
        except TimeoutError:
            pass
        finally:
            self.abort()

    def abort(self) -> None:
        for link in self.links:
            link.abort()

    # at the master

    async def _register(self) -> None:
        node = self._node
        uris = await node._registrar.register_publisher(
            self.name, self.message_class._type, node.uri
        )
        self.known_subscribers = len(uris)

    async def _unregister(self) -> None:
        await self._node._registrar.unregister_publisher(self.name, self._node.uri)


def _waiting(link: OutgoingLink, publisher: Publisher[Any]) -> int:
    """How many of the publisher's messages wait for one connection."""
    if publisher.is_alone:
        return len(link.queue)
    return sum(1 for _, owner in link.queue if owner is publisher)


def _enqueue(link: OutgoingLink, frame: Frame, publisher: Publisher[Any]) -> None:
    """Queue a message for a slow connection; a full queue is the publisher's policy."""
    if _waiting(link, publisher) < publisher.options.queue_size:
        link.queue.append((frame, publisher))
        return
    publisher.stats.dropped += 1
    link.info.stats.dropped += 1
    if publisher.options.overflow == "drop_oldest":
        for index, (_, owner) in enumerate(link.queue):
            if owner is publisher:
                del link.queue[index]
                break
        link.queue.append((frame, publisher))
