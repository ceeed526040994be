"""Topics between our nodes and roscpp's."""

from __future__ import annotations

import pytest

from .ours import take
from .processes import until
from .world import World

STRING = "std_msgs/String"


async def test_our_publisher_is_heard_in_order(under_each: World) -> None:
    world = under_each
    topic = world.unique("chatter")
    async with (
        world.node("ours") as node,
        node.advertise(topic, STRING, queue_size=100) as pub,
    ):
        listener = world.roscpp("listener", topic, STRING)
        await pub.wait_for_subscribers(timeout=15)
        for i in range(50):
            pub.publish(data=f"number {i}")
        messages = await listener.wait_values("message", 50)
        assert [m["data"] for m in messages] == [f"number {i}" for i in range(50)]
        assert set(listener.values("from")) == {"/ours"}
        await listener.end()
        await until(lambda: pub.subscriber_count == 0, what="no subscriber to be left")


async def test_our_subscriber_hears_in_order(under_each: World) -> None:
    world = under_each
    topic = world.unique("chatter")
    async with (
        world.node("ours") as node,
        node.subscribe(topic, STRING, queue_size=100) as sub,
    ):
        talker = world.roscpp("talker", topic, STRING, "50", "500", "0")
        messages = await take(sub, 50)
        assert [m.data for m in messages] == [f"number {i}" for i in range(50)]
        assert talker.values("subscriber") == ["/ours"]
        await talker.end()
        await until(lambda: sub.publisher_count == 0, what="no publisher to be left")


async def test_our_unsubscribing_is_noticed(under_rosmaster: World) -> None:
    world = under_rosmaster
    topic = world.unique("chatter")
    talker = await world.roscpp_ready("talker", topic, STRING, "0", "100", "0")
    async with world.node("ours") as node:
        async with node.subscribe(topic, STRING) as sub:
            await take(sub, 1)
        assert await talker.wait_values("gone") == ["/ours"]
        async with node.subscribe(topic, STRING) as sub:
            await take(sub, 1)
        await talker.wait_values("gone", 2)


async def test_header_sequence_of_our_publisher(under_rosmaster: World) -> None:
    world = under_rosmaster
    topic = world.unique("joints")
    async with (
        world.node("ours") as node,
        node.advertise(topic, "sensor_msgs/JointState") as pub,
    ):
        listener = world.roscpp("listener", topic, "sensor_msgs/JointState")
        await pub.wait_for_subscribers(timeout=15)
        for i in range(5):
            message = pub.message(name=["shoulder", "elbow"], position=[0.5 * i, -1.25])
            message.header.frame_id = "arm"
            pub.publish(message)
        messages = await listener.wait_values("message", 5)
        seqs = [m["header"]["seq"] for m in messages]
        assert seqs == list(range(seqs[0], seqs[0] + 5))
        assert messages[3]["name"] == ["shoulder", "elbow"]
        assert messages[3]["position"] == [1.5, -1.25]
        assert messages[3]["header"]["frame_id"] == "arm"


async def test_header_sequence_of_roscpp(under_rosmaster: World) -> None:
    world = under_rosmaster
    topic = world.unique("joints")
    async with (
        world.node("ours") as node,
        node.subscribe(topic, "sensor_msgs/JointState") as sub,
    ):
        world.roscpp("talker", topic, "sensor_msgs/JointState", "5", "100", "0")
        messages = await take(sub, 5)
        seqs = [m.header.seq for m in messages]
        assert seqs == list(range(seqs[0], seqs[0] + 5))
        last = messages[-1]
        assert (last.header.stamp.secs, last.header.stamp.nsecs) == (1004, 500)
        assert last.header.frame_id == "arm"
        assert list(last.name) == ["shoulder", "elbow"]
        assert list(last.position) == [2.0, -1.25]
        assert list(last.velocity) == [1e-3]
        assert list(last.effort) == []


