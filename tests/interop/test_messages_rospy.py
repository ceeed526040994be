"""Messages of all kinds between our nodes and rospy's: what arrives is what was sent."""

from __future__ import annotations

import zlib
from typing import Any

import pytest

from .ours import take
from .world import World

STRING = "std_msgs/String"


async def test_header_sequence_of_our_publisher(under_rosmaster: World) -> None:
    world = under_rosmaster
    topic = world.unique("joints")
    async with (
        world.node("ours") as node,
        node.advertise(topic, "sensor_msgs/JointState", queue_size=100) as pub,
    ):
        listener = world.rospy("listener", topic, "sensor_msgs/JointState")
        await pub.wait_for_subscribers(timeout=15)
        for i in range(5):
            msg = pub.message(name=["shoulder", "elbow"], position=[0.5 * i, -1.25])
            msg.header.frame_id = "arm"
            msg.velocity = [1e-3]
            pub.publish(msg)
        messages = await listener.wait_values("message", 5)
        seqs = [m["header"]["seq"] for m in messages]
        assert seqs == list(range(seqs[0], seqs[0] + 5))
        assert messages[3]["name"] == ["shoulder", "elbow"]
        assert messages[3]["position"] == [1.5, -1.25]
        assert messages[3]["velocity"] == [1e-3]
        assert messages[3]["effort"] == []
        assert messages[3]["header"]["frame_id"] == "arm"


async def test_header_sequence_of_rospy(under_rosmaster: World) -> None:
    world = under_rosmaster
    topic = world.unique("joints")
    fields = world.fields(
        header={"frame_id": "arm", "stamp": {"secs": 7, "nsecs": 999_999_999}},
        name=["shoulder", "elbow"],
        position=[0.1, -1e300],
    )
    async with (
        world.node("ours") as node,
        node.subscribe(topic, "sensor_msgs/JointState", queue_size=100) as sub,
    ):
        world.rospy("talker", topic, "sensor_msgs/JointState", fields, "--count", "5")
        messages = await take(sub, 5)
        seqs = [m.header.seq for m in messages]
        assert seqs == list(range(seqs[0], seqs[0] + 5))
        last = messages[-1]
        assert (last.header.stamp.secs, last.header.stamp.nsecs) == (7, 999_999_999)
        assert last.header.frame_id == "arm"
        assert list(last.name) == ["shoulder", "elbow"]
        assert list(last.position) == [0.1, -1e300]
        assert list(last.effort) == []


async def test_a_large_image_from_us(under_rosmaster: World) -> None:
    world = under_rosmaster
    topic = world.unique("image")
    data = bytes(k % 251 for k in range(1 << 20))
    async with (
        world.node("ours") as node,
        node.advertise(topic, "sensor_msgs/Image") as pub,
    ):
        listener = world.rospy("listener", topic, "sensor_msgs/Image")
        await pub.wait_for_subscribers(timeout=15)
        for i in range(3):
            await pub.send(
                height=1024, width=1024, step=1024, encoding="mono8", data=data[i:] + data[:i]
            )
        messages = await listener.wait_values("message", 3)
        for i, message in enumerate(messages):
            crc = zlib.crc32(data[i:] + data[:i])
            assert message["data"] == {"length": 1 << 20, "crc": crc}
        assert messages[0]["encoding"] == "mono8"


async def test_a_large_image_from_rospy(under_rosmaster: World) -> None:
    world = under_rosmaster
    topic = world.unique("image")
    size = 1 << 20
    async with (
        world.node("ours") as node,
        node.subscribe(topic, "sensor_msgs/Image") as sub,
    ):
        fields = world.fields(height=1024, width=1024, step=1024, encoding="mono8")
        options = ("--count", "3", "--rate", "5", "--bytes", str(size))
        world.rospy("talker", topic, "sensor_msgs/Image", fields, *options)
        messages = await take(sub, 3)
        for i, message in enumerate(messages):
            assert bytes(message.data) == bytes((k + i) % 251 for k in range(size))
        assert (messages[0].height, messages[0].encoding) == (1024, "mono8")


