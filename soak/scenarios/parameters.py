"""Nodes set and delete parameters that all of them follow, and the master is killed meanwhile."""

from __future__ import annotations

import asyncio
import contextlib
import random

import aioros1
from soak.masters import MasterProcess
from soak.parameters import FOLLOWED, make_changes, wait_until_right
from soak.scenario import Scenario, Seen

HEARTBEAT = 0.2
NODES = 3
ROOT = "/soak"
CHANGES = 20
"""By each node, in each round."""


async def run(times: int) -> Seen:
    master = MasterProcess()
    await master.start()
    try:
        async with contextlib.AsyncExitStack() as stack:
            return await _change(times, master, stack)
    finally:
        await master.kill()


async def _change(times: int, master: MasterProcess, stack: contextlib.AsyncExitStack) -> Seen:
    enter = stack.enter_async_context
    nodes = [
        await enter(
            aioros1.Node(f"node_{number}", master_uri=master.uri, heartbeat=HEARTBEAT, rosout=False)
        )
        for number in range(NODES)
    ]
    followers = {
        ROOT + key: [await enter(node.subscribe_param(ROOT + key, default={})) for node in nodes]
        for key in FOLLOWED
    }
    chance = random.Random(1)
    slowest = 0.0
    loop = asyncio.get_running_loop()
    for number in range(times):
        async with asyncio.TaskGroup() as group:
            for node in nodes:
                own = random.Random(chance.random())
                at_once = chance.choice((1, 1, 3))
                group.create_task(make_changes(node, ROOT, own, CHANGES, at_once=at_once))
            if number % 10 == 1:
                await asyncio.sleep(chance.random() * 0.2)
                await master.kill()
                await master.start()
        begin = loop.time()
        if wrong := await wait_until_right(nodes[0], followers):
            return Seen("", [f"round {number}: {each}" for each in wrong])
        slowest = max(slowest, loop.time() - begin)
    return Seen(f"all followers were right {slowest / HEARTBEAT:.1f} heartbeats later at most")


SCENARIO = Scenario(
    "parameters",
    "Three nodes set and delete parameters above, below and beside one another, which all of "
    "them follow; the master is killed at times, and another one comes up",
    "rounds",
    "every follower ends with the value that the master has",
    run,
    quick=3,
    short=200,
    full=2_000,
)
