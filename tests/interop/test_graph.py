"""What our node sees of rospy's and roscpp's, and what rosnode sees of the same graph."""

from __future__ import annotations

import asyncio
import json
from typing import Any

import pytest

import aioros1

from . import debian
from .ours import take
from .processes import Process, until
from .world import PEERS, World

STRING = "std_msgs/String"
SET_BOOL = "std_srvs/SetBool"
EMPTY: frozenset[str] = frozenset()


async def talker(world: World, client: str, topic: str) -> tuple[str, Process]:
    """The name and the process of a node of another library that publishes."""
    if client == "rospy":
        fields = world.fields(data="x")
        return "/rospy_talker", await world.rospy_ready("talker", topic, STRING, fields)
    words = (topic, STRING, "1000000", "100", "0", "__name:=cpp_talker")
    return "/cpp_talker", await world.roscpp_ready("talker", *words)


async def test_a_snapshot_is_what_rosnode_lists(under_each: World) -> None:
    world = under_each
    topic, service = world.unique("chatter"), world.unique("flip")
    async with (
        world.node("ours") as node,
        node.subscribe(topic, STRING),
        node.advertise_service(world.unique("mine"), SET_BOOL, lambda request: None) as provider,
    ):
        await talker(world, "rospy", topic)
        await talker(world, "roscpp", topic)
        await world.roscpp_ready("server", service, "", "__name:=cpp_server")

        def is_complete(graph: aioros1.graph.GraphSnapshot) -> bool:
            return graph.nodes >= {"/ours", "/rospy_talker", "/cpp_talker", "/cpp_server"}

        snapshot = await node.graph.wait_for(is_complete, timeout=15)
        listed = (await world.run("rosnode", "list")).stdout.split()
        assert snapshot.nodes == set(listed)
        # Each node's address as well, as the master and our peers know it.
        rows = (await world.run("rosnode", "list", "-a")).stdout.splitlines()
        addresses = {name.strip(): uri.strip() for uri, name in (row.split("\t") for row in rows)}
        assert addresses["/ours"] == node.uri
        for name in ("/rospy_talker", "/cpp_talker", "/cpp_server"):
            assert addresses[name] == (await node.peer(name)).uri
        assert snapshot.topic_types[topic] == STRING
        assert {edge for edge in snapshot.edges if edge[1] == topic} == {
            ("/rospy_talker", topic, "/ours"),
            ("/cpp_talker", topic, "/ours"),
        }
        assert service in snapshot.node("/cpp_server").provides
        assert snapshot.node("/ours").provides >= {provider.name}
        for name in ("/ours", "/rospy_talker", "/cpp_server"):
            seen = snapshot.node(name)
            info = (await world.run("rosnode", "info", name)).stdout.split("contacting node")[0]
            parts = [part.split("\n\n")[0] for part in info.split("Publications:")[1:]]
            publications = {line.split()[1] for line in parts[0].splitlines() if " * " in line}
            assert publications == seen.publishes
            assert {f" * {each}" for each in seen.provides} <= set(info.splitlines())
        ping = (await world.run("rosnode", "ping", "-a")).stdout
        assert f"xmlrpc reply from {node.uri}" in ping.replace("pinging", "")


async def test_edges_are_those_of_rqt_graph(under_each: World) -> None:
    """It draws what rosgraph has found out from the connections that each node tells."""
    world = under_each
    topic, other = world.unique("chatter"), world.unique("other")

    async def edges() -> tuple[set[tuple[str, ...]], list[str]]:
        record = json.loads((await world.run(debian.PYTHON, str(PEERS / "graph.py"))).stdout)
        found = {tuple(edge) for edge in record["edges"]}
        return {edge for edge in found if edge[1] in (topic, other)}, record["unreachable"]

    async with (
        world.node("one") as one,
        world.node("two") as two,
        one.advertise(other, STRING) as pub,
        one.subscribe(topic, STRING) as sub,
        two.subscribe(topic, STRING),
        two.subscribe(other, STRING),
        one.subscribe(other, STRING),
    ):
        name, process = await talker(world, "rospy", topic)
        await world.rospy_ready("listener", other, STRING)
        await pub.wait_for_subscribers(3, timeout=15)
        await take(sub, 1)
        mine = {edge for edge in (await one.graph.snapshot()).edges if edge[1] in (topic, other)}
        assert len(mine) == 5

        async def agrees() -> bool:
            return await edges() == (mine, [])

        await until(agrees, what=f"rosgraph to see {mine}")
        await process.kill()  # the master is told nothing
        assert (await one.graph.snapshot()).edges >= mine
        assert (await edges())[1] == [name]


