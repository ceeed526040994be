"""The roles of one node: opened, found by name, closed.

Roles of one topic or parameter share what the rest of the graph sees as one: a
:class:`Publication`, a :class:`Subscription`, a :class:`FollowedParam`. These stand in
the tables here for as long as a role uses them.
"""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

from aioros1.connection import ConnectionInfo
from aioros1.core.registration import Registration, Tell
from aioros1.core.role import Role
from aioros1.errors import ClosedError, MasterError, Md5MismatchError
from aioros1.params.subscriber import FollowedParam, ParamSubscriber
from aioros1.services.caller import ServiceCaller, ServiceCallerOptions
from aioros1.services.lookup import probe, service_class_of, type_of
from aioros1.services.provider import Handler, ServiceProvider, ServiceProviderOptions
from aioros1.topics.publication import Publication
from aioros1.topics.publisher import Publisher, PublisherOptions
from aioros1.topics.subscriber import Subscriber, SubscriberOptions
from aioros1.topics.subscription import Subscription
from aioros1.waiting import deadline

if TYPE_CHECKING:
    from aioros1.node import Node

__all__ = ["Roles"]

R = TypeVar("R", bound=Role)

_AT_ONCE = 6
"""Requests for registrations at a time. They have no limit of time, so that a master that
answers none of them must leave connections for others, which ask whether it is there."""


_LAST_TURNS = 10


class Shared(Protocol):
    """What roles share: one entry of a table, registered once."""

    name: str
    registration: Registration

    @property
    def is_used(self) -> bool: ...


S = TypeVar("S", bound=Shared)


class Link(Protocol):
    """One connection."""

    def abort(self) -> None: ...


