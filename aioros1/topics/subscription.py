"""A topic that a node receives: a connection to each of its publishers.

The subscribers of one topic in one node share a :class:`Subscription`, and with it one
connection per publisher. Each publisher has a task of its own, so one that hangs delays
no other. The task asks the publisher how to connect, connects, and tries again, with
growing delays, for as long as the master lists that publisher.
"""

from __future__ import annotations

import asyncio
import builtins
from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Protocol

from aioros1.connection import ConnectionInfo
from aioros1.core.context import Context
from aioros1.core.shared import Shared
from aioros1.errors import ClosedError, HandshakeError, Md5MismatchError, PeerError
from aioros1.log.library_log import ROSOUT
from aioros1.net.backoff import Backoff
from aioros1.net.local_transports import LocalTransports
from aioros1.net.tcpros import Stream, connect, connection_info, take_over
from aioros1.net.topic_links import IncomingLink, Received
from aioros1.quoting import printable
from aioros1.waiting import Obstacle, Waiters
from aioros1.wire.handshake import TopicClient, TopicOffer
from aioros1.wire.http import MAX_URI
from aioros1.xmlrpc.node_proxy import NodeProxy

if TYPE_CHECKING:
    from aioros1.idl import Message
    from aioros1.topics.options import SubscriberOptions

__all__ = ["OnReceived", "Subscription"]

_GRACE = 1.0
"""Seconds without a byte after which we close the connection to a publisher that the
master no longer lists. A publisher that ends closes its connections itself, and its last
messages may still be on their way when the master announces that it is gone."""


_PER_TURN = 20
"""Publishers that are followed in one iteration of the event loop."""


class Subscribing(Protocol):
    """What a subscription needs of a subscriber."""

    options: SubscriberOptions

    @property
    def message_class(self) -> type[Message] | None: ...
    @property
    def type(self) -> str: ...
    @property
    def md5sum(self) -> str: ...
    @property
    def definition(self) -> str: ...
    @property
    def is_open(self) -> bool: ...

    def _offer(self, frames: list[Received]) -> None:
        """Take frames, all from one link."""


