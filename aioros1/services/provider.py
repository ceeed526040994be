"""Providing a service."""

from __future__ import annotations

from dataclasses import dataclass
from numbers import Integral
from typing import Any, Generic, Self, TypeVar

from aioros1._public import public
from aioros1.connection import ConnectionInfo
from aioros1.core.awaited import awaits_caller
from aioros1.core.context import Context
from aioros1.core.role import Role
from aioros1.hints import check_kinds
from aioros1.idl import Service
from aioros1.services.call import ServiceCall
from aioros1.services.provider_connection import Handler
from aioros1.services.provision import Provision

__all__ = ["ServiceProvider", "ServiceProviderOptions"]

Q = TypeVar("Q")
A = TypeVar("A")


@public
@dataclass(frozen=True, slots=True, kw_only=True)
class ServiceProviderOptions:
    """Options of a provider; the defaults are those of
    :meth:`aioros1.Node.advertise_service`."""

    max_concurrency: int | None = None
    """How many calls are handled at a time; others wait in order of arrival."""

    raw: bool = False
    """Pass requests and responses as serialised bytes."""

    def __post_init__(self) -> None:
        check_kinds(
            self,
            {
                "max_concurrency": (Integral | None, "a whole number of calls or None"),
                "raw": (bool, "True or False"),
            },
        )
        if self.max_concurrency is not None and self.max_concurrency < 1:
            raise ValueError(f"max_concurrency must be at least 1, got {self.max_concurrency!r}")


@public
class ServiceProvider(Role, Generic[Q, A]):
    """Answers calls of one service; made by :meth:`aioros1.Node.advertise_service`.

    A handler is called with each request. Without a handler, you iterate over the provider
    and answer each :class:`~aioros1.ServiceCall` whenever you like, in any order.
    """

    kind = "service"
    _factory = "advertise_service"

    def __init__(
        self,
        context: Context,
        provision: Provision,
        service_class: type[Service[Any, Any]] | None,
        options: ServiceProviderOptions,
    ) -> None:
        super().__init__(context, provision.name)
        self.options = options
        """The options it was opened with."""
        self.service_class = service_class
        """The class of the service; None for a raw provider of any type."""
        self._provision = provision

    @property
    def handler(self) -> Handler[Q, A] | None:
        """The function called with each request; None if you iterate over the calls."""
        return self._provision.handler

    @property
    def type(self) -> str:
        return "*" if self.service_class is None else self.service_class._type

    @property
    def md5sum(self) -> str:
        return "*" if self.service_class is None else self.service_class._md5sum

    @property
    def definition(self) -> str:
        return "" if self.service_class is None else self.service_class._full_text

    @property
    def connections(self) -> tuple[ConnectionInfo, ...]:
        return self._provision.connections

    @property
    def uri(self) -> str:
        """The ``rosrpc://host:port`` that callers get from the master."""
        return self._context.address.tcpros_uri

    # without a handler

    def __aiter__(self) -> Self:
        if self.handler is not None:
            raise TypeError(f"service {self.name} has a handler, which takes all calls")
        self._context.check_iterator()
        return self

    async def __anext__(self) -> ServiceCall[Q, A]:
        provision = self._provision
        while not provision.calls:
            if not self._is_open:
                raise StopAsyncIteration
            await provision.arrived.wait()
        return provision.calls.popleft()

    # the end

    async def close(self) -> None:
        """Unregister the service from the master and free its resources.

        Calls that a handler works on are still answered. A handler of this service may call
        this, too: it then returns once the service is unregistered. Otherwise it is as
        :meth:`.Role.close`.
        """
        provision = self._provision
        if not awaits_caller(provision):
            await super().close()
            return
        self._start_closing()
        while self._is_closing and provision.is_at_master:
            await provision.has_left.wait()

    def _abort(self) -> None:
        super()._abort()
        self._provision.end_calls(self._closed_error())
        self._provision.abort()
        self._provision.has_left.wake()

    async def _close(self) -> None:
        """Let running calls finish, and start no further ones."""
        self._provision.end_calls(self._closed_error())
        await self._provision.leave(self)
