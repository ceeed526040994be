"""What does not fit a field, and how the error says so."""

from __future__ import annotations

import struct
from array import array
from typing import Any

import numpy as np
import pytest

from aioros1.errors import SerializationError
from aioros1.idl import MessageStore, convert, load_msg
from aioros1.time import Duration, Time

DEFINITION = """
bool flag
int8 i8
uint8 u8
int16 i16
int32 i32
uint32 u32
int64 i64
uint64 u64
float32 f32
float64 f64
string text
time when
duration span
char letter
byte octet
int32[] ints
uint16[2] pair
float32[] floats
float64[] doubles
uint8[] blob
uint8[3] triple
bool[] flags
string[] names
time[] times
string[2] two
geometry_msgs/Point point
geometry_msgs/Pose[] poses
geometry_msgs/Point[2] line
std_msgs/Empty nothing
std_msgs/Empty[] nothings
"""


@pytest.fixture(scope="module")
def cls() -> Any:
    store = MessageStore()
    store.add_text("p/All", DEFINITION)
    return store.load_msg("p/All")


Pose = load_msg("geometry_msgs/Pose")
Point = load_msg("geometry_msgs/Point")
Empty = load_msg("std_msgs/Empty")

# field, value, the text of the error
REFUSED: list[tuple[str, Any, str]] = [
    ("flag", 2, "flag: expected bool, got 2"),
    ("flag", None, "flag: expected bool, got None"),
    ("flag", "", "flag: expected bool, got ''"),
    ("flag", [], r"flag: expected bool, got \[\]"),
    ("flag", 1.0, "flag: expected bool, got 1.0"),
    ("i8", 128, r"i8: expected int8 \(-128 to 127\), got 128"),
    ("i8", -129, "i8: expected int8"),
    ("u8", -1, r"u8: expected uint8 \(0 to 255\), got -1"),
    ("u8", 256, "u8: expected uint8"),
    ("letter", 256, "letter: expected char"),
    ("letter", "a", "letter: expected char, got 'a'"),
    ("octet", 128, "octet: expected byte"),
    ("i16", 1 << 15, "i16: expected int16"),
    ("i32", 1.0, "i32: expected int32, got 1.0"),
    ("i32", "1", "i32: expected int32, got '1'"),
    ("i32", None, "i32: expected int32, got None"),
    ("i32", 1 << 31, "i32: expected int32"),
    ("i32", np.float64(1), "i32: expected int32"),
    ("i32", np.zeros(2, int), "i32: expected int32, got ndarray of 'int64'"),
    ("u32", 1 << 32, "u32: expected uint32"),
    ("i64", 1 << 63, "i64: expected int64"),
    ("u64", 1 << 64, "u64: expected uint64"),
    ("f32", 1e39, r"f32: expected float32, got 1e\+39 \(out of range\)"),
    ("f32", "1", "f32: expected float32, got '1'"),
    ("f64", None, "f64: expected float64, got None"),
    ("f64", "abc", "f64: expected float64, got 'abc'"),
    ("f64", 10**400, "f64: expected float64"),
    ("f64", [1.0], r"f64: expected float64, got \[1.0\]"),
    ("text", None, "text: expected string, got None"),
    ("text", 5, "text: expected string, got 5"),
    ("text", ["a"], r"text: expected string, got \['a'\]"),
    ("text", "\ud800", "text: expected string, got .* surrogates not allowed"),
    ("when", None, "when: expected time, got None"),
    ("when", 1.5, "when: expected time, got 1.5"),
    ("when", Duration(1), "when: expected time, got"),
    ("when", Time(1 << 32), "when: expected time, got .*out of the range"),
    ("span", Time(1), "span: expected duration, got"),
    ("span", Duration(1 << 31), "span: expected duration, got .*out of the range"),
    ("ints", None, r"ints: expected int32\[\], got None"),
    ("ints", 5, r"ints: expected int32\[\], got 5"),
    ("ints", "123", r"ints: expected int32\[\], got '123'"),
    ("ints", b"1234", r"ints: expected int32\[\], got b'1234'"),
    ("ints", {1: 2}, r"ints: expected int32\[\], got \{1: 2\}"),
    ("ints", {1, 2}, r"ints: expected int32\[\], got \{1, 2\}"),
    ("ints", [1, 2.5], r"ints\[1\]: expected int32, got 2.5"),
    ("ints", (1, "2"), r"ints\[1\]: expected int32, got '2'"),
    ("ints", [1 << 31], r"ints\[0\]: expected int32"),
    ("ints", [[1]], r"ints\[0\]: expected int32, got \[1\]"),
    ("ints", array("f", [1]), r"ints: expected int32\[\], got array of 'f'"),
    ("ints", array("I", [1]), r"ints: expected int32\[\], got array of 'I'"),
    ("ints", np.zeros(2), r"ints: expected int32\[\], got ndarray of 'float64'"),
    ("ints", np.zeros(2, np.int64), r"ints: expected int32\[\], got ndarray of 'int64'"),
    ("ints", np.zeros((2, 2), np.int32), r"ints: expected int32\[\], .*not one-dimensional"),
    ("ints", np.zeros(2, bool), r"ints: expected int32\[\]"),
    ("pair", [1], r"pair: expected 2 elements, got \[1\] \(1 elements\)"),
    ("pair", [1, 2, 3], "pair: expected 2 elements"),
    ("pair", array("H", [1]), "pair: expected 2 elements, got array of 'H'"),
    ("pair", [1, -1], r"pair\[1\]: expected uint16"),
    ("floats", ["a"], r"floats\[0\]: expected float32, got 'a'"),
    ("floats", [0.0, 1e39], r"floats\[1\]: expected float32, got 1e\+39"),
    ("floats", np.zeros(2), r"floats: expected float32\[\], got ndarray of 'float64'"),
    ("doubles", np.zeros(2, np.float32), r"doubles: expected float64\[\]"),
    ("doubles", array("q", [1]), r"doubles: expected float64\[\], got array of 'q'"),
    ("doubles", [None], r"doubles\[0\]: expected float64, got None"),
    ("blob", "abc", r"blob: expected uint8\[\], got 'abc'"),
    ("blob", 5, r"blob: expected uint8\[\], got 5"),
    ("blob", None, r"blob: expected uint8\[\], got None"),
    ("blob", [256], r"blob\[0\]: expected uint8"),
    ("blob", ["a"], r"blob\[0\]: expected uint8, got 'a'"),
    ("blob", array("b", [1]), r"blob: expected uint8\[\], got array of 'b'"),
    ("blob", np.zeros(2, np.uint16), r"blob: expected uint8\[\]"),
    ("triple", b"ab", "triple: expected 3 elements"),
    ("triple", b"abcd", "triple: expected 3 elements"),
    ("flags", [True, 2], r"flags\[1\]: expected bool, got 2"),
    ("flags", b"\1\0", r"flags: expected bool\[\], got b"),
    ("flags", 3, r"flags: expected bool\[\], got 3"),
    ("flags", [None], r"flags\[0\]: expected bool, got None"),
    ("names", "abc", r"names: expected string\[\], got 'abc'"),
    ("names", "", r"names: expected string\[\], got ''"),
    ("names", ["a", 5], r"names\[1\]: expected string, got 5"),
    ("names", ["a", None], r"names\[1\]: expected string, got None"),
    ("times", [Time(), 5], r"times\[1\]: expected time, got 5"),
    ("times", None, r"times: expected time\[\], got None"),
    ("two", ["a"], "two: expected 2 elements"),
    ("point", None, "point: expected geometry_msgs/Point, got None"),
    ("point", Pose(), "point: expected geometry_msgs/Point, got a geometry_msgs/Pose"),
    ("point", Point(x="a"), "point.x: expected float64, got 'a'"),
    ("poses", Pose(), r"poses: expected geometry_msgs/Pose\[\], got a geometry_msgs/Pose"),
    ("poses", [Pose(), None], r"poses\[1\]: expected geometry_msgs/Pose, got None"),
    ("poses", {}, r"poses: expected geometry_msgs/Pose\[\], got \{\}"),
    (
        "poses",
        [Pose(), Pose(), Pose(), Pose(position=Point(x="abc"))],
        r"poses\[3\].position.x: expected float64, got 'abc'",
    ),
    ("line", [Point()], "line: expected 2 elements"),
    ("line", [Point(), Point(y=None)], r"line\[1\].y: expected float64, got None"),
    ("nothing", 5, "nothing: expected std_msgs/Empty, got 5"),
    ("nothings", [Empty(), 5], r"nothings\[1\]: expected std_msgs/Empty, got 5"),
]


