"""What a node is called, where it is, why it ends."""

from __future__ import annotations

import asyncio
import os
import sys

import pytest

import aioros1
from aioros1.msg.std_msgs import String


def test_the_constructor_does_no_io():
    node = aioros1.Node("demo", master_uri="http://localhost:9")
    assert node.state == "new"
    assert not node.is_open


@pytest.mark.parametrize("name", ["", "a/b", "/abs", "~private", "with blank", "a:b"])
def test_a_bad_node_name_is_refused_by_name(name):
    with pytest.raises(aioros1.InvalidNameError, match="node name") as caught:
        aioros1.Node(name)
    assert repr(name) in str(caught.value)


@pytest.mark.parametrize("uri", ["localhost:11311", "https://localhost:1", "http://", "http://h:x"])
def test_a_bad_master_uri_is_refused_by_name(uri):
    with pytest.raises(ValueError, match="expected http://host:port") as caught:
        aioros1.Node("demo", master_uri=uri)
    assert repr(uri) in str(caught.value)


@pytest.mark.parametrize(
    ("options", "name"),
    [
        ({}, "/demo"),
        ({"namespace": "robot"}, "/robot/demo"),
        ({"namespace": "/robot/"}, "/robot/demo"),
        ({"argv": ["__ns:=/fleet/a"]}, "/fleet/a/demo"),
        ({"argv": ["__name:=other", "--flag", "rest"]}, "/other"),
        ({"argv": ["__name:=other"], "anonymous": True}, "/other"),
    ],
)
def test_names_come_from_arguments_then_the_command_line(options, name):
    assert aioros1.Node("demo", **options).name == name


def test_the_environment_counts_least(monkeypatch):
    monkeypatch.setenv("ROS_NAMESPACE", "fleet")
    monkeypatch.setenv("ROS_MASTER_URI", "http://elsewhere:1234")
    assert aioros1.Node("demo").name == "/fleet/demo"
    assert aioros1.Node("demo").master_uri == "http://elsewhere:1234"
    node = aioros1.Node("demo", argv=["__master:=http://there:1", "__ns:=/x"])
    assert (node.name, node.master_uri) == ("/x/demo", "http://there:1")
    node = aioros1.Node("demo", namespace="y", master_uri="http://here:2", argv=["__ns:=/x"])
    assert (node.name, node.master_uri) == ("/y/demo", "http://here:2")


def test_anonymous_names_differ():
    names = {aioros1.Node("demo", anonymous=True).name for _ in range(50)}
    assert len(names) == 50
    assert all(name.startswith("/demo_") for name in names)


@pytest.mark.parametrize(
    ("given", "resolved"),
    [
        ("scan", "/robot/laser"),
        ("/robot/scan", "/robot/laser"),
        ("~rate", "/robot/demo/speed"),
        ("/abs", "/abs"),
        ("other", "/robot/other"),
        ("~other", "/robot/demo/other"),
        ("image", "/camera/image"),
    ],
)
def test_names_are_resolved_and_remapped(given, resolved):
    node = aioros1.Node(
        "demo",
        namespace="/robot",
        argv=["scan:=laser", "~rate:=~speed"],
        remap={"image": "/camera/image"},
    )
    assert node.resolve_name(given) == resolved


async def test_roles_are_remapped(make_node):
    talker = await make_node("talker", argv=["chatter:=/elsewhere"])
    listener = await make_node("listener", namespace="ns", remap={"/ns/heard": "/elsewhere"})
    async with talker.advertise("chatter", String) as pub, listener.subscribe("heard") as sub:
        assert pub.name == sub.name == "/elsewhere"
        await pub.wait_for_subscribers(timeout=30)
        pub.publish(data="found")
        assert (await sub.get(timeout=30)).data == "found"


async def test_private_parameters_of_the_command_line_are_set(make_node):
    node = await make_node("demo", argv=["_rate:=10", "_name:=bob", "_flags:=[a, 2]"])
    assert await node.get_param("~") == {"rate": 10, "name": "bob", "flags": ["a", 2]}


async def test_addresses_are_those_others_can_reach(make_node):
    node = await make_node("demo", host=None)
    # The master is told as localhost, so that is what faces it.
    assert node.host == "localhost"
    assert node.uri == f"http://localhost:{node.uri.rsplit(':', 1)[1]}"
    assert node.tcpros_address == ("localhost", node.tcpros_address[1])
    async with node.advertise("chatter", String):
        assert await node.master.lookup_node("/demo") == node.uri


