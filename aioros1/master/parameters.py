"""The tree of parameters, and which nodes to tell of a change. Pure: no I/O, no event loop.

Keys are resolved names. A dict is a namespace, anything else a parameter; an empty dict
is a namespace without parameters. The tree is never changed in place: values read from it
stay as they were, so answers and notifications need no copies.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from aioros1.names import is_global, is_private, join
from aioros1.wire.xmlrpc import MAX_DEPTH
from aioros1.wire.xmlrpc_size import Size

__all__ = [
    "MAX_NAME",
    "ParamUpdate",
    "ParameterTree",
    "holds_nil",
    "param_updates",
    "subscription_key",
]


_NAMESPACE = 60  # bytes around its name

MAX_NAME = 1_024
"""Characters of a name or a key."""


class ParamUpdate(NamedTuple):
    """A notification to the node ``caller_id`` at ``api`` that a parameter has changed."""

    api: str
    caller_id: str
    key: str
    """The changed key, with a slash at the end, as every master sends it."""
    value: Any
    """The new value; an empty dict means that there is none."""


class ParameterTree:
    """All the parameters of a master.

    ``max_depth`` bounds how deep namespaces, arrays and structs are nested: the whole tree
    has to fit an answer that peers can read. ``max_bytes`` and ``max_values`` bound all of it,
    and ``max_names`` the bytes of all names together: each holds those of its namespaces.
    """

    def __init__(
        self,
        *,
        max_depth: int = MAX_DEPTH - 1,
        max_bytes: int = 256 << 20,
        max_values: int = 500_000,
        max_names: int = 64 << 20,
    ) -> None:
        self._root: dict[str, Any] = {}
        self._max_names = max_names
        self._max_depth = max_depth
        self._max_bytes = max_bytes
        self._max_values = max_values
        # At least as much as there is. Counted again when that may be too much.
        self._bytes = self._values = 0

    def get(self, key: str) -> Any:
        """The value or the namespace at ``key``. Raises :class:`KeyError`."""
        node: Any = self._root
        for part in _parts(key):
            if not isinstance(node, dict) or part not in node:
                raise KeyError(key)
            node = node[part]
        return node

    def has(self, key: str) -> bool:
        """Whether there is a value or a namespace at ``key``."""
        try:
            self.get(key)
        except KeyError:
            return False
        return True

    def set(self, key: str, value: Any) -> None:
        """Replace whatever is at ``key``; a dict becomes a namespace.

        A namespace replaces a plain value on the path to ``key``. Raises :class:`TypeError`
        for a root that is not a dict, and :class:`ValueError` for a tree that would get too
        deep or too large.
        """
        parts = _parts(key)
        if not parts and not isinstance(value, dict):
            raise TypeError("cannot set root of parameter tree to non-dictionary")
        size = Size(value)
        if len(parts) + size.depth > self._max_depth:
            raise ValueError(f"more than {self._max_depth} namespaces inside one another")
        self._make_room(parts, size)
        for part, node in reversed(list(zip(parts, self._branch(parts), strict=True))):
            value = {**node, part: value}
        self._root = value

    def delete(self, key: str) -> None:
        """Remove ``key`` and everything below it. Raises :class:`KeyError`, also for the root.

        The namespace that it was in stays, even if it is now empty.
        """
        parts = _parts(key)
        if not parts or not self.has(key):
            raise KeyError(key)
        branch = self._branch(parts)
        node = {name: value for name, value in branch[-1].items() if name != parts[-1]}
        for part, parent in reversed(list(zip(parts[:-1], branch[:-1], strict=True))):
            node = {**parent, part: node}
        self._root = node

    def search(self, caller_id: str, key: str) -> str | None:
        """The name under which the node ``caller_id`` finds ``key``, or ``None``.

        The search starts in the node's private namespace and goes up. Only the first part
        of ``key`` has to exist: if ``/ns/arm`` does, a search for ``arm/speed`` returns
        ``/ns/arm/speed``, set or not. Raises :class:`ValueError` for a private key and for a
        ``caller_id`` that is not global.
        """
        if not key or is_private(key):
            raise ValueError("invalid key")
        if not is_global(caller_id):
            raise ValueError("namespace must be global")
        if is_global(key):
            return key if self.has(key) else None
        first = _parts(key)[0]
        if self.has(join(caller_id, first)):
            return join(caller_id, key)
        namespaces = _parts(caller_id)
        while namespaces:
            namespaces.pop()
            namespace = "/" + "/".join(namespaces)
            if self.has(join(namespace, first)):
                return join(namespace, key)
        return None

    def names(self) -> list[str]:
        """The full names of all parameters; namespaces are not among them, nor names that are
        too long to ask for.

        Raises :class:`ValueError` if they are too many for an answer.
        """
        names: list[str] = []
        room = self._max_names
        for name in _names("", self._root):
            room -= len(name)
            if room < 0:
                raise ValueError(f"the names have more than {self._max_names} characters together")
            names.append(name)
        return names

    def _make_room(self, parts: list[str], size: Size) -> None:
        size.values += len(parts)
        size.bytes += sum(map(len, parts)) + _NAMESPACE * len(parts)
        most_bytes, most_values = self._max_bytes - size.bytes, self._max_values - size.values
        if self._bytes > most_bytes or self._values > most_values:
            now, replaced = Size(self._root), Size(self._replaced(parts))
            self._bytes, self._values = now.bytes, now.values
            if now.bytes - replaced.bytes > most_bytes:
                raise ValueError(f"more than {self._max_bytes} bytes of parameters")
            if now.values - replaced.values > most_values:
                raise ValueError(f"more than {self._max_values} values in all parameters")
        self._bytes += size.bytes
        self._values += size.values

    def _replaced(self, parts: list[str]) -> Any:
        """What a new value takes the place of; None if there is nothing."""
        node: Any = self._root
        for part in parts:
            if not isinstance(node, dict):
                break
            node = node.get(part)
        return node

    def _branch(self, parts: list[str]) -> list[dict[str, Any]]:
        """The namespaces that hold each of ``parts``; empty ones where there are none."""
        branch: list[dict[str, Any]] = []
        node: Any = self._root
        for part in parts:
            node = node if isinstance(node, dict) else {}
            branch.append(node)
            node = node.get(part)
        return branch


def param_updates(
    subscribers: Mapping[str, Mapping[str, str]],
    key: str,
    value: Any,
    *,
    setter: str | None = None,
) -> list[ParamUpdate]:
    """The notifications after ``value`` was set at ``key``; an empty dict means deleted.

    ``subscribers`` holds, for each :func:`subscription_key`, the nodes and their URIs.
    Followers of ``key`` or of a namespace above are told of ``key`` itself, except the node
    that has set it (``setter``). Followers of a key below are told of their own part, or
    that it is gone if ``value`` does not have it.
    """
    if not subscribers:
        return []
    changed = subscription_key(key)
    updates: list[ParamUpdate] = []
    namespace = changed
    while True:
        for caller_id, api in subscribers.get(namespace, {}).items():
            if caller_id != setter:
                updates.append(ParamUpdate(api, caller_id, changed, value))
        if namespace == "/":
            break
        namespace = namespace[: namespace.rindex("/", 0, -1) + 1]
    for followed, nodes in subscribers.items():
        if len(followed) > len(changed) and followed.startswith(changed):
            part = _descend(value, followed[len(changed) :])
            updates += [ParamUpdate(api, node, followed, part) for node, api in nodes.items()]
    return updates


def subscription_key(key: str) -> str:
    """``key`` with exactly one slash at the end, so that ``/a`` is no prefix of ``/ab``."""
    return "/".join(["", *_parts(key), ""])


def holds_nil(value: Any) -> bool:
    """Whether ``value`` is a nil or contains one.

    A server that stores a nil can never again answer for it or for any namespace above.
    """
    return Size(value).has_nil


def _parts(key: str) -> list[str]:
    return [part for part in key.split("/") if part]


def _descend(value: Any, path: str) -> Any:
    for part in _parts(path):
        if not isinstance(value, dict) or part not in value:
            return {}
        value = value[part]
    return value


def _names(namespace: str, node: Mapping[str, Any]) -> Iterator[str]:
    for name, value in node.items():
        if len(namespace) + len(name) >= MAX_NAME:
            continue
        full = f"{namespace}/{name}"
        if isinstance(value, dict):
            yield from _names(full, value)
        else:
            yield full
