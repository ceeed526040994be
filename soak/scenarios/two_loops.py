"""Event loops in threads of one process, each with its own nodes, topics and services.

Whatever one of them sends is made of one letter. A byte of another letter has come from the
memory of another loop.
"""

from __future__ import annotations

import asyncio
import contextlib
import sys
import threading
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import aioros1
from aioros1.contrib.threads import NodeThread
from soak.scenario import Scenario, Seen

__all__ = ["LOOPS", "run", "run_on"]

PATIENCE = 60.0
"""Seconds that may pass until all are connected, and until what was sent has arrived."""

NO_PATIENCE = 1.0
"""The same once something was wrong: what is lost with a connection never arrives."""

SWITCH = 2e-5
"""Seconds after which threads take turns. Python's own 5 ms would seldom hit the moment in
which two loops could disturb each other."""

TRANSPORTS: dict[str, tuple[Any, ...]] = {
    "TCPROS": (),
    "UNIXROS": ("unix",),
    "INTRAPROCESS": ("intraprocess",),
}
"""What connections call a transport, and what nodes are told so that they use it."""

MOST_PROBLEMS = 5
"""Problems of a kind that are told; all are counted."""

LOOPS: dict[str, Callable[[], asyncio.AbstractEventLoop]] = {"asyncio": asyncio.new_event_loop}
with contextlib.suppress(ImportError):
    import uvloop

    LOOPS["uvloop"] = uvloop.new_event_loop


@dataclass
class Tally:
    """What all threads have seen."""

    counts: Counter[str] = field(default_factory=Counter)
    wrong: Counter[str] = field(default_factory=Counter)
    problems: list[str] = field(default_factory=list)
    _lock: threading.Lock = field(default_factory=threading.Lock)

    def add(self, counts: Counter[str]) -> None:
        with self._lock:
            self.counts.update(counts)

    def report(self, kind: str, text: str) -> None:
        with self._lock:
            self.wrong[kind] += 1
            if self.wrong[kind] <= MOST_PROBLEMS:
                self.problems.append(f"{kind}: {text}")

    @property
    def patience(self) -> float:
        return NO_PATIENCE if self.wrong else PATIENCE

    def all_problems(self) -> list[str]:
        more = [
            f"{kind}: {count:,} in all"
            for kind, count in self.wrong.items()
            if count > MOST_PROBLEMS
        ]
        return self.problems + more


class Phases:
    """What the threads do together: nobody sends until all are connected, and nobody closes
    until all have received what they wait for."""

    def __init__(self, threads: int) -> None:
        self.is_over = threading.Event()
        """Whether it is time to stop sending."""
        self._threads = threads
        self._arrived: Counter[str] = Counter()
        self._lock = threading.Lock()

    async def all_have(self, what: str) -> None:
        """Wait until every thread is here, or one has given up."""
        with self._lock:
            self._arrived[what] += 1
        await self.reached(what)

    async def reached(self, what: str) -> None:
        """Wait as :meth:`all_have` does, as somebody who watches."""
        while self._arrived[what] < self._threads:
            await asyncio.sleep(0.01)

    def give_up(self) -> None:
        """Let nobody wait for this thread."""
        self.is_over.set()
        with self._lock:
            self._threads -= 1


