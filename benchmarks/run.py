"""The benchmarks: this library beside rospy, roscpp and others, in one run.

    python benchmarks/run.py [SUITE ...] [--runs N] [--only NAME ...] [--cases TEXT ...]
                             [--json FILE] [--quick] [--node-modules DIR] [--cros DIR]

One table for each suite (all of them, if none is named; "growth" is all that begin with it).
Peers that are not installed are left out, and the table says so. Figures drift from machine
to machine and from minute to minute: quote the ratios, which are of medians of runs that
took turns. To compare interpreters fairly, run it with a virtual environment made from the
Python that has rospy (/usr/bin/python3 on Debian). ``report.py`` makes the documentation's
tables of the figures that --json wrote.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import time
from pathlib import Path
from typing import Any

from common.known import KEYS
from common.node_contenders import INSTALL
from common.progress import Progress
from common.suite import Suite, plan, run_suite
from common.tables import as_json, machine, print_machine, print_table
from common.world import open_world
from suites import (
    fanout,
    growth_connections,
    growth_master,
    growth_nodes,
    growth_notices,
    growth_topics,
    latency,
    local,
    master,
    paced,
    services,
    startup,
    topics,
)

MODULES = (
    *(topics, latency, services, fanout, paced, master, startup, local),
    *(growth_topics, growth_nodes, growth_master, growth_notices, growth_connections),
)
SUITES: dict[str, Suite] = {module.SUITE.name: module.SUITE for module in MODULES}
NAMES = (*SUITES, "codec")
CODEC_SECONDS = 60.0


def main() -> None:
    options = parse()
    runs = options.runs or (1 if options.quick else 3)
    names = options.suites or NAMES
    written: dict[str, Any] = {"machine": machine(options.quick), "suites": {}}
    failed = False
    with open_world(options.quick, options.node_modules, options.cros) as world:
        plans = {
            name: plan(SUITES[name], world, options.only, options.cases)
            for name in names
            if name in SUITES
        }
        seconds = sum(results.seconds(runs) for results in plans.values())
        progress = Progress(seconds + CODEC_SECONDS * ("codec" in names and not options.quick))
        print_machine(written["machine"])
        for name in names:
            if name == "codec":
                progress.measuring("codec", CODEC_SECONDS)
                written["suites"][name] = run_codec(options)
            elif plans[name].rows:  # otherwise no case of it was wanted
                start = time.monotonic()
                run_suite(plans[name], world, runs, progress)
                print_table(plans[name])
                failed = failed or any(row.errors for row in plans[name].rows)
                took = {"seconds": round(time.monotonic() - start)}
                written["suites"][name] = as_json(plans[name]) | took
            if options.json:  # each time: what was measured is kept when a later one is stopped
                options.json.write_text(json.dumps(written, indent=1))
    if failed:
        sys.exit("some of it failed")


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("suites", nargs="*", metavar="SUITE", help=", ".join(NAMES))
    parser.add_argument("--runs", type=int, help="runs of each (3; with --quick 1)")
    parser.add_argument("--only", nargs="+", choices=KEYS, default=KEYS, help="only these")
    parser.add_argument("--cases", nargs="+", default=[""], help="only with this in the name")
    parser.add_argument("--json", type=Path, help="write all figures to this file")
    parser.add_argument("--quick", action="store_true", help="a few messages: does it work?")
    parser.add_argument(
        "--node-modules",
        type=Path,
        metavar="DIR",
        default=os.environ.get("AIOROS1_NODE_MODULES"),
        help=f"where npm's packages are, made by {INSTALL}",
    )
    parser.add_argument(
        "--cros",
        type=Path,
        metavar="DIR",
        default=os.environ.get("AIOROS1_CROS"),
        help="a built cROS: its sources, with build/lib/libcros.a",
    )
    options = parser.parse_intermixed_args()
    options.suites = [found for word in options.suites for found in named(word, parser)]
    return options


def named(word: str, parser: argparse.ArgumentParser) -> list[str]:
    """The suites that a word means: one, or all that begin with it."""
    found = [name for name in NAMES if name == word or name.startswith(f"{word}-")]
    if not found:
        parser.error(f"no suite {word!r}; there are {', '.join(NAMES)}")
    return found


def run_codec(options: argparse.Namespace) -> dict[str, Any]:
    """The codec has no processes, and rounds of its own; see ``codec.py``."""
    import codec  # only here: it puts Debian's packages on the path

    print("\nCodec: messages to bytes and back")
    words = ["--rounds", "1", "--only", "String", "Twist"] if options.quick else []
    if set(options.only) != set(KEYS):
        words.append("--alone")
    return {"title": "Codec", "rows": [vars(row) for row in codec.run(codec.parse(words))]}


if __name__ == "__main__":
    main()
