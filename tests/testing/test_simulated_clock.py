"""Time that a test drives: what has happened when it has passed."""

from __future__ import annotations

import asyncio

import pytest

import aioros1
from aioros1 import Duration, Time
from aioros1.testing import SimulatedClock


async def test_a_node_has_the_time_from_its_start(ros_node, make_node, ros_clock):
    assert ros_clock.now == ros_node.now() == Time(1)
    await ros_clock.set(100)
    late = await make_node("late")
    assert (ros_node.now(), late.now()) == (Time(100), Time(100))
    await ros_clock.set(Time(200, 7))
    assert (ros_node.now(), late.now(), ros_clock.now) == (Time(200, 7),) * 3


async def test_a_node_that_does_not_want_it_keeps_its_own(make_node, ros_clock):
    node = await make_node(use_sim_time=False)
    await ros_clock.advance(1)
    assert node.now() > Time(1_000_000_000)


async def test_a_node_that_was_there_before_the_clock(ros_master, make_node):
    node = await make_node(heartbeat=0.01)
    own = await make_node("own", heartbeat=0.01, use_sim_time=False)
    async with SimulatedClock(ros_master.uri) as clock:
        await clock.track(own)
        await clock.track(node)
        assert node.now() == Time(1)
        await clock.advance(1)
        assert node.now() == Time(2)
    assert node.now() == Time(2)


async def test_a_node_that_calls_the_master_by_another_address(ros_master, make_node, ros_clock):
    """Or by way of a proxy."""
    for number in range(20):
        uri = f"http://127.0.0.1:{ros_master.port}"
        node = await make_node(f"node_{number}", master_uri=uri)
        assert node.now() == Time(1)


async def test_a_sleep_ends_when_its_time_has_come(ros_node, ros_clock):
    log = []

    async def sleeper():
        await ros_node.sleep(5)
        log.append(ros_clock.now)
        await ros_node.sleep(Duration(0, 500_000_000))
        log.append(ros_clock.now)

    task = asyncio.create_task(sleeper())
    await ros_clock.advance(4.999999999)
    assert log == []
    await ros_clock.advance(Duration(0, 1))
    assert log == [Time(6)]
    await ros_clock.advance(10)
    assert log == [Time(6), Time(6, 500_000_000)]
    assert ros_clock.now == Time(16)
    assert task.done()


async def test_rates_and_timers_of_several_nodes_tick_each_at_their_time(make_node, ros_clock):
    one, two = await make_node("one"), await make_node("two")
    log = []

    async def ticks():
        async for now in two.rate(0.5):
            log.append(("rate", now.to_sec()))  # noqa: PERF401 - one by one, with the others

    task = asyncio.create_task(ticks())
    one.timer(1.5, lambda now: log.append(("timer", now.to_sec())))
    await ros_clock.advance(6)
    assert log[:5] == [
        ("timer", 2.5), ("rate", 3.0), ("timer", 4.0), ("rate", 5.0), ("timer", 5.5),
    ]  # fmt: skip
    assert sorted(log[5:]) == [("rate", 7.0), ("timer", 7.0)]  # at once, in any order
    assert ros_clock.now == Time(7)
    task.cancel()


async def test_a_jump_is_one_step(ros_node, ros_clock):
    ticks = []
    ros_node.timer(1, ticks.append)
    await ros_clock.set(101)
    assert ticks == [Time(101)]


async def test_a_jump_backwards_ends_what_waits(ros_node, ros_clock):
    await ros_clock.set(50)
    asleep = asyncio.create_task(ros_node.sleep(1000))
    await ros_clock.set(10)
    assert asleep.done()
    assert (ros_clock.now, ros_node.now()) == (Time(10), Time(10))