class World:
    """What one event loop does: all kinds of messages by all transports, and calls, to nodes
    of its own and of its neighbour."""

    def __init__(
        self, letter: str, neighbour: str, master_uri: str, phases: Phases, tally: Tally
    ) -> None:
        self._letter = letter
        self._neighbour = neighbour
        self._options: dict[str, Any] = {
            "master_uri": master_uri, "rosout": False, "logger_services": False,
        }  # fmt: skip
        self._phases = phases
        self._tally = tally
        self._counts: Counter[str] = Counter()
        self._is_closing = False

    def run_in_runner(self, loop_factory: Callable[[], asyncio.AbstractEventLoop]) -> None:
        """In a thread: with an event loop that the program runs itself."""
        with self._reported(), asyncio.Runner(loop_factory=loop_factory) as runner:
            runner.run(self._run_alone())

    def run_in_node_thread(self, loop_factory: Callable[[], asyncio.AbstractEventLoop]) -> None:
        """With an event loop that a :class:`NodeThread` has made."""
        name = f"{self._letter}_receiver"
        with (
            self._reported(),
            NodeThread(name, loop_factory=loop_factory, **self._options) as ros,
        ):
            ros.run(self._run(ros.node))

    @contextlib.contextmanager
    def _reported(self) -> Iterator[None]:
        try:
            yield
        except BaseException as error:
            self._tally.report("exceptions", f"loop {self._letter!r} ended with {error!r}")
            self._phases.give_up()
        self._tally.add(self._counts)

    async def _run_alone(self) -> None:
        async with aioros1.Node(f"{self._letter}_receiver", **self._options) as node:
            await self._run(node)

    async def _run(self, node: aioros1.Node) -> None:
        """``node`` is the one that receives over TCP; the others are made here."""
        async with contextlib.AsyncExitStack() as stack, asyncio.TaskGroup() as tasks:
            watching = []
            flows = []
            for transport, wanted in TRANSPORTS.items():
                options = self._options | {"local_transports": wanted}
                name = f"{self._letter}_{transport.lower()}"
                sender = await stack.enter_async_context(aioros1.Node(name, **options))
                receiver = node
                if wanted:
                    receiver = aioros1.Node(f"{name}_receiver", **options)
                    await stack.enter_async_context(receiver)
                watching += [tasks.create_task(self._watch(one)) for one in (sender, receiver)]
                for kind, message in contents(self._letter).items():
                    topic = f"{self._letter}/{transport.lower()}/{kind}"
                    flows.append(await self._flow(sender, receiver, topic, message, transport))
                if transport != "INTRAPROCESS":  # which does not lead to another loop
                    topic = f"{self._letter}/{transport.lower()}/small"
                    flows.append(await self._abroad(receiver, topic, transport))
            callers = [await self._caller(node, to) for to in (self._letter, self._neighbour)]
            for flow in flows:
                await flow.connected()
            await self._phases.all_have("connected")
            sending = [tasks.create_task(flow.send(self._phases.is_over)) for flow in flows]
            receiving = [tasks.create_task(flow.receive()) for flow in flows]
            calling = [tasks.create_task(self._call(caller)) for caller in callers]
            while not self._phases.is_over.is_set():
                await asyncio.sleep(0.05)
            await asyncio.wait([*sending, *calling], timeout=self._tally.patience)
            await self._phases.all_have("sent")
            for flow in flows:
                await flow.arrived()
            await self._phases.all_have("received")
            self._is_closing = True
            for task in (*watching, *receiving, *sending, *calling):
                task.cancel()

    # topics

    async def _flow(
        self, sender: aioros1.Node, receiver: aioros1.Node, topic: str, message: Any, transport: str
    ) -> Flow:
        """From here to here. Nodes are closed with what was opened on them."""
        pub = await sender.advertise(topic, type(message), overflow="block")
        sub = await receiver.subscribe(topic, type(message), overflow="block")
        return Flow(pub, sub, message, transport, self._counts, self._tally)

    async def _abroad(self, receiver: aioros1.Node, topic: str, transport: str) -> Flow:
        """From the neighbour to here."""
        topic = f"{self._neighbour}{topic.removeprefix(self._letter)}"
        message = contents(self._neighbour)["small"]
        sub = await receiver.subscribe(topic, type(message), overflow="block")
        return Flow(None, sub, message, transport, self._counts, self._tally)

    async def _watch(self, node: aioros1.Node) -> None:
        """Nobody disconnects anybody before the end."""
        async for event in node.events():
            match event:
                case aioros1.PeerDisconnected() if not self._is_closing:
                    self._tally.report(
                        "lost connections",
                        f"{event.kind} {event.name} of {node.name}: {event.reason}",
                    )
                case aioros1.MasterLost() if not self._is_closing:
                    self._tally.report("lost masters", node.name)

    # services

    async def _caller(self, node: aioros1.Node, to: str) -> Any:
        if to == self._letter:
            await node.advertise_service(f"{to}/ask", "std_srvs/SetBool", self._answer)
        await node.wait_for_service(f"{to}/ask", timeout=PATIENCE)
        caller = await node.service_caller(f"{to}/ask", "std_srvs/SetBool", persistent=True)
        await caller.call(data=True, timeout=PATIENCE)
        return caller

    def _answer(self, request: Any) -> dict[str, Any]:
        return {"success": request.data, "message": self._letter * 1_000}

    async def _call(self, caller: Any) -> None:
        expected = caller.name[1] * 1_000
        number = 0
        while not self._phases.is_over.is_set():
            number += 1
            reply = await caller.call(data=number % 2 == 1, timeout=PATIENCE)
            self._counts["calls"] += 1
            if reply.message != expected or reply.success != (number % 2 == 1):
                self._tally.report("wrong answers", f"{caller.name}: {shown(reply.message)}")


