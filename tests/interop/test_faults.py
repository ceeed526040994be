"""Peers that die, come back, or take another's name."""

from __future__ import annotations

import asyncio
import logging
import signal

import pytest

from .ours import take, take_until
from .processes import Process, until
from .rosmaster import RealMaster
from .world import World, xmlrpc_call

STRING = "std_msgs/String"
SET_BOOL = "std_srvs/SetBool"


async def talker(world: World, client: str, topic: str) -> Process:
    """A publisher /mouth that talks for ever to whom it may concern."""
    if client == "roscpp":
        return await world.roscpp_ready("talker", topic, STRING, "0", "100", "0", "__name:=mouth")
    fields = world.fields(data="number $i")
    return await world.rospy_ready("talker", topic, STRING, fields, "--name", "mouth")


async def listener(world: World, client: str, topic: str) -> Process:
    if client == "roscpp":
        return await world.roscpp_ready("listener", topic, STRING, "__name:=ear")
    return await world.rospy_ready("listener", topic, STRING, "--name", "ear")


async def server(world: World, client: str, service: str) -> Process:
    if client == "roscpp":
        return await world.roscpp_ready("server", service, "__name:=server")
    reply = world.fields(success=True, message="it is on")
    return await world.rospy_ready(
        "server", service, SET_BOOL, "--reply", reply, "--name", "server"
    )


each_client = pytest.mark.parametrize("client", ["rospy", "roscpp"])


@each_client
async def test_a_killed_publisher_that_comes_back_is_heard(under_each: World, client: str) -> None:
    world = under_each
    topic = world.unique("chatter")
    async with world.node("ours") as node, node.subscribe(topic, STRING) as sub:
        first = await talker(world, client, topic)
        await take(sub, 5)
        await first.kill()
        await until(lambda: sub.publisher_count == 0, what="the loss to be noticed")
        # The master still names the dead one.
        assert await world.who("publishers", topic) == {"/mouth"}
        await talker(world, client, topic)
        # It counts from zero again.
        messages = await take_until(sub, lambda m: m.data == "number 0")
        assert messages[-1].data == "number 0"
        assert sub.publisher_count == 1


@each_client
async def test_a_killed_subscriber_does_not_disturb_our_publisher(
    under_rosmaster: World, client: str
) -> None:
    world = under_rosmaster
    topic = world.unique("chatter")
    other = "rospy" if client == "roscpp" else "roscpp"
    async with world.node("ours") as node, node.advertise(topic, STRING, queue_size=1000) as pub:
        doomed = await listener(world, client, topic)
        if other == "rospy":
            steady = await world.rospy_ready("listener", topic, STRING, "--name", "steady")
        else:
            steady = await world.roscpp_ready("listener", topic, STRING, "__name:=steady")
        await pub.wait_for_subscribers(2, timeout=15)
        for i in range(200):
            if i == 100:
                await doomed.kill()
            pub.publish(data=f"number {i}")
            await asyncio.sleep(0.002)
        await until(lambda: pub.subscriber_count == 1, what="the loss to be noticed")
        messages = await steady.wait_values("message", 200)
        assert [m["data"] for m in messages] == [f"number {i}" for i in range(200)]
        # And it may come back.
        again = await listener(world, client, topic)
        await pub.wait_for_subscribers(2, timeout=15)
        pub.publish(data="welcome back")
        assert (await again.wait_values("message"))[0]["data"] == "welcome back"


