"""One publisher and many subscribers.

``links``: connections of their own to one reader, the same for every publisher, that counts
bytes: what publishing to many costs. ``subscribers``: so many of the contender's own in one
node, which share one connection in each of the libraries: what handing out to many costs.
"""

from __future__ import annotations

import sys

from common.contenders import PEERS, Contender
from common.suite import Case, Suite
from common.world import World

from suites.topics import COLUMNS, figures

__all__ = ["SUITE"]

NUMBERS = (1, 10, 50, 200)
SIZE = 32
DELIVERED = {"links": 1_000_000, "subscribers": 500_000}
OURS = 10
QUICK = 100
CONTENDERS = ("aioros1", "aioros1-uvloop", "rospy", "roscpp")


def cases(world: World) -> list[Case]:
    result = []
    for kind, delivered in DELIVERED.items():
        for number in NUMBERS:
            count = (QUICK if world.quick else delivered) // number
            name = f"{number} {kind}" if number > 1 else f"1 {kind[:-1]}"
            result.append(Case(name, "rate", {kind: number, "count": count}, CONTENDERS))
    return result


def run(world: World, contender: Contender, case: Case) -> dict[str, float]:
    environment = world.environment()
    count, links = case.options["count"], case.options.get("links", 0)
    if links and contender.ours and not world.quick:
        count *= OURS  # or it would be over before it can be measured
    options = {"kind": "String", "size": SIZE, "count": count}
    if links:
        words = [f"links={links}", f"count={count}", f"size={SIZE}"]
        subscriber = [sys.executable, str(PEERS / "reader.py"), *words]
    else:
        number = case.options["subscribers"]
        subscriber = contender.arguments("sub", **options, subscribers=number)
    with world.start(subscriber, environment) as sub:
        if not links:
            sub.report()  # all are there before anything is published
        with world.start(
            contender.arguments("pub", **options, links=links or 1), environment
        ) as pub:
            return figures(sub.finish(), pub.finish(), count * (links or number))


SUITE = Suite(
    "fanout",
    "Fan-out: String 32 B from one publisher to many, delivered",
    COLUMNS,
    cases,
    run,
    seconds=1.7,
)
