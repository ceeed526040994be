"""Look-ups of a node, on connections that are kept, by the same client for every master."""

from __future__ import annotations

import sys

from common.contenders import PEERS, Contender
from common.known import MASTERS
from common.suite import Case, Figure, Suite
from common.world import World

__all__ = ["SUITE"]

COUNT, QUICK = 20_000, 40


def cases(world: World) -> list[Case]:
    count = QUICK if world.quick else COUNT
    return [
        Case(name, "rate", {"clients": clients, "count": count})
        for name, clients in {"1 client": 1, "8 clients": 8}.items()
    ]


def run(world: World, contender: Contender, case: Case) -> dict[str, float]:
    uri, master = world.start_master(contender.command, *contender.words)
    with master:
        words = [f"{name}={value}" for name, value in case.options.items()]
        command = [sys.executable, str(PEERS / "lookups.py"), *words]
        with world.start(command, world.environment(uri)) as client:
            figures = client.finish()
        rss = master.footprint()["rss"] / 1e6
    return {**figures, "rate": figures["count"] / figures["seconds"], "rss": rss}


SUITE = Suite(
    "master",
    "Master: lookupNode on kept connections",
    (
        Figure("rate", "look-ups/s", better="more"),
        Figure("p50", "p50 µs", ",.0f", better="less"),
        Figure("p99", "p99 µs", ",.0f", better="less"),
        Figure("rss", "MB", ",.0f", better="less"),
    ),
    cases,
    run,
    MASTERS,
    seconds=4.5,
)