class Subscription(Shared[Subscribing]):
    """One subscribed topic of one node."""

    kind = "subscriber"

    def __init__(
        self,
        context: Context,
        topic: str,
        table: dict[str, Subscription],
        local: LocalTransports,
    ) -> None:
        super().__init__(context, topic, table)
        self.changed = Waiters()
        """Woken when a connection opens or closes."""
        self.on_received: OnReceived | None = None
        """Called with everything received, before the subscribers get it."""
        self.obstacle = Obstacle(self._in_the_way)
        """What keeps publishers from being connected; empty if all are."""
        self._local = local
        self._followers: dict[str, _Follower] = {}
        self._waiting: deque[str] = deque()  # publishers that are not followed yet
        self._follows_more = False
        self._links: tuple[IncomingLink, ...] = ()
        self._updates = 0

    @property
    def type(self) -> str:
        """The type that the subscribers agree on; ``*`` if none of them names one."""
        return next((sub.type for sub in self.roles if sub.type != "*"), "*")

    @property
    def connections(self) -> tuple[ConnectionInfo, ...]:
        """The connections to its publishers."""
        return tuple(link.info for link in self._links)

    @property
    def publisher_count(self) -> int:
        """How many publishers are connected."""
        return len(self._links)

    def _in_the_way(self) -> str:
        if complaints := [each.complaint for each in self._followers.values() if each.complaint]:
            more = f" (and {len(complaints) - 1} more)" if len(complaints) > 1 else ""
            return f"{complaints[0]}{more}"
        connecting = len(self._followers) - len(self._links)
        if connecting > 0:
            return f"publishers that were announced and are being connected: {connecting}"
        if self._links:
            return ""
        if not self.registration.is_established:
            return f"the master does not know of subscriber {self.name} yet"
        return "no publisher was announced"

    @property
    def has_header(self) -> bool:
        """Whether its messages begin with a header, as far as the subscribers know them."""
        classes = [sub.message_class for sub in self.roles]
        return any(cls is not None and cls._has_header for cls in classes)

    def check_type(self, message_class: builtins.type[Message]) -> None:
        """Raise :class:`~aioros1.Md5MismatchError` for a type other than the subscribers'.
        Subscribers to any type agree with every type."""
        for sub in self.roles:
            ours = sub.message_class
            if sub.is_open and ours is not None and ours._md5sum != message_class._md5sum:
                raise Md5MismatchError(
                    f"{self._context.name} subscribes to {self.name} as {ours._type} with "
                    f"md5sum {ours._md5sum} already, not as {message_class._type} with "
                    f"md5sum {message_class._md5sum}"
                )

    def wanted(self) -> TopicOffer:
        """The offer that we send to a publisher when we connect."""
        for sub in self.roles:
            if sub.type != "*":
                return TopicOffer(self.name, sub.type, sub.md5sum, sub.definition)
        return TopicOffer(self.name, "*", "*", "")

    # the publishers

    def update(self, uris: Iterable[str]) -> None:
        """Follow exactly the publishers that the master has announced."""
        self._updates += 1
        if not self.roles:
            return
        limit = self._context.limits.publishers
        # A dict, not a set: it keeps the master's order and drops duplicates.
        wanted = dict.fromkeys(uri for uri in uris if len(uri) <= MAX_URI)
        for uri in [uri for uri in self._followers if uri not in wanted]:
            self._followers[uri].leave()
        self._waiting.clear()
        for uri in wanted:
            follower = self._followers.get(uri)
            if follower is not None:
                follower.stay()
            elif len(self._waiting) < limit:
                self._waiting.append(uri)
        self._follow_some()

    def _follow_some(self) -> None:
        """Follow some of the publishers that wait; more of them in the next iteration."""
        context = self._context
        for _ in range(min(_PER_TURN, len(self._waiting))):
            if not context.dialling.admit():
                return  # until another has gone
            uri = self._waiting.popleft()
            follower = self._followers[uri] = _Follower(self, context, self._local, uri)
            try:
                what = f"{context.name} follows {self.name} of {printable(uri)}"
                follower.task = context.spawn(follower.run, name=what)
            except ClosedError:  # the node has ended meanwhile
                self._waiting.clear()
                self.follower_ended(uri)
        if self._waiting and not self._follows_more:
            self._follows_more = True
            context.loop_state.loop.call_soon(self._follow_more)

    def _follow_more(self) -> None:
        self._follows_more = False
        self._follow_some()

    def follower_ended(self, uri: str) -> None:
        """Forget the follower of ``uri``, which has ended."""
        if self._followers.pop(uri, None) is not None:
            self._context.dialling.leave()
            if self._waiting and not self._follows_more:
                self._follow_some()

    def link_opened(self, link: IncomingLink) -> None:
        """Add the connection to a publisher."""
        self._links += (link,)
        self._context.connections.add(self.kind, link, link.info)
        self.changed.wake()

    def link_closed(self, link: IncomingLink) -> None:
        """Remove the connection to a publisher."""
        self._links = tuple(other for other in self._links if other is not link)
        self._context.connections.remove(link, link.failure or "")
        self.changed.wake()

    def deliver(self, frames: list[Received]) -> None:
        """Give frames, all from one link, to every subscriber."""
        link = frames[-1][0].link
        if link.offer.latching:
            link.latched = frames[-1]
        if self.on_received is not None:
            self.on_received(self, frames)
        for sub in self.roles:
            sub._offer(frames)

    # the subscribers

    def _join(self, role: Subscribing) -> None:
        """Give a new subscriber what the connected publishers have latched."""
        super()._join(role)
        for link in self._links:
            if link.latched is not None:
                role._offer([link.latched])

    def _part(self, role: Subscribing) -> None:
        """Remove a subscriber; the last one takes the connections with it."""
        super()._part(role)
        self.changed.wake()
        if not self.roles:
            self.abort()

    def abort(self) -> None:
        """Drop all publishers at once."""
        self._waiting.clear()
        for follower in tuple(self._followers.values()):
            follower.cancel()
        self.changed.wake()

    # at the master

    async def _register(self) -> None:
        context = self._context
        updates = self._updates
        for follower in self._followers.values():
            follower.forgotten()
        uris = await context.registrar.register_subscriber(
            self.name, self.type, context.address.uri
        )
        # An announcement that overtook this answer is newer.
        if updates == self._updates:
            self.update(uris)

    async def _unregister(self) -> None:
        context = self._context
        await context.registrar.unregister_subscriber(self.name, context.address.uri)


OnReceived = Callable[[Subscription, list[Received]], None]


