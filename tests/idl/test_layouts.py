"""A decoder that has seen many messages reads the next one as a new decoder would."""

from __future__ import annotations

import itertools
import random
import struct
from typing import Any

import pytest

from aioros1 import DeserializationError, MessageStore
from aioros1.idl import layouts
from aioros1.idl.layouts import Layouts, Loop, Step, Stretch

DEFINITION = """\
uint32 seq
string first
string second
string[] names
float32[] numbers
uint8[] octets
bool[] flags
duration[] durations
Point[] points
Part[] parts
Part[2] both
string[2] two
float64 last
"""
PART = "string name\nPart1[] inner\nint16 number\n"
INNER = "string key\nstring value\n"
POINT = "float64 x\nfloat64 y\n"


def make_class() -> Any:
    """The class, with decoders that have not seen anything."""
    store = MessageStore(parent=None)
    store.add_text("p/Type", DEFINITION)
    store.add_text("p/Part", PART)
    store.add_text("p/Part1", INNER)
    store.add_text("p/Point", POINT)
    return store.load_msg("p/Type")


def text(rng: random.Random, length: int) -> str:
    return "".join(rng.choice("abcdeé\udcff") if rng.random() < 0.1 else "x" for _ in range(length))


def values(rng: random.Random, lengths: random.Random) -> dict[str, Any]:
    """Values from ``rng``, lengths from ``lengths``."""

    def some(most: int = 3) -> range:
        return range(lengths.randrange(most + 1))

    def string() -> str:
        return text(rng, lengths.randrange(4))

    def part() -> dict[str, Any]:
        return {
            "name": string(),
            "inner": [{"key": string(), "value": string()} for _ in some()],
            "number": rng.randrange(100),
        }

    return {
        "seq": rng.randrange(1000),
        "first": string(),
        "second": string(),
        "names": [string() for _ in some()],
        "numbers": [float(rng.randrange(100)) for _ in some()],
        "octets": rng.randbytes(lengths.randrange(5)),
        "flags": [rng.random() < 0.5 for _ in some()],
        "durations": [{"secs": rng.randrange(9), "nsecs": 1} for _ in some()],
        "points": [{"x": rng.random(), "y": 1.0} for _ in some()],
        "parts": [part() for _ in some()],
        "both": [part(), part()],
        "two": [string(), string()],
        "last": rng.random(),
    }


@pytest.mark.parametrize("seed", range(20))
def test_any_sequence_of_layouts(seed: int) -> None:
    """Few layouts, in any order and often again, with other values every time."""
    rng = random.Random(seed)
    used, expected_class = make_class(), make_class()
    for _ in range(150):
        shape = random.Random(rng.randrange(5) if rng.random() < 0.9 else rng.random())
        message = expected_class.from_dict(values(rng, shape))
        octets = message.to_bytes()
        assert used.from_bytes(octets) == message
        around = b"??" + octets + b"..."
        assert used._decode(around, 2, 2 + len(octets)) == message
        # Left over octets are no error here, and must not be taken for a layout.
        assert used._decode(around, 2, len(around)) == message
        cut = rng.randrange(len(octets))
        with pytest.raises(DeserializationError):
            used.from_bytes(octets[:cut])


@pytest.mark.parametrize("seed", range(20))
def test_damaged_octets(seed: int) -> None:
    """What is not in the layout it seems to have is what it is without one."""
    rng = random.Random(seed)
    cls = make_class()
    message = cls.from_dict(values(rng, random.Random(seed)))
    octets = message.to_bytes()
    for place, byte in itertools.product(range(0, len(octets), 3), (0, 1, 2, 0x80, 0xFF)):
        assert cls._decode(octets, 0, len(octets)) == message
        damaged = octets[:place] + bytes([byte]) + octets[place + 1 :]
        results = []
        # From views, a decoder learns nothing.
        for decode, data in ((cls._decode, damaged), (cls._decode_view, memoryview(damaged))):
            try:
                results.append(repr(decode(data, 0, len(damaged))))
            except DeserializationError as error:
                results.append(str(error))
        assert results[0] == results[1]


