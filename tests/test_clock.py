"""A node's time: the wall clock's, or that of /clock."""

from __future__ import annotations

import asyncio
import itertools
import time

import pytest

import aioros1
from aioros1 import Duration, Time


async def test_now_is_the_wall_clock(make_node):
    node = await make_node()
    before = time.time_ns()
    now = node.now().to_nsec()
    assert before <= now <= time.time_ns()


async def test_rate_keeps_its_phase_and_skips_what_was_missed(make_node, master):
    clock = await make_node("clock")
    node = await make_node("node", use_sim_time=True)
    ticks = []
    async with clock.advertise("/clock", "rosgraph_msgs/Clock", overflow="block") as pub:
        await pub.wait_for_subscribers(timeout=5)
        rate = node.rate(10)
        following = asyncio.create_task(anext(rate))
        for tenths in range(100, 121, 2):
            await pub.send(clock=Time(tenths // 10, tenths % 10 * 100_000_000))
            while node.now() != Time(tenths // 10, tenths % 10 * 100_000_000):
                await asyncio.sleep(0)
            for _ in range(3):
                await asyncio.sleep(0)
            if following.done():
                ticks.append(following.result())
                following = asyncio.create_task(anext(rate))
        following.cancel()
    # Ten ticks a second, a clock that shows every second of them: one each time.
    assert len(ticks) >= 9
    gaps = [later - earlier for earlier, later in itertools.pairwise(ticks)]
    assert min(gaps) >= Duration(0, 100_000_000)
    await asyncio.gather(following, return_exceptions=True)
    await rate.aclose()


async def test_sleep_goes_by_simulated_time_and_a_jump_back_ends_it(make_node):
    clock = await make_node("clock")
    await clock.set_param("/use_sim_time", True)
    node = await make_node("node")
    async with clock.advertise("/clock", "rosgraph_msgs/Clock", latch=True) as pub:
        pub.publish(clock=Time(100))
        while node.now() != Time(100):
            await asyncio.sleep(0.001)
        asleep = asyncio.create_task(node.sleep(Duration(5)))
        pub.publish(clock=Time(104))
        while node.now() != Time(104):
            await asyncio.sleep(0.001)
        assert not asleep.done()
        pub.publish(clock=Time(105))
        await asyncio.wait_for(asleep, 5)
        asleep = asyncio.create_task(node.sleep(1000.0))
        await asyncio.sleep(0)
        pub.publish(clock=Time(1))
        await asyncio.wait_for(asleep, 5)
        assert node.now() == Time(1)


async def test_sleeps_and_rates_end_with_the_node(make_node):
    node = await make_node()

    async def ticks():
        return [tick async for tick in node.rate(0.001)]

    asleep = asyncio.create_task(node.sleep(3600))
    ticking = asyncio.create_task(ticks())
    await asyncio.sleep(0)
    await node.close()
    with pytest.raises(aioros1.ClosedError):
        await asleep
    assert await ticking == []


async def test_timers_call_functions_and_coroutine_functions(make_node):
    node = await make_node()
    times: asyncio.Queue[Time] = asyncio.Queue()
    timer = node.timer(0.001, times.put)
    first = await asyncio.wait_for(times.get(), 5)
    assert await asyncio.wait_for(times.get(), 5) > first
    timer.cancel()
    once = asyncio.Event()
    node.timer(Duration(0, 1000), lambda now: once.set(), oneshot=True)
    await asyncio.wait_for(once.wait(), 5)


@pytest.mark.parametrize("period", [0, -1.0, Duration(0)])
async def test_a_period_must_be_positive(make_node, period):
    node = await make_node()
    with pytest.raises(ValueError, match="must be positive"):
        node.timer(period, print)
    with pytest.raises(ValueError, match="must be positive"):
        await anext(node.rate(-1))
