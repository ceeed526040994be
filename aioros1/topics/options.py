"""Options of publishers and subscribers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from aioros1._public import public
from aioros1.hints import check_kinds
from aioros1.options import DEFAULT_QUEUE_SIZE, Overflow, check_queue

__all__ = ["PublisherOptions", "SubscriberOptions"]

_FLAG = (bool, "True or False")


@public
@dataclass(frozen=True, slots=True, kw_only=True)
class PublisherOptions:
    """Options of a publisher; the defaults are those of :meth:`aioros1.Node.advertise`."""

    latch: bool = False
    """Keep the last message, and send it to every subscriber that connects later."""

    queue_size: int = DEFAULT_QUEUE_SIZE
    """How many messages may wait for one subscriber whose connection is full."""

    overflow: Overflow = "drop_oldest"
    """Which message is dropped when that queue is full; ``block`` drops none."""

    tcp_nodelay: bool = False
    """Has no effect: small messages are always sent at once."""

    headers: Mapping[str, str] | None = field(default=None)
    """Extra fields for the connection header that subscribers receive."""

    def __post_init__(self) -> None:
        headers = (Mapping | None, "a mapping of str to str or None")
        check_kinds(self, {"latch": _FLAG, "tcp_nodelay": _FLAG, "headers": headers})
        check_queue(self.queue_size, self.overflow)


@public
@dataclass(frozen=True, slots=True, kw_only=True)
class SubscriberOptions:
    """Options of a subscriber; the defaults are those of :meth:`aioros1.Node.subscribe`."""

    queue_size: int = DEFAULT_QUEUE_SIZE
    """How many messages may wait in the queue."""

    overflow: Overflow = "drop_oldest"
    """Which message is dropped when that queue is full; ``block`` drops none, and stops
    reading the publishers' connections until there is room."""

    tcp_nodelay: bool = True
    """Ask publishers to send small messages at once."""

    raw: bool = False
    """Hand out messages serialised, as ``bytes``."""

    views: bool = False
    """Hand out numeric arrays and ``uint8[]`` as memoryviews of the received bytes,
    without copying them."""

    def __post_init__(self) -> None:
        check_kinds(self, {"tcp_nodelay": _FLAG, "raw": _FLAG, "views": _FLAG})
        check_queue(self.queue_size, self.overflow)
