"""Calls of std_srvs/SetBool, one at a time: on a kept connection, and one connection each."""

from __future__ import annotations

from common.contenders import Contender
from common.suite import Case, Figure, Suite
from common.world import World

__all__ = ["SUITE"]

PERSISTENT, SINGLE = 20_000, 2_000
QUICK = 10
CONTENDERS = ("aioros1", "aioros1-uvloop", "rospy", "roscpp", "rosnodejs")


def cases(world: World) -> list[Case]:
    kept = {"persistent": 1, "count": QUICK if world.quick else PERSISTENT}
    single = {"persistent": 0, "count": QUICK if world.quick else SINGLE, "cores": (None, None)}
    return [
        *(
            Case(f"persistent, {pinning}", "rate", {**kept, "cores": cores}, (*CONTENDERS, "cros"))
            for pinning, cores in world.core_pairs.items()
        ),
        Case("one connection per call", "rate", single, CONTENDERS),
    ]


def run(world: World, contender: Contender, case: Case) -> dict[str, float]:
    environment = world.environment()
    here, there = case.options["cores"]
    count = contender.count(case.options["count"])
    options = {"persistent": case.options["persistent"], "count": count}
    with (
        world.start(contender.arguments("serve"), environment, there),
        world.start(contender.arguments("call", **options), environment, here) as call,
    ):
        figures = call.finish()
    answered, failed = figures["count"], figures.get("failed", 0)
    return {
        **figures,
        "rate": answered / figures["seconds"],
        "lost": failed / (answered + failed),
    }


SUITE = Suite(
    "services",
    "Services: calls of std_srvs/SetBool, two processes",
    (
        Figure("rate", "calls/s", better="more"),
        Figure("lost", "failed", ".2%"),
        Figure("p50", "p50 µs", ",.1f", better="less"),
        Figure("p99", "p99 µs", ",.1f", better="less"),
    ),
    cases,
    run,
)
