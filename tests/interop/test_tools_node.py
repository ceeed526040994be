"""rosnode and roswtf with our nodes."""

from __future__ import annotations

import asyncio
import os
import re
import signal
import sys
from pathlib import Path

import pytest

import aioros1

from .ours import take
from .processes import until
from .world import World

STRING = "std_msgs/String"
SET_BOOL = "std_srvs/SetBool"


async def test_list_and_ping(under_each: World) -> None:
    world = under_each
    name = world.unique("ours").lstrip("/")
    async with world.node(name) as node:
        assert f"/{name}" in (await world.run("rosnode", "list")).stdout.split()
        ping = (await world.run("rosnode", "ping", "-c", "2", node.name)).stdout
        assert len(re.findall(rf"xmlrpc reply from {re.escape(node.uri)}", ping)) == 2


async def test_info(under_each: World) -> None:
    """It asks our slave API for the process id and for each connection."""
    world = under_each
    topic, heard, service = (world.unique(stem) for stem in ("chatter", "heard", "flip"))
    async with (
        world.node("ours") as node,
        node.advertise(topic, STRING) as pub,
        node.subscribe(heard, STRING) as sub,
        node.advertise_service(service, SET_BOOL, lambda request: None),
    ):
        await world.rospy_ready("listener", topic, STRING)
        await world.rospy_ready("talker", heard, STRING, world.fields(data="x"))
        await pub.wait_for_subscribers(timeout=15)
        await sub.wait_for_publishers(timeout=15)
        text = (await world.run("rosnode", "info", "/ours")).stdout
        assert f"* {topic} [{STRING}]" in text
        assert f"* {heard} [{STRING}]" in text
        assert f"* {service}" in text
        assert f"Pid: {os.getpid()}" in text
        connections = text.split("Connections:")[1]
        outbound = re.search(rf"\* topic: {topic}\n(.*\n)+?.*transport: TCPROS", connections)
        assert outbound is not None, text
        assert "* to: /rospy_listener" in outbound[0]
        assert "direction: outbound" in outbound[0]
        inbound = re.search(rf"\* topic: {heard}\n(.*\n)+?.*transport: TCPROS", connections)
        assert inbound is not None, text
        assert "* to: /rospy_talker" in inbound[0]
        assert "direction: inbound" in inbound[0]


async def test_kill_ends_our_node_with_its_reason(under_each: World) -> None:
    world = under_each
    topic, service, key = (world.unique(stem) for stem in ("chatter", "flip", "key"))
    async with world.node("victim") as node:
        pub = await node.advertise(topic, STRING)
        sub = await node.subscribe(topic, STRING)
        provider = await node.advertise_service(service, SET_BOOL)
        params = await node.subscribe_param(key, default=None)

        async def count(role: object) -> int:
            return len([item async for item in role])  # type: ignore[attr-defined]

        loops = [asyncio.create_task(count(role)) for role in (sub, provider, params)]
        events = asyncio.create_task(count(node.events()))
        await pub.wait_for_subscribers(timeout=15)
        pub.publish(data="one")

        killed = await world.run("rosnode", "kill", "/victim")
        assert "killed" in killed.stdout
        async with asyncio.timeout(10):
            reason = await node.wait_closed()
            counts = await asyncio.gather(*loops)
            await events
        assert "user request" in str(reason)
        assert counts == [1, 0, 0]
        assert not node.is_open
        assert not pub.is_open
        await world.wait_no_traces("/victim")


DRIVING = """
import asyncio, aioros1

async def main(node):
    async with node.advertise("{topic}", "std_msgs/String", queue_size=100) as pub:
        print("ready", flush=True)
        try:
            while True:
                pub.publish(data="drive")
                await asyncio.sleep(0.01)
        finally:
            pub.publish(data="stop")

aioros1.run(main, "driver")
"""


@pytest.mark.parametrize("how", ["rosnode kill", "SIGINT", "SIGTERM"])
async def test_a_script_stops_the_robot_whoever_ends_it(under_each: World, how: str) -> None:
    world = under_each
    topic = world.unique("cmd")
    robot = await world.rospy_ready("listener", topic, STRING, "--name", "robot")
    paths = f"{Path(aioros1.__file__).parent.parent}"
    script = world.start(
        sys.executable, "-c", DRIVING.format(topic=topic), env={"PYTHONPATH": paths}
    )
    await script.wait_text("ready")
    await robot.wait_values("message")
    if how == "rosnode kill":
        assert "killed" in (await world.run("rosnode", "kill", "/driver")).stdout
    else:
        script.signal(getattr(signal, how))
    result = await script.wait()
    assert result.code == 0
    if how == "rosnode kill":
        assert "/driver was shut down: " in result.stderr
        assert "user request" in result.stderr
        assert len(result.stderr.splitlines()) == 1
    else:
        assert result.stderr == ""
    await until(lambda: robot.values("message")[-1] == {"data": "stop"}, what="the robot stops")
    await world.wait_no_traces("/driver")


async def test_kill_all(under_ours: World) -> None:
    """Ours and rospy's nodes go; the master stays."""
    world = under_ours
    topic = world.unique("chatter")
    async with world.node("victim") as node:
        talker = await world.rospy_ready("talker", topic, STRING, world.fields(data="x"))
        await world.run("rosnode", "kill", "-a")
        async with asyncio.timeout(10):
            await node.wait_closed()
        await talker.wait()
        await world.wait_no_traces("/victim")
        await world.wait_no_traces("/rospy_talker")
        assert await world.ask("getPid") == os.getpid()


async def test_cleanup_leaves_our_node_alone(under_each: World) -> None:
    world = under_each
    topic = world.unique("chatter")
    async with (
        world.node("survivor") as node,
        node.subscribe(topic, STRING) as sub,
        node.advertise_service(world.unique("flip"), SET_BOOL, lambda request: None) as provider,
    ):
        dead = await world.rospy_ready("talker", topic, STRING, world.fields(data="x"))
        await take(sub, 1)
        await dead.kill()
        assert await world.who("publishers", topic) == {"/rospy_talker"}
        tool = world.start("rosnode", "cleanup")
        await tool.wait_text("Please type y or n")
        tool.tell("y")
        result = await tool.wait()
        assert result.code == 0
        assert " * /rospy_talker" in result.stdout
        assert "survivor" not in result.stdout
        await world.wait_no_traces("/rospy_talker")
        assert await world.who("subscribers", topic) == {"/survivor"}
        assert await world.who("services", provider.name) == {"/survivor"}
        await until(lambda: sub.publisher_count == 0, what="the dead publisher to be let go")


async def test_roswtf_finds_nothing_wrong_with_us(under_each: World) -> None:
    """It contacts all nodes and services, and compares what both ends of a topic say."""
    world = under_each
    topic, service = world.unique("chatter"), world.unique("flip")
    async with (
        world.node("wtf_ours") as node,
        world.node("wtf_other") as other,
        node.advertise(topic, STRING) as pub,
        other.subscribe(topic, STRING),
        node.advertise_service(service, SET_BOOL, lambda request: None),
    ):
        await world.rospy_ready("listener", topic, STRING)
        await pub.wait_for_subscribers(2, timeout=15)
        result = await world.run("roswtf", timeout=40, code=None)
        assert "running graph rules" in result.text, result.text
        # What comes first is about the machine: Debian has neither rosdep nor the
        # directory of ROS_ROOT. What the graph is told of must not be about us.
        graph = result.text.split("analyzing graph", 1)[1]
        if "No errors or warnings" not in graph:
            for name in ("wtf_ours", "wtf_other", topic, service):
                assert name not in graph, graph
