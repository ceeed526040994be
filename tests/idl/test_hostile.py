"""Octets, definitions and values that mean harm: what they may cost, and what comes of them.

Time is counted, not measured: calls of functions, and octets that are copied.
"""

from __future__ import annotations

import gc
import struct
import sys
import tracemalloc
from collections.abc import Callable
from typing import Any

import pytest

from aioros1.errors import (
    DeserializationError,
    MessageError,
    MessageSpecError,
    SerializationError,
)
from aioros1.idl import MessageStore

HUGE = [0xFFFFFFFF, 0x7FFFFFFF, 0x40000001, 0x10000, 0x100]
MODES = ["_decode", "_decode_view", "_decode_views"]

TYPES = {
    "None": "",
    "Leaf": "string name\nuint8[] raw",
    "Twig": "Leaf[] leaves\nint16 n",
    "Row": "int8 x\nint32[3] y\nNone[2] e",
    "Lists": "bool[] a\nuint8[] b\nint16[] c\nfloat64[] d\ntime[] e\nduration[] f\nstring[] g",
    "Texts": "string a\nstring[] b\nstring[2] c\nstring d",
    "Tree": "Twig[] twigs\nTwig trunk\nRow[] rows\nint8 end",
    "Hollow": "None[] a\nNone[3] b\nint8 c\nNone[] d",
    "Hollows": "Hollow[] a\nint8 b",
}


@pytest.fixture
def store() -> MessageStore:
    made = MessageStore(parent=None)
    for name, text in TYPES.items():
        made.add_text(f"p/{name}", text)
    return made


def u32(*values: int) -> bytes:
    return struct.pack(f"<{len(values)}I", *values)


def decoded(cls: Any, mode: str, data: bytes) -> bool:
    """Whether the octets are a message."""
    source: Any = data if mode == "_decode" else memoryview(data)
    try:
        getattr(cls, mode)(source, 0, len(data))
    except DeserializationError:
        return False
    return True


def peak_of(function: Callable[[], object]) -> int:
    """The most memory that a call has at one time; it is called once before, to warm up."""
    function()
    tracemalloc.start()
    try:
        function()
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


def calls_of(function: Callable[[], object]) -> int:
    """How many functions are called, those written in C included."""
    function()
    count = 0

    def note(frame: Any, event: str, argument: Any) -> None:
        nonlocal count
        count += event in ("call", "c_call")

    gc.disable()  # there are callbacks of others that it calls
    sys.setprofile(note)
    try:
        function()
    finally:
        sys.setprofile(None)
        gc.enable()
    return count


# -- memory ----------------------------------------------------------------------------


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("name", ["Leaf", "Twig", "Lists", "Texts", "Tree"])
def test_a_length_that_is_not_there_costs_no_memory(
    store: MessageStore, name: str, mode: str
) -> None:
    cls: Any = store.load_msg(f"p/{name}")
    # Wherever there may be a length: some that stand for one in a message of ones.
    octets = [bytes(120), u32(*[1] * 30), u32(*[2] * 30), u32(*[1, 0] * 15)]
    hostile = [
        data[:place] + u32(size) + data[place + 4 :]
        for data in octets
        for place in range(117)
        for size in HUGE
    ]

    def decode() -> None:
        for data in hostile:
            decoded(cls, mode, data)

    assert peak_of(decode) < 100_000


@pytest.mark.parametrize("mode", MODES)
def test_messages_without_octets_are_bounded(store: MessageStore, mode: str) -> None:
    cls: Any = store.load_msg("p/Hollows")
    for count in (65_537, 1 << 20, 0xFFFFFFFF):
        one = u32(count) + b"\0" + u32(0)
        assert not decoded(cls, mode, u32(1) + one + b"\0")
        assert peak_of(lambda one=one: decoded(cls, mode, u32(1) + one + b"\0")) < 100_000
    # Many that are few each are as many.
    many = u32(100) + (u32(1000) + b"\0" + u32(0)) * 100 + b"\0"
    assert not decoded(cls, mode, many)
    assert decoded(cls, mode, u32(100) + (u32(100) + b"\0" + u32(100)) * 100 + b"\0")


@pytest.mark.parametrize("mode", MODES)
def test_messages_without_octets_inside_one_another_are_bounded(mode: str) -> None:
    # Each of them brings a hundred more that nothing in the frame speaks of.
    store = MessageStore(parent=None)
    store.add_text("p/None", "")
    store.add_text("p/Clump", "None[100] a")
    store.add_text("p/Clumps", "Clump[10] b")
    store.add_text("p/Type", "Clumps[] c\nClump[] d")
    cls: Any = store.load_msg("p/Type")
    for octets in (u32(65, 0), u32(3000, 0), u32(65_000, 0), u32(0, 649)):
        with pytest.raises(DeserializationError, match=r"p/Type\.[cd]: \d+ messages without"):
            cls.from_bytes(octets)
        assert peak_of(lambda octets=octets: decoded(cls, mode, octets)) < 100_000
    assert decoded(cls, mode, u32(60, 0))
    assert decoded(cls, mode, u32(0, 640))


