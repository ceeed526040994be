"""Graph resource names: how they are written, resolved and remapped.

A name is global (``/camera/image``), relative (``image``) or private (``~rate``).
Relative names belong to the namespace of the node, private ones to the node itself.
Resolved names start with a slash, have no empty parts and no slash at the end.

ROS 1 programs accept far more names than the documentation allows (``/1abc``, ``/a-b``,
``/ü``), and robots in the field use them. This module therefore refuses only what no master
accepts: the empty name, ``/`` itself, blanks, colons and characters that XML cannot carry.
"""

from __future__ import annotations

import os
import platform
import random
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from aioros1.errors import InvalidNameError

__all__ = [
    "Arguments",
    "anonymous_name",
    "canonicalize",
    "is_global",
    "is_private",
    "join",
    "namespace_of",
    "normalize_namespace",
    "parse_args",
    "qualify",
    "resolve_from",
    "resolve_name",
    "resolve_remappings",
    "validate",
    "validate_base_name",
]

_EMPTY: Mapping[str, str] = {}


def is_global(name: str) -> bool:
    """Whether ``name`` starts at the root, as ``/a/b`` does."""
    return name[:1] == "/"


def is_private(name: str) -> bool:
    """Whether ``name`` belongs to a node, as ``~a`` does."""
    return name[:1] == "~"


def canonicalize(name: str) -> str:
    """``name`` without empty parts and without a slash at the end; ``/`` stays ``/``."""
    # Nearly every name is canonical already, and the test is cheaper than the work.
    if "//" not in name and (name[-1:] != "/" or name == "/"):
        return name
    parts = "/".join([part for part in name.split("/") if part])
    return "/" + parts if name[0] == "/" else parts


def namespace_of(name: str) -> str:
    """The namespace a name is in: ``/a`` for ``/a/b``, ``/`` for ``/a`` and for ``/``."""
    return canonicalize(name).rpartition("/")[0] or "/"


def normalize_namespace(namespace: str) -> str:
    """Return a namespace in its resolved form: ``/foo`` for ``foo``, ``/`` for an empty one.

    Raises :class:`InvalidNameError` for a private name, blanks and colons.
    """
    text = _name(namespace, "namespace")
    if is_private(text) or " " in text or ":" in text:
        raise InvalidNameError(
            f"{namespace!r} is not a namespace: expected one like '/robot/arm', "
            "without '~', blanks and colons"
        )
    return canonicalize("/" + text)


def join(namespace: str, name: str) -> str:
    """``name`` below ``namespace``; a global or private name is returned as it is."""
    if name[:1] in ("/", "~") or not namespace:
        return name
    if namespace == "~" or namespace[-1] == "/":
        return namespace + name
    return f"{namespace}/{name}"


def validate(name: str, what: str = "name") -> str:
    """Return ``name`` if a master would accept it, resolved or not.

    ``what`` says in the error text what the name is for. Raises :class:`InvalidNameError`,
    and :class:`TypeError` for anything but a string.
    """
    text = _name(name, what)
    if " " in text or ":" in text or not text.strip("/"):
        raise InvalidNameError(
            f"{name!r} is not a {what}: expected a name like 'scan', '/robot/scan' or '~scan', "
            "not empty, without blanks and colons"
        )
    return text


def validate_base_name(name: str, what: str = "node name") -> str:
    """Return ``name`` if it can be the last part of a node's name.

    The namespace of a node is given separately, so slashes are refused here. Raises as
    :func:`validate` does.
    """
    text = _name(name, what)
    if not text or any(char in text for char in "/~ :"):
        raise InvalidNameError(
            f"{name!r} is not a {what}: expected a single name like 'camera', not empty, without "
            "'/', '~', blanks and colons (a namespace is given apart from the name)"
        )
    return text


def qualify(namespace: str, base_name: str) -> str:
    """The full name of a node: ``/ns/base``, or ``/base`` in the root namespace."""
    return join(normalize_namespace(namespace), validate_base_name(base_name))


def resolve_name(
    name: str,
    namespace: str,
    node_name: str,
    remappings: Mapping[str, str] = _EMPTY,
    *,
    what: str = "name",
) -> str:
    """Resolve ``name`` as the node ``node_name`` means it.

    ``namespace`` and ``node_name`` must be resolved (``/ns`` and ``/ns/node``).
    ``remappings`` come from :func:`resolve_remappings` and apply to the resolved name, so
    ``scan:=laser`` applies to ``/ns/scan`` as well. Raises as :func:`validate` does; ``what``
    is for the error text.
    """
    resolved = _resolve(validate(name, what), namespace, node_name)
    return remappings.get(resolved, resolved)


