"""The topic methods of a node."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Mapping
from typing import Any, Literal, TypedDict, TypeVar, Unpack, overload

from aioros1.core.contact import Contact
from aioros1.core.opening import Opening
from aioros1.hints import check_takes, explained, methods_of
from aioros1.idl import Message
from aioros1.idl.genpy_types import GenpyMessage
from aioros1.idl.message import AnyMessage
from aioros1.options import DEFAULT_QUEUE_SIZE, Overflow
from aioros1.topics.options import PublisherOptions, SubscriberOptions
from aioros1.topics.publisher import Publisher
from aioros1.topics.subscriber import Subscriber
from aioros1.topics.topics import Topics

__all__ = ["TopicMethods"]

M = TypeVar("M", bound=Message)


class _PublisherKeywords(TypedDict, total=False):
    latch: bool
    queue_size: int
    overflow: Overflow
    tcp_nodelay: bool
    headers: Mapping[str, str] | None


class _SubscriberKeywords(TypedDict, total=False):
    queue_size: int
    overflow: Overflow
    tcp_nodelay: bool
    views: bool


@methods_of("Node")
class TopicMethods:
    """The topic methods of :class:`~aioros1.Node`."""

    _contact: Contact
    _topics: Topics

    @overload
    def advertise(
        self, topic: str, type: type[M], **options: Unpack[_PublisherKeywords]
    ) -> Opening[Publisher[M]]: ...
    @overload
    def advertise(
        self, topic: str, type: str | type[GenpyMessage], **options: Unpack[_PublisherKeywords]
    ) -> Opening[Publisher[Any]]: ...
    @explained
    def advertise(
        self,
        topic: str,
        type: Any,
        *,
        latch: bool = False,
        queue_size: int = DEFAULT_QUEUE_SIZE,
        overflow: Overflow = "drop_oldest",
        tcp_nodelay: bool = False,
        headers: Mapping[str, str] | None = None,
    ) -> Opening[Publisher[Any]]:
        """Open a publisher; see :class:`~aioros1.PublisherOptions` for the options.

        ``type`` is a message class, ours or genpy's, or ``"pkg/Type"``. Other nodes see
        several publishers of one topic in this node as one. Raises
        :class:`~aioros1.MasterError`, :class:`~aioros1.MessageError`,
        :class:`~aioros1.InvalidNameError` and :class:`~aioros1.ClosedError`.
        """
        options = PublisherOptions(
            latch=latch,
            queue_size=queue_size,
            overflow=overflow,
            tcp_nodelay=tcp_nodelay,
            headers=headers,
        )
        opening = self._topics.advertise(topic, type, options, self._contact.policy)
        return Opening(opening, "advertise", f"publisher {topic}")

    @overload
    def subscribe(
        self,
        topic: str,
        type: type[M],
        callback: Callable[[M], object] | Callable[[M], Awaitable[object]] | None = None,
        *,
        raw: Literal[False] = False,
        **options: Unpack[_SubscriberKeywords],
    ) -> Opening[Subscriber[M]]: ...
    @overload
    def subscribe(
        self,
        topic: str,
        type: type[Message] | type[GenpyMessage] | str = "*",
        callback: Callable[[bytes], object] | Callable[[bytes], Awaitable[object]] | None = None,
        *,
        raw: Literal[True],
        **options: Unpack[_SubscriberKeywords],
    ) -> Opening[Subscriber[bytes]]: ...
    @overload
    def subscribe(
        self,
        topic: str,
        type: Literal["*"] = "*",
        callback: (
            Callable[[AnyMessage], object] | Callable[[AnyMessage], Awaitable[object]] | None
        ) = None,
        *,
        raw: Literal[False] = False,
        **options: Unpack[_SubscriberKeywords],
    ) -> Opening[Subscriber[AnyMessage]]: ...
    @overload
    def subscribe(
        self,
        topic: str,
        type: type[GenpyMessage] | str = "*",
        callback: Callable[[Any], object] | Callable[[Any], Awaitable[object]] | None = None,
        *,
        raw: bool = False,
        **options: Unpack[_SubscriberKeywords],
    ) -> Opening[Subscriber[Any]]: ...
    @overload
    def subscribe(
        self,
        topic: str,
        type: type[Message],
        callback: Callable[[Any], object] | Callable[[Any], Awaitable[object]] | None = None,
        *,
        raw: bool,
        **options: Unpack[_SubscriberKeywords],
    ) -> Opening[Subscriber[Any]]: ...
    @explained
    def subscribe(
        self,
        topic: str,
        type: Any = "*",
        callback: Callable[[Any], object] | Callable[[Any], Awaitable[object]] | None = None,
        *,
        queue_size: int = DEFAULT_QUEUE_SIZE,
        overflow: Overflow = "drop_oldest",
        tcp_nodelay: bool = True,
        raw: bool = False,
        views: bool = False,
    ) -> Opening[Subscriber[Any]]:
        """Open a subscriber; see :class:`~aioros1.SubscriberOptions` for the options.

        ``type`` is as for :meth:`advertise`, or ``"*"`` to decode messages as each publisher
        defines them. ``callback`` takes each message, instead of an iteration: a plain
        function is called as the message arrives, a coroutine function is awaited message
        by message; see :class:`~aioros1.Subscriber`. Latched messages come first.

        Raises as :meth:`advertise` does, and :class:`TypeError` for a callback that cannot
        be called.
        """
        options = SubscriberOptions(
            queue_size=queue_size,
            overflow=overflow,
            tcp_nodelay=tcp_nodelay,
            raw=raw,
            views=views,
        )
        if callback is not None:
            what = "the serialised message" if raw else "the message"
            check_takes(callback, f"subscriber {topic}: the callback", what)
        opening = self._topics.subscribe(topic, type, callback, options, self._contact.policy)
        return Opening(opening, "subscribe", f"subscriber {topic}")

    @overload
    async def wait_for_message(
        self, topic: str, type: type[M], *, timeout: float | None = None
    ) -> M: ...
    @overload
    async def wait_for_message(
        self, topic: str, type: Literal["*"] = "*", *, timeout: float | None = None
    ) -> AnyMessage: ...
    @overload
    async def wait_for_message(
        self, topic: str, type: str | type[GenpyMessage], *, timeout: float | None = None
    ) -> Any: ...
    async def wait_for_message(
        self, topic: str, type: Any = "*", *, timeout: float | None = None
    ) -> Any:
        """Return the next message of a topic.

        Raises :class:`TimeoutError` after ``timeout`` seconds, and as :meth:`subscribe` does.
        """
        return await self._topics.wait_for_message(topic, type, timeout)
