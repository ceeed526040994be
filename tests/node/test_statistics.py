"""``/statistics``: what came over each connection, for those who ask for it by a parameter."""

from __future__ import annotations

import asyncio
import tracemalloc
from typing import Any

import pytest

import aioros1
from aioros1.msg.geometry_msgs import PointStamped
from aioros1.msg.rosgraph_msgs import TopicStatistics
from aioros1.msg.std_msgs import String
from aioros1.time import Duration, Time

SECOND = Duration(1)


@pytest.fixture
async def watched(make_node, master):
    """A node that counts, with ``/clock`` in our hands, and the node that reads it."""
    teller = await make_node("teller", use_sim_time=False)
    await teller.set_param("/enable_statistics", True)
    node = await make_node("watched", use_sim_time=True)
    statistics = await teller.subscribe("/statistics", TopicStatistics)
    await statistics.wait_for_publishers(timeout=30)
    clock = await teller.advertise("/clock", "rosgraph_msgs/Clock")
    await clock.wait_for_subscribers(timeout=30)

    async def set_time(seconds: float) -> None:
        wanted = Time.from_sec(seconds)
        clock.publish(clock=wanted)
        async with asyncio.timeout(30):
            while node.now() != wanted:
                await asyncio.sleep(0.001)

    await set_time(1000)
    return node, statistics, set_time


async def deliver(
    pub: aioros1.Publisher[Any], sub: aioros1.Subscriber[Any], *messages: Any
) -> None:
    for message in messages:
        pub.publish(message)
        await sub.get(timeout=30)


async def test_periods_bytes_and_ages(watched, make_node):
    node, statistics, set_time = watched
    other = await make_node("other")
    async with (
        other.advertise("points", PointStamped) as pub,
        node.subscribe("points", PointStamped) as sub,
    ):
        await pub.wait_for_subscribers(timeout=30)
        # Before the last one, two did not come.
        for seq, now, age in (
            (1, 1000.0, 0.1),
            (2, 1000.25, 0.1),
            (3, 1000.75, 0.1),
            (6, 1001, 0.5),
        ):
            await set_time(now)
            message = PointStamped.from_dict(
                {"header": {"seq": seq, "stamp": Time.from_sec(now - age)}}
            )
            pub.publish_raw(message.to_bytes())
            await sub.get(timeout=30)
        got = await statistics.get(timeout=30)
    assert (got.topic, got.node_pub, got.node_sub) == ("/points", "/other", "/watched")
    assert (got.window_start, got.window_stop) == (Time.from_sec(1000), Time.from_sec(1001))
    assert (got.delivered_msgs, got.dropped_msgs) == (4, 2)
    assert got.traffic == 4 * (len(message.to_bytes()) + 4)
    assert got.period_mean.to_sec() == pytest.approx(1 / 3)
    assert got.period_max == Duration.from_sec(0.5)
    assert got.period_stddev.to_sec() == pytest.approx(0.1178511)
    assert got.stamp_age_mean.to_sec() == pytest.approx(0.2)
    assert got.stamp_age_max == Duration.from_sec(0.5)


async def test_messages_without_a_header(watched, make_node):
    node, statistics, set_time = watched
    other = await make_node("other")
    async with (
        other.advertise("chatter", String) as pub,
        node.subscribe("chatter", "*") as sub,
    ):
        await pub.wait_for_subscribers(timeout=30)
        await deliver(pub, sub, String("a"))
        await set_time(1002)
        await deliver(pub, sub, String("b"))
        got = await statistics.get(timeout=30)
        assert (got.delivered_msgs, got.dropped_msgs, got.traffic) == (2, 0, 18)
        assert got.period_max == Duration(2)
        assert got.stamp_age_max == Duration()
        # Few came: the next window is twice as long.
        for now in (1003.5, 1004.0):
            await set_time(now)
            await deliver(pub, sub, String("c"))
        got = await statistics.get(timeout=30)
        assert (got.delivered_msgs, got.window_stop) == (2, Time(1004))


async def test_a_clock_that_is_set_back(watched, make_node):
    """As a simulation or a bag that starts over does it: the windows begin again."""
    node, statistics, set_time = watched
    other = await make_node("other")
    async with (
        other.advertise("points", PointStamped) as pub,
        node.subscribe("points", PointStamped) as sub,
    ):
        await pub.wait_for_subscribers(timeout=30)
        for now in (1000.0, 1000.5, 3.0, 3.5, 4.0, 0.5, 1.0, 5.0):
            await set_time(now)
            message = PointStamped.from_dict({"header": {"stamp": Time.from_sec(now)}})
            await deliver(pub, sub, message)
        for begin, stop, count in ((3, 4, 3), (0.5, 5, 3)):
            got = await statistics.get(timeout=30)
            assert (got.window_start, got.window_stop) == (
                Time.from_sec(begin),
                Time.from_sec(stop),
            )
            assert (got.delivered_msgs, got.dropped_msgs) == (count, 0)
            assert got.period_max >= got.period_mean > Duration()


async def test_a_clock_that_stands_still(watched, make_node):
    """What is measured takes no memory for each message."""
    node, statistics, set_time = watched
    other = await make_node("other")
    async with (
        other.advertise("chatter", String, queue_size=3000) as pub,
        node.subscribe("chatter", String, queue_size=1) as sub,
    ):
        await pub.wait_for_subscribers(timeout=30)
        tracemalloc.start()
        try:
            for _ in range(10):
                for _ in range(2000):
                    pub.publish(data="a")
                await pub.drain(timeout=30)
            pub.publish(data="b")
            async with asyncio.timeout(30):
                while (await sub.get()).data != "b":
                    pass
            kept = tracemalloc.take_snapshot().filter_traces(
                [tracemalloc.Filter(True, "*/node/statistics.py")]
            )
        finally:
            tracemalloc.stop()
        assert sum(each.size for each in kept.statistics("filename")) < 20_000
        await set_time(1001.0)
        await deliver(pub, sub, String("c"))
        got = await statistics.get(timeout=30)
        assert (got.delivered_msgs, got.period_max) == (20_002, SECOND)


async def test_nothing_is_published_unless_it_is_asked_for(make_node):
    node = await make_node("node")
    async with node.advertise("chatter", String) as pub, node.subscribe("chatter", String) as sub:
        await pub.wait_for_subscribers(timeout=30)
        await deliver(pub, sub, String("a"))
        state = await node.master.get_system_state()
    assert "/statistics" not in state.publishers
