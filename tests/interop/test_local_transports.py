"""Nodes of ours that offer more than TCPROS, among programs that know nothing of it."""

from __future__ import annotations

from aioros1.net import local_transports as local
from aioros1.xmlrpc.client import XmlRpcClient

from .ours import take
from .processes import until
from .world import World

STRING = "std_msgs/String"
BOTH = ("intraprocess", "unix")


async def test_rospy_hears_us_and_is_heard(under_each: World) -> None:
    world = under_each
    topic, back = world.unique("chatter"), world.unique("back")
    async with (
        world.node("ours", local_transports=BOTH) as node,
        node.advertise(topic, STRING, queue_size=100) as pub,
        node.subscribe(back, STRING, queue_size=100) as sub,
    ):
        listener = world.rospy("listener", topic, STRING)
        world.rospy(
            "talker", back, STRING, world.fields(data="number $i"), "--count", "20", "--rate", "200"
        )
        await pub.wait_for_subscribers(timeout=15)
        for i in range(20):
            pub.publish(data=f"number {i}")
        values = await listener.wait_values("message", 20)
        assert [each["data"] for each in values] == [f"number {i}" for i in range(20)]
        assert [each.data for each in await take(sub, 20)] == [f"number {i}" for i in range(20)]
        assert {info.transport for info in node.connections} == {"TCPROS"}


async def test_roscpp_hears_us_and_is_heard(under_each: World) -> None:
    world = under_each
    topic, back = world.unique("chatter"), world.unique("back")
    async with (
        world.node("ours", local_transports=BOTH) as node,
        node.advertise(topic, STRING, queue_size=100) as pub,
        node.subscribe(back, STRING, queue_size=100) as sub,
    ):
        listener = world.roscpp("listener", topic, STRING)
        world.roscpp("talker", back, STRING, "20", "200", "0", "__name:=t")
        await pub.wait_for_subscribers(timeout=15)
        for i in range(20):
            pub.publish(data=f"number {i}")
        values = await listener.wait_values("message", 20)
        assert [each["data"] for each in values] == [f"number {i}" for i in range(20)]
        assert len(await take(sub, 20)) == 20
        assert {info.transport for info in node.connections} == {"TCPROS"}


async def test_rospy_and_roscpp_pass_over_what_else_they_are_asked_for(
    under_rosmaster: World,
) -> None:
    world = under_rosmaster
    topics = [world.unique("rospy"), world.unique("roscpp")]
    await world.rospy_ready("talker", topics[0], STRING, world.fields(data="x"))
    await world.roscpp_ready("talker", topics[1], STRING, "0", "10", "0")
    client = XmlRpcClient()
    extra = [["INTRAPROCESS", "0" * 32], *local.LocalTransports(("unix",), None).offers()]
    try:
        for topic in topics:
            [talker] = await world.who("publishers", topic)
            uri = await world.ask("lookupNode", talker)
            for protocols in ([["TCPROS"], *extra], [*extra, ["TCPROS"]]):
                code, _, value = await client.call(
                    uri, "requestTopic", "/interop_test", topic, protocols
                )
                assert (code, value[0]) == (1, "TCPROS")
            # Alone, it is refused and nothing breaks.
            code, _, _ = await client.call(uri, "requestTopic", "/interop_test", topic, extra)
            assert code == 0
    finally:
        await client.close()


async def test_rosnode_shows_every_kind_of_connection(under_each: World) -> None:
    world = under_each
    topics = {kind: world.unique(kind.lower()) for kind in ("TCPROS", "UNIXROS", "INTRAPROCESS")}
    async with (
        world.node("ours", local_transports=BOTH) as node,
        world.node("unix", local_transports=("unix",)) as by_unix,
        world.node("same", local_transports=BOTH) as same,
        node.advertise(topics["TCPROS"], STRING) as pub,
        node.advertise(topics["UNIXROS"], STRING) as unix_pub,
        by_unix.subscribe(topics["UNIXROS"], STRING),
        node.subscribe(topics["INTRAPROCESS"], STRING) as sub,
        same.advertise(topics["INTRAPROCESS"], STRING),
    ):
        await world.rospy_ready("listener", topics["TCPROS"], STRING)
        await pub.wait_for_subscribers(timeout=15)
        await unix_pub.wait_for_subscribers(timeout=15)
        await sub.wait_for_publishers(timeout=15)
        text = (await world.run("rosnode", "info", "/ours")).stdout
        rows = text.split("Connections:")[1].split(" * topic: ")
        found = {row.split("\n")[0]: row for row in rows[1:]}
        for kind, topic in topics.items():
            assert f"* transport: {kind}" in found[topic], text
        assert "* to: /unix" in found[topics["UNIXROS"]]
        assert "direction: outbound\n" in found[topics["UNIXROS"]]
        assert "* to: /same" in found[topics["INTRAPROCESS"]]
        assert "direction: inbound\n" in found[topics["INTRAPROCESS"]]


async def test_rostopic_hears_a_node_that_serves_its_own_kind_otherwise(under_each: World) -> None:
    world = under_each
    topic = world.unique("chatter")
    async with (
        world.node("ours", local_transports=BOTH) as node,
        world.node("same", local_transports=BOTH) as same,
        node.advertise(topic, STRING, latch=True) as pub,
        same.subscribe(topic, STRING) as sub,
    ):
        pub.publish(data="for all")
        assert (await take(sub, 1))[0].data == "for all"
        text = (await world.run("rostopic", "echo", "-n", "1", topic)).stdout
        assert "for all" in text
        await until(lambda: pub.subscriber_count == 1, what="rostopic to be gone")
        assert [info.transport for info in pub.connections] == ["INTRAPROCESS"]
