"""The rostopic tool, and topic_tools, with our nodes."""

from __future__ import annotations

import asyncio
import re
from typing import TYPE_CHECKING, Any

import pytest

from .ours import take, take_until
from .processes import Process, until
from .world import World

if TYPE_CHECKING:
    import aioros1

STRING = "std_msgs/String"


async def test_list_type_and_find(under_each: World) -> None:
    world = under_each
    topic, heard = world.unique("chatter"), world.unique("heard")
    async with (
        world.node("ours") as node,
        node.advertise(topic, STRING),
        node.subscribe(heard, "std_msgs/Int32"),
    ):
        listed = (await world.run("rostopic", "list")).stdout.split()
        assert topic in listed
        assert heard in listed
        published = (await world.run("rostopic", "list", "-p")).stdout.split()
        assert topic in published
        assert heard not in published
        assert (await world.run("rostopic", "type", topic)).stdout.strip() == STRING
        assert topic in (await world.run("rostopic", "find", STRING)).stdout.split()


async def test_info(under_each: World) -> None:
    world = under_each
    topic = world.unique("chatter")
    async with (
        world.node("ours") as node,
        world.node("other") as other,
        node.advertise(topic, STRING),
        other.subscribe(topic, STRING),
    ):
        text = (await world.run("rostopic", "info", topic)).stdout
        assert re.search(rf"Type: {STRING}", text)
        publishers, subscribers = text.split("Subscribers:")
        assert f"* /ours ({node.uri}" in publishers
        assert f"* /other ({other.uri}" in subscribers


@pytest.mark.parametrize(
    ("type_name", "fields", "expected"),
    [
        (STRING, {"data": "hi"}, 'data: "hi"'),
        (
            "sensor_msgs/JointState",
            {"name": ["a", "b"], "position": [0.5, -1.0]},
            "position: [0.5, -1.0]",
        ),
        ("geometry_msgs/PoseArray", {"poses": [{"position": {"x": 1.5}}]}, "x: 1.5"),
        ("std_msgs/ColorRGBA", {"r": 0.25}, "r: 0.25"),
        ("std_msgs/Time", {"data": {"secs": 5, "nsecs": 6}}, "nsecs:"),
    ],
    ids=lambda value: value if isinstance(value, str) and "/" in value else "",
)
async def test_echo(
    under_rosmaster: World, type_name: str, fields: dict[str, object], expected: str
) -> None:
    """rostopic takes the type from the master, and our definition for the header."""
    import aioros1

    world = under_rosmaster
    topic = world.unique("echo")
    async with world.node("ours") as node, node.advertise(topic, type_name, latch=True) as pub:
        pub.publish(aioros1.load_msg(type_name).from_dict(fields))
        result = await world.run("rostopic", "echo", "-n", "1", topic)
        assert expected in result.stdout
        assert result.stdout.rstrip().endswith("---")


async def test_echo_under_our_master(under_ours: World) -> None:
    world = under_ours
    topic = world.unique("echo")
    async with world.node("ours") as node, node.advertise(topic, STRING, latch=True) as pub:
        pub.publish(data="hi")
        assert 'data: "hi"' in (await world.run("rostopic", "echo", "-n", "1", topic)).stdout
        # A part of the message only.
        result = await world.run("rostopic", "echo", "-n", "1", f"{topic}/data")
        assert result.stdout.split() == ['"hi"', "---"]


async def test_pub(under_each: World) -> None:
    world = under_each
    topic = world.unique("pub")
    async with world.node("ours") as node, node.subscribe(topic, STRING) as sub:
        tool = world.start("rostopic", "pub", "-r", "20", topic, STRING, "data: hi")
        messages = await take(sub, 3)
        assert [m.data for m in messages] == ["hi"] * 3
        await tool.end()
        await until(lambda: sub.publisher_count == 0, what="the tool to be gone")


async def test_latched_pub_of_a_nested_type(under_rosmaster: World) -> None:
    world = under_rosmaster
    topic = world.unique("pub")
    value = "{header: {frame_id: map}, pose: {position: {x: 1.5}, orientation: {w: 1.0}}}"
    world.start("rostopic", "pub", "-l", topic, "geometry_msgs/PoseStamped", value)
    async with world.node("ours") as node:
        message = await node.wait_for_message(topic, "geometry_msgs/PoseStamped", timeout=15)
        assert message.header.frame_id == "map"
        assert message.pose.position.x == 1.5


async def test_hz(under_each: World) -> None:
    world = under_each
    topic = world.unique("hz")
    async with world.node("ours") as node, node.advertise(topic, STRING) as pub:
        tool = world.start("rostopic", "hz", topic)
        rate = await publish_until(tool, r"average rate: ([0-9.]+)", node, pub, "x")
        assert 30 < float(rate[1]) < 60


async def test_bw(under_rosmaster: World) -> None:
    world = under_rosmaster
    topic = world.unique("bw")
    async with world.node("ours") as node, node.advertise(topic, STRING) as pub:
        tool = world.start("rostopic", "bw", topic)
        mean = await publish_until(tool, r"mean: ([0-9.]+K?B)", node, pub, "x" * 996)
        # The characters, and the four bytes before them that tell their number.
        assert mean[1] == "1.00KB"


async def publish_until(
    tool: Process, pattern: str, node: aioros1.Node, pub: aioros1.Publisher[Any], text: str
) -> re.Match[str]:
    """Publish 50 times a second until the tool has written ``pattern``."""
    await pub.wait_for_subscribers(timeout=15)
    async with asyncio.timeout(20):
        async for _ in node.rate(50):
            pub.publish(data=text)
            match = re.search(pattern, tool.stdout)
            if match:
                return match
            assert tool.code is None, tool.report()
    raise AssertionError(tool.report())


async def test_relay(under_each: World) -> None:
    """It learns our type from our connection header and offers it on."""
    world = under_each
    source, sink = world.unique("source"), world.unique("sink")
    async with (
        world.node("ours") as node,
        world.node("reader") as reader,
        node.advertise(source, "sensor_msgs/JointState", latch=True) as pub,
        reader.subscribe(sink, "*") as anything,
        reader.subscribe(sink, "sensor_msgs/JointState") as typed,
    ):
        world.start("/usr/lib/topic_tools/relay", source, sink)
        await pub.wait_for_subscribers(timeout=15)
        pub.publish(name=["a"], position=[0.5])
        await typed.wait_for_publishers(timeout=15)
        for sub in (anything, typed):
            # The relay has no message for those who come after the first one went by.
            pub.publish(name=["a"], position=[0.5])
            message = (await take_until(sub, lambda m: list(m.name) == ["a"]))[-1]
            assert message._type == "sensor_msgs/JointState"
            assert list(message.position) == [0.5]


async def test_throttle(under_rosmaster: World) -> None:
    world = under_rosmaster
    source, sink = world.unique("source"), world.unique("sink")
    async with (
        world.node("ours") as node,
        node.advertise(source, STRING) as pub,
        node.subscribe(sink) as sub,
    ):
        world.start("/usr/lib/topic_tools/throttle", "messages", source, "20", sink)
        await pub.wait_for_subscribers(timeout=15)
        sent = 0
        async with asyncio.timeout(15):
            async for _ in node.rate(200):
                pub.publish(data=f"number {sent}")
                sent += 1
                if sub.queued >= 5:
                    break
        messages = await take(sub, 5)
        numbers = [int(m.data.split()[1]) for m in messages]
        assert numbers == sorted(set(numbers))
        assert numbers[4] - numbers[0] > 8
