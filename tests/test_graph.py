"""The graph, as one of its nodes sees it."""

from __future__ import annotations

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