def test_one_size_with_two_layouts() -> None:
    """Neither is ever read as the other, and who alternates is given up in the end."""
    store = MessageStore(parent=None)
    store.add_text("p/Two", "string a\nstring b\n")
    cls = store.load_msg("p/Two")
    for pair in [("ab", "c"), ("a", "bc"), ("", "abc")] * 30:
        message = cls.from_bytes(cls(*pair).to_bytes())
        assert (message.a, message.b) == pair


def test_lists_of_names_are_those_of_each_message() -> None:
    store = MessageStore(parent=None)
    store.add_text("p/Names", "string[] names\nint32 number\n")
    cls = store.load_msg("p/Names")
    octets = cls(["a", "b"], 1).to_bytes()
    messages = [cls.from_bytes(octets) for _ in range(4)]
    messages[1].names.append("c")
    messages[2].names[0] = "d"
    assert messages[0] == messages[3] == cls.from_bytes(octets)
    # The same octets in all, but other names.
    assert cls.from_bytes(cls(["b", "a"], 1).to_bytes()).names == ["b", "a"]
    shifted = struct.pack("<IIIsIi", 2, 0, 1, b"a", 0, 0)[:9] + struct.pack("<sii", b"b", 0, 7)
    with pytest.raises(DeserializationError):
        cls.from_bytes(shifted)


def plan() -> list[Stretch | Loop]:
    """Of ``string name``, ``Part[] parts`` with a string in each."""
    return [
        Stretch("<I{}sI", (Step("sized", 0), Step("count", 0))),
        Loop([Stretch("<I{}s", (Step("sized", 0),))], None),
    ]


def octets(name: bytes, parts: list[bytes]) -> bytes:
    strings = [struct.pack("<I", len(part)) + part for part in [name, *parts]]
    return strings[0] + struct.pack("<I", len(parts)) + b"".join(strings[1:])


def test_a_layout() -> None:
    known = Layouts(plan())
    data = octets(b"abc", [b"", b"de"])
    known.learn(b"?" + data, 1, 1 + len(data))
    (layout,) = known.known.values()
    unpack, size, length, count, parts = layout
    assert unpack(data) == (3, b"abc", 2)
    assert (size, length, count) == (11, 3, 2)
    assert [(part[1], part[2]) for part in parts] == [(4, 0), (6, 2)]


def test_layouts_are_bounded_in_number() -> None:
    known = Layouts(plan())
    for size in range(10 * layouts.MAX_LAYOUTS):
        data = octets(bytes(size), [])
        known.learn(data, 0, len(data))
    assert len(known.known) == layouts.MAX_LAYOUTS


def test_layouts_are_bounded_in_size() -> None:
    known = Layouts(plan())
    for parts in (layouts.MAX_PARTS, layouts.MAX_PARTS + 1):
        data = octets(b"", [b""] * parts)
        known.learn(data, 0, len(data))
    assert [bool(layout) for layout in known.known.values()] == [True, False]
    names = Layouts([Stretch("<I{}s", (Step("strings", 0),))])
    for length in (layouts.MAX_STRINGS - 4, layouts.MAX_STRINGS - 3):
        data = struct.pack("<II", 1, length) + bytes(length)
        names.learn(data, 0, len(data))
    assert [bool(layout) for layout in names.known.values()] == [True, False]


def test_a_size_is_given_up_after_some_mistakes() -> None:
    known = Layouts(plan())
    data = octets(b"abc", [])
    for _ in range(layouts.MAX_MISTAKES - 1):
        known.learn(data, 0, len(data))
        assert known.known[len(data)]
        assert known.mistaken(len(data)) is None
        assert known.known == {len(data): None}
    known.learn(data, 0, len(data))
    assert known.mistaken(len(data)) == ()
    assert known.known == {len(data): ()}
