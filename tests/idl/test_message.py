"""Message classes as their users meet them."""

from __future__ import annotations

import copy
import io
import pickle
from array import array
from typing import Any

import numpy as np
import pytest

from aioros1.idl import Message, MessageStore, load_msg, load_srv
from aioros1.time import Duration, Time

String = load_msg("std_msgs/String")
Header = load_msg("std_msgs/Header")
Point = load_msg("geometry_msgs/Point")
PoseStamped = load_msg("geometry_msgs/PoseStamped")
LaserScan = load_msg("sensor_msgs/LaserScan")


def define(text: str) -> Any:
    store = MessageStore()
    store.add_text("p/Type", text)
    return store.load_msg("p/Type")


class TestConstruction:
    def test_defaults(self) -> None:
        scan = LaserScan()
        assert scan.header == Header(seq=0, stamp=Time(), frame_id="")
        assert scan.angle_min == 0.0
        assert isinstance(scan.ranges, array)

    def test_defaults_of_all_kinds(self) -> None:
        cls = define(
            "bool a\nint8 b\nfloat32 c\nstring d\ntime e\nduration f\nuint8[] g\nuint8[2] h\n"
            "bool[2] i\nstring[2] j\ntime[1] k\nint32[2] l\nstd_msgs/String[2] m\nuint8[5000] n"
        )
        message = cls()
        assert [getattr(message, name) for name in "abcdef"] == [
            False, 0, 0.0, "", Time(), Duration(),
        ]  # fmt: skip
        assert (message.g, message.h, message.n) == (b"", b"\0\0", bytes(5000))
        assert (message.i, message.j, message.k) == ([False] * 2, ["", ""], [Time()])
        assert message.l == array("i", [0, 0])
        assert message.m == [String(), String()]
        assert message.m[0] is not message.m[1]

    def test_nothing_is_shared_between_messages(self) -> None:
        first, second = LaserScan(), LaserScan()
        first.ranges.append(1.0)
        first.header.seq = 5
        assert (len(second.ranges), second.header.seq) == (0, 0)

    def test_by_name(self) -> None:
        assert Point(y=2).y == 2
        assert Point(y=2).x == 0.0

    def test_by_position(self) -> None:
        point = Point(1, 2, 3)
        assert (point.x, point.y, point.z) == (1, 2, 3)

    @pytest.mark.parametrize("values", [(1,), (1, 2), (1, 2, 3, 4)])
    def test_by_position_takes_all_fields_or_none(self, values: tuple[int, ...]) -> None:
        with pytest.raises(TypeError, match=r"geometry_msgs/Point has 3 fields \(x, y, z\), got"):
            Point(*values)

    @pytest.mark.parametrize("others", [{"x": 1.5}, {"w": 1}])
    def test_either_by_position_or_by_name(self, others: dict[str, float]) -> None:
        with pytest.raises(TypeError, match="either by position or by name"):
            Point(1, 2, 3, **others)

    def test_unknown_fields_are_named(self) -> None:
        with pytest.raises(
            AttributeError, match=r"geometry_msgs/Point has no field 'w'.*: x, y, z"
        ):
            Point(w=1)
        with pytest.raises(AttributeError, match="has no field 'w'"):
            Point().replace(w=1)
        with pytest.raises(AttributeError):
            Point().w = 1

    def test_a_type_without_fields(self) -> None:
        empty = load_msg("std_msgs/Empty")
        assert (empty(), empty().to_bytes(), repr(empty()), str(empty())) == (
            empty(), b"", "Empty()", "",
        )  # fmt: skip

    def test_names_that_python_uses_for_itself(self) -> None:
        cls = define("int32 from\nint32 None\nint32 self")
        message = cls(**{"from": 1, "self": 3})
        message = cls.from_bytes(message.to_bytes())
        assert [getattr(message, n) for n in ("from", "None", "self")] == [1, 0, 3]
        assert cls(1, 0, 3) == message
        assert message.to_dict() == {"from": 1, "None": 0, "self": 3}
        assert cls.from_dict(message.to_dict()) == message
        assert repr(message) == "Type(from=1, None=0, self=3)"
        assert getattr(message.replace(**{"from": 9}), "from") == 9

    def test_names_of_builtins(self) -> None:
        cls = define(
            "std_msgs/String[2] range\nfloat32[2] bytes\nuint8[5000] bool\nint8 setattr\n"
            "string len\nint32[] list\nbool[] map\nstring[] str\ntime new\nint8 array\nint8 from"
        )
        message = cls(setattr=1, len="x", str=["y"], **{"from": 3})
        assert cls.from_bytes(message.to_bytes()) == message
        with pytest.raises(TypeError, match="either by position or by name"):
            cls(*[None] * 11, setattr=5)

    def test_names_of_methods(self) -> None:
        cls = define(
            "int32 serialize\nint32 to_bytes\nint32 replace\nint32 data\nint32 deserialize"
        )
        message = cls(1, 2, 3, 4, 5)
        assert message.to_bytes == 2
        assert cls._frame(message)[:8] == b"\x14\0\0\0\1\0\0\0"
        assert cls.from_bytes(cls._encode(message)) == message

    def test_the_base_class_is_no_message(self) -> None:
        with pytest.raises(TypeError):
            Message()


