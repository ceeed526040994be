"""TCP addresses, as sockets take them and as people read them."""

from __future__ import annotations

import asyncio
import ipaddress
import socket

__all__ = ["Address", "addresses_of", "host_and_port"]

Address = tuple[socket.AddressFamily, tuple[str, int]]


async def addresses_of(host: str, port: int) -> list[Address]:
    """The numeric addresses of ``host``, the one to try first in front.

    Only real names are looked up, which takes a thread. Raises :class:`OSError` for an
    unknown name.
    """
    if host.rstrip(".").lower() == "localhost":
        return [(socket.AF_INET, ("127.0.0.1", port)), (socket.AF_INET6, ("::1", port))]
    try:
        version = ipaddress.ip_address(host).version
    except ValueError:
        pass
    else:
        return [(socket.AF_INET if version == 4 else socket.AF_INET6, (host, port))]
    loop = asyncio.get_running_loop()
    try:
        found = await loop.getaddrinfo(host, port, type=socket.SOCK_STREAM)
    except UnicodeError as error:  # a label longer than 63 characters, and the like
        raise socket.gaierror(socket.EAI_NONAME, f"{host!r} is not a host name: {error}") from None
    numeric = [
        (family, (str(address[0]), port))
        for family, _, _, _, address in found
        if family in (socket.AF_INET, socket.AF_INET6)
    ]
    return list(dict.fromkeys(numeric))


def host_and_port(host: str, port: int) -> str:
    """``host:port``, with brackets around a numeric IPv6 address."""
    return f"[{host}]:{port}" if ":" in host else f"{host}:{port}"
