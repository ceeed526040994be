"""Parameters: rosparam, rospy and roscpp under our master, our node under rosmaster."""

from __future__ import annotations

import json
from typing import Any

import pytest

from .ours import take_until
from .processes import Process, until
from .world import World


async def rospy_call(params: Process, *call: Any) -> Any:
    """One operation of the rospy program ``params``; its result."""
    count = len(params.values("result"))
    params.tell(json.dumps(call))
    return (await params.wait_values("result", count + 1))[-1]


async def test_rosparam_set_get_list_delete(under_each: World) -> None:
    world = under_each
    base = world.unique("base")
    async with world.node("ours") as node:
        await world.run("rosparam", "set", f"{base}/number", "42")
        await world.run("rosparam", "set", f"{base}/table", "{a: 1, b: [x, y], c: {d: 0.5}}")
        assert await node.get_param(f"{base}/number") == 42
        assert await node.get_param(f"{base}/table") == {"a": 1, "b": ["x", "y"], "c": {"d": 0.5}}

        await node.set_param(f"{base}/ours", {"text": "tä", "flag": True, "real": 1.5})
        text = (await world.run("rosparam", "get", f"{base}/ours")).stdout
        assert await world.parse_yaml(text) == {"text": "tä", "flag": True, "real": 1.5}
        listed = (await world.run("rosparam", "list", base)).stdout.split()
        assert set(listed) == {
            f"{base}/{key}"
            for key in (
                *("number", "table/a", "table/b", "table/c/d"),
                *("ours/text", "ours/flag", "ours/real"),
            )
        }
        assert set(listed) <= set(await node.get_param_names())

        await world.run("rosparam", "delete", f"{base}/table")
        assert not await node.has_param(f"{base}/table")
        with pytest.raises(KeyError):
            await node.get_param(f"{base}/table")
        failed = await world.run("rosparam", "get", f"{base}/table", code=None)
        assert failed.code != 0
        assert "not set" in failed.text


async def test_rosparam_dump_and_load(under_ours: World) -> None:
    world = under_ours
    base = world.unique("base")
    value = {"list": [1, 2.5, "x", True], "deep": {"er": {"est": "ende"}}, "text": "a: b\n#c"}
    async with world.node("ours") as node:
        await node.set_param(base, value)
        await world.run("rosparam", "dump", "dump.yaml", base)
        dumped = await world.parse_yaml((world.folder / "dump.yaml").read_text())
        assert dumped == value
        await node.delete_param(base)
        await world.run("rosparam", "load", "dump.yaml", f"{base}/again")
        assert await node.get_param(f"{base}/again") == value


async def test_rosparam_dump_of_everything_under_our_master(under_ours: World) -> None:
    world = under_ours
    async with world.node("ours") as node:
        await node.set_param("/some/where", 1)
        await world.run("rosparam", "dump", "all.yaml")
        dumped = await world.parse_yaml((world.folder / "all.yaml").read_text())
        assert dumped["some"] == {"where": 1}
        assert dumped == await node.get_param("/")


async def test_a_table_set_leaf_by_leaf_is_followed(under_each: World) -> None:
    """rosparam sends a request for each leaf; the follower puts them together."""
    world = under_each
    key = world.unique("table")
    async with world.node("ours") as node, node.subscribe_param(key, default=None) as psub:
        assert psub.value is None
        await world.run("rosparam", "set", key, "{a: 1, b: 2, c: {d: 3}}")
        expected = {"a": 1, "b": 2, "c": {"d": 3}}
        assert await psub.wait_for(lambda value: value == expected, timeout=10) == expected
        await world.run("rosparam", "set", f"{key}/c/d", "4")
        updates = await take_until(psub, lambda update: update.value == 4)
        assert updates[-1].key == f"{key}/c/d"
        assert psub.value == {"a": 1, "b": 2, "c": {"d": 4}}
        assert {update.key for update in updates} == {f"{key}/{leaf}" for leaf in ("a", "b", "c/d")}
        await world.run("rosparam", "delete", f"{key}/c")
        await psub.wait_for(lambda value: not value.get("c"), timeout=10)
        assert (psub.value["a"], psub.value["b"]) == (1, 2)


async def test_a_table_over_a_scalar_is_followed(under_each: World) -> None:
    """Leaves arrive below what was a number."""
    world = under_each
    key = world.unique("k")
    async with world.node("setter") as setter, world.node("ours") as node:
        await setter.set_param(key, 5)
        async with node.subscribe_param(key) as psub:
            assert psub.value == 5
            await world.run("rosparam", "set", key, "{a: 1, b: 2}")
            await psub.wait_for(lambda value: value == {"a": 1, "b": 2}, timeout=10)
            await world.run("rosparam", "set", key, "7")
            await psub.wait_for(lambda value: value == 7, timeout=10)
            await world.run("rosparam", "delete", key)
            await take_until(psub, lambda update: update.value == {})
            with pytest.raises(KeyError):
                _ = psub.value


