"""The graph, as one of its nodes sees it."""

from __future__ import annotations

import asyncio
import socket

import pytest

import aioros1
from aioros1.graph import GraphNode, GraphSnapshot

SNAPSHOT = GraphSnapshot(
    publishers={"/a": frozenset({"/one", "/two"}), "/alone": frozenset({"/one"})},
    subscribers={"/a": frozenset({"/one", "/ear"}), "/wanted": frozenset({"/ear"})},
    services={"/flip": frozenset({"/two"})},
    topic_types={"/a": "std_msgs/String"},
)


def test_a_snapshot_knows_what_each_node_does():
    assert SNAPSHOT.nodes == {"/one", "/two", "/ear"}
    assert SNAPSHOT.topics == {"/a", "/alone", "/wanted"}
    assert SNAPSHOT.node("/one") == GraphNode(
        frozenset({"/a", "/alone"}), frozenset({"/a"}), frozenset()
    )
    assert SNAPSHOT.node("/two").provides == {"/flip"}
    assert SNAPSHOT.node("/nobody") == GraphNode(frozenset(), frozenset(), frozenset())


def test_edges_are_between_those_who_share_a_topic():
    assert SNAPSHOT.edges == {
        ("/one", "/a", "/one"),
        ("/one", "/a", "/ear"),
        ("/two", "/a", "/one"),
        ("/two", "/a", "/ear"),
    }


async def test_a_snapshot_of_a_living_graph(make_node):
    one, two = await make_node("one"), await make_node("two")
    async with one.advertise("a", "std_msgs/String"), two.subscribe("a"):
        snapshot = await one.graph.snapshot()
        assert snapshot.edges == {("/one", "/a", "/two")}
        assert snapshot.node("/two").subscribes == {"/a"}
    assert (await one.graph.snapshot()).edges == frozenset()


@pytest.mark.parametrize("poll", [0, -1, float("nan")])
async def test_how_often_it_is_looked_at(make_node, poll):
    node = await make_node()
    with pytest.raises(ValueError, match=f"poll: expected a positive number .* got {poll}"):
        node.graph.changes(poll=poll)
    with pytest.raises(ValueError, match="poll"):
        await node.graph.wait_for(lambda graph: True, poll=poll)


async def test_what_a_predicate_raises_is_raised(make_node):
    def predicate(graph):
        raise LookupError("mine")

    node = await make_node()
    with pytest.raises(LookupError, match="mine"):
        await node.graph.wait_for(predicate, timeout=30)


@pytest.fixture
def port():
    with socket.socket() as sock:
        sock.bind(("127.0.0.1", 0))
        return sock.getsockname()[1]


def watcher_at(port):
    return aioros1.Node(
        "watcher",
        master_uri=f"http://localhost:{port}",
        host="localhost",
        heartbeat=0.02,
        rosout=False,
        logger_services=False,
    )


def master_at(port):
    return aioros1.Master(host="localhost", port=port, rosout=False)


async def test_changes_go_on_while_the_master_is_away(port):
    chatter = ("publisher", "/chatter", "/watcher")
    async with watcher_at(port) as node:
        changes = node.graph.changes(poll=0.01)

        async def next_with(part):
            async with asyncio.timeout(30):
                async for change in changes:
                    if chatter in getattr(change, part):
                        return change
            raise AssertionError("it ended")

        # From before there is a master.
        change = asyncio.ensure_future(next_with("added"))
        await asyncio.sleep(0.05)
        async with master_at(port):
            await node.wait_for_master(timeout=30)
            await asyncio.sleep(0.2)  # it has looked once
            role = await node.advertise("chatter", "std_msgs/String")
            await change
        # Without a master nothing is known to have changed.
        change = asyncio.ensure_future(next_with("removed"))
        await asyncio.sleep(0.05)
        assert not change.done()
        await role.close()
        async with master_at(port):
            assert chatter not in (await change).snapshot.publishers
            change = asyncio.ensure_future(next_with("added"))
            await node.advertise("chatter", "std_msgs/String")
            await change
            await node.close()
        assert [change async for change in changes] == []


async def test_waiting_goes_on_while_the_master_is_away(port):
    async with watcher_at(port) as node:
        waiting = asyncio.ensure_future(
            node.graph.wait_for(lambda graph: "/chatter" in graph.topics, timeout=30)
        )
        for _ in range(2):
            async with master_at(port):
                await node.wait_for_master(timeout=30)
            await asyncio.sleep(0.05)
        assert not waiting.done()
        async with master_at(port):
            await node.wait_for_master(timeout=30)
            await node.advertise("chatter", "std_msgs/String")
            assert "/chatter" in (await waiting).topics
            await node.close()


async def test_waiting_in_vain_for_a_master_that_is_away_says_so(port):
    async with watcher_at(port) as node:
        with pytest.raises(TimeoutError) as late:
            await node.graph.wait_for(lambda graph: True, timeout=0.2, poll=0.01)
    assert "the graph did not become as wanted within 0.2 s" in str(late.value)
    assert f"http://localhost:{port}: cannot connect: Connection refused" in str(late.value)


async def test_an_iteration_over_changes_ends_with_the_node_also_without_a_master(port):
    async with watcher_at(port) as node:
        changes = node.graph.changes(poll=0.01)
        waiting = asyncio.ensure_future(anext(changes))
        await asyncio.sleep(0.05)
    with pytest.raises(StopAsyncIteration):
        await waiting
