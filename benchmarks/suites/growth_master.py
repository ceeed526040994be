"""A master with 10 to 10,000 registrations: asked for a node, for everything, and changed."""

from __future__ import annotations

import sys

from common.contenders import PEERS, Contender
from common.known import MASTERS
from common.suite import Case, Figure, Suite
from common.world import World

__all__ = ["SUITE"]

NUMBERS = (10, 100, 1000, 10_000)
COUNT, QUICK = 5_000, 40


def cases(world: World) -> list[Case]:
    count = QUICK if world.quick else COUNT
    return [
        Case(named(number), "rate", {"fill": number, "count": count}, base=named(NUMBERS[0]))
        for number in NUMBERS
    ]


def named(number: int) -> str:
    return f"{number:,} registrations"


def run(world: World, contender: Contender, case: Case) -> dict[str, float]:
    uri, master = world.start_master(contender.command, *contender.words)
    with master:
        words = [f"{name}={value}" for name, value in case.options.items()]
        command = [sys.executable, str(PEERS / "registrations.py"), *words]
        with world.start(command, world.environment(uri)) as client:
            changes = client.report()
            figures = client.finish()
        rss = master.footprint()["rss"] / 1e6
    return {
        **figures,
        "rate": figures["count"] / figures["seconds"],
        "changes": changes["changes"],
        "state": changes["state"],
        "rss": rss,
    }


SUITE = Suite(
    "growth-master",
    "Growth: a master with many registrations, one client on a kept connection",
    (
        Figure("rate", "look-ups/s", better="more"),
        Figure("p50", "p50 µs", ",.0f", better="less"),
        Figure("p99", "p99 µs", ",.0f", better="less"),
        Figure("changes", "registrations/s", better="more"),
        Figure("state", "getSystemState ms", ",.1f", better="less"),
        Figure("rss", "MB", ",.0f", better="less"),
    ),
    cases,
    run,
    MASTERS,
    seconds=2,
)
