"""Receiving a topic."""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Generic, NoReturn, Self, TypeVar
from weakref import WeakKeyDictionary

from aioros1.core.role import Role
from aioros1.errors import DeserializationError, InvalidNameError, MessageError
from aioros1.net.topic_links import IncomingLink, Received
from aioros1.options import Overflow, check_queue
from aioros1.time import Time
from aioros1.waiting import Waiters, deadline

if TYPE_CHECKING:
    from aioros1.connection import ConnectionInfo
    from aioros1.idl import Message, MessageStore
    from aioros1.node import Node
    from aioros1.topics.subscription import Subscription
    from aioros1.wire.handshake import TopicOffer

__all__ = ["MessageEvent", "Subscriber", "SubscriberOptions"]

M = TypeVar("M")

Decoder = Callable[[Received], Any]


@dataclass(frozen=True, slots=True, kw_only=True)
class SubscriberOptions:
    """How a subscriber was opened; the defaults are those of :meth:`Node.subscribe`."""

    queue_size: int = 10
    """Messages that wait to be taken."""

    overflow: Overflow = "drop_oldest"
    """Which message goes when that queue is full; with ``block`` none does: the
    publishers' connections are not read until there is room."""

    tcp_nodelay: bool = True
    """Ask publishers to send small messages at once."""

    raw: bool = False
    """Hand out serialised messages, as ``bytes``."""

    views: bool = False
    """Hand out numeric arrays and ``uint8[]`` as memoryviews of what was received,
    without copying them."""

    def __post_init__(self) -> None:
        check_queue(self.queue_size, self.overflow)


@dataclass(frozen=True, slots=True)
class MessageEvent(Generic[M]):
    """A message with what came along with it."""

    message: M
    header: Mapping[str, str]
    """The connection header of the publisher; ``header["callerid"]`` is its name."""
    received: Time
    """When the message was read from the socket, by the node's clock."""
    raw: bytes
    """The serialised message."""


