"""Random changes by nodes of every library: each follower of ours ends with what the master has."""

from __future__ import annotations

import asyncio
import contextlib
import json
import random
import sys
from pathlib import Path
from typing import Any

import pytest

sys.path.append(str(Path(__file__).parents[2]))

from soak.parameters import FOLLOWED, make_changes, wait_until_right

from .processes import Process
from .rosmaster import RealMaster
from .world import World

HEARTBEAT = 0.3


class RospySetter:
    """Sets parameters through a rospy program."""

    def __init__(self, process: Process) -> None:
        self._process = process
        self._answers = 0

    async def set_param(self, key: str, value: Any) -> None:
        await self._do(json.dumps(["set", key, value]))

    async def delete_param(self, key: str) -> None:
        await self._do(json.dumps(["delete", key]))

    async def _do(self, line: str) -> None:
        self._answers += 1
        self._process.tell(line)
        await self._process.wait_values("result", self._answers)


class RoscppSetter(RospySetter):
    """Sets parameters through a roscpp program, which knows numbers and tables of one."""

    async def set_param(self, key: str, value: Any) -> None:
        if isinstance(value, dict):
            await self._do(f"table {key} 7 {' '.join(value)}")
        else:
            await self._do(f"set {key} {value}")

    async def delete_param(self, key: str) -> None:
        await self._do(f"delete {key}")


async def follow(
    world: World, root: str, stack: contextlib.AsyncExitStack
) -> tuple[list[Any], dict[str, list[Any]]]:
    """Two nodes of ours, each of which follows the same parameters."""
    nodes = [
        await stack.enter_async_context(
            world.node(f"ours_{number}", heartbeat=HEARTBEAT, rosout=False)
        )
        for number in range(2)
    ]
    followers = {
        root + key: [
            await stack.enter_async_context(node.subscribe_param(root + key, default={}))
            for node in nodes
        ]
        for key in FOLLOWED
    }
    return nodes, followers


async def test_delete_and_set_by_one_node(under_each: World) -> None:
    """The notice of its own deletion comes when the new value is set."""
    world = under_each
    key = world.unique("p")
    async with world.node("ours", rosout=False) as node, node.subscribe_param(key) as psub:
        for number in range(20):
            await node.set_param(key, number)
            await node.delete_param(key)
            await node.set_param(key, -number)
            assert psub.value == -number
        await node.sleep(0.3)
        assert psub.value == -19


async def test_another_sets_and_then_the_follower(under_each: World) -> None:
    world = under_each
    key = world.unique("p")
    async with (
        world.node("other", rosout=False) as other,
        world.node("ours", rosout=False) as node,
        node.subscribe_param(key, default=None) as psub,
    ):
        for number in range(20):
            await other.set_param(key, number)
            await node.set_param(key, -number)
        await other.set_param(key, "last but one")
        await node.set_param(key, "last")
        await node.sleep(0.3)
        assert psub.value == "last"


async def test_a_plain_value_above_the_followed_key(under_each: World) -> None:
    """rosmaster tells those who follow a key below nothing of it."""
    world = under_each
    root = world.unique("p")
    async with (
        world.node("other", rosout=False) as other,
        world.node("ours", rosout=False, heartbeat=HEARTBEAT) as node,
    ):
        await other.set_param(root, {"a": {"b": 1, "c": 2}})
        async with node.subscribe_param(f"{root}/a", default=None) as psub:
            assert psub.value == {"b": 1, "c": 2}
            await other.set_param(root, 5)
            await psub.wait_for(lambda value: value is None, timeout=20)
            await other.set_param(root, {"a": {"b": 1, "c": 2}})
            await psub.wait_for(lambda value: value == {"b": 1, "c": 2}, timeout=20)
            await other.set_param(root, 5)
            await other.set_param(f"{root}/a/b", 3)
            await psub.wait_for(lambda value: value == {"b": 3}, timeout=20)


@pytest.mark.parametrize("seed", range(3))
async def test_random_changes_of_all(under_each: World, seed: int) -> None:
    world = under_each
    root = world.unique("tree")
    rospy = RospySetter(await world.rospy_ready("params", "--anonymous"))
    roscpp = RoscppSetter(await world.roscpp_ready("param_setter"))
    async with contextlib.AsyncExitStack() as stack:
        nodes, followers = await follow(world, root, stack)
        for turn in range(5):
            async with asyncio.TaskGroup() as group:
                for number, setter in enumerate((*nodes, rospy, roscpp)):
                    chance = random.Random(f"{seed} {turn} {number}")
                    group.create_task(make_changes(setter, root, chance, 5))
            assert await wait_until_right(nodes[0], followers) == []


@pytest.mark.parametrize("kind", ["rosmaster"])
async def test_random_changes_and_a_master_that_is_restarted(
    kind: str, own_real_master: RealMaster, tmp_path: Path
) -> None:
    world = World(kind, own_real_master.uri, tmp_path)
    async with contextlib.AsyncExitStack() as stack:
        nodes, followers = await follow(world, "/tree", stack)
        for turn in range(4):
            if turn == 2:
                await asyncio.to_thread(own_real_master.stop)
                await asyncio.to_thread(own_real_master.start)
            async with asyncio.TaskGroup() as group:
                for number, node in enumerate(nodes):
                    chance = random.Random(f"{turn} {number}")
                    group.create_task(make_changes(node, "/tree", chance, 10, at_once=2))
            assert await wait_until_right(nodes[0], followers) == []