class TestClassAttributes:
    def test_those_of_genpy(self) -> None:
        assert PoseStamped._type == "geometry_msgs/PoseStamped"
        assert PoseStamped._md5sum == "d3812c3cbc69362b77dc0b19b345f8f5"
        assert "MSG: geometry_msgs/Quaternion\n" in PoseStamped._full_text
        assert (PoseStamped._has_header, Point._has_header) == (True, False)
        assert list(PoseStamped.__slots__) == ["header", "pose"]
        assert PoseStamped._slot_types == ["std_msgs/Header", "geometry_msgs/Pose"]
        assert PoseStamped()._get_types() == PoseStamped._slot_types
        assert PoseStamped()._connection_header is None

    def test_fields(self) -> None:
        field = load_msg("geometry_msgs/PoseWithCovariance")._fields[1]
        assert (field.name, field.type, field.base_type) == ("covariance", "float64[36]", "float64")
        assert (field.is_array, field.array_len, field.is_builtin) == (True, 36, True)

    def test_constants(self) -> None:
        cls = load_msg("rosgraph_msgs/Log")
        assert (cls.DEBUG, cls.WARN) == (1, 4)
        cls = define("string S= a # b\nbool B=True\nfloat64 F=1e3\nint8 I=-1")
        assert (cls.S, cls.B, cls.F, cls.I) == ("a # b", True, 1000.0, -1)

    def test_constants_that_would_break_the_class(self) -> None:
        cls = define("int32 x=1\nint32 __init__=2\nint32 _type=3\nint32 a b=4\nint32 x\nint32 _e=5")
        assert cls(x=7).to_bytes() == b"\7\0\0\0"
        assert cls._type == "p/Type"
        assert [constant.name for constant in cls._constants] == [
            "x", "__init__", "_type", "a b", "_e",
        ]  # fmt: skip

    def test_codecs_are_made_when_they_are_used(self) -> None:
        cls = define("int32 x")
        assert "_encode" not in cls.__dict__
        cls(x=1).to_bytes()
        assert "_encode" in cls.__dict__
        with pytest.raises(AttributeError, match="no attribute '_no_such'"):
            _ = cls._no_such