@pytest.mark.parametrize(("field", "value", "text"), REFUSED)
def test_refused_with_the_path_of_the_field(cls: Any, field: str, value: Any, text: str) -> None:
    message = cls()
    setattr(message, field, value)
    for encode in (cls.to_bytes, cls._frame, cls._frame_parts):
        with pytest.raises(SerializationError, match=rf"^{text}"):
            encode(message)


# field, value, what a decoder shows
ACCEPTED: list[tuple[str, Any, Any]] = [
    ("flag", 1, True),
    ("flag", 0, False),
    ("flag", np.True_, True),
    ("i32", True, 1),
    ("i32", np.int8(-3), -3),
    ("u8", np.uint64(255), 255),
    ("f32", 1, 1.0),
    ("f64", True, 1.0),
    ("f64", np.float32(0.5), 0.5),
    ("f32", float("inf"), float("inf")),
    ("text", b"raw\xff", "raw\udcff"),
    ("text", "raw\udcff", "raw\udcff"),
    ("text", bytearray(b"abc"), "abc"),
    ("text", np.str_("abc"), "abc"),
    ("ints", (1, 2), [1, 2]),
    ("ints", range(3), [0, 1, 2]),
    ("ints", [np.int64(1), True], [1, 1]),
    ("ints", array("i", [1, 2]), [1, 2]),
    ("ints", array("l" if struct.calcsize("l") == 4 else "i", [1, 2]), [1, 2]),
    ("ints", memoryview(array("i", [1, 2])), [1, 2]),
    ("ints", memoryview(array("i", range(6)))[::2], [0, 2, 4]),
    ("ints", np.arange(3, dtype=np.int32), [0, 1, 2]),
    ("ints", np.arange(6, dtype=np.int32)[::-2], [5, 3, 1]),
    ("ints", np.arange(3, dtype=">i4"), [0, 1, 2]),
    ("ints", np.arange(3, dtype="<i4"), [0, 1, 2]),
    ("ints", np.zeros(0, np.int32), []),
    ("floats", [1, np.float64(2)], [1.0, 2.0]),
    ("floats", [float("inf"), float("-inf")], [float("inf"), float("-inf")]),
    ("floats", np.array([1, 2], np.float32), [1.0, 2.0]),
    ("doubles", (1, 2.5), [1.0, 2.5]),
    ("pair", np.array([1, 2], np.uint16), [1, 2]),
    ("pair", (1, 2), [1, 2]),
    ("blob", bytearray(b"abc"), b"abc"),
    ("blob", memoryview(b"abcdef")[::2], b"ace"),
    ("blob", array("B", [1, 2]), b"\1\2"),
    ("blob", [1, 2], b"\1\2"),
    ("blob", range(3), b"\0\1\2"),
    ("blob", np.arange(6, dtype=np.uint8)[::2], b"\0\2\4"),
    ("triple", np.arange(3, dtype=np.uint8), b"\0\1\2"),
    ("triple", (1, 2, 3), b"\1\2\3"),
    ("flags", (1, False), [True, False]),
    ("flags", np.array([True, False]), [True, False]),
    ("flags", [np.True_, 0], [True, False]),
    ("names", ("a", b"b\xff"), ["a", "b\udcff"]),
    ("names", np.array(["a", "b"]), ["a", "b"]),
    ("times", (Time(1),), [Time(1)]),
]


