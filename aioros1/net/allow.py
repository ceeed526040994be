"""Lists of the addresses that may connect. No I/O."""

from __future__ import annotations

from collections.abc import Iterable
from ipaddress import (
    IPv4Address,
    IPv4Network,
    IPv6Address,
    IPv6Network,
    ip_address,
    ip_network,
)

__all__ = ["THIS_MACHINE", "Address", "AllowList", "host_of", "parse_address"]

Address = IPv4Address | IPv6Address

THIS_MACHINE = "127.0.0.1"
"""What :func:`host_of` calls this machine."""

Network = IPv4Network | IPv6Network

_EXPECTED = "an IPv4 or IPv6 address or network, such as '10.0.0.5', '10.0.0.0/8' or 'fd00::/8'"
_MAPPED = IPv6Network("::ffff:0:0/96")

_SUBNET = 64  # bits


def parse_address(text: str) -> Address:
    """Parse the numeric address of a peer, as the kernel reports it.

    A dual-stack socket reports IPv4 addresses mapped into IPv6; they are returned as IPv4.
    The interface of a link-local address is dropped. Raises :class:`ValueError`.
    """
    address = ip_address(text.partition("%")[0])
    return getattr(address, "ipv4_mapped", None) or address


def host_of(address: Address) -> str:
    """Name the host that ``address`` belongs to, for limits that hosts share.

    A machine has 16 million loopback addresses, and may take any address of its IPv6 subnet,
    so that a limit for each address would limit nobody. All loopback addresses are one host,
    and all addresses of a /64.
    """
    if address.is_loopback:
        return THIS_MACHINE
    if isinstance(address, IPv6Address):
        return str(IPv6Network((address, _SUBNET), strict=False))
    return str(address)


class AllowList:
    """The networks whose addresses may connect; ``None`` is every network.

    An empty list admits nobody, so that a list which was filtered down to nothing does not
    admit everyone. Host names are not accepted, because what they resolve to can change.
    Raises :class:`ValueError` for anything that is not a network, and for a network with
    host bits (``"10.0.0.5/8"``), which may mean the host or the network.
    """

    def __init__(self, networks: Iterable[str] | None) -> None:
        if isinstance(networks, str):
            raise ValueError(f"allow must be a list of networks, got the string {networks!r}")
        self._networks = None if networks is None else tuple(map(_parse_network, networks))

    @property
    def networks(self) -> tuple[str, ...] | None:
        """The allowed networks in CIDR notation; ``None`` if every address is allowed."""
        return None if self._networks is None else tuple(map(str, self._networks))

    def __contains__(self, address: Address) -> bool:
        if self._networks is None:
            return True
        return any(address in network for network in self._networks)


def _parse_network(text: object) -> Network:
    if not isinstance(text, str):
        raise ValueError(f"allow: expected {_EXPECTED}, got {text!r}")
    host, slash, bits = text.partition("/")
    try:
        # Not netmasks (10.0.0.0/255.0.0.0), which can be read in two ways.
        if "%" in text or (slash and not (bits.isascii() and bits.isdecimal())):
            raise ValueError
        network = ip_network(text, strict=False)
    except ValueError:
        raise ValueError(f"allow: expected {_EXPECTED}, got {text!r}") from None
    if network.network_address != ip_address(host):
        raise ValueError(
            f"allow: {text!r} has host bits: expected '{network}' for the network "
            f"or '{ip_address(host)}' for the host"
        )
    if isinstance(network, IPv6Network) and network.subnet_of(_MAPPED):
        address = network.network_address.ipv4_mapped
        assert address is not None
        return IPv4Network((address, network.prefixlen - 96))
    return network
