"""Publishing a topic."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Mapping
from typing import TYPE_CHECKING, Any, Generic, TypeVar
from weakref import WeakSet

from aioros1._public import public
from aioros1.clock.timer import Timer
from aioros1.core.role import Role
from aioros1.errors import ClosedError
from aioros1.idl import Message
from aioros1.idl.codec import codec_of
from aioros1.idl.message_from import message_from
from aioros1.net.topic_links import JOIN, Frame
from aioros1.topics.options import PublisherOptions
from aioros1.waiting import deadline
from aioros1.wire.frames import frame_parts

if TYPE_CHECKING:
    from aioros1.connection import ConnectionInfo
    from aioros1.core.context import Context
    from aioros1.idl.genpy_types import GenpyMessage
    from aioros1.time import Duration, Time
    from aioros1.topics.publication import Publication

__all__ = ["Publisher"]

M = TypeVar("M", bound=Message)


@public
class Publisher(Role, Generic[M]):
    """Publishes messages of one type on one topic; made by :meth:`Node.advertise`.

    Every subscriber has a connection of its own. Messages go into the socket as long
    as that takes them, then into a queue of ``queue_size`` messages for that
    subscriber; what happens when it is full is said by ``overflow``. One slow
    subscriber never holds up the others.
    """

    kind = "publisher"

    def __init__(
        self,
        context: Context,
        publication: Publication,
        message_class: type[M],
        options: PublisherOptions,
    ) -> None:
        super().__init__(context, publication.name)
        self.options = options
        """How it was opened."""
        self.message_class = message_class
        """The class of its messages."""
        self._latched: Frame | None = None  # the message that new subscribers get first
        self._publication = publication
        self._blocks = options.overflow == "block"
        self._latches = options.latch
        self._frame = _frame_encoder(message_class)
        self._is_numbered = message_class._has_header
        # Messages of this class are encoded as they are: a call less for each.
        self._plain_class = None if self._is_numbered else message_class
        self._seq = 0
        self._timers: WeakSet[Timer] = WeakSet()  # those that run keep themselves

    @property
    def type(self) -> str:
        return self.message_class._type

    @property
    def md5sum(self) -> str:
        return self.message_class._md5sum

    @property
    def definition(self) -> str:
        return self.message_class._full_text

    @property
    def connections(self) -> tuple[ConnectionInfo, ...]:
        return self._publication.connections if self._is_open else ()

    @property
    def subscriber_count(self) -> int:
        """How many subscribers are connected now."""
        return self._publication.subscriber_count if self._is_open else 0

    @property
    def dropped(self) -> int:
        """Messages dropped so far from full queues, counted once per subscriber."""
        return self.stats.dropped

    def message(self, **fields: Any) -> M:
        """A new message of the topic's type."""
        return self.message_class(**fields)

    def publish(
        self, msg: M | GenpyMessage | Mapping[str, Any] | None = None, /, **fields: Any
    ) -> None:
        """Publish a message, or one made of ``fields``. Never waits.

        ``msg`` is a message of the topic's type, also one of genpy's, or a dict of its
        fields. If its type has a header, ``header.seq`` is set in ``msg``.

        Raises :class:`~aioros1.SerializationError` for values that do not fit,
        :class:`~aioros1.ClosedError`, and with ``overflow="block"``
        :class:`asyncio.QueueFull` when a subscriber has no room; then nobody got it.
        """
        if not self._is_open:
            raise self._closed_error()
        publication = self._publication
        coalescer = publication.coalescer
        if not coalescer.collects_here():
            coalescer.begin()
        if msg.__class__ is self._plain_class and not fields:
            frame = self._frame(msg)
        else:
            frame = self._encode(msg, fields)
        if self._blocks and publication.is_congested:
            self._require_room()
        if self._latches:
            self._latched = frame
        publication.send(frame, self)

    def publish_raw(self, buffer: bytes | bytearray | memoryview) -> None:
        """Publish a message that is serialised already; it is not looked into.

        Raises as :meth:`publish`. ``buffer`` may be changed afterwards.
        """
        if not self._is_open:
            raise self._closed_error()
        if self._blocks:
            self._require_room()
        coalescer = self._publication.coalescer
        if not coalescer.collects_here():
            coalescer.begin()
        frame = frame_parts(buffer, join=JOIN)
        if self._latches:
            self._latched = frame
        self._publication.send(frame, self)

    async def send(
        self,
        msg: M | GenpyMessage | Mapping[str, Any] | None = None,
        /,
        *,
        timeout: float | None = None,
        **fields: Any,
    ) -> None:
        """Publish as soon as every connected subscriber has room in its queue.

        Nothing is dropped then, whatever ``overflow`` says. It goes out at once while
        there is room, but from time to time other tasks run before.

        Raises as :meth:`publish`, and :class:`TimeoutError` after ``timeout`` seconds;
        then, and when it is cancelled, the message was not published.
        """
        if not self._is_open:
            raise self._closed_error()
        publication = self._publication
        coalescer = publication.coalescer
        # Before it is published, and nothing after it: who is cancelled may send it again.
        if coalescer.should_yield or not publication.has_subscribers:
            await asyncio.sleep(0)
            self._check_open()
        if publication.is_congested and not publication.has_room(self):
            await self._wait_until(
                lambda: publication.has_room(self), timeout, "no room in the queue of a subscriber"
            )
        if not coalescer.collects_here():
            coalescer.begin()
        if msg.__class__ is self._plain_class and not fields:
            frame = self._frame(msg)
        else:
            frame = self._encode(msg, fields)
        if self._latches:
            self._latched = frame
        publication.send(frame, self)

    def publish_every(
        self,
        period: float | Duration,
        msg: M | GenpyMessage | Mapping[str, Any] | Callable[[Time], object] | None = None,
        /,
        **fields: Any,
    ) -> Timer:
        """Publish again and again, every ``period`` seconds of the node's time, first after one.

        ``msg`` is what :meth:`publish` takes, and published as it is at that moment; or a
        function, which may be a coroutine function, that is called with the time each time
        and gives the message, or None for none. It ends with the publisher, or with
        :meth:`Timer.cancel` of what is returned. With ``overflow="block"`` a message waits
        for room as :meth:`send` does, and the ticks that it misses are skipped. An exception
        is treated as one in a timer's callback, see ``on_error`` of :class:`~aioros1.Node`.

        Raises :class:`ValueError` for a period that is not positive,
        :class:`~aioros1.SerializationError` for a message that cannot be published, and
        :class:`~aioros1.ClosedError`.
        """
        self._check_open()
        if not callable(msg):
            # What is wrong is told here, and not later to nobody.
            self._frame(message_from(self.message_class, msg, fields, "msg"))

        async def publish(now: Time) -> None:
            message: Any = msg
            if callable(msg):
                message = msg(now)
                if isinstance(message, Awaitable):
                    message = await message
                if message is None:
                    return
            try:
                if self._blocks:
                    await self.send(message, **fields)
                else:
                    self.publish(message, **fields)
            except ClosedError:
                pass  # while it waited

        context = self._context
        timer = Timer(context.clock, context.spawn, context.user_error, period, publish)
        self._timers.add(timer)
        return timer

    async def drain(self, *, timeout: float | None = None) -> None:
        """Wait until the operating system has taken all that was published.

        Raises :class:`TimeoutError` after ``timeout`` seconds, and
        :class:`~aioros1.ClosedError`.
        """
        self._check_open()
        await self._wait_until(
            lambda: self._publication.is_drained, timeout, "a subscriber did not take all"
        )

    async def wait_for_subscribers(self, n: int = 1, *, timeout: float | None = None) -> None:
        """Wait until ``n`` subscribers are connected.

        Raises :class:`TimeoutError` after ``timeout`` seconds, and
        :class:`~aioros1.ClosedError`.
        """
        self._check_open()
        await self._wait_until(
            lambda: self.subscriber_count >= n, timeout, f"{n} subscribers did not connect"
        )

    async def _wait_until(self, predicate: Any, timeout: float | None, what: str) -> None:
        waiters = self._publication.changed
        async with deadline(timeout, f"publisher {self.name}: {what}"):
            while not predicate():
                await waiters.wait()
                self._check_open()

    def _encode(self, msg: Any, fields: dict[str, Any]) -> Frame:
        if fields or msg.__class__ is not self.message_class:
            msg = message_from(self.message_class, msg, fields, "msg")
        if self._is_numbered:
            self._seq = seq = (self._seq + 1) & 0xFFFFFFFF
            try:
                msg.header.seq = seq
            except AttributeError:
                pass  # no header: told by what encodes it
        return self._frame(msg)

    def _require_room(self) -> None:
        if not self._publication.has_room(self):
            raise asyncio.QueueFull(
                f"publisher {self.name}: a subscriber has {self.options.queue_size} messages "
                "waiting; use send() to wait for room"
            )

    def _abort(self) -> None:
        super()._abort()
        self._publication.changed.wake()

    async def _close(self) -> None:
        for timer in tuple(self._timers):
            timer.cancel()
        await self._publication.leave(self)


def _frame_encoder(cls: type[Message]) -> Callable[[Any], Frame]:
    """What makes the frame of a message: in parts, where copying it would cost more."""
    codec = codec_of(cls)
    if not codec.has_bulk:
        return codec.frame
    in_parts = codec.frame_parts

    def encode(message: Any) -> Frame:
        parts = in_parts(message)
        return parts if len(parts) > 1 else bytes(parts[0])

    return encode