async def test_empty_messages_both_ways(under_rosmaster: World) -> None:
    world = under_rosmaster
    to_us, from_us = world.unique("to_us"), world.unique("from_us")
    async with (
        world.node("ours") as node,
        node.subscribe(to_us, "std_msgs/Empty") as sub,
        node.advertise(from_us, "std_msgs/Empty") as pub,
    ):
        world.rospy("talker", to_us, "std_msgs/Empty", "{}", "--count", "3", "--name", "t")
        listener = world.rospy("listener", from_us, "std_msgs/Empty", "--name", "l")
        messages = await take(sub, 3)
        assert [m._type for m in messages] == ["std_msgs/Empty"] * 3
        await pub.wait_for_subscribers(timeout=15)
        for _ in range(3):
            pub.publish()
        assert await listener.wait_values("message", 3) == [{}, {}, {}]


NESTED: list[tuple[str, dict[str, Any]]] = [
    (
        "trajectory_msgs/JointTrajectory",
        {
            "header": {"seq": 1, "stamp": [1, 2], "frame_id": "arm"},
            "joint_names": ["shoulder", "", "elbow"],
            "points": [
                {
                    "positions": [float(i), 0.5],
                    "velocities": [],
                    "accelerations": [1e-300],
                    "effort": [],
                    "time_from_start": [i, 500_000_000],
                }
                for i in range(3)
            ],
        },
    ),
    (
        "geometry_msgs/PoseArray",
        {
            "header": {"seq": 1, "stamp": [3, 4], "frame_id": "map"},
            "poses": [
                {
                    "position": {"x": float(i), "y": -0.5, "z": 0.25},
                    "orientation": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0},
                }
                for i in range(3)
            ],
        },
    ),
    (
        "std_msgs/Float64MultiArray",
        {
            "layout": {
                "dim": [
                    {"label": "rows", "size": 2, "stride": 4},
                    {"label": "columns", "size": 2, "stride": 2},
                ],
                "data_offset": 0,
            },
            "data": [1.0, 2.5, -3.0, 1e-300],
        },
    ),
    (
        "sensor_msgs/PointCloud",
        {
            "header": {"seq": 1, "stamp": [0, 0], "frame_id": "laser"},
            "points": [{"x": 0.5, "y": 1.5, "z": -2.0}, {"x": 1.0, "y": 0.0, "z": 0.0}],
            "channels": [{"name": "intensity", "values": [0.25, 0.5]}],
        },
    ),
    (
        "geometry_msgs/PoseWithCovariance",
        {
            "pose": {
                "position": {"x": 1.0, "y": 2.0, "z": 3.0},
                "orientation": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0},
            },
            "covariance": [float(i) / 4 for i in range(36)],
        },
    ),
]


def _genpy_fields(value: Any, key: str = "") -> Any:
    """As genpy wants times: by name."""
    if isinstance(value, dict):
        return {k: _genpy_fields(v, k) for k, v in value.items()}
    if key in ("stamp", "time_from_start"):
        return {"secs": value[0], "nsecs": value[1]}
    if isinstance(value, list):
        return [_genpy_fields(v) for v in value]
    return value


def _plain(message: Any) -> Any:
    """One of our messages as the peers of this folder print theirs."""
    if hasattr(message, "nsecs"):
        return [message.secs, message.nsecs]
    if hasattr(message, "_slot_types"):
        return {name: _plain(getattr(message, name)) for name in message.__slots__}
    if isinstance(message, (str, bytes, int, float)):
        return message
    return [_plain(item) for item in message]


@pytest.mark.parametrize(("type_name", "value"), NESTED, ids=[name for name, _ in NESTED])
async def test_nested_and_array_types_both_ways(
    under_rosmaster: World, type_name: str, value: dict[str, Any]
) -> None:
    """Our message goes to rospy; rospy's, of the same fields, comes to us."""
    import aioros1

    world = under_rosmaster
    to_us, from_us = world.unique("to_us"), world.unique("from_us")
    fields = world.fields(**_genpy_fields(value))
    async with (
        world.node("ours") as node,
        node.subscribe(to_us, type_name) as sub,
        node.advertise(from_us, type_name, latch=True) as pub,
    ):
        world.rospy("talker", to_us, type_name, fields, "--count", "1", "--name", "t")
        listener = world.rospy("listener", from_us, type_name, "--name", "l")
        (message,) = await take(sub, 1)
        assert isinstance(message, aioros1.load_msg(type_name))
        assert _plain(message) == value
        pub.publish(message)
        (heard,) = await listener.wait_values("message")
        assert heard == value


