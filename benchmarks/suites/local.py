"""The shorter ways between nodes of this library: within one host, within one event loop.

There is nobody to compare with: each way is compared with TCP between the same places.
"""

from __future__ import annotations

from common.contenders import Contender
from common.suite import Case, Figure, Suite
from common.world import World

from suites.topics import figures

__all__ = ["SUITE"]

OURS = ("aioros1", "aioros1-uvloop")
KINDS = {
    # of what, of which size, how many there and back, how many as fast as it goes
    "String 32 B": ("String", 32, 20_000, 1_000_000),
    "Image 1 MB": ("Image", 1_000_000, 1_000, 4_000),
    "Image 6.2 MB": ("Image", 1920 * 1080 * 3, 200, 600),
}
WAYS = {
    # The ways between two processes, and those in one loop; the first of each is TCP.
    False: {"TCP": "", "Unix socket": "unix"},
    True: {"one loop, TCP": "", "one loop, in process": "intraprocess"},
}
QUICK = 20


def cases(world: World) -> list[Case]:
    result = []
    for kind, (message, size, rounds, count) in KINDS.items():
        for figure, number in (("p50", rounds), ("rate", count)):
            work = f"{kind}, there and back" if figure == "p50" else kind
            options = {"kind": message, "size": size, "views": 1}
            options["count"] = QUICK if world.quick else number
            for one_loop, ways in WAYS.items():
                base = ""
                for way, local in ways.items():
                    told = {"one_loop": one_loop, "words": {**options, "local": local}}
                    result.append(Case(f"{work}, {way}", figure, told, OURS, base=base))
                    base = base or f"{work}, {way}"
    return result


def run(world: World, contender: Contender, case: Case) -> dict[str, float]:
    words, environment = case.options["words"], world.environment()
    ping_pong = case.ratio == "p50"
    if case.options["one_loop"]:
        mode = "ping_pong" if ping_pong else "pub_sub"
        with world.start(contender.arguments(mode, **words), environment) as program:
            found = program.finish()
        # Of one process, whose CPU time is that of both sides.
        return found if ping_pong else figures(found, dict.fromkeys(found, 0), words["count"])
    # Latency depends on whether both share a core, and is measured where they do.
    core = next(iter(world.core_pairs.values()))[0] if ping_pong else None
    modes = ("pong", "ping") if ping_pong else ("pub", "sub")
    with (
        world.start(contender.arguments(modes[0], **words), environment, core) as first,
        world.start(contender.arguments(modes[1], **words), environment, core) as second,
    ):
        found = second.finish()
        return found if ping_pong else figures(found, first.finish(), words["count"])


SUITE = Suite(
    "local",
    "Local: shorter ways than TCP, arrays as views; two processes or one event loop",
    (
        Figure("p50", "p50 µs", ",.1f", better="less"),
        Figure("p99", "p99 µs", ",.1f", better="less"),
        Figure("rate", "messages/s", better="more"),
        Figure("lost", "lost", ".1%"),
        Figure("cpu_per_million", "CPU s/million", ",.2f", better="less"),
    ),
    cases,
    run,
    base="TCP",
)
