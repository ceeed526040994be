"""Publishing again and again."""

from __future__ import annotations

import asyncio
import gc

import pytest

import aioros1
from aioros1.msg.geometry_msgs import PointStamped
from aioros1.msg.std_msgs import Int32, String


async def take(sub, count):
    return [await sub.get(timeout=30) for _ in range(count)]


async def test_the_same_message_as_it_is_at_each_moment(make_node):
    node = await make_node("node")
    async with (
        node.advertise("point", PointStamped) as pub,
        node.subscribe("point", PointStamped) as sub,
    ):
        await pub.wait_for_subscribers(timeout=30)
        message = PointStamped()
        timer = pub.publish_every(0.01, message)
        first, second = await take(sub, 2)
        assert (first.header.seq, second.header.seq) == (1, 2)
        message.point.x = 5.0
        async with asyncio.timeout(30):
            while (await sub.get()).point.x != 5.0:
                pass
        timer.cancel()


@pytest.mark.parametrize("kind", ["function", "coroutine"])
async def test_what_a_function_gives(make_node, kind):
    node = await make_node("node")
    numbers = iter(range(100))

    def make(now):
        number = next(numbers)
        assert isinstance(now, aioros1.Time)
        return None if number % 2 else Int32(number)

    async def make_slowly(now):
        await asyncio.sleep(0)
        return make(now)

    async with node.advertise("number", Int32) as pub, node.subscribe("number", Int32) as sub:
        await pub.wait_for_subscribers(timeout=30)
        timer = pub.publish_every(0.005, make if kind == "function" else make_slowly)
        assert [message.data for message in await take(sub, 3)] == [0, 2, 4]
        timer.cancel()


async def test_fields(make_node):
    node = await make_node("node")
    async with node.advertise("chatter", String) as pub, node.subscribe("chatter", String) as sub:
        await pub.wait_for_subscribers(timeout=30)
        pub.publish_every(0.01, data="again")
        assert [message.data for message in await take(sub, 2)] == ["again", "again"]


async def test_it_ends_with_the_publisher(make_node):
    node = await make_node("node")
    tasks = asyncio.all_tasks()
    async with node.advertise("chatter", String) as pub:
        pub.publish_every(1000, data="later")
        assert asyncio.all_tasks() - tasks
    await asyncio.sleep(0)
    assert not [task for task in asyncio.all_tasks() - tasks if "timer" in task.get_name()]
    assert node.is_open


async def test_it_ends_with_the_publisher_though_nobody_keeps_the_timer(make_node):
    node = await make_node("node")
    pub = await node.advertise("chatter", String)
    pub.publish_every(1000, data="later")
    gc.collect()
    assert [task for task in asyncio.all_tasks() if "timer" in task.get_name()]
    await pub.close()
    await asyncio.sleep(0)
    assert not [task for task in asyncio.all_tasks() if "timer" in task.get_name()]


async def test_it_waits_for_room_where_nothing_may_be_dropped(make_node):
    talker, listener = await make_node("talker"), await make_node("listener")
    options = {"queue_size": 1, "overflow": "block"}
    async with (
        talker.advertise("chatter", String, **options) as pub,
        listener.subscribe("chatter", String, **options) as sub,
    ):
        await pub.wait_for_subscribers(timeout=30)
        numbers = iter(range(1000))
        text = "x" * 1_000_000
        pub.publish_every(0.001, lambda now: String(f"{next(numbers)} {text}"))
        with pytest.raises(asyncio.QueueFull):
            while True:  # until the sockets are full
                pub.publish(data="in between")
                await asyncio.sleep(0.001)
        got = []
        while len(got) < 20:
            message = await sub.get(timeout=30)
            if message.data != "in between":
                got.append(int(message.data.split()[0]))
        assert got == list(range(20))


async def test_bad_input(make_node):
    node = await make_node("node")
    async with node.advertise("number", Int32) as pub:
        with pytest.raises(ValueError, match="the period of a timer must be positive, got 0"):
            pub.publish_every(0, data=1)
        with pytest.raises(aioros1.SerializationError, match="data"):
            pub.publish_every(1, data="no number")
    with pytest.raises(aioros1.ClosedError):
        pub.publish_every(1, data=1)
