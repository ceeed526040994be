"""A topic with 200 subscribers: what look-ups take while a publisher of it comes and goes.

Each time that it does, the master tells all of them; the look-ups come one at a time, at a
steady rate. ``notices/s`` is how many arrived: a master may leave out those that a newer one
has overtaken.
"""

from __future__ import annotations

import sys

from common.contenders import PEERS, Contender
from common.known import MASTERS
from common.suite import Case, Figure, Suite
from common.world import World

__all__ = ["SUITE"]

SUBSCRIBERS, QUICK_SUBSCRIBERS = 200, 5
SECONDS, QUICK_SECONDS = 3.0, 0.2
LOOKUPS = 250
"""A second."""

COMINGS = 5
"""A second, and as many goings: 2,000 notices a second."""

TOPIC = "/watched"
QUIET = "nothing changes"


def cases(world: World) -> list[Case]:
    number = QUICK_SUBSCRIBERS if world.quick else SUBSCRIBERS
    busy = f"{2 * COMINGS * number:,} notices a second"
    return [
        Case(name, "p99", {"subscribers": number, "comings": comings}, base=QUIET)
        for name, comings in ((QUIET, 0), (busy, COMINGS))
    ]


def run(world: World, contender: Contender, case: Case) -> dict[str, float]:
    seconds = QUICK_SECONDS if world.quick else SECONDS
    uri, master = world.start_master(contender.command, *contender.words)
    environment = world.environment(uri)

    def command(name: str, **options: object) -> list[str]:
        words = [f"{key}={value}" for key, value in options.items()]
        return [sys.executable, str(PEERS / name), *words]

    with master:
        slaves = command("subscribed.py", nodes=case.options["subscribers"], topic=TOPIC)
        with world.start(slaves, environment) as slaves_program:
            slaves_program.report()
            lookups = command(
                "registrations.py", paced=1, count=round(LOOKUPS * seconds), seconds=seconds
            )
            comings = round(case.options["comings"] * seconds)
            churn = command("registrations.py", churn=TOPIC, count=comings, seconds=seconds)
            with world.start(lookups, environment) as client:
                if comings:
                    with world.start(churn, environment) as publisher:
                        publisher.finish()
                figures = client.finish()
            notices = slaves_program.ask()["notices"]
    return {"p50": figures["p50"], "p99": figures["p99"], "notices": notices / seconds}


SUITE = Suite(
    "growth-notices",
    "Growth: look-ups while 200 subscribers are told of publishers",
    (
        Figure("p50", "p50 µs", ",.0f", better="less"),
        Figure("p99", "p99 µs", ",.0f", better="less"),
        Figure("notices", "notices/s"),
    ),
    cases,
    run,
    MASTERS,
    seconds=3.5,
)