async def test_any_type_is_decoded_from_the_definition_of_rospy(under_each: World) -> None:
    world = under_each
    topic = world.unique("joints")
    fields = world.fields(name=["a"], position=[0.5])
    async with world.node("ours") as node, node.subscribe(topic) as sub:
        assert sub.type == "*"
        world.rospy("talker", topic, "sensor_msgs/JointState", fields)
        (message,) = await take(sub, 1)
        assert message._type == "sensor_msgs/JointState"
        assert list(message.name) == ["a"]
        assert list(message.position) == [0.5]


async def test_a_type_nobody_has_heard_of(under_rosmaster: World) -> None:
    """Our side has no file of it, only what the publisher sends."""
    import aioros1

    world = under_rosmaster
    topic = world.unique("odometry")
    fields = world.fields(
        child_frame_id="base",
        pose={"pose": {"position": {"x": 1.5}}},
        twist={"covariance": [0.25] * 36},
    )
    store = aioros1.MessageStore(parent=None)
    async with world.node("ours", store=store) as node, node.subscribe(topic) as sub:
        world.rospy("talker", topic, "nav_msgs/Odometry", fields)
        (message,) = await take(sub, 1)
        assert message._type == "nav_msgs/Odometry"
        assert message.child_frame_id == "base"
        assert message.pose.pose.position.x == 1.5
        assert list(message.twist.covariance) == [0.25] * 36


async def test_raw_bytes_of_rospy(under_rosmaster: World) -> None:
    import aioros1

    world = under_rosmaster
    topic = world.unique("raw")
    async with (
        world.node("ours") as node,
        node.subscribe(topic, STRING, raw=True) as sub,
        node.subscribe(topic, "*", raw=True) as any_sub,
    ):
        world.rospy("talker", topic, STRING, world.fields(data="bytes"), "--count", "1")
        (raw,) = await take(sub, 1)
        expected = aioros1.load_msg(STRING)(data="bytes").to_bytes()
        assert bytes(raw) == expected
        assert bytes((await take(any_sub, 1))[0]) == expected


async def test_rospy_hears_our_raw_bytes(under_rosmaster: World) -> None:
    import aioros1

    world = under_rosmaster
    topic = world.unique("raw")
    async with world.node("ours") as node, node.advertise(topic, STRING) as pub:
        listener = world.rospy("listener", topic, STRING)
        await pub.wait_for_subscribers(timeout=15)
        pub.publish_raw(aioros1.load_msg(STRING)(data="bytes").to_bytes())
        assert await listener.wait_values("message") == [{"data": "bytes"}]


async def test_an_any_type_listener_of_rospy_gets_our_definition(under_rosmaster: World) -> None:
    world = under_rosmaster
    topic = world.unique("any")
    async with (
        world.node("ours") as node,
        node.advertise(topic, "sensor_msgs/JointState") as pub,
    ):
        listener = world.rospy("listener", topic, "*")
        await pub.wait_for_subscribers(timeout=15)
        message = pub.message(name=["a"], position=[0.5])
        pub.publish(message)
        assert await listener.wait_values("message") == [{"length": len(message.to_bytes())}]
        (definition,) = listener.values("definition")
        assert "float64[] position" in definition
        assert "MSG: std_msgs/Header" in definition


async def test_bytes_that_are_no_text_survive(under_rosmaster: World) -> None:
    """What rospy cannot decode either reaches us and goes on as it was."""
    import aioros1

    world = under_rosmaster
    source, sink = world.unique("source"), world.unique("sink")
    latin = b"caf\xe9"
    raw = len(latin).to_bytes(4, "little") + latin
    async with (
        world.node("upstream") as upstream,
        world.node("ours") as node,
        upstream.advertise(source, STRING, latch=True) as pub,
        node.subscribe(source, STRING) as sub,
        node.advertise(sink, STRING, latch=True) as onward,
    ):
        pub.publish_raw(raw)
        (message,) = await take(sub, 1)
        assert message.data.encode("utf-8", "surrogateescape") == latin
        onward.publish(message)
        listener = world.rospy("listener", sink, "*")
        await listener.wait_values("message")
        assert listener.values("message") == [{"length": len(raw)}]
        assert aioros1.load_msg(STRING)(data=message.data).to_bytes() == raw
