"""rosbag with our nodes."""

from __future__ import annotations

import asyncio
import itertools
from pathlib import Path

from aioros1 import Duration, Time

from .ours import take
from .processes import until
from .world import World

JOINTS = "sensor_msgs/JointState"
STRING = "std_msgs/String"
COUNT = 10


async def record(world: World, joints: str, text: str) -> Path:
    """A bag with ``COUNT`` of our messages on ``joints`` and a latched one on ``text``."""
    bag = world.folder / "ours.bag"
    async with (
        world.node("recorded") as node,
        node.advertise(joints, JOINTS, queue_size=100) as pub,
        node.advertise(text, STRING, latch=True) as latched,
    ):
        latched.publish(data="for the record")
        # The limit makes it end by itself, when it has all.
        tool = world.start("rosbag", "record", "-O", str(bag), "-l", str(COUNT), joints, text)
        await pub.wait_for_subscribers(timeout=15)
        await latched.wait_for_subscribers(timeout=15)
        for i in range(COUNT):
            message = pub.message(name=["a", "b"], position=[0.5 * i, -1.0])
            message.header.frame_id = "arm"
            pub.publish(message)
            await asyncio.sleep(0.01)
        await until(lambda: pub.subscriber_count == 0, what="the recorder to have its messages")
        await tool.end()
    assert bag.exists(), tool.report()
    return bag


async def test_record_info_and_play(under_each: World) -> None:
    world = under_each
    joints, text = world.unique("joints"), world.unique("text")
    bag = await record(world, joints, text)

    info = await world.parse_yaml((await world.run("rosbag", "info", "--yaml", str(bag))).stdout)
    topics = {entry["topic"]: entry for entry in info["topics"]}
    assert topics[joints]["type"] == JOINTS
    assert topics[joints]["messages"] == COUNT
    assert topics[text]["messages"] == 1

    async with (
        world.node("listening") as node,
        node.subscribe(joints, JOINTS, queue_size=100) as typed,
        node.subscribe(joints, "*", queue_size=100) as anything,
        node.subscribe(text, STRING) as latched,
    ):
        player = world.start("rosbag", "play", "-q", "--wait-for-subscribers", str(bag))
        messages = await take(typed, COUNT)
        assert [m.position[0] for m in messages] == [0.5 * i for i in range(COUNT)]
        seqs = [m.header.seq for m in messages]
        assert seqs == list(range(seqs[0], seqs[0] + COUNT))
        assert [list(m.name) for m in await take(anything, COUNT)] == [["a", "b"]] * COUNT
        (event,) = await take(latched.events(), 1)
        assert event.message.data == "for the record"
        assert event.header["latching"] == "1"
        result = await player.wait()
        assert result.code == 0, result.text


async def test_the_clock_of_a_bag(under_rosmaster: World) -> None:
    """A node on simulated time lives in the time of the bag, and sleeps by it."""
    world = under_rosmaster
    joints, text = world.unique("joints"), world.unique("text")
    bag = await record(world, joints, text)
    info = await world.parse_yaml((await world.run("rosbag", "info", "--yaml", str(bag))).stdout)
    async with world.node("simulated", use_sim_time=True) as node:
        assert node.now().to_sec() == 0
        sleeper = asyncio.create_task(node.sleep(0.02))
        # A tenth of the speed: the 0.1 s of the bag take a second.
        world.start("rosbag", "play", "-q", "--clock", "--hz=200", "-r", "0.1", str(bag))
        async with asyncio.timeout(15):
            await sleeper
        assert info["start"] - 1 < node.now().to_sec() < info["end"] + 1


async def test_the_clock_of_a_bag_drives_rates_and_timers(under_rosmaster: World) -> None:
    world = under_rosmaster
    joints, text = world.unique("joints"), world.unique("text")
    bag = await record(world, joints, text)
    info = await world.parse_yaml((await world.run("rosbag", "info", "--yaml", str(bag))).stdout)
    called: list[float] = []
    async with world.node("simulated", use_sim_time=True) as node:
        timer = node.timer(Duration(0, 10_000_000), lambda now: called.append(now.to_sec()))
        rate = node.rate(100)
        ticks: list[float] = []

        async def tick() -> None:
            async for now in rate:
                ticks.append(now.to_sec())  # noqa: PERF401 - it is looked at meanwhile

        ticking = asyncio.create_task(tick())
        play = ("rosbag", "play", "-q", "--clock", "--hz=200", "-r", "0.1", str(bag))
        async with asyncio.timeout(40):
            for _ in range(2):  # the second time the clock jumps back to the start
                before = len(ticks)
                player = world.start(*play)
                result = await player.wait()
                assert result.code == 0, result.text
                assert len(ticks) > before
        ticking.cancel()
        timer.cancel()
        await asyncio.gather(ticking, return_exceptions=True)
    for times in (ticks, called):
        steps = [later - earlier for earlier, later in itertools.pairwise(times)]
        assert all(info["start"] - 1 < now < info["end"] + 1 for now in times)
        assert sum(step < 0 for step in steps) == 1


async def test_a_node_that_runs_goes_over_to_the_clock_of_a_bag(under_ours: World) -> None:
    """As somebody does who looks at a bag, with everything running: rosparam, then rosbag."""
    world = under_ours
    bag = await record(world, world.unique("joints"), world.unique("text"))
    info = await world.parse_yaml((await world.run("rosbag", "info", "--yaml", str(bag))).stdout)
    async with world.node("ours", heartbeat=0.05) as node:
        asleep = asyncio.create_task(node.sleep(3600))
        assert node.now().to_sec() > info["end"]
        await world.run("rosparam", "set", "/use_sim_time", "true")
        await asleep
        assert node.now() == Time()
        ticking = asyncio.create_task(anext(node.rate(50)))
        world.start("rosbag", "play", "-q", "--clock", "--hz=200", "-r", "0.1", str(bag))
        now = await asyncio.wait_for(ticking, 40)
        assert info["start"] - 1 < now.to_sec() < info["end"] + 1
        asleep = asyncio.create_task(node.sleep(3600))
        await world.run("rosparam", "set", "/use_sim_time", "false")
        await asleep
        assert node.now().to_sec() > info["end"]


async def test_a_compressed_bag_of_a_rospy_talker(under_rosmaster: World) -> None:
    world = under_rosmaster
    topic = world.unique("text")
    bag = world.folder / "theirs.bag"
    recorder = world.start("rosbag", "record", "--lz4", "-O", str(bag), "-l", "5", topic)
    talker = world.rospy("talker", topic, STRING, world.fields(data="number $i"))
    await until(bag.exists, what=recorder.report)
    await talker.end()
    async with world.node("ours") as node, node.subscribe(topic, STRING) as sub:
        world.start("rosbag", "play", "-q", "--wait-for-subscribers", str(bag))
        messages = await take(sub, 5)
        first = int(messages[0].data.split()[1])
        assert [m.data for m in messages] == [f"number {i}" for i in range(first, first + 5)]
