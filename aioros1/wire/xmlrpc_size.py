"""Measures values of XML-RPC without writing them."""

from __future__ import annotations

from collections.abc import Generator
from itertools import chain
from typing import Any

__all__ = ["Size"]

_TAGS = 30  # bytes around a value


class Size:
    """How many values were added, how deep they are, and how many bytes they need.

    A value is measured level by level, because Python is quick to look at many at once.
    """

    __slots__ = ("bytes", "depth", "has_nil", "values")

    def __init__(self, value: Any = ()) -> None:
        self.values = 0
        """Values, arrays and structs included."""
        self.bytes = 0
        """About as many as the document has."""
        self.depth = 0
        """How deep arrays and structs are nested."""
        self.has_nil = False
        """Whether any of them is None."""
        for _ in self.adding(value):
            pass

    def __repr__(self) -> str:
        return f"<Size: {self.values} values, {self.bytes} bytes, {self.depth} deep>"

    def exceeds(self, max_bytes: int, max_values: int) -> bool:
        """Whether it is more than that."""
        return self.bytes > max_bytes or self.values > max_values

    def adding(self, value: Any) -> Generator[None, None, None]:
        """Add ``value`` and all that is in it, a level in each step."""
        level = [value]
        depth = 0
        while level:
            self.values += len(level)
            self.bytes += _TAGS * len(level)
            kinds = set(map(type, level))
            if type(None) in kinds:
                self.has_nil = True
            if not kinds.isdisjoint(_TEXTS):
                self.bytes += sum(len(each) for each in level if isinstance(each, str | bytes))
            if kinds.isdisjoint(_CONTAINERS):
                break
            depth += 1
            lists = [each for each in level if isinstance(each, list | tuple)]
            structs = [each for each in level if isinstance(each, dict)]
            for struct in structs:
                self.bytes += sum(map(len, struct)) + _TAGS * len(struct)
            inner = (struct.values() for struct in structs)
            level = list(chain(chain.from_iterable(lists), chain.from_iterable(inner)))
            yield
        self.depth = max(self.depth, depth)


_TEXTS = frozenset({str, bytes})
_CONTAINERS = frozenset({dict, list, tuple})
