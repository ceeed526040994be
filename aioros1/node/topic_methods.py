"""Topics, as a node uses them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Literal, TypeVar, overload

from aioros1.core.role import Opening
from aioros1.idl import Message
from aioros1.options import Overflow
from aioros1.topics.publisher import Publisher, PublisherOptions
from aioros1.topics.subscriber import Subscriber, SubscriberOptions
from aioros1.waiting import deadline

if TYPE_CHECKING:
    from aioros1.idl.genpy_types import GenpyMessage
    from aioros1.idl.message import AnyMessage
    from aioros1.node.node_roles import Roles

__all__ = ["TopicCalls"]

M = TypeVar("M", bound=Message)


class TopicCalls(ABC):
    """The part of :class:`Node` that is about topics."""

    _roles: Roles

    @abstractmethod
    def resolve_name(self, name: str) -> str: ...

    @overload
    def advertise(
        self,
        topic: str,
        type: type[M],
        *,
        latch: bool = False,
        queue_size: int = 10,
        overflow: Overflow = "drop_oldest",
        tcp_nodelay: bool = False,
        headers: Mapping[str, str] | None = None,
    ) -> Opening[Publisher[M]]: ...
    @overload
    def advertise(
        self,
        topic: str,
        type: str | type[GenpyMessage],
        *,
        latch: bool = False,
        queue_size: int = 10,
        overflow: Overflow = "drop_oldest",
        tcp_nodelay: bool = False,
        headers: Mapping[str, str] | None = None,
    ) -> Opening[Publisher[Any]]: ...
    def advertise(
        self,
        topic: str,
        type: Any,
        *,
        latch: bool = False,
        queue_size: int = 10,
        overflow: Overflow = "drop_oldest",
        tcp_nodelay: bool = False,
        headers: Mapping[str, str] | None = None,
    ) -> Opening[Publisher[Any]]:
        """Open a publisher; see :class:`PublisherOptions` for the options.

        ``type`` is a message class, ours or genpy's, or ``"pkg/Type"``. Several
        publishers of one topic in one node look like one to the others. Raises
        :class:`~aioros1.MasterError`, :class:`~aioros1.MessageError`,
        :class:`~aioros1.InvalidNameError`, :class:`~aioros1.ClosedError`.
        """
        options = PublisherOptions(
            latch=latch,
            queue_size=queue_size,
            overflow=overflow,
            tcp_nodelay=tcp_nodelay,
            headers=headers,
        )
        return Opening(self._roles.advertise(topic, type, options))

    @overload
    def subscribe(
        self,
        topic: str,
        type: type[M],
        *,
        queue_size: int = 10,
        overflow: Overflow = "drop_oldest",
        tcp_nodelay: bool = True,
        raw: Literal[False] = False,
        views: bool = False,
    ) -> Opening[Subscriber[M]]: ...
    @overload
    def subscribe(
        self,
        topic: str,
        type: type[Message] | type[GenpyMessage] | str = "*",
        *,
        queue_size: int = 10,
        overflow: Overflow = "drop_oldest",
        tcp_nodelay: bool = True,
        raw: Literal[True],
        views: bool = False,
    ) -> Opening[Subscriber[bytes]]: ...
    @overload
    def subscribe(
        self,
        topic: str,
        type: Literal["*"] = "*",
        *,
        queue_size: int = 10,
        overflow: Overflow = "drop_oldest",
        tcp_nodelay: bool = True,
        raw: Literal[False] = False,
        views: bool = False,
    ) -> Opening[Subscriber[AnyMessage]]: ...
    @overload
    def subscribe(
        self,
        topic: str,
        type: type[Message] | type[GenpyMessage] | str = "*",
        *,
        queue_size: int = 10,
        overflow: Overflow = "drop_oldest",
        tcp_nodelay: bool = True,
        raw: bool = False,
        views: bool = False,
    ) -> Opening[Subscriber[Any]]: ...
    def subscribe(
        self,
        topic: str,
        type: Any = "*",
        *,
        queue_size: int = 10,
        overflow: Overflow = "drop_oldest",
        tcp_nodelay: bool = True,
        raw: bool = False,
        views: bool = False,
    ) -> Opening[Subscriber[Any]]:
        """Open a subscriber; see :class:`SubscriberOptions` for the options.

        ``type`` is as for :meth:`advertise`, or ``"*"``: messages are then decoded as
        each publisher defines them. Raises as :meth:`advertise` does.
        """
        options = SubscriberOptions(
            queue_size=queue_size,
            overflow=overflow,
            tcp_nodelay=tcp_nodelay,
            raw=raw,
            views=views,
        )
        return Opening(self._roles.subscribe(topic, type, options))

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
        """The next message of a topic.

        Raises :class:`TimeoutError` after ``timeout`` seconds, and as :meth:`subscribe`.
        """
        async with (
            deadline(timeout, f"no message on {self.resolve_name(topic)}"),
            self.subscribe(topic, type, queue_size=1, overflow="drop_newest") as subscriber,
        ):
            return await subscriber.get()
