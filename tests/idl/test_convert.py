"""Messages as dicts, on their way through JSON and YAML: nothing is lost."""

from __future__ import annotations

import enum
import json
import math
import struct
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from aioros1.errors import SerializationError
from aioros1.idl import Message, MessageStore, load_msg
from aioros1.time import Duration, Time

from .test_codec_properties import LIMITS, definitions, messages


def define(text: str) -> Any:
    store = MessageStore(parent=None)
    store.add_text("p/T", text)
    return store.load_msg("p/T")


def through_json(values: Any) -> Any:
    return json.loads(json.dumps(values))


def through_yaml(values: Any) -> Any:
    return yaml.safe_load(yaml.safe_dump(values))


def through_flow_yaml(values: Any) -> Any:
    return yaml.safe_load(yaml.safe_dump(values, default_flow_style=True, allow_unicode=True))


Way = Callable[[Any], Any]
WAYS: list[Way] = [through_json, through_yaml, through_flow_yaml]


def bits(value: int) -> float:
    """The float64 of these bits."""
    (number,) = struct.unpack("<d", value.to_bytes(8, "little"))
    return float(number)


# -- any message -------------------------------------------------------------------


@given(st.data())
@LIMITS
def test_any_message_survives_in_json_form(data: st.DataObject) -> None:
    cls = data.draw(definitions()).load_msg("p/Root")
    message = data.draw(messages(cls))
    octets, values = message.to_bytes(), message.to_dict(json=True)
    # Nothing but what every parser of JSON takes.
    text = json.dumps(values, allow_nan=False)
    assert text.isascii()
    assert cls.from_dict(json.loads(text)).to_bytes() == octets
    assert cls.from_dict(through_yaml(values)).to_bytes() == octets


@given(st.data())
@LIMITS
def test_any_message_survives_yaml_as_it_is(data: st.DataObject) -> None:
    cls = data.draw(definitions()).load_msg("p/Root")
    message = data.draw(messages(cls))
    values = message.to_dict()
    back = cls.from_dict(through_yaml(values))
    assert back.to_bytes() == cls.from_dict(with_usual_nan(values)).to_bytes()
    assert cls.from_dict(values).to_bytes() == message.to_bytes()


def with_usual_nan(values: Any) -> Any:
    """YAML and JSON know one NaN."""
    if isinstance(values, dict):
        return {name: with_usual_nan(value) for name, value in values.items()}
    if isinstance(values, list):
        return [with_usual_nan(value) for value in values]
    return math.nan if isinstance(values, float) and values != values else values


# -- numbers -----------------------------------------------------------------------

FLOATS = define("float64 d\nfloat64[] ds\nfloat64[2] d2\nfloat32 f\nfloat32[] fs")
NUMBERS = [
    *(0.0, -0.0, math.inf, -math.inf, math.nan, 0.1, 1e16, 1e22),
    *(5e-324, -2.2250738585072009e-308, 1.7976931348623157e308),
]
SINGLES = [0.0, -0.0, math.inf, -math.inf, math.nan, 0.5, 2.0**-149, 3.4028234663852886e38]


@pytest.mark.parametrize("options", [{}, {"json": True}])
@pytest.mark.parametrize("way", WAYS)
def test_floats_survive_bit_for_bit(way: Way, options: Any) -> None:
    for double, single in zip(NUMBERS, [*SINGLES, 0.1, 1.5, 2.5], strict=True):
        message = FLOATS(d=double, ds=NUMBERS, d2=[double, -double], fs=SINGLES)
        message.f = struct.unpack("<f", struct.pack("<f", single))[0]
        if not options:
            message.d2 = [double, double]  # without the NaN whose sign is set
        back = FLOATS.from_dict(way(message.to_dict(**options)))
        assert back.to_bytes() == message.to_bytes()


@pytest.mark.parametrize("way", WAYS)
def test_nans_of_all_bits_survive_in_json_form(way: Way) -> None:
    numbers = [
        bits(value)
        for value in (0xFFF8000000000000, 0x7FF8000000000001, 0x7FF0000000000001, (1 << 64) - 1)
    ]
    message = FLOATS(d=numbers[0], ds=numbers, d2=numbers[:2], f=numbers[0], fs=numbers[:1])
    values = message.to_dict(json=True)
    assert values["d"] == "NaN:fff8000000000000"
    assert FLOATS.from_dict(way(values)).to_bytes() == message.to_bytes()


def test_what_is_no_number_is_named_in_json_form() -> None:
    message = FLOATS(d=math.nan, ds=[math.inf, -math.inf, -0.0], f=math.inf, fs=[math.nan])
    assert message.to_dict(json=True) == {
        "d": "NaN",
        "ds": ["Infinity", "-Infinity", -0.0],
        "d2": [0.0, 0.0],
        "f": "Infinity",
        "fs": ["NaN"],
    }
    assert message.to_dict()["ds"] == [math.inf, -math.inf, -0.0]


