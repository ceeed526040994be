"""Everything that a network does to connections, to all of them, with a model of what holds.

Proxies stand before each node, and before the master. Times of chaos and of calm alternate: in
the chaos connections are reset, closed, stalled, throttled, delayed, refused, or accepted by
nobody; in the calm everything has to fall into place again, and a model is asked whether
something was lost that was promised.
"""

from __future__ import annotations

import asyncio
import contextlib
import random
from collections import Counter
from collections.abc import Mapping
from typing import Any

import aioros1
from aioros1.testing import FlakyProxy, proxies_before
from soak.bystander import Bystander
from soak.messages import Numbered, Question
from soak.scenario import Scenario, Seen

NODES = 6
REACH = (1, 2)
"""Each node subscribes to those so many places further on."""

STALL = 1.0
"""Seconds after which a publisher cuts off a subscriber that takes nothing."""

CHAOS, QUICK_CHAOS = 20.0, 2.0
"""Seconds of chaos between two calms."""

PATIENCE = 60.0
"""Seconds that everything may take to fall into place."""

PADDING = (0, 100, 4_000, 200_000)
"""Bytes of messages: some are in many pieces when a connection is cut."""


async def run(seconds: int) -> Seen:
    model = Model()
    chance = random.Random(seconds)
    calms = 0
    async with contextlib.AsyncExitStack() as stack:
        enter = stack.enter_async_context
        master = await enter(aioros1.Master(host="localhost", port=0, rosout=False))
        bystander = await enter(Bystander(master.uri))
        door = await enter(FlakyProxy("127.0.0.1", master.port))
        proxies = [door]
        members = []
        for number in range(NODES):
            member = _Member(number, f"http://127.0.0.1:{door.port}", model)
            members.append(member)
            await enter(member.node)
            before = await enter(proxies_before(member.node))
            proxies += [before.slave_api, before.tcpros]
        for member in members:
            await member.open()
        watcher = await enter(aioros1.Node("watcher", master_uri=master.uri, rosout=False))
        loop = asyncio.get_running_loop()
        end = loop.time() + seconds
        while True:
            await _calm(members, watcher, model)
            calms += 1
            if loop.time() >= end or model.problems:
                break
            await _chaos(members, proxies, min(CHAOS, max(seconds / 2, QUICK_CHAOS)), chance, model)
        for member in members:
            await member.stop()
    text = f"{model.text}, {calms} calms; {bystander.text}"
    return Seen(text, model.problems + bystander.problems)


async def _chaos(
    members: list[_Member],
    proxies: list[FlakyProxy],
    seconds: float,
    chance: random.Random,
    model: Model,
) -> None:
    over = asyncio.Event()
    spoiling = [asyncio.create_task(_spoil(proxy, chance, over, model)) for proxy in proxies]
    opening = [asyncio.create_task(member.come_and_go(over, chance)) for member in members]
    await asyncio.sleep(seconds)
    over.set()
    await asyncio.gather(*spoiling, *opening)


async def _spoil(
    proxy: FlakyProxy, chance: random.Random, over: asyncio.Event, model: Model
) -> None:
    """Now this fault, now that one, for a moment, on one connection or on all."""
    while not over.is_set():
        await asyncio.sleep(chance.uniform(0, 0.3))
        where: Any = chance.choice([proxy, *proxy.connections])
        way: Any = chance.choice(["up", "down", "both"])
        fault = chance.choice(FAULTS)
        # Most are short. In some a publisher loses its patience.
        seconds = chance.choice((chance.uniform(0, 0.2), chance.uniform(0, 1.5 * STALL)))
        model.faults[fault] += 1
        match fault:
            case "reset":
                where.cut()
            case "closed":
                for connection in proxy.connections if isinstance(where, FlakyProxy) else (where,):
                    connection.close()
            case "stalled":
                where.stall(way)
                await asyncio.sleep(seconds)
                where.resume(way)
            case "throttled":
                where.throttle(10 ** chance.uniform(3.5, 7), way)
                await asyncio.sleep(seconds)
                where.throttle(None, way)
            case "delayed":
                where.delay(seconds / 3, way)
                await asyncio.sleep(seconds)
                where.delay(0, way)
            case "refused":
                proxy.refuse()
                await asyncio.sleep(seconds)
                proxy.accept()
            case _:
                proxy.half_open()
                await asyncio.sleep(seconds)
                proxy.half_open(False)
                proxy.cut()  # those that were accepted by nobody


