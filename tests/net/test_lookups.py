"""Looking up names: who waits for whom, and what is remembered."""

from __future__ import annotations

import asyncio
import gc
import os
import socket
import subprocess
import sys
import textwrap
import threading
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

import aioros1
from aioros1.net import lookups
from aioros1.net.hosts import resolve

ROOT = Path(aioros1.__file__).parent.parent


class Resolver:
    """The system's resolver: names that are known, unknown, or not answered for now."""

    def __init__(self) -> None:
        self.asked: Counter[str] = Counter()
        self.known: dict[str, str] = {}
        self.slow: dict[str, threading.Event] = {}

    def getaddrinfo(self, host: str, port: object, *_: Any, **__: Any) -> list[Any]:
        self.asked[host] += 1
        if host in self.slow:
            self.slow[host].wait(60)
        if host not in self.known:
            raise socket.gaierror(socket.EAI_NONAME, "Name or service not known")
        return [(socket.AF_INET, socket.SOCK_STREAM, 6, "", (self.known[host], 0))]

    def hold(self, *hosts: str) -> None:
        for host in hosts:
            self.slow[host] = threading.Event()

    def release(self) -> None:
        for event in self.slow.values():
            event.set()


@pytest.fixture
def resolver(monkeypatch: pytest.MonkeyPatch) -> Iterator[Resolver]:
    made = Resolver()
    monkeypatch.setattr(socket, "getaddrinfo", made.getaddrinfo)
    yield made
    made.release()


async def until(condition: Callable[[], bool]) -> None:
    async with asyncio.timeout(30):
        while not condition():
            await asyncio.sleep(0.001)


async def test_a_name_is_looked_up_once_for_all_who_wait(resolver: Resolver) -> None:
    resolver.known["robot"] = "10.0.0.1"
    resolver.hold("robot")
    names = ("robot", "Robot", "robot", "ROBOT", "robot")
    waiting = [asyncio.create_task(resolve(name)) for name in names]
    await until(lambda: resolver.asked["robot"] == 1)
    waiting[0].cancel()
    waiting[3].cancel()
    await until(waiting[3].done)
    resolver.release()
    found = await asyncio.gather(*waiting, return_exceptions=True)
    assert [isinstance(each, asyncio.CancelledError) for each in found] == [
        *(True, False, False, True, False)
    ]
    assert found[1] == found[2] == found[4] == [(socket.AF_INET, "10.0.0.1")]
    assert resolver.asked == {"robot": 1}
    # Whoever comes later asks again: what a name means may have changed.
    resolver.known["robot"] = "10.0.0.2"
    assert await resolve("robot") == [(socket.AF_INET, "10.0.0.2")]


async def test_a_look_up_goes_on_for_those_who_come_after_all_others_left(
    resolver: Resolver,
) -> None:
    resolver.known["robot"] = "10.0.0.1"
    resolver.hold("robot")
    first = asyncio.create_task(resolve("robot"))
    await until(lambda: resolver.asked["robot"] == 1)
    first.cancel()
    await asyncio.wait([first])
    second = asyncio.create_task(resolve("robot"))
    await asyncio.sleep(0)
    resolver.release()
    assert await second == [(socket.AF_INET, "10.0.0.1")]
    assert resolver.asked == {"robot": 1}


async def test_a_failure_is_remembered_for_a_moment(
    resolver: Resolver, monkeypatch: pytest.MonkeyPatch
) -> None:
    errors = []
    for _ in range(3):
        with pytest.raises(socket.gaierror, match="not known") as caught:
            await resolve("robot")
        errors.append(caught.value)
    assert resolver.asked == {"robot": 1}
    assert len(set(map(id, errors))) == 3
    monkeypatch.setattr(lookups, "SHORTEST_MEMORY", 0.01)
    monkeypatch.setattr(lookups, "LONGEST_MEMORY", 0.01)
    with pytest.raises(socket.gaierror):
        await resolve("other")
    resolver.known["other"] = "10.0.0.1"

    async def found() -> bool:
        try:
            return bool(await resolve("other"))
        except OSError:
            return False

    async with asyncio.timeout(30):
        while not await found():
            await asyncio.sleep(0.001)
    assert resolver.asked["other"] == 2