@pytest.mark.parametrize(("field", "value", "shown"), ACCEPTED)
def test_accepted(cls: Any, field: str, value: Any, shown: Any) -> None:
    message = cls()
    setattr(message, field, value)
    octets = message.to_bytes()
    got = getattr(cls.from_bytes(octets), field)
    assert (got.tolist() if isinstance(got, array) else got) == shown
    assert cls._frame(message)[4:] == octets
    assert b"".join(cls._frame_parts(message))[4:] == octets


class Unspeakable(int):
    def __repr__(self) -> str:
        raise RuntimeError("no")


@pytest.mark.parametrize("value", [10**5000, Unspeakable(300)], ids=["huge", "no repr"])
def test_values_without_a_repr(cls: Any, value: Any) -> None:
    with pytest.raises(SerializationError, match=r"^u8: expected uint8"):
        cls(u8=value).to_bytes()


class Look:
    """Any object with the attributes that are needed."""

    def __init__(self, **attributes: Any) -> None:
        self.__dict__.update(attributes)


def test_messages_and_times_need_only_look_right(cls: Any) -> None:
    message = cls(
        point=Look(x=1, y=2.0, z=np.float32(3)),
        when=Look(secs=1, nsecs=2),
        span=Look(secs=np.int32(-1), nsecs=-2),
        times=[Look(secs=3, nsecs=4)],
    )
    back = cls.from_bytes(message.to_bytes())
    assert back.point == Point(1.0, 2.0, 3.0)
    assert (back.when.secs, back.when.nsecs) == (1, 2)
    assert (back.span.secs, back.span.nsecs) == (-1, -2)
    assert back.times == [Time(3, 4)]