FAULTS = ("reset", "closed", "stalled", "throttled", "delayed", "refused", "accepted by nobody")


async def _calm(members: list[_Member], watcher: aioros1.Node, model: Model) -> None:
    """Everything falls into place; else it is a problem."""
    lacking = ["nothing was looked at"]
    try:
        async with asyncio.timeout(PATIENCE):
            for member in members:
                await member.speak()
            while lacking:
                lacking = [text for member in members for text in member.lacks(members)]
                lacking += await _differences(members, watcher)
                await asyncio.sleep(0.02)
    except TimeoutError:
        model.problems.append(f"not in place after {PATIENCE:g} s: {'; '.join(lacking[:5])}")
    model.settle()


async def _differences(members: list[_Member], watcher: aioros1.Node) -> list[str]:
    """What is registered and not open, or open and not registered."""
    state = await watcher.master.get_system_state()
    found = []
    for kind in ("publishers", "subscribers", "services"):
        registered = {
            (name, node)
            for name, nodes in getattr(state, kind).items()
            for node in nodes
            if node.startswith("/member_")
        }
        opened = {(name, member.name) for member in members for name in member.names(kind)}
        found += [
            f"{kind[:-1]} {name} of {node} is registered" for name, node in registered - opened
        ]
        found += [
            f"{kind[:-1]} {name} of {node} is not registered" for name, node in opened - registered
        ]
    return found


class Model:
    """Who has sent, received, asked and answered what."""

    def __init__(self) -> None:
        self.problems: list[str] = []
        self.faults: Counter[str] = Counter()
        self.sent = self.received = self.connections = 0
        self.executed: Counter[int] = Counter()
        self.asked = self.answered = 0

    @property
    def text(self) -> str:
        faults = ", ".join(f"{self.faults[fault]:,} {fault}" for fault in FAULTS)
        return (
            f"{sum(self.faults.values()):,} faults ({faults}); {self.received:,} messages on "
            f"{self.connections:,} connections, {self.answered:,} of {self.asked:,} calls answered"
        )

    def problem(self, text: str) -> None:
        if len(self.problems) < 10:
            self.problems.append(text)

    def answer(self, request: Any) -> Any:
        """The handler of all services."""
        self.executed[request.number] += 1
        return Question.Response(number=request.number)

    def was_answered(self, question: int, answer: int) -> None:
        self.answered += 1
        if answer != question or self.executed[question] != 1:
            self.problem(
                f"question {question} was answered with {answer}, and executed "
                f"{self.executed[question]} times"
            )

    def settle(self) -> None:
        twice = [question for question, count in self.executed.items() if count > 1]
        if twice:
            self.problem(f"questions executed more than once: {twice[:5]}")
        for question in [each for each in self.executed if each < self.asked - 10_000]:
            del self.executed[question]


class Flow:
    """The messages of one topic as one subscriber gets them.

    Those of one connection come in order, and none is missing. From one connection to the next
    there may be a gap, and nothing comes twice.
    """

    def __init__(self, name: str, model: Model) -> None:
        self._name = name
        self._model = model
        self._header: Mapping[str, str] | None = None
        self.last = -1

    def got(self, header: Mapping[str, str], number: int) -> None:
        model = self._model
        model.received += 1
        if header is not self._header:
            self._header = header
            model.connections += 1
            if number <= self.last:
                model.problem(f"{self._name}: {number} came after {self.last} on a new connection")
        elif number != self.last + 1:
            model.problem(f"{self._name}: {number} came after {self.last} on one connection")
        self.last = number


