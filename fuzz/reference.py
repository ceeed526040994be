"""What octets mean, worked out the slow way: field by field, from the definition alone.

No generated code, no memory of what was read before. A message is read as a *tree* that
says all there is to compare: a message is the tuple of its fields, a list a list, an array
of numbers its octets, a floating point number the octets of the double that it is.
:func:`tree` shows a decoded message as the same, and minds the types of its values.
"""

from __future__ import annotations

import struct
from array import array
from functools import lru_cache
from random import Random
from typing import Any, NamedTuple

from aioros1.idl import Message
from aioros1.idl.builtin_types import BUILTINS
from aioros1.idl.spec import Field
from aioros1.time import Duration, Time

__all__ = ["MAX_EMPTY", "Malformed", "Reading", "read", "sample", "tree"]

MAX_EMPTY = 65536
"""Messages without octets that a message may hold in its arrays."""

_TIMES = {"time": Time, "duration": Duration}
_TYPES = {"int": int, "float": float, "bool": bool, "string": str, **_TIMES}
_U32 = struct.Struct("<I")
_double = struct.Struct("<d").pack


class Malformed(Exception):
    """Octets that are no message: where they stop being one."""

    def __init__(self, offset: int) -> None:
        super().__init__(offset)
        self.path = ""
        self.offset = offset

    def inside(self, place: str) -> None:
        dot = "." if self.path and not self.path.startswith("[") else ""
        self.path = f"{place}{dot}{self.path}"

    def __str__(self) -> str:
        return f"{self.path} at offset {self.offset}"


class Reading(NamedTuple):
    """A message that was read: ``octets`` are how it is written, ``used`` how many it took.

    The octets differ from those read where a boolean was neither 0 nor 1, and where a
    float32 was a signalling NaN, which a Python float cannot be on all machines.
    """

    tree: Any
    octets: bytes
    used: int


def read(cls: type[Message], data: bytes) -> Reading:
    """Read a message from the start of ``data``; raises :class:`Malformed`."""
    reader = _Reader(data)
    value = reader.message(cls)
    return Reading(value, bytes(reader.out), reader.pos)


class _Item(NamedTuple):
    """A field, or each element of one, with what is asked of its type again and again."""

    name: str
    kind: str
    is_array: bool
    array_len: int | None
    code: str
    packer: struct.Struct
    nested: Any
    hollow: int
    """How many messages without octets come with each element, if it is one itself."""


@lru_cache(maxsize=256)
def _items(cls: type[Message]) -> list[_Item]:
    items = []
    for field in cls._fields:
        builtin = BUILTINS.get(field.base_type)
        nested = cls._nested.get(field.base_type)
        kind, code = ("message", "") if builtin is None else (builtin.kind, builtin.code)
        if builtin is not None and builtin.octets and field.is_array:
            code = "bytes"
        hollow = 1 + _hollows(nested) if nested is not None and _is_hollow(nested) else 0
        packer = struct.Struct("<" + (builtin.code if builtin is not None else ""))
        items.append(
            _Item(field.name, kind, field.is_array, field.array_len, code, packer, nested, hollow)
        )
    return items


class _Reader:
    def __init__(self, data: bytes) -> None:
        self.data = data
        self.pos = 0
        self.empty = 0
        self.out = bytearray()

    def take(self, size: int) -> bytes:
        start = self.pos
        if len(self.data) - start < size:
            raise Malformed(start)
        self.pos = start + size
        return self.data[start : self.pos]

    def count(self) -> int:
        octets = self.take(4)
        self.out += octets
        return int.from_bytes(octets, "little")

    def message(self, cls: type[Message]) -> tuple[Any, ...]:
        values = []
        for item in _items(cls):
            try:
                values.append(self.array(item) if item.is_array else self.one(item))
            except Malformed as error:
                error.inside(item.name)
                raise
        return tuple(values)

    def array(self, item: _Item) -> Any:
        count = self.count() if item.array_len is None else item.array_len
        if item.kind in ("int", "float"):
            octets = self.take(count * item.packer.size)
            self.out += octets
            return octets
        if item.hollow:
            self.empty += count * item.hollow
            if self.empty > MAX_EMPTY:
                raise Malformed(self.pos)
            return count, _Reader(b"").message(item.nested) if count else None
        values: list[Any] = []
        try:
            for _ in range(count):
                values.append(self.one(item))  # noqa: PERF401 - its length is needed below
        except Malformed as error:
            error.inside(f"[{len(values)}]")
            raise
        return values

    def one(self, item: _Item) -> Any:
        if item.kind == "message":
            return self.message(item.nested)
        if item.kind == "string":
            octets = self.take(self.count())
            self.out += octets
            return octets.decode("utf-8", "surrogateescape")
        values = item.packer.unpack(self.take(item.packer.size))
        self.out += item.packer.pack(*values)
        if item.kind == "float":
            return _double(values[0])
        return values if item.kind in _TIMES else values[0]