async def test_ros_hostname_and_ros_ip_are_advertised(monkeypatch, make_node):
    monkeypatch.setenv("ROS_IP", "127.0.0.1")
    assert (await make_node("by_ip", host=None)).host == "127.0.0.1"
    monkeypatch.setenv("ROS_HOSTNAME", "localhost")
    assert (await make_node("by_name", host=None)).host == "localhost"


@pytest.mark.parametrize("bind", ["127.0.0.1", "0.0.0.0"])
async def test_no_wildcard_address_is_ever_advertised(make_node, bind):
    node = await make_node("demo", host=None, bind=bind)
    assert "0.0.0.0" not in node.uri


@pytest.mark.skipif(sys.platform != "linux", reason="needs a second loopback address")
async def test_the_one_address_that_is_listened_on_is_told(make_node):
    node = await make_node("demo", host=None, bind="127.0.0.2")
    assert (node.host, node.tcpros_address[0]) == ("127.0.0.2", "127.0.0.2")
    listener = await make_node("listener")
    async with node.advertise("chatter", String, latch=True) as pub:
        pub.publish(data="hi")
        assert (await listener.wait_for_message("chatter", String, timeout=30)).data == "hi"
    with pytest.raises(ConnectionRefusedError):
        await asyncio.open_connection("127.0.0.1", node.tcpros_address[1])
    told = await make_node("told", host="localhost", bind="0.0.0.0")
    assert told.host == "localhost"


async def test_ports_can_be_chosen(make_node):
    first = await make_node("first")
    xmlrpc, tcpros = int(first.uri.rstrip("/").rsplit(":", 1)[1]), first.tcpros_address[1]
    await first.close()
    second = await make_node("second", xmlrpc_port=xmlrpc, tcpros_port=tcpros)
    assert second.tcpros_address[1] == tcpros
    assert second.uri == first.uri
    with pytest.raises(OSError, match=str(tcpros)):
        await make_node("third", tcpros_port=tcpros)


async def test_shutdown_by_another_node_ends_everything_cleanly_and_keeps_the_reason(make_node):
    victim, killer = await make_node("victim"), await make_node("killer")
    sub = await victim.subscribe("chatter", String)
    provider = await victim.advertise_service("flip", "std_srvs/SetBool")
    events = victim.events()

    async def drain(iterator):
        return [item async for item in iterator]

    loops = [asyncio.create_task(drain(each)) for each in (sub, provider, events)]
    getting = asyncio.create_task(sub.get())
    await asyncio.sleep(0)
    await (await killer.peer("victim")).shutdown("no longer needed")
    assert await victim.wait_closed() == "[/killer] no longer needed"
    assert (await asyncio.gather(*loops))[:2] == [[], []]
    with pytest.raises(aioros1.ClosedError, match="no longer needed"):
        await getting
    with pytest.raises(aioros1.ClosedError, match="no longer needed"):
        await victim.advertise("chatter", String)
    state = await killer.master.get_system_state()
    assert not any(state)


async def test_a_second_node_of_the_same_name_ends_the_first(make_node):
    first = await make_node("twin")
    await first.advertise("chatter", String)
    second = await make_node("twin")
    pub = await second.advertise("chatter", String)
    assert "new node registered with same name" in await first.wait_closed()
    assert (await second.master.get_system_state()).publishers == {"/chatter": ["/twin"]}
    assert pub.is_open


async def test_events_tell_what_happens(make_node):
    node = await make_node()
    events = node.events()
    async with node.advertise("chatter", String) as pub, node.subscribe("chatter"):
        await pub.wait_for_subscribers(timeout=30)
        await node.subscribe_param("/p", default=0)
        await node.set_param("/p", 7)
    await node.close()
    seen = [event async for event in events]
    assert aioros1.RoleRegistered("publisher", "/chatter") in seen
    assert aioros1.RoleUnregistered("subscriber", "/chatter") in seen
    assert aioros1.ParamUpdate("/p", 7) in seen
    connected = [event for event in seen if isinstance(event, aioros1.PeerConnected)]
    assert {(event.kind, event.connection.direction) for event in connected} == {
        ("publisher", "o"),
        ("subscriber", "i"),
    }
    assert len([event for event in seen if isinstance(event, aioros1.PeerDisconnected)]) == 2