@each_client
async def test_a_stopped_subscriber_holds_up_nobody(under_rosmaster: World, client: str) -> None:
    """One process sleeps on its socket; ours goes on, drops and counts."""
    world = under_rosmaster
    topic = world.unique("image")
    async with (
        world.node("ours") as node,
        world.node("reader") as reader,
        node.advertise(topic, "sensor_msgs/Image", queue_size=2) as pub,
        reader.subscribe(topic, "sensor_msgs/Image", queue_size=100) as sub,
    ):
        if client == "rospy":
            slow = await world.rospy_ready("listener", topic, "sensor_msgs/Image")
        else:
            slow = await world.roscpp_ready("listener", topic, "sensor_msgs/Image")
        await pub.wait_for_subscribers(2, timeout=15)
        slow.signal(signal.SIGSTOP)
        try:
            heard = 0
            for i in range(40):
                pub.publish(height=i, data=bytes(1 << 20))
                (message,) = await take(sub, 1)
                assert message.height == i
                heard += 1
            assert heard == 40
            assert pub.dropped > 0
        finally:
            slow.signal(signal.SIGCONT)
        # The sleeper wakes up and gets the newest of what waited.
        pub.publish(height=1000, data=b"")
        await until(
            lambda: 1000 in [m["height"] for m in slow.values("message")],
            what=slow.report,
        )


@each_client
@pytest.mark.parametrize("persistent", [False, True], ids=["plain", "persistent"])
async def test_a_killed_server(under_each: World, client: str, persistent: bool) -> None:
    """An error at once, though the master still names it; and it works when it is back."""
    import aioros1

    world = under_each
    service = world.unique("flip")
    first = await server(world, client, service)
    async with (
        world.node("ours") as node,
        node.service_caller(service, SET_BOOL, persistent=persistent) as caller,
    ):
        assert (await caller.call(data=True, timeout=10)).success is True
        await first.kill()
        assert await world.who("services", service) == {"/server"}
        for _ in range(2):
            with pytest.raises(aioros1.ServiceUnavailable):
                await caller.call(data=True, timeout=10)
        assert not await caller.is_available()
        await server(world, client, service)
        await caller.wait_for_service(timeout=10)
        assert (await caller.call(data=True, timeout=10)).success is True


async def test_a_server_killed_in_the_middle_of_a_call(under_rosmaster: World) -> None:
    """The request is not sent again, and the caller is told."""
    import aioros1

    world = under_rosmaster
    service = world.unique("flip")
    process = await world.rospy_ready("server", service, SET_BOOL, "--hang")
    async with (
        world.node("ours") as node,
        node.service_caller(service, SET_BOOL, persistent=True) as caller,
    ):
        call = caller.send_request(data=True, timeout=20)
        await process.wait_values("request")
        assert not call.done()
        await process.kill()
        with pytest.raises(aioros1.ServiceUnavailable):
            await call
        assert process.values("request") == [{"data": True}]
        assert caller.is_open


async def test_rospy_takes_the_name_of_our_node(under_each: World) -> None:
    """The older one is told to go, and why."""
    world = under_each
    topic = world.unique("chatter")
    async with world.node("same_name") as node:
        sub = await node.subscribe(topic, STRING)
        fields = world.fields(data="x")
        await world.rospy_ready("talker", topic, STRING, fields, "--name", "same_name")
        async with asyncio.timeout(10):
            reason = await node.wait_closed()
            assert [item async for item in sub] == []
        assert "new node registered with same name" in str(reason)
        # Our leaving takes nothing from the new one.
        await world.wait_who("publishers", topic, {"/same_name"})
        assert await world.who("subscribers", topic) == set()


async def test_our_node_takes_the_name_of_rospys(under_each: World) -> None:
    world = under_each
    topic = world.unique("chatter")
    fields = world.fields(data="x")
    older = await world.rospy_ready("talker", topic, STRING, fields, "--name", "same_name")
    async with world.node("same_name") as node, node.advertise(topic, STRING, latch=True) as pub:
        await older.wait()
        assert older.values("shutdown") == [True]
        assert "same name" in (older.stdout + older.stderr + _log(world, "same_name"))
        assert node.is_open
        assert await world.who("publishers", topic) == {"/same_name"}
        pub.publish(data="mine now")
        result = await world.run("rostopic", "echo", "-n", "1", topic)
        assert "mine now" in result.stdout