class _Follower:
    """Keeps one connection to one publisher."""

    def __init__(
        self, subscription: Subscription, context: Context, local: LocalTransports, uri: str
    ) -> None:
        self.task: asyncio.Task[None] | None = None
        self._subscription = subscription
        self._context = context
        self._local = local
        self._uri = uri
        self._link: IncomingLink | None = None
        self._stir = asyncio.Event()
        self._leaving = False
        self._was_forgotten = False
        self._tries_local = True
        self.complaint = ""
        """What went wrong last; empty if nothing has, or if a connection is open."""

    def stay(self) -> None:
        """Note that the master lists the publisher, perhaps again, and stop waiting."""
        self._leaving = False
        self._was_forgotten = False
        self._tries_local = True
        self._stir.set()

    def forgotten(self) -> None:
        """Judge by the connection alone whether the publisher lives, until it is listed again.

        This node registers again because the master was away or is a new one. Such a master
        lists only nodes that have registered again too, and rospy and roscpp never do.
        """
        self._was_forgotten = True

    def leave(self) -> None:
        """Note that the master no longer lists the publisher."""
        self._leaving = True
        if self._link is None:
            self.cancel()
        else:
            self._stir.set()

    def cancel(self) -> None:
        self._subscription.follower_ended(self._uri)
        if self.task is not None:
            self.task.cancel()

    async def run(self) -> None:
        backoff = Backoff()
        try:
            while not self._leaving:
                self._stir.clear()
                try:
                    await self._connect_and_receive(backoff)
                except (HandshakeError, PeerError, OSError, TimeoutError) as error:
                    self._complain(str(error))
                except Exception as error:  # a fault of ours must not cost the publisher
                    if self._context.loop_state.loop.is_closed():
                        raise  # Python ends the task, and nothing can be awaited
                    if repr(error) != self.complaint:
                        self.complaint = repr(error)
                        what = f"subscriber {self._subscription.name}: connecting to {self._uri}"
                        self._context.report(error, what)
                if not self._leaving:
                    await self._stirred(backoff.delay())
            self._subscription.follower_ended(self._uri)
        finally:
            if self._link is not None:
                self._link.abort()

    async def _connect_and_receive(self, backoff: Backoff) -> None:
        subscription = self._subscription
        async with self._context.dialling.slots:
            link = await self._connect()
        loop = asyncio.get_running_loop()
        begin = loop.time()
        self.complaint = ""
        try:
            await self._until_closed(link)
        finally:
            # Connecting alone does not count: we would ask a publisher that accepts and
            # then fails ten times a second for ever.
            lasted = loop.time() - begin > backoff.longest
            if link.info.stats.messages or lasted:
                backoff.reset()
            link.abort()
            self._link = None
            subscription.link_closed(link)
        if link.failure is not None:
            self._complain(link.failure)

    async def _connect(self) -> IncomingLink:
        """Connect in the way the publisher chooses; fall back to TCP if that fails."""
        context, local = self._context, self._local
        offers = local.offers() if self._tries_local else []
        answer = await self._request_topic([["TCPROS"], *offers])
        match answer:
            case ["TCPROS", str(host), int(port), *_] if 0 < port < 65536:
                return await self._shake_hands(await connect(host, port, context.timeouts))
        if not offers:
            raise PeerError(
                -1,
                f"requestTopic at {printable(self._uri)}: cannot use "
                f"{printable(repr(answer), 200)}",
            )
        try:
            return await self._shake_hands(await local.connect(answer))
        except (OSError, TimeoutError) as error:
            context.log.debug(
                "subscriber %s: publisher at %s: %s; trying TCP",
                *(self._subscription.name, self._uri, error),
            )
        self._tries_local = False
        return await self._connect()

    async def _request_topic(self, protocols: list[list[str]]) -> list[Any]:
        peer = NodeProxy(self._context.xmlrpc, self._uri, self._context.name)
        return await peer.request_topic(self._subscription.name, protocols)

    async def _shake_hands(self, stream: Stream) -> IncomingLink:
        context, subscription = self._context, self._subscription
        try:
            client = TopicClient(
                stream.peer,
                context.name,
                subscription.wanted(),
                tcp_nodelay=any(sub.options.tcp_nodelay for sub in subscription.roles),
                max_bytes=context.limits.header_bytes,
                max_fields=context.limits.header_fields,
            )
            stream.writer.write(client.data_to_send())
            await stream.receive_header(client, timeout=context.timeouts.handshake)
            link = self._link = await self._open_link(stream, client)
        except BaseException:
            stream.abort()
            raise
        return link

    async def _open_link(self, stream: Stream, client: TopicClient) -> IncomingLink:
        context, subscription = self._context, self._subscription
        header, offer = context.connections.kept(client.header), client.agreed
        if "message_definition" not in header:
            offer = replace(offer, definition="")
        link = IncomingLink(
            stream,
            connection_info(stream, subscription.name, "i", self._uri, header),
            offer,
            subscription.deliver,
            self._stir.set,
            context.clock.nanoseconds,
            context.loop_state.receive_buffer,
            max_bytes=context.limits.message_bytes,
            budget=context.budget,
        )
        rest = await take_over(stream, link)
        subscription.link_opened(link)
        if rest:
            link.block_received(rest)
        return link

    async def _until_closed(self, link: IncomingLink) -> None:
        """Wait until the connection closes, or falls silent when the publisher is delisted."""
        while not link.is_closed:
            if not self._leaving or self._was_forgotten:
                await self._stirred(None)
                continue
            link.has_progressed()  # from now on
            if not await self._stirred(_GRACE) and not link.has_progressed():
                break

    async def _stirred(self, timeout: float | None) -> bool:
        """Wait at most ``timeout`` seconds for news from the master or the connection.
        Returns whether there was any."""
        try:
            async with asyncio.timeout(timeout):
                await self._stir.wait()
        except TimeoutError:
            return False
        self._stir.clear()
        return True

    def _complain(self, text: str) -> None:
        """Log a problem, or count it if it was logged a short while ago."""
        text = text.replace(f" at {printable(self._uri)}", "")  # it is said once
        self.complaint = f"publisher at {printable(self._uri)}: {printable(text)}"
        log, topic = self._context.log, self._subscription.name
        what = "subscriber %s: publisher at %s: %s"
        if topic == ROSOUT:
            log.debug(what, topic, self._uri, text)
        else:
            log.complain(what, topic, self._uri, text)
