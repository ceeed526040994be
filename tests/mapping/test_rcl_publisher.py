"""rcl/publisher.h: publishers."""

from __future__ import annotations

import asyncio
import dataclasses

import pytest

import aioros1
from aioros1.msg.std_msgs import Header, Int32, String
from aioros1.topics.publisher import PublisherOptions


@pytest.fixture
async def node(make_node):
    return await make_node("talker")


async def test_rcl_publisher_t(node):
    async with node.advertise("chatter", String) as pub:
        assert isinstance(pub, aioros1.Publisher)
        assert repr(pub) == "<Publisher /chatter [std_msgs/String] of /talker, open>"


async def test_rcl_publisher_options_t(node):
    options = {
        "latch": True,
        "queue_size": 3,
        "overflow": "drop_newest",
        "tcp_nodelay": True,
        "headers": {"origin": "test"},
    }
    async with node.advertise("chatter", String, **options) as pub:
        assert pub.options == PublisherOptions(**options)
        with pytest.raises(dataclasses.FrozenInstanceError):
            pub.options.latch = False


async def test_rcl_get_zero_initialized_publisher(node):
    """A publisher on its way is not open yet, and the master does not know of it."""
    opening = node.advertise("chatter", String)
    assert node.roles == ()
    assert "/chatter" not in (await node.graph.snapshot()).publishers
    async with opening as pub:
        assert pub.is_open
        assert "/chatter" in (await node.graph.snapshot()).publishers


@pytest.mark.parametrize("type", [String, "std_msgs/String"], ids=["class", "name"])
async def test_rcl_publisher_init(node, type):
    async with node.advertise("chatter", type) as pub:
        assert (pub.type, pub.message_class) == ("std_msgs/String", String)


async def test_rcl_publisher_init_that_fails(node):
    with pytest.raises(aioros1.InvalidNameError):
        await node.advertise("not a name", String)
    with pytest.raises(aioros1.MessageNotFoundError):
        await node.advertise("chatter", "std_msgs/Nothing")
    with pytest.raises(ValueError, match="queue_size"):
        node.advertise("chatter", String, queue_size=0)
    async with node.advertise("chatter", String):
        with pytest.raises(aioros1.Md5MismatchError):
            await node.advertise("chatter", Int32)
    assert node.roles == ()


async def test_rcl_publisher_fini(node):
    pub = await node.advertise("chatter", String)
    await pub.close()
    await pub.close()
    for publish in (lambda: pub.publish(data="late"), lambda: pub.publish_raw(b"\0\0\0\0")):
        with pytest.raises(aioros1.ClosedError):
            publish()
    assert "/chatter" not in (await node.graph.snapshot()).publishers


async def test_rcl_publisher_fini_leaves_another_on_the_topic_alone(node):
    first = await node.advertise("chatter", String)
    second = await node.advertise("chatter", String)
    await first.close()
    assert "/chatter" in (await node.graph.snapshot()).publishers
    second.publish(data="still here")
    await second.close()
    assert "/chatter" not in (await node.graph.snapshot()).publishers


async def test_rcl_publisher_get_default_options(node):
    async with node.advertise("chatter", String) as pub:
        assert pub.options == PublisherOptions()
        assert pub.options == PublisherOptions(
            latch=False,
            queue_size=10,
            overflow="drop_oldest",
            tcp_nodelay=False,
            headers=None,
        )


async def test_rcl_publish(node):
    async with node.advertise("chatter", String) as pub, node.subscribe("chatter") as sub:
        await pub.wait_for_subscribers(timeout=30)
        pub.publish(String(data="a message"))
        pub.publish(data="fields")
        pub.publish({"data": "a dict"})
        heard = [(await sub.get(timeout=30)).data for _ in range(3)]
        assert heard == ["a message", "fields", "a dict"]


async def test_rcl_publish_of_what_does_not_fit(node):
    """Undefined in rcl; refused here, and nobody gets anything."""
    async with node.advertise("count", Int32) as pub:
        with pytest.raises(aioros1.SerializationError, match=r"^data: "):
            pub.publish(data="five")
        with pytest.raises(aioros1.SerializationError, match=r"^data: "):
            pub.publish(data=2**31)
        with pytest.raises(aioros1.SerializationError):
            pub.publish(String())
        assert pub.stats.messages == 0


async def test_rcl_publish_to_several_subscribers(node, make_node):
    others = [await make_node(f"listener{number}") for number in range(3)]
    subs = [await other.subscribe("chatter", String) for other in others]
    async with node.advertise("chatter", String) as pub:
        await pub.wait_for_subscribers(3, timeout=30)
        pub.publish(data="hi")
        assert [(await sub.get(timeout=30)).data for sub in subs] == ["hi"] * 3
        assert pub.stats.messages == 1


