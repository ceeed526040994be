"""The scenarios of the soak, as often as takes a second or two; and that they can fail."""

from __future__ import annotations

import asyncio
import json
import socket
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

sys.path.append(str(Path(__file__).parents[1]))

from soak.footprint import Footprint
from soak.messages import Question, Run
from soak.model import Model
from soak.scenarios import SCENARIOS, chaos

ROOT = Path(__file__).parents[1]

pytestmark = pytest.mark.skipif(
    sys.platform != "linux", reason="they look into /proc, and use all of 127.0.0.0/8"
)


ELSEWHERE = {"churn", "two-loops"}
"""Those with a test of their own: here, and in ``test_two_loops.py``."""


@pytest.mark.parametrize("name", [name for name in SCENARIOS if name not in ELSEWHERE])
async def test_what_is_promised_is_kept(name: str) -> None:
    scenario = SCENARIOS[name]
    seen = await scenario.run(scenario.quick)
    assert not seen.problems
    assert seen.text


async def test_nodes_that_come_and_go_find_each_other_again() -> None:
    scenario = SCENARIOS["churn"]
    assert not (await scenario.run(scenario.quick)).problems


# What is the use of checks that cannot fail?


async def test_what_is_left_behind_is_noticed() -> None:
    before = await Footprint.take(0)
    assert not before.problems_since(before)
    waiting = asyncio.create_task(asyncio.sleep(60))
    with socket.socket():
        after = await Footprint.take(0)
    waiting.cancel()
    assert after.problems_since(before) == [
        "left behind: 1 tasks",
        "left behind: 1 file descriptors",
    ]


def test_messages_that_are_missing_or_out_of_order_are_noticed() -> None:
    run = Run()
    for number in (5, 6, 8, 7):
        run.got(number)
    assert run.problems == ["8 came after 6", "7 came after 8"]


def test_what_ended_well_has_to_arrive() -> None:
    model = Model()
    publisher, subscriber = model.begin(), model.begin()
    for number in range(3):
        model.got(subscriber, "/topic", publisher, number)
        model.sent[publisher] = number + 1
    model.ends_well(publisher)
    model.settle({subscriber})
    assert model.problems == [
        "/topic: life 1 ended well with message 3, and life 2 got no more than 2"
    ]


def test_who_died_need_not_have_sent_all() -> None:
    model = Model()
    publisher, subscriber = model.begin(), model.begin()
    model.got(subscriber, "/topic", publisher, 0)
    model.sent[publisher] = 7
    model.ends(publisher)
    model.settle({subscriber})
    assert not model.problems


def test_a_call_that_was_executed_twice_is_noticed() -> None:
    model = Model()
    question = model.question()
    request: Any = Question.Request(number=question)
    model.answer(request)
    model.was_answered(question, question)
    assert not model.problems
    model.answer(request)
    model.settle(set())
    assert model.problems == [f"questions executed more than once: [{question}]"]


def test_a_gap_is_noticed_unless_the_connection_is_a_new_one() -> None:
    model = chaos.Model()
    flow = chaos.Flow("flow", model)
    first, second = {"callerid": "/a"}, {"callerid": "/a"}
    for header, number in ((first, 3), (first, 4), (second, 7), (second, 8)):
        flow.got(header, number)
    assert not model.problems
    assert (model.received, model.connections) == (4, 2)
    flow.got(second, 10)
    flow.got(first, 10)
    assert model.problems == [
        "flow: 10 came after 8 on one connection",
        "flow: 10 came after 10 on a new connection",
    ]


def test_a_call_that_was_executed_twice_in_the_chaos_is_noticed() -> None:
    model = chaos.Model()
    model.asked = 1
    model.answer(Question.Request(number=1))
    model.was_answered(1, 1)
    model.settle()
    assert not model.problems
    model.answer(Question.Request(number=1))
    model.settle()
    assert model.problems == ["questions executed more than once: [1]"]


def test_a_wrong_answer_is_noticed() -> None:
    model = Model()
    first, second = model.question(), model.question()
    model.answer(Question.Request(number=first))
    model.was_answered(first, second)
    assert model.problems == ["question 1 was answered with 2"]


def test_the_table_of_what_was_seen(tmp_path: Path) -> None:
    results, page = tmp_path / "results.json", tmp_path / "page.md"
    results.write_text(
        json.dumps(
            {
                "a-fault": {
                    "name": "a-fault", "fault": "A fault", "times": 1000, "unit": "faults",
                    "promised": "nothing is lost", "seen": "1,000 faults", "left": "+0 tasks",
                    "problems": ["7 are missing"], "seconds": 600, "uvloop": True,
                }
            }
        )
    )  # fmt: skip
    page.write_text("before\n<!-- soak -->old<!-- end soak -->\nafter\n")
    script = str(ROOT / "soak" / "report.py")
    subprocess.run([sys.executable, script, str(results), "--docs", str(page)], check=True)
    text = page.read_text()
    assert text.startswith("before\n<!-- soak -->\n\n| fault | how often |")
    assert text.endswith("<!-- end soak -->\nafter\n")
    assert "old" not in text
    assert (
        "| A fault | 1,000 faults, in 10 min, uvloop | nothing is lost | "
        "1,000 faults<br>**7 are missing** | +0 tasks | "
        "`python soak/run.py a-fault --times 1000` |"
    ) in text


def test_a_scenario_that_is_not_there() -> None:
    command = [sys.executable, str(ROOT / "soak" / "run.py"), "nothing"]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 2
    assert "no scenario 'nothing'; there are master-restarts, " in done.stderr
