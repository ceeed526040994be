"""Finds out why bytes are not a message, after a decoder has failed."""

from __future__ import annotations

import struct
from collections.abc import Callable
from typing import Any

from aioros1.errors import DeserializationError
from aioros1.idl.builtin_types import BUILTINS
from aioros1.idl.codegen_decode import MAX_EMPTY
from aioros1.idl.spec import Field
from aioros1.idl.structure import Structure

__all__ = ["explainer"]

_length = struct.Struct("<I").unpack_from


class _Reader:
    """Steps over the fields of a message, and makes nothing, until one does not fit."""

    def __init__(self, cls: type[Structure], data: Any, pos: int, end: int) -> None:
        self.cls = cls
        self.data = data
        self.start = self.pos = pos
        self.end = min(end, len(data))
        self.empty = 0

    def fail(self, path: str, text: str) -> DeserializationError:
        place = f"{self.cls._type}.{path}" if path else self.cls._type
        return DeserializationError(f"{place}: {text} at offset {self.pos - self.start}")

    def step(self, size: int, path: str) -> None:
        left = self.end - self.pos
        if size > left:
            raise self.fail(path, f"{size} bytes expected, {max(left, 0)} left")
        self.pos += size

    def length(self, path: str) -> int:
        self.step(4, path)
        count: int = _length(self.data, self.pos - 4)[0]
        return count

    def hollow(self, count: int, path: str) -> None:
        self.empty += count
        if self.empty > MAX_EMPTY:
            raise self.fail(path, f"{count} messages without content, more than accepted")

    def message(self, cls: type[Structure], path: str) -> None:
        for field in cls._fields:
            self.field(cls, field, f"{path}.{field.name}" if path else field.name)

    def field(self, cls: type[Structure], field: Field, path: str) -> None:
        builtin = BUILTINS.get(field.base_type)
        nested = None if builtin is not None else cls._nested[field.base_type]
        if builtin is not None:
            size = builtin.size if builtin.kind != "string" else None
        else:
            assert nested is not None
            size = nested._fixed_size
        count = 1
        if field.is_array:
            count = self.length(path) if field.array_len is None else field.array_len
        if size is not None:
            if nested is not None:
                self.hollow(count * (nested._hollow + (field.is_array and size == 0)), path)
            self.step(count * size, path)
            return
        smallest = 4 if nested is None else nested._min_size
        if field.is_array and count * smallest > self.end - self.pos:
            self.step(count * smallest, path)
        for index in range(count):
            place = f"{path}[{index}]" if field.is_array else path
            if nested is None:
                self.step(self.length(place), place)
            else:
                self.message(nested, place)


def explainer(
    cls: type[Structure], *, exact: bool
) -> Callable[[Any, int, int], DeserializationError]:
    """The function that a decoder of ``cls`` calls for the error that it raises."""

    def explain(data: Any, pos: int, end: int) -> DeserializationError:
        reader = _Reader(cls, data, pos, end)
        try:
            reader.message(cls, "")
        except DeserializationError as error:
            return error
        left = reader.end - reader.pos
        if exact and left:
            return reader.fail("", f"{left} bytes too many")
        return reader.fail("", "not a message of this type, for a reason unknown")

    return explain
