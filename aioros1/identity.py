"""Who a node is, from its arguments, its command line and its environment."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Self
from urllib.parse import urlsplit

from aioros1 import names
from aioros1.private_params import parse_value

__all__ = ["DEFAULT_MASTER_URI", "Identity"]

DEFAULT_MASTER_URI = "http://localhost:11311"


@dataclass(frozen=True, slots=True)
class Identity:
    """A node's name, its place in the graph, and how it calls others."""

    base_name: str
    namespace: str
    master_uri: str
    host: str | None
    """What others are told to connect to, if anything says."""
    remappings: Mapping[str, str]
    private_params: Mapping[str, Any]

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
        URI or a parameter value that cannot be read.
        """
        arguments = names.parse_args(argv)
        special, environ = arguments.special, os.environ
        base_name = names.validate_base_name(special.get("__name", name))
        if anonymous and "__name" not in special:
            base_name = names.anonymous_name(base_name)
        namespace = names.normalize_namespace(
            _first(namespace, special.get("__ns"), environ.get("ROS_NAMESPACE")) or "/"
        )
        return cls(
            base_name=base_name,
            namespace=namespace,
            master_uri=_http_uri(
                _first(master_uri, special.get("__master"), environ.get("ROS_MASTER_URI"))
                or DEFAULT_MASTER_URI
            ),
            host=_first(
                host,
                special.get("__hostname"),
                special.get("__ip"),
                environ.get("ROS_HOSTNAME"),
                environ.get("ROS_IP"),
            ),
            remappings=names.resolve_remappings(
                {**arguments.remappings, **(remap or {})},
                namespace,
                names.qualify(namespace, base_name),
            ),
            private_params={key: parse_value(text) for key, text in arguments.params.items()},
        )


def _first(*values: str | None) -> str | None:
    """The first that is neither None nor empty."""
    return next((value for value in values if value), None)


def _http_uri(uri: str) -> str:
    try:
        parts = urlsplit(uri)
        valid = parts.scheme == "http" and parts.hostname and (parts.port or 1)
    except ValueError:
        valid = False
    if not valid:
        raise ValueError(f"master URI {uri!r}: expected http://host:port")
    return uri
