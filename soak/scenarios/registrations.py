"""Everything that can make a master forget a node, or a node miss its master, at random."""

from __future__ import annotations

import asyncio
import contextlib
import random
import resource
import socket
import time
from collections.abc import Callable, Iterator
from typing import Any
from unittest import mock

import aioros1
from aioros1.testing import FlakyProxy
from aioros1.xmlrpc.client import XmlRpcClient
from soak.messages import Numbered, Question
from soak.scenario import Scenario, Seen

HEARTBEAT = 0.05
PATIENCE = 60.0
PLACES = 6  # topics, services and parameters, of each
STEPS_BETWEEN_CALMS = 25
TIMEOUTS = aioros1.Timeouts(xmlrpc=0.3, close=2, stall=5)


async def run(times: int) -> Seen:
    return await play(random.Random(1), times)


async def play(chance: random.Random, steps: int) -> Seen:
    """Do ``steps`` bad things, with a calm now and then."""
    problems: list[str] = []
    calms, longest = 0, 0.0
    async with _World(chance) as world:
        for step in range(1, steps + 1):
            await world.do_something()
            if step % STEPS_BETWEEN_CALMS == 0 or step == steps:
                begin = time.monotonic()
                problems += await world.calm()
                longest = max(longest, time.monotonic() - begin)
                calms += 1
                if problems:
                    break
        done = ", ".join(f"{count} {name}" for name, count in sorted(world.done.items()))
        problems += await world.end()
    return Seen(f"{done}; {calms} calms, the longest until all was right {longest:.1f} s", problems)


class _World:
    """Two nodes, their master, and a proxy between them; everything is in one event loop."""

    def __init__(self, chance: random.Random) -> None:
        self._chance = chance
        self._stack = contextlib.AsyncExitStack()
        self.done: dict[str, int] = {}

    async def __aenter__(self) -> _World:
        self._runs = 1
        # As two masters of containers, which have nothing but their state to tell them apart.
        self._stack.enter_context(mock.patch("aioros1.master.server.process_id", return_value=1))
        self._master = aioros1.Master("127.0.0.1", 0, rosout=False, params={"/run_id": "0"})
        await self._master.start()
        self._stack.push_async_callback(lambda: self._master.close())
        # For connections that the proxy has just made, and the master not yet accepted.
        self._stack.push_async_callback(asyncio.sleep, 0.05)
        enter = self._stack.enter_async_context
        self._proxy = await enter(FlakyProxy("127.0.0.1", self._master.port))
        uri = f"http://127.0.0.1:{self._proxy.port}/"
        # Whoever looks, and does what others do to nodes, is not disturbed.
        self._client = XmlRpcClient()
        self._stack.push_async_callback(self._client.close)
        self._nodes = [
            await enter(
                aioros1.Node(
                    f"node_{number}",
                    master_uri=uri,
                    host="127.0.0.1",
                    heartbeat=HEARTBEAT,
                    timeouts=TIMEOUTS,
                    rosout=False,
                    logger_services=False,
                )
            )
            for number in range(2)
        ]
        self._open: dict[tuple[aioros1.Node, str, int], Any] = {}
        self._busy: set[tuple[aioros1.Node, str, int]] = set()
        self._tasks: set[asyncio.Task[None]] = set()
        for _ in range(8):
            self._change_role()
        await self._settled()
        return self

    async def __aexit__(self, *exc_info: object) -> None:
        for task in self._tasks:
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)
        await self._stack.aclose()

    # bad things

    async def do_something(self) -> None:
        chance = self._chance
        for _ in range(chance.randrange(3)):
            self._change_role()
        name, thing = chance.choice(
            [
                ("restarts", self._restart),
                ("restarts", self._restart),
                ("purges", self._purge),
                ("purges", self._purge),
                ("cuts", self._cut),
                ("outages", self._refuse),
                ("stalls", self._stall),
                ("silences", self._swallow),
                ("blocked loops", self._block),
                ("times without descriptors", self._exhaust),
            ]
        )
        self.done[name] = self.done.get(name, 0) + 1
        await thing()
        await asyncio.sleep(chance.uniform(0, 2 * HEARTBEAT))

    async def _restart(self) -> None:
        """With another run id, or with the same."""
        await self._master.close()
        self._proxy.cut()
        await asyncio.sleep(self._chance.choice([0, 0.01, 3 * HEARTBEAT]))
        self._runs += self._chance.randrange(2)
        params = {"/run_id": str(self._runs)}
        self._master = aioros1.Master("127.0.0.1", self._master.port, rosout=False, params=params)
        await self._master.start()

    async def _purge(self) -> None:
        """As ``rosnode cleanup`` does, but perhaps not everything."""
        node = self._chance.choice(self._nodes)
        share = self._chance.choice([0.3, 1])
        for owner, kind, place in list(self._open):
            if owner is node and self._chance.random() < share:
                await self._ask_as(node, *_unregistering(node, kind, place))

    async def _cut(self) -> None:
        self._proxy.cut()

    async def _refuse(self) -> None:
        self._proxy.refuse()
        self._proxy.cut()
        await asyncio.sleep(self._chance.uniform(0, 4 * HEARTBEAT))
        self._proxy.accept()

    async def _stall(self) -> None:
        """What is on its way arrives later, or is cut off."""
        way = self._chance.choice(["up", "down", "both"])
        self._proxy.stall(way)
        await asyncio.sleep(self._chance.uniform(0, 2 * TIMEOUTS.xmlrpc))
        if self._chance.random() < 0.5:
            self._proxy.cut()
        self._proxy.resume(way)

    async def _swallow(self) -> None:
        """Connections that live, and are never answered."""
        for connection in self._proxy.connections:
            if self._chance.random() < 0.7:
                connection.stall()
        self._proxy.half_open()
        self._change_role()
        await asyncio.sleep(self._chance.uniform(0, 2 * TIMEOUTS.xmlrpc))
        self._proxy.half_open(False)

    async def _block(self) -> None:
        seconds = self._chance.choice([0.05, 2 * TIMEOUTS.xmlrpc])
        asyncio.get_running_loop().call_soon(time.sleep, seconds)
        await asyncio.sleep(0)

    async def _exhaust(self) -> None:
        # Nobody accepts meanwhile, which is no matter of the nodes.
        self._proxy.refuse()
        with _no_descriptors():
            self._change_role()
            await asyncio.sleep(self._chance.uniform(0, 4 * HEARTBEAT))
        self._proxy.accept()

    # roles that open and close meanwhile

    def _change_role(self) -> None:
        chance = self._chance
        node = chance.choice(self._nodes)
        key = node, chance.choice(list(_OPENING)), chance.randrange(PLACES)
        if key not in self._busy:
            self._busy.add(key)
            task = asyncio.create_task(self._change(key))
            self._tasks.add(task)
            task.add_done_callback(self._tasks.discard)

    async def _change(self, key: tuple[aioros1.Node, str, int]) -> None:
        node, kind, place = key
        try:
            if key in self._open:
                await self._open.pop(key).close()
            else:
                with contextlib.suppress(aioros1.MasterError):
                    self._open[key] = await _OPENING[kind](node, place)
        finally:
            self._busy.discard(key)

    # what has to be right

    async def calm(self) -> list[str]:
        """What is not as it should be, once nothing bad happens any more."""
        return await self._settled() or await self._parameters_arrive()

    async def _settled(self) -> list[str]:
        """Wait until what is open is listed, and nothing else, and stays so."""
        while self._tasks:
            await asyncio.wait(self._tasks)
        try:
            async with asyncio.timeout(PATIENCE):
                right = 0
                while right < 5:
                    right = 0 if await self._differences() else right + 1
                    await asyncio.sleep(HEARTBEAT / 2)
        except TimeoutError:
            return await self._differences()
        return []

    async def _differences(self) -> list[str]:
        _, _, state = await self._ask("getSystemState")
        listed = {
            (kind, name, node)
            for kind, part in zip(("publisher", "subscriber", "service"), state, strict=True)
            for name, nodes in part
            for node in nodes
        }
        is_open = {
            (kind, _name(node, kind, place), node.name)
            for node, kind, place in self._open
            if kind != "parameter"
        }
        return [
            *(f"missing at the master: {' '.join(each)}" for each in sorted(is_open - listed)),
            *(f"not open, but listed: {' '.join(each)}" for each in sorted(listed - is_open)),
        ]

    async def _parameters_arrive(self) -> list[str]:
        self._runs += 1
        problems = []
        for (node, kind, place), role in list(self._open.items()):
            if kind == "parameter":
                name, value = _name(node, kind, place), self._runs * 1000 + place
                await self._ask("setParam", name, value)
                try:
                    await role.wait_for(lambda seen, value=value: seen == value, timeout=PATIENCE)
                except TimeoutError:
                    problems.append(f"{node.name} was not told of {name}")
        return problems

    async def end(self) -> list[str]:
        """Close the nodes, after which the master must list nothing."""
        for node in self._nodes:
            await node.close(timeout=10)
        self._open.clear()
        return await self._differences()

    async def _ask(self, method: str, *params: Any) -> Any:
        return await self._client.call(self._master.uri, method, "/observer", *params)

    async def _ask_as(self, node: aioros1.Node, method: str, *params: Any) -> Any:
        """Ask the master itself, in the name of a node."""
        return await self._client.call(self._master.uri, method, node.name, *params)


