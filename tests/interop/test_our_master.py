"""The programs of ROS 1 with each other, under our master."""

from __future__ import annotations

import json

from .ours import take_until
from .processes import until
from .world import World

STRING = "std_msgs/String"
SET_BOOL = "std_srvs/SetBool"


async def test_rospy_and_roscpp_find_each_other(under_ours: World) -> None:
    world = under_ours
    topic = world.unique("chatter")
    py = await world.rospy_ready("listener", topic, STRING)
    cpp = await world.roscpp_ready("listener", topic, STRING, "__name:=cpp_ear")
    await world.rospy_ready("talker", topic, STRING, world.fields(data="py"), "--name", "py_mouth")
    await world.roscpp_ready("talker", topic, STRING, "0", "50", "0", "__name:=cpp_mouth")
    await until(
        lambda: {"/py_mouth", "/cpp_mouth"} <= set(py.values("callerid")),
        what=py.report,
    )
    await until(lambda: {"/py_mouth", "/cpp_mouth"} <= set(cpp.values("from")), what=cpp.report)


async def test_rospy_and_roscpp_call_each_other(under_ours: World) -> None:
    world = under_ours
    cpp_service, py_service = world.unique("flip"), world.unique("flip")
    await world.roscpp_ready("server", cpp_service)
    reply = json.dumps({"success": True, "message": "py"})
    await world.rospy_ready("server", py_service, SET_BOOL, "--reply", reply)
    py = world.rospy("client", cpp_service, SET_BOOL, '{"data": true}')
    cpp = world.roscpp("client", py_service, "1", "0", "__name:=cpp_client")
    assert (await py.wait_values("answer"))[0]["message"] == "it is on"
    assert (await cpp.wait_values("answer"))[0]["message"] == "py"


async def test_rospy_says_goodbye_in_one_request(under_ours: World) -> None:
    """It unregisters everything through system.multicall when it ends."""
    world = under_ours
    topic, service = world.unique("chatter"), world.unique("flip")
    talker = await world.rospy_ready("talker", topic, STRING, world.fields(data="x"))
    server = await world.rospy_ready("server", service, SET_BOOL)
    listener = await world.rospy_ready("listener", topic, STRING)
    await listener.wait_values("message")
    assert await world.who("publishers", topic) == {"/rospy_talker"}
    assert await world.who("services", service) == {"/rospy_server"}
    for process in (talker, server, listener):
        await process.end()
        assert process.values("shutdown") == [True], process.report()
        assert "rror" not in process.stderr, process.report()
    for name in ("/rospy_talker", "/rospy_server", "/rospy_listener"):
        assert await world.traces(name) == []


async def test_roscpp_says_goodbye(under_ours: World) -> None:
    world = under_ours
    topic = world.unique("chatter")
    listener = await world.roscpp_ready("listener", topic, STRING)
    assert await world.who("subscribers", topic) == {"/roscpp_peer"}
    await listener.end()
    assert await world.traces("/roscpp_peer") == []


async def test_multicall_as_xmlrpc_clients_make_it(under_ours: World) -> None:
    """Each request has its own result, also when one of them fails."""
    import asyncio
    import xmlrpc.client

    world = under_ours

    def ask() -> list[list[object]]:
        with xmlrpc.client.ServerProxy(world.uri) as proxy:
            calls = xmlrpc.client.MultiCall(proxy)
            calls.setParam("/me", "/x", 3)
            calls.getParam("/me", "/x")
            calls.getParam("/me", "/nothing")
            return list(calls())

    results = await asyncio.to_thread(ask)
    assert [result[0] for result in results] == [1, 1, -1]
    assert results[1][2] == 3


async def test_our_node_among_theirs(under_ours: World) -> None:
    """What the graph of our node says is what there is."""
    world = under_ours
    topic, service = world.unique("chatter"), world.unique("flip")
    await world.rospy_ready("talker", topic, STRING, world.fields(data="x"))
    await world.roscpp_ready("server", service)
    async with world.node("ours") as node:
        state = await node.master.get_system_state()
        assert set(dict(state.publishers)[topic]) == {"/rospy_talker"}
        assert set(dict(state.services)[service]) == {"/roscpp_peer"}
        assert (topic, STRING) in [tuple(entry) for entry in await node.master.get_topic_types()]
        for name in ("/rospy_talker", "/roscpp_peer"):
            peer = await node.peer(name)
            assert await peer.get_pid() in [process.pid for process in world.processes]
            await peer.ping()
            await peer.get_bus_stats()
            await peer.get_bus_info()
        # roscpp does not have this one.
        rospy = await node.peer("/rospy_talker")
        assert (await rospy.get_master_uri()).rstrip("/") == world.uri.rstrip("/")


async def test_our_node_shuts_rospy_down(under_ours: World) -> None:
    world = under_ours
    topic = world.unique("chatter")
    talker = await world.rospy_ready("talker", topic, STRING, world.fields(data="x"))
    async with world.node("ours") as node:
        await (await node.peer("/rospy_talker")).shutdown("that is enough")
        result = await talker.wait()
        assert result.code == 0
        await world.wait_no_traces("/rospy_talker")


async def test_rosout_of_rospy_is_aggregated(under_ours: World) -> None:
    world = under_ours
    async with (
        world.node("reader") as reader,
        reader.subscribe("/rosout_agg", "rosgraph_msgs/Log", queue_size=100) as sub,
    ):
        await world.rospy_ready("logger", "the word of the day", "--name", "rospy_logger")
        entries = await take_until(sub, lambda m: m.msg == "the word of the day")
        assert (entries[-1].name, entries[-1].level) == ("/rospy_logger", 4)
