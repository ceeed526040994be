"""The service methods of a node."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal, TypedDict, TypeVar, Unpack, overload

from aioros1.core.contact import Contact
from aioros1.core.opening import Opening
from aioros1.hints import check_takes, explained, methods_of
from aioros1.idl import Message, Service
from aioros1.idl.genpy_types import GenpyMessage, GenpyService
from aioros1.services.caller import ServiceCaller, ServiceCallerOptions
from aioros1.services.provider import ServiceProvider, ServiceProviderOptions
from aioros1.services.provider_connection import Handler
from aioros1.services.services import Services

__all__ = ["ServiceMethods"]

Q = TypeVar("Q", bound=Message)
A = TypeVar("A", bound=Message)

RawHandler = Handler[bytes, "bytes | bytearray | memoryview"]


class _CallerKeywords(TypedDict, total=False):
    persistent: bool
    timeout: float | None
    tcp_nodelay: bool


@methods_of("Node")
class ServiceMethods:
    """The service methods of :class:`~aioros1.Node`."""

    _contact: Contact
    _services: Services

    @overload
    def advertise_service(
        self,
        name: str,
        type: type[Service[Q, A]],
        handler: Handler[Q, A] | None = None,
        *,
        max_concurrency: int | None = None,
        raw: Literal[False] = False,
    ) -> Opening[ServiceProvider[Q, A]]: ...
    @overload
    def advertise_service(
        self,
        name: str,
        type: type[Service[Any, Any]] | str | type[GenpyService],
        handler: RawHandler | None = None,
        *,
        max_concurrency: int | None = None,
        raw: Literal[True],
    ) -> Opening[ServiceProvider[bytes, bytes]]: ...
    @overload
    def advertise_service(
        self,
        name: str,
        type: str | type[GenpyService],
        handler: Handler[Any, Any] | None = None,
        *,
        max_concurrency: int | None = None,
        raw: bool = False,
    ) -> Opening[ServiceProvider[Any, Any]]: ...
    @explained
    def advertise_service(
        self,
        name: str,
        type: Any,
        handler: Handler[Any, Any] | None = None,
        *,
        max_concurrency: int | None = None,
        raw: bool = False,
    ) -> Opening[ServiceProvider[Any, Any]]:
        """Open a service provider.

        ``handler`` is a function or a coroutine function: it takes the request and
        returns the response, a dict of its fields, or None for a default response. If it
        raises, the caller gets the error. Without a handler, iterate over the provider. At
        most ``max_concurrency`` calls run at a time. With ``raw``, requests and responses
        are serialised bytes, and ``type`` may be ``"*"`` to accept calls of any type.

        Raises as :meth:`advertise` does, and :class:`ValueError` when this node already
        provides the service.
        """
        options = ServiceProviderOptions(max_concurrency=max_concurrency, raw=raw)
        if handler is not None:
            what = "the serialised request" if raw else "the request"
            check_takes(handler, f"service {name}: the handler", what)
        opening = self._services.advertise(name, type, handler, options, self._contact.policy)
        return Opening(opening, "advertise_service", f"provider of service {name}")

    @overload
    def service_caller(
        self,
        name: str,
        type: type[Service[Q, A]],
        *,
        raw: Literal[False] = False,
        **options: Unpack[_CallerKeywords],
    ) -> Opening[ServiceCaller[Q, A]]: ...
    @overload
    def service_caller(
        self,
        name: str,
        type: type[Service[Any, Any]] | str | type[GenpyService] = "*",
        *,
        raw: bool = False,
        **options: Unpack[_CallerKeywords],
    ) -> Opening[ServiceCaller[Any, Any]]: ...
    @explained
    def service_caller(
        self,
        name: str,
        type: Any = "*",
        *,
        persistent: bool = False,
        timeout: float | None = None,
        tcp_nodelay: bool = True,
        raw: bool = False,
    ) -> Opening[ServiceCaller[Any, Any]]:
        """Open a service caller; see :class:`~aioros1.ServiceCallerOptions` for the options.

        ``type`` is a service class, ours or genpy's, or ``"pkg/Type"``; opening then does
        not check whether the service exists. With ``"*"``, the node asks the provider for
        the type, within ``timeout``, and takes the definition from its store. With ``raw``,
        requests and responses are serialised bytes, and the node does not ask for the type
        even if it is ``"*"``.

        Raises :class:`~aioros1.MessageError`, :class:`~aioros1.InvalidNameError` and
        :class:`~aioros1.ClosedError`. With ``"*"``, also raises what :meth:`service_type`
        raises, :class:`~aioros1.MessageNotFoundError` for a type without a definition here,
        and :class:`~aioros1.Md5MismatchError` for one with a different definition.
        """
        options = ServiceCallerOptions(
            persistent=persistent, timeout=timeout, tcp_nodelay=tcp_nodelay, raw=raw
        )
        opening = self._services.caller(name, type, options)
        return Opening(opening, "service_caller", f"caller of service {name}")

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
        """Call a service once; see :meth:`service_caller` and :meth:`aioros1.ServiceCaller.call`.

        ``timeout`` includes asking for the type.
        """
        return await self._services.call(name, type, request, timeout, fields)

    async def service_type(self, name: str) -> str:
        """Ask the provider of a service for its type.

        Raises :class:`~aioros1.ServiceNotFound` when the master knows no provider,
        :class:`~aioros1.ServiceUnavailable` when it cannot be reached,
        :class:`~aioros1.HandshakeError` when it refuses, :class:`~aioros1.MasterError`,
        :class:`~aioros1.InvalidNameError` and :class:`~aioros1.ClosedError`.
        """
        return await self._contact.reach(lambda: self._services.type_of(name))

    async def wait_for_service(self, name: str, *, timeout: float | None = None) -> None:
        """Wait until a service is registered and its provider takes connections; see
        :meth:`aioros1.ServiceCaller.is_available`.

        Raises :class:`TimeoutError` after ``timeout`` seconds.
        """
        await self._services.wait_for(name, timeout)