async def test_names_without_an_answer_hold_up_no_others(resolver: Resolver) -> None:
    slow = [f"slow{number}" for number in range(100)]
    resolver.known |= dict.fromkeys([*slow, "robot"], "10.0.0.1")
    resolver.hold(*slow)
    waiting = [asyncio.create_task(resolve(host)) for host in slow]
    await until(lambda: len(resolver.asked) == 100)
    # Neither other names, nor what the program itself does in threads, nor its own look-ups.
    assert await resolve("robot") == [(socket.AF_INET, "10.0.0.1")]
    assert await asyncio.to_thread(lambda: "done") == "done"
    resolver.release()
    assert await asyncio.gather(*waiting) == [[(socket.AF_INET, "10.0.0.1")]] * 100


async def test_threads_are_bounded_and_names_in_order_do_not_wait(
    resolver: Resolver, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(lookups, "THREADS", 3)
    resolver.known |= dict.fromkeys(["robot", "later", "d", "e"], "10.0.0.1")
    await resolve("robot")
    resolver.hold("a", "b", "c", "d")
    waiting = {host: asyncio.create_task(resolve(host)) for host in ("a", "b", "c", "d", "e")}
    await until(lambda: len(resolver.asked) == 4)
    later = asyncio.create_task(resolve("later"))
    assert await resolve("robot") == [(socket.AF_INET, "10.0.0.1")]
    assert set(resolver.asked) == {"robot", "a", "b", "c"}
    # A look-up that nobody waits for any more never begins.
    waiting["e"].cancel()
    await asyncio.wait([waiting["e"]])
    resolver.release()
    assert await waiting["d"] == await later == [(socket.AF_INET, "10.0.0.1")]
    found = await asyncio.gather(*(waiting[host] for host in "abc"), return_exceptions=True)
    assert all(isinstance(each, socket.gaierror) for each in found)
    assert "e" not in resolver.asked


async def test_a_system_without_threads_is_an_error_of_the_look_up(
    resolver: Resolver, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: Any) -> None:
        raise RuntimeError("can't start new thread")

    resolver.known |= dict.fromkeys(["robot", "other", "third"], "10.0.0.1")
    start = lookups.start_new_thread
    monkeypatch.setattr(lookups, "start_new_thread", refuse)
    with pytest.raises(OSError, match=r"cannot look up 'robot': can't start new thread"):
        await resolve("robot")
    # While a thread runs, the next waits for it.
    monkeypatch.setattr(lookups, "start_new_thread", start)
    resolver.hold("other")
    other = asyncio.create_task(resolve("other"))
    await until(lambda: resolver.asked["other"] == 1)
    monkeypatch.setattr(lookups, "start_new_thread", refuse)
    third = asyncio.create_task(resolve("third"))
    await asyncio.sleep(0)
    monkeypatch.setattr(lookups, "start_new_thread", start)
    resolver.release()
    assert await other == await third == [(socket.AF_INET, "10.0.0.1")]


def test_a_loop_closes_while_a_name_is_looked_up(resolver: Resolver) -> None:
    resolver.hold("robot")

    async def main() -> None:
        with pytest.raises(TimeoutError):
            async with asyncio.timeout(0.01):
                await resolve("robot")

    asyncio.run(main())
    gc.collect()
    resolver.release()


@pytest.mark.slow
def test_a_program_ends_while_names_are_looked_up() -> None:
    program = """
        import asyncio, socket, time
        def getaddrinfo(host, *_, **__):
            time.sleep(3600)
        socket.getaddrinfo = getaddrinfo
        import aioros1
        async def main():
            options = {"host": "localhost", "rosout": False, "logger_services": False}
            async with aioros1.Node("demo", master_uri="http://robot:1", **options) as node:
                try:
                    await node.wait_for_master(timeout=0.1)
                except TimeoutError:
                    print("ended")
        asyncio.run(main())
    """
    ended = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(program)],
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "ended\n", "")
