"""The table of docs/reliability.md, from what ``run.py --json`` wrote.

    python soak/report.py FILE ... [--docs FILE]

Of a scenario that is in several files, the last is taken. Only what stands between the
markers of the page is written.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

PAGE = Path(__file__).resolve().parent.parent / "docs" / "reliability.md"
BEGIN, END = "<!-- soak -->", "<!-- end soak -->"


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("files", nargs="+", type=Path, metavar="FILE", help="of run.py --json")
    parser.add_argument("--docs", type=Path, default=PAGE, help="the page to write in")
    options = parser.parse_args()
    results: dict[str, Any] = {}
    for path in options.files:
        results.update(json.loads(path.read_text()))
    page = options.docs.read_text()
    before, begin, rest = page.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not begin or not end:
        sys.exit(f"{options.docs} has no {BEGIN} ... {END}")
    options.docs.write_text(f"{before}{BEGIN}\n\n{table(list(results.values()))}\n\n{END}{after}")


def table(results: Sequence[dict[str, Any]]) -> str:
    head = ("fault", "how often", "what is promised", "what was seen", "left behind", "command")
    lines = [head, ("---",) * len(head), *map(row, results)]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)


def row(result: dict[str, Any]) -> tuple[str, ...]:
    loop = ", uvloop" if result["uvloop"] else ""
    times = f"{result['times']:,} {result['unit']}, in {duration(result['seconds'])}{loop}"
    seen = "<br>".join(filter(None, [result["seen"], *map(bold, result["problems"])]))
    command = f"`python soak/run.py {result['name']} --times {result['times']}`"
    return result["fault"], times, result["promised"], seen, result["left"], command


def bold(problem: str) -> str:
    return f"**{problem}**"


def duration(seconds: int) -> str:
    return f"{seconds} s" if seconds < 120 else f"{seconds / 60:.0f} min"


if __name__ == "__main__":
    main()