@pytest.mark.parametrize(
    ("values", "text"),
    [
        ({"d": "nan"}, "d: expected float64, got 'nan'"),
        ({"d": "1.5"}, "d: expected float64, got '1.5'"),
        ({"d": "NaN:"}, "d: expected float64"),
        ({"d": "NaN:7FF8000000000001"}, "d: expected float64"),
        ({"d": "NaN:3ff0000000000000"}, "d: expected float64"),
        ({"f": "inf"}, "f: expected float32, got 'inf'"),
        ({"ds": [0.0, "NaN", "x"]}, r"ds\[2\]: expected float64, got 'x'"),
        ({"ds": [0.0, None]}, r"ds\[1\]: expected float64, got None"),
        ({"fs": ["NaN", 1e39]}, r"fs\[1\]: expected float32, got 1e\+39"),
        ({"fs": [1e39]}, r"fs\[0\]: expected float32, got 1e\+39"),
    ],
)
def test_floats_that_are_refused(values: Any, text: str) -> None:
    with pytest.raises(SerializationError, match=f"^{text}"):
        FLOATS.from_dict(values)


@pytest.mark.parametrize("way", WAYS)
def test_integers_at_their_limits(way: Way) -> None:
    cls = define(
        "int8 a\nuint8 b\nint64 c\nuint64 d\nint64[] e\nuint64[2] f\nbool[] g\nbyte[] h\nchar i"
    )
    low, high = -(1 << 63), (1 << 64) - 1
    message = cls(-128, 255, low, high, [low, -low - 1], [0, high], [True, False], [-128], 255)
    assert cls.from_dict(way(message.to_dict())).to_bytes() == message.to_bytes()


@pytest.mark.parametrize("way", WAYS)
def test_times_at_their_limits(way: Way) -> None:
    cls = define("time a\ntime[] b\nduration c\nduration[] d\ntime[1] e")
    times = [Time(0xFFFFFFFF, 999_999_999), Time._raw(0xFFFFFFFF, 0xFFFFFFFF), Time()]
    spans = [Duration(-(1 << 31)), Duration._raw(-(1 << 31), -(1 << 31)), Duration._raw(0, -1)]
    for time, span in zip(times, spans, strict=True):
        message = cls(time, times, span, spans, [time])
        assert cls.from_dict(way(message.to_dict())).to_bytes() == message.to_bytes()


# -- strings and octets ------------------------------------------------------------

TEXTS = define("string s\nstring[] many\nstring[1] one")
STRINGS = [
    *(b"", b"a", b"\0", b"\xff", b"gr\xf6\xdfe", b"\xed\xa0\x80", b"\xc3", b"a\xf0\x9f"),
    *("größe\U0001f916".encode(), b"\r\n", b"\xc2\x85\xe2\x80\xa8\xef\xbb\xbf", bytes(range(256))),
    *(b"null", b"~", b"yes", b"0x10", b"1e5", b"1_000", b"12:30", b"2020-01-01", b".nan", b"NaN"),
    *(b"- a", b"a: b", b"# c", b" a ", b"'", b'"', b"\\", b"!!binary x", b"<<", b"=", b"---", b"."),
]


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("octets", STRINGS, ids=repr)
def test_any_octets_in_a_string(way: Way, octets: bytes) -> None:
    text = octets.decode("utf-8", "surrogateescape")
    message = TEXTS(text, [text, "", text], [text])
    assert TEXTS.from_dict(way(message.to_dict())).to_bytes() == message.to_bytes()
    # Octets stand for themselves where a string is expected.
    assert TEXTS(octets, [octets, b"", octets], [octets]).to_dict() == message.to_dict()
    assert TEXTS.from_dict({"s": octets}).to_bytes() == TEXTS(s=text).to_bytes()


def test_a_string_that_is_not_utf8_needs_the_escapes_of_json() -> None:
    values = TEXTS(s=b"\xff").to_dict()
    assert '"\\udcff"' in json.dumps(values)
    with pytest.raises(UnicodeEncodeError):
        json.dumps(values, ensure_ascii=False).encode()


OCTETS = define("uint8[] a\nuint8[3] b\nchar[] c\nchar[2] d")


def test_octets_stay_bytes_or_become_base64() -> None:
    message = OCTETS(b"\xfb\xff", b"abc", b"", b"\0\1")
    assert message.to_dict() == {"a": b"\xfb\xff", "b": b"abc", "c": b"", "d": b"\0\1"}
    assert message.to_dict(json=True) == {"a": "+/8=", "b": "YWJj", "c": "", "d": "AAE="}
    for values in (message.to_dict(json=True), message.to_dict()):
        assert OCTETS.from_dict(through_yaml(values)) == message
    assert OCTETS.from_dict(through_json(message.to_dict(json=True))) == message


