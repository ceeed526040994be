"""Subscriber and service connections that are cut at random points, handshake included."""

from __future__ import annotations

import asyncio
import contextlib
import random
from collections import Counter
from typing import Any

import aioros1
from aioros1.testing import FlakyConnection, proxies_before
from soak.bystander import Bystander
from soak.messages import Numbered, Question, Run
from soak.scenario import Scenario, Seen

TOPICS = 25
CALLERS = 10
QUIET = 60.0
"""Seconds in which everything has to be connected again when nothing is cut any more."""


async def run(times: int) -> Seen:
    state = _State(times)
    async with (
        aioros1.Master(host="localhost", port=0, rosout=False) as master,
        aioros1.Node(
            "server", master_uri=master.uri, host="127.0.0.2", bind="127.0.0.1", rosout=False
        ) as server,
        aioros1.Node("client", master_uri=master.uri, rosout=False) as client,
        Bystander(master.uri) as bystander,
        proxies_before(server, script=state.script) as proxies,
    ):
        async with contextlib.AsyncExitStack() as stack:
            enter = stack.enter_async_context
            await enter(server.advertise_service("ask", Question, state.answer))
            pubs, subs = [], []
            for number in range(TOPICS):
                topic = f"cut_{number}"
                pubs.append(await enter(server.advertise(topic, Numbered)))
                subs.append(await enter(client.subscribe(topic, Numbered, queue_size=1000)))
            callers = [
                await enter(
                    client.service_caller("ask", Question, persistent=number % 2 == 0, timeout=5)
                )
                for number in range(CALLERS)
            ]
            work = [
                asyncio.create_task(state.publish(pubs)),
                *(asyncio.create_task(state.receive(sub)) for sub in subs),
                *(asyncio.create_task(state.ask(caller)) for caller in callers),
            ]
            try:
                await _until_well(state, subs)
            except TimeoutError:
                still = [sub.name for sub in subs if not sub.publisher_count]
                state.problems.append(f"nothing comes on {still} after {QUIET:g} s")
            for task in work:
                task.cancel()
            for result in await asyncio.gather(*work, return_exceptions=True):
                if isinstance(result, Exception):
                    state.problems.append(repr(result))
        accepted = proxies.tcpros.accepted
    twice = [question for question, count in state.executed.items() if count > 1]
    if twice:
        state.problems.append(f"executed more than once: {twice[:5]}")
    text = (
        f"{accepted:,} connections, {state.cuts:,} of them cut, {state.answered:,} of "
        f"{state.asked:,} calls answered, none executed twice; {bystander.text}"
    )
    return Seen(text, state.problems + bystander.problems)


async def _until_well(state: _State, subs: list[Any]) -> None:
    """Until all was cut that is to be cut, and something came on every topic after that."""
    await state.all_cut.wait()
    async with asyncio.timeout(QUIET):
        for sub in subs:
            last = state.runs[sub.name].last
            while state.runs[sub.name].last <= last:
                await asyncio.sleep(0.01)
        answered = state.answered
        while state.answered < answered + CALLERS:
            await asyncio.sleep(0.01)


class _State:
    """What was cut, sent, received and asked so far."""

    def __init__(self, times: int) -> None:
        self.times = times
        self.cuts = 0
        self.all_cut = asyncio.Event()
        self.runs: dict[str, Run] = {}
        self.executed: Counter[int] = Counter()
        self.asked = self.answered = 0
        self.problems: list[str] = []
        self._chance = random.Random(0)

    async def script(self, connection: FlakyConnection) -> None:
        """Cut a connection somewhere: most in the handshake, some later."""
        chance = self._chance
        if self.cuts >= self.times:
            return
        way = chance.choice(("up", "down"))
        await connection.passed(round(1_500 * chance.random() ** 2), way)
        if self.cuts >= self.times:
            return
        chance.choice((connection.cut, connection.close))()
        self.cuts += 1
        if self.cuts == self.times:
            self.all_cut.set()

    async def publish(self, pubs: list[Any]) -> None:
        number = 0
        while True:
            for pub in pubs:
                pub.publish(number=number)
            number += 1
            await asyncio.sleep(0.005)

    async def receive(self, sub: Any) -> None:
        """In order, though with gaps: what is sent while there is no connection is lost."""
        got = self.runs[sub.name] = Run()
        async for message in sub:
            if message.number <= got.last:
                self.problems.append(f"{sub.name}: {message.number} came after {got.last}")
            got.last = message.number

    async def ask(self, caller: Any) -> None:
        while True:
            self.asked += 1
            question = self.asked
            try:
                reply = await caller.call(number=question)
            except (aioros1.RosError, TimeoutError):
                await asyncio.sleep(0)
                continue
            self.answered += 1
            if reply.number != question or self.executed[question] != 1:
                self.problems.append(
                    f"question {question} was answered with {reply.number}, and executed "
                    f"{self.executed[question]} times"
                )

    def answer(self, request: Any) -> Any:
        self.executed[request.number] += 1
        return Question.Response(number=request.number)


SCENARIO = Scenario(
    "cut-connections",
    "Subscriber and service connections are reset or closed at random bytes, the handshake "
    "included",
    "cuts",
    "subscribers connect again by themselves, and get messages in order; a call is executed "
    "once at most, and one that is answered exactly once",
    run,
    quick=100,
    short=2_000,
    full=10_000,
)
