"""A master and a node under attack over real sockets, and healthy peers in their midst.

Not guided by coverage: seeded, so that the same attackers send the same. While they do,
a second node calls, asks and listens, and must get everything; at the end nothing may be
left of the attack: no task, no descriptor, no memory, and nothing of what the healthy own.
"""

from __future__ import annotations

import asyncio
import contextlib
import ctypes
import gc
import logging
import os
import sys
import time
from collections import Counter, deque
from collections.abc import Callable
from dataclasses import dataclass
from hashlib import sha1
from pathlib import Path
from random import Random
from typing import Any

import aioros1
from aioros1.xmlrpc.client import XmlRpcClient
from fuzz.documents import DEAD, MASTER, SLAVE
from fuzz.http_attack import HttpAttack
from fuzz.requests import MAX_BODY
from fuzz.tcpros_attack import MAX_FRAME, MAX_HEADER, TcprosAttack

__all__ = ["Report", "attack"]

LIMITS = aioros1.Limits(
    header_bytes=MAX_HEADER,
    header_fields=64,
    message_bytes=MAX_FRAME,
    xmlrpc_bytes=MAX_BODY,
    xmlrpc_depth=20,
)
_HTTP_CLIENTS = 16
_TCPROS_CLIENTS = 6
_WARM_UP = 0.1
SETTLE = 30.0
"""Seconds until nothing may be left of an attack."""
_MOST_KIB, _MOST_OBJECTS = 64 << 10, 10_000
"""How much more memory there may be in the end than after the warm-up."""
_SLACK = 40
"""Connections that are kept for a while, of which each may have a task and two descriptors."""


class Finding(AssertionError):
    """Something that should not be; ``inputs`` is what was sent last."""

    def __init__(self, text: str, inputs: list[bytes] | None = None) -> None:
        super().__init__(text)
        self.inputs = inputs or []


@dataclass
class Report:
    """What an attack came to."""

    seconds: float
    counts: Counter[str]
    memory: list[tuple[int, int]]
    """Kilobytes resident, and objects of the garbage collector: warmed up, and at the end."""
    healthy: Counter[str]

    def __str__(self) -> str:
        counts, (before, after) = self.counts, self.memory
        total = counts["http sent"] + counts["tcpros sent"]
        lines = [
            f"{total:,} requests in {self.seconds:.0f} s, {total / self.seconds:,.0f} a second"
        ]
        for kind in ("http", "tcpros"):
            words = ("sent", "connections", "answered", "faults", "refused")
            parts = [f"{counts[f'{kind} {word}']:,} {word}" for word in words]
            lines.append(f"{kind}: {', '.join(parts)}")
        lines.append("healthy: " + ", ".join(f"{n:,} {word}" for word, n in self.healthy.items()))
        lines.append(
            f"memory: {before[0]:,} KiB and {before[1]:,} objects warmed up, "
            f"{after[0]:,} KiB and {after[1]:,} objects at the end"
        )
        return "\n".join(lines)


class _Errors(logging.Handler):
    """Errors that were logged: an attack is no reason for any."""

    def __init__(self) -> None:
        super().__init__(logging.ERROR)
        self.seen: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        self.seen.append(self.format(record))