class TestEquality:
    @pytest.mark.parametrize(
        "ranges",
        [
            [1.0, 2.0],
            (1.0, 2.0),
            array("f", [1.0, 2.0]),
            array("d", [1.0, 2.0]),
            np.array([1.0, 2.0], np.float32),
            memoryview(array("f", [1.0, 2.0])),
            [1, 2],
        ],
    )
    def test_by_value_whatever_holds_an_array(self, ranges: Any) -> None:
        assert LaserScan(ranges=ranges) == LaserScan(ranges=array("f", [1.0, 2.0]))
        assert LaserScan(ranges=array("f", [1.0, 2.0])) == LaserScan(ranges=ranges)
        assert LaserScan(ranges=ranges) != LaserScan(ranges=[1.0, 2.5])
        assert LaserScan(ranges=ranges) != LaserScan(ranges=[1.0])
        assert LaserScan(ranges=ranges) == LaserScan(ranges=ranges)

    @pytest.mark.parametrize(
        "data", [b"ab", bytearray(b"ab"), [97, 98], np.array([97, 98], np.uint8), memoryview(b"ab")]
    )
    def test_octets(self, data: Any) -> None:
        image = load_msg("sensor_msgs/Image")
        assert image(data=data) == image(data=b"ab")
        assert image(data=b"ab") == image(data=data)
        assert image(data=data) != image(data=b"ac")

    def test_two_numpy_arrays(self) -> None:
        one, two = np.zeros(3, np.float32), np.zeros(3, np.float32)
        assert LaserScan(ranges=one) == LaserScan(ranges=two)

    def test_other_types_are_not_equal(self) -> None:
        assert Point(1, 2, 3) != load_msg("geometry_msgs/Vector3")(1, 2, 3)
        assert Point() != 5
        assert String(data="1") != String(data=1)

    def test_the_same_type_of_another_store(self) -> None:
        other = MessageStore(parent=None)
        other.add_text("std_msgs/String", "string data # here too")
        assert other.load_msg("std_msgs/String")(data="a") == String(data="a")

    def test_messages_cannot_be_hashed(self) -> None:
        with pytest.raises(TypeError):
            hash(Point())


class TestText:
    def test_repr(self) -> None:
        assert repr(String(data="hi")) == "String(data='hi')"
        assert repr(Header(stamp=Time(1, 2))) == (
            "Header(seq=0, stamp=Time(secs=1, nsecs=2), frame_id='')"
        )

    def test_str(self) -> None:
        cls = define(
            "Header h\nbool b\nfloat64[] d\nuint8[] o\nstring[] s\nstring e\ntime[] t\n"
            "geometry_msgs/Point[] p\nduration u\nstring[] no"
        )
        message = cls(
            h=Header(1, Time(2, 3), "m\tap"),
            b=True,
            d=[1, 2.5],
            o=b"\1\2",
            s=["a", "yes", "a: b"],
            t=[Time(1)],
            p=[Point(1, 2, 3)],
            u=Duration(-1.5),
        )
        assert str(message) == (
            "h: \n  seq: 1\n  stamp: \n    secs: 2\n    nsecs:         3\n"
            '  frame_id: "m\\tap"\n'
            "b: True\nd: [1, 2.5]\no: [1, 2]\n"
            "s: \n  - a\n  - 'yes'\n  - 'a: b'\n"
            "e: ''\n"
            "t: \n  - \n    secs: 1\n    nsecs:         0\n"
            "p: \n  - \n    x: 1\n    y: 2\n    z: 3\n"
            "u: \n  secs: -2\n  nsecs: 500000000\n"
            "no: []"
        )

    def test_incomplete_messages_can_be_shown(self) -> None:
        point = Point()
        del point.y
        assert repr(point) == "Point(x=0.0, y='<unset>', z=0.0)"
        assert str(point) == "x: 0.0\ny: None\nz: 0.0"


class TestCopies:
    scan = LaserScan(Header(1, Time(2, 3), "f"), *[0.5] * 7, array("f", [1, 2]), [3])

    def test_copy_shares_what_is_inside(self) -> None:
        other = copy.copy(self.scan)
        assert other == self.scan
        assert other.header is self.scan.header

    def test_deepcopy_does_not(self) -> None:
        other = copy.deepcopy(self.scan)
        assert other == self.scan
        assert other.header is not self.scan.header
        assert other.ranges is not self.scan.ranges

    def test_replace(self) -> None:
        other = self.scan.replace(angle_min=9, ranges=[])
        assert (other.angle_min, other.ranges) == (9, [])
        assert self.scan.angle_min == 0.5

    @pytest.mark.parametrize("protocol", range(pickle.HIGHEST_PROTOCOL + 1))
    def test_pickle(self, protocol: int) -> None:
        other = pickle.loads(pickle.dumps(self.scan, protocol))
        assert other == self.scan
        assert type(other) is LaserScan

    def test_pickle_of_types_that_no_import_leads_to(self) -> None:
        store = MessageStore()
        store.add_text("p/Inner", "string[] names")
        store.add_text("p/Outer", "Inner[] inners\ntime t")
        cls = store.load_msg("p/Outer")
        message = cls([store.load_msg("p/Inner")(["a"])], Time(1))
        other = pickle.loads(pickle.dumps(message))
        assert other == message
        assert pickle.loads(pickle.dumps(other)) == message
        assert type(pickle.loads(pickle.dumps(message))) is type(other)

    def test_pickle_of_requests(self) -> None:
        request = load_srv("std_srvs/SetBool").Request(data=True)
        assert pickle.loads(pickle.dumps(request)) == request


