"""Providing a service."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Generic, Self, TypeVar

from aioros1._public import public
from aioros1.core.role import Role
from aioros1.services.call import ServiceCall
from aioros1.services.provider_connection import Handler

if TYPE_CHECKING:
    from aioros1.connection import ConnectionInfo
    from aioros1.core.context import Context
    from aioros1.idl import Service
    from aioros1.services.provision import Provision

__all__ = ["ServiceProvider", "ServiceProviderOptions"]

Q = TypeVar("Q")
A = TypeVar("A")


@public
@dataclass(frozen=True, slots=True, kw_only=True)
class ServiceProviderOptions:
    """How a provider was opened; the defaults are those of
    :meth:`aioros1.Node.advertise_service`."""

    max_concurrency: int | None = None
    """Calls that are worked on at a time; further ones wait, in the order they came."""

    raw: bool = False
    """Hand over requests, and take responses, as serialised bytes."""

    def __post_init__(self) -> None:
        if self.max_concurrency is not None and self.max_concurrency < 1:
            raise ValueError(f"max_concurrency must be at least 1, got {self.max_concurrency!r}")


@public
class ServiceProvider(Role, Generic[Q, A]):
    """Answers calls of one service; made by :meth:`aioros1.Node.advertise_service`.

    With a handler, that is called with each request. Without one, you iterate the
    provider, and answer every :class:`~aioros1.ServiceCall` it gives whenever you like, in
    any order.
    """

    kind = "service"

    def __init__(
        self,
        context: Context,
        provision: Provision,
        service_class: type[Service[Any, Any]] | None,
        options: ServiceProviderOptions,
    ) -> None:
        super().__init__(context, provision.name)
        self.options = options
        """How it was opened."""
        self.service_class = service_class
        """The class of the service; None for a raw provider of any type."""
        self._provision = provision

    @property
    def handler(self) -> Handler[Q, A] | None:
        """What is called with each request; None if calls are to be taken."""
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
        """The ``rosrpc://host:port`` that the master gives to callers."""
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

    def _abort(self) -> None:
        super()._abort()
        self._provision.end_calls(self._closed_error())
        self._provision.abort()

    async def _close(self) -> None:
        """Let calls that are being worked on be answered, and no further ones begin."""
        self._provision.end_calls(self._closed_error())
        await self._provision.leave(self)
