"""How publishers and subscribers are opened."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from aioros1._public import public
from aioros1.options import DEFAULT_QUEUE_SIZE, Overflow, check_queue

__all__ = ["PublisherOptions", "SubscriberOptions"]


@public
@dataclass(frozen=True, slots=True, kw_only=True)
class PublisherOptions:
    """How a publisher was opened; the defaults are those of :meth:`aioros1.Node.advertise`."""

    latch: bool = False
    """Keep the last message, and send it to every subscriber that connects later."""

    queue_size: int = DEFAULT_QUEUE_SIZE
    """Messages that may wait for one subscriber whose connection takes no more."""

    overflow: Overflow = "drop_oldest"
    """Which message goes when that queue is full; with ``block`` none does."""

    tcp_nodelay: bool = False
    """Kept for the record: small messages are never held back, whatever this says."""

    headers: Mapping[str, str] | None = field(default=None)
    """Additional fields of the connection header that subscribers get."""

    def __post_init__(self) -> None:
        check_queue(self.queue_size, self.overflow)


@public
@dataclass(frozen=True, slots=True, kw_only=True)
class SubscriberOptions:
    """How a subscriber was opened; the defaults are those of :meth:`aioros1.Node.subscribe`."""

    queue_size: int = DEFAULT_QUEUE_SIZE
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
