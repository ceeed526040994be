"""The graph, as one of its nodes sees it."""

from __future__ import annotations

import pytest

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
