"""A String a millisecond: what both sides use of a core while they keep the pace."""

from __future__ import annotations

from common.contenders import Contender
from common.suite import Case, Figure, Suite
from common.world import World

__all__ = ["SUITE"]

RATE = 1000
SECONDS, QUICK = 6.0, 0.2


def cases(world: World) -> list[Case]:
    count = round(RATE * (QUICK if world.quick else SECONDS))
    options = {"kind": "String", "size": 32, "rate": RATE, "count": count}
    contenders = ("aioros1", "aioros1-uvloop", "rospy", "roscpp")
    return [Case(f"{RATE} Hz, String 32 B", "cpu", options, contenders)]


def run(world: World, contender: Contender, case: Case) -> dict[str, float]:
    environment = world.environment()
    with (
        world.start(contender.arguments("sub", **case.options), environment) as sub_program,
        world.start(contender.arguments("pub", **case.options), environment) as pub_program,
    ):
        sub, pub = sub_program.finish(), pub_program.finish()
    # Both by the time that the messages took: a publisher's own includes waiting for the end.
    seconds = max(sub["seconds"], 1e-9)
    return {
        "publisher": pub["cpu"] / seconds,
        "subscriber": sub["cpu"] / seconds,
        "cpu": (pub["cpu"] + sub["cpu"]) / seconds,
        "rate": (sub["received"] - 1) / seconds,
        "lost": 1 - sub["received"] / case.options["count"],
    }


SUITE = Suite(
    "paced",
    "Paced: CPU of one core while messages come at a steady rate",
    (
        Figure("publisher", "publisher", ".1%", better="less"),
        Figure("subscriber", "subscriber", ".1%", better="less"),
        Figure("cpu", "both", ".1%", better="less"),
        Figure("rate", "messages/s"),
        Figure("lost", "lost", ".1%"),
    ),
    cases,
    run,
    seconds=7,
)
