"""Nodes that start, die and come back at random, under a master that does so as well.

A model knows what must have arrived. Times of chaos and of calm alternate: in the calm all
nodes are there, everything must fall into place again, and what the process holds is
compared with what it held in the first calm.
"""

from __future__ import annotations

import asyncio
import contextlib
import random
import traceback
from typing import Any

import aioros1
from soak.footprint import Footprint
from soak.masters import MasterProcess
from soak.messages import Numbered, Question
from soak.model import Model
from soak.scenario import Scenario, Seen

SLOTS = 16
REACH = (1, 3, 7)
"""Each slot subscribes to those so many places further on."""

HEARTBEAT = 0.3
CHAOS, QUICK_CHAOS = 20.0, 2.0
"""Seconds of chaos between two calms."""

PATIENCE = 60.0
"""Seconds that everything may take to fall into place."""


async def run(seconds: int) -> Seen:
    master = MasterProcess()
    await master.start()
    model = Model()
    slots = [_Slot(number, master.uri, model) for number in range(SLOTS)]
    loop = asyncio.get_running_loop()
    end = loop.time() + seconds
    restarts = calms = 0
    first = last = None
    try:
        await _calm(slots, model)
        while loop.time() < end and not model.problems:
            restarts += await _chaos(slots, master, min(CHAOS, max(seconds / 2, QUICK_CHAOS)))
            await _calm(slots, model)
            calms += 1
            last = await Footprint.take()
            first = first or last
    finally:
        await asyncio.gather(*(slot.stop() for slot in slots))
        await master.kill()
    text = f"{model.text}, {restarts:,} master restarts"
    if first is not None and last is not None:
        # Nodes keep the connections to their master and to each other's slave APIs for up to
        # half a minute; what is left when all are closed is measured by whoever runs this.
        model.problems += last.problems_since(first, kept=SLOTS)
        text += f"; {calms} calms, from the first to the last {last.text_since(first)}"
    return Seen(text, model.problems)


async def _chaos(slots: list[_Slot], master: MasterProcess, seconds: float) -> int:
    """How many times the master was replaced."""
    chance = random.Random()
    restarts = 0
    over = asyncio.Event()
    lives = [asyncio.create_task(slot.come_and_go(over, chance)) for slot in slots]
    try:
        loop = asyncio.get_running_loop()
        end = loop.time() + seconds
        while loop.time() < end:
            await asyncio.sleep(chance.uniform(0.2, 1.0) * seconds / 3)
            await master.kill()
            await asyncio.sleep(chance.uniform(0.0, 4 * HEARTBEAT))
            await master.start()
            restarts += 1
    finally:
        over.set()
        await asyncio.gather(*lives)
    return restarts


async def _calm(slots: list[_Slot], model: Model) -> None:
    """All are there, and find each other; else it is a problem."""
    await asyncio.gather(*(slot.start() for slot in slots))
    try:
        async with asyncio.timeout(PATIENCE):
            await _connected(slots)
            for slot in slots:
                await slot.say_something()
            for slot in slots:
                await slot.hear_it()
    except TimeoutError:
        model.problems.append(f"not in place after {PATIENCE:g} s: {_lacking(slots)}")
    model.settle({slot.life for slot in slots})


async def _connected(slots: list[_Slot]) -> None:
    while True:
        if not _lacking(slots):
            state = await _state(slots[0])
            names = {slot.name for slot in slots}
            if state is not None and all(
                names <= {node for nodes in getattr(state, kind).values() for node in nodes}
                for kind in ("publishers", "subscribers", "services")
            ):
                return
        await asyncio.sleep(0.05)


async def _state(slot: _Slot) -> Any:
    try:
        return await slot.node.master.get_system_state()
    except aioros1.MasterError:
        return None


def _lacking(slots: list[_Slot]) -> str:
    return ", ".join(filter(None, (slot.lacks() for slot in slots)))