def _name(node: aioros1.Node, kind: str, place: int) -> str:
    # A service has one provider; topics may have several of each.
    return (
        f"/topic_{place}" if kind in ("publisher", "subscriber") else f"{node.name}/{kind}_{place}"
    )


_OPENING: dict[str, Callable[[aioros1.Node, int], Any]] = {
    "publisher": lambda node, place: node.advertise(_name(node, "publisher", place), Numbered),
    "subscriber": lambda node, place: node.subscribe(_name(node, "subscriber", place), Numbered),
    "service": lambda node, place: node.advertise_service(
        _name(node, "service", place), Question, lambda request: None
    ),
    "parameter": lambda node, place: node.subscribe_param(
        _name(node, "parameter", place), default=None
    ),
}


def _unregistering(node: aioros1.Node, kind: str, place: int) -> tuple[str, ...]:
    """The request by which others unregister it."""
    name = _name(node, kind, place)
    return {
        "publisher": ("unregisterPublisher", name, node.uri),
        "subscriber": ("unregisterSubscriber", name, node.uri),
        "service": ("unregisterService", name, node.tcpros_uri),
        "parameter": ("unsubscribeParam", node.uri, name),
    }[kind]


@contextlib.contextmanager
def _no_descriptors() -> Iterator[None]:
    limits = resource.getrlimit(resource.RLIMIT_NOFILE)
    with socket.socket() as spare:
        lowest = spare.fileno()
    try:
        resource.setrlimit(resource.RLIMIT_NOFILE, (lowest, limits[1]))
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_NOFILE, limits)


SCENARIO = Scenario(
    "registrations",
    "The master is replaced by one of the same or other ids; roles are unregistered by others; "
    "requests are cut, delayed or never answered; the loop is blocked; no descriptors are left; "
    "meanwhile roles open and close",
    "faults",
    "in each calm the master lists what is open and nothing else, followed parameters arrive, and "
    "nothing is listed of a node that has closed",
    run,
    quick=10,
    short=250,
    full=5_000,
)
