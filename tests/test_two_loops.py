"""Event loops in threads of one process share nothing; and if they did, it would be noticed."""

from __future__ import annotations

import asyncio
import sys
from pathlib import Path
from typing import Any

import pytest

sys.path.append(str(Path(__file__).parents[1]))

import aioros1
from soak.scenarios.two_loops import LOOPS, Tally, contents, differs, run_on

SECONDS = 1.5
"""For each kind of loop; some thousand messages."""

# The threads have loops of both kinds, whatever the one is that watches them.
one_loop = pytest.mark.asyncio(loop_factories=["asyncio"])

on_linux = pytest.mark.skipif(sys.platform != "linux", reason="it uses abstract Unix sockets")


@one_loop
@on_linux
@pytest.mark.timeout(120)
@pytest.mark.parametrize("kind", LOOPS)
async def test_loops_in_threads_do_not_get_bytes_of_each_other(kind: str) -> None:
    tally = Tally()
    await run_on(LOOPS[kind], SECONDS, tally)
    assert not tally.all_problems()
    assert tally.counts["messages"] > 100
    assert tally.counts["calls"] > 10


# What is the use of checks that cannot fail?


@pytest.mark.parametrize("kind", contents("a"))
def test_a_message_of_another_topic_is_noticed(kind: str) -> None:
    ours, theirs = contents("a")[kind], contents("b")[kind]
    assert differs(type(ours).from_bytes(ours.to_bytes()), ours) == ""
    assert differs(theirs, ours)


@pytest.mark.parametrize("kind", ["small", "large", "image"])
def test_a_single_byte_of_another_topic_is_noticed(kind: str) -> None:
    ours = contents("a")[kind]
    spoiled = type(ours).from_bytes(ours.to_bytes()[:-1] + b"b")
    assert differs(spoiled, ours).endswith(f"1 times {'b' if kind != 'image' else 98!r}")


def test_a_single_name_of_another_topic_is_noticed() -> None:
    ours, spoiled = contents("a")["joints"], contents("a")["joints"]
    spoiled.name[7] = "b_joint_7"
    assert differs(spoiled, ours).startswith("name is ['a_joint_0', ")


def test_problems_are_counted_and_the_first_are_told() -> None:
    tally = Tally()
    for number in range(7):
        tally.report("wrong messages", f"number {number}")
    assert tally.all_problems()[0] == "wrong messages: number 0"
    assert tally.all_problems()[4:] == ["wrong messages: number 4", "wrong messages: 7 in all"]


@one_loop
@on_linux
async def test_an_event_loop_that_fails_holds_nobody_up(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(self: Any, *words: Any, **options: Any) -> Any:
        raise RuntimeError("no services here")

    monkeypatch.setattr(aioros1.Node, "advertise_service", fail)
    tally = Tally()
    async with asyncio.timeout(30):
        await run_on(asyncio.new_event_loop, SECONDS, tally)
    assert tally.wrong["exceptions"] == 4
    told = [problem for problem in tally.all_problems() if problem.startswith("exceptions: ")]
    assert all("no services here" in problem for problem in told)
