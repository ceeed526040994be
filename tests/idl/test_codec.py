"""Octets: what messages look like on the wire, and what is refused as no message."""

from __future__ import annotations

import math
import struct
import sys
import tracemalloc
from array import array
from typing import Any

import pytest

from aioros1.errors import DeserializationError, MessageSpecError
from aioros1.idl import MessageStore, load_msg
from aioros1.time import Duration, Time


def define(text: str, **others: str) -> Any:
    """The class of p/Type with this definition, beside types of p by other names."""
    store = MessageStore()
    for name, other in others.items():
        store.add_text(f"p/{name}", other)
    store.add_text("p/Type", text)
    return store.load_msg("p/Type")


# definition, fields, octets in hexadecimal
LAYOUT: list[tuple[str, dict[str, Any], str]] = [
    ("", {}, ""),
    ("bool a\nbool b", {"a": True}, "01 00"),
    ("int8 a\nuint8 b\nbyte c\nchar d", {"a": -1, "b": 255, "c": -2, "d": 254}, "ff ff fe fe"),
    ("int16 a\nuint16 b", {"a": -2, "b": 0x1234}, "feff 3412"),
    ("int32 a\nuint32 b", {"a": -2, "b": 0x12345678}, "feffffff 78563412"),
    ("int64 a\nuint64 b", {"a": -2, "b": 1}, "feffffffffffffff 0100000000000000"),
    ("float32 a\nfloat64 b", {"a": 1.0, "b": -0.0}, "0000803f 0000000000000080"),
    ("string a", {"a": "é"}, "02000000 c3a9"),
    ("time a", {"a": Time(1, 2)}, "01000000 02000000"),
    ("duration a", {"a": Duration(-1, 2)}, "ffffffff 02000000"),
    ("uint8[] a", {"a": b"ab"}, "02000000 6162"),
    ("uint8[2] a", {"a": b"ab"}, "6162"),
    ("char[] a\nchar[1] b", {"a": b"a", "b": b"b"}, "01000000 61 62"),
    ("byte[] a", {"a": [-1]}, "01000000 ff"),
    ("int16[] a", {"a": [1, -1]}, "02000000 0100 ffff"),
    ("int16[2] a", {"a": [1, -1]}, "0100 ffff"),
    ("int16[0] a", {}, ""),
    ("string[] a", {"a": ["x", ""]}, "02000000 01000000 78 00000000"),
    ("string[2] a", {"a": ["x", ""]}, "01000000 78 00000000"),
    ("bool[] a", {"a": [True, False]}, "02000000 01 00"),
    ("bool[2] a", {"a": [True, False]}, "01 00"),
    ("time[] a", {"a": [Time(1, 2)]}, "01000000 01000000 02000000"),
    ("duration[1] a", {"a": [Duration(-1, 2)]}, "ffffffff 02000000"),
    ("std_msgs/Empty a\nint8 b", {"b": 1}, "01"),
    ("std_msgs/Empty[] a\nint8 b", {"b": 1}, "00000000 01"),
    ("Header header\nint8 a", {"a": 1}, "00000000 00000000 00000000 00000000 01"),
]


@pytest.mark.parametrize(("text", "fields", "octets"), LAYOUT)
def test_layout(text: str, fields: dict[str, Any], octets: str) -> None:
    cls = define(text)
    message = cls(**fields)
    expected = bytes.fromhex(octets)
    assert message.to_bytes() == expected
    assert cls.from_bytes(expected) == message
    assert cls._frame(message) == struct.pack("<I", len(expected)) + expected


def test_arrays_are_of_compact_kinds() -> None:
    cls = define("int16[] a\nfloat32[2] b\nuint8[] c\nchar[2] d\nbool[] e\nstring[] f\nbyte[] g")
    for message in (cls(), cls.from_bytes(cls().to_bytes())):
        assert message.a == array("h")
        assert message.b == array("f", [0, 0])
        assert (message.c, message.d) == (b"", b"\0\0")
        assert (message.e, message.f) == ([], [])
        assert message.g == array("b")
        kinds = [type(getattr(message, name)) for name in cls.__slots__]
        assert kinds == [array, array, bytes, bytes, list, list, array]