class _World:
    """A master and a node, and a friend of theirs."""

    def __init__(self) -> None:
        self.healthy: Counter[str] = Counter()
        self.is_over = False
        self.client = XmlRpcClient()
        self._stack = contextlib.AsyncExitStack()

    async def __aenter__(self) -> _World:
        async with contextlib.AsyncExitStack() as stack:
            stack.push_async_callback(self.client.close)
            self.master = await stack.enter_async_context(
                aioros1.Master("127.0.0.1", 0, rosout=False, limits=LIMITS)
            )
            options: Any = {"master_uri": self.master.uri, "host": "127.0.0.1", "limits": LIMITS}
            options |= {"rosout": False, "logger_services": False}
            self.node = await stack.enter_async_context(aioros1.Node("target", **options))
            self.friend = await stack.enter_async_context(aioros1.Node("friend", **options))
            node, friend = self.node, self.friend
            enter: Any = stack.enter_async_context
            self._out = await enter(node.advertise("/healthy/out", "std_msgs/String"))
            self._back = await enter(friend.advertise("/healthy/back", "std_msgs/String"))
            self._out_sub = await enter(friend.subscribe("/healthy/out", overflow="block"))
            self._back_sub = await enter(node.subscribe("/healthy/back", overflow="block"))
            service = "roscpp_tutorials/TwoInts"
            for name in ("/healthy/add", "/fz/service"):
                await enter(node.advertise_service(name, service, _add))
            self._caller = await enter(friend.service_caller("/healthy/add", service))
            # What attackers play with.
            self._bait = await enter(node.advertise("/fz/topic", "std_msgs/String"))
            await enter(node.subscribe("/fz/sub"))
            await enter(node.subscribe_param("/fz/param", default=None))
            await friend.set_param("/healthy/param", {"a": [1, "two", {"b": 3.5}]})
            await self._out.wait_for_subscribers(timeout=30)
            await self._back.wait_for_subscribers(timeout=30)
            self._stack = stack.pop_all()
        self._owned = await self._possessions()
        return self

    async def __aexit__(self, *exc: object) -> None:
        await self._stack.aclose()

    async def live(self) -> None:
        """What healthy nodes do, until :attr:`is_over`."""
        while not self.is_over:
            await self.live_once()
            await asyncio.sleep(0.002)

    async def live_once(self) -> None:
        """One of everything; all of it must work."""
        node, friend, count = self.node, self.friend, self.healthy["messages"]
        self._bait.publish(data="fz")
        for publisher, subscriber in ((self._out, self._out_sub), (self._back, self._back_sub)):
            for number in range(5):
                publisher.publish(data=f"{count + number}")
            for number in range(5):
                message = await subscriber.get(timeout=60)
                assert message.data == f"{count + number}", message
        assert (await self._caller.call(a=count, b=1, timeout=60)).sum == count + 1
        peer = await friend.peer(node.name)
        assert await peer.get_pid() == os.getpid()
        assert (await friend.get_param("/healthy/param"))["a"][1] == "two"
        await friend.set_param("/healthy/count", count)
        self.healthy.update({"messages": 5, "calls": 1, "requests": 4})

    async def settle(self, left: Callable[[], str | None]) -> None:
        """Take back what attackers have registered, and wait until nothing is ``left``."""
        call, master = self.client.call, self.master.uri
        await call(self.node.uri, "publisherUpdate", "/fuzzer", "/fz/sub", [])
        state = (await call(master, "getSystemState", "/fuzzer"))[2]
        own = {self.node.name, self.friend.name}
        apis = {}
        for kind, method in enumerate(("unregisterPublisher", "unregisterSubscriber")):
            for topic, names in state[kind]:
                for name in set(names) - own:
                    apis[name] = (await call(master, "lookupNode", "/fuzzer", name))[2]
                    await call(master, method, name, topic, apis[name])
        for service, names in state[2]:
            for name in set(names) - own:
                api = (await call(master, "lookupService", "/fuzzer", service))[2]
                await call(master, "unregisterService", name, service, api)
        service = ("/fz/service", self.node.tcpros_uri, self.node.uri)
        await call(master, "registerService", self.node.name, *service)
        for key in (await call(master, "getParamNames", "/fuzzer"))[2]:
            if not key.startswith(("/healthy/", "/run_id", "/rosdistro", "/rosversion")):
                await call(master, "deleteParam", "/fuzzer", key)
        for name in "abcd":
            for key in ("/fz/topic", "/fz/sub", "/fz/service", "/fz/param", "/fz/a", "/fz/a/b"):
                await call(master, "unsubscribeParam", f"/fuzzer/{name}", DEAD, key)
        await _until_none(left)

    async def check(self) -> None:
        """Alive, and everything that the healthy own is as it was."""
        await self.live_once()
        now = await self._possessions()
        if now != self._owned:
            raise Finding(f"healthy peers have {now}, and had {self._owned}")

    async def _possessions(self) -> Any:
        friend = self.friend
        state = await friend.master.get_system_state()
        rows = [sorted(map(repr, kind)) for kind in state]
        kept = [[row for row in kind if "/healthy" in row] for kind in rows]
        uris = [await friend.master.lookup_node(each.name) for each in (self.node, friend)]
        params = {
            key: await friend.get_param(key)
            for key in await friend.get_param_names()
            if not key.startswith(("/fz", "/fuzzer")) and key != "/healthy/count"
        }
        peers = sorted((info.name, info.direction) for info in self.node.connections)
        return kept, uris, params, [peer for peer in peers if peer[0].startswith("/healthy")]


