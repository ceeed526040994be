"""There and back: a String is answered with the same String, one at a time."""

from __future__ import annotations

from common.contenders import Contender
from common.suite import Case, Figure, Suite
from common.world import World

__all__ = ["SUITE"]

SIZES = {"32 B": (32, 20_000), "1 MB": (1_000_000, 600)}
QUICK = 20


def cases(world: World) -> list[Case]:
    return [
        Case(
            f"{name}, {pinning}",
            "p50",
            {"size": size, "count": QUICK if world.quick else count, "cores": cores},
        )
        for name, (size, count) in SIZES.items()
        for pinning, cores in world.core_pairs.items()
    ]


def run(world: World, contender: Contender, case: Case) -> dict[str, float]:
    environment = world.environment()
    count = contender.count(case.options["count"])
    options = {"kind": "String", "size": case.options["size"], "count": count}
    here, there = case.options["cores"]
    with (
        world.start(contender.arguments("pong", **options), environment, there),
        world.start(contender.arguments("ping", **options), environment, here) as ping,
    ):
        return ping.finish()


SUITE = Suite(
    "latency",
    "Latency: ping-pong of std_msgs/String, two processes, µs there and back",
    (
        Figure("p50", "p50", ",.1f", better="less"),
        Figure("p99", "p99", ",.1f", better="less"),
    ),
    cases,
    run,
    seconds=2,
)
