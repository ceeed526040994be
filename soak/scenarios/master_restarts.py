"""The master is killed, and another one comes up at its place that knows nothing."""

from __future__ import annotations

import asyncio
import contextlib
import random
from typing import Any

import aioros1
from soak.bystander import Bystander
from soak.masters import MasterProcess
from soak.messages import Numbered, Question
from soak.scenario import Scenario, Seen

HEARTBEAT = 0.2
NODES = 5


async def run(times: int) -> Seen:
    master = MasterProcess()
    await master.start()
    try:
        async with Bystander(master.uri) as bystander, contextlib.AsyncExitStack() as stack:
            seen = await _restart(times, master, stack)
    finally:
        await master.kill()
    seen.text += f"; {bystander.text}"
    seen.problems += bystander.problems
    return seen


async def _restart(times: int, master: MasterProcess, stack: contextlib.AsyncExitStack) -> Seen:
    nodes = [await _node(master.uri, number, stack) for number in range(NODES)]
    observer = await stack.enter_async_context(
        aioros1.Node("observer", master_uri=master.uri, heartbeat=None, rosout=False)
    )
    followed = await stack.enter_async_context(nodes[0].subscribe_param("/soak", default=None))
    counts = [0] * NODES
    counters = [
        asyncio.create_task(_count(node.events(), counts, number))
        for number, node in enumerate(nodes)
    ]
    expected = await _registrations(observer)
    problems: list[str] = []
    beats: list[float] = []
    chance = random.Random(1)
    loop = asyncio.get_running_loop()
    for number in range(times):
        await master.kill()
        await asyncio.sleep(chance.random() * HEARTBEAT)
        await master.start()
        begin = loop.time()
        try:
            async with asyncio.timeout(30):
                while await _registrations(observer) != expected:
                    await asyncio.sleep(0.01)
        except TimeoutError:
            problems.append(
                f"restart {number}: {_missing(expected, await _registrations(observer))}"
            )
            break
        beats.append((loop.time() - begin) / HEARTBEAT)
        # That it is followed again is part of what the new master has to be told.
        await observer.set_param("/soak", number)
        await followed.wait_for(lambda value, number=number: value == number, timeout=30)
        async with asyncio.timeout(30):
            while min(counts) < number + 1:
                await asyncio.sleep(0.01)
    if counts != [times] * NODES:
        problems.append(f"MasterRestarted was seen {counts} times")
    for counter in counters:
        counter.cancel()
    await asyncio.gather(*counters, return_exceptions=True)
    text = f"all registered again after {max(beats, default=0):.1f} heartbeats at most"
    return Seen(text, problems)


async def _node(master_uri: str, number: int, stack: contextlib.AsyncExitStack) -> aioros1.Node:
    """One with every kind of role; they form a ring."""
    enter = stack.enter_async_context
    node = await enter(
        aioros1.Node(f"ring_{number}", master_uri=master_uri, heartbeat=HEARTBEAT, rosout=False)
    )
    await enter(node.advertise(f"/ring_{number}", Numbered))
    await enter(node.subscribe(f"/ring_{(number + 1) % NODES}", Numbered))
    await enter(node.advertise_service(f"/ask_{number}", Question, lambda request: None))
    await enter(node.subscribe_param(f"/param_{number}", default=None))
    return node


async def _count(events: Any, counts: list[int], number: int) -> None:
    async for event in events:
        counts[number] += isinstance(event, aioros1.MasterRestarted)


async def _registrations(observer: aioros1.Node) -> dict[str, set[str]]:
    """What the ring and the bystander have at the master; the observer's own is not told
    again, because it does not look."""
    state = await observer.master.get_system_state()
    found = {}
    for kind in ("publishers", "subscribers", "services"):
        for name, nodes in getattr(state, kind).items():
            if names := {node for node in nodes if node != observer.name}:
                found[f"{kind} {name}"] = names
    return found


def _missing(expected: dict[str, set[str]], found: dict[str, set[str]]) -> str:
    different = [name for name in expected | found if expected.get(name) != found.get(name)]
    return f"not registered as before after 30 s: {', '.join(different)}"


SCENARIO = Scenario(
    "master-restarts",
    "The master is killed and another one comes up at its address",
    "restarts",
    "every role is registered again, parameters are followed again, `MasterRestarted` is seen "
    "once by every node, and what flows goes on flowing",
    run,
    quick=3,
    short=100,
    full=1_000,
)