class _Slot:
    """A place in the ring, in which one node lives after the other."""

    def __init__(self, number: int, master_uri: str, model: Model) -> None:
        self.name = f"/slot_{number}"
        self.life = -1
        self.node: Any = None
        self._number = number
        self._uri = master_uri
        self._model = model
        self._tasks: list[asyncio.Task[None]] = []

    async def start(self) -> None:
        """A new life, unless there is one."""
        if self.node is not None:
            return
        model, number = self._model, self._number
        self.life = model.begin()
        node = self.node = aioros1.Node(
            self.name[1:],
            master_uri=self._uri,
            heartbeat=HEARTBEAT,
            rosout=False,
            timeouts=aioros1.Timeouts(xmlrpc=2, connect=2, handshake=2),
        )
        await node.start()
        # The master may be away at any moment: then it is asked again.
        options: Any = {"queue_size": 20, "overflow": "block"}
        others = [(number + step) % SLOTS for step in REACH]
        self._pub = await _again(lambda: node.advertise(f"/topic_{number}", Numbered, **options))
        self._subs = [
            await _again(lambda other=other: node.subscribe(f"/topic_{other}", Numbered, **options))
            for other in others
        ]
        await _again(lambda: node.advertise_service(f"/ask_{number}", Question, self._model.answer))
        self._caller = await node.service_caller(
            f"/ask_{others[0]}", Question, persistent=bool(number % 2), timeout=2
        )
        self._followed = await _again(
            lambda: node.subscribe_param(f"/param_{others[0]}", default=0)
        )
        life = self.life
        self._tasks = [
            asyncio.create_task(self._send(life)),
            asyncio.create_task(self._ask(life)),
            *(asyncio.create_task(self._receive(sub, life)) for sub in self._subs),
        ]

    async def stop(self) -> None:
        """The end of a life, as it should be: what was sent is to arrive."""
        node, self.node = self.node, None
        if node is None:
            return
        speaking = self._tasks[:2]
        for task in speaking:
            task.cancel()
        await asyncio.gather(*speaking, return_exceptions=True)
        self._model.ends_well(self.life)
        await node.close(timeout=30)
        await self._join()

    async def drop(self) -> None:
        """The end of a life without a farewell."""
        node, self.node = self.node, None
        self._model.ends(self.life)
        node.abort()
        await node.wait_closed()
        await self._join()

    async def come_and_go(self, over: asyncio.Event, chance: random.Random) -> None:
        try:
            while not over.is_set():
                await _wait(over, chance.uniform(0.3, 5.0))
                if self.node is None:
                    await self.start()
                elif chance.random() < 0.5:
                    await self.stop()
                else:
                    await self.drop()
        except Exception:
            self._model.problems.append(f"{self.name}: {traceback.format_exc()}")

    def lacks(self) -> str:
        """Whom it has not found."""
        if self._pub.subscriber_count != len(REACH):
            return f"{self.name} has {self._pub.subscriber_count} subscribers"
        if missing := [sub.name for sub in self._subs if sub.publisher_count != 1]:
            return f"{self.name} hears nothing of {missing[0]}"
        return ""

    async def say_something(self) -> None:
        await self.node.set_param(f"/param_{self._number}", self.life)

    async def hear_it(self) -> None:
        """What all have set and sent must come to those who follow; calls are answered."""
        model, number = self._model, self._number
        await self._followed.wait_for(lambda value: value == model.of_slot((number + 1) % SLOTS))
        question = model.question()
        reply = await self._caller.call(life=self.life, number=question, timeout=PATIENCE)
        model.was_answered(question, reply.number)
        for sub in self._subs:
            heard = model.heard(self.life, sub.name)
            while model.heard(self.life, sub.name) == heard:
                await asyncio.sleep(0.01)

    async def _send(self, life: int) -> None:
        number = 0
        chance = random.Random(life)
        self._model.slots[self._number] = life
        while True:
            await self._pub.send(life=life, number=number)
            self._model.sent[life] = number
            number += 1
            if chance.random() < 0.05:
                await asyncio.sleep(chance.uniform(0, 0.2))

    async def _receive(self, sub: Any, life: int) -> None:
        chance = random.Random(life + 1)
        async for message in sub:
            self._model.got(life, sub.name, message.life, message.number)
            if chance.random() < 0.01:
                await asyncio.sleep(chance.uniform(0, 0.05))

    async def _ask(self, life: int) -> None:
        chance = random.Random(life + 2)
        while True:
            await asyncio.sleep(chance.uniform(0, 0.2))
            question = self._model.question()
            try:
                reply = await self._caller.call(life=life, number=question)
            except (aioros1.RosError, TimeoutError):
                continue  # who is asked may be dead; nothing is promised then
            self._model.was_answered(question, reply.number)

    async def _join(self) -> None:
        for task in self._tasks[:2]:
            task.cancel()
        results = await asyncio.gather(*self._tasks, return_exceptions=True)
        self._tasks = []
        for result in results:
            if isinstance(result, Exception) and not isinstance(result, aioros1.ClosedError):
                self._model.problems.append(f"{self.name}: {result!r}")


async def _again(opening: Any) -> Any:
    while True:
        with contextlib.suppress(aioros1.MasterError):
            return await opening()
        await asyncio.sleep(0.05)


async def _wait(over: asyncio.Event, seconds: float) -> None:
    with contextlib.suppress(TimeoutError):
        async with asyncio.timeout(seconds):
            await over.wait()


SCENARIO = Scenario(
    "churn",
    "Nodes start, end, die and come back at random, and so does their master",
    "seconds",
    "no message missing within a connection, none of a publisher that ended well; a call is "
    "executed once at most; in each calm all have found each other again, and nothing grows",
    run,
    quick=2,
    short=120,
    full=3_600,
)