@pytest.mark.parametrize("mode", MODES)
def test_messages_without_octets_in_rows_are_bounded(mode: str) -> None:
    store = MessageStore(parent=None)
    store.add_text("p/None", "")
    store.add_text("p/Row", "int8 x\nNone[1000] e")
    store.add_text("p/Type", "Row[] rows")
    cls: Any = store.load_msg("p/Type")
    assert decoded(cls, mode, u32(65) + bytes(65))
    assert not decoded(cls, mode, u32(66) + bytes(66))
    with pytest.raises(DeserializationError, match=r"p/Type\.rows.*messages without content"):
        cls.from_bytes(u32(66) + bytes(66))


def retained_by(function: Callable[[], object]) -> int:
    """The memory that is still in use after a call."""
    tracemalloc.start()
    try:
        function()
        return tracemalloc.get_traced_memory()[0]
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize("mode", MODES)
def test_what_a_decoder_remembers_is_bounded(mode: str) -> None:
    store = MessageStore(parent=None)
    store.add_text("p/Names", "string[] names\nstring[] more")
    store.add_text("p/Type", "Names[] names\nstring[] more\nstring end")
    cls: Any = store.load_msg("p/Type")
    text = u32(8) + b"abcdefgh"
    names = (u32(200) + text * 200) * 2
    assert decoded(cls, mode, u32(0, 0, 0))

    def stream() -> None:
        for size in range(40):
            octets = u32(10) + names * 10 + u32(200) + text * 200 + u32(size) + bytes(size)
            for _ in range(2):
                assert decoded(cls, mode, octets)

    assert retained_by(stream) < 3_000_000


@pytest.mark.parametrize("mode", MODES)
def test_what_a_decoder_remembers_of_mistakes_is_bounded(store: MessageStore, mode: str) -> None:
    cls: Any = store.load_msg("p/Texts")
    assert decoded(cls, mode, u32(0, 0, 0, 0, 0))

    def stream() -> None:
        for size in range(3000):
            # Of one size: a message, another in another layout, and none at all.
            assert decoded(cls, mode, u32(size) + bytes(size) + u32(0, 0, 0, 0))
            assert decoded(cls, mode, u32(0, 0, 0, 0, size) + bytes(size))
            assert not decoded(cls, mode, u32(size + 1) + bytes(size) + u32(0, 0, 0, 0))

    assert retained_by(stream) < 200_000


# -- time ------------------------------------------------------------------------------


def leaf(name: bytes = b"ab", raw: bytes = b"xyz") -> bytes:
    return u32(len(name)) + name + u32(len(raw)) + raw


def texts(count: int) -> bytes:
    return u32(0, count) + (u32(2) + b"ab") * count + u32(0, 0, 0)


def tree(count: int) -> bytes:
    twig = u32(3) + leaf() * 3 + b"\0\0"
    return u32(count) + twig * count + u32(0) + b"\0\0" + u32(0) + b"\0"


def hollows(count: int) -> bytes:
    return u32(count) + (u32(3) + b"\0" + u32(2)) * count + b"\0"


def lists(count: int) -> bytes:
    return b"".join(u32(count) + bytes(size * count) for size in (1, 1, 2, 8, 8, 8, 4))


class Copied(bytes):
    """Octets that count how many of them are taken out."""

    count = 0

    def __getitem__(self, key: Any) -> Any:
        part = bytes.__getitem__(self, key)
        if isinstance(key, slice):
            Copied.count += len(part)
        return part


BUILDERS = {"Texts": texts, "Tree": tree, "Hollows": hollows, "Lists": lists}


@pytest.mark.parametrize("cut", [0, 1, 6])
@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("name", BUILDERS)
def test_twice_the_octets_take_twice_the_time(
    store: MessageStore, name: str, mode: str, cut: int
) -> None:
    cls: Any = store.load_msg(f"p/{name}")
    costs = []
    for count in (50, 100, 200):
        data = BUILDERS[name](count)
        data = data[: len(data) - cut]
        assert decoded(cls, mode, data) is (cut == 0)
        costs.append(calls_of(lambda data=data: decoded(cls, mode, data)))
    assert costs[2] - costs[1] <= 2.2 * (costs[1] - costs[0]) + 20