async def peer_event(events: Any, kind: type[Any], topic: str) -> Any:
    """The next such event of a topic: under our master, somebody listens to /rosout as well."""
    async with asyncio.timeout(15):
        async for event in events:
            if isinstance(event, kind) and event.name == topic:
                return event
    raise AssertionError("the events have ended")


@pytest.mark.parametrize("client", ["rospy", "roscpp"])
async def test_changes_and_events(under_each: World, client: str) -> None:
    world = under_each
    topic = world.unique("chatter")
    async with world.node("ours") as node, node.subscribe(topic, STRING) as sub:
        events = node.events()
        changes = node.graph.changes(poll=0.05)
        coming = asyncio.ensure_future(anext(changes))
        await asyncio.sleep(0)
        await node.graph.snapshot()
        name, process = await talker(world, client, topic)

        async def wait(kind: str) -> None:
            nonlocal coming
            async with asyncio.timeout(15):
                while ("publisher", topic, name) not in getattr(await coming, kind):
                    coming = asyncio.ensure_future(anext(changes))
            coming = asyncio.ensure_future(anext(changes))

        await wait("added")
        event = await peer_event(events, aioros1.PeerConnected, topic)
        connection = event.connection
        assert (event.kind, connection.direction) == ("subscriber", "i")
        # rospy and roscpp say who they are and what they send.
        header = connection.header
        assert (header["callerid"], header["type"]) == (name, STRING)
        assert header["md5sum"] == aioros1.load_msg(STRING)._md5sum
        assert header["latching"] == "0"
        assert sub.connections == (connection,)
        await until(lambda: connection.stats.messages > 0, what="a message to be counted")
        await process.end()
        await wait("removed")
        event = await peer_event(events, aioros1.PeerDisconnected, topic)
        assert event.connection == connection
        coming.cancel()
        await asyncio.wait({coming})


@pytest.mark.parametrize("client", ["rospy", "roscpp"])
async def test_a_peer_of_theirs(under_each: World, client: str) -> None:
    world = under_each
    topic = world.unique("chatter")
    async with world.node("ours") as node, node.subscribe(topic, STRING) as sub:
        name, process = await talker(world, client, topic)
        await sub.get(timeout=15)
        peer = await node.peer(name)
        assert await peer.get_pid() == process.pid
        if client == "rospy":
            assert (await peer.get_master_uri()).rstrip("/") == world.uri.rstrip("/")
        else:
            with pytest.raises(aioros1.PeerError, match="unknown method"):
                await peer.get_master_uri()
        assert await peer.ping() > 0
        assert (topic, STRING) in await peer.get_publications()
        if client == "roscpp":
            assert isinstance(await peer.get_subscriptions(), list)
        (row,) = [row for row in await peer.get_bus_info() if row.topic == topic]
        assert (row.destination, row.direction, row.transport) == ("/ours", "o", "TCPROS")
        assert row.connected

        async def counted() -> Any:
            stats = (await peer.get_bus_stats()).publish
            (of_topic,) = [each for each in stats if each.topic == topic]
            return [each for each in of_topic.connections if each.num_sent and each.bytes_sent]

        (theirs,) = await until(counted, what="what was sent to be counted")
        # Both ends of one connection count the same messages, some of them on their way.
        (ours,) = (await (await node.peer("/ours")).get_bus_stats()).subscribe
        assert ours.topic == topic
        (received,) = ours.connections
        assert received.num_received > 0
        assert theirs.num_sent > 0

        await peer.shutdown("that is enough")
        await process.wait()
        await world.wait_no_traces(name)
        with pytest.raises(aioros1.PeerUnreachable):
            await peer.get_pid()
