"""Finding the provider of a service, and the handshake with it."""

from __future__ import annotations

from collections.abc import Mapping
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

__all__ = ["agree", "look_up", "probe", "service_class_of", "type_of"]


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
    context: Context,
    uri: str,
    wanted: ServiceOffer,
    *,
    persistent: bool = False,
    probe: bool = False,
    tcp_nodelay: bool = True,
) -> tuple[Stream, Mapping[str, str]]:
    """Connect to the provider at ``uri``; returns the connection and the provider's header.

    Raises :class:`~aioros1.ServiceUnavailable`, and :class:`~aioros1.HandshakeError` when
    the provider refuses or has another type.
    """
    service = wanted.service
    try:
        stream = await connect(*_address(service, uri), context.timeouts)
    except (OSError, TimeoutError) as error:
        raise ServiceUnavailable(f"service {service}: {error}") from None
    try:
        client = ServiceClient(
            f"{service} at {stream.peer}",
            context.name,
            wanted,
            persistent=persistent,
            probe=probe,
            tcp_nodelay=tcp_nodelay,
            max_bytes=context.limits.header_bytes,
            max_fields=context.limits.header_fields,
        )
        stream.writer.write(client.data_to_send())
        try:
            await stream.receive_header(client, timeout=context.timeouts.handshake)
        except (OSError, TimeoutError) as error:
            raise ServiceUnavailable(f"service {service}: {error}") from None
    except BaseException:
        stream.abort()
        raise
    return stream, client.header


async def probe(context: Context, service: str, limits: Deadlines) -> Mapping[str, str]:
    """Ask a provider of any type for its header. rosservice probes in the same way, and no
    provider takes a probe for a call.

    The probe ends with ``limits``. Raises as :func:`look_up` and :func:`agree` do.
    """
    wanted = ServiceOffer(service, type="*", md5sum="*")
    try:
        async with limits.limit(None, f"service {service}: no answer"):
            uri = await look_up(context, service)
            stream, header = await agree(context, uri, wanted, probe=True)
    except TimeoutError:
        context.check_open()  # closing ended it, not the timeout
        raise
    stream.abort()
    return header


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
