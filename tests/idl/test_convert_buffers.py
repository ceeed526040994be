"""Buffers as the values of arrays: taken without a copy where they fit, else refused."""

from __future__ import annotations

import ctypes
from array import array
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from aioros1.errors import SerializationError
from aioros1.idl import MessageStore

# Of each numeric type: NumPy's letter for it, ctypes' class.
NUMERIC = {
    "int8": ("i1", ctypes.c_int8),
    "byte": ("i1", ctypes.c_byte),
    "uint8": ("u1", ctypes.c_uint8),
    "char": ("u1", ctypes.c_ubyte),
    "int16": ("i2", ctypes.c_int16),
    "uint16": ("u2", ctypes.c_uint16),
    "int32": ("i4", ctypes.c_int32),
    "uint32": ("u4", ctypes.c_uint32),
    "int64": ("i8", ctypes.c_int64),
    "uint64": ("u8", ctypes.c_uint64),
    "float32": ("f4", ctypes.c_float),
    "float64": ("f8", ctypes.c_double),
}
CODES = "bBhHiIlLqQfd"
VALUES = [1, 2, 100, 4]


@pytest.fixture(params=NUMERIC)
def type_(request: pytest.FixtureRequest) -> str:
    name: str = request.param
    return name


def cls_of(type_: str) -> Any:
    store = MessageStore(parent=None)
    store.add_text("p/T", f"{type_}[] many\n{type_}[4] four")
    return store.load_msg("p/T")


def read_only(letter: str) -> Any:
    numbers = np.array(VALUES, letter)
    numbers.flags.writeable = False
    return numbers


def strided(letter: str) -> Any:
    return np.repeat(np.array(VALUES, letter), 2)[::2]


FITTING: dict[str, Callable[[str, Any], Any]] = {
    "ndarray": lambda letter, _: np.array(VALUES, letter),
    "little-endian ndarray": lambda letter, _: np.array(VALUES, f"<{letter}"),
    "big-endian ndarray": lambda letter, _: np.array(VALUES, f">{letter}"),
    "ndarray with steps": lambda letter, _: strided(letter),
    "reversed ndarray": lambda letter, _: np.array(VALUES[::-1], letter)[::-1],
    "column of an ndarray": lambda letter, _: np.array([[v, 0] for v in VALUES], letter)[:, 0],
    "read-only ndarray": lambda letter, _: read_only(letter),
    "unaligned ndarray": lambda letter, _: np.frombuffer(
        b"x" + np.array(VALUES, letter).tobytes(), letter, offset=1
    ),
    "array": lambda letter, _: array(np.dtype(letter).char, VALUES),
    "memoryview": lambda letter, _: memoryview(np.array(VALUES, letter)),
    "memoryview with steps": lambda letter, _: memoryview(strided(letter)),
    "big-endian memoryview": lambda letter, _: memoryview(np.array(VALUES, f">{letter}")),
    "ctypes array": lambda _, kind: (kind * 4)(*VALUES),
    "list": lambda *_: list(VALUES),
    "tuple": lambda *_: tuple(VALUES),
}


@pytest.mark.parametrize("name", FITTING)
def test_what_fits(type_: str, name: str) -> None:
    letter, kind = NUMERIC[type_]
    value = FITTING[name](letter, kind)
    cls = cls_of(type_)
    expected = np.array(VALUES, f"<{letter}").tobytes()
    plain = bytes(VALUES) if type_ in ("uint8", "char") else VALUES
    for message in (cls(value, value), cls.from_dict({"many": value, "four": value})):
        octets = message.to_bytes()
        assert octets == b"\4\0\0\0" + expected * 2
        assert cls._frame(message)[4:] == b"".join(cls._frame_parts(message))[4:] == octets
        assert cls.from_bytes(octets) == message
        assert message.to_dict() == {"many": plain, "four": plain}


def test_ctypes_of_the_other_byte_order() -> None:
    numbers = (ctypes.c_uint32.__ctype_be__ * 4)(*VALUES)  # type: ignore[attr-defined]
    assert cls_of("uint32")(many=numbers).to_bytes()[4:20] == np.array(VALUES, "<u4").tobytes()


@pytest.mark.parametrize(
    "make",
    [
        lambda other: np.array(VALUES, other),
        lambda other: memoryview(np.array(VALUES, other)),
        lambda other: np.zeros(0, other),
    ],
    ids=["ndarray", "memoryview", "empty"],
)
def test_numbers_of_another_type_are_refused(type_: str, make: Callable[[str], Any]) -> None:
    for other, _ in NUMERIC.values():
        if other != NUMERIC[type_][0]:
            refused(type_, make(other))


def test_arrays_of_another_type_are_refused(type_: str) -> None:
    letter = np.dtype(NUMERIC[type_][0])
    for code in CODES:
        if np.dtype(code) != letter:
            refused(type_, array(code, VALUES))


