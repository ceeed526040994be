"""Definitions loaded at run time, and messages: fields, arrays, copies, octets."""

from __future__ import annotations

import copy
import gc
import hashlib
import weakref
from array import array

import pytest

import aioros1
from aioros1.idl import Message, full_text, md5_text, md5sum, parse_message
from aioros1.idl.builtin_types import BUILTINS, is_builtin
from aioros1.msg.geometry_msgs import Point, Polygon, PoseStamped
from aioros1.msg.rosgraph_msgs import Log
from aioros1.msg.std_msgs import Header, String

NUMBERS = {
    "int8": -5,
    "int16": -500,
    "int32": -70000,
    "int64": -(2**40),
    "uint8": 200,
    "uint16": 60000,
    "uint32": 2**32 - 1,
    "uint64": 2**64 - 1,
    "float32": 0.5,
    "float64": 0.1,
}


def define(text, type="robot_msgs/Thing"):
    store = aioros1.MessageStore()
    store.add_text(type, text)
    return store.load_msg(type)


def spec_of(type):
    return aioros1.load_msg(type)._spec


def again(message):
    """The message as somebody else receives it."""
    return type(message).from_bytes(message.to_bytes())


@pytest.fixture
def folder(tmp_path):
    """A tree of packages, as cROS's message_root_path names it."""
    for kind, name, text in (
        ("msg", "Wheel", "float64 speed\n"),
        ("msg", "Car", "Header header\nWheel[4] wheels\nstd_msgs/String name\n"),
        ("srv", "Drive", "Wheel wheel\n---\nbool done\n"),
        ("action", "Park", "Wheel wheel\n---\nbool done\n---\nfloat32 left\n"),
    ):
        path = tmp_path / "car_msgs" / kind / f"{name}.{kind}"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return tmp_path


# ------------------------------------------------------------------ loading


@pytest.mark.parametrize(
    "function",
    [
        "cRosMessageDefBuild",
        "cRosMessageNewBuild",
        "cRosMessageBuildFromDef",
        "loadFromFileMsg",
        "getFileDependenciesMsg",
        "getDependenciesMsg",
    ],
)
def test_loading_a_message(folder, function):
    Car = aioros1.MessageStore([folder]).load_msg("car_msgs/Car")  # noqa: N806 - a class
    car = Car()
    car.wheels[3].speed = 2.5
    car.name.data = "beetle"
    assert again(car) == car
    assert Car._spec.dependencies == ("std_msgs/Header", "car_msgs/Wheel", "std_msgs/String")


@pytest.mark.parametrize(
    "function",
    [
        "cRosServiceBuild",
        "cRosServiceBuildInner",
        "loadFromFileSrv",
        "getFileDependenciesSrv",
    ],
)
def test_loading_a_service(folder, function):
    Drive = aioros1.MessageStore([folder]).load_srv("car_msgs/Drive")  # noqa: N806 - a class
    request = Drive.Request()
    request.wheel.speed = 2.5
    assert again(request) == request
    assert again(Drive.Response(done=True)).done is True


def test_loading_an_action(folder):
    Park = aioros1.MessageStore([folder]).load_action("car_msgs/Park")  # noqa: N806 - a class
    assert again(Park.ActionGoal()).goal == Park.Goal()


def test_loadFromStringMsg():
    Thing = define("uint8 A=5\nstring name\n")  # noqa: N806 - a class
    assert (Thing.A, Thing(name="x").name) == (5, "x")


def test_loadFromStringMsg_of_a_full_text():
    """As it comes in a connection header: with all types that it needs."""
    store = aioros1.MessageStore(parent=None)
    cls = store.add_definition("geometry_msgs/PoseStamped", PoseStamped._full_text)
    assert cls is not PoseStamped
    assert cls._md5sum == PoseStamped._md5sum


async def test_cRosMessageBuildFromDef_of_a_publisher(make_node):
    """A subscriber to any type makes the class from what the publisher says."""
    store = aioros1.MessageStore()
    store.add_text("car_msgs/Wheel", "float64 speed\n")
    talker = await make_node("talker", store=store)
    listener = await make_node("listener")
    async with (
        talker.advertise("wheel", "car_msgs/Wheel", latch=True) as pub,
        listener.subscribe("wheel") as sub,
    ):
        pub.publish(speed=2.5)
        message = await sub.get(timeout=30)
        assert (message._type, message.speed) == ("car_msgs/Wheel", 2.5)


