"""How many Strings a second get through, beside the peers: one row of the suite ``topics``.

    python benchmarks/topics.py [--count N] [--size BYTES] [--runs N] [--json FILE]

``run.py topics`` has more kinds of messages, and says how to compare fairly.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from common.progress import Progress
from common.suite import plan, run_suite
from common.tables import as_json, machine, print_table
from common.world import open_world
from suites.topics import string_suite


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--count", type=int, default=1_000_000, help="messages per run")
    parser.add_argument("--size", type=int, default=32, help="bytes of the string")
    parser.add_argument("--runs", type=int, default=3, help="runs of each client")
    parser.add_argument("--json", type=Path, help="write all results to this file")
    options = parser.parse_args()
    with open_world() as world:
        results = plan(string_suite(options.size, options.count), world)
        run_suite(results, world, options.runs, Progress(results.seconds(options.runs)))
    print_table(results)
    if options.json:
        written = {"machine": machine(quick=False), "suites": {"topics": as_json(results)}}
        options.json.write_text(json.dumps(written, indent=1))


if __name__ == "__main__":
    main()
