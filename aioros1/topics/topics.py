"""All topics of one node."""

from __future__ import annotations

from typing import Any

from aioros1.core.context import Context
from aioros1.core.obstacles import Hint
from aioros1.errors import HandshakeError
from aioros1.net.local_transports import LocalTransports
from aioros1.net.tcpros import Stream
from aioros1.options import WithoutMaster
from aioros1.quoting import printable
from aioros1.topics.options import PublisherOptions, SubscriberOptions
from aioros1.topics.publication import Publication
from aioros1.topics.publisher import Publisher
from aioros1.topics.subscriber import Callback, Subscriber
from aioros1.topics.subscription import OnReceived, Subscription
from aioros1.waiting import deadline
from aioros1.wire.handshake import Server

__all__ = ["NotPublishedError", "Topics"]


_REMEMBERED = 1_000
"""Topics of a node that are known to be closed when somebody comes for them."""


class NotPublishedError(HandshakeError):
    """A subscriber came for a topic that is not published any more. The master is about to tell
    it so, and this is no news to anybody else."""


class Topics:
    """The topics that a node publishes and subscribes to.

    ``local`` holds the transports other than TCP that subscriptions may use.
    """

    def __init__(self, context: Context, local: LocalTransports) -> None:
        self.publications: dict[str, Publication] = {}
        self._were_published: set[str] = set()  # some names that were published at any time
        """By topic, for as long as a publisher uses them."""
        self.subscriptions: dict[str, Subscription] = {}
        """By topic, for as long as a subscriber uses them."""
        self._context = context
        self._local = local
        self._on_received: OnReceived | None = None

    async def advertise(
        self,
        topic: str,
        type: Any,
        options: PublisherOptions,
        without_master: WithoutMaster = "raise",
        *,
        warns: bool = True,
    ) -> Publisher[Any]:
        """See :meth:`aioros1.Node.advertise`. ``warns`` of the first message that is dropped."""
        context = self._context
        context.check_open()
        topic = context.resolve_name(topic)
        message_class = context.store.resolve_msg(type)
        publication = self.publications.get(topic)
        if publication is not None:
            publication.check_type(message_class)
        # A publication whose publishers are closing can be reused, but not for another type.
        if publication is None or publication.message_class._md5sum != message_class._md5sum:
            publication = Publication(context, topic, self.publications, message_class)
        publisher: Publisher[Any] = Publisher(
            context, publication, message_class, options, warns=warns
        )
        if len(self._were_published) < _REMEMBERED:
            self._were_published.add(topic)
        await publication.acquire(publisher, without_master)
        return await context.admit(publisher, publisher._abort)

    async def subscribe(
        self,
        topic: str,
        type: Any,
        callback: Callback | None,
        options: SubscriberOptions,
        without_master: WithoutMaster = "raise",
        *,
        warns: bool = True,
    ) -> Subscriber[Any]:
        """See :meth:`aioros1.Node.subscribe`. ``warns`` of the first message that is dropped."""
        context = self._context
        context.check_open()
        topic = context.resolve_name(topic)
        any_type = type == "*" or getattr(type, "_type", None) == "*"
        message_class = None if any_type else context.store.resolve_msg(type)
        subscription = self.subscriptions.get(topic)
        if subscription is None:
            subscription = Subscription(context, topic, self.subscriptions, self._local)
            subscription.on_received = self._on_received
        if message_class is not None:
            subscription.check_type(message_class)
        subscriber: Subscriber[Any] = Subscriber(
            context, subscription, message_class, callback, options, warns=warns
        )
        await subscription.acquire(subscriber, without_master)
        await context.admit(subscriber, subscriber._abort)
        subscriber._begin()
        return subscriber

    async def wait_for_message(self, topic: str, type: Any, timeout: float | None) -> Any:
        """See :meth:`aioros1.Node.wait_for_message`."""
        context = self._context
        options = SubscriberOptions(queue_size=1, overflow="drop_newest")
        name = context.resolve_name(topic)
        async with deadline(timeout, f"no message on {name}") as limit:
            limit.why = context.contact.obstacle
            async with await self.subscribe(
                topic, type, None, options, context.contact.policy, warns=False
            ) as subscriber:
                obstacle = subscriber._subscription.obstacle
                with Hint(context, "publishers", name, obstacle.__str__, timeout) as limit.why:
                    return await subscriber.get()

    async def serve(self, stream: Stream, server: Server) -> None:
        """Serve a subscriber that has connected; ``server`` holds its header.

        Raises :class:`~aioros1.HandshakeError` and :class:`ConnectionError`.
        """
        publication = self.published(server.topic or "")
        if publication is None:
            name = self._context.name
            topic = printable(server.topic)
            was_published = server.topic in self._were_published
            refusal = NotPublishedError if was_published else HandshakeError
            raise refusal(server.peer, f"{name} does not publish {topic}")
        await publication.serve(stream, server)

    def watch(self, on_received: OnReceived) -> None:
        """Call ``on_received`` with everything received on any topic."""
        self._on_received = on_received
        for subscription in self.subscriptions.values():
            subscription.on_received = on_received

    def published(self, topic: str) -> Publication | None:
        """The publication of a topic, from its first publisher until the last one is
        unregistered at the master."""
        return self.publications.get(topic)

    def abort(self) -> None:
        """Drop all connections at once."""
        for publication in self.publications.values():
            publication.abort()
        for subscription in self.subscriptions.values():
            subscription.abort()
