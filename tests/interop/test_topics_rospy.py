"""Topics between our nodes and rospy's: who hears whom, and when."""

from __future__ import annotations

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
        listener = world.rospy("listener", topic, STRING)
        await pub.wait_for_subscribers(timeout=15)
        for i in range(50):
            pub.publish(data=f"number {i} \N{SNOWMAN}")
        messages = await listener.wait_values("message", 50)
        assert [m["data"] for m in messages] == [f"number {i} \N{SNOWMAN}" for i in range(50)]
        assert set(listener.values("callerid")) == {"/ours"}
        assert set(listener.values("type")) == {STRING}
        assert pub.stats.messages == 50
        assert pub.dropped == 0


async def test_our_subscriber_hears_in_order(under_each: World) -> None:
    world = under_each
    topic = world.unique("chatter")
    fields = world.fields(data="number $i")
    async with (
        world.node("ours") as node,
        node.subscribe(topic, STRING, queue_size=100) as sub,
    ):
        talker = world.rospy("talker", topic, STRING, fields, "--count", "50", "--rate", "500")
        messages = await take(sub, 50)
        assert [m.data for m in messages] == [f"number {i}" for i in range(50)]
        assert sub.publisher_count == 1
        assert talker.values("subscriber") == [topic]


async def test_a_leaving_listener_is_noticed(under_each: World) -> None:
    world = under_each
    topic = world.unique("chatter")
    async with world.node("ours") as node, node.advertise(topic, STRING) as pub:
        listener = world.rospy("listener", topic, STRING)
        await pub.wait_for_subscribers(timeout=15)
        await listener.end()
        await until(lambda: pub.subscriber_count == 0, what="no subscriber to be left")
        pub.publish(data="to nobody")
        again = world.rospy("listener", topic, STRING)
        await pub.wait_for_subscribers(timeout=15)
        pub.publish(data="to the second")
        assert await again.wait_values("message") == [{"data": "to the second"}]


async def test_a_leaving_talker_is_noticed(under_each: World) -> None:
    world = under_each
    topic = world.unique("chatter")
    async with world.node("ours") as node, node.subscribe(topic, STRING) as sub:
        talker = world.rospy("talker", topic, STRING, world.fields(data="x"))
        await sub.wait_for_publishers(timeout=15)
        await take(sub, 1)
        await talker.end()
        await until(lambda: sub.publisher_count == 0, what="no publisher to be left")


async def test_our_unsubscribing_is_noticed(under_rosmaster: World) -> None:
    world = under_rosmaster
    topic = world.unique("chatter")
    talker = await world.rospy_ready("talker", topic, STRING, world.fields(data="x"))
    async with world.node("ours") as node:
        async with node.subscribe(topic, STRING) as sub:
            await take(sub, 1)
        await talker.wait_values("gone")
        assert await world.who("subscribers", topic) == set()
        # The next one gets a new connection.
        async with node.subscribe(topic, STRING) as sub:
            assert (await take(sub, 1))[0].data == "x"


async def test_our_latched_message_reaches_a_late_listener(under_each: World) -> None:
    world = under_each
    topic = world.unique("latched")
    async with (
        world.node("ours") as node,
        node.advertise(topic, STRING, latch=True) as pub,
    ):
        pub.publish(data="first")
        pub.publish(data="last")
        listener = world.rospy("listener", topic, STRING)
        assert await listener.wait_values("message") == [{"data": "last"}]
        assert listener.values("latching") == ["1"]


async def test_a_latched_message_of_rospy_reaches_us_late(under_each: World) -> None:
    world = under_each
    topic = world.unique("latched")
    fields = world.fields(data="number $i")
    talker = world.rospy("talker", topic, STRING, fields, "--latch", "--count", "1")
    await talker.wait_values("ready")
    await world.wait_who("publishers", topic, {"/rospy_talker"})
    async with world.node("ours") as node:
        for _ in range(2):
            async with node.subscribe(topic, STRING) as sub:
                event = await take(sub.events(), 1)
                assert event[0].message.data == "number 0"
                assert event[0].header["latching"] == "1"
                assert event[0].header["callerid"] == "/rospy_talker"