async def _until_none(left: Callable[[], str | None]) -> None:
    end = time.monotonic() + SETTLE
    while (objection := left()) is not None:
        if time.monotonic() > end:
            raise Finding(f"left behind: {objection}")
        await asyncio.sleep(0.01)


def _add(request: Any) -> dict[str, int]:
    # With 64 bits, as C++ does it: whatever is asked for, the handler is not to blame.
    return {"sum": (request.a + request.b + (1 << 63)) % (1 << 64) - (1 << 63)}


async def attack(
    requests: int, *, seed: int = 0, only: str | None = None, findings: Path | None = None
) -> Report:
    """Send ``requests`` requests, of kind ``only`` or of both; :class:`Finding` if one is found."""
    errors = _Errors()
    loggers = [logging.getLogger(name) for name in ("aioros1", "ros", "asyncio")]
    kept = [(logger, logger.level, logger.propagate) for logger in loggers]
    for logger in loggers:
        logger.addHandler(errors)
        logger.setLevel(logging.ERROR)
        logger.propagate = False
    descriptors = _descriptors()
    tasks = asyncio.all_tasks()
    try:
        report = await _attack(requests, Random(seed), only, errors)

        def left() -> str | None:
            more, running = _descriptors() - descriptors, asyncio.all_tasks() - tasks
            return f"{more} descriptors, tasks: {running}" if more > 0 or running else None

        await _until_none(left)
        if errors.seen:
            raise Finding("\n".join(errors.seen[:5]))
        return report
    except (Finding, BaseExceptionGroup) as error:
        finding = _first(error)
        if findings is not None:
            _keep(finding, findings)
        raise finding from error
    finally:
        for logger, level, propagate in kept:
            logger.removeHandler(errors)
            logger.setLevel(level)
            logger.propagate = propagate


async def _attack(requests: int, random: Random, only: str | None, errors: _Errors) -> Report:
    counts: Counter[str] = Counter()
    memory: list[tuple[int, int]] = []
    seconds = 0.0
    async with _World() as world:
        await world.live_once()
        before, descriptors = _tasks(), _descriptors()

        def left() -> str | None:
            more = +(_tasks() - before)
            if sum(more.values()) > _SLACK or any(n > 10 for n in more.values() if n < _SLACK):
                return f"tasks: {more}"
            if _descriptors() > descriptors + 2 * _SLACK:
                return f"{_descriptors()} descriptors where there were {descriptors}"
            return None

        warm_up = max(1, round(requests * _WARM_UP))
        for share in (warm_up, requests - warm_up):
            began = time.monotonic()
            await _round(world, share, random, only, errors, counts)
            seconds += time.monotonic() - began
            await world.settle(left)
            await world.check()
            memory.append(_memory())
    _check_memory(requests, *memory)
    return Report(seconds, counts, memory, world.healthy)


