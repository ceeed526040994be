"""Bad things done to nodes and masters, often, and what came of it.

    python soak/run.py [SCENARIO ...] [--quick | --full | --times N | --minutes M]
                       [--uvloop] [--json FILE]

Each scenario takes a minute or two; with ``--full`` it is run as often as the table of
docs/reliability.md says, which takes hours for all of them, with ``--quick`` as often as the
tests do. ``--minutes`` is for ``churn``. Before it is measured, it runs once quickly, so that
what is imported and cached is there. It fails if anything promised was lost, if another peer was
not served meanwhile, or if a task, a file descriptor, a thread or memory is left behind.
``--json`` keeps what was seen; ``soak/report.py`` makes the table of it.
"""

from __future__ import annotations

import argparse
import asyncio
import json
import logging
import platform
import sys
import time
from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from soak.footprint import Footprint
from soak.scenario import Scenario, Seen
from soak.scenarios import SCENARIOS


def main() -> None:
    options = parse()
    # What nodes say of the faults is what is meant to happen, thousands of times.
    logging.disable(logging.CRITICAL)
    failed = False
    for name in options.scenarios or SCENARIOS:
        scenario = SCENARIOS[name]
        times = options.times or getattr(scenario, options.size)
        if options.minutes and scenario.unit == "seconds":
            times = round(60 * options.minutes)
        print(f"{name}: {times:,} {scenario.unit}", flush=True)
        with asyncio.Runner(loop_factory=loop_factory(options.uvloop)) as runner:
            result = runner.run(measure(scenario, times))
        for line in (result["seen"], result["left"], *result["problems"]):
            print(f"    {line}", flush=True)
        failed = failed or bool(result["problems"])
        if options.json:
            keep(options.json, result | {"uvloop": options.uvloop})
    if failed:
        sys.exit("something that is promised was not kept")


async def measure(scenario: Scenario, times: int) -> dict[str, Any]:
    """Run it, and compare what the process holds afterwards with what it held before."""
    await scenario.run(times if scenario.is_size else scenario.quick)
    before = await Footprint.take()
    start = time.monotonic()
    try:
        seen = await scenario.run(times)
    except Exception as error:
        seen = Seen("", [f"it ended with {error!r}"])
    seconds = time.monotonic() - start
    after = await Footprint.take()
    return {
        "name": scenario.name,
        "fault": scenario.fault,
        "times": times,
        "unit": scenario.unit,
        "promised": scenario.promised,
        "seen": seen.text,
        "left": after.text_since(before),
        "problems": seen.problems + after.problems_since(before),
        "seconds": round(seconds),
        "when": datetime.now(UTC).isoformat(timespec="seconds"),
        "python": platform.python_version(),
    }


def loop_factory(with_uvloop: bool) -> Callable[[], asyncio.AbstractEventLoop]:
    if not with_uvloop:
        return asyncio.new_event_loop
    import uvloop

    factory: Callable[[], asyncio.AbstractEventLoop] = uvloop.new_event_loop
    return factory


def keep(path: Path, result: dict[str, Any]) -> None:
    """One scenario has one result in the file: the newest."""
    results = json.loads(path.read_text()) if path.exists() else {}
    results[result["name"]] = result
    path.write_text(json.dumps(results, indent=1))


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    names = ", ".join(SCENARIOS)
    parser.add_argument("scenarios", nargs="*", metavar="SCENARIO", help=names)
    size = parser.add_mutually_exclusive_group()
    for name, text in (("quick", "as often as the tests do"), ("full", "as the table says")):
        size.add_argument(f"--{name}", action="store_const", const=name, dest="size", help=text)
    size.add_argument("--times", type=int, help="so often")
    size.add_argument("--minutes", type=float, help="for so long, where that can be said")
    parser.set_defaults(size="short")
    parser.add_argument("--uvloop", action="store_true", help="on uvloop")
    parser.add_argument("--json", type=Path, metavar="FILE", help="keep the results there")
    options = parser.parse_args()
    for name in options.scenarios:
        if name not in SCENARIOS:
            parser.error(f"no scenario {name!r}; there are {names}")
    return options


if __name__ == "__main__":
    main()
