"""From 1 to 1,000 topics in a node: what a message costs, and a topic to be opened.

One process publishes to all in turn, as fast as the other takes it, and nothing is lost. The
fewer topics, the more messages there are in one block of bytes; with "one a turn" the event
loop goes around after each, so that each is sent alone, as the peers send all of theirs.
``ms/topic`` is the time that both sides' registrations take, and the connecting there is.
"""

from __future__ import annotations

from common.contenders import Contender
from common.suite import Case, Figure, Suite
from common.world import World

from suites.topics import COLUMNS, OURS, figures

__all__ = ["SUITE"]

NUMBERS = (1, 10, 100, 1000)
SIZE = 32
COUNT, QUICK = 200_000, 1_000
RATIO = "cpu_per_million"
ONE_A_TURN = ", one a turn"
CONTENDERS = ("aioros1", "aioros1-uvloop", "rospy", "roscpp")


def cases(world: World) -> list[Case]:
    count = QUICK if world.quick else COUNT
    result = []
    for number in NUMBERS:
        name, options = topics(number), {"topics": number, "count": count // number}
        result.append(Case(name, RATIO, options, CONTENDERS, base=topics(1)))
    for number in NUMBERS:
        name, options = topics(number), {"topics": number, "count": count // number, "turns": 1}
        base = topics(1) + ONE_A_TURN
        result.append(Case(name + ONE_A_TURN, RATIO, options, OURS, beside=name, base=base))
    return result


def topics(number: int) -> str:
    return f"{number:,} topic{'s' * (number > 1)}"


def run(world: World, contender: Contender, case: Case) -> dict[str, float]:
    environment = world.environment()
    options = {"kind": "String", "size": SIZE, **case.options}
    with (
        world.start(contender.arguments("sub", **options), environment) as sub_program,
        world.start(contender.arguments("pub", **options), environment) as pub_program,
    ):
        sub, pub = sub_program.finish(), pub_program.finish()
    number = case.options["topics"]
    result = figures(sub, pub, number * case.options["count"])
    return {**result, "setup": (sub["setup"] + pub["setup"]) / number * 1e3}


SUITE = Suite(
    "growth-topics",
    "Growth: topics in one node, String 32 B to all in turn",
    (*COLUMNS, Figure("setup", "ms/topic", ",.2f", better="less")),
    cases,
    run,
    seconds=2.5,
)