class TestDicts:
    def test_to_dict_has_plain_values(self) -> None:
        cls = define(
            "Header h\nfloat32[] f\nuint8[] o\nduration u\nstring[] s\ntime[] t\nbool[1] b"
        )
        message = cls(f=[1, 2], o=b"ab", u=Duration(-1), s=["x"], t=[Time(1)])
        assert message.to_dict() == {
            "h": {"seq": 0, "stamp": {"secs": 0, "nsecs": 0}, "frame_id": ""},
            "f": [1.0, 2.0],
            "o": b"ab",
            "u": {"secs": -1, "nsecs": 0},
            "s": ["x"],
            "t": [{"secs": 1, "nsecs": 0}],
            "b": [False],
        }
        assert cls.from_bytes(message.to_bytes()).to_dict() == message.to_dict()
        assert cls.from_dict(message.to_dict()) == message

    def test_unusual_values(self) -> None:
        cls = define("float32[] f\nuint8[] o")
        for f, o in (
            (np.zeros(1, np.float32), np.zeros(1, np.uint8).data),
            (memoryview(array("f", [0])), bytearray(1)),
            ((0.0,), array("B", [0])),
        ):
            assert cls(f, o).to_dict() == {"f": [0.0], "o": b"\0"}

    def test_from_dict_fills_in_defaults(self) -> None:
        message = PoseStamped.from_dict({"pose": {"position": {"x": 1}}})
        assert message.pose.position == Point(1, 0, 0)
        assert message.header == Header()


class TestGenpyMethods:
    def test_serialize_and_deserialize(self) -> None:
        buffer = io.BytesIO()
        String(data="hi").serialize(buffer)
        assert buffer.getvalue() == b"\2\0\0\0hi"
        message = String()
        assert message.deserialize(buffer.getvalue()) is message
        assert message.data == "hi"

    def test_numpy_variants(self) -> None:
        cls = define("float32[] f\nuint8[] o\nint16[2] i\nsensor_msgs/LaserScan[] s")
        source = cls(f=[1, 2], o=b"ab", i=[3, 4], s=[LaserScan(ranges=[5])])
        buffer = io.BytesIO()
        source.serialize_numpy(buffer, np)
        message = cls().deserialize_numpy(buffer.getvalue(), np)
        assert isinstance(message.f, np.ndarray)
        assert message.f.dtype == np.float32
        assert isinstance(message.s[0].ranges, np.ndarray)
        assert message.o == b"ab"
        message.f[0] = 7  # it is the message's own
        assert message != source

    def test_any_buffer_can_be_decoded(self) -> None:
        octets = String(data="hi").to_bytes()
        for kind in (bytes, bytearray, memoryview, lambda data: np.frombuffer(data, np.uint8)):
            assert String.from_bytes(kind(octets)) == String(data="hi")
        with pytest.raises(TypeError):
            String.from_bytes("hi")


def test_a_constant_does_not_hide_what_all_messages_have() -> None:
    store = MessageStore(parent=None)
    store.add_text("p/Type", "int8 to_bytes=1\nint8 _type=2\nint8 other=3\nint8 x")
    cls: Any = store.load_msg("p/Type")
    assert cls(x=4).to_bytes() == b"\4"
    assert (cls._type, cls.other) == ("p/Type", 3)
    assert [constant.name for constant in cls._constants] == ["to_bytes", "_type", "other"]
