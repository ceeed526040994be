"""Finding the provider of a service, and the handshake with it."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import AsyncIterator, Mapping
from typing import TYPE_CHECKING
from urllib.parse import urlsplit

from aioros1.errors import (
    HandshakeError,
    InvalidNameError,
    MasterError,
    Md5MismatchError,
    MessageNotFoundError,
    ServiceNotFound,
    ServiceUnavailable,
)
from aioros1.idl.parser import split_type
from aioros1.net.tcpros import Stream, connect
from aioros1.quoting import printable
from aioros1.waiting import Deadlines
from aioros1.wire.handshake import ServiceClient, ServiceOffer

if TYPE_CHECKING:
    from aioros1.core.context import Context
    from aioros1.idl.service import AnyService

__all__ = ["agree", "look_up", "probe", "reach", "service_class_of", "type_of"]

GRACE = 0.5
"""Seconds in which a provider may refuse a probe; see :func:`reach`."""


async def look_up(context: Context, service: str) -> str:
    """Ask the master for the ``rosrpc://host:port`` of ``service``.

    Raises :class:`~aioros1.ServiceNotFound`, and :class:`~aioros1.MasterError` for an invalid
    answer.
    """
    try:
        return await context.master.lookup_service(service)
    except MasterError as error:
        if not error.is_refusal:
            raise
        raise ServiceNotFound(
            f"service {service}: no provider: the master at {context.master.uri} knows none"
        ) from error


async def agree(
    context: Context, uri: str, wanted: ServiceOffer, *, persistent: bool = False
) -> tuple[Stream, Mapping[str, str]]:
    """Connect to the provider at ``uri``; returns the connection and the provider's header.

    Raises :class:`~aioros1.ServiceUnavailable`, and :class:`~aioros1.HandshakeError` when
    the provider refuses or has another type.
    """
    stream, client = await _ask(context, uri, wanted, persistent=persistent)
    return stream, await _answer(context, stream, client)


async def probe(context: Context, service: str, limits: Deadlines) -> Mapping[str, str]:
    """Ask a provider of any type for its header. rosservice probes in the same way, and no
    provider takes a probe for a call.

    The probe ends with ``limits``. Raises as :func:`look_up` and :func:`agree` do.
    """
    async with _probe(context, service, limits) as (stream, client):
        return await _answer(context, stream, client)


async def reach(context: Context, service: str, limits: Deadlines) -> None:
    """Probe a provider, and return unless it refuses.

    rospy and roscpp are content when they can connect and write, and read no answer. Some
    providers never give one: rosgo's. So no answer within a moment, or the end of the
    connection, is no refusal. Ends and raises as :func:`probe` does.
    """
    async with _probe(context, service, limits) as (stream, client):
        try:
            async with asyncio.timeout(GRACE):
                while data := await stream.reader.read(client.missing):
                    if client.receive_data(data):
                        return
        except TimeoutError:
            pass
        except OSError as error:
            raise ServiceUnavailable(f"service {service}: {stream.peer}: {error}") from None


@contextlib.asynccontextmanager
async def _probe(
    context: Context, service: str, limits: Deadlines
) -> AsyncIterator[tuple[Stream, ServiceClient]]:
    """Send a probe to the provider of a service, and close the connection afterwards."""
    try:
        async with limits.limit(None, f"service {service}: no answer"):
            uri = await look_up(context, service)
            wanted = ServiceOffer(service, type="*", md5sum="*")
            stream, client = await _ask(context, uri, wanted, probe=True)
            try:
                yield stream, client
            finally:
                stream.abort()
    except TimeoutError:
        context.check_open()  # closing ended it, not the timeout
        raise


async def _ask(
    context: Context,
    uri: str,
    wanted: ServiceOffer,
    *,
    persistent: bool = False,
    probe: bool = False,
) -> tuple[Stream, ServiceClient]:
    """Connect to the provider at ``uri`` and send our header."""
    service = wanted.service
    host, port = _address(service, uri)
    try:
        stream = await connect(host, port, context.timeouts)
    except (OSError, TimeoutError) as error:
        raise ServiceUnavailable(f"service {service}: {error}") from None
    client = ServiceClient(
        f"{service} at {stream.peer}",
        context.name,
        wanted,
        persistent=persistent,
        probe=probe,
        max_bytes=context.limits.header_bytes,
        max_fields=context.limits.header_fields,
    )
    stream.writer.write(client.data_to_send())
    return stream, client


async def _answer(context: Context, stream: Stream, client: ServiceClient) -> Mapping[str, str]:
    """Wait for the provider's header; close the connection if none comes."""
    try:
        try:
            await stream.receive_header(client, timeout=context.timeouts.handshake)
        except (OSError, TimeoutError) as error:
            raise ServiceUnavailable(f"service {client.wanted.service}: {error}") from None
    except BaseException:
        stream.abort()
        raise
    return client.header


def type_of(service: str, header: Mapping[str, str]) -> str:
    """The type in a provider's header.

    Raises :class:`~aioros1.HandshakeError` if it is not a valid type.
    """
    name = header.get("type", "")
    try:
        split_type(name)
    except InvalidNameError:
        peer = f"{service} of {printable(header.get('callerid', '?'))}"
        text = f"expected its type as package/Type, got {printable(name)!r}"
        raise HandshakeError(peer, text) from None
    return name


def service_class_of(context: Context, service: str, header: Mapping[str, str]) -> type[AnyService]:
    """The class of the type that the provider announces.

    A provider sends the name and the MD5 sum of its type, but no definition, so the
    definition has to be in the node's store. Raises :class:`~aioros1.MessageNotFoundError`
    when it is not, :class:`~aioros1.Md5MismatchError` when the store has another definition
    by that name, :class:`~aioros1.MessageSpecError` when it cannot be read, and as
    :func:`agree` does.
    """
    name = type_of(service, header)
    provider = printable(header.get("callerid", "?"))
    what = f"service {service} of {provider} has type {printable(name)}"
    try:
        known = context.store.load_srv(name)
    except MessageNotFoundError as error:
        raise MessageNotFoundError(f"{what}: {error.text}", error.places) from error
    md5sum = header.get("md5sum", "*")
    if md5sum not in ("*", known._md5sum):
        raise Md5MismatchError(
            f"{what} with md5sum {printable(md5sum)}, but the definition known here has "
            f"{known._md5sum}"
        )
    return known


def _address(service: str, uri: str) -> tuple[str, int]:
    try:
        parts = urlsplit(uri)
        if parts.scheme == "rosrpc" and parts.hostname and parts.port:
            return parts.hostname, parts.port
    except ValueError:
        pass  # no port, or unbalanced brackets
    raise ServiceUnavailable(
        f"service {service}: the master gives {printable(uri)!r}, expected rosrpc://host:port"
    )
