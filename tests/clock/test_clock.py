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
        await pub.wait_for_subscribers(timeout=30)
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
        await asyncio.wait_for(asleep, 30)
        asleep = asyncio.create_task(node.sleep(1000.0))
        await asyncio.sleep(0)
        pub.publish(clock=Time(1))
        await asyncio.wait_for(asleep, 30)
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
    first = await asyncio.wait_for(times.get(), 30)
    assert await asyncio.wait_for(times.get(), 30) > first
    timer.cancel()
    once = asyncio.Event()
    node.timer(Duration(0, 1000), lambda now: once.set(), oneshot=True)
    await asyncio.wait_for(once.wait(), 30)


class Simulation:
    """A node on simulated time, and the hand that sets it."""

    def __init__(self, node, pub):
        self.node = node
        self._pub = pub

    async def set(self, seconds):
        now = Time(seconds)
        await self._pub.send(clock=now)
        while self.node.now() != now:
            await asyncio.sleep(0.0005)
        for _ in range(5):
            await asyncio.sleep(0)  # whoever waited for it, and whoever waits for that


@pytest.fixture
async def simulation(make_node):
    clock = await make_node("clock")
    node = await make_node("simulated", use_sim_time=True)
    async with clock.advertise("/clock", "rosgraph_msgs/Clock", latch=True) as pub:
        await pub.wait_for_subscribers(timeout=30)
        yield Simulation(node, pub)


async def test_a_rate_counts_what_it_missed(simulation):
    await simulation.set(100)
    rate = simulation.node.rate(10)
    given = []
    for now in (100.1, 100.2, 100.9, 101.0, 105.0, 105.05, 105.1):
        following = asyncio.create_task(anext(rate))
        await asyncio.sleep(0)
        await simulation.set(now)
        if following.done():
            given.append((following.result().to_sec(), rate.missed))
        else:
            following.cancel()
    # 100.3 came at 100.9 only, so that six were missed; 101.0 was waited for until then.
    assert given == [(100.1, 0), (100.2, 0), (100.9, 0), (101.0, 6), (105.0, 6), (105.1, 45)]


async def test_a_rate_begins_a_new_phase_when_time_jumps_back(simulation):
    await simulation.set(100)
    rate = simulation.node.rate(1)
    given = []

    async def tick():
        async for now in rate:
            given.append(now.to_sec())  # noqa: PERF401 - it is cancelled

    ticking = asyncio.create_task(tick())
    await asyncio.sleep(0)
    for now in (101, 101.5, 101.2, 101.9, 102.2, 10, 10.9, 11, 12):
        await simulation.set(now)
    assert given == [101, 101.2, 102.2, 10, 11, 12]
    assert rate.missed == 0
    ticking.cancel()
    await asyncio.gather(ticking, return_exceptions=True)


async def test_a_timer_goes_on_when_time_jumps_back_or_stands_still(simulation):
    given = []
    timer = simulation.node.timer(Duration(2), lambda now: given.append(now.to_sec()))
    await asyncio.sleep(0)
    for now in (50, 52, 52, 52, 54, 3, 4, 5, 7):
        await simulation.set(now)
    assert given == [52, 54, 3, 5, 7]
    timer.cancel()


async def test_a_sleep_of_a_duration_is_exact(simulation):
    start, far = Time(1_700_000_000), Duration(200_000_000, 1)
    await simulation.set(start.secs)
    asleep = asyncio.create_task(simulation.node.sleep(far))
    await asyncio.sleep(0)
    await simulation.set(start.secs + far.secs)
    assert not asleep.done()  # one nanosecond is left
    await simulation.set(start.secs + far.secs + 1)
    assert asleep.done()
    await asleep


async def test_a_clock_that_is_silent_is_told_once(make_node, monkeypatch, caplog):
    monkeypatch.setattr("aioros1.node.sim_time._SILENCE", 0.02)
    clock = await make_node("clock")
    node = await make_node("simulated", use_sim_time=True)
    asleep = asyncio.create_task(node.sleep(1))
    while not caplog.messages:
        await asyncio.sleep(0.001)
    async with clock.advertise("/clock", "rosgraph_msgs/Clock", latch=True) as pub:
        for secs in (7, 8):
            pub.publish(clock=Time(secs))
            while node.now() != Time(secs):
                await asyncio.sleep(0.001)
        await asleep
    (record,) = [record for record in caplog.records if record.ros_node == "/simulated"]
    assert record.levelname == "WARNING"
    assert "nothing came on /clock in 0.02 s" in record.getMessage()


async def test_a_clock_that_comes_in_time_is_no_reason_to_warn(simulation, caplog):
    await simulation.set(1)
    assert caplog.messages == []


async def becomes(is_simulated, node):
    """Wait until a node has the one time or the other; a simulated one begins at zero."""
    async with asyncio.timeout(30):
        while (node.now() < Time(1_000_000_000)) is not is_simulated:
            await asyncio.sleep(0.001)