async def _round(
    world: _World,
    requests: int,
    random: Random,
    only: str | None,
    errors: _Errors,
    counts: Counter[str],
) -> None:
    """All attackers at once, until the requests are sent."""
    ports = [_port(world.master.uri), _port(world.node.uri)]
    attackers: list[tuple[str, HttpAttack | TcprosAttack, deque[bytes]]] = []
    if only != "tcpros":
        for number in range(_HTTP_CLIENTS):
            sent: deque[bytes] = deque(maxlen=20)
            own = Random(random.getrandbits(64))
            way = number % 2
            http = HttpAttack(own, ports[way], (MASTER, SLAVE)[way], sent)
            attackers.append(("http", http, sent))
    if only != "http":
        for _ in range(_TCPROS_CLIENTS):
            sent = deque(maxlen=20)
            own = Random(random.getrandbits(64))
            port = world.node.tcpros_address[1]
            attackers.append(("tcpros", TcprosAttack(own, port, sent), sent))
    budget = [requests]

    async def run(client: HttpAttack | TcprosAttack, sent: deque[bytes]) -> None:
        try:
            await client.run(budget)
            if errors.seen:
                raise AssertionError(errors.seen[0])
        except (AssertionError, TimeoutError, ValueError) as error:
            raise Finding(f"{type(error).__name__}: {error}", list(sent)) from error

    async def live() -> None:
        try:
            await world.live()
        except (AssertionError, TimeoutError, aioros1.RosError) as error:
            raise Finding(f"a healthy peer: {error!r}") from error

    async with asyncio.TaskGroup() as healthy:
        world.is_over = False
        healthy.create_task(live())
        async with asyncio.TaskGroup() as group:
            for _, client, sent in attackers:
                group.create_task(run(client, sent))
        world.is_over = True
    for kind, client, _ in attackers:
        for word in ("sent", "connections", "answered", "faults", "refused"):
            counts[f"{kind} {word}"] += getattr(client, word)


def _port(uri: str) -> int:
    return int(uri.rstrip("/").rpartition(":")[2])


def _tasks() -> Counter[str]:
    return Counter(getattr(task.get_coro(), "__qualname__", "?") for task in asyncio.all_tasks())


def _descriptors() -> int:
    count = 0
    for entry in Path("/proc/self/fd").iterdir():
        with contextlib.suppress(OSError):  # the one that lists the others
            count += entry.readlink() != Path("/dev/null")  # uvloop keeps one in reserve
    return count


def _memory() -> tuple[int, int]:
    gc.collect()
    with contextlib.suppress(AttributeError):  # what is free is not in use: glibc alone keeps it
        ctypes.CDLL(None).malloc_trim(0)
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") // 1024, len(gc.get_objects())


def _first(error: BaseException) -> Finding:
    while isinstance(error, BaseExceptionGroup):
        error = next(
            (each for each in error.exceptions if not isinstance(each, asyncio.CancelledError)),
            error.exceptions[0],
        )
    return error if isinstance(error, Finding) else Finding(repr(error))


def _check_memory(requests: int, before: tuple[int, int], after: tuple[int, int]) -> None:
    """Some is kept for names that are new, and some in free lists; but not of each request."""
    if after[0] - before[0] > _MOST_KIB or after[1] - before[1] > _MOST_OBJECTS + requests // 50:
        raise Finding(f"memory, in KiB and objects: {before} warmed up, {after} at the end")


def _keep(finding: Finding, findings: Path) -> None:
    name = sha1(str(finding).encode("utf-8", "replace"), usedforsecurity=False).hexdigest()[:12]
    folder = findings / f"live-{name}"
    folder.mkdir(parents=True, exist_ok=True)
    for number, data in enumerate(finding.inputs):
        (folder / f"{number:03}").write_bytes(data)
    (folder / "finding.txt").write_text(str(finding), errors="replace")
    print(f"what was sent last: {folder}", file=sys.stderr)


def main(requests: int, seed: int, only: str | None, loop: str, findings: Path) -> bool:
    """Attack, and print what came of it; whether all was well."""
    print(f"seed {seed}", flush=True)
    factory = None
    if loop == "uvloop":
        import uvloop

        factory = uvloop.new_event_loop
    with asyncio.Runner(loop_factory=factory) as runner:
        try:
            report = runner.run(attack(requests, seed=seed, only=only, findings=findings))
        except Finding as finding:
            print(f"found: {finding}", flush=True)
            return False
        print(report, flush=True)
    return True