def test_a_field_whose_name_genpy_had_to_change() -> None:
    store = MessageStore()
    store.add_text("p/Word", "int32 from")
    word = store.load_msg("p/Word")
    assert word._encode(Look(from_=5)) == word(**{"from": 5}).to_bytes()


def test_a_field_that_was_deleted(cls: Any) -> None:
    message = cls()
    del message.text
    with pytest.raises(SerializationError, match=r"^text: has no value"):
        message.to_bytes()


def test_an_object_that_raises_anything() -> None:
    class Bad:
        def __index__(self) -> int:
            raise RuntimeError("no")

    with pytest.raises((SerializationError, RuntimeError)):
        load_msg("std_msgs/Int32")(data=Bad()).to_bytes()


class TestConvert:
    String = load_msg("std_msgs/String")

    def test_the_class_itself(self) -> None:
        message = self.String(data="a")
        assert convert(self.String, message) is message

    def test_a_class_with_the_same_md5sum(self) -> None:
        other = MessageStore(parent=None)
        other.add_text("std_msgs/String", "string data\n# another file")
        message = other.load_msg("std_msgs/String")(data="a")
        assert convert(self.String, message) is message
        assert self.String._encode(message) == b"\1\0\0\0a"

    def test_a_dict(self) -> None:
        assert convert(self.String, {"data": "a"}) == self.String(data="a")

    @pytest.mark.parametrize(
        ("value", "text"),
        [
            (Point(), "expected a std_msgs/String, got a geometry_msgs/Point"),
            ("hi", "expected a std_msgs/String, got 'hi'"),
            (None, "expected a std_msgs/String, got None"),
        ],
    )
    def test_anything_else(self, value: Any, text: str) -> None:
        with pytest.raises(SerializationError, match=text):
            convert(self.String, value)

    def test_another_definition_of_the_name(self) -> None:
        other = MessageStore(parent=None)
        other.add_text("std_msgs/String", "int32 data")
        with pytest.raises(SerializationError, match="of another definition"):
            convert(self.String, other.load_msg("std_msgs/String")())


class TestFromDict:
    Pose = Pose

    @pytest.mark.parametrize(
        ("values", "text"),
        [
            ({"data": 1}, "data: not a field of geometry_msgs/Pose; its fields: position, orient"),
            ({"position": {"w": 1}}, "position.w: not a field of geometry_msgs/Point"),
        ],
    )
    def test_unknown_fields(self, values: Any, text: str) -> None:
        with pytest.raises(SerializationError, match=rf"^{text}"):
            Pose.from_dict(values)

    def test_wrong_shapes(self, cls: Any) -> None:
        for values, text in (
            ({"ints": ["a"]}, r"ints\[0\]: expected int32, got 'a'"),
            ({"blob": [300]}, r"blob\[0\]: expected uint8, got 300"),
            ({"names": "abc"}, r"names: expected string\[\]"),
            ({"poses": [{"x": 1}]}, r"poses\[0\].x: not a field"),
            ({"when": {"seconds": 1}}, "when: expected time"),
            ({"when": {"secs": "a"}}, "when: expected time"),
            ({"when": -1}, "when: expected time"),
        ):
            with pytest.raises(SerializationError, match=rf"^{text}"):
                cls.from_dict(values)

    def test_times(self, cls: Any) -> None:
        message = cls.from_dict({"when": 1.5, "span": {"secs": -1, "nsecs": 5}, "times": [2]})
        assert message.when == Time(1, 500_000_000)
        assert message.span == Duration(-1, 5)
        assert message.times == [Time(2)]

    def test_not_a_mapping(self) -> None:
        with pytest.raises(SerializationError, match=r"expected a mapping"):
            Pose.from_dict([1])