def test_messages_inside_messages() -> None:
    cls = define(
        "Outer[] outers\nOuter[2] pair\nInner inner\nstring end",
        Outer="string name\nInner[] inners\nInner[2] two\nInner one",
        Inner="int8 a\ntime t\nuint8[2] raw\nfloat32[1] f\nbool b",
    )
    message = cls(end="z")
    inner = cls._nested["p/Inner"](1, Time(2, 3), b"ab", array("f", [1.5]), True)
    outer = cls._nested["p/Outer"]("n", [inner, inner], [inner, inner], inner)
    message.outers, message.pair, message.inner = [outer, outer, outer], [outer, outer], inner
    back = cls.from_bytes(message.to_bytes())
    assert back == message
    assert back.outers[2].inners[1].f == array("f", [1.5])


def test_fixed_arrays_of_messages_of_fixed_size_in_such_messages() -> None:
    cls = define(
        "A[2] a\nA[] b\nint8 end",
        A="int8 x\nB[2] bs\nint8 y",
        B="bool p\nC[2] cs\ntime[1] t\nE[2] es\nC[0] no\nstring[0] nor",
        C="uint16 q\nint32[2] r",
        E="",
    )
    message = cls(end=7)
    message.b = [cls._nested["p/A"](x=-1) for _ in range(3)]
    message.b[1].bs[1].cs[0].r = [5, 6]
    message.b[1].bs[0].t = [Time(8, 9)]
    back = cls.from_bytes(message.to_bytes())
    assert back == message
    assert back.b[1].bs[1].cs[0].r.tolist() == [5, 6]
    assert len(back.a[0].bs[0].es) == 2


def test_extreme_values_survive() -> None:
    cls = define("float32 f\nfloat64 d\nfloat64[] ds\ntime t\nduration u\nstring s\nbool b")
    octets = (
        b"\x00\x00\xc0\x7f"  # a NaN
        + struct.pack("<d", math.inf)
        + b"\2\0\0\0"
        + b"\1\0\0\0\0\0\xf8\x7f"  # a NaN that carries something
        + struct.pack("<d", -0.0)
        + b"\xff" * 8
        + b"\0\0\0\x80" * 2
        + b"\4\0\0\0\xff\0\xfea"
        + b"\1"
    )
    message = cls.from_bytes(octets)
    assert message.to_bytes() == octets
    assert (message.t.secs, message.t.nsecs) == (0xFFFFFFFF, 0xFFFFFFFF)
    assert (message.u.secs, message.u.nsecs) == (-(1 << 31), -(1 << 31))
    assert message.s == "\udcff\0\udcfea"
    assert cls.from_dict(message.to_dict()).to_bytes() == octets


def test_any_octet_but_zero_is_true() -> None:
    cls = define("bool a\nbool[] b\nbool[2] c")
    message = cls.from_bytes(b"\x07\2\0\0\0\0\x80\2\0")
    assert message == cls(True, [False, True], [True, False])
    assert message.a is True


def test_strings_that_are_not_utf8_among_others() -> None:
    cls = define("string a\nstring[] b\nstring c")
    octets = b"\1\0\0\0a\2\0\0\0\1\0\0\0\xff\1\0\0\0b\2\0\0\0\xc3\xa9"
    message = cls.from_bytes(octets)
    assert message == cls("a", ["\udcff", "b"], "é")
    assert message.to_bytes() == octets
    assert cls._frame(message) == struct.pack("<I", len(octets)) + octets


