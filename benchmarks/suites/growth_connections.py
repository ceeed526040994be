"""Connections to one node, opened and closed: how fast, and what they leave behind.

Some come first, which fill what is filled once. Then the node is looked at, and again when
all others have gone: at its file descriptors, threads and memory, and after it has collected
its garbage, at its tasks and at the objects that Python keeps an eye on.
"""

from __future__ import annotations

import sys
import time

from common.contenders import PEERS, Contender
from common.processes import Program
from common.suite import Case, Figure, Suite
from common.world import World

__all__ = ["SUITE"]

COUNT, QUICK = 10_000, 20
WARM_UP = 500
SETTLE = 5.0
"""Seconds that a node has for closing its side; publishers notice it when they publish."""

CONTENDERS = ("aioros1", "aioros1-uvloop", "rospy", "roscpp")


def cases(world: World) -> list[Case]:
    count = QUICK if world.quick else COUNT
    return [
        Case(f"{count:,} {kind} connections", "rate", {"kind": kind, "count": count}, CONTENDERS)
        for kind in ("topic", "service")
    ]


def run(world: World, contender: Contender, case: Case) -> dict[str, float]:
    environment = world.environment()

    def visit(count: int) -> dict[str, float]:
        words = [f"kind={case.options['kind']}", f"count={count}"]
        with world.start([sys.executable, str(PEERS / "visitors.py"), *words], environment) as it:
            return it.finish()

    with world.start(contender.arguments("host"), environment) as node:
        node.report()
        idle = node.footprint()["fds"]
        visit(QUICK if world.quick else WARM_UP)
        before = settled(node, idle)
        figures = visit(case.options["count"])
        after = settled(node, idle)
    left = {key: after[key] - before[key] for key in before}
    return {
        "rate": figures["count"] / figures["seconds"],
        **{key: figures[key] for key in ("p50", "p99")},
        **{f"left_{key}": value for key, value in left.items()},
        "left_memory": left["rss"] / case.options["count"],
    }


def settled(node: Program, fds: float) -> dict[str, float]:
    """A node when its connections are closed, or when it has had time enough for that."""
    end = time.monotonic() + SETTLE
    while node.footprint()["fds"] > fds and time.monotonic() < end:
        time.sleep(0.05)
    told = node.ask()
    return {**node.footprint(), **{key: told[key] for key in ("tasks", "objects") if key in told}}


SUITE = Suite(
    "growth-connections",
    "Growth: connections to one node, opened and closed, and what is left of them",
    (
        Figure("rate", "connections/s", better="more"),
        Figure("p50", "p50 µs", ",.0f", better="less"),
        Figure("p99", "p99 µs", ",.0f", better="less"),
        Figure("left_fds", "left: fds", "+,.0f"),
        Figure("left_threads", "threads", "+,.0f"),
        Figure("left_tasks", "tasks", "+,.0f"),
        Figure("left_objects", "objects", "+,.0f"),
        Figure("left_memory", "bytes each", "+,.0f"),
    ),
    cases,
    run,
    seconds=3,
)