@pytest.mark.parametrize("kind", [bytes, bytearray, memoryview])
async def test_rcl_publish_serialized_message(node, kind):
    message = Header(frame_id="map")
    async with node.advertise("header", Header) as pub, node.subscribe("header") as sub:
        await pub.wait_for_subscribers(timeout=30)
        pub.publish_raw(kind(message.to_bytes()))
        assert await sub.get(timeout=30) == message


async def test_rcl_publish_serialized_message_of_another_node(node, make_node):
    """A relay: what was received is passed on without being looked into."""
    listener = await make_node("listener")
    async with (
        node.advertise("chatter", String) as source,
        node.subscribe("chatter", String, raw=True) as relay_in,
        node.advertise("relayed", String) as relay_out,
        listener.subscribe("relayed", String) as sub,
    ):
        await source.wait_for_subscribers(timeout=30)
        await relay_out.wait_for_subscribers(timeout=30)
        source.publish(data="hi")
        relay_out.publish_raw(await relay_in.get(timeout=30))
        assert (await sub.get(timeout=30)).data == "hi"


async def test_rcl_publisher_assert_liveliness_is_what_subscribers_notice(node, make_node):
    """ROS 1 has no leases: that a publisher is gone is seen by its connection."""
    listener = await make_node("listener")
    async with listener.subscribe("chatter", String) as sub, asyncio.timeout(30):
        pub = await node.advertise("chatter", String)
        await sub.wait_for_publishers()
        events = listener.events()
        await pub.close()
        event = await anext(events)
        assert isinstance(event, aioros1.PeerDisconnected)
        assert (event.name, sub.publisher_count) == ("/chatter", 0)


async def test_rcl_publisher_get_topic_name(make_node):
    node = await make_node("talker", namespace="robot", remap={"chatter": "speech"})
    async with node.advertise("chatter", String) as remapped, node.advertise("~x", String) as own:
        assert (remapped.name, own.name) == ("/robot/speech", "/robot/talker/x")


async def test_rcl_publisher_get_options(node):
    async with node.advertise("chatter", String, queue_size=5) as pub:
        assert pub.options.queue_size == 5


async def test_rcl_publisher_get_rmw_handle(node, make_node):
    """What is below a publisher are its connections."""
    listener = await make_node("listener")
    async with node.advertise("chatter", String) as pub, listener.subscribe("chatter", String):
        await pub.wait_for_subscribers(timeout=30)
        [connection] = pub.connections
        assert (connection.peer, connection.direction) == ("/listener", "o")
        assert connection.transport == "TCPROS"
        assert connection.local[1] == node.tcpros_address[1]


async def test_rcl_publisher_get_context(node):
    async with node.advertise("chatter", String) as pub:
        assert pub.node is node


async def test_rcl_publisher_is_valid(node):
    pub = await node.advertise("chatter", String)
    assert pub.is_open
    await pub.close()
    assert not pub.is_open


async def test_rcl_publisher_is_valid_except_context(make_node):
    node = await make_node("other")
    pub = await node.advertise("chatter", String)
    await node.close()
    assert not pub.is_open


async def test_rcl_publisher_get_subscription_count(node, make_node):
    listener = await make_node("listener")
    async with node.advertise("chatter", String) as pub:
        assert pub.subscriber_count == 0
        with pytest.raises(TimeoutError):
            await pub.wait_for_subscribers(timeout=0.01)
        sub = await listener.subscribe("chatter", String)
        await pub.wait_for_subscribers(timeout=30)
        # Two of one node share a connection, and count once.
        second = await listener.subscribe("chatter", String)
        await sub.wait_for_publishers(timeout=30)
        assert pub.subscriber_count == 1
        events = node.events()
        await sub.close()
        await second.close()
        async with asyncio.timeout(30):
            assert isinstance(await anext(events), aioros1.PeerDisconnected)
        assert pub.subscriber_count == 0


async def test_rcl_publisher_get_actual_qos(node, tcpros):
    """Agreed on is what the publisher was opened with and what each subscriber asks for."""
    headers = {"origin": "test"}
    async with node.advertise("chatter", String, latch=True, headers=headers) as pub:
        fields = {"callerid": "/hand", "topic": "/chatter", "md5sum": "*", "tcp_nodelay": "1"}
        async with tcpros(node.tcpros_address, fields) as peer:
            await pub.wait_for_subscribers(timeout=30)
            assert (pub.options.latch, peer.header["latching"]) == (True, "1")
            assert peer.header["origin"] == "test"
            assert pub.connections[0].header["tcp_nodelay"] == "1"