class Flow:
    """One topic, from a publisher to a subscriber; the publisher may be in another loop."""

    def __init__(
        self,
        pub: Any,
        sub: Any,
        message: Any,
        transport: str,
        counts: Counter[str],
        tally: Tally,
    ) -> None:
        self._pub = pub
        self._sub = sub
        self._message = message
        self._transport = transport
        self._counts = counts
        self._tally = tally
        self._sent = 0
        self._got = 0

    async def connected(self) -> None:
        await self._sub.wait_for_publishers(timeout=PATIENCE)
        if self._pub is not None:
            await self._pub.wait_for_subscribers(timeout=PATIENCE)
        (connection,) = self._sub.connections
        if connection.transport != self._transport:
            self._tally.report("transports", f"{self._sub.name} came by {connection.transport}")

    async def send(self, is_over: threading.Event) -> None:
        while self._pub is not None and not is_over.is_set():
            await self._pub.send(self._message)
            self._sent += 1
            await asyncio.sleep(0)

    async def receive(self) -> None:
        expected = self._message
        async for message in self._sub:
            self._got += 1
            self._counts["messages"] += 1
            if difference := differs(message, expected):
                self._tally.report("wrong messages", f"{self._sub.name}: {difference}")

    async def arrived(self) -> None:
        """Wait for what was sent here; of what the neighbour sends, nobody has counted."""
        try:
            async with asyncio.timeout(self._tally.patience):
                while self._pub is not None and self._got < self._sent:
                    await asyncio.sleep(0.01)
        except TimeoutError:
            self._tally.report(
                "lost messages", f"{self._sub.name}: {self._sent} sent, {self._got} received"
            )
        if errors := self._sub.stats.errors:
            self._tally.report("unreadable messages", f"{self._sub.name}: {errors}")


def contents(letter: str) -> dict[str, Any]:
    """One message of each kind, made of one letter, as it arrives."""
    string = aioros1.load_msg("std_msgs/String")
    joints = aioros1.load_msg("sensor_msgs/JointState")
    image = aioros1.load_msg("sensor_msgs/Image")
    number = float(ord(letter))
    made = {
        "small": string(data=letter * 40),
        "large": string(data=letter * 200_000),
        "joints": joints(
            # Strings that come again and again, and that are of this loop alone.
            name=[f"{letter}_joint_{i}" for i in range(20)],
            position=[number] * 20,
        ),
        "image": image(
            encoding=letter * 4, height=300, width=300, step=300, data=letter.encode() * 90_000
        ),
    }
    return {kind: type(each).from_bytes(each.to_bytes()) for kind, each in made.items()}


def differs(message: Any, expected: Any) -> str:
    """What is wrong with a message; nothing, if it is as it was sent."""
    for name in expected.__slots__:
        theirs, ours = getattr(message, name), getattr(expected, name)
        if name == "header":  # the publisher counts there
            theirs, ours = theirs.frame_id, ours.frame_id
        if theirs != ours:
            return f"{name} is {shown(theirs)}"
    return ""


def shown(value: Any) -> str:
    """Which characters or bytes there are how often, or the beginning."""
    if isinstance(value, str | bytes):
        return ", ".join(
            f"{count:,} times {each!r}" for each, count in Counter(value).most_common(3)
        )
    return repr(value)[:100]


async def run(times: int) -> Seen:
    """``times`` is how many seconds, on all kinds of event loop together."""
    tally = Tally()
    for loop_factory in LOOPS.values():
        await run_on(loop_factory, times / len(LOOPS), tally)
    text = (
        f"{tally.counts['messages']:,} messages and {tally.counts['calls']:,} calls in four "
        f"threads, {tally.wrong['wrong messages'] + tally.wrong['wrong answers']:,} of them wrong"
    )
    return Seen(text, tally.all_problems())


async def run_on(
    loop_factory: Callable[[], asyncio.AbstractEventLoop], seconds: float, tally: Tally
) -> None:
    """Two loops that the program runs, and two of :class:`NodeThread`, all at the same time.

    It ends early when something is wrong.
    """
    phases = Phases(4)
    async with aioros1.Master(host="localhost", port=0, rosout=False) as master:
        ways = [World.run_in_runner, World.run_in_runner]
        ways += [World.run_in_node_thread, World.run_in_node_thread]
        threads = [
            threading.Thread(
                target=way,
                args=(World(*pair, master.uri, phases, tally), loop_factory),
                daemon=True,
            )
            for way, pair in zip(ways, ("ab", "ba", "cd", "dc"), strict=True)
        ]
        with _eager_threads():
            for thread in threads:
                thread.start()
            await phases.reached("connected")
            with contextlib.suppress(TimeoutError):
                async with asyncio.timeout(seconds):
                    while not (phases.is_over.is_set() or tally.wrong):
                        await asyncio.sleep(0.05)
            phases.is_over.set()
            while any(thread.is_alive() for thread in threads):
                await asyncio.sleep(0.01)


@contextlib.contextmanager
def _eager_threads() -> Iterator[None]:
    interval = sys.getswitchinterval()
    sys.setswitchinterval(SWITCH)
    try:
        yield
    finally:
        sys.setswitchinterval(interval)


SCENARIO = Scenario(
    "two-loops",
    "Event loops in four threads of one process, with topics and services of their own, over TCP, "
    "Unix sockets and memory",
    "seconds",
    "every byte that arrives is of its topic, every message and answer arrives, and no connection "
    "is lost",
    run,
    quick=4,
    short=60,
    full=600,
)
