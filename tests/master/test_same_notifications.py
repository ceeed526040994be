"""The same changes at rosmaster and at ours: the same nodes are told the same."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from typing import Any

import pytest

from aioros1.master import Master
from aioros1.xmlrpc.client import XmlRpcClient

pytestmark = pytest.mark.interop

NOBODY = "http://127.0.0.1:1/"
SYNC = "/sync"

# What is asked, and where ours is meant to tell something else: what, to whom.
# {a} and {b} are the URIs of the nodes /a and /b.
Step = tuple[list[Any], dict[str, list[Any]] | None]

STEPS: list[Step] = [
    # Keys that are not set are followed.
    (["subscribeParam", "/a", "{a}", "/q/r"], None),
    (["subscribeParam", "/b", "{b}", "/q/"], None),
    # A value, and the same value again.
    (["setParam", "/c", "/q/r", 1], None),
    (["setParam", "/c", "/q/r", 1], None),
    # A child of the key.
    (["setParam", "/c", "/q/r/c", 5], None),
    (["setParam", "/c", "/q/r/c/d/e", [1]], None),
    # A parent of the key; without the key, its followers are told {}.
    (["setParam", "/c", "/q", {"r": {"x": 1}, "s": 2}], None),
    (["setParam", "/c", "/q", {"s": 2}], None),
    (["setParam", "/c", "/q", {}], None),
    # Keys that only begin alike.
    (["setParam", "/c", "/q/rr", 1], None),
    (["setParam", "/c", "/qq", 1], None),
    # A node is not told what it sets itself.
    (["setParam", "/a", "/q/r", 3], None),
    (["setParam", "/a", "/q", {"r": 4}], None),
    (["setParam", "/b", "/q", {"r": 4}], None),
    # A parent of the key; without the key, its followers are told {}.
    (["deleteParam", "/c", "/q/r"], None),
    (["deleteParam", "/a", "/q"], None),
    (["setParam", "/c", "/q", {"r": 1}], None),
    # rosmaster leaves /a with the value of a parameter that is gone.
    (["setParam", "/c", "/q", 5], {"/a": ["paramUpdate", "/master", "/q/r/", {}]}),
    # A node that has stopped following is not told.
    (["unsubscribeParam", "/b", "{b}", "/q"], None),
    (["setParam", "/c", "/q/r", 6], None),
    # Subscribers are told of every registration, of a repeated one too.
    (["registerSubscriber", "/a", "/t", "a/T", "{a}"], None),
    (["registerSubscriber", "/b", "/t", "a/T", "{b}"], None),
    (["registerPublisher", "/p", "/t", "a/T", "http://p:1/"], None),
    (["registerPublisher", "/p", "/t", "a/T", "http://p:1/"], None),
    (["registerPublisher", "/p2", "/t", "a/T", "http://p2:1/"], None),
    # Nobody is told of what changes nothing.
    (["unregisterPublisher", "/nobody", "/t", "http://p:1/"], None),
    # The list is sent when publishers leave, the empty one too.
    (["unregisterPublisher", "/p", "/t", "http://p:1/"], None),
    (["unregisterPublisher", "/p2", "/t", "http://p2:1/"], None),
    # rosmaster ends whoever is at the address where a node was before.
    (["registerPublisher", "/dup", "/t", "a/T", "{b}"], None),
    # rosmaster does not tell subscribers that the old node's publications are gone.
    (
        ["registerPublisher", "/dup", "/other", "a/T", NOBODY],
        {node: ["publisherUpdate", "/master", "/t", []] for node in ("/a", "/b")},
    ),
]  # fmt: skip


async def test_notifications_are_those_of_rosmaster(
    rosmaster: str, make_node: Callable[[str], Awaitable[Any]]
) -> None:
    async with Master("127.0.0.1", port=0, rosout=False) as ours:
        expected = await _told(rosmaster, make_node)
        got = await _told(ours.uri, make_node)
    different = []
    for (request, extra), theirs, mine in zip(STEPS, expected, got, strict=True):
        # Another node is registered at that address as well, so ours ends none there.
        theirs["/b"] = [told for told in theirs["/b"] if told[0] != "shutdown"]
        for node, told in (extra or {}).items():
            theirs[node].append(told)
            theirs[node].sort(key=repr)
        if theirs != mine:
            different.append(f"{request}:\n    {theirs}\n    {mine}")
    assert not different, "\n".join(different)


async def _told(uri: str, make_node: Callable[[str], Awaitable[Any]]) -> list[dict[str, list[Any]]]:
    """What each node was told at each step; the URIs replaced by names."""
    client = XmlRpcClient()
    nodes = {name: await make_node(name) for name in ("/a", "/b")}
    uris = {f"{{{name[1:]}}}": node.uri for name, node in nodes.items()}

    for name, node in nodes.items():
        # Another name, so that the node is not spared what it sets itself.
        await client.call(uri, "subscribeParam", f"{name}_sync", node.uri, SYNC)
    results = []
    for number, (request, _) in enumerate(STEPS):
        answer = await client.call(
            uri, *[uris.get(word, word) if isinstance(word, str) else word for word in request]
        )
        assert answer[0] == 1, (request, answer)
        await client.call(uri, "setParam", "/c", SYNC, number)
        end = ("paramUpdate", "/master", SYNC + "/", number)
        step = {}
        for name, node in nodes.items():
            await node.until(lambda node=node, end=end: node.told[-1:] == [end])
            step[name] = sorted((_named(entry, uris) for entry in node.told[:-1]), key=repr)
            node.told.clear()
        results.append(step)
    await client.close()
    return results


def _named(value: Any, uris: dict[str, str]) -> Any:
    if isinstance(value, list | tuple):
        return [_named(item, uris) for item in value]
    return next((name for name, uri in uris.items() if uri == value), value)
