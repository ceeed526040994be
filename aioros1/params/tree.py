"""The tree of parameters: finding a key in it and changing part of a value. Pure."""

from __future__ import annotations

from typing import Any

__all__ = ["dig", "graft", "is_below", "path_to"]


def is_below(key: str, other: str) -> bool:
    """Whether ``key`` lies below ``other``."""
    return other == "/" or key.startswith(other + "/")


def path_to(key: str, above: str) -> list[str]:
    """The names that lead from ``above`` to ``key`` below it."""
    return key[len(above.rstrip("/")) + 1 :].split("/")


def dig(value: Any, path: list[str]) -> Any:
    """The part of ``value`` at ``path``; ``{}`` where there is none."""
    for name in path:
        if not isinstance(value, dict) or name not in value:
            return {}
        value = value[name]
    return value


def graft(tree: Any, path: list[str], value: Any) -> Any:
    """``tree`` with ``value`` at ``path``, replacing whatever blocks the path.

    Removes a deleted key, which is announced as ``{}``.
    """
    tree = dict(tree) if isinstance(tree, dict) else {}
    name, *rest = path
    if rest:
        tree[name] = graft(tree.get(name), rest, value)
    elif isinstance(value, dict) and not value:
        tree.pop(name, None)
    else:
        tree[name] = value
    return tree
