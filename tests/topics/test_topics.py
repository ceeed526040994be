"""Publishers and subscribers of this library with one another."""

from __future__ import annotations

import asyncio

import pytest

import aioros1
from aioros1.msg.std_msgs import Int32, String


async def test_a_message_reaches_a_subscriber(make_node):
    node = await make_node()
    async with node.advertise("chatter", String) as pub, node.subscribe("chatter") as sub:
        await pub.wait_for_subscribers(timeout=30)
        pub.publish(data="hi")
        assert await sub.get(timeout=30) == String(data="hi")


async def test_blocked_publisher_raises_queue_full_and_send_waits(make_node):
    node = await make_node()
    async with (
        node.advertise("big", "std_msgs/UInt8MultiArray", overflow="block", queue_size=2) as pub,
        node.subscribe("big", overflow="block", queue_size=1) as sub,
    ):
        await pub.wait_for_subscribers(timeout=30)
        payload = bytes(1_000_000)
        sent = 0
        with pytest.raises(asyncio.QueueFull):
            while True:
                pub.publish(data=payload[: sent + 1000])
                sent += 1
                await asyncio.sleep(0)
        with pytest.raises(TimeoutError):
            await pub.send(data=payload, timeout=0.01)
        for length in range(sent):
            assert len((await sub.get(timeout=30)).data) == length + 1000
        await pub.send(data=b"last", timeout=30)
        assert (await sub.get(timeout=30)).data == b"last"


async def test_closed_roles_raise_closed_error(make_node):
    node = await make_node()
    pub = await node.advertise("chatter", String)
    await pub.close()
    with pytest.raises(aioros1.ClosedError):
        pub.publish(data="late")


async def test_a_message_may_be_given_by_keyword_unless_that_is_a_field(make_node):
    node = await make_node()
    async with (
        node.advertise("chatter", String) as pub,
        node.subscribe("chatter") as sub,
        node.advertise("log", "rosgraph_msgs/Log") as log,
        node.subscribe("log") as logged,
    ):
        await pub.wait_for_subscribers(timeout=30)
        await log.wait_for_subscribers(timeout=30)
        pub.publish(msg=String(data="whole"))
        assert (await sub.get(timeout=30)).data == "whole"
        log.publish(msg="a field")
        assert (await logged.get(timeout=30)).msg == "a field"
        with pytest.raises(TypeError, match="a message or fields, got both"):
            pub.publish(String(), data="x")


async def test_another_type_while_the_old_one_is_being_closed(make_node):
    """At whatever moment of the close: the master learns of the new type."""
    node = await make_node()
    for turns in range(12):
        pub = await node.advertise("t", String)
        closing = asyncio.create_task(pub.close())
        for _ in range(turns):
            await asyncio.sleep(0)
        if not turns:
            await asyncio.sleep(0)
        async with asyncio.timeout(20):
            other = await node.advertise("t", Int32)
            assert ("/t", "std_msgs/Int32") in await node.master.get_published_topics()
            await closing
            await other.close()
        assert not await node.master.get_published_topics()