async def test_own_changes_are_followed(under_each: World) -> None:
    """The master tells everybody but the one who set it."""
    world = under_each
    key = world.unique("own")
    async with world.node("ours") as node, node.subscribe_param(key, default=0) as psub:
        await node.set_param(key, 3)
        assert await psub.wait_for(lambda value: value == 3, timeout=10) == 3
        assert await node.get_param_cached(key) == 3
        await node.delete_param(key)
        await psub.wait_for(lambda value: value == 0, timeout=10)


async def test_our_cache_follows_rospy(under_each: World) -> None:
    world = under_each
    key = world.unique("cached")
    params = await world.rospy_ready("params")
    async with world.node("ours") as node:
        await rospy_call(params, "set", key, 1)
        assert await node.get_param_cached(key) == 1
        async with node.subscribe_param(key) as psub:
            await rospy_call(params, "set", key, 2)
            await psub.wait_for(lambda value: value == 2, timeout=10)
            assert await node.get_param_cached(key) == 2


async def test_rospy_operations(under_each: World) -> None:
    world = under_each
    base = world.unique("base")
    params = await world.rospy_ready("params")
    async with world.node("ours") as node:
        value = {"int": -3, "text": "tä <&>", "list": [1, [2.5, True]], "deep": {"er": ""}}
        await rospy_call(params, "set", base, value)
        assert await node.get_param(base) == value
        await node.set_param(f"{base}/ours", value)
        assert await rospy_call(params, "get", f"{base}/ours") == value
        assert await rospy_call(params, "has", f"{base}/ours/int") is True
        assert await rospy_call(params, "has", f"{base}/nothing") is False
        assert f"{base}/deep/er" in await rospy_call(params, "names")
        assert await rospy_call(params, "search", base.lstrip("/")) == base
        await rospy_call(params, "delete", f"{base}/ours")
        assert not await node.has_param(f"{base}/ours")
        await rospy_call(params, "get", f"{base}/ours")
        assert params.values("kind") == ["KeyError"]


async def test_the_cache_of_rospy(under_each: World) -> None:
    """It subscribes when first asked, and is told of each change."""
    world = under_each
    key = world.unique("cached")
    params = await world.rospy_ready("params")
    async with world.node("ours") as node:
        await node.set_param(key, {"gain": 1})
        assert await rospy_call(params, "get_cached", key) == {"gain": 1}

        async def reads(expected: Any) -> None:
            async def check() -> bool:
                return bool(await rospy_call(params, "get_cached", key) == expected)

            await until(check, what=lambda: f"{expected} in the cache of {params.report()}")

        await node.set_param(f"{key}/gain", 2)
        await reads({"gain": 2})
        await node.set_param(key, {"gain": 3, "more": [1]})
        await reads({"gain": 3, "more": [1]})
        await world.run("rosparam", "set", f"{key}/gain", "4")
        await reads({"gain": 4, "more": [1]})


async def test_roscpp_operations(under_each: World) -> None:
    world = under_each
    base = world.unique("base")
    async with world.node("ours") as node:
        await node.set_param(
            base,
            {
                "int": -3,
                "float": 0.1,
                "bool": True,
                "text": "some <text> & more",
                "list": ["a", "b c"],
                "table": {"one": 1},
            },
        )
        cpp = world.roscpp("params", base)
        await cpp.wait_values("done")
        said = {key: value for record in cpp.records for key, value in record.items()}
        assert said == {
            "int": -3,
            "float": 0.1,
            "bool": True,
            "text": "some <text> & more",
            "list": ["a", "b c"],
            "table": 1,
            "missing": False,
            "has": True,
            "deleted": True,
            "search": f"{base}/int",
            "done": True,
        }
        assert await node.get_param(f"{base}/from_cpp") == {"x": 1.5, "y": -2.0}
        assert await node.get_param(f"{base}/names") == ["a", "b"]
        assert not await node.has_param(f"{base}/text")


async def test_the_cache_of_roscpp(under_each: World) -> None:
    world = under_each
    key = world.unique("cached")
    async with world.node("ours") as node:
        await node.set_param(key, 1)
        watcher = await world.roscpp_ready("param_watch", key)
        await watcher.wait_values("value", 1)
        await node.set_param(key, 2)
        await watcher.wait_values("value", 2)
        await world.run("rosparam", "set", key, "3")
        assert await watcher.wait_values("value", 3) == [1, 2, 3]


async def test_a_follower_leaves_no_trace(under_each: World) -> None:
    """A node that only followed a parameter is unknown to the master when it is closed."""
    world = under_each
    key = world.unique("key")
    options = {"rosout": False, "logger_services": False}
    async with world.node("follower", **options) as node:
        async with node.subscribe_param(key, default=None) as psub:
            await world.run("rosparam", "set", key, "1")
            await psub.wait_for(lambda value: value == 1, timeout=10)
            assert await world.ask("lookupNode", "/follower") == node.uri
        with pytest.raises(AssertionError, match="follower"):
            await world.ask("lookupNode", "/follower")