class Subscriber(Role, Generic[M]):
    """Receives messages of a topic; made by :meth:`Node.subscribe`.

    It has one queue, filled by the publishers' connections and emptied by whoever
    iterates or calls :meth:`get`, :meth:`get_nowait`; each message is handed out once.
    Messages are decoded when they are taken, so one that is dropped costs nothing. One
    that cannot be decoded is logged, counted in ``stats.errors`` and skipped.
    """

    kind = "subscriber"

    def __init__(
        self,
        node: Node,
        subscription: Subscription,
        message_class: type[Message] | None,
        options: SubscriberOptions,
    ) -> None:
        super().__init__(node, subscription.name)
        self.options = options
        self.message_class = message_class
        """None for a subscriber to any type."""
        self._subscription = subscription
        self._md5sum = "*" if message_class is None else message_class._md5sum
        self._decode: Decoder = self._decoder()
        # Where there is nothing to choose, the codec itself: a call less for each message.
        plain = message_class is not None and not options.raw and not options.views
        self._decode_bytes = message_class._decode if message_class and plain else None
        self._queue: deque[Received] = deque()
        self._newest: Received | None = None
        self._arrived = Waiters()
        # With overflow="block": what was read from a socket before it could be paused,
        # in order, and how far into it we are.
        self._backlog: deque[tuple[IncomingLink, list[Received], int]] = deque()

    # what it is

    @property
    def type(self) -> str:
        return "*" if self.message_class is None else self.message_class._type

    @property
    def md5sum(self) -> str:
        return self._md5sum

    @property
    def definition(self) -> str:
        return "" if self.message_class is None else self.message_class._full_text

    @property
    def connections(self) -> tuple[ConnectionInfo, ...]:
        return self._subscription.connections if self._is_open else ()

    @property
    def publisher_count(self) -> int:
        """How many publishers are connected now."""
        return self._subscription.publisher_count if self._is_open else 0

    @property
    def queued(self) -> int:
        """Messages that wait to be taken, ``options.queue_size`` at most."""
        return len(self._queue)

    @property
    def dropped(self) -> int:
        """Messages dropped so far because the queue was full."""
        return self.stats.dropped

    @property
    def latest(self) -> M | None:
        """The newest message received, taken from the queue or not; None before the first.

        Raises :class:`~aioros1.DeserializationError` if that cannot be decoded.
        """
        if self._newest is None:
            return None
        message: M = self._decode(self._newest)
        return message

    async def wait_for_publishers(self, n: int = 1, *, timeout: float | None = None) -> None:
        """Wait until ``n`` publishers are connected.

        Raises :class:`TimeoutError` after ``timeout`` seconds, and
        :class:`~aioros1.ClosedError`.
        """
        self._check_open()
        async with deadline(timeout, f"subscriber {self.name}: {n} publishers did not connect"):
            while self.publisher_count < n:
                await self._subscription.changed.wait()
                self._check_open()

    # taking messages

    def __aiter__(self) -> Self:
        return self

    async def __anext__(self) -> M:
        queue = self._queue
        while True:
            if queue:
                item = queue.popleft()
                batch, start, stop = item
                data, decode = batch.data, self._decode_bytes
                message: M
                try:
                    if decode is not None and isinstance(data, bytes):
                        message = decode(data, start, stop)
                    else:
                        message = self._decode(item)
                except DeserializationError as error:
                    self._skip(error)
                else:
                    return message
            elif self._backlog:
                self._refill()
            elif self._is_open:
                await self._arrived.wait()
            else:
                raise StopAsyncIteration

    async def get(self, *, timeout: float | None = None) -> M:
        """The next message; waits for one.

        Raises :class:`TimeoutError` after ``timeout`` seconds, and
        :class:`~aioros1.ClosedError`. Nothing is lost when it is cancelled.
        """
        if timeout is not None:
            async with deadline(timeout, f"subscriber {self.name}: no message came"):
                return await self.get()
        while True:
            self._check_open()
            item = self._take()
            if item is None:
                await self._arrived.wait()
                continue
            try:
                message: M = self._decode(item)
            except DeserializationError as error:
                self._skip(error)
            else:
                return message

    def get_nowait(self) -> M:
        """The next message. Raises :class:`asyncio.QueueEmpty` if none has come."""
        self._check_open()
        while (item := self._take()) is not None:
            try:
                message: M = self._decode(item)
            except DeserializationError as error:
                self._skip(error)
            else:
                return message
        raise asyncio.QueueEmpty(f"subscriber {self.name}: no message has come")

    def events(self) -> _Events[M]:
        """Iterate as the subscriber itself does, over :class:`MessageEvent`."""
        return _Events(self)

    async def _next_event(self) -> MessageEvent[M]:
        while True:
            item = self._take()
            if item is None:
                if not self._is_open:
                    raise StopAsyncIteration
                await self._arrived.wait()
                continue
            batch, start, stop = item
            try:
                message: M = self._decode(item)
            except DeserializationError as error:
                self._skip(error)
                continue
            return MessageEvent(
                message,
                batch.link.info.header,
                Time.from_nsec(batch.received),
                bytes(batch.data[start:stop]),
            )

    def _take(self) -> Received | None:
        if not self._queue and self._backlog:
            self._refill()
        return self._queue.popleft() if self._queue else None

    def _skip(self, error: DeserializationError) -> None:
        self.stats.errors += 1
        # The first one is worth a warning; a publisher that sends nothing else is not
        # worth one for each.
        log = self._node.log.warning if self.stats.errors == 1 else self._node.log.debug
        log("subscriber %s: a message was skipped: %s", self.name, error)

    def _decoder(self) -> Decoder:
        if self.options.raw:
            return _raw
        if self.message_class is not None:
            return _decoder_of(self.message_class, self.options.views)
        return _AnyDecoder(self._node.peer_definitions, self.options.views)

    # being filled

    def _offer(self, frames: list[Received]) -> None:
        """Take frames from a connection; what does not fit is dropped, or kept waiting."""
        batch, _, stop = frames[-1]
        link = batch.link
        if link.offer.md5sum != self._md5sum and "*" not in (self._md5sum, link.offer.md5sum):
            return  # somebody else here takes any type, and this publisher's is not ours
        stats = self.stats
        stats.messages += len(frames)
        stats.bytes += stop - frames[0][1] + 4
        queue, size = self._queue, self.options.queue_size
        room = size - len(queue)
        self._newest = frames[-1]
        if len(frames) <= room and not self._backlog:
            queue.extend(frames)
        elif self.options.overflow == "drop_oldest":
            stats.dropped += len(frames) - room
            if len(frames) >= size:
                queue.clear()
                queue.extend(frames[-size:])
            else:
                for _ in range(len(frames) - room):
                    queue.popleft()
                queue.extend(frames)
        elif self.options.overflow == "drop_newest":
            stats.dropped += len(frames) - room
            queue.extend(frames[:room])
        else:
            link.pause()
            self._backlog.append((link, frames, 0))
            self._refill()
        self._arrived.wake()

    def _refill(self) -> None:
        """Move what waits into the queue, and read on from connections that are done."""
        queue, backlog = self._queue, self._backlog
        room = self.options.queue_size - len(queue)
        while backlog and room:
            link, frames, index = backlog.popleft()
            part = frames[index : index + room]
            queue.extend(part)
            room -= len(part)
            index += len(part)
            if index < len(frames):
                backlog.appendleft((link, frames, index))
            else:
                link.resume()

    # the end

    def _abort(self) -> None:
        super()._abort()
        self._arrived.wake()
        self._subscription.changed.wake()

    async def _close(self) -> None:
        self._queue.clear()
        while self._backlog:
            self._backlog.popleft()[0].resume()
        self._arrived.wake()
        await self._node._roles.close_subscriber(self, self._subscription)


