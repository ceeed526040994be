"""Many nodes in one event loop, all at once, and their master restarts."""

from __future__ import annotations

import asyncio
import contextlib
from typing import Any

import aioros1
from soak.bystander import Bystander
from soak.masters import MasterProcess
from soak.messages import Numbered, Question, Run
from soak.scenario import Scenario, Seen

MESSAGES = 1_000
CALLS = 10


async def run(times: int) -> Seen:
    """``times`` is how many nodes."""
    master = MasterProcess()
    await master.start()
    problems: list[str] = []
    try:
        async with Bystander(master.uri) as bystander, contextlib.AsyncExitStack() as stack:
            ring = await _open(times, master.uri, stack)
            restarted = [asyncio.create_task(_restart_seen(member.node)) for member in ring]
            work = [asyncio.create_task(member.work(problems)) for member in ring]
            await asyncio.sleep(0)
            await master.kill()
            await master.start()
            await asyncio.gather(*work)
            async with asyncio.timeout(60):
                await asyncio.gather(*restarted)
            state = await ring[0].node.master.get_system_state()
            here = {f"/many_{number}" for number in range(times)}
            if missing := here - set(state.publishers):
                problems.append(f"not registered again: {', '.join(sorted(missing)[:5])}")
    finally:
        await master.kill()
    text = f"{times * MESSAGES:,} messages and {times * CALLS:,} calls, none lost; {bystander.text}"
    return Seen(text, problems + bystander.problems)


class _Member:
    """A node that publishes, subscribes to the one before it, and asks it."""

    def __init__(self, node: aioros1.Node, pub: Any, sub: Any, caller: Any) -> None:
        self.node = node
        self._pub = pub
        self._sub = sub
        self._caller = caller

    async def work(self, problems: list[str]) -> None:
        got = Run()
        name = self.node.name

        async def receive() -> None:
            async for message in self._sub:
                got.got(message.number)
                if message.number == MESSAGES - 1:
                    break

        receiving = asyncio.create_task(receive())
        for number in range(MESSAGES):
            await self._pub.send(number=number)
            if number % (MESSAGES // CALLS) == 0:
                reply = await self._caller.call(number=number, timeout=60)
                if reply.number != number:
                    problems.append(f"{name} was answered {reply.number} to {number}")
        try:
            async with asyncio.timeout(60):
                await receiving
        except TimeoutError:
            problems.append(f"{name}: no message after {got.last}")
        if got.count != MESSAGES or got.problems:
            problems.append(f"{name} got {got.count} of {MESSAGES}: {got.problems[:3]}")


async def _open(number: int, uri: str, stack: contextlib.AsyncExitStack) -> list[_Member]:
    enter = stack.enter_async_context
    nodes = [
        await enter(aioros1.Node(f"many_{i}", master_uri=uri, rosout=False, heartbeat=0.5))
        for i in range(number)
    ]
    pubs, subs, callers = [], [], []
    options: Any = {"queue_size": 100, "overflow": "block"}
    for i, node in enumerate(nodes):
        before = (i or number) - 1
        pubs.append(await enter(node.advertise(f"many_{i}", Numbered, **options)))
        subs.append(await enter(node.subscribe(f"many_{before}", Numbered, **options)))
        await enter(node.advertise_service(f"ask_{i}", Question, _answer))
        callers.append(await enter(node.service_caller(f"ask_{before}", Question, persistent=True)))
    for pub in pubs:
        await pub.wait_for_subscribers(timeout=60)
    for caller in callers:
        await caller.call(number=0, timeout=60)  # later there may be no master to ask
    return [_Member(*of) for of in zip(nodes, pubs, subs, callers, strict=True)]


def _answer(request: Any) -> Any:
    return Question.Response(life=request.life, number=request.number)


async def _restart_seen(node: aioros1.Node) -> None:
    async for event in node.events():
        if isinstance(event, aioros1.MasterRestarted):
            break


SCENARIO = Scenario(
    "many-nodes",
    "Many nodes at once in one event loop, whose master is killed and replaced meanwhile",
    "nodes",
    "every message and every call of each arrives, all are registered again",
    run,
    quick=10,
    short=50,
    full=200,
    is_size=True,
)