@pytest.mark.parametrize(
    "struct", ["cRosMessage", "cRosMessageField", "cRosMessageDef", "cRosService"]
)
def test_struct_is_a_class(struct):
    if struct == "cRosService":
        srv = aioros1.load_srv("std_srvs/SetBool")
        assert (srv._type, len(srv._md5sum)) == ("std_srvs/SetBool", 32)
        assert srv.Request(data=True).data is True
    else:
        assert Header.__slots__ == ("seq", "stamp", "frame_id")
        assert Header._slot_types == ["uint32", "time", "string"]
        assert (Header._type, Header._md5sum) == (
            "std_msgs/Header",
            "2176decaecbce78abc3b96ef049fabed",
        )
        assert Header._full_text.splitlines()[-1] == "string frame_id"


@pytest.mark.parametrize(
    "function",
    [
        "cRosMessageNew",
        "cRosMessageInit",
        "cRosMessageFieldNew",
        "cRosMessageFieldInit",
        "cRosServiceNew",
        "cRosServiceInit",
    ],
)
def test_constructor(function):
    pose = PoseStamped()
    assert (pose.header.frame_id, pose.pose.position.x) == ("", 0.0)
    assert PoseStamped().header is not pose.header
    assert aioros1.load_srv("std_srvs/SetBool").Request().data is False


@pytest.mark.parametrize(
    "function",
    [
        "cRosMessageRelease",
        "cRosMessageFree",
        "cRosMessageFieldRelease",
        "cRosMessageFieldFree",
        "cRosMessageFieldsFree",
        "cRosMessageDefFree",
        "cRosServiceRelease",
        "cRosServiceFree",
        "cRosServiceDefFree",
    ],
)
def test_nobody_frees(function):
    """What is not used any more goes by itself: classes do, when their store does."""
    reference = weakref.ref(define("string name\n"))
    gc.collect()
    assert reference() is None


def test_cRosMessageDefCopy():
    spec = copy.copy(PoseStamped._spec)
    assert spec == PoseStamped._spec


# ------------------------------------------------------------------ fields


def test_cRosMessageFieldsPrint():
    assert str(PoseStamped(header=Header(frame_id="map"))).splitlines()[:6] == [
        "header: ",
        "  seq: 0",
        "  stamp: ",
        "    secs: 0",
        "    nsecs:         0",
        '  frame_id: "map"',
    ]
    assert repr(Point(x=1.0)) == "Point(x=1.0, y=0.0, z=0.0)"


def test_cRosMessageGetField():
    pose = PoseStamped()
    pose.pose.position.x = 2.5
    assert pose.pose.position.x == 2.5
    assert getattr(pose, "header") is pose.header  # noqa: B009 - by a name known at run time
    with pytest.raises(AttributeError):
        pose.nothing  # noqa: B018 - the reading of it is what fails


@pytest.mark.parametrize(
    ("member", "type", "value"),
    [
        ("as_int8", "int8", -5),
        ("as_int16", "int16", -500),
        ("as_int32", "int32", -70000),
        ("as_int64", "int64", -(2**40)),
        ("as_uint8", "uint8", 200),
        ("as_uint16", "uint16", 60000),
        ("as_uint32", "uint32", 2**32 - 1),
        ("as_uint64", "uint64", 2**64 - 1),
        ("as_float32", "float32", 0.5),
        ("as_float64", "float64", 0.1),
        ("as_string", "string", "ü"),
        ("as_msg", "std_msgs/String", String(data="x")),
        ("as_int8_array", "int8[]", array("b", [1, -1])),
        ("as_uint8_array", "uint8[]", b"\1\xff"),
        ("as_float32_array", "float32[]", array("f", [1.5])),
        ("as_string_array", "string[]", ["a", "b"]),
        ("as_msg_array", "std_msgs/String[]", [String(data="x")]),
        ("as_array", "time[]", [aioros1.Time(1, 2)]),
        ("opaque", "bool[]", [True, False]),
    ],
    ids=lambda value: value if isinstance(value, str) and value[:3] in ("as_", "opa") else "",
)
def test_field_value(member, type, value):
    found = again(define(f"{type} v\n")(v=value)).v
    assert found == value
    if not isinstance(value, Message | list):
        assert found.__class__ is value.__class__


@pytest.mark.parametrize(
    ("function", "type"),
    [
        ("cRosMessageFieldArrayPushBackInt8", "int8"),
        ("cRosMessageFieldArrayPushBackInt16", "int16"),
        ("cRosMessageFieldArrayPushBackInt32", "int32"),
        ("cRosMessageFieldArrayPushBackInt64", "int64"),
        ("cRosMessageFieldArrayPushBackUInt8", "uint8"),
        ("cRosMessageFieldArrayPushBackUInt16", "uint16"),
        ("cRosMessageFieldArrayPushBackUInt32", "uint32"),
        ("cRosMessageFieldArrayPushBackUInt64", "uint64"),
        ("cRosMessageFieldArrayPushBackFloat32", "float32"),
        ("cRosMessageFieldArrayPushBackFloat64", "float64"),
    ],
    ids=lambda value: value if value.startswith("cRos") else "",
)
def test_appending_a_number(function, type):
    message, value = define(f"{type}[] v\n")(), NUMBERS[type]
    if type == "uint8":  # bytes, which grow by being replaced
        message.v += bytes([value])
    else:
        message.v.append(value)
    assert list(again(message).v) == [value]


