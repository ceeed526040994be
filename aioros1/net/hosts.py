"""Host names and addresses: which to connect to, which to listen on, which to advertise.

Looking up a name takes a thread. Most ROS graphs run on one machine and call it
``localhost`` or use a numeric address; for these no thread is started.
"""

from __future__ import annotations

import contextlib
import ipaddress
import os
import socket
from collections.abc import Iterable, Mapping

from aioros1.net.loop_state import loop_state

__all__ = [
    "advertised_host",
    "all_loopback",
    "bind_address_for",
    "bind_sockets",
    "every_interface",
    "is_local",
    "is_loopback",
    "is_wildcard",
    "local_address",
    "local_address_facing",
    "resolve",
    "set_keepalive",
    "uri_host",
]

_LOCALHOST = [(socket.AF_INET, "127.0.0.1"), (socket.AF_INET6, "::1")]


async def resolve(host: str) -> list[tuple[socket.AddressFamily, str]]:
    """Return the numeric addresses of ``host``, the most promising first.

    ``localhost`` is 127.0.0.1, then ::1. A link-local address ends with its interface
    (``fe80::1%2``). Raises :class:`OSError` (``socket.gaierror``) if the name is unknown.
    """
    literal = _literal(host)
    if literal is not None:
        return [literal]
    if host.rstrip(".").lower() == "localhost":
        return list(_LOCALHOST)
    return await loop_state().lookups.addresses(host)


def local_address_facing(remote: str) -> str:
    """Return the numeric address of this machine from which packets to ``remote`` are sent.

    ``remote`` is a numeric address. Nothing is sent: the kernel only chooses a route. For
    a loopback address that is the address itself. Raises :class:`OSError` if there is no
    route.
    """
    literal = _literal(remote)
    if literal is None:
        raise ValueError(f"expected a numeric address, got {remote!r}")
    family, address = literal
    with socket.socket(family, socket.SOCK_DGRAM) as sock:
        sock.setblocking(False)  # connecting a datagram socket never waits anyway
        sock.connect((address, 9))  # the discard port; any port would do
        return str(sock.getsockname()[0])


def local_address() -> str | None:
    """Return this machine's numeric address on its default route, ``None`` without one."""
    for remote in ("192.0.2.1", "2001:db8::1"):  # reserved for documentation: never local
        with contextlib.suppress(OSError):
            address = local_address_facing(remote)
            if not is_loopback(address):
                return address
    return None


def advertised_host(
    environ: Mapping[str, str] | None = None, *, bound: str | None = None
) -> str | None:
    """Return the host that a server should advertise, or ``None`` if there is none.

    It is ``ROS_HOSTNAME``, then ``ROS_IP``, as for every ROS 1 program; else ``bound``, the
    one address that the server listens on; else the address on the default route. (rosmaster
    advertises the machine's host name, which other machines often cannot resolve, and which
    takes a thread to look up.)
    """
    environ = os.environ if environ is None else environ
    for variable in ("ROS_HOSTNAME", "ROS_IP"):
        if host := environ.get(variable, "").strip():
            return host
    return bound or local_address()


def bind_address_for(host: str) -> str:
    """Return the address to listen on when ``host`` is advertised: a loopback address for
    loopback, otherwise all interfaces, as for every ROS 1 program."""
    if is_loopback(host):
        return host.strip("[]") if _literal(host) else "127.0.0.1"
    return every_interface(host)


def every_interface(host: str) -> str:
    """Return the wildcard address to listen on to be reached as ``host``: that of IPv6 if
    ``host`` is an IPv6 address, or if it is a name and ``ROS_IPV6`` is ``on``."""
    is_name = _literal(host) is None
    is_ipv6 = ":" in host or (is_name and os.environ.get("ROS_IPV6") == "on")
    return "::" if is_ipv6 else "0.0.0.0"


def is_loopback(host: str) -> bool:
    """Whether ``host`` is ``localhost`` or a numeric loopback address."""
    if host.rstrip(".").lower() == "localhost":
        return True
    try:
        return ipaddress.ip_address(host.strip("[]")).is_loopback
    except ValueError:
        return False


def all_loopback(addresses: Iterable[tuple[socket.AddressFamily, str]]) -> bool:
    """Whether each of these is a loopback address: what :func:`resolve` gives for this machine."""
    return all(map(is_loopback, (address for _, address in addresses)))


def is_local(host: str) -> bool:
    """Whether ``host`` is currently a numeric address of this machine."""
    literal = _literal(host)
    if literal is None:
        return False
    family, address = literal
    with socket.socket(family, socket.SOCK_DGRAM) as sock:
        try:
            sock.bind((address, 0))
        except OSError:
            return False
        return True


def is_wildcard(host: str) -> bool:
    """Whether ``host`` stands for all addresses, and so cannot be advertised."""
    try:
        return ipaddress.ip_address(host.strip("[]")).is_unspecified
    except ValueError:
        return False


def uri_host(host: str) -> str:
    """Return ``host`` as a URI needs it: a numeric IPv6 address in brackets."""
    return f"[{host}]" if ":" in host and not host.startswith("[") else host


def bind_sockets(host: str = "0.0.0.0", port: int = 0) -> list[socket.socket]:
    """Open listening sockets on the numeric address ``host`` (or ``localhost``).

    ``"0.0.0.0"`` is every IPv4 interface, ``"::"`` every interface of IPv4 and IPv6 in one
    socket. Port 0 takes a free one. Raises :class:`OSError`, whose text names the address,
    and :class:`ValueError` if ``host`` is not an address or ``port`` not a port.
    """
    if host.rstrip(".").lower() == "localhost":
        host = "127.0.0.1"
    literal = _literal(host)
    if literal is None:
        raise ValueError(f"expected a numeric address to listen on, got {host!r}")
    if not 0 <= port <= 65535:
        raise ValueError(f"expected a port from 0 to 65535, got {port}")
    family, address = literal
    sock = socket.socket(family, socket.SOCK_STREAM)
    try:
        # A restarted master must not have to wait until its old connections time out.
        if os.name == "posix":
            sock.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        if family == socket.AF_INET6:
            sock.setsockopt(socket.IPPROTO_IPV6, socket.IPV6_V6ONLY, address != "::")
        sock.bind((address, port))
        sock.listen(512)
        sock.setblocking(False)
    except OSError as error:
        sock.close()
        reason = error.strerror or str(error)
        raise OSError(
            error.errno, f"cannot listen on {uri_host(address)}:{port}: {reason}"
        ) from None
    except BaseException:
        sock.close()
        raise
    return [sock]


def set_keepalive(sock: socket.socket, idle: int, interval: int, count: int) -> None:
    """Let the system find out when the other side of a TCP connection is gone.

    After ``idle`` seconds of silence it asks ``count`` times, every ``interval`` seconds.
    """
    sock.setsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE, 1)
    for name, value in (
        ("TCP_KEEPIDLE", idle),
        ("TCP_KEEPINTVL", interval),
        ("TCP_KEEPCNT", count),
    ):
        option = getattr(socket, name, None)  # not every system has all three
        if option is not None:
            sock.setsockopt(socket.IPPROTO_TCP, option, value)


def _literal(host: str) -> tuple[socket.AddressFamily, str] | None:
    if host[:1] == "[" and host[-1:] == "]":
        host = host[1:-1]
    try:
        socket.inet_pton(socket.AF_INET, host)
        return socket.AF_INET, host
    except (OSError, ValueError):
        pass
    if ":" in host:
        try:
            ipaddress.IPv6Address(host)
            return socket.AF_INET6, host
        except ValueError:
            pass
    return None
