"""Publishing a topic."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Mapping
from typing import Any, Generic, TypeVar
from weakref import WeakSet

from aioros1._public import public
from aioros1.clock.timer import Timer
from aioros1.connection import ConnectionInfo
from aioros1.core.context import Context
from aioros1.core.obstacles import Hint
from aioros1.core.role import Role
from aioros1.errors import ClosedError, SerializationError
from aioros1.hints import check_takes
from aioros1.idl import Message
from aioros1.idl.codec import codec_of
from aioros1.idl.genpy_types import GenpyMessage
from aioros1.idl.message_from import message_from
from aioros1.net.topic_links import JOIN, Frame
from aioros1.time import Duration, Time
from aioros1.topics.options import PublisherOptions
from aioros1.topics.publication import Publication
from aioros1.waiting import deadline
from aioros1.wire.frames import frame_parts

__all__ = ["Publisher"]

M = TypeVar("M", bound=Message)


@public
class Publisher(Role, Generic[M]):
    """Publishes messages of one type on one topic; made by :meth:`Node.advertise`.

    Every subscriber has its own connection. Messages go to the socket while it accepts
    them, then into a queue of ``queue_size`` messages for that subscriber; ``overflow``
    decides what happens when the queue is full. A slow subscriber never holds up the others.
    """

    kind = "publisher"
    _factory = "advertise"

    def __init__(
        self,
        context: Context,
        publication: Publication,
        message_class: type[M],
        options: PublisherOptions,
        *,
        warns: bool = True,
    ) -> None:
        super().__init__(context, publication.name)
        self.options = options
        """The options it was opened with."""
        self.message_class = message_class
        """The class of its messages."""
        self._latched: Frame | None = None  # the message that every new subscriber gets first
        self._warns = warns  # of the first message that is dropped
        self._publication = publication
        self._blocks = options.overflow == "block"
        self._latches = options.latch
        self._frame = _frame_encoder(message_class)
        self._is_numbered = message_class._has_header
        # Messages of exactly this class are encoded directly, which saves a call for each.
        self._plain_class = None if self._is_numbered else message_class
        self._seq = 0
        self._timers: WeakSet[Timer] = WeakSet()  # a running timer keeps itself alive

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
        """How many messages full queues have dropped so far, counted once per subscriber."""
        return self.stats.dropped

    def message(self, **fields: Any) -> M:
        """Make a new message of the topic's type."""
        return self.message_class(**fields)

    def publish(
        self, msg: M | GenpyMessage | Mapping[str, Any] | None = None, /, **fields: Any
    ) -> None:
        """Publish a message, or one made from ``fields``. Never waits.

        ``msg`` is a message of the topic's type (genpy's class works too) or a dict of its
        fields. If the type has a header, this sets ``header.seq`` in ``msg``.

        Raises :class:`~aioros1.SerializationError` for values that do not fit,
        :class:`~aioros1.ClosedError`, and with ``overflow="block"``
        :class:`asyncio.QueueFull` when a subscriber has no room; no subscriber gets it then.
        """
        if not self._is_open:
            raise self._closed_error()
        publication = self._publication
        coalescer = publication.coalescer
        if not coalescer.collects_here():
            coalescer.begin()
        try:
            if msg.__class__ is self._plain_class and not fields:
                frame = self._frame(msg)
            else:
                frame = self._encode(msg, fields)
        except SerializationError as error:
            raise error.locate(self.type, f"on {self.name}")  # noqa: B904 - the same error
        if self._blocks and publication.is_congested:
            self._require_room()
        if self._latches:
            self._latched = frame
        publication.send(frame, self)

    def publish_raw(self, buffer: bytes | bytearray | memoryview) -> None:
        """Publish a message that is already serialised, without checking it.

        Raises as :meth:`publish`. You may change ``buffer`` afterwards.
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
        """Publish as soon as the queue for each connected subscriber has room.

        This drops nothing from these queues, whatever ``overflow`` says. A subscriber has a
        queue of its own, which drops unless its ``overflow`` is ``"block"``. While there is
        room this publishes at once, but lets other tasks run first from time to time.

        Raises as :meth:`publish`, and :class:`TimeoutError` after ``timeout`` seconds. After
        a timeout or a cancellation the message was not published.
        """
        if not self._is_open:
            raise self._closed_error()
        publication = self._publication
        coalescer = publication.coalescer
        # Wait only before publishing, never after: a cancelled caller may send it again.
        if coalescer.should_yield or not publication.has_subscribers:
            await asyncio.sleep(0)
            self._check_open()
        if publication.is_congested and not publication.has_room(self):
            await self._wait_until(
                lambda: publication.has_room(self), timeout, "no room in the queue of a subscriber"
            )
        if not coalescer.collects_here():
            coalescer.begin()
        try:
            if msg.__class__ is self._plain_class and not fields:
                frame = self._frame(msg)
            else:
                frame = self._encode(msg, fields)
        except SerializationError as error:
            raise error.locate(self.type, f"on {self.name}")  # noqa: B904 - the same error
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
        """Publish every ``period`` seconds of the node's time, first after one period.

        ``msg`` is anything that :meth:`publish` takes, and is published as it is at each
        tick. Or it is a function or coroutine function that takes the time and returns the
        message, or None to publish nothing. Publishing ends with the publisher, or with
        :meth:`Timer.cancel` of the returned timer. With ``overflow="block"`` a message waits
        for room as in :meth:`send`, and skips the ticks that it misses. Exceptions are
        treated like those of a timer's callback: see ``on_error`` of :class:`~aioros1.Node`.

        Raises :class:`ValueError` for a period that is not positive,
        :class:`~aioros1.SerializationError` for a message that cannot be published, and
        :class:`~aioros1.ClosedError`.
        """
        self._check_open()
        if not callable(msg):
            # Raise here, where the caller sees it, and not later in the timer.
            try:
                self._frame(message_from(self.message_class, msg, fields, "msg"))
            except SerializationError as error:
                raise error.locate(self.type, f"on {self.name}")  # noqa: B904 - the same error
        else:
            check_takes(msg, f"publisher {self.name}: the function that makes messages", "the time")

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
                pass  # the publisher was closed while this waited

        context = self._context
        timer = Timer(context.clock, context.spawn_user, context.user_error, period, publish)
        self._timers.add(timer)
        return timer

    async def drain(self, *, timeout: float | None = None) -> None:
        """Wait until the operating system has taken everything published so far.

        Raises :class:`TimeoutError` after ``timeout`` seconds, and
        :class:`~aioros1.ClosedError`.
        """
        self._check_open()
        await self._wait_until(
            lambda: self._publication.is_drained, timeout, "a subscriber did not take all"
        )

    async def wait_for_subscribers(self, n: int = 1, *, timeout: float | None = None) -> None:
        """Wait until ``n`` subscribers are connected.

        Raises :class:`TimeoutError` after ``timeout`` seconds, whose text says what is in the
        way, and :class:`~aioros1.ClosedError`.
        """
        self._check_open()
        publication = self._publication
        what = f"{n} subscribers did not connect"
        hint = Hint(self._context, "subscribers", self.name, lambda: publication.obstacle, timeout)
        with hint:
            await self._wait_until(lambda: self.subscriber_count >= n, timeout, what, hint)

    async def _wait_until(
        self, predicate: Any, timeout: float | None, what: str, why: object = ""
    ) -> None:
        waiters = self._publication.changed
        async with deadline(timeout, f"publisher {self.name}: {what}") as limit:
            limit.why = why
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
                pass  # no header: the encoder raises
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
    """Return the encoder from messages to frames: in parts, where copying would cost more."""
    codec = codec_of(cls)
    if not codec.has_bulk:
        return codec.frame
    in_parts = codec.frame_parts

    def encode(message: Any) -> Frame:
        parts = in_parts(message)
        return parts if len(parts) > 1 else bytes(parts[0])

    return encode
