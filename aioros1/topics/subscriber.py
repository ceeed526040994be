"""Receiving a topic."""

from __future__ import annotations

import asyncio
import functools
import inspect
from collections import deque
from collections.abc import AsyncIterator, Awaitable, Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Generic, Self, TypeVar

from aioros1._public import public
from aioros1.connection import ConnectionInfo
from aioros1.core.context import Context
from aioros1.core.obstacles import Hint
from aioros1.core.role import Role
from aioros1.errors import DeserializationError
from aioros1.idl import Message
from aioros1.idl.codec import codec_of
from aioros1.net.topic_links import IncomingLink, Received
from aioros1.time import Time
from aioros1.topics.decoding import Decoder, decoder_for
from aioros1.topics.options import SubscriberOptions
from aioros1.topics.subscription import Subscription
from aioros1.waiting import Waiters, deadline

__all__ = ["Callback", "MessageEvent", "Subscriber"]

M = TypeVar("M")

Callback = Callable[[Any], object] | Callable[[Any], Awaitable[object]]
"""A function or a coroutine function that takes a message."""


@public
@dataclass(frozen=True, slots=True)
class MessageEvent(Generic[M]):
    """A message, its sender and its time of receipt."""

    message: M
    """The message itself."""
    header: Mapping[str, str] = field(repr=False)
    """The connection header of the publisher; ``header["callerid"]`` is its name."""
    received: Time
    """When the message was read from the socket, by the node's clock."""
    raw: bytes = field(repr=False)
    """The serialised message."""