class Roles:
    """Everything a node does in the graph."""

    def __init__(self, node: Node) -> None:
        self.publications: dict[str, Publication] = {}
        self.subscriptions: dict[str, Subscription] = {}
        self.providers: dict[str, ServiceProvider[Any, Any]] = {}
        self.params: dict[str, FollowedParam] = {}
        self.registrations: dict[tuple[str, str], Registration] = {}
        """By kind and name, those that have users, or of which the master is yet to hear."""
        self.slots = asyncio.Semaphore(_AT_ONCE)
        """What requests for registrations have to get hold of."""
        self.open: dict[Role, None] = {}  # a set that keeps the order
        self.probes: set[deadline] = set()
        """The questions to providers that are on their way."""
        self._node = node

    @property
    def connections(self) -> tuple[ConnectionInfo, ...]:
        """All TCPROS connections: those of topics, once each, and those of services."""
        sources: list[Publication | Subscription | Role] = [
            *self.publications.values(),
            *self.subscriptions.values(),
            *(role for role in self.open if isinstance(role, ServiceCaller | ServiceProvider)),
        ]
        return tuple(info for source in sources for info in source.connections)

    # opening

    async def advertise(self, topic: str, type: Any, options: PublisherOptions) -> Publisher[Any]:
        node = self._node
        node._check_open()
        topic = node.resolve_name(topic)
        message_class = node.store.resolve_msg(type)
        publication = self.publications.get(topic)
        if publication is not None and publication.publishers:
            _check_same_type(
                f"{node.name} publishes {topic}", publication.message_class, message_class
            )
        # One whose publishers are being closed may be used again, but for another type.
        if publication is None or publication.message_class._md5sum != message_class._md5sum:
            publication = self.publications[topic] = Publication(node, topic, message_class)
        publisher: Publisher[Any] = Publisher(node, publication, message_class, options)
        # Subscribers may come as soon as the master knows, before we know that it does.
        publication.publishers.append(publisher)
        try:
            await publication.registration.acquire()
        except BaseException:
            publication.remove(publisher)
            if not publication.publishers:
                publication.abort()  # somebody may have connected already
            _discard_unused(self.publications, publication)
            raise
        return await self._opened(publisher)

    async def subscribe(self, topic: str, type: Any, options: SubscriberOptions) -> Subscriber[Any]:
        node = self._node
        node._check_open()
        topic = node.resolve_name(topic)
        any_type = type == "*" or getattr(type, "_type", None) == "*"
        message_class = None if any_type else node.store.resolve_msg(type)
        subscription = self.subscriptions.get(topic)
        if subscription is None:
            subscription = self.subscriptions[topic] = Subscription(node, topic)
        if message_class is not None:
            for other in subscription.subscribers:
                if other.message_class is not None:
                    _check_same_type(
                        f"{node.name} subscribes to {topic}", other.message_class, message_class
                    )
        subscriber: Subscriber[Any] = Subscriber(node, subscription, message_class, options)
        subscription.add(subscriber)
        try:
            await subscription.registration.acquire()
        except BaseException:
            subscription.remove(subscriber)
            _discard_unused(self.subscriptions, subscription)
            raise
        return await self._opened(subscriber)

    async def advertise_service(
        self,
        name: str,
        type: Any,
        handler: Handler[Any, Any] | None,
        options: ServiceProviderOptions,
    ) -> ServiceProvider[Any, Any]:
        node = self._node
        node._check_open()
        name = node.resolve_name(name)
        service_class = node.store.resolve_srv(type)
        if handler is not None and not callable(handler):
            raise TypeError(f"service {name}: the handler is a function, got {handler!r}")
        while (other := self.providers.get(name)) is not None:
            if other.is_open:
                raise ValueError(f"{node.name} provides service {name} already")
            await other.close()  # which goes on, when it was cancelled before
        provider: ServiceProvider[Any, Any] = ServiceProvider(
            node, name, service_class, handler, options
        )
        self.providers[name] = provider
        try:
            await provider.registration.acquire()
        except BaseException:
            if self.providers.get(name) is provider:
                del self.providers[name]
            provider._abort()  # somebody may have connected already
            raise
        return await self._opened(provider)

    async def service_caller(
        self, name: str, type: Any, options: ServiceCallerOptions
    ) -> ServiceCaller[Any, Any]:
        node = self._node
        node._check_open()
        name = node.resolve_name(name)
        if type == "*":
            async with deadline(options.timeout, f"service {name}: no answer"):
                service_class = await service_class_of(node, name)
        else:
            service_class = node.store.resolve_srv(type)
        return await self._opened(ServiceCaller(node, name, service_class, options))

    async def service_type(self, name: str) -> str:
        self._node._check_open()
        name = self._node.resolve_name(name)
        return type_of(name, await probe(self._node, name))

    async def subscribe_param(self, key: str, default: Any) -> ParamSubscriber:
        node = self._node
        key = node._param_key(key)
        followed = self.params.get(key)
        if followed is None:
            followed = self.params[key] = FollowedParam(node, key)
        try:
            await followed.registration.acquire()
        except BaseException:
            _discard_unused(self.params, followed)
            raise
        subscriber = ParamSubscriber(node, followed, default)
        followed.subscribers.append(subscriber)
        return await self._opened(subscriber)

    async def _opened(self, role: R) -> R:
        """Hand out a role, unless the node was closed while it was being opened."""
        self.open[role] = None
        if not self._node.is_open:
            await role.close()
            self._node._check_open()
        return role

    # closing

    async def close(self, timeout: float) -> None:
        """Close all, at the same time, within ``timeout`` seconds."""
        try:
            async with asyncio.timeout(timeout):
                # What is being opened, or could not be taken back so far, has no open role.
                await asyncio.gather(self._close_roles(), self._end(only_unfinished=True))
                await self._end()
        except TimeoutError:
            self._node.log.warning("closed without having told everybody in %.3g s", timeout)

    async def _close_roles(self) -> None:
        rosout = self._node._rosout
        roles = tuple(role for role in self.open if rosout is None or not rosout.uses(role))
        results = await asyncio.gather(*(role.close() for role in roles), return_exceptions=True)
        for role, result in zip(roles, results, strict=True):
            if isinstance(result, Exception):
                self._node._report(result, f"closing {role}")
        if rosout is not None:
            # Last, for what those have to say whose loops have ended now. There may have been
            # nothing to wait for so far: they get some turns for the ends of their blocks.
            for _ in range(_LAST_TURNS):
                await asyncio.sleep(0)
            await rosout.finish()

    async def _end(self, *, only_unfinished: bool = False) -> None:
        ending = [
            registration.end()
            for registration in self.registrations.values()
            if not (only_unfinished and registration.is_established)
        ]
        for error in await asyncio.gather(*ending, return_exceptions=True):
            if isinstance(error, BaseException) and not isinstance(
                error, MasterError | ClosedError
            ):
                raise error

    def abort(self) -> None:
        """Drop all connections at once, and let everybody who waits for a role know."""
        for publication in self.publications.values():
            publication.abort()
        for subscription in self.subscriptions.values():
            subscription.close()
        for role in tuple(self.open):
            role._abort()
        for limit in self.probes:
            limit.expire()
        self.open.clear()

    def lose_address(self, host: str) -> None:
        """Drop all connections of an address of this machine, which it has lost: nothing
        comes there any more, not even their end."""
        for link, info in self._links():
            if info.local[0] == host:
                link.abort()

    def _links(self) -> list[tuple[Link, ConnectionInfo]]:
        links: list[tuple[Link, ConnectionInfo]] = []
        for publication in self.publications.values():
            links += ((link, link.info) for link in publication.links)
        for subscription in self.subscriptions.values():
            links += ((link, link.info) for link in subscription.links)
        for role in self.open:
            if isinstance(role, ServiceCaller | ServiceProvider):
                links += role.links
        return links

    async def close_publisher(self, publisher: Publisher[Any], publication: Publication) -> None:
        publication.remove(publisher)
        if not publication.publishers:
            await publication.close_links(self._node.timeouts.close)
        await self._release(publication.registration)
        _discard_unused(self.publications, publication)

    async def close_subscriber(
        self, subscriber: Subscriber[Any], subscription: Subscription
    ) -> None:
        subscription.remove(subscriber)
        await self._release(subscription.registration)
        _discard_unused(self.subscriptions, subscription)

    async def close_provider(self, provider: ServiceProvider[Any, Any]) -> None:
        await self._release(provider.registration)
        if self.providers.get(provider.name) is provider:
            del self.providers[provider.name]
        await provider.close_connections(self._node.timeouts.close)

    async def close_param_subscriber(
        self, subscriber: ParamSubscriber, followed: FollowedParam
    ) -> None:
        followed.subscribers.remove(subscriber)
        await self._release(followed.registration)
        _discard_unused(self.params, followed)

    # at the master

    def registration(self, kind: str, name: str, register: Tell, unregister: Tell) -> Registration:
        """The entry of that name at the master; one for all that ever use it, so that what
        the master is told of it keeps its order."""
        registration = self.registrations.get((kind, name))
        if registration is None:
            return Registration(self._node, kind, name, register, unregister)
        registration.adopt(register, unregister)
        return registration

    async def _release(self, registration: Registration) -> None:
        try:
            await registration.release()
        except (MasterError, ClosedError) as error:
            self._node.log.debug(
                "%s %s could not be unregistered: %s", registration.kind, registration.name, error
            )

    def param_updated(self, key: str, value: Any) -> bool:
        """Pass an update on to those whom it concerns; whether there are any."""
        concerned = [followed for followed in self.params.values() if followed.concerns(key)]
        for followed in concerned:
            followed.update(key, value)
        return bool(concerned)

    def param_in_doubt(self, key: str) -> None:
        """It may have changed: those whom it concerns have to ask, with the next heartbeat."""
        for followed in self.params.values():
            if followed.concerns(key):
                followed.registration.forget()


def _check_same_type(what: str, known: Any, other: Any) -> None:
    if known._md5sum != other._md5sum:
        raise Md5MismatchError(
            f"{what} as {known._type} with md5sum {known._md5sum} already, "
            f"not as {other._type} with md5sum {other._md5sum}"
        )


def _discard_unused(table: dict[str, S], entry: S) -> None:
    if not entry.is_used and not entry.registration.users and table.get(entry.name) is entry:
        del table[entry.name]
