"""The tree of parameters: finding a key in it and changing part of a value. Pure."""

from __future__ import annotations

from typing import Any

__all__ = ["dig", "graft", "is_below", "path_to", "same", "weight"]


def is_below(key: str, other: str) -> bool:
    """Whether ``key`` lies below ``other``."""
    return key != other and key.startswith(other if other == "/" else other + "/")


def path_to(key: str, above: str) -> list[str]:
    """The names that lead from ``above`` to ``key`` below it; none if they are the same."""
    return [name for name in key[len(above.rstrip("/")) :].split("/") if name]


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
    if not path:
        return value
    tree = dict(tree) if isinstance(tree, dict) else {}
    name, *rest = path
    if rest:
        tree[name] = graft(tree.get(name), rest, value)
    elif isinstance(value, dict) and not value:
        tree.pop(name, None)
    else:
        tree[name] = value
    return tree


def same(one: Any, other: Any) -> bool:
    """Whether two values are the same parameter: equal, and of one type at every place.

    ``1``, ``1.0`` and ``True`` are three values, and NaN is the same as NaN.
    """
    pending = [(one, other)]
    while pending:
        one, other = pending.pop()
        if one is other:
            continue
        if type(one) is not type(other):
            return False
        if isinstance(one, dict):
            if one.keys() != other.keys():
                return False
            pending += [(value, other[key]) for key, value in one.items()]
        elif isinstance(one, list):
            if len(one) != len(other):
                return False
            pending += zip(one, other, strict=True)
        elif one != other and (one == one or other == other):
            return False
    return True


def weight(value: Any) -> int:
    """About how many bytes of memory ``value`` takes."""
    total = 0
    pending = [value]
    while pending:
        value = pending.pop()
        total += 56
        if isinstance(value, (str, bytes)):
            total += len(value)
        elif isinstance(value, dict):
            total += sum(map(len, value))
            pending += value.values()
        elif isinstance(value, list):
            pending += value
    return total