@pytest.mark.parametrize(
    "value", [b"abc", "YWJj", [97, 98, 99], (97, 98, 99), bytearray(b"abc"), memoryview(b"abc")]
)
def test_octets_may_be_given_in_many_forms(value: Any) -> None:
    assert OCTETS.from_dict({"a": value, "b": value}) == OCTETS(a=b"abc", b=b"abc")


@pytest.mark.parametrize(
    ("values", "text"),
    [
        ({"a": "abc"}, r"a: expected uint8\[\] in base64, got 'abc'"),
        ({"a": "YW Jj"}, r"a: expected uint8\[\] in base64"),
        ({"a": "YWJj\n"}, r"a: expected uint8\[\] in base64"),
        ({"c": "-_8="}, r"c: expected char\[\] in base64"),
        ({"c": "é"}, r"c: expected char\[\] in base64, got 'é'"),
        ({"a": [1, 256]}, r"a\[1\]: expected uint8, got 256"),
        ({"a": ["1"]}, r"a\[0\]: expected uint8, got '1'"),
    ],
)
def test_octets_that_are_refused(values: Any, text: str) -> None:
    with pytest.raises(SerializationError, match=f"^{text}"):
        OCTETS.from_dict(values)


def test_too_few_octets_in_base64_are_refused_by_the_encoder() -> None:
    with pytest.raises(SerializationError, match=r"^b: expected 3 elements"):
        OCTETS.from_dict({"b": "YWI="}).to_bytes()


# -- the form of the dicts ---------------------------------------------------------


class Color(enum.IntEnum):
    RED = 3


def test_values_are_of_the_classes_that_json_and_yaml_write() -> None:
    cls = define(
        "int32 i\nfloat64 d\nfloat32 f\nbool b\nstring s\n"
        "int32[] ints\nfloat32[] floats\nuint8[] octets\nbool[] bools\nstring[] strings"
    )
    message = cls(
        *(Color.RED, np.float64(0.5), np.float32(0.25), np.True_, np.str_("a")),
        *([Color.RED, np.int8(1)], np.zeros(1, np.float32), [1, np.uint8(2)]),
        *(np.array([True, False]), np.array(["a"])),
    )
    plain = {"i": 3, "d": 0.5, "f": 0.25, "b": True, "s": "a", "ints": [3, 1], "floats": [0.0]}
    plain |= {"octets": b"\1\2", "bools": [True, False], "strings": ["a"]}
    assert message.to_dict() == plain
    assert through_yaml(message.to_dict()) == plain
    assert through_json(message.to_dict(json=True)) == {**plain, "octets": "AQI="}


@pytest.mark.parametrize("way", WAYS)
def test_names_that_mean_something_in_yaml(way: Way) -> None:
    cls = define("int32 yes\nint32 no\nint32 on\nint32 null\nint32 true\nint32 y\nint32 nan")
    message = cls(1, 2, 3, 4, 5, 6, 7)
    assert cls.from_dict(way(message.to_dict())) == message


def test_a_message_with_the_fields_of_a_time() -> None:
    store = MessageStore(parent=None)
    store.add_text("p/Stamp", "int32 secs\nint32 nsecs\nstring clock")
    store.add_text("p/T", "Stamp one\nStamp[] many")
    cls = store.load_msg("p/T")
    stamp = store.load_msg("p/Stamp")(1, 2, "c")
    values = cls(stamp, [stamp]).to_dict()
    assert values == {"one": stamp.to_dict(), "many": [stamp.to_dict()]}
    assert cls.from_dict(values) == cls(stamp, [stamp])


@pytest.mark.parametrize("json_form", [False, True])
def test_what_does_not_fit_is_left_to_the_encoder(json_form: bool) -> None:
    cls = define("int32[] ints\nuint8[] octets\nstring[] strings\ntime t\nfloat64 d")
    odd = {"ints": 5, "octets": [300], "strings": "abc", "t": None, "d": "x"}
    for name, value in odd.items():
        message = cls(**{name: value})
        assert message.to_dict(json=json_form)[name] == value
        with pytest.raises(SerializationError, match=f"^{name}"):
            message.to_bytes()


@pytest.mark.parametrize("name", ["std_msgs/Header", "sensor_msgs/JointState", "sensor_msgs/Image"])
def test_types_in_daily_use(name: str) -> None:
    cls: type[Message] = load_msg(name)
    assert cls.from_dict(through_json(cls().to_dict(json=True))) == cls()
    assert cls.from_dict(through_yaml(cls().to_dict())) == cls()
    assert cls.from_dict({}) == cls()