class _Member:
    """A node that publishes, subscribes, serves, calls and follows parameters."""

    def __init__(self, number: int, master_uri: str, model: Model) -> None:
        self.name = f"/member_{number}"
        self.node = aioros1.Node(
            self.name[1:],
            master_uri=master_uri,
            host=f"127.0.0.{number + 2}",
            bind="127.0.0.1",
            heartbeat=0.3,
            rosout=False,
            logger_services=False,
            timeouts=aioros1.Timeouts(xmlrpc=1, connect=1, handshake=1, stall=STALL),
        )
        self._number = number
        self._model = model
        self._said = 0
        self._extra: list[Any] = []
        self._tasks: list[asyncio.Task[None]] = []

    async def open(self) -> None:
        node, number = self.node, self._number
        options: Any = {"queue_size": 20, "overflow": "block"}
        self._pub = await node.advertise(f"flow_{number}", Numbered, **options)
        self._status = await node.advertise(f"status_{number}", Numbered, latch=True)
        await node.advertise_service(f"ask_{number}", Question, self._model.answer)
        others = [(number + step) % NODES for step in REACH]
        self._subs = {
            other: await node.subscribe(f"flow_{other}", Numbered, **options) for other in others
        }
        self._statuses = {
            other: await node.subscribe(f"status_{other}", Numbered) for other in others
        }
        self._flows = {other: Flow(f"flow_{other} to {self.name}", self._model) for other in others}
        self._followed = {
            other: await node.subscribe_param(f"/param_{other}", default=0) for other in others
        }
        callers = [
            await node.service_caller(
                f"ask_{others[kind]}", Question, persistent=bool(kind), timeout=2
            )
            for kind in range(2)
        ]
        self._tasks = [
            asyncio.create_task(self._send()),
            *(asyncio.create_task(self._receive(other)) for other in others),
            *(asyncio.create_task(self._ask(caller)) for caller in callers),
        ]

    async def stop(self) -> None:
        for task in self._tasks:
            task.cancel()
        for result in await asyncio.gather(*self._tasks, return_exceptions=True):
            if isinstance(result, Exception):
                self._model.problem(f"{self.name}: {result!r}")

    async def come_and_go(self, over: asyncio.Event, chance: random.Random) -> None:
        """Open something more, or close it again."""
        while not over.is_set():
            await asyncio.sleep(chance.uniform(0, 0.5))
            if self._extra and chance.random() < 0.5:
                await self._extra.pop(chance.randrange(len(self._extra))).close()
                continue
            name = f"extra_{chance.randrange(4)}"
            opening: Any = self.node.advertise if chance.random() < 0.5 else self.node.subscribe
            with contextlib.suppress(aioros1.MasterError):  # it cannot be asked just now
                self._extra.append(await opening(name, Numbered))

    async def speak(self) -> None:
        """Say something that all others must have heard when they are in place."""
        self._said += 1
        self._status.publish(number=self._said)
        await self.node.set_param(f"/param_{self._number}", self._said)

    def names(self, kind: str) -> set[str]:
        """What is open here, as the master has to know it."""
        extra = {
            role.name
            for role in self._extra
            if isinstance(role, aioros1.Publisher) == (kind == "publishers")
        }
        match kind:
            case "publishers":
                return {self._pub.name, self._status.name} | extra
            case "subscribers":
                roles = [*self._subs.values(), *self._statuses.values()]
                return {role.name for role in roles} | extra
        return {f"/ask_{self._number}"}

    def lacks(self, members: list[_Member]) -> list[str]:
        """What it should have, and has not."""
        found = []
        for other in self._subs:
            member = members[other]
            latest: Any = self._statuses[other].latest
            if self._subs[other].publisher_count != 1:
                found.append(f"{self.name} has no connection to {member._pub.name}")
            if latest is None or latest.number != member._said:
                found.append(f"{self.name} has not the last of {member._status.name}")
            if self._followed[other].value != member._said:
                found.append(f"{self.name} has not the last of /param_{other}")
        return found

    async def _send(self) -> None:
        chance = random.Random(self._number)
        number = 0
        while True:
            await self._pub.send(number=number, padding=bytes(chance.choice(PADDING)))
            self._model.sent += 1
            number += 1
            if chance.random() < 0.3:
                await asyncio.sleep(chance.uniform(0, 0.05))

    async def _receive(self, other: int) -> None:
        chance = random.Random(other)
        flow = self._flows[other]
        async for event in self._subs[other].events():
            flow.got(event.header, event.message.number)
            if chance.random() < 0.01:
                await asyncio.sleep(chance.uniform(0, 0.05))

    async def _ask(self, caller: Any) -> None:
        while True:
            self._model.asked += 1
            question = self._model.asked
            try:
                reply = await caller.call(number=question)
            except (aioros1.RosError, TimeoutError):
                await asyncio.sleep(0.01)
                continue
            self._model.was_answered(question, reply.number)
            await asyncio.sleep(0.005)


SCENARIO = Scenario(
    "chaos",
    "Connections of all kinds, those to the master too, are reset, closed, stalled, throttled, "
    "delayed, refused or accepted by nobody, while roles are opened and closed",
    "seconds",
    'with `overflow="block"` no message is missing within a connection, and none comes twice; a '
    "call is executed once at most; in each calm all are connected, what is open is registered "
    "and nothing else, and the last value of each parameter and latched topic is everywhere",
    run,
    quick=2,
    short=120,
    full=1_800,
)