def test_lists_of_strings_that_repeat_or_change() -> None:
    cls = define("string[] a\nstring[2] b\nint8 c")
    seen = []
    for names in (["x", "yy"], ["x", "yy"], ["x", "zz"], ["x"], [], ["x", "yy", "\udcff"], ["x"]):
        message = cls(names, ["p", "q"], 5)
        octets = message.to_bytes()
        for _ in range(2):
            back = cls.from_bytes(octets)
            assert back == message
            seen.append((back, names))
        message.a.append("more")
        assert cls.from_bytes(message.to_bytes()).a == [*names]
        message.a.pop()
    for back, names in seen:
        assert back.a == names
        back.a.append("own")
        back.a.pop()
    # What has changed since it was packed last is packed anew, whoever changed it.
    names = ["a", "b"]
    message = cls(names, names, 5)
    message.to_bytes()
    names[1] = "c"
    assert cls.from_bytes(message.to_bytes()).b == ["a", "c"]
    message.b = (b"a", b"c")
    assert cls.from_bytes(message.to_bytes()).b == ["a", "c"]
    octets = message.to_bytes()
    with pytest.raises(DeserializationError):
        cls.from_bytes(octets[:-4])


# definition, octets in hexadecimal, the text of the error
BROKEN: list[tuple[str, str, str]] = [
    ("int32 a", "000000", "p/Type.a: 4 bytes expected, 3 left at offset 0"),
    ("int8 a\nint32 b", "00", "p/Type.b: 4 bytes expected, 0 left at offset 1"),
    ("int8 a", "0000", "p/Type: 1 bytes too many at offset 1"),
    ("", "00", "p/Type: 1 bytes too many at offset 0"),
    ("string a", "0000", "p/Type.a: 4 bytes expected, 2 left at offset 0"),
    ("string a", "05000000 61", "p/Type.a: 5 bytes expected, 1 left at offset 4"),
    ("string a\nint8 b", "ffffffff 61", "p/Type.a: 4294967295 bytes expected"),
    ("uint8[] a", "05000000 61", "p/Type.a: 5 bytes expected, 1 left"),
    ("int64[] a", "ffffffff 61", "p/Type.a: 34359738360 bytes expected, 1 left"),
    ("float64[] a", "02000000 0000000000000000 00", "p/Type.a: 16 bytes expected, 9 left"),
    ("bool[] a", "ffffffff 01", "p/Type.a: 4294967295 bytes expected"),
    ("time[] a", "ffffffff 01", "p/Type.a: 34359738360 bytes expected"),
    ("string[] a", "ffffffff 61", "p/Type.a: 17179869180 bytes expected"),
    ("string[] a", "02000000 01000000 61 00", r"p/Type.a: 8 bytes expected, 6 left"),
    ("string[] a", "02000000 01000000 61 01000000", r"p/Type.a\[1\]: 1 bytes expected, 0 left"),
    ("string[2] a", "00000000 0000", "p/Type.a: 8 bytes expected, 6 left at offset 0"),
    ("int16[4] a", "00", "p/Type.a: 8 bytes expected, 1 left"),
    ("Header h", "00", "p/Type.h.seq: 4 bytes expected, 1 left"),
    ("Header h", "00" * 12 + "05000000", "p/Type.h.frame_id: 5 bytes expected, 0 left"),
    ("geometry_msgs/Point[] a", "ffffffff 00", "p/Type.a: 103079215080 bytes expected"),
    ("Header[] a", "ffffffff 00", "p/Type.a"),
    ("std_msgs/String[] a", "02000000 00000000 05000000", r"p/Type.a\[1\].data: 5 bytes expected"),
    ("std_msgs/Empty[] a", "ffffffff", "p/Type.a: 4294967295 messages without content"),
    ("std_msgs/Empty[70000] a", "", "p/Type.a: 70000 messages without content"),
]


@pytest.mark.parametrize(("text", "octets", "error"), BROKEN)
def test_octets_that_are_no_message(text: str, octets: str, error: str) -> None:
    cls = define(text.replace("Header[]", "std_msgs/Header[]"))
    with pytest.raises(DeserializationError, match=error):
        cls.from_bytes(bytes.fromhex(octets))