async def test_a_large_image_from_us(under_rosmaster: World) -> None:
    world = under_rosmaster
    topic = world.unique("image")
    data = bytes(k % 251 for k in range(1 << 20))
    async with world.node("ours") as node, node.advertise(topic, "sensor_msgs/Image") as pub:
        listener = world.roscpp("listener", topic, "sensor_msgs/Image")
        await pub.wait_for_subscribers(timeout=15)
        for _ in range(3):
            await pub.send(height=1024, width=1024, step=1024, encoding="mono8", data=data)
        messages = await listener.wait_values("message", 3)
        assert {(m["length"], m["sum"], m["encoding"]) for m in messages} == {
            (1 << 20, sum(data), "mono8")
        }


async def test_a_large_image_from_roscpp(under_rosmaster: World) -> None:
    world = under_rosmaster
    topic = world.unique("image")
    size = 1 << 20
    async with world.node("ours") as node, node.subscribe(topic, "sensor_msgs/Image") as sub:
        world.roscpp("talker", topic, "sensor_msgs/Image", "3", "20", "0")
        for i, message in enumerate(await take(sub, 3)):
            assert bytes(message.data) == bytes((k + i) % 251 for k in range(size))
            assert (message.height, message.encoding) == (1024, "mono8")


async def test_empty_messages_both_ways(under_rosmaster: World) -> None:
    world = under_rosmaster
    to_us, from_us = world.unique("to_us"), world.unique("from_us")
    async with (
        world.node("ours") as node,
        node.subscribe(to_us, "std_msgs/Empty") as sub,
        node.advertise(from_us, "std_msgs/Empty") as pub,
    ):
        world.roscpp("talker", to_us, "std_msgs/Empty", "3", "100", "0", "__name:=t")
        listener = world.roscpp("listener", from_us, "std_msgs/Empty", "__name:=l")
        assert [m._type for m in await take(sub, 3)] == ["std_msgs/Empty"] * 3
        await pub.wait_for_subscribers(timeout=15)
        for _ in range(3):
            pub.publish()
        assert await listener.wait_values("message", 3) == [{}, {}, {}]


async def test_nested_messages_both_ways(under_rosmaster: World) -> None:
    world = under_rosmaster
    cloud = "sensor_msgs/PointCloud"
    to_us, from_us = world.unique("to_us"), world.unique("from_us")
    async with (
        world.node("ours") as node,
        node.subscribe(to_us, cloud) as sub,
        node.advertise(from_us, cloud, latch=True) as pub,
    ):
        world.roscpp("talker", to_us, cloud, "2", "100", "0", "__name:=t")
        message = (await take(sub, 2))[1]
        assert [p.x for p in message.points] == [0.0, 1.5, 0.0]
        assert [c.name for c in message.channels] == ["intensity", ""]
        assert [list(c.values) for c in message.channels] == [[], [0.25, 1.0]]
        pub.publish(message)
        listener = world.roscpp("listener", from_us, cloud, "__name:=l")
        (heard,) = await listener.wait_values("message")
        assert heard["header"]["frame_id"] == "laser"
        assert heard["points"] == [[0, 0, 0], [1.5, 0, 0], [0, 0, 0]]
        assert heard["channels"] == [
            {"name": "intensity", "values": []},
            {"name": "", "values": [0.25, 1]},
        ]


async def test_our_latched_message_reaches_a_late_listener(under_each: World) -> None:
    world = under_each
    topic = world.unique("latched")
    async with world.node("ours") as node, node.advertise(topic, STRING, latch=True) as pub:
        pub.publish(data="first")
        pub.publish(data="last")
        listener = world.roscpp("listener", topic, STRING)
        assert await listener.wait_values("message") == [{"data": "last"}]
        assert await listener.wait_values("latching") == ["1"]


async def test_several_latched_publishers_of_one_roscpp_node(under_rosmaster: World) -> None:
    """They share one connection; a late subscriber gets the last message of each."""
    world = under_rosmaster
    topic = world.unique("latched")
    await world.roscpp_ready("latches", topic, "3")
    async with world.node("ours") as node, node.subscribe(topic, STRING) as sub:
        messages = await take(sub, 3)
        assert {m.data for m in messages} == {"number 0", "number 1", "number 2"}
        assert sub.publisher_count == 1
        # Another subscriber of the same node shares that connection, and is late, too.
        async with node.subscribe(topic, STRING) as second:
            (message,) = await take(second, 1)
            assert message.data in {"number 0", "number 1", "number 2"}


