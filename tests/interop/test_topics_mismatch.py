"""Types that do not fit: refused, and nobody else is disturbed."""

from __future__ import annotations

import pytest

from .ours import take
from .processes import until
from .world import World

STRING = "std_msgs/String"
OTHER = "std_msgs/Int32"


@pytest.mark.parametrize("client", ["rospy", "roscpp"])
async def test_our_subscriber_of_the_wrong_type(under_rosmaster: World, client: str) -> None:
    world = under_rosmaster
    topic = world.unique("chatter")
    if client == "rospy":
        talker = world.rospy("talker", topic, STRING, world.fields(data="x"))
    else:
        talker = world.roscpp("talker", topic, STRING, "0", "100", "0")
    await talker.wait_values("ready")
    async with (
        world.node("wrong") as wrong,
        world.node("right") as right,
        wrong.subscribe(topic, OTHER) as bad,
        right.subscribe(topic, STRING) as good,
    ):
        await take(good, 20)
        assert bad.publisher_count == 0
        assert wrong.is_open
        await take(good, 20)
        assert bad.queued == 0
        assert talker.code is None


async def test_the_refusal_of_a_publisher_is_logged_with_its_text(
    under_rosmaster: World, caplog: pytest.LogCaptureFixture
) -> None:
    world = under_rosmaster
    topic = world.unique("chatter")
    await world.rospy_ready("talker", topic, STRING, world.fields(data="x"))
    async with world.node("wrong") as node, node.subscribe(topic, OTHER):
        await until(
            lambda: any(
                topic in record.getMessage() and "do not match" in record.getMessage()
                for record in caplog.records
            ),
            what=lambda: f"a log of the refusal: {caplog.text}",
        )


async def refused(node_name: str, caplog: pytest.LogCaptureFixture) -> None:
    """Wait until our publisher has logged that it refused that node."""
    await until(
        lambda: any(
            node_name in record.getMessage() and "md5sum" in record.getMessage()
            for record in caplog.records
        ),
        what=lambda: f"a log of the refusal: {caplog.text}",
    )


async def test_a_rospy_listener_of_the_wrong_type(
    under_each: World, caplog: pytest.LogCaptureFixture
) -> None:
    world = under_each
    topic = world.unique("chatter")
    async with world.node("ours") as node, node.advertise(topic, STRING) as pub:
        good = await world.rospy_ready("listener", topic, STRING, "--name", "good")
        await pub.wait_for_subscribers(timeout=15)
        bad = await world.rospy_ready("listener", topic, OTHER, "--name", "bad")
        await refused("/bad", caplog)
        pub.publish(data="still here")
        assert await good.wait_values("message") == [{"data": "still here"}]
        assert bad.values("message") == []
        assert pub.subscriber_count == 1
        assert node.is_open


async def test_a_roscpp_listener_of_the_wrong_type(
    under_each: World, caplog: pytest.LogCaptureFixture
) -> None:
    world = under_each
    topic = world.unique("chatter")
    async with world.node("ours") as node, node.advertise(topic, STRING) as pub:
        good = await world.roscpp_ready("listener", topic, STRING, "__name:=good")
        await pub.wait_for_subscribers(timeout=15)
        bad = await world.roscpp_ready("listener", topic, OTHER, "__name:=bad")
        await refused("/bad", caplog)
        pub.publish(data="still here")
        assert await good.wait_values("message") == [{"data": "still here"}]
        assert bad.values("message") == []
        assert pub.subscriber_count == 1


@pytest.mark.parametrize("client", ["rospy", "roscpp"])
async def test_two_types_on_one_topic(under_rosmaster: World, client: str) -> None:
    """A publisher of another type beside ours: each listener hears its own."""
    world = under_rosmaster
    topic = world.unique("mixed")
    if client == "rospy":
        world.rospy("talker", topic, OTHER, world.fields(data=7), "--latch", "--count", "1")
    else:
        world.roscpp("talker", topic, OTHER, "1", "50", "1")
    async with (
        world.node("ours") as node,
        world.node("reader") as reader,
        node.advertise(topic, STRING, latch=True) as pub,
        reader.subscribe(topic, STRING) as strings,
    ):
        pub.publish(data="ours")
        (message,) = await take(strings, 1)
        assert message.data == "ours"
        await until(lambda: _two_publishers(world, topic), what="both publishers to be registered")
        pub.publish(data="ours again")
        (message,) = await take(strings, 1)
        assert message.data == "ours again"
        assert strings.publisher_count == 1


async def _two_publishers(world: World, topic: str) -> bool:
    return len(await world.who("publishers", topic)) == 2
