"""Measures values of XML-RPC without writing them."""

from __future__ import annotations

from collections.abc import Generator
from typing import Any

__all__ = ["Size"]

_STEP = 2048
_TAGS = 30  # bytes around a value


class Size:
    """How many values were added, and how many bytes they need."""

    __slots__ = ("bytes", "values")

    def __init__(self, value: Any = None) -> None:
        self.values = 0
        """Values, arrays and structs included."""
        self.bytes = 0
        """About as many as the document has."""
        if value is not None:
            for _ in self.adding(value):
                pass

    def __repr__(self) -> str:
        return f"<Size: {self.values} values, {self.bytes} bytes>"

    def exceeds(self, max_bytes: int, max_values: int) -> bool:
        """Whether it is more than that."""
        return self.bytes > max_bytes or self.values > max_values

    def adding(self, value: Any) -> Generator[None, None, None]:
        """Add ``value`` and all that is in it, in short steps."""
        pending = [value]
        while pending:
            value = pending.pop()
            self.values += 1
            self.bytes += _TAGS
            if isinstance(value, dict):
                pending += value.values()
                self.bytes += sum(map(len, value)) + _TAGS * len(value)
            elif isinstance(value, list | tuple):
                pending += value
            elif isinstance(value, str | bytes):
                self.bytes += len(value)
            if not self.values % _STEP:
                yield