def test_lengths_that_are_not_there_cost_no_memory() -> None:
    cls = define("string s\nuint8[] o\nfloat64[] d\nstring[] t\nbool[] b\nstd_msgs/Empty[] e")
    zero = b"\0\0\0\0"
    cls.from_bytes(zero * 6)
    tracemalloc.start()
    try:
        for field in range(6):
            with pytest.raises(DeserializationError):
                cls.from_bytes(zero * field + b"\xff\xff\xff\x7f" + zero * (5 - field))
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak < 1_000_000


def test_the_empty_messages_in_a_message_are_bounded_together() -> None:
    cls = define("Many[] many", Many="std_msgs/Empty[] a")
    octets = struct.pack("<IIIII", 4, *[20_000] * 4)
    with pytest.raises(DeserializationError, match="without content"):
        cls.from_bytes(octets)
    assert len(cls.from_bytes(struct.pack("<III", 2, 3, 4)).many[1].a) == 4


def test_decoders_stop_at_the_end_that_they_are_given() -> None:
    cls = define("string a\nint32[] b\nuint8[] c")
    octets = cls("abc", [1, 2], b"xyz").to_bytes()
    data = b"??" + octets + b"more"
    end = 2 + len(octets)
    assert cls._decode(data, 2, end) == cls("abc", [1, 2], b"xyz")
    # Trailing octets within the end are let pass, as rospy and roscpp do.
    assert cls._decode(data, 2, len(data)) == cls("abc", [1, 2], b"xyz")
    view = memoryview(data)
    for decode, source in (
        (cls._decode, data),
        (cls._decode_view, view),
        (cls._decode_views, view),
    ):
        for wrong in range(2, end):
            with pytest.raises(DeserializationError):
                decode(source, 2, wrong)


def test_views_share_memory_and_copies_do_not() -> None:
    cls = define("float32[] a\nuint8[] b\nint16[2] c\nuint8[2] d\nstring e\nP[] ps", P="int16[2] x")
    message = cls([1, 2], b"ab", [3, 4], b"cd", "text", [])
    buffer = bytearray(b"?" + message.to_bytes())
    view = memoryview(buffer)
    copied = cls._decode_view(view, 1, len(buffer))
    shown = cls._decode_views(view, 1, len(buffer))
    assert copied == shown == message
    for name, code in (("a", "f"), ("b", "B"), ("c", "h"), ("d", "B")):
        part = getattr(shown, name)
        assert isinstance(part, memoryview)
        assert part.format == code
        assert part.obj is buffer
    assert shown.e == "text"
    buffer[:] = bytes(len(buffer))
    assert copied == message
    assert shown.a.tolist() == [0.0, 0.0]


def test_messages_with_views_can_be_used_like_others() -> None:
    import copy
    import pickle

    cls = load_msg("sensor_msgs/LaserScan")
    octets = cls(ranges=[1, 2], intensities=[3]).to_bytes()
    message = cls._decode_views(memoryview(octets), 0, len(octets))
    plain = cls.from_bytes(octets)
    assert message.to_bytes() == octets
    assert (str(message), message.to_dict()) == (str(plain), plain.to_dict())
    assert repr(message.replace(ranges=[])) == repr(message.replace(ranges=[]))
    for other in (copy.deepcopy(message), pickle.loads(pickle.dumps(message))):
        assert other == plain
        assert type(other.ranges) is array


