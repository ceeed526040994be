"""Strings of every kind in parameters, between all who set and read them."""

from __future__ import annotations

import json
from typing import Any

import pytest

from .processes import Process
from .world import World

TEXTS = [
    *("line\r\nend\r", "\r", "\r\n", "\n", "\t", " ", "  a  ", "", "a]]>b", "]]>", "<a href='x'>"),
    *("&amp;", "&#13;", "&lt;", "a & b < c > d", "'\"", "&", "\\r", "</string>", "%41"),
    *("<![CDATA[x]]>", "<!-- x -->", "&apos;&quot;", "-" * 70_000 + "\r", "\x7f\x80\x85"),
    "tä€😀\u2028",
]


async def rospy_call(params: Process, *call: Any) -> Any:
    count = len(params.values("result"))
    params.tell(json.dumps(call))
    return (await params.wait_values("result", count + 1))[-1]


async def roscpp_get(params: Process, key: str) -> str:
    """What roscpp reads: it takes bytes for text."""
    count = len(params.values("result"))
    params.tell(f"get {key}")
    text: str = (await params.wait_values("result", count + 1))[-1]
    return text.encode("latin-1").decode()


async def test_what_we_set_is_what_all_read(under_each: World) -> None:
    world = under_each
    key = world.unique("text")
    rospy = await world.rospy_ready("params", "--anonymous")
    roscpp = await world.roscpp_ready("param_setter")
    async with world.node("ours") as node, world.node("reader") as reader:
        for number, text in enumerate(TEXTS):
            await node.set_param(f"{key}{number}", text)
            assert await reader.get_param(f"{key}{number}") == text
            assert await roscpp_get(roscpp, f"{key}{number}") == text
            # rosmaster sends carriage returns to rospy in a way that XML does not keep.
            read = await rospy_call(rospy, "get", f"{key}{number}")
            assert read == (plain(text) if world.kind == "rosmaster" else text)


async def test_what_others_set_is_what_we_read(under_each: World) -> None:
    world = under_each
    key = world.unique("text")
    rospy = await world.rospy_ready("params", "--anonymous")
    roscpp = await world.roscpp_ready("param_setter")
    is_rosmaster = world.kind == "rosmaster"
    async with world.node("ours") as node, node.subscribe_param(key, default="") as psub:
        for text in TEXTS:
            await rospy_call(rospy, "set", key, text)
            expected = plain(text) if is_rosmaster else text
            assert await node.get_param(key) == expected
            assert await roscpp_get(roscpp, key) == expected
            await psub.wait_for(lambda value, expected=expected: value == expected, timeout=20)
        roscpp.tell(f"text {key} a\\r\\rb\\r &<>")
        await psub.wait_for(
            lambda value: value == ("a\n\nb\n &<>" if is_rosmaster else "a\r\rb\r &<>"), timeout=20
        )


async def test_tables_and_their_names(under_each: World) -> None:
    world = under_each
    key = world.unique("table")
    table = {"a>b": "1\r\n2", "c'\"": ["\r", "x"], "d\r": {"e": "]]>"}, "é": 1}
    rospy = await world.rospy_ready("params", "--anonymous")
    async with world.node("ours") as node, world.node("reader") as reader:
        await node.set_param(key, table)
        assert await reader.get_param(key) == table
        if world.kind != "rosmaster":
            assert await rospy_call(rospy, "get", key) == table


@pytest.mark.parametrize("text", ["a\r\nb", "\r", "plain"])
async def test_updates_of_a_string_reach_the_caches_of_others(under_ours: World, text: str) -> None:
    world = under_ours
    key = world.unique("cached")
    rospy = await world.rospy_ready("params", "--anonymous")
    async with world.node("ours") as node, node.subscribe_param(key, default=None) as psub:
        await node.set_param(key, "first")
        assert await rospy_call(rospy, "get_cached", key) == "first"
        async with world.node("other") as other:
            await other.set_param(key, text)
            await psub.wait_for(lambda value: value == text, timeout=20)


def plain(text: str) -> str:
    """What an XML parser makes of carriage returns that stand for themselves."""
    return text.replace("\r\n", "\n").replace("\r", "\n")