@pytest.mark.parametrize("cut", [0, 1, 6])
@pytest.mark.parametrize("name", BUILDERS)
def test_each_octet_is_copied_a_few_times_at_most(store: MessageStore, name: str, cut: int) -> None:
    cls: Any = store.load_msg(f"p/{name}")
    data = BUILDERS[name](300)
    for _ in range(3):
        Copied.count = 0
        decoded(cls, "_decode", Copied(data[: len(data) - cut]))
        assert Copied.count <= 4 * len(data)


def test_lengths_that_point_beyond_the_end_are_not_followed_again_and_again(
    store: MessageStore,
) -> None:
    # Lengths that would do if the message were as long as what lies behind it.
    cls: Any = store.load_msg("p/Twig")
    for size in (1, 100, 1000, 40_000, 60_000):
        data = u32(200, size) + bytes(1598)
        assert decoded(cls, "_decode", u32(200) + bytes(1602))
        batch = Copied(data + bytes(50_000))
        Copied.count = 0
        with pytest.raises(DeserializationError):
            cls._decode(batch, 0, len(data))
        assert Copied.count <= 4 * len(batch)


def test_wrong_lengths_do_not_copy_what_belongs_to_others(store: MessageStore) -> None:
    # Frames of a batch lie side by side: the length in each points behind the last.
    store.add_text("p/Bytes", "int8 a\nstring b\nuint8[] c\nstring d\nint16[] e")
    cls: Any = store.load_msg("p/Bytes")
    for start in (b"\0", b"\0" + u32(0), b"\0" + u32(0, 0), b"\0" + u32(0, 0, 0)):
        frame = start + u32(0x7FFF_FFF0) + b"\0\0"
        batch = Copied(frame * 300)
        Copied.count = 0
        for place in range(0, len(batch), len(frame)):
            with pytest.raises(DeserializationError):
                cls._decode(batch, place, place + len(frame))
        assert Copied.count <= 4 * len(batch)


# -- definitions -----------------------------------------------------------------------


def test_deep_definitions_are_decoded_and_blamed(store: MessageStore) -> None:
    store.add_text("p/D0", "string[] a")
    for level in range(1, 90):
        store.add_text(f"p/D{level}", f"D{level - 1} d")
    cls: Any = store.load_msg("p/D89")
    for mode in MODES:
        assert decoded(cls, mode, u32(1, 0))
        assert not decoded(cls, mode, u32(1, 1))
    with pytest.raises(DeserializationError, match=r"p/D89(\.d){89}\.a\[0\]: 1 bytes expected"):
        cls.from_bytes(u32(1, 1))
    store.add_text("p/A0", "string a")
    for level in range(1, 13):
        store.add_text(f"p/A{level}", f"A{level - 1}[] d")
    cls = store.load_msg("p/A12")
    for mode in MODES:
        assert decoded(cls, mode, u32(*[1] * 12, 0))
    with pytest.raises(DeserializationError, match=r"p/A12(\.d\[0\]){12}\.a: 9 bytes expected"):
        cls.from_bytes(u32(*[1] * 12, 9))


def test_types_of_many_fields_can_be_used() -> None:
    store = MessageStore(parent=None)
    store.add_text("p/Wide", "\n".join(f"string s{n}" for n in range(10_000)))
    cls: Any = store.load_msg("p/Wide")
    message = cls(s9999="z")
    octets = cls._encode(message)
    assert octets == u32(*[0] * 9999, 1) + b"z"
    frame = u32(len(octets)) + octets
    assert cls._frame(message) == frame
    assert b"".join(cls._frame_parts(message)) == frame
    assert cls.from_bytes(octets).s9999 == "z"


def wide(types: int, comment: int) -> str:
    """A definition whose types all contain one with a long text."""
    fields = "\n".join(f"T{number} f{number}" for number in range(types))
    parts = [f"=====\nMSG: p/T{number}\nL x" for number in range(types)]
    return "\n".join([fields, *parts, f"=====\nMSG: p/L\nint8 y\n#{'c' * comment}"])


def test_the_text_of_a_definition_is_not_kept_once_for_each_type() -> None:
    text = wide(300, 100_000)
    assert peak_of(lambda: MessageStore(parent=None).add_definition("p/Root", text)) < 6_000_000


def test_twice_the_types_take_twice_the_time() -> None:
    # As many types that each contain all of as many others; too large in all.
    costs = []
    for count in (100, 200, 400):
        numbers = range(count)
        parts = ["\n".join(f"W{number} f{number}" for number in numbers)]
        parts += [f"=====\nMSG: p/W{number}\nM x\nM y" for number in numbers]
        parts.append("=====\nMSG: p/M\n" + "\n".join(f"L{n} l{n}" for n in numbers))
        parts += [f"=====\nMSG: p/L{number}\nint8 y" for number in numbers]
        text = "\n".join(parts)

        def define(text: str = text) -> None:
            with pytest.raises(MessageSpecError, match="fields, with nested ones"):
                MessageStore(parent=None).add_definition("p/Root", text)

        costs.append(calls_of(define))
        assert peak_of(define) < 400 * len(text)
    assert costs[2] - costs[1] <= 2.2 * (costs[1] - costs[0]) + 20