def test_arrays_are_swapped_where_the_machine_is_not_little_endian(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    text = "int16[] a\nfloat64[2] b\nint16 c"
    wire = define(text)(a=[1, 2], b=[1, 2], c=1).to_bytes()
    if sys.byteorder == "little":
        # Pretend: what should be swapped for the wire shows as swapped.
        monkeypatch.setattr("aioros1.idl.values.LITTLE", False)
        wire = b"\2\0\0\0\0\1\0\2" + struct.pack(">dd", 1, 2) + b"\1\0"
    cls = define(text)
    values = [1, 2], array("h", [1, 2]), memoryview(array("h", [1, 2]))
    for value in values:
        message = cls(a=value, b=[1, 2], c=1)
        assert message.to_bytes() == wire
        assert cls.from_bytes(wire) == message
        for decode in (cls._decode_view, cls._decode_views):
            assert decode(memoryview(wire), 0, len(wire)) == message
    assert cls(a=(1, 2), b=Odd([1.0, 2.0]), c=1).to_bytes() == wire


class Odd(list):  # type: ignore[type-arg]
    """A list, if not exactly."""


class TestParts:
    cls = load_msg("sensor_msgs/Image")

    def test_large_bytes_are_passed_on_as_they_are(self) -> None:
        pixels = bytes(100_000)
        parts = self.cls._frame_parts(self.cls(encoding="rgb8", data=pixels))
        assert b"".join(parts) == self.cls._frame(self.cls(encoding="rgb8", data=pixels))
        assert any(part is pixels for part in parts)
        assert len(parts) == 2

    def test_small_ones_are_joined(self) -> None:
        assert len(self.cls._frame_parts(self.cls(data=bytes(100)))) == 1

    @pytest.mark.parametrize(
        "make",
        [
            bytearray,
            lambda data: memoryview(bytearray(data)),
            lambda data: memoryview(bytearray(data)).toreadonly(),
            lambda data: array("B", data),
        ],
    )
    def test_what_can_change_is_copied(self, make: Any) -> None:
        pixels = make(bytes(100_000))
        parts = self.cls._frame_parts(self.cls(data=pixels))
        before = b"".join(parts)
        target = pixels.obj if isinstance(pixels, memoryview) else pixels
        target[0] = 255
        assert b"".join(parts) == before
        assert len(parts) == 2

    def test_a_view_of_bytes_cannot_change(self) -> None:
        pixels = bytes(100_000)
        part = self.cls._frame_parts(self.cls(data=memoryview(pixels)))[1]
        assert isinstance(part, memoryview)
        assert part.obj is pixels

    @pytest.mark.parametrize(
        ("type_", "bulk"),
        [
            ("sensor_msgs/Image", True),
            ("sensor_msgs/LaserScan", True),
            ("std_msgs/Float64MultiArray", True),
            ("std_msgs/String", False),
            ("geometry_msgs/PoseArray", False),
            ("geometry_msgs/PoseWithCovariance", False),
        ],
    )
    def test_types_that_can_have_any(self, type_: str, bulk: bool) -> None:
        assert load_msg(type_)._has_bulk is bulk


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("uint8[4294967296] a", "over 2 GiB"),
        ("float64[1000000000] a", "over 2 GiB"),
        ("geometry_msgs/Twist[1000000000] a", "over 2 GiB"),
    ],
)
def test_definitions_out_of_all_proportion(text: str, error: str) -> None:
    with pytest.raises(MessageSpecError, match=error):
        define(text)


def test_definitions_that_explode() -> None:
    store = MessageStore(parent=None)
    store.add_text("p/T0", "int8 a")
    for level in range(1, 60):
        store.add_text(f"p/T{level}", f"T{level - 1} a\nT{level - 1} b")
    with pytest.raises(MessageSpecError, match="fields, with nested ones"):
        store.load_msg("p/T59")


def test_definitions_that_are_too_deep() -> None:
    store = MessageStore(parent=None)
    store.add_text("p/T0", "int8 a")
    for level in range(1, 300):
        store.add_text(f"p/T{level}", f"T{level - 1} a")
        store.add_text(f"p/L{level}", f"L{level - 1}[] a" if level > 1 else "string a")
    assert store.load_msg("p/T90")().to_bytes() == b"\0"
    with pytest.raises(MessageSpecError, match="nested over 100 deep"):
        MessageStore(parent=store).load_msg("p/T299")
    assert store.load_msg("p/L12")().to_bytes() == b"\0\0\0\0"
    with pytest.raises(MessageSpecError, match="arrays nested"):
        store.load_msg("p/L50")