async def test_roscpp_and_our_node_of_one_name(under_rosmaster: World) -> None:
    world = under_rosmaster
    topic = world.unique("chatter")
    older = await world.roscpp_ready(
        "talker", topic, STRING, "0", "50", "0", "__name:=same_cpp_name"
    )
    async with world.node("same_cpp_name") as node:
        await older.wait()
        await world.roscpp_ready("talker", topic, STRING, "0", "50", "0", "__name:=same_cpp_name")
        async with asyncio.timeout(10):
            reason = await node.wait_closed()
        assert "new node registered with same name" in str(reason)


async def test_a_node_with_the_port_of_a_dead_one_survives_the_return_of_that(
    under_each: World, caplog: pytest.LogCaptureFixture
) -> None:
    """rosmaster tells the dead one to end, at the address that it had."""
    world = under_each
    caplog.set_level(logging.INFO)
    topic = world.unique("chatter")
    async with world.node("heir") as heir, heir.advertise(topic, STRING) as pub:
        # A registration of a node that was killed, whose port the heir got.
        await asyncio.to_thread(
            *(xmlrpc_call, world.uri, "registerPublisher"),
            *("/returning", topic, STRING, heir.uri),
        )
        async with world.node("returning") as returning, returning.subscribe(topic) as sub:
            await sub.wait_for_publishers(timeout=15)
            await pub.wait_for_subscribers(timeout=15)
            if world.kind == "rosmaster":
                await until(
                    lambda: "ignored a shutdown that is meant for /returning" in caplog.text,
                    what="the shutdown came",
                )
            await world.wait_who("publishers", topic, {"/heir"})
            assert heir.is_open
            assert await world.ask("lookupNode", "/returning") == returning.uri


def _log(world: World, name: str) -> str:
    folder = world.folder / "ros_home" / "log"
    return "".join(path.read_text(errors="replace") for path in folder.glob(f"*{name}*.log"))


async def test_closing_leaves_nothing_at_the_master(under_each: World) -> None:
    world = under_each
    topic, service, key = (world.unique(stem) for stem in ("chatter", "flip", "key"))
    node = world.node("leaving")
    await node.start()
    try:
        pub = await node.advertise(topic, STRING)
        sub = await node.subscribe(topic, STRING)
        provider = await node.advertise_service(service, SET_BOOL)
        psub = await node.subscribe_param(key, default=None)
        ear = await world.rospy_ready("listener", topic, STRING)
        await pub.wait_for_subscribers(2, timeout=15)
        assert {name for _, name in await world.traces("/leaving")} >= {topic, service}
    finally:
        await node.close()
    assert await world.traces("/leaving") == []
    assert not any(role.is_open for role in (pub, sub, provider, psub))
    await node.close()
    assert ear.code is None


async def test_closing_under_a_master_that_is_gone(own_real_master: RealMaster) -> None:
    import aioros1

    async with asyncio.timeout(10):
        async with aioros1.Node(
            "bereaved", master_uri=own_real_master.uri, host="localhost"
        ) as node:
            await node.advertise("/chatter", STRING)
            await node.subscribe("/chatter", STRING)
            own_real_master.stop()
        assert not node.is_open


async def test_one_name_used_again_in_one_process(under_each: World) -> None:
    world = under_each
    topic = world.unique("chatter")
    ear = await world.rospy_ready("listener", topic, STRING)
    for i in range(3):
        async with world.node("phoenix") as node, node.advertise(topic, STRING) as pub:
            await pub.wait_for_subscribers(timeout=15)
            pub.publish(data=f"life {i}")
            await ear.wait_values("message", i + 1)
        assert await world.traces("/phoenix") == []
    assert [m["data"] for m in ear.values("message")] == ["life 0", "life 1", "life 2"]


async def test_our_newer_node_ends_our_older_one(under_each: World) -> None:
    world = under_each
    topic = world.unique("chatter")
    async with world.node("twin") as older:
        await older.advertise(topic, STRING)
        async with world.node("twin") as newer, newer.advertise(topic, STRING):
            async with asyncio.timeout(10):
                reason = await older.wait_closed()
            assert "new node registered with same name" in str(reason)
            assert newer.is_open
            assert await world.who("publishers", topic) == {"/twin"}
            assert await world.ask("lookupNode", "/twin") == newer.uri
