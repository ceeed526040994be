"""The types there are, by kind."""

from __future__ import annotations

import re
from collections.abc import Iterable
from fnmatch import fnmatchcase
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from aioros1 import MessageStore
    from aioros1.idl import Kind

__all__ = ["all_types", "matching", "packages"]

_WILDCARD = re.compile(r"[*?\[]")


def packages(store: MessageStore, kind: Kind) -> list[str]:
    """The packages that have types of the kind."""
    from aioros1.idl import types_of

    return [package for package in store.packages() if types_of(store, package, kind)]


def all_types(store: MessageStore, kind: Kind) -> list[str]:
    """All types of the kind, as ``pkg/Type``."""
    from aioros1.idl import types_of

    return [name for package in store.packages() for name in types_of(store, package, kind)]


def matching(pattern: str, names: Iterable[str]) -> list[str]:
    """The names that a pattern with wildcards fits, or that have the plain text in them.

    Lower case and upper case are the same.
    """
    pattern = pattern.lower()
    if _WILDCARD.search(pattern):
        return [name for name in names if fnmatchcase(name.lower(), pattern)]
    return [name for name in names if pattern in name.lower()]