@pytest.mark.parametrize("line", ["int8 f{}", "p/T[] f{}", "int8 C{}=1", "string C{}=# a", "# {}"])
def test_twice_the_lines_take_twice_the_time(line: str) -> None:
    costs = []
    for count in (200, 400, 800):
        text = "\n".join(line.format(number) for number in range(count))
        store = MessageStore(parent=None)
        store.add_text("p/T", "int8 a")

        def define(store: MessageStore = store, text: str = text) -> None:
            store.add_text("p/Root", text)
            store.load_msg("p/Root")

        costs.append(calls_of(define))
    assert costs[2] - costs[1] <= 2.2 * (costs[1] - costs[0]) + 20


@pytest.mark.parametrize(
    "text",
    [
        "int8[" * 10_000 + "] a",
        "int8[" + "9" * 10_000 + "] a",
        "int32 X=" + "9" * 10_000,
        "float64 X=" + "9" * 100_000 + "x",
        "bool X=" + "(" * 10_000,
        "bool X=" + "-" * 10_000 + "1",
        "bool X='\\d'",
        "a/" * 10_000 + " a",
        "=" * 10_000,
        "[] a",
        "\0\0",
        "---\n" * 10_000,
        "Root a",
        "A a\n=====\nMSG: p/A\nRoot a",
    ],
)
def test_odd_texts_are_errors_of_ours(text: str) -> None:
    for add in (_as_text, _as_definition):
        with pytest.raises(MessageError):
            add(text)


def _as_text(text: str) -> None:
    store = MessageStore(parent=None)
    store.add_text("p/Root", text)
    store.load_msg("p/Root")


def _as_definition(text: str) -> None:
    MessageStore(parent=None).add_definition("p/Root", text)


# -- values ----------------------------------------------------------------------------


class Broken:
    """What it seems to be able to do ends in an exception of its own."""

    def _fail(self, *_: Any) -> Any:
        raise ZeroDivisionError

    __index__ = __float__ = __len__ = __iter__ = __getitem__ = __eq__ = __repr__ = _fail
    __bytes__ = tolist = _fail
    __hash__ = None  # type: ignore[assignment]
    secs = nsecs = typecode = dtype = x = property(_fail)


class Odd:
    """Numbers that are none."""

    secs = nsecs = "1"

    def __index__(self) -> Any:
        return "1"

    __float__ = tolist = __index__


def released() -> memoryview:
    view = memoryview(b"abc")
    view.release()
    return view


@pytest.mark.parametrize(
    "make",
    [
        Broken,
        Odd,
        released,
        lambda: [Broken()],
        lambda: [released()],
        lambda: range(10**18),
        lambda: range(10**30),
        lambda: "\ud800",
        lambda: Broken,
    ],
)
def test_values_that_fail_by_themselves_are_named(make: Callable[[], Any]) -> None:
    store = MessageStore(parent=None)
    store.add_text("p/Leaf", "int8 x\nstring y")
    store.add_text("p/None", "")
    store.add_text(
        "p/Type",
        "int32 a\nfloat64 b\nbool c\nstring d\ntime e\nduration f\nuint8[] g\nint32[] h\n"
        "float32[2] i\nbool[] j\nstring[] k\ntime[] l\nLeaf m\nLeaf[] n\nNone o\nNone[] p",
    )
    cls: Any = store.load_msg("p/Type")
    for name in cls.__slots__:
        message = cls()
        setattr(message, name, make())
        for encode in (cls._encode, cls._frame, cls._frame_parts):
            with pytest.raises(SerializationError, match=rf"^{name}(\[0\])?(\.x)?: expected "):
                encode(message)


def test_a_list_of_strings_is_not_taken_for_the_last_one(store: MessageStore) -> None:
    # Two lists may be equal, and only one of them a list of strings.
    store.add_text("p/Names", "string[] names")
    cls: Any = store.load_msg("p/Names")
    assert cls._encode(cls([b"a"])) == u32(1, 1) + b"a"
    with pytest.raises(SerializationError, match=r"^names\[0\]: expected string"):
        cls._encode(cls([memoryview(b"a")]))


@pytest.mark.parametrize("value", [b"1", bytearray(b"1"), memoryview(b"1"), "1"])
def test_a_text_is_no_number(value: Any) -> None:
    store = MessageStore(parent=None)
    store.add_text("p/Type", "float32 a\nfloat64 b\nint8 c")
    cls: Any = store.load_msg("p/Type")
    for name in cls.__slots__:
        with pytest.raises(SerializationError, match=rf"^{name}: expected "):
            cls._encode(cls(**{name: value}))
