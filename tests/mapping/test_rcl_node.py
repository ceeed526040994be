"""rcl/node.h: nodes."""

from __future__ import annotations

import asyncio
import dataclasses
import itertools
import os

import pytest

import aioros1
from aioros1.msg.std_msgs import String
from aioros1.srv.std_srvs import Empty


async def test_rcl_node_t(make_node):
    node = await make_node("talker")
    assert isinstance(node, aioros1.Node)
    assert repr(node) == f"<Node /talker at {node.master_uri}, open>"


def test_rcl_get_zero_initialized_node():
    node = aioros1.Node("talker")
    assert (node.state, node.is_open, node.roles, node.connections) == ("new", False, (), ())


async def test_rcl_get_zero_initialized_node_cannot_be_used():
    node = aioros1.Node("talker")
    for use in (
        lambda: node.advertise("chatter", String),
        lambda: node.get_param("rate"),
        lambda: node.call("nothing", Empty),
    ):
        with pytest.raises(aioros1.ClosedError, match="is new, not open"):
            await use()


async def test_rcl_node_init(master):
    async with aioros1.Node("talker", namespace="robot", master_uri=master.uri) as node:
        assert (node.name, node.is_open) == ("/robot/talker", True)


async def test_rcl_node_init_twice_is_an_error(make_node):
    node = await make_node()
    with pytest.raises(RuntimeError, match="was started before"):
        await node.start()


@pytest.mark.parametrize("name", ["", "a/b", "/a", "~a", "a b", "a:b"])
def test_rcl_node_init_with_a_name_that_is_wrong(name):
    with pytest.raises(aioros1.InvalidNameError):
        aioros1.Node(name)


@pytest.mark.parametrize(
    ("namespace", "resolved"),
    [("", "/"), ("/", "/"), ("robot", "/robot"), ("/robot/", "/robot"), ("a/b", "/a/b")],
)
def test_rcl_node_init_normalises_the_namespace(namespace, resolved):
    assert aioros1.Node("talker", namespace=namespace).namespace == resolved


async def test_rcl_node_init_of_a_name_that_is_taken(make_node):
    """The master ends the older one, which knows why."""
    older = await make_node("talker")
    await older.advertise("chatter", String)
    newer = await make_node("talker")
    await newer.advertise("chatter", String)
    reason = await asyncio.wait_for(older.wait_closed(), 30)
    assert "new node registered with same name" in reason
    assert older.close_reason == reason
    assert newer.is_open


async def test_rcl_node_fini(make_node):
    node = await make_node()
    pub = await node.advertise("chatter", String)
    sub = await node.subscribe("chatter", String)
    await node.close()
    assert [node.is_open, pub.is_open, sub.is_open] == [False] * 3
    with pytest.raises(aioros1.ClosedError, match=r"the node was closed \(closed\)"):
        pub.publish(data="late")
    assert [message async for message in sub] == []


async def test_rcl_node_fini_of_one_that_was_never_started():
    node = aioros1.Node("talker")
    await node.close()
    assert node.state == "closed"


async def test_rcl_node_is_valid(master):
    node = aioros1.Node("talker", master_uri=master.uri)
    assert (node.state, node.is_open) == ("new", False)
    await node.start()
    assert (node.state, node.is_open) == ("open", True)
    await node.close()
    assert (node.state, node.is_open) == ("closed", False)


async def test_rcl_node_is_valid_except_context(master):
    """When the loop is about to end: everything is dropped, without asking anybody."""
    node = aioros1.Node("talker", master_uri=master.uri)
    await node.start()
    pub = await node.advertise("chatter", String)
    node.abort()
    assert node.state == "closed"
    assert not pub.is_open
    assert await asyncio.wait_for(node.wait_closed(), 30) == "aborted"


async def test_rcl_node_get_name(make_node):
    assert (await make_node("talker", namespace="robot")).base_name == "talker"


async def test_rcl_node_get_namespace(make_node):
    assert (await make_node("talker", namespace="robot")).namespace == "/robot"


