"""Services, as a node uses them."""

from __future__ import annotations

from abc import ABC
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, TypeVar, overload

from aioros1.idl import Message
from aioros1.role import Opening
from aioros1.service_caller import ServiceCaller, ServiceCallerOptions
from aioros1.service_provider import Handler, ServiceProvider, ServiceProviderOptions

if TYPE_CHECKING:
    from aioros1.idl import Service
    from aioros1.idl.genpy_types import GenpyMessage, GenpyService
    from aioros1.roles import Roles

__all__ = ["ServiceCalls"]

Q = TypeVar("Q", bound=Message)
A = TypeVar("A", bound=Message)


class ServiceCalls(ABC):
    """The part of :class:`Node` that is about services."""

    _roles: Roles

    @overload
    def advertise_service(
        self,
        name: str,
        type: type[Service[Q, A]],
        handler: Handler[Q, A] | None = None,
        *,
        max_concurrency: int | None = None,
    ) -> Opening[ServiceProvider[Q, A]]: ...
    @overload
    def advertise_service(
        self,
        name: str,
        type: str | type[GenpyService],
        handler: Handler[Any, Any] | None = None,
        *,
        max_concurrency: int | None = None,
    ) -> Opening[ServiceProvider[Any, Any]]: ...
    def advertise_service(
        self,
        name: str,
        type: Any,
        handler: Handler[Any, Any] | None = None,
        *,
        max_concurrency: int | None = None,
    ) -> Opening[ServiceProvider[Any, Any]]:
        """Open a service provider.

        ``handler`` is a function or a coroutine function: it takes the request and
        returns the response, a dict of its fields, or None for a default response. What
        it raises is the caller's error. Without a handler, iterate the provider. At most
        ``max_concurrency`` calls are worked on at a time.

        Raises as :meth:`advertise` does, and :class:`ValueError` when this node provides
        the service already.
        """
        options = ServiceProviderOptions(max_concurrency=max_concurrency)
        return Opening(self._roles.advertise_service(name, type, handler, options))

    @overload
    def service_caller(
        self,
        name: str,
        type: type[Service[Q, A]],
        *,
        persistent: bool = False,
        timeout: float | None = None,
        tcp_nodelay: bool = True,
    ) -> Opening[ServiceCaller[Q, A]]: ...
    @overload
    def service_caller(
        self,
        name: str,
        type: str | type[GenpyService],
        *,
        persistent: bool = False,
        timeout: float | None = None,
        tcp_nodelay: bool = True,
    ) -> Opening[ServiceCaller[Any, Any]]: ...
    def service_caller(
        self,
        name: str,
        type: Any,
        *,
        persistent: bool = False,
        timeout: float | None = None,
        tcp_nodelay: bool = True,
    ) -> Opening[ServiceCaller[Any, Any]]:
        """Open a service caller; see :class:`ServiceCallerOptions` for the options.

        Nobody is asked whether the service is there. Raises
        :class:`~aioros1.MessageError`, :class:`~aioros1.InvalidNameError` and
        :class:`~aioros1.ClosedError`.
        """
        options = ServiceCallerOptions(
            persistent=persistent, timeout=timeout, tcp_nodelay=tcp_nodelay
        )
        return Opening(self._roles.service_caller(name, type, options))

    @overload
    async def call(
        self,
        name: str,
        type: type[Service[Q, A]],
        request: Q | GenpyMessage | Mapping[str, Any] | None = None,
        /,
        *,
        timeout: float | None = None,
        **fields: Any,
    ) -> A: ...
    @overload
    async def call(
        self,
        name: str,
        type: str | type[GenpyService],
        request: Any = None,
        /,
        *,
        timeout: float | None = None,
        **fields: Any,
    ) -> Any: ...
    async def call(
        self,
        name: str,
        type: Any,
        request: Any = None,
        /,
        *,
        timeout: float | None = None,
        **fields: Any,
    ) -> Any:
        """One call of a service; see :meth:`ServiceCaller.call`."""
        async with self.service_caller(name, type) as caller:
            return await caller.call(request, timeout=timeout, **fields)

    async def wait_for_service(self, name: str, *, timeout: float | None = None) -> None:
        """Wait until a service is registered and its provider answers.

        Raises :class:`TimeoutError` after ``timeout`` seconds.
        """
        # Of whatever type: to be asked whether it is there, a provider need not know.
        async with self.service_caller(name, "std_srvs/Empty") as caller:
            await caller.wait_for_service(timeout=timeout)
