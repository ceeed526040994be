"""What a program costs before it does anything: starting, importing, being there.

``first message`` is from the start of the process to the first message in it, of a publisher
that waits with a latched one, the same for all. ``idle`` has one publisher and one
subscriber. ``import`` is the time of an interpreter that imports, less that of one that does
not.
"""

from __future__ import annotations

import sys
import time

from common.contenders import Contender
from common.known import CLIENTS
from common.suite import Case, Figure, Suite
from common.world import World

__all__ = ["SUITE"]

SETTLE, QUICK = 1.0, 0.1
"""Seconds until an idle node is looked at."""

CONTENDERS = ("aioros1", "aioros1-uvloop", "rospy", "roscpp", "foxglove", "rosnodejs")
IMPORTS = {
    "aioros1": "import aioros1; aioros1.Node",
    "aioros1-uvloop": "import aioros1, uvloop; aioros1.Node",
    "rospy": "import rospy",
}
"""Ours is lazy: without using a name of it, there would be nothing to see."""


def cases(world: World) -> list[Case]:
    result = [Case("first message", "ms", contenders=CONTENDERS)]
    if sys.platform == "linux":
        result.append(Case("idle", "rss", contenders=CONTENDERS))
    return [*result, Case("import", "ms", contenders=tuple(IMPORTS))]


def run(world: World, contender: Contender, case: Case) -> dict[str, float]:
    measures = {"first message": first_message, "idle": idle, "import": importing}
    return measures[case.name](world, contender)


def first_message(world: World, contender: Contender) -> dict[str, float]:
    environment = world.environment()
    latch = CLIENTS["aioros1"](world.places).arguments("latch")
    with world.start(latch, environment) as publisher:
        publisher.report()
        start = time.perf_counter()
        command = contender.arguments("sub", kind="String", count=1)
        with world.start(command, environment) as sub:
            while "received" not in sub.report():
                pass
            return {"ms": (time.perf_counter() - start) * 1e3}


def idle(world: World, contender: Contender) -> dict[str, float]:
    with world.start(contender.arguments("idle"), world.environment()) as node:
        node.report()
        time.sleep(QUICK if world.quick else SETTLE)
        found = node.footprint()
    return {"rss": found["rss"] / 1e6, "threads": found["threads"]}


def importing(world: World, contender: Contender) -> dict[str, float]:
    def seconds(statement: str) -> float:
        command = [contender.command[0], "-c", f"{statement}; print('{{}}')"]
        start = time.perf_counter()
        with world.start(command, environment) as program:
            program.finish()
        return time.perf_counter() - start

    environment = world.environment()
    rounds = 1 if world.quick else 5
    best = [min(seconds(s) for _ in range(rounds)) for s in (IMPORTS[contender.key], "pass")]
    return {"ms": (best[0] - best[1]) * 1e3}


SUITE = Suite(
    "startup",
    "Start-up: ms to the first message, an idle node, importing",
    (
        Figure("ms", "ms", ",.0f", better="less"),
        Figure("rss", "MB", ",.0f", better="less"),
        Figure("threads", "threads", ",.0f", better="less"),
    ),
    cases,
    run,
    seconds=1.5,
)
