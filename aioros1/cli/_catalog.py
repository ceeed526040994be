"""The types there are, by kind, and those that somebody may have meant."""

from __future__ import annotations

import re
from collections.abc import Iterable
from difflib import SequenceMatcher
from fnmatch import fnmatchcase
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from aioros1 import MessageStore
    from aioros1.idl import Kind

__all__ = ["all_types", "matching", "near_misses", "packages"]

_WILDCARD = re.compile(r"[*?\[]")
# How like, from 0 to 1, a package and a type must at least be to be taken for another.
_PACKAGE_LIKENESS, _TYPE_LIKENESS = 0.5, 0.7


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


def near_misses(wrong: str, names: Iterable[str]) -> list[str]:
    """The few names that are like a wrong one, the likest first.

    Of a wrong name without a package, the types alone are compared. The ways of other
    languages to write a type, ``pkg::Type`` and ``pkg.msg.Type``, are understood.
    """
    words = [word for word in re.split(r"\W+", wrong.lower()) if word]
    if not words:
        return []
    found = []
    for name in names:
        package, _, type_ = name.lower().rpartition("/")
        likeness = _likeness(words[-1], type_), _likeness(words[0], package)
        if len(words) == 1:
            likeness = likeness[0], 1.0
        if likeness[0] >= _TYPE_LIKENESS and likeness[1] >= _PACKAGE_LIKENESS:
            found.append((-sum(likeness), name))
    return [name for _, name in sorted(found)[:3]]


def _likeness(first: str, second: str) -> float:
    return SequenceMatcher(None, first, second).ratio()