def resolve_remappings(
    remappings: Mapping[str, str], namespace: str, node_name: str
) -> dict[str, str]:
    """Resolve both sides of remappings, as :func:`resolve_name` expects.

    Raises as :func:`validate` does; the error text contains the remapping.
    """
    resolved = {}
    for source, target in remappings.items():
        try:
            key = _resolve(validate(source, "name to remap"), namespace, node_name)
            value = _resolve(validate(target, "name to remap to"), namespace, node_name)
        except InvalidNameError as error:
            raise InvalidNameError(f"{source}:={target}: {error}") from None
        resolved[key] = value
    return resolved


def resolve_from(name: str, caller_id: str) -> str:
    """Resolve ``name`` as the node ``caller_id`` means it, refusing nothing.

    This is what masters do with the names they receive: ``caller_id`` is whatever the
    caller claims. An empty name resolves to its namespace, with a slash at the end.
    """
    if not name:
        return _namespace_prefix(caller_id)
    name = canonicalize(name)
    first = name[0]
    if first == "/":
        return name
    if first == "~":
        return canonicalize(f"{caller_id}/{name[1:]}")
    return _namespace_prefix(caller_id) + name


def anonymous_name(base: str) -> str:
    """Return a unique name made of ``base``, the host, the process and a random number."""
    host = re.sub(r"[^0-9A-Za-z]", "_", platform.node())
    return f"{validate_base_name(base)}_{host}_{os.getpid()}_{random.getrandbits(48)}"


@dataclass(frozen=True, slots=True)
class Arguments:
    """What the words of a command line mean to a node; made by :func:`parse_args`."""

    remappings: dict[str, str] = field(default_factory=dict)
    """``a:=b``, neither side resolved yet."""

    params: dict[str, str] = field(default_factory=dict)
    """``_rate:=10`` as ``{"rate": "10"}``: private parameters, the values as written."""

    special: dict[str, str] = field(default_factory=dict)
    """``__name:=x`` and the like, keys with both underscores."""

    rest: list[str] = field(default_factory=list)
    """Everything else, in order."""


_ASSIGNMENT = re.compile(r"([~/A-Za-z_][\w/]*):=(.*)", re.DOTALL)


def parse_args(argv: Iterable[str]) -> Arguments:
    """Sort the words of a command line (with or without the program's name).

    Words such as ``--a:=b`` are not remappings and stay in ``rest``. The last of several
    assignments to one name wins. An assignment of nothing (``a:=``, ``_a:=``) is ignored, as
    in rospy: that is what a launch file with an empty argument has. Raises :class:`TypeError`
    for anything but a list of words.
    """
    if isinstance(argv, str | bytes):
        raise TypeError(f"a command line is a list of words, not one: {argv!r}")
    arguments = Arguments()
    for word in argv:
        match = _ASSIGNMENT.fullmatch(_text(word, "word of a command line"))
        if match is None:
            arguments.rest.append(word)
            continue
        name, value = match[1], match[2].strip()
        if name.startswith("__"):
            arguments.special[name] = value
        elif not value:
            continue
        elif name.startswith("_") and len(name) > 1:
            arguments.params[name[1:]] = value
        else:
            arguments.remappings[name] = value
    return arguments


def _resolve(name: str, namespace: str, node_name: str) -> str:
    name = canonicalize(name)
    if name[0] == "/":
        return name
    if name[0] == "~":
        return canonicalize(f"{node_name}/{name[1:]}")
    return join(namespace, name)


def _namespace_prefix(caller_id: str) -> str:
    """The namespace of a caller, with the slash that joins a name to it."""
    if caller_id[-1:] == "/":
        caller_id = caller_id[:-1]
    return caller_id[: caller_id.rfind("/") + 1] or "/"


# Control characters and halves of surrogate pairs: no master can be told of them.
_UNSENDABLE = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")


def _name(name: object, what: str) -> str:
    text = _text(name, what)
    bad = _UNSENDABLE.search(text)
    if bad is not None:
        raise InvalidNameError(f"{name!r} is not a {what}: XML cannot carry {bad[0]!r}")
    return text


def _text(name: object, what: str) -> str:
    if not isinstance(name, str):
        hint = "; the name comes before the type" if isinstance(name, type) else ""
        raise TypeError(f"a {what} is a str, not {type(name).__name__}: {name!r:.200}{hint}")
    return name