async def test_rcl_node_get_fully_qualified_name(make_node):
    node = await make_node("talker", namespace="robot")
    assert node.name == "/robot/talker"
    async with node.advertise("chatter", String):
        assert await node.master.lookup_node("/robot/talker") == node.uri


async def test_rcl_node_get_options(make_node):
    node = await make_node(heartbeat=2.0, timeouts=aioros1.Timeouts(close=1.0))
    assert (node.options.heartbeat, node.options.timeouts.close) == (2.0, 1.0)
    assert node.options.rosout is False
    with pytest.raises(dataclasses.FrozenInstanceError):
        node.options.heartbeat = 3.0


async def test_rcl_node_get_domain_id_is_the_master_and_its_run_id(master, make_node):
    """ROS 1 has no domains: what separates graphs is their masters."""
    node = await make_node()
    async with (
        aioros1.Master(host="localhost", port=0) as elsewhere,
        aioros1.Node("node", master_uri=elsewhere.uri, rosout=False) as stranger,
    ):
        assert node.run_id == master.run_id
        assert stranger.run_id == elsewhere.run_id != node.run_id
        assert stranger.master_uri != node.master_uri


async def test_rcl_node_assert_liveliness_is_a_ping_by_others(pair):
    """ROS 1 has no liveliness to assert: whoever wants to know asks."""
    talker, listener = pair
    await talker.advertise("chatter", String)
    peer = await listener.peer("/talker")
    assert await peer.ping() > 0
    await talker.close()
    with pytest.raises(aioros1.PeerUnreachable):
        await peer.ping()


async def test_rcl_node_assert_liveliness_of_the_master(make_node):
    node = await make_node(heartbeat=None)
    before = node.master.last_seen
    assert await node.master.ping() > 0
    assert node.master.last_seen >= before


async def test_rcl_node_get_rmw_handle(make_node):
    """What is below a node are two ports, of its slave API and of TCPROS."""
    node = await make_node()
    for host, port in (("127.0.0.1", int(node.uri.split(":")[2][:-1])), node.tcpros_address):
        _, writer = await asyncio.open_connection(host, port)
        writer.close()
        await writer.wait_closed()


async def test_rcl_node_get_rcl_instance_id_is_the_uri_and_the_pid(pair):
    """Of two runs of a node, no two have the same."""
    first, second = pair
    assert first.uri != second.uri
    assert first.pid == second.pid == os.getpid()


async def test_rcl_node_get_graph_guard_condition(pair):
    talker, listener = pair
    changes = listener.graph.changes(poll=0.01)
    watching = asyncio.create_task(anext(changes))
    async with asyncio.timeout(30):
        # What is there already is no change: wait until the watcher has looked once.
        numbers = itertools.count()
        while not watching.done():
            await talker.advertise(f"chatter{next(numbers)}", String)
        change = await watching
        assert {(kind, node) for kind, _, node in change.added} == {("publisher", "/talker")}
        assert change.removed == frozenset()
        for _, topic, _ in change.added:
            assert change.snapshot.publishers[topic] == {"/talker"}
        await changes.aclose()


async def test_rcl_node_get_graph_guard_condition_to_wait_for_something(pair):
    talker, listener = pair
    waiting = asyncio.create_task(
        listener.graph.wait_for(
            lambda graph: "/chatter" in graph.topics and "/nothing" in graph.services,
            timeout=30,
            poll=0.01,
        )
    )
    await talker.advertise("chatter", String)
    await talker.advertise_service("nothing", Empty, lambda request: None)
    graph = await waiting
    assert graph.nodes >= {"/talker"}
    with pytest.raises(TimeoutError, match="did not become as wanted"):
        await listener.graph.wait_for(lambda graph: False, timeout=0.02)


async def test_rcl_node_get_logger_name(make_node):
    node = await make_node("talker", namespace="robot")
    assert node.log.logger.name == "ros.robot.talker"
