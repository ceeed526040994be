"""The built-in types of definitions: numbers, strings, times."""

from __future__ import annotations

from typing import Final, NamedTuple

__all__ = ["BUILTINS", "CONSTANT_TYPES", "HEADER_TYPE", "Builtin", "is_builtin"]


class Builtin(NamedTuple):
    """One built-in type.

    ``kind`` is ``int``, ``float``, ``bool``, ``string``, ``time`` or ``duration``.
    ``code`` holds the letters of :mod:`struct` for one value (for a string: its length),
    and ``size`` is the number of bytes that one value takes at least. ``low`` and
    ``high`` are the range of an integer. ``octets`` says whether arrays of the type are
    :class:`bytes`.
    """

    name: str
    kind: str
    code: str
    size: int
    low: int = 0
    high: int = 0
    octets: bool = False


def _integer(name: str, code: str, bits: int, *, signed: bool, octets: bool = False) -> Builtin:
    low = -(1 << bits - 1) if signed else 0
    high = (1 << bits - 1) - 1 if signed else (1 << bits) - 1
    return Builtin(name, "int", code, bits // 8, low, high, octets)


BUILTINS: Final[dict[str, Builtin]] = {
    builtin.name: builtin
    for builtin in (
        _integer("int8", "b", 8, signed=True),
        _integer("uint8", "B", 8, signed=False, octets=True),
        _integer("int16", "h", 16, signed=True),
        _integer("uint16", "H", 16, signed=False),
        _integer("int32", "i", 32, signed=True),
        _integer("uint32", "I", 32, signed=False),
        _integer("int64", "q", 64, signed=True),
        _integer("uint64", "Q", 64, signed=False),
        Builtin("float32", "float", "f", 4),
        Builtin("float64", "float", "d", 8),
        Builtin("string", "string", "I", 4),
        Builtin("bool", "bool", "?", 1),
        # Two old names. One is signed and the other is not: genpy reads them so.
        _integer("char", "B", 8, signed=False, octets=True),
        _integer("byte", "b", 8, signed=True),
        Builtin("time", "time", "II", 8),
        Builtin("duration", "duration", "ii", 8),
    )
}

CONSTANT_TYPES: Final = frozenset(BUILTINS) - {"time", "duration"}

HEADER_TYPE: Final = "std_msgs/Header"


def is_builtin(name: str) -> bool:
    """Whether ``name`` (without brackets) is a built-in type."""
    return name in BUILTINS