def test_cRosMessageFieldArrayPushBackUInt8_in_place():
    """An array of octets that shall grow can be a bytearray."""
    message = define("uint8[] v\n")(v=bytearray())
    message.v.append(200)
    assert again(message).v == b"\xc8"


def test_cRosMessageFieldArrayPushBackString():
    message = define("string[] v\n")()
    message.v.append("x")
    assert again(message).v == ["x"]


def test_cRosMessageFieldArrayPushBackMsg():
    message = Polygon()
    message.points.append(aioros1.load_msg("geometry_msgs/Point32")(x=1.5))
    assert again(message).points[0].x == 1.5


def test_cRosMessageFieldArrayPushBackZero():
    message = Polygon()
    message.points.append(aioros1.load_msg("geometry_msgs/Point32")())
    assert again(message).points[0].x == 0.0
    numbers = define("int32[] v\n")()
    numbers.v.append(0)
    assert list(again(numbers).v) == [0]


@pytest.mark.parametrize(
    ("function", "type"),
    [
        ("cRosMessageFieldArrayAtInt8", "int8"),
        ("cRosMessageFieldArrayAtInt16", "int16"),
        ("cRosMessageFieldArrayAtInt32", "int32"),
        ("cRosMessageFieldArrayAtInt64", "int64"),
        ("cRosMessageFieldArrayAtUInt8", "uint8"),
        ("cRosMessageFieldArrayAtUInt16", "uint16"),
        ("cRosMessageFieldArrayAtUInt32", "uint32"),
        ("cRosMessageFieldArrayAtUInt64", "uint64"),
        ("cRosMessageFieldArrayAtFloat32", "float32"),
        ("cRosMessageFieldArrayAtFloat64", "float64"),
    ],
    ids=lambda value: value if value.startswith("cRos") else "",
)
def test_element_of_an_array_of_numbers(function, type):
    message, value = define(f"{type}[3] v\n")(), NUMBERS[type]
    if type == "uint8":
        message.v = bytearray(message.v)
    message.v[1] = value
    assert list(again(message).v) == [0, value, 0]


def test_cRosMessageFieldArrayAtStringGet_and_StringSet():
    """cRosMessageFieldArrayAtStringSet is an assignment."""
    message = define("string[2] v\n")()
    message.v[1] = "x"
    assert again(message).v[1] == "x"


def test_cRosMessageFieldArrayAtMsgGet_and_MsgSet():
    """cRosMessageFieldArrayAtMsgSet is an assignment."""
    message = define("geometry_msgs/Point[2] v\n")()
    message.v[0].x = 1.0
    message.v[1] = Point(y=2.0)
    assert (again(message).v[0].x, again(message).v[1].y) == (1.0, 2.0)


def test_cRosMessageFieldArrayRemoveLastMsg():
    message = define("geometry_msgs/Point[] v\n")(v=[Point(x=1.0), Point(x=2.0)])
    assert message.v.pop().x == 2.0
    assert again(message).v == [Point(x=1.0)]


@pytest.mark.parametrize("type", ["geometry_msgs/Point[]", "string[]", "int32[]", "uint8[]"])
def test_cRosMessageFieldArrayClear(type):
    message = define(f"{type} v\n")()
    size = len(message.to_bytes())
    message.v = {"int32[]": array("i", [1]), "uint8[]": bytearray(b"x")}.get(type, [])
    del message.v[:]
    assert len(message.to_bytes()) == size


def test_cRosMessageSetFieldValueString():
    message = String()
    message.data = "x"
    assert again(message).data == "x"


def test_cRosMessageCopy_is_deep():
    pose = PoseStamped()
    other = copy.deepcopy(pose)
    other.pose.position.x = 1.0
    assert pose.pose.position.x == 0.0
    assert other != pose


@pytest.mark.parametrize(
    "function", ["cRosMessageFieldCopy", "cRosMessageFieldsCopy", "cRosMessageCopyWithoutDef"]
)
def test_copying(function):
    point = Point(x=1.0, y=2.0)
    assert copy.copy(point) == point
    assert point.replace(y=3.0) == Point(x=1.0, y=3.0)
    assert Point.from_dict(point.to_dict()) == point


# ------------------------------------------------------------------ octets


def test_cRosMessageSize():
    assert len(String(data="hi").to_bytes()) == 6
    assert len(Point().to_bytes()) == 24


def test_cRosMessageSerialize():
    assert String(data="hi").to_bytes() == b"\2\0\0\0hi"


