"""The documentation's tables and plot, from what ``run.py --json`` wrote.

    python benchmarks/report.py FILE ... [--docs FOLDER]

Writes the parts of ``performance.md`` between its markers, all of ``performance-tables.md``
and ``img/performance.svg``. A suite that is in several files is taken from the last. What is
said beside a row of the targets stands in ``remarks.toml``, and stays.
"""

from __future__ import annotations

import argparse
import sys
import tomllib
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from common import ROOT
from common.measured import Measured, read
from common.plot import draw
from common.targets import LOOPS, TARGETS, Target

HERE = Path(__file__).parent
PAGE, TABLES, PLOT = "performance.md", "performance-tables.md", "img/performance.svg"
INTRODUCTION = (
    "What stands behind the [targets](performance.md#targets), written by "
    "`benchmarks/report.py`; the suites of growth are [there](performance.md#growth). "
    "Columns with × say how many times better than that peer, by the figure in bold."
)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("files", nargs="+", type=Path, metavar="FILE", help="of run.py --json")
    parser.add_argument("--docs", type=Path, default=ROOT / "docs", help="where the pages are")
    options = parser.parse_args()
    try:
        measured = read(options.files)
        page = options.docs / PAGE
        parts = {
            "machine": machine(measured),
            "targets": targets(measured, remarks(HERE / "remarks.toml")),
            "growth": growth(measured),
        }
        page.write_text(fill_in(page.read_text(), parts))
    except ValueError as error:
        sys.exit(str(error))
    (options.docs / TABLES).write_text(tables(measured))
    plot = options.docs / PLOT
    plot.parent.mkdir(exist_ok=True)
    plot.write_text(draw(measured))


def fill_in(page: str, parts: dict[str, str]) -> str:
    """A page with what is between ``<!-- name -->`` and ``<!-- end name -->`` made new."""
    for name, text in parts.items():
        begin, end = f"<!-- {name} -->", f"<!-- end {name} -->"
        if page.count(begin) != 1 or page.count(end) != 1 or page.index(begin) > page.index(end):
            raise ValueError(f"{PAGE} has no {begin} ... {end}")
        before, _, rest = page.partition(begin)
        page = f"{before}{begin}\n\n{text}\n\n{end}{rest.partition(end)[2]}"
    return page


def remarks(path: Path) -> dict[str, str]:
    """What is said by hand of the rows; a name that no row has is a mistake."""
    found: dict[str, str] = tomllib.loads(path.read_text())
    unknown = set(found) - {target.key for target in TARGETS}
    if unknown:
        raise ValueError(f"{path.name}: no row {', '.join(sorted(unknown))}")
    return found


def machine(measured: Measured) -> str:
    found = measured.machine
    rows = [
        ("machine", f"{found['cpu']}, {found['cores']} cores, kernel {found['kernel']}"),
        ("Python", found["python"]),
        *((name, found[name]) for name in ("aioros1", "aiohttp", "uvloop") if found.get(name)),
        *sorted(measured.versions().items()),
        ("runs", f"{runs(measured)}, on {found['when'][:10]}"),
    ]
    text = table(("", "version"), rows)
    if found["quick"]:
        text += "\n\n**A quick run: too few messages for the figures to mean anything.**"
    return text


def runs(measured: Measured) -> str:
    """How many there were of each, and what became of those that failed."""
    numbers = {
        len(row["runs"]) + len(row["errors"])
        for name, suite in measured.suites.items()
        if name != "codec"
        for row in suite["rows"]
    }
    low, high = min(numbers, default=0), max(numbers, default=0)
    return f"{low} of each" if low == high else f"{low} to {high} of each"


# -- targets -------------------------------------------------------------------------


def targets(measured: Measured, said: dict[str, str]) -> str:
    head = ("work", *LOOPS.values(), "")
    rows = []
    for target in TARGETS:
        cells = [verdict(measured, target, contender) for contender in LOOPS]
        rows.append((target.work, *cells, said.get(target.key, "")))
    return table(head, rows)


def verdict(measured: Measured, target: Target, contender: str) -> str:
    if target.key == "codec" and contender != "aioros1":
        return "the same"
    found = [check.find(measured, contender) for check in target.checks(contender)]
    if any(one.met is False for one in found):
        word = "**not met**"
    elif any(one.met is None for one in found):
        word = "not measured" if all(one.met is None for one in found) else "in part"
    else:
        word = "met"
    texts = [f"**{one.text}**" if one.met is False else one.text for one in found]
    return "<br>".join([word, *texts])


# -- all figures ---------------------------------------------------------------------


def growth(measured: Measured) -> str:
    names = [name for name in measured.suites if name.startswith("growth-")]
    return "\n\n".join(section(measured, name, "###") for name in names) or "Not measured."


def tables(measured: Measured) -> str:
    head = [
        "# Benchmark figures",
        INTRODUCTION,
    ]
    names = [name for name in measured.suites if name != "codec" and "growth" not in name]
    parts = [section(measured, name) for name in names]
    if "codec" in measured.suites:
        parts.append(codec(measured.suites["codec"]["rows"]))
    return "\n\n".join([*head, *parts]) + "\n"


def section(measured: Measured, name: str, level: str = "##") -> str:
    suite = measured.suites[name]
    labels = {key: who["label"] for key, who in suite["contenders"].items()}
    peers = list(dict.fromkeys(peer for row in suite["rows"] for peer in row["ratios"]))
    used = {row["ratio_of"] for row in suite["rows"]}
    series = any(row["growth"] for row in suite["rows"])
    titles = [
        f"**{figure['title']}**" if key in used and (peers or series) else figure["title"]
        for key, figure in suite["figures"].items()
    ]
    head = ["", "", *titles, *(f"× {labels[peer].split(',')[0]}" for peer in peers)]
    head += [f"× {suite['base']}"] * series
    rows, case = [], ""
    for row in suite["rows"]:
        cells = ["" if row["case"] == case else row["case"], labels[row["contender"]]]
        case = row["case"]
        values = {**row["median"], "lost": row["lost"]}
        cells += [number(values.get(k), f["format"]) for k, f in suite["figures"].items()]
        cells += [number(row["ratios"].get(peer), ".2f") for peer in peers]
        cells += [number(row["growth"], ".2f")] * series
        rows.append(cells)
    text = f"{level} {suite['title']}\n\n{table(head, rows)}"
    left_out = [*suite["missing"], *failures(suite["rows"], labels)]
    return text + "".join(f"\n\n{line[0].upper()}{line[1:]}." for line in left_out)


def failures(rows: Iterable[dict[str, Any]], labels: dict[str, str]) -> list[str]:
    return [
        f"{row['case']}, {labels[row['contender']]}: {len(row['errors'])} of "
        f"{len(row['errors']) + len(row['runs'])} runs failed"
        for row in rows
        if row["errors"]
    ]


def codec(rows: Sequence[dict[str, Any]]) -> str:
    libraries = list(dict.fromkeys(key for row in rows for key in row["into"]))
    head = ["µs a message", "bytes"]
    head += [f"{way}, {library}" for way in ("out", "in") for library in libraries]
    lines = []
    for row in rows:
        cells = [row["name"], f"{row['size']:,}"]
        for way in ("out", "into"):
            cells += [number(row[way].get(library), ".3g") for library in libraries]
        lines.append(cells)
    return f"## Codec: messages to bytes and back\n\n{table(head, lines)}"


def number(value: float | None, text_format: str) -> str:
    return "" if value is None else format(value, text_format)


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)


if __name__ == "__main__":
    main()