async def test_several_latched_publishers_of_one_node_of_ours(under_rosmaster: World) -> None:
    world = under_rosmaster
    topic = world.unique("latched")
    async with (
        world.node("ours") as node,
        node.advertise(topic, STRING, latch=True) as first,
        node.advertise(topic, STRING, latch=True) as second,
    ):
        first.publish(data="first")
        second.publish(data="second")
        listeners = [
            world.roscpp("listener", topic, STRING, "__name:=cpp"),
            world.rospy("listener", topic, STRING, "--name", "py"),
        ]
        for listener in listeners:
            messages = await listener.wait_values("message", 2)
            assert {m["data"] for m in messages} == {"first", "second"}


@pytest.mark.parametrize("type_name", ["sensor_msgs/JointState", "nav_msgs/Path"])
async def test_any_type_is_decoded_from_the_definition_of_roscpp(
    under_rosmaster: World, type_name: str
) -> None:
    world = under_rosmaster
    topic = world.unique("any")
    async with world.node("ours") as node, node.subscribe(topic) as sub:
        world.roscpp("talker", topic, type_name, "2", "100", "0")
        message = (await take(sub, 2))[1]
        assert message._type == type_name
        if type_name == "nav_msgs/Path":
            assert [p.pose.position.x for p in message.poses] == [1.0, 1.5, 2.0]
        else:
            assert list(message.position) == [0.5, -1.25]


async def test_raw_bytes_of_roscpp(under_rosmaster: World) -> None:
    import aioros1

    world = under_rosmaster
    topic = world.unique("raw")
    async with world.node("ours") as node, node.subscribe(topic, STRING, raw=True) as sub:
        world.roscpp("talker", topic, STRING, "1", "100", "0")
        (raw,) = await take(sub, 1)
        assert bytes(raw) == aioros1.load_msg(STRING)(data="number 0").to_bytes()


async def test_views_of_an_image_of_roscpp(under_rosmaster: World) -> None:
    world = under_rosmaster
    topic = world.unique("image")
    async with (
        world.node("ours") as node,
        node.subscribe(topic, "sensor_msgs/Image", views=True) as sub,
    ):
        world.roscpp("talker", topic, "sensor_msgs/Image", "3", "20", "0")
        messages = await take(sub, 3)
        # All of them are looked at after the last has come: none is overwritten.
        for i, message in enumerate(messages):
            assert bytes(message.data[:4]) == bytes((k + i) % 251 for k in range(4))
            assert len(message.data) == 1 << 20


async def test_a_dozen_of_each_on_one_topic(under_rosmaster: World) -> None:
    """Publishers and subscribers of all three libraries on one topic."""
    world = under_rosmaster
    topic = world.unique("crowd")
    async with (
        world.node("ours_a") as node_a,
        world.node("ours_b") as node_b,
        node_a.advertise(topic, STRING, queue_size=100) as pub,
        node_b.subscribe(topic, STRING, queue_size=1000) as sub,
    ):
        cpp = await world.roscpp_ready("listener", topic, STRING, "__name:=cpp_ear")
        py = await world.rospy_ready("listener", topic, STRING, "--name", "py_ear")
        await pub.wait_for_subscribers(3, timeout=15)
        await world.roscpp_ready("talker", topic, STRING, "0", "50", "1", "__name:=cpp_mouth")
        fields = world.fields(data="py")
        await world.rospy_ready("talker", topic, STRING, fields, "--latch", "--name", "py_mouth")
        await sub.wait_for_publishers(3, timeout=15)
        pub.publish(data="ours")
        heard: set[str] = set()
        while not {"ours", "py", "number"} <= heard:
            heard |= {m.data.split()[0] for m in await take(sub, 1)}
        for listener in (cpp, py):
            await until(
                lambda listener=listener: (
                    {m["data"].split()[0] for m in listener.values("message")}
                    >= {"ours", "py", "number"}
                ),
                what=lambda listener=listener: listener.report(),
            )