def test_cRosMessageDeserialize():
    assert String.from_bytes(b"\2\0\0\0hi") == String(data="hi")
    with pytest.raises(aioros1.DeserializationError):
        String.from_bytes(b"\2\0\0\0h")


BUILTIN_SIZES = {
    "bool": 1, "int8": 1, "uint8": 1, "int16": 2, "uint16": 2, "int32": 4, "uint32": 4,
    "int64": 8, "uint64": 8, "float32": 4, "float64": 8, "string": 4, "time": 8,
    "duration": 8, "char": 1, "byte": 1,
}  # fmt: skip


@pytest.mark.parametrize(
    "function",
    [
        "CrosMessageType",
        "getMessageType",
        "getMessageTypeString",
        "getMessageTypeDeclaration",
        "getMessageTypeSizeOf",
        "isBuiltinMessageType",
    ],
)
def test_builtin_types(function):
    assert {name: builtin.size for name, builtin in BUILTINS.items()} == BUILTIN_SIZES
    for name, size in BUILTIN_SIZES.items():
        cls = define(f"{name} v\n")
        [field] = cls._fields
        assert (field.name, field.type, field.is_builtin) == ("v", name, True)
        assert len(cls().to_bytes()) == size
        assert is_builtin(name)
    assert not is_builtin("std_msgs/Header")


@pytest.mark.parametrize("function", ["msgConst", "initMsgConst"])
def test_constants(function):
    assert (Log.DEBUG, Log.INFO, Log.WARN, Log.ERROR, Log.FATAL) == (1, 2, 4, 8, 16)
    [constant] = define("string NAME= a # b\n")._constants
    assert (constant.type, constant.name, constant.value) == ("string", "NAME", "a # b")


@pytest.mark.parametrize("function", ["initCrosMsg", "initCrosDep", "initFieldDef", "initCrosSrv"])
def test_definition_as_data(function):
    spec = parse_message("car_msgs/Car", "Header header\nWheel[4] wheels\n")
    assert [(field.name, field.base_type, field.array_len) for field in spec.fields] == [
        ("header", "std_msgs/Header", None),
        ("wheels", "car_msgs/Wheel", 4),
    ]


def test_computeFullTextMsg():
    texts = PoseStamped._full_text.split("=" * 80 + "\n")
    assert texts[0].split()[-2:] == ["Pose", "pose"]
    assert [text.splitlines()[0] for text in texts[1:]] == [
        "MSG: std_msgs/Header",
        "MSG: geometry_msgs/Pose",
        "MSG: geometry_msgs/Point",
        "MSG: geometry_msgs/Quaternion",
    ]
    assert full_text(PoseStamped._spec, spec_of) == PoseStamped._full_text


def test_computeFullTextSrv():
    """The text of the service, then those of what both of its messages need."""
    srv = aioros1.load_srv("roscpp/GetLoggers")
    first, second = srv._full_text.split("=" * 80 + "\n")
    assert first.split() == ["---", "Logger[]", "loggers"]
    assert second.split() == ["MSG:", "roscpp/Logger", "string", "name", "string", "level"]


@pytest.mark.parametrize(
    "function", ["getMD5Txt", "cRosMD5Readable", "MD5_Init", "MD5_Update", "MD5_Final"]
)
def test_md5(function):
    spec = parse_message("robot_msgs/Thing", "# a comment\nstring   name\nint32 A = 5\n")
    text = md5_text(spec, spec_of)
    assert text == "int32 A=5\nstring name"
    assert md5sum(spec, spec_of) == hashlib.md5(text.encode()).hexdigest()


def test_cRosGentoolsMD5():
    assert String._md5sum == "992ce8a1687cec8c8bd883ec73ca41d1"
    assert aioros1.load_srv("roscpp_tutorials/TwoInts")._md5sum == (
        "6a2e34150c00229791cc89ff309fff21"
    )


def test_cRosGentoolsFulltext():
    assert define("string name\n")._full_text == "string name\n"


def test_HEADER_DEFAULT_TYPEDEF():
    cls = define("Header header\n")
    assert type(cls().header) is Header
    assert cls._has_header
    assert cls._slot_types == ["std_msgs/Header"]


async def test_HEADER_DEFAULT_TYPEDEF_is_numbered_when_published(make_node):
    node = await make_node()
    async with (
        node.advertise("pose", PoseStamped) as pub,
        node.subscribe("pose", PoseStamped) as sub,
    ):
        await pub.wait_for_subscribers(timeout=30)
        for _ in range(3):
            pub.publish()
        numbers = [(await sub.get(timeout=30)).header.seq for _ in range(3)]
        assert numbers == [numbers[0], numbers[0] + 1, numbers[0] + 2]