@pytest.mark.parametrize(
    "make",
    [
        lambda letter: np.array(5, letter),
        lambda letter: np.array([VALUES, VALUES], letter),
        lambda letter: memoryview(bytes(8)).cast("B", (2, 4)),
        lambda _: np.zeros(4, bool),
        lambda _: np.zeros(4, complex),
        lambda _: np.zeros(4, np.float16),
        lambda _: np.zeros(4, "datetime64[s]"),
        lambda _: np.zeros(4, [("x", "i4"), ("y", "i4")]),
        lambda _: np.array(["a", "b"]),
        lambda _: (ctypes.c_bool * 4)(),
        lambda _: memoryview(b"abcd").cast("c"),
        lambda _: "abcd",
        lambda _: None,
        lambda _: {1: 2},
        lambda _: {1, 2},
        lambda _: 5,
    ],
    ids=[
        *("0-d", "2-d", "2-d memoryview", "bool", "complex", "float16", "datetime", "record"),
        *("strings", "ctypes bool", "chars", "str", "None", "dict", "set", "int"),
    ],
)
def test_other_shapes_and_kinds_are_refused(type_: str, make: Callable[[str], Any]) -> None:
    refused(type_, make(NUMERIC[type_][0]))


@pytest.mark.parametrize("value", [b"abcd", bytearray(b"abcd"), memoryview(b"abcd")])
def test_bytes_are_no_numbers_but_octets(type_: str, value: Any) -> None:
    if NUMERIC[type_][0] == "u1":
        assert cls_of(type_)(many=value).to_bytes()[:8] == b"\4\0\0\0abcd"
    else:
        refused(type_, value)


@pytest.mark.parametrize("count", [0, 3, 5])
def test_fixed_arrays_of_another_length_are_refused(type_: str, count: int) -> None:
    letter, kind = NUMERIC[type_]
    for value in (np.zeros(count, letter), (kind * count)(), [0] * count):
        with pytest.raises(SerializationError, match=rf"^four: expected 4 elements.*{count} elem"):
            cls_of(type_)(four=value).to_bytes()


def refused(type_: str, value: Any) -> None:
    """By every encoder, with the path of the field and its type, inside of others too."""
    cls = cls_of(type_)
    for encode in (cls.to_bytes, cls._frame, cls._frame_parts):
        with pytest.raises(SerializationError, match=rf"^many: expected {type_}\[\], got "):
            encode(cls(many=value))
        with pytest.raises(SerializationError, match=rf"^four: expected {type_}\[4\], got "):
            encode(cls(four=value))
    store = MessageStore(parent=None)
    store.add_text("p/T", f"{type_}[] many")
    store.add_text("p/Outer", "T[] inner")
    outer, inner = store.load_msg("p/Outer"), store.load_msg("p/T")
    with pytest.raises(SerializationError, match=rf"^inner\[1\]\.many: expected {type_}\[\]"):
        outer([inner(), inner(value)]).to_bytes()


# -- copies ------------------------------------------------------------------------

COUNT = 1 << 16


def payload(cls: Any, value: Any) -> Any:
    """The part of a frame that has the payload alone."""
    parts = cls._frame_parts(cls(many=value))
    (part,) = [part for part in parts if len(part) > 1000]
    return part


def test_bytes_and_views_of_them_are_sent_as_they_are(type_: str) -> None:
    """Nobody can change them before they are sent; whatever else could be, is copied once."""
    memory = bytes(COUNT)
    values: list[Any] = [memoryview(memory).cast(np.dtype(NUMERIC[type_][0]).char)]
    if NUMERIC[type_][0] == "u1":
        values += [memory, memoryview(memory)]
    for value in values:
        part = payload(cls_of(type_), value)
        assert np.shares_memory(np.frombuffer(part, "u1"), np.frombuffer(memory, "u1"))


def test_what_could_still_change_is_copied(type_: str) -> None:
    letter, kind = NUMERIC[type_]
    writeable = np.zeros(COUNT, letter)
    locked = writeable.view()
    locked.flags.writeable = False  # but not the memory below
    for value in (writeable, locked, (kind * COUNT)(), array(np.dtype(letter).char, writeable)):
        part = payload(cls_of(type_), value)
        view = memoryview(value)
        assert not np.shares_memory(np.frombuffer(part, "u1"), np.frombuffer(view, "u1"))


def test_from_dict_keeps_buffers(type_: str) -> None:
    letter, kind = NUMERIC[type_]
    for value in (np.zeros(4, letter), (kind * 4)(), array(np.dtype(letter).char, VALUES)):
        message = cls_of(type_).from_dict({"many": value, "four": value})
        assert message.many is value
        assert message.four is value
