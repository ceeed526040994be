"""Who a node is, from its arguments, its command line and its environment."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from ipaddress import ip_address
from typing import Self, TypeVar
from urllib.parse import urlsplit

from aioros1 import names
from aioros1.errors import InvalidNameError
from aioros1.node.private_params import PrivateParams

__all__ = ["DEFAULT_MASTER_URI", "Identity", "master_uri_of"]

DEFAULT_MASTER_URI = "http://localhost:11311"

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Identity:
    """A node's name, its place in the graph, and its remappings."""

    base_name: str
    namespace: str
    master_uri: str
    host: str | None
    """The host to announce, if one is given."""
    host_words: str
    """Where the host comes from, as it was written: ``ROS_IP=10.0.0.2``."""
    remappings: Mapping[str, str]
    private_params: PrivateParams
    log_file: str | None
    """The file that ``__log:=`` names."""

    @property
    def name(self) -> str:
        """The full name."""
        return names.qualify(self.namespace, self.base_name)

    @classmethod
    def of(
        cls,
        name: str,
        argv: Sequence[str],
        namespace: str | None,
        master_uri: str | None,
        host: str | None,
        remap: Mapping[str, str] | None,
        anonymous: bool,
    ) -> Self:
        """Arguments override the command line, which overrides the environment.

        The name is the exception: the argument is only a default, which ``__name:=`` from
        roslaunch replaces. The name is then not made anonymous.

        Raises :class:`~aioros1.InvalidNameError`, and :class:`ValueError` for an invalid
        master URI, host or parameter value. Both name the word or variable that it comes
        from.
        """
        arguments = names.parse_args(argv)
        special = _Settings(arguments.special)
        base_name = special.read("__name", names.validate_base_name)
        if base_name is None:
            base_name = names.validate_base_name(name)
            if anonymous:
                base_name = names.anonymous_name(base_name)
        namespace = (
            (names.normalize_namespace(namespace) if namespace else None)
            or special.read("__ns", names.normalize_namespace)
            # As in rospy and roscpp, nothing is the root, whatever the environment says.
            or ("/" if "__ns" in special.values else None)
            or _ENVIRONMENT.read("ROS_NAMESPACE", names.normalize_namespace)
            or "/"
        )
        host, host_words = _host(host, special)
        return cls(
            base_name=base_name,
            namespace=namespace,
            master_uri=(
                (_check_uri(master_uri) if master_uri else None)
                or special.read("__master", _check_uri)
                or master_uri_of()
            ),
            host=host,
            host_words=host_words,
            remappings=names.resolve_remappings(
                {**arguments.remappings, **(remap or {})},
                namespace,
                names.qualify(namespace, base_name),
            ),
            private_params=PrivateParams.of(arguments.params),
            log_file=arguments.special.get("__log") or None,
        )


def master_uri_of(uri: str | None = None) -> str:
    """Return ``uri``, or else ``ROS_MASTER_URI``, or else the default URI.

    Raises :class:`ValueError` for a URI that cannot be a master's.
    """
    if uri:
        return _check_uri(uri)
    return _ENVIRONMENT.read("ROS_MASTER_URI", _check_uri) or DEFAULT_MASTER_URI


@dataclass(frozen=True, slots=True)
class _Settings:
    """Words of a command line, or environment variables."""

    values: Mapping[str, str]
    assign: str = ":="

    def read(self, name: str, check: Callable[[str], T]) -> T | None:
        """Return ``check(value)``; None when the value is not set or empty.

        Errors that ``check`` raises name where the value comes from.
        """
        value = self.values.get(name)
        if not value:
            return None
        try:
            return check(value)
        except ValueError as error:
            kind = InvalidNameError if isinstance(error, InvalidNameError) else ValueError
            raise kind(f"{self.words(name)}: {error}") from None

    def words(self, name: str) -> str:
        """The name and the value of a setting, as they were written."""
        return f"{name}{self.assign}{self.values[name]}"


_ENVIRONMENT = _Settings(os.environ, "=")


def _check_uri(uri: str) -> str:
    try:
        parts = urlsplit(uri)
        host = parts.hostname or ""
        valid = parts.scheme == "http" and _is_host(host) and parts.port != 0
        # urlsplit drops blanks around it and line ends in it, but others do not.
        valid = valid and not any(map(str.isspace, uri))
    except (ValueError, AttributeError):  # AttributeError when it is not a str
        valid = False
    if not valid:
        raise ValueError(f"master URI {uri!r}: expected http://host:port")
    return uri


def _host(argument: str | None, special: _Settings) -> tuple[str | None, str]:
    """The host to announce, and where it comes from."""
    if argument:
        return _check_host(argument), f"host={argument!r}"
    for settings, name in (
        *((special, "__hostname"), (special, "__ip")),
        *((_ENVIRONMENT, "ROS_HOSTNAME"), (_ENVIRONMENT, "ROS_IP")),
    ):
        host = settings.read(name, _check_host)
        if host is not None:
            return host, settings.words(name)
    return None, ""


def _check_host(host: str) -> str:
    if not _is_host(host):
        raise ValueError(
            f"host {host!r}: expected a host name or an address like 'robot.local' or '10.0.0.2', "
            "without a port"
        )
    return host


def _is_host(host: str) -> bool:
    """Whether it can be a host. Only those who are told to use it know whether it is one."""
    if ":" in host:  # only an IPv6 address, which may have a zone
        return _is_ipv6(host.partition("%")[0])
    return host.isprintable() and not any(char in " /?#@[]" for char in host) and bool(host)


def _is_ipv6(address: str) -> bool:
    try:
        return ip_address(address).version == 6
    except ValueError:
        return False