def _is_hollow(cls: type[Message]) -> bool:
    """Whether messages of the type have no octets at all."""
    return all(
        field.array_len == 0
        or (
            not field.is_builtin
            and (not field.is_array or field.array_len is not None)
            and _is_hollow(cls._nested[field.base_type])
        )
        for field in cls._fields
    )


def _hollows(cls: type[Message]) -> int:
    """How many messages without octets are inside one that has none itself."""
    total = 0
    for field in cls._fields:
        nested = cls._nested.get(field.base_type)
        if nested is not None:
            each = _hollows(nested)
            total += field.array_len * (1 + each) if field.array_len is not None else each
    return total


# -- messages as trees ---------------------------------------------------------------


def tree(cls: type[Message], message: Any) -> tuple[Any, ...]:
    """The tree of a decoded message; AssertionError where a value is of the wrong type."""
    assert type(message) is cls, f"a {type(message)}, not a {cls}"
    values = []
    for item in _items(cls):
        value = getattr(message, item.name)
        values.append(_array(item, value) if item.is_array else _one(item, value))
    return tuple(values)


def _array(item: _Item, value: Any) -> Any:
    if item.kind in ("int", "float"):
        kind = type(value)
        if kind is memoryview:
            code = "B" if item.code == "bytes" else item.code
            assert (value.format, value.ndim) == (code, 1), f"{item.name}: not a view of {code}"
        elif item.code == "bytes":
            assert kind is bytes, f"{item.name}: a {kind}"
            return value
        else:
            assert kind is array, f"{item.name}: a {kind}"
            assert value.typecode == item.code, f"{item.name}: an array of {value.typecode}"
        return value.tobytes()
    assert type(value) is list, f"{item.name}: a {type(value)}"
    if item.hollow:
        # One is like the other; there can be very many.
        assert {item.nested}.issuperset(map(type, value)), f"{item.name}: not all are right"
        return len(value), tree(item.nested, value[0]) if value else None
    return [_one(item, each) for each in value]


def _one(item: _Item, value: Any) -> Any:
    kind = item.kind
    if kind == "message":
        return tree(item.nested, value)
    assert type(value) is _TYPES[kind], f"{item.name}: a {type(value)}"
    if kind == "float":
        return _double(value)
    if kind in _TIMES:
        assert type(value.secs) is type(value.nsecs) is int
        return value.secs, value.nsecs
    return value


# -- octets to begin with ------------------------------------------------------------


def sample(cls: type[Message], values: Random, shape: Random) -> bytes:
    """The octets of a random message; the lengths in it are drawn from ``shape`` alone."""
    return b"".join(_sample_field(cls, field, values, shape) for field in cls._fields)


def _sample_field(cls: type[Message], field: Field, values: Random, shape: Random) -> bytes:
    builtin = BUILTINS.get(field.base_type)
    prefix, count = b"", 1
    if field.is_array:
        count = field.array_len if field.array_len is not None else shape.choice((0, 1, 1, 2, 5))
        prefix = _U32.pack(count) if field.array_len is None else b""
    if builtin is None:
        nested = cls._nested[field.base_type]
        return prefix + b"".join(sample(nested, values, shape) for _ in range(count))
    if builtin.kind == "bool":
        return prefix + bytes(values.choice((0, 1)) for _ in range(count))
    if builtin.kind != "string":
        return prefix + values.randbytes(builtin.size * count)
    parts = [prefix]
    for _ in range(count):
        text = _sample_text(values, shape.choice((0, 1, 3, 8, 20)))
        parts += (_U32.pack(len(text)), text)
    return b"".join(parts)


def _sample_text(values: Random, length: int) -> bytes:
    kind = values.randrange(8)
    if kind == 0:
        return values.randbytes(length)
    if kind == 1:
        return ("é" * length).encode()[:length]
    return bytes(values.choices(b"abcdefgh_/ 01", k=length))