@public
class Subscriber(Role, Generic[M]):
    """Receives messages of a topic; made by :meth:`aioros1.Node.subscribe`.

    It has one queue. The publishers' connections fill it, and you empty it by iterating or
    with :meth:`get` and :meth:`get_nowait`; each message is handed out once. Messages are
    decoded when you take them, so a dropped message costs nothing. A message that cannot be
    decoded is logged, counted in ``stats.errors`` and skipped.

    With a callback there is nothing to iterate. A plain function is called as soon as a
    message arrives, without the queue. A coroutine function takes messages from the queue
    and is awaited for each, in order, in a task of the node. ``on_error`` of the node decides
    what happens to its exceptions. A callback may close the subscriber: it gets no further
    messages then, and an ``async def`` callback runs to its end.
    """

    kind = "subscriber"
    _factory = "subscribe"

    def __init__(
        self,
        context: Context,
        subscription: Subscription,
        message_class: type[Message] | None,
        callback: Callback | None,
        options: SubscriberOptions,
        *,
        warns: bool = True,
    ) -> None:
        super().__init__(context, subscription.name)
        self.options = options
        """The options it was opened with."""
        self.message_class = message_class
        """The class of its messages; None for a subscriber to any type."""
        self.callback = callback
        """The callback for each message; None if you take the messages yourself."""
        self._warns = warns  # of the first message that is dropped
        self._subscription = subscription
        self._md5sum = "*" if message_class is None else message_class._md5sum
        self._decode: Decoder = decoder_for(
            message_class, context.peer_definitions, raw=options.raw, views=options.views
        )
        # The codec itself where there is no choice, which saves a call for each message.
        self._decode_bytes: Callable[[bytes, int, int], Any] | None = None
        if message_class is not None and not options.raw and not options.views:
            self._decode_bytes = codec_of(message_class).decode
        self._queue: deque[Received] = deque()
        self._newest: Received | None = None
        self._arrived = Waiters()
        self._on_arrival: tuple[Callable[[], object], ...] = ()
        # With overflow="block": frames read from a socket before it could be paused, in
        # order, and how many of them have been handled.
        self._backlog: deque[tuple[IncomingLink, list[Received], int]] = deque()
        self._awaits = callback is not None and _is_coroutine_function(callback)
        self._at_once = None if self._awaits else callback

    def _begin(self) -> None:
        """Start the task for a coroutine callback, once the subscriber is open."""
        if self._awaits:
            name = f"callback of subscriber {self.name}"
            self._context.spawn_user(self._take_all, name=name, until="closing")

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
        """How many messages wait in the queue, ``options.queue_size`` at most."""
        return len(self._queue)

    @property
    def dropped(self) -> int:
        """How many messages were dropped so far because the queue was full."""
        return self.stats.dropped

    @property
    def next_received(self) -> Time | None:
        """When the next message in the queue was received; None while the queue is empty."""
        if not self._queue and self._backlog:
            self._refill()
        return Time.from_nsec(self._queue[0][0].received) if self._queue else None

    @property
    def latest(self) -> M | None:
        """The newest message received, taken from the queue or not; None before the first.

        Raises :class:`~aioros1.DeserializationError` if it cannot be decoded.
        """
        if self._newest is None:
            return None
        message: M = self._decode(self._newest)
        return message

    @property
    def latest_event(self) -> MessageEvent[M] | None:
        """The same as :attr:`latest`, with the time of receipt and the sender."""
        return None if self._newest is None else self._event(self._newest)

    async def wait_for_publishers(self, n: int = 1, *, timeout: float | None = None) -> None:
        """Wait until ``n`` publishers are connected.

        Raises :class:`TimeoutError` after ``timeout`` seconds, whose text says what is in the
        way, and :class:`~aioros1.ClosedError`.
        """
        self._check_open()
        subscription = self._subscription
        what = f"subscriber {self.name}: {n} publishers did not connect"
        obstacle = subscription.obstacle.__str__
        async with deadline(timeout, what) as limit:
            with Hint(self._context, "publishers", self.name, obstacle, timeout) as limit.why:
                while self.publisher_count < n:
                    await subscription.changed.wait()
                    self._check_open()

    async def wait_for_messages(self, n: int = 1, *, timeout: float | None = None) -> None:
        """Wait until ``n`` messages are in the queue, without taking any.

        Raises :class:`ValueError` for more than ``queue_size``, :class:`TimeoutError` after
        ``timeout`` seconds, and :class:`~aioros1.ClosedError`.
        """
        self._check_queued()
        if not isinstance(n, int) or n < 1:
            raise ValueError(f"subscriber {self.name}: expected 1 message or more, got {n!r}")
        if n > self.options.queue_size:
            raise ValueError(
                f"subscriber {self.name}: {n} messages never fit into a queue of "
                f"{self.options.queue_size}"
            )
        async with deadline(timeout, f"subscriber {self.name}: {n} messages did not come"):
            while self.queued < n:
                if self._backlog:
                    self._refill()
                    continue
                await self._arrived.wait()
                self._check_open()

    def add_arrival_callback(self, function: Callable[[], object]) -> None:
        """Call ``function()`` whenever messages enter the queue, and when the subscriber is
        closed.

        The event loop calls it as messages arrive: it has to return soon and must not raise.
        Use it to wait for several subscribers at a time.
        """
        self._context.check_loop()
        self._on_arrival += (function,)

    def remove_arrival_callback(self, function: Callable[[], object]) -> None:
        """Stop calling ``function``. Does nothing if it was not added."""
        self._on_arrival = tuple(each for each in self._on_arrival if each != function)

    # taking messages

    def __aiter__(self) -> Self:
        self._check_queued()
        self._context.check_iterator()
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
        """Wait for the next message and take it.

        Raises :class:`TimeoutError` after ``timeout`` seconds, and
        :class:`~aioros1.ClosedError`. Cancelling it loses no message.
        """
        if timeout is not None:
            async with deadline(timeout, f"subscriber {self.name}: no message came") as limit:
                limit.why = self._subscription.obstacle
                return await self.get()
        if self.callback is not None:
            self._check_queued()
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
        """Take the next message. Raises :class:`asyncio.QueueEmpty` if there is none."""
        self._check_open()
        self._check_queued()
        while (item := self._take()) is not None:
            try:
                message: M = self._decode(item)
            except DeserializationError as error:
                self._skip(error)
            else:
                return message
        raise asyncio.QueueEmpty(f"subscriber {self.name}: no message has come")

    def peek(self) -> MessageEvent[M] | None:
        """Look at the next message without taking it; None while the queue is empty."""
        self._check_queued()
        if not self._queue and self._backlog:
            self._refill()
        while self._queue:
            try:
                return self._event(self._queue[0])
            except DeserializationError as error:
                self._queue.popleft()
                self._skip(error)
        return None

    def events(self) -> AsyncIterator[MessageEvent[M]]:
        """Iterate like the subscriber itself, but over :class:`MessageEvent` objects."""
        self._check_queued()
        self._context.check_iterator()
        return _Events(self)

    async def _next_event(self) -> MessageEvent[M]:
        while (item := await self._next_item()) is not None:
            try:
                return self._event(item)
            except DeserializationError as error:
                self._skip(error)
        raise StopAsyncIteration

    async def _next_item(self) -> Received | None:
        """Wait for a message and take it. None once the subscriber is closed."""
        while (item := self._take()) is None and self._is_open:
            await self._arrived.wait()
        return item

    def _event(self, item: Received) -> MessageEvent[M]:
        batch, start, stop = item
        return MessageEvent(
            self._decode(item),
            batch.link.info.header,
            Time.from_nsec(batch.received),
            bytes(batch.data[start:stop]),
        )

    def _check_queued(self) -> None:
        if self.callback is not None:
            raise TypeError(f"subscriber {self.name} has a callback, which gets all messages")

    def _take(self) -> Received | None:
        if not self._queue and self._backlog:
            self._refill()
        return self._queue.popleft() if self._queue else None

    def _skip(self, error: DeserializationError) -> None:
        self.stats.errors += 1
        # Warn once only: a publisher may send nothing but messages that cannot be decoded.
        log = self._context.log.warning if self.stats.errors == 1 else self._context.log.debug
        log("subscriber %s: a message was skipped: %s", self.name, error)

    # being filled

    def _offer(self, frames: list[Received]) -> None:
        """Take frames from a connection; drop or hold back what does not fit the queue."""
        batch, _, stop = frames[-1]
        link = batch.link
        if link.offer.md5sum != self._md5sum and "*" not in (self._md5sum, link.offer.md5sum):
            return  # another subscriber takes any type, and this publisher's is not ours
        stats = self.stats
        stats.messages += len(frames)
        stats.bytes += stop - frames[0][1] + 4
        self._newest = frames[-1]
        if self._at_once is not None:
            self._call(self._at_once, frames)
            return
        queue, size = self._queue, self.options.queue_size
        room = size - len(queue)
        if len(frames) <= room and not self._backlog:
            queue.extend(frames)
        elif self.options.overflow == "drop_oldest":
            if not stats.dropped:
                self._first_drop(len(frames) - room)
            stats.dropped += len(frames) - room
            if len(frames) >= size:
                queue.clear()
                queue.extend(frames[-size:])
            else:
                for _ in range(len(frames) - room):
                    queue.popleft()
                queue.extend(frames)
        elif self.options.overflow == "drop_newest":
            if not stats.dropped:
                self._first_drop(len(frames) - room)
            stats.dropped += len(frames) - room
            queue.extend(frames[:room])
        else:
            link.pause()
            self._backlog.append((link, frames, 0))
            self._refill()
        self._arrived.wake()
        for function in self._on_arrival:
            function()

    def _first_drop(self, count: int) -> None:
        if self._warns:
            self._context.log.warning(
                "subscriber %s: %s dropped, because they are not taken as fast as they come and "
                "the queue is full (queue_size=%s, overflow=%s). A larger queue_size helps with "
                'bursts, overflow="block" makes the publishers wait. Further drops are only '
                "counted, in `dropped`",
                *(self.name, "a message was" if count == 1 else f"{count} messages were"),
                *(self.options.queue_size, repr(self.options.overflow)),
            )

    def _refill(self) -> None:
        """Move the backlog into the queue, and resume connections that have none left."""
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

    # the callback

    def _call(self, callback: Callback, frames: list[Received]) -> None:
        """Call a plain function with each message."""
        decode = self._decode
        for item in frames:
            if not self._is_open:
                return  # it was closed from within
            try:
                message = decode(item)
            except DeserializationError as error:
                self._skip(error)
                continue
            try:
                result = callback(message)
                if result is not None and inspect.isawaitable(result):
                    _refuse(result)
            except BaseException as error:
                self._failed(error)

    async def _take_all(self) -> None:
        """Await a coroutine function for each message."""
        callback: Any = self.callback
        task = asyncio.current_task()
        assert task is not None
        # A callback may have caught its cancellation.
        while not task.cancelling() and (item := await self._next_item()) is not None:
            try:
                message = self._decode(item)
            except DeserializationError as error:
                self._skip(error)
                continue
            try:
                await callback(message)
            except BaseException as error:
                self._failed(error)

    def _failed(self, error: BaseException) -> None:
        """Handle an exception of the callback; other subscribers must not notice it."""
        self._context.user_error(error, f"the callback of subscriber {self.name}")

    # the end

    def _abort(self) -> None:
        super()._abort()
        self._wake_all()
        self._subscription.changed.wake()

    async def _close(self) -> None:
        self._queue.clear()
        while self._backlog:
            self._backlog.popleft()[0].resume()
        self._wake_all()
        await self._subscription.leave(self)

    def _wake_all(self) -> None:
        self._arrived.wake()
        for function in self._on_arrival:
            function()


class _Events(Generic[M]):
    """The iterator of :meth:`Subscriber.events`; it takes from the subscriber's queue."""

    def __init__(self, subscriber: Subscriber[M]) -> None:
        self._subscriber = subscriber

    def __aiter__(self) -> Self:
        return self

    async def __anext__(self) -> MessageEvent[M]:
        return await self._subscriber._next_event()

    def __repr__(self) -> str:
        return f"<events of {self._subscriber!r}>"


def _is_coroutine_function(callback: Callable[..., object]) -> bool:
    while isinstance(callback, functools.partial):
        callback = callback.func
    if isinstance(callback, type):
        return False  # calling it makes an instance, awaitable or not
    call = getattr(callback, "__call__", None)  # noqa: B004 - for a callable object
    return inspect.iscoroutinefunction(callback) or inspect.iscoroutinefunction(call)


def _refuse(result: Awaitable[object]) -> None:
    if inspect.iscoroutine(result):
        result.close()  # Python warns about a coroutine that is never awaited
    raise TypeError(
        f"a plain function returned an awaitable, {result!r:.100}: nobody awaits it; make the "
        "callback `async def`"
    )
