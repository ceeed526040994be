"""All services of one node."""

from __future__ import annotations

import asyncio
from collections.abc import Mapping
from typing import Any

from aioros1.core.context import Context
from aioros1.errors import HandshakeError
from aioros1.net.tcpros import Stream
from aioros1.options import WithoutMaster
from aioros1.quoting import printable
from aioros1.services.caller import ServiceCaller, ServiceCallerOptions
from aioros1.services.lookup import probe, service_class_of, type_of
from aioros1.services.provider import ServiceProvider, ServiceProviderOptions
from aioros1.services.provider_connection import Handler
from aioros1.services.provision import Provision
from aioros1.services.side import providers_side, raw_side
from aioros1.waiting import Deadlines, deadline
from aioros1.wire.handshake import Server, ServiceOffer

__all__ = ["Services"]


class Services:
    """The services that a node provides and calls."""

    def __init__(self, context: Context) -> None:
        self.provisions: dict[str, Provision] = {}
        """By name, for as long as a provider uses them."""
        self._context = context
        self._probes = Deadlines()  # running probes of providers

    async def advertise(
        self,
        name: str,
        type: Any,
        handler: Handler[Any, Any] | None,
        options: ServiceProviderOptions,
        without_master: WithoutMaster = "raise",
    ) -> ServiceProvider[Any, Any]:
        """See :meth:`aioros1.Node.advertise_service`."""
        context = self._context
        context.check_open()
        name = context.resolve_name(name)
        is_any = options.raw and type == "*"
        service_class = None if is_any else context.store.resolve_srv(type)
        while (other := self.provisions.get(name)) is not None and other.provider is not None:
            if other.is_open:
                raise ValueError(f"{context.name} provides service {name} already")
            await other.provider.close()  # continues a close that was cancelled
        if service_class is None or options.raw:
            side = raw_side(f"service {name}")
        else:
            side = providers_side(service_class)
        if service_class is None:
            offer = ServiceOffer(name, "*", "*")
        else:
            offer = ServiceOffer(name, service_class._type, service_class._md5sum)
        provision = Provision(
            context, self.provisions, offer, side, handler, options.max_concurrency
        )
        provider: ServiceProvider[Any, Any] = ServiceProvider(
            context, provision, service_class, options
        )
        try:
            await provision.acquire(provider, without_master)
        except BaseException:
            provider._abort()  # there may be calls already
            raise
        return await context.admit(provider, provider._abort)

    async def caller(
        self, name: str, type: Any, options: ServiceCallerOptions
    ) -> ServiceCaller[Any, Any]:
        """See :meth:`aioros1.Node.service_caller`."""
        context = self._context
        context.check_open()
        name = context.resolve_name(name)
        if type != "*":
            service_class = context.store.resolve_srv(type)
        elif options.raw:
            service_class = None
        else:
            async with deadline(options.timeout, f"service {name}: no answer") as limit:
                limit.why = context.contact.obstacle
                header = await context.contact.reach(lambda: probe(context, name, self._probes))
            service_class = service_class_of(context, name, header)
        caller: ServiceCaller[Any, Any] = ServiceCaller(context, name, service_class, options)
        return await context.admit(caller, caller._abort)

    async def call(
        self,
        name: str,
        type: Any,
        request: Any,
        timeout: float | None,
        fields: Mapping[str, Any],
    ) -> Any:
        """See :meth:`aioros1.Node.call`."""
        async with (
            deadline(timeout, f"service {self._context.resolve_name(name)}: no answer") as limit,
        ):
            limit.why = self._context.contact.obstacle
            async with await self.caller(name, type, ServiceCallerOptions()) as caller:
                return await caller.call(request, **fields)

    async def wait_for(self, name: str, timeout: float | None) -> None:
        """See :meth:`aioros1.Node.wait_for_service`."""
        # Any type will do: a probe names none.
        async with await self.caller(name, "std_srvs/Empty", ServiceCallerOptions()) as caller:
            await caller.wait_for_service(timeout=timeout)

    async def type_of(self, name: str) -> str:
        """See :meth:`aioros1.Node.service_type`."""
        context = self._context
        context.check_open()
        name = context.resolve_name(name)
        return type_of(name, await probe(context, name, self._probes))

    async def serve(self, stream: Stream, server: Server) -> None:
        """Serve a caller that has connected; ``server`` holds its header.

        Raises :class:`~aioros1.HandshakeError`, :class:`ConnectionError` and
        :class:`TimeoutError`.
        """
        provision = self.provisions.get(server.service or "")
        if provision is None:
            name = self._context.name
            service = printable(server.service)
            raise HandshakeError(server.peer, f"{name} has no service {service}")
        await provision.serve(stream, server)

    async def end_calls(self) -> None:
        """Let handlers that run return, while other roles can still be used."""
        busy = [each for each in self.provisions.values() if each.running]
        if busy:
            await asyncio.gather(*(each.end_running() for each in busy))

    def abort(self) -> None:
        """End all probes at once."""
        self._probes.expire()
