"""The benchmarks: this library beside rospy, roscpp and a bare socket, in one run.

    python benchmarks/run.py [SUITE ...] [--runs N] [--only NAME ...] [--cases TEXT ...]
                             [--json FILE] [--quick]

One table for each suite (all of them, if none is named). Peers that are not installed are
left out, and the table says so. Figures drift from machine to machine and from minute to
minute: quote the ratios, which are of medians of runs that took turns. To compare
interpreters fairly, run it with a virtual environment made from the Python that has rospy
(/usr/bin/python3 on Debian).
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import Any

from common.contenders import KEYS
from common.report import as_json, machine, print_table
from common.suite import Suite, run_suite
from common.world import open_world
from suites import fanout, latency, master, paced, services, startup, topics

MODULES = (topics, latency, services, fanout, paced, master, startup)
SUITES: dict[str, Suite] = {module.SUITE.name: module.SUITE for module in MODULES}
NAMES = (*SUITES, "codec")


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("suites", nargs="*", metavar="SUITE", help=", ".join(NAMES))
    parser.add_argument("--runs", type=int, help="runs of each (3; with --quick 1)")
    parser.add_argument("--only", nargs="+", choices=KEYS, default=KEYS, help="only these")
    parser.add_argument("--cases", nargs="+", default=[""], help="only with this in the name")
    parser.add_argument("--json", type=Path, help="write all figures to this file")
    parser.add_argument("--quick", action="store_true", help="a few messages: does it work?")
    options = parser.parse_intermixed_args()
    for name in options.suites:
        if name not in NAMES:
            parser.error(f"no suite {name!r}; there are {', '.join(NAMES)}")
    written: dict[str, Any] = {"machine": machine(options.quick), "suites": {}}
    failed = False
    with open_world(quick=options.quick) as world:
        for name in options.suites or NAMES:
            if name == "codec":
                written["suites"][name] = run_codec(options)
                continue
            runs = options.runs or (1 if options.quick else 3)
            results = run_suite(SUITES[name], world, runs, options.only, options.cases)
            if not results.rows:
                continue  # no case of it was wanted
            print_table(results)
            failed = failed or any(row.errors for row in results.rows)
            written["suites"][name] = as_json(results)
    if options.json:
        options.json.write_text(json.dumps(written, indent=1))
    if failed:
        sys.exit("some of it failed")


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