async def test_what_was_woken_has_run_to_its_next_wait(ros_node, ros_clock):
    queue: asyncio.Queue[int] = asyncio.Queue()
    log = []

    async def produce(now):
        await asyncio.gather(*(asyncio.gather(queue.put(each)) for each in range(3)))

    async def consume():
        while True:
            item = await queue.get()
            await asyncio.sleep(0)
            log.append(item)

    consumer = asyncio.create_task(consume())
    ros_node.timer(1, produce, oneshot=True)
    await ros_clock.advance(1)
    assert log == [0, 1, 2]
    consumer.cancel()


async def test_callbacks_that_sleep_take_simulated_time(ros_node, ros_clock):
    log = []

    async def callback(now):
        await ros_node.sleep(0.25)
        log.append((now.to_sec(), ros_node.now().to_sec()))

    ros_node.timer(1, callback)
    await ros_clock.advance(2.25)
    assert log == [(2.0, 2.25), (3.0, 3.25)]


async def test_a_callback_may_move_the_time(ros_node, ros_clock):
    ros_node.timer(1, lambda now: ros_clock.advance(5), oneshot=True)
    await ros_clock.advance(1)
    while ros_node.now() != Time(7):
        await asyncio.sleep(0.001)


async def test_a_node_that_closes_on_the_way_is_not_waited_for(make_node, ros_clock):
    node, other = await make_node("node"), await make_node("other")
    asleep = asyncio.create_task(node.sleep(10))
    await ros_clock.advance(1)
    await node.close()
    await ros_clock.advance(100)
    assert other.now() == Time(102)
    with pytest.raises(aioros1.ClosedError):
        await asleep


@pytest.mark.parametrize("moment", [0, Time(), -1.0])
async def test_a_time_is_after_zero(ros_clock, moment):
    with pytest.raises(ValueError, match=r"zero|before the epoch"):
        await ros_clock.set(moment)


async def test_time_does_not_advance_backwards(ros_clock):
    with pytest.raises(ValueError, match=r"cannot advance by -0\.5"):
        await ros_clock.advance(-0.5)
    await ros_clock.advance(0)
    assert ros_clock.now == Time(1)


async def test_a_task_that_never_waits_is_named(ros_clock, monkeypatch):
    monkeypatch.setattr("aioros1.testing.simulated_clock._PATIENCE", 0.05)

    async def spin():
        while True:
            await asyncio.sleep(0)

    task = asyncio.create_task(spin(), name="spinner")
    with pytest.raises(TimeoutError, match=r"never wait for anything in 0\.05 s: spinner$"):
        await ros_clock.advance(1)
    task.cancel()


async def test_a_node_that_does_not_hear_of_the_time_is_named(ros_clock, monkeypatch):
    monkeypatch.setattr("aioros1.testing.simulated_clock._PATIENCE", 0.05)
    async with aioros1.Node("deaf", remap={"/clock": "/elsewhere"}) as node:
        with pytest.raises(TimeoutError, match=r"node /deaf did not get the time 1\.0* of /clock"):
            await ros_clock.track(node)


async def test_without_pytest(master):
    async with (
        SimulatedClock(master.uri, start=Time(5)) as clock,
        aioros1.Node("robot", master_uri=master.uri) as node,
    ):
        await clock.track(node)
        assert node.now() == clock.now == Time(5)
        assert await node.get_param("/use_sim_time") is True
        await clock.advance(1)
        assert node.now() == Time(6)
    async with aioros1.Node("robot", master_uri=master.uri) as node:
        assert not await node.has_param("/use_sim_time")


async def test_it_ends_well_without_its_master(master):
    async with SimulatedClock(master.uri) as clock:
        await master.close()
        await clock.advance(1)


async def test_programs_hear_of_it_as_of_any_simulator(make_node, ros_clock):
    node = await make_node(use_sim_time=False)
    async with node.subscribe("/clock", "rosgraph_msgs/Clock") as sub:
        assert (await sub.get(timeout=30)).clock == Time(1)
        await ros_clock.advance(1)
        assert (await sub.get(timeout=30)).clock == Time(2)