class _Events(Generic[M]):
    """What :meth:`Subscriber.events` returns; it draws from the subscriber's queue."""

    def __init__(self, subscriber: Subscriber[M]) -> None:
        self._subscriber = subscriber

    def __aiter__(self) -> Self:
        return self

    async def __anext__(self) -> MessageEvent[M]:
        return await self._subscriber._next_event()


def _raw(item: Received) -> bytes:
    batch, start, stop = item
    return bytes(batch.data[start:stop])


def _decoder_of(cls: type[Message], views: bool) -> Decoder:
    """What turns a frame into a message; small frames lie in bytes, large ones in a view."""
    small, large, with_views = cls._decode, cls._decode_view, cls._decode_views

    def decode_views(item: Received) -> Any:
        batch, start, stop = item
        return with_views(memoryview(batch.data), start, stop)

    def decode(item: Received) -> Any:
        batch, start, stop = item
        data = batch.data
        if isinstance(data, bytes):
            return small(data, start, stop)
        return large(data, start, stop)

    return decode_views if views else decode


class _AnyDecoder:
    """Decodes every publisher's messages from that publisher's own definition."""

    def __init__(self, store: MessageStore, views: bool) -> None:
        self._store = store
        self._views = views
        # Weak, because publishers come and go and the subscriber stays.
        self._decoders: WeakKeyDictionary[IncomingLink, Decoder] = WeakKeyDictionary()

    def __call__(self, item: Received) -> Any:
        link = item[0].link
        decoder = self._decoders.get(link)
        if decoder is None:
            decoder = self._decoders[link] = self._decoder_for(link.offer)
        return decoder(item)

    def _decoder_for(self, offer: TopicOffer) -> Decoder:
        try:
            cls = self._store.add_definition(offer.type, offer.definition)
        except (MessageError, InvalidNameError) as error:
            return _undecodable(f"the publisher's definition of {offer.type}: {error}")
        if offer.md5sum not in ("*", cls._md5sum):
            return _undecodable(
                f"the publisher's definition of {offer.type} has md5sum {cls._md5sum}, "
                f"but it announced {offer.md5sum}"
            )
        return _decoder_of(cls, self._views)


def _undecodable(why: str) -> Decoder:
    def decode(item: Received) -> NoReturn:
        raise DeserializationError(why)

    return decode
