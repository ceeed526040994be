"""Who a node is, from its arguments, its command line and its environment."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from ipaddress import ip_address
from typing import Any, Self, TypeVar
from urllib.parse import urlsplit

from aioros1 import names
from aioros1.errors import InvalidNameError
from aioros1.node.private_params import parse_value

__all__ = ["DEFAULT_MASTER_URI", "Identity", "master_uri_of"]

DEFAULT_MASTER_URI = "http://localhost:11311"

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Identity:
    """A node's name, its place in the graph, and how it calls others."""

    base_name: str
    namespace: str
    master_uri: str
    host: str | None
    """What others are told to connect to, if anything says."""
    host_words: str
    """What says so, as it was written: ``ROS_IP=10.0.0.2``."""
    remappings: Mapping[str, str]
    private_params: Mapping[str, Any]
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
        """Arguments count most, then the command line, then the environment.

        Only the name is different: it is a program's default, which ``__name:=`` of
        roslaunch replaces, and then it is not made anonymous.

        Raises :class:`~aioros1.InvalidNameError`, and :class:`ValueError` for a master
        URI, a host or a parameter value that cannot be read; both name the word or the
        variable that it comes from.
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
            private_params=_private_params(arguments.params),
            log_file=arguments.special.get("__log") or None,
        )


def master_uri_of(uri: str | None = None) -> str:
    """``uri`` itself, or what ``ROS_MASTER_URI`` says, or the usual one.

    Raises :class:`ValueError` for what is no URI of a master.
    """
    if uri:
        return _check_uri(uri)
    return _ENVIRONMENT.read("ROS_MASTER_URI", _check_uri) or DEFAULT_MASTER_URI


@dataclass(frozen=True, slots=True)
class _Settings:
    """Words of a command line, or variables of the environment."""

    values: Mapping[str, str]
    assign: str = ":="

    def read(self, name: str, check: Callable[[str], T]) -> T | None:
        """What ``check`` makes of a value; None when it is not set, or to nothing.

        What ``check`` raises names where the value comes from.
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
        """A value that is set, and its name, as it was written."""
        return f"{name}{self.assign}{self.values[name]}"


_ENVIRONMENT = _Settings(os.environ, "=")


def _private_params(words: Mapping[str, str]) -> dict[str, Any]:
    params = {}
    for key, text in words.items():
        try:
            params[key] = parse_value(text)
        except ValueError as error:
            raise ValueError(f"_{key}:={text}: {error}") from error
    return params


def _check_uri(uri: str) -> str:
    try:
        parts = urlsplit(uri)
        host = parts.hostname or ""
        valid = parts.scheme == "http" and _is_host(host) and parts.port != 0
        # Blanks around it and line ends in it are dropped by urlsplit, but not by others.
        valid = valid and not any(map(str.isspace, uri))
    except (ValueError, AttributeError):  # the latter for what is not a str
        valid = False
    if not valid:
        raise ValueError(f"master URI {uri!r}: expected http://host:port")
    return uri


def _host(argument: str | None, special: _Settings) -> tuple[str | None, str]:
    """What others are told to connect to, and what says so."""
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
    """Whether it can be one. Whether it is, only those know whom it is told."""
    if ":" in host:  # nothing but an IPv6 address, which may have a zone
        return _is_ipv6(host.partition("%")[0])
    return host.isprintable() and not any(char in " /?#@[]" for char in host) and bool(host)


def _is_ipv6(address: str) -> bool:
    try:
        return ip_address(address).version == 6
    except ValueError:
        return False