async def test_connections_and_stats_count_both_sides(make_node):
    talker, listener = await make_node("talker"), await make_node("listener")
    async with talker.advertise("chatter", String) as pub, listener.subscribe("chatter") as sub:
        await pub.wait_for_subscribers(timeout=30)
        for number in range(3):
            pub.publish(data=str(number))
        for _ in range(3):
            await sub.get(timeout=30)
        (out,), (into,) = pub.connections, sub.connections
        assert (out.peer, out.direction) == ("/listener", "o")
        assert (into.peer, into.direction) == (talker.uri, "i")
        assert into.header["callerid"] == "/talker"
        assert out.local == into.remote
        assert out.stats.messages == into.stats.messages == 3
        assert out.stats.bytes == into.stats.bytes == 3 * (4 + 4 + 1)
        assert pub.stats.messages == sub.stats.messages == 3
        assert talker.stats.connections == 1
        assert talker.connections == (out,)


async def test_a_callback_that_fails_ends_the_node_and_is_raised_where_it_is_used(master):
    def broken(now):
        raise LookupError("from the timer")

    with pytest.raises(LookupError, match="from the timer"):
        async with aioros1.Node("demo", master_uri=master.uri, host="localhost") as node:
            node.timer(0.001, broken)
            await asyncio.sleep(30)
    assert node.state == "closed"
    with pytest.raises(LookupError):
        await node.wait_closed()


async def test_a_callback_that_fails_is_logged_or_handed_over_if_asked(make_node, caplog):
    def broken(now):
        raise LookupError("from the timer")

    errors: asyncio.Queue[Exception] = asyncio.Queue()
    node = await make_node("handed", on_error=errors.put_nowait)
    node.timer(0.001, broken)
    assert isinstance(await errors.get(), LookupError)
    logged = await make_node("logged", on_error="log")
    logged.timer(0.001, broken)
    while "from the timer" not in caplog.text:
        await asyncio.sleep(0.001)
    assert logged.is_open


async def test_wait_for_message(make_node):
    node = await make_node()
    async with node.advertise("chatter", String, latch=True) as pub:
        pub.publish(data="latched")
        assert (await node.wait_for_message("chatter", timeout=30)).data == "latched"
    with pytest.raises(TimeoutError, match="/silent"):
        await node.wait_for_message("silent", String, timeout=0.05)


async def test_graph_snapshot_and_changes(make_node):
    node = await make_node("watcher")
    async with node.advertise("chatter", String):
        graph = await node.graph.wait_for(lambda graph: "/chatter" in graph.topics, timeout=30)
        assert graph.topic_types["/chatter"] == "std_msgs/String"
        assert graph.nodes == {"/watcher"}
        assert graph.publishers == {"/chatter": {"/watcher"}}
        changes = node.graph.changes(poll=0.001)
        following = asyncio.ensure_future(anext(changes))
        number = 0
        while not following.done():  # it may look for the first time only after some
            number += 1
            async with node.subscribe(f"topic{number}"):
                await node.graph.snapshot()
        change = following.result()
        ((kind, name, who),) = change.added or change.removed
        assert (kind, who) == ("subscriber", "/watcher")
        assert (name in change.snapshot.subscribers) == bool(change.added)
    await changes.aclose()


async def test_events_that_are_not_taken_are_counted(make_node):
    node = await make_node()
    slow, quick = node.events(), node.events()
    taken = []
    async with node.advertise("first", String):
        pass
    while len(taken) < 1002:
        async with node.advertise("chatter", String):
            taken += [await anext(quick) for _ in range(2)]
    await node.close()
    missed = [event async for event in slow]
    assert (len(missed), quick.dropped) == (1000, 0)
    everything = taken + [event async for event in quick]
    assert slow.dropped == len(everything) - 1000
    assert missed == everything[-1000:]


async def test_pid_run_id_and_options(make_node, master):
    node = await make_node("demo")
    assert node.pid == os.getpid()
    assert node.run_id == master.run_id
    assert node.options.host == "localhost"
    assert (node.base_name, node.namespace) == ("demo", "/")
