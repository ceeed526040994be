"""The first message that a role drops is a warning; all of them are counted."""

from __future__ import annotations

import asyncio
import logging

import pytest

import aioros1
from aioros1.msg.std_msgs import String, UInt8MultiArray

BIG = bytes(100_000)


def drops(caplog):
    return [
        record.getMessage()
        for record in caplog.records
        if record.levelno == logging.WARNING
        and ("dropped" in record.getMessage() or "messages (queue" in record.getMessage())
    ]


async def until(predicate):
    async with asyncio.timeout(30):
        while not predicate():
            await asyncio.sleep(0.002)


@pytest.mark.parametrize("overflow", ["drop_oldest", "drop_newest"])
@pytest.mark.parametrize("size", [1, 10])
async def test_a_subscriber(make_node, caplog, overflow, size):
    talker, listener = await make_node("talker"), await make_node("listener")
    async with (
        talker.advertise("chatter", String) as pub,
        listener.subscribe("chatter", String, overflow=overflow, queue_size=size) as sub,
    ):
        await pub.wait_for_subscribers(timeout=30)
        for _ in range(3):
            for number in range(100):
                await pub.send(data=str(number))
            await pub.drain(timeout=30)
        await until(lambda: sub.stats.messages == 300)
        assert sub.dropped == 300 - size
        assert pub.dropped == 0
        (text,) = drops(caplog)
        for words in ("subscriber /chatter", f"queue_size={size}", f"'{overflow}'", '"block"'):
            assert words in text


async def test_each_subscriber_says_so_once(make_node, caplog):
    talker, listener = await make_node("talker"), await make_node("listener")
    async with (
        talker.advertise("chatter", String) as pub,
        listener.subscribe("chatter", String, queue_size=1) as one,
        listener.subscribe("chatter", String, queue_size=2) as two,
        listener.subscribe("chatter", String, queue_size=200) as enough,
    ):
        await pub.wait_for_subscribers(timeout=30)
        for number in range(100):
            pub.publish(data=str(number))
        await until(lambda: enough.queued == 100)
        assert (one.dropped, two.dropped, enough.dropped) == (99, 98, 0)
        assert len(drops(caplog)) == 2


@pytest.mark.parametrize("overflow", ["drop_oldest", "drop_newest"])
async def test_a_publisher(make_node, caplog, overflow):
    talker, listener = await make_node("talker"), await make_node("listener")
    async with (
        talker.advertise("big", UInt8MultiArray, overflow=overflow, queue_size=3) as pub,
        listener.subscribe("big", UInt8MultiArray, overflow="block", queue_size=1) as sub,
    ):
        await pub.wait_for_subscribers(timeout=30)
        async with asyncio.timeout(30):
            while pub.dropped < 5:
                pub.publish(data=BIG)
                await asyncio.sleep(0)
        (text,) = drops(caplog)
        for words in ("publisher /big", "for /listener", " 3 ", f"'{overflow}'", "`await send()`"):
            assert words in text
        assert sub.dropped == 0


async def test_a_publisher_that_waits_drops_nothing_and_says_nothing(make_node, caplog):
    talker, listener = await make_node("talker"), await make_node("listener")
    async with (
        talker.advertise("big", UInt8MultiArray, queue_size=2) as pub,
        listener.subscribe("big", UInt8MultiArray, overflow="block", queue_size=1) as sub,
    ):
        await pub.wait_for_subscribers(timeout=30)

        async def receive():
            for _ in range(100):
                await sub.get(timeout=30)

        async with asyncio.TaskGroup() as group:
            group.create_task(receive())
            for _ in range(100):
                await pub.send(data=BIG, timeout=30)
        assert (pub.dropped, sub.dropped) == (0, 0)
        assert drops(caplog) == []


@pytest.mark.parametrize("end", ["stall", "gone"])
async def test_what_waits_for_a_subscriber_is_lost_with_its_connection(make_node, caplog, end):
    stall = 0.2 if end == "stall" else 30.0
    talker = await make_node("talker", timeouts=aioros1.Timeouts(stall=stall))
    listener = await make_node("listener")
    async with (
        talker.advertise("big", UInt8MultiArray, overflow="block", queue_size=10) as pub,
        listener.subscribe("big", UInt8MultiArray, overflow="block", queue_size=1),
    ):
        await pub.wait_for_subscribers(timeout=30)
        with pytest.raises((asyncio.QueueFull, aioros1.ClosedError)):
            async with asyncio.timeout(30):
                while True:
                    pub.publish(data=BIG)
                    await asyncio.sleep(0)
        if end == "gone":
            listener.abort()
        await until(lambda: pub.dropped)
        (text,) = drops(caplog)
        for words in ("publisher /big", "/listener", "10 of its messages", "queue_size=10"):
            assert words in text
        assert pub.dropped == 10


async def test_what_the_node_does_for_itself_warns_of_nothing(make_node, caplog):
    talker, listener = await make_node("talker"), await make_node("listener")
    async with talker.advertise("chatter", String, latch=True) as pub:
        pub.publish(data="first")
        async with listener.subscribe("chatter", String) as sub:
            await sub.get(timeout=30)
            waiting = asyncio.ensure_future(
                listener.wait_for_message("chatter", String, timeout=30)
            )
            for number in range(50):
                pub.publish(data=str(number))
                await sub.get(timeout=30)
            await waiting
    assert drops(caplog) == []


async def test_a_follower_of_a_parameter(make_node, caplog):
    node = await make_node("node")
    async with node.subscribe_param("/gain", default=0) as followed:
        for number in range(1005):
            node._params.announced("/gain", number + 1)
        assert followed.stats.dropped == 5
        assert followed.value == 1005
    assert len(drops(caplog)) == 1
    assert "/gain" in drops(caplog)[0]