async def test_use_sim_time_counts_when_it_changes(make_node):
    other = await make_node("other", use_sim_time=False)
    node = await make_node("node", heartbeat=0.01)
    own = await make_node("own", use_sim_time=True)
    assert node.roles == ()
    assert node.stats.roles == 0
    for _ in range(2):
        asleep = asyncio.create_task(node.sleep(3600))
        await asyncio.sleep(0)
        await other.set_param("/use_sim_time", True)
        await becomes(True, node)
        await asleep  # an hour of the other time
        asleep = asyncio.create_task(node.sleep(0.01))
        await asyncio.sleep(0)
        await other.set_param("/use_sim_time", False)
        await becomes(False, node)
        await asleep  # it had to wait for the first time
    assert other.now() != Time()
    assert own.now() == Time()


async def test_clock_is_followed_while_it_is_wanted(make_node):
    clock = await make_node("clock", use_sim_time=False)
    node = await make_node("node", heartbeat=0.01)
    async with clock.advertise("/clock", "rosgraph_msgs/Clock", overflow="block") as pub:
        for start in (100, 50):
            await clock.set_param("/use_sim_time", True)
            await pub.wait_for_subscribers(timeout=30)
            assert node.now() == Time()
            simulation = Simulation(node, pub)
            await simulation.set(start)
            rate = node.rate(1)
            ticking = asyncio.create_task(anext(rate))
            await asyncio.sleep(0)
            await simulation.set(start + 1)
            assert await ticking == Time(start + 1)
            asleep = asyncio.create_task(node.sleep(3600))
            await asyncio.sleep(0)
            await clock.set_param("/use_sim_time", False)
            async with asyncio.timeout(30):
                while pub.connections:
                    await asyncio.sleep(0.001)
            assert abs(node.now().to_sec() - time.time()) < 60
            await asleep
            rate = node.rate(1000)
            assert await anext(rate) < await anext(rate)


async def test_time_stays_as_it_is_when_the_parameter_has_gone(make_node):
    """With its master, for example: the simulation runs on then."""
    params = {"/use_sim_time": True}
    async with aioros1.Master(host="localhost", port=0, rosout=False, params=params) as master:
        port = master.port
        options = {"master_uri": master.uri, "heartbeat": 0.02}
        clock = await make_node("clock", use_sim_time=False, **options)
        node = await make_node("node", **options)
        pub = await clock.advertise("/clock", "rosgraph_msgs/Clock", overflow="block")
        await pub.wait_for_subscribers(timeout=30)
        simulation = Simulation(node, pub)
        await simulation.set(100)
    events = node.events()
    async with aioros1.Master(host="localhost", port=port, rosout=False):
        async for event in events:
            if isinstance(event, aioros1.MasterRestarted):
                break  # it has asked for the parameter, too
        await simulation.set(102)
        await clock.set_param("/use_sim_time", False)
        await becomes(False, node)
        await node.close()
        await clock.close()


async def test_who_waits_while_the_master_comes_with_simulated_time(make_node):
    """A node that starts before its master learns only then what time it is."""
    async with aioros1.Master(host="localhost", port=0, rosout=False) as reserved:
        port = reserved.port
    node = await make_node("early", master_uri=f"http://localhost:{port}/", heartbeat=0.05)
    rate = node.rate(0.001)
    asleep = asyncio.create_task(node.sleep(3600))
    ticking = asyncio.create_task(anext(rate))
    await asyncio.sleep(0)
    params = {"/use_sim_time": True}
    async with aioros1.Master(host="localhost", port=port, rosout=False, params=params) as master:
        await asyncio.wait_for(asleep, 10)
        assert node.now() == Time()
        assert not ticking.done()
        clock = await make_node("clock", master_uri=master.uri)
        async with clock.advertise("/clock", "rosgraph_msgs/Clock", overflow="block") as pub:
            await pub.wait_for_subscribers(timeout=30)
            simulation = Simulation(node, pub)
            await simulation.set(500)
            assert not ticking.done()  # a whole period of the new time
            await simulation.set(1500)
            assert await ticking == Time(1500)
            assert rate.missed == 0
        await clock.close()
        await node.close()


@pytest.mark.parametrize("hz", [0, -1, float("nan"), float("inf"), 1e-300])
async def test_a_rate_must_be_one(make_node, hz):
    node = await make_node()
    with pytest.raises(ValueError, match="a rate must be positive, got"):
        node.rate(hz)


async def test_a_rate_that_no_clock_can_show(make_node):
    node = await make_node()
    rate = node.rate(1e12)
    assert await anext(rate) < await anext(rate)


@pytest.mark.parametrize("seconds", [float("nan"), float("inf")])
async def test_a_sleep_must_end(make_node, seconds):
    node = await make_node()
    with pytest.raises(ValueError, match="must be finite, got"):
        await node.sleep(seconds)
    with pytest.raises(ValueError, match="must be finite, got"):
        node.timer(seconds, print)


@pytest.mark.parametrize("period", [0, -1.0, Duration(0)])
async def test_a_period_must_be_positive(make_node, period):
    node = await make_node()
    with pytest.raises(ValueError, match="must be positive"):
        node.timer(period, print)
    with pytest.raises(ValueError, match="must be positive"):
        await anext(node.rate(-1))
