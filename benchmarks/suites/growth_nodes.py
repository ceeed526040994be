"""From 1 to 200 nodes in one event loop, each of which publishes to the next.

The other libraries have one node in a process, so there is nobody to compare with.
"""

from __future__ import annotations

from common.contenders import Contender
from common.suite import Case, Figure, Suite
from common.world import World

__all__ = ["SUITE"]

NUMBERS = (1, 10, 50, 200)
COUNT, QUICK = 300_000, 1_000


def cases(world: World) -> list[Case]:
    count = QUICK if world.quick else COUNT
    return [
        Case(
            f"{number} node{'s' * (number > 1)}",
            "cpu_per_million",
            {"nodes": number, "count": count},
            ("aioros1", "aioros1-uvloop"),
            base="1 node",
        )
        for number in NUMBERS
    ]


def run(world: World, contender: Contender, case: Case) -> dict[str, float]:
    arguments = contender.arguments("ring", size=32, **case.options)
    with world.start(arguments, world.environment()) as program:
        figures = program.finish()
    number, received = case.options["nodes"], figures["received"]
    return {
        "received": received,
        "lost": 1 - received / (case.options["count"] // number * number),
        "rate": received / figures["seconds"],
        "cpu_per_million": figures["cpu"] / received * 1e6,
        "open": figures["opened"] / number * 1e3,
        "close": figures["closed"] / number * 1e3,
        "memory": figures["memory"] / number / 1e3,
    }


SUITE = Suite(
    "growth-nodes",
    "Growth: nodes in one event loop, String 32 B from each to the next",
    (
        Figure("rate", "messages/s", better="more"),
        Figure("lost", "lost", ".1%"),
        Figure("cpu_per_million", "CPU s/million", ",.2f", better="less"),
        Figure("open", "ms/node to open", ",.2f", better="less"),
        Figure("close", "to close", ",.2f", better="less"),
        Figure("memory", "kB/node", ",.0f", better="less"),
    ),
    cases,
    run,
)
