"""Services, as a node uses them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, TypeVar, overload

from aioros1.core.role import Opening
from aioros1.idl import Message
from aioros1.services.caller import ServiceCaller, ServiceCallerOptions
from aioros1.services.provider import Handler, ServiceProvider, ServiceProviderOptions
from aioros1.waiting import deadline

if TYPE_CHECKING:
    from aioros1.idl import Service
    from aioros1.idl.genpy_types import GenpyMessage, GenpyService
    from aioros1.node.node_roles import Roles

__all__ = ["ServiceCalls"]

Q = TypeVar("Q", bound=Message)
A = TypeVar("A", bound=Message)


class ServiceCalls(ABC):
    """The part of :class:`Node` that is about services."""

    _roles: Roles

    @abstractmethod
    def resolve_name(self, name: str) -> str: ...

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
        type: str | type[GenpyService] = "*",
        *,
        persistent: bool = False,
        timeout: float | None = None,
        tcp_nodelay: bool = True,
    ) -> Opening[ServiceCaller[Any, Any]]: ...
    def service_caller(
        self,
        name: str,
        type: Any = "*",
        *,
        persistent: bool = False,
        timeout: float | None = None,
        tcp_nodelay: bool = True,
    ) -> Opening[ServiceCaller[Any, Any]]:
        """Open a service caller; see :class:`ServiceCallerOptions` for the options.

        ``type`` is a service class, ours or genpy's, or ``"pkg/Type"``; then nobody is
        asked whether the service is there. With ``"*"`` its provider is asked for the
        type, within ``timeout``, and the definition is that of the node's store.

        Raises :class:`~aioros1.MessageError`, :class:`~aioros1.InvalidNameError` and
        :class:`~aioros1.ClosedError`; with ``"*"`` what :meth:`service_type` raises, and
        :class:`~aioros1.MessageNotFoundError` for a type without a definition here,
        :class:`~aioros1.Md5MismatchError` for one with another definition.
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
        type: str | type[GenpyService] = "*",
        request: Any = None,
        /,
        *,
        timeout: float | None = None,
        **fields: Any,
    ) -> Any: ...
    async def call(
        self,
        name: str,
        type: Any = "*",
        request: Any = None,
        /,
        *,
        timeout: float | None = None,
        **fields: Any,
    ) -> Any:
        """One call of a service; see :meth:`service_caller` and :meth:`ServiceCaller.call`.

        ``timeout`` covers the question for the type as well.
        """
        async with (
            deadline(timeout, f"service {self.resolve_name(name)}: no answer"),
            self.service_caller(name, type) as caller,
        ):
            return await caller.call(request, **fields)

    async def service_type(self, name: str) -> str:
        """The type of a service, as its provider says it.

        Raises :class:`~aioros1.ServiceNotFound` when the master knows no provider,
        :class:`~aioros1.ServiceUnavailable` when it cannot be reached,
        :class:`~aioros1.HandshakeError` when it refuses, :class:`~aioros1.MasterError`,
        :class:`~aioros1.InvalidNameError` and :class:`~aioros1.ClosedError`.
        """
        return await self._roles.service_type(name)

    async def wait_for_service(self, name: str, *, timeout: float | None = None) -> None:
        """Wait until a service is registered and its provider answers.

        Raises :class:`TimeoutError` after ``timeout`` seconds.
        """
        # Of whatever type: to be asked whether it is there, a provider need not know.
        async with self.service_caller(name, "std_srvs/Empty") as caller:
            await caller.wait_for_service(timeout=timeout)
