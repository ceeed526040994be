"""The benchmarks run: a few messages in each suite, by this library alone."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="they measure Linux processes")

RUN = Path(__file__).parent.parent / "benchmarks" / "run.py"
CASES = {
    "topics": {"String 32 B", "Image 6.2 MB", "Image 6.2 MB, views"},
    "latency": {"32 B, same core"},
    "services": {"persistent, same core", "one connection per call"},
    "fanout": {"10 links", "10 subscribers"},
    "paced": {"1000 Hz, String 32 B"},
    "master": {"8 clients"},
    "startup": {"first message", "idle", "import"},
    "local": {
        "String 32 B, there and back, TCP",
        "String 32 B, there and back, Unix socket",
        "Image 1 MB, Unix socket",
        "Image 1 MB, one loop, TCP",
        "Image 1 MB, one loop, in process",
    },
    "growth-topics": {"10 topics", "10 topics, one a turn"},
    "growth-nodes": {"10 nodes"},
    "growth-master": {"100 registrations"},
    "growth-notices": {"50 notices a second"},
    "growth-connections": {"20 topic connections", "20 service connections"},
}
FIGURES = {
    "topics": {"rate", "lost", "cpu_per_million", "rss"},
    "latency": {"p50", "p99"},
    "services": {"rate", "lost", "p50", "p99"},
    "fanout": {"rate", "lost", "cpu_per_million", "rss"},
    "paced": {"publisher", "subscriber", "cpu", "lost"},
    "master": {"rate", "p50", "p99", "rss"},
    "growth-topics": {"rate", "lost", "cpu_per_million", "setup"},
    "growth-nodes": {"rate", "lost", "cpu_per_million", "open", "close", "memory"},
    "growth-master": {"rate", "p50", "p99", "changes", "state", "rss"},
    "growth-notices": {"p50", "p99", "notices"},
    "growth-connections": {"rate", "p50", "p99", "left_fds", "left_threads", "left_tasks"},
}


def run(*words: str) -> subprocess.CompletedProcess[str]:
    # A test run may stop at any warning; the programs that are measured do not.
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONWARNINGS"}
    return subprocess.run(
        [sys.executable, str(RUN), *words], env=environment, capture_output=True, text=True
    )


def test_every_suite_measures_this_library(tmp_path: Path) -> None:
    path = tmp_path / "figures.json"
    names = sorted({name for cases in CASES.values() for name in cases})
    done = run("--quick", "--only", "aioros1", "--cases", *names, "--json", str(path))
    assert done.returncode == 0, done.stdout + done.stderr
    written = json.loads(path.read_text())
    assert written["machine"]["quick"] is True
    suites = written["suites"]
    assert set(suites) == {*CASES, "codec"}
    for name, cases in CASES.items():
        rows = {row["case"]: row for row in suites[name]["rows"]}
        assert cases <= set(rows), name
        for case, row in rows.items():
            assert case in done.stdout
            check_row(name, row)
    assert {row["name"] for row in suites["codec"]["rows"]} == {"String", "Twist"}
    assert suites["topics"]["title"] in done.stdout


def check_row(suite: str, row: dict[str, Any]) -> None:
    figures, where = row["median"], (suite, row["case"])
    assert row["contender"] == "aioros1", where
    assert (len(row["runs"]), row["errors"], row["ratios"]) == (1, [], {}), where
    assert FIGURES.get(suite, set()) <= set(figures), where
    if "lost" in figures:
        assert (figures["lost"], row["lost"]) == (0, 0), where
    if "received" in figures:
        assert figures["received"] > 0, where
    if "rate" in figures:
        assert figures["rate"] > 0, where
    if "p50" in figures:
        assert 0 < figures["p50"] <= figures["p99"], where
    if "notices" in figures:
        assert figures["notices"] > 0, where
    if suite == "growth-connections":
        left = {name: figures[f"left_{name}"] for name in ("fds", "threads", "tasks")}
        assert left == {"fds": 0, "threads": 0, "tasks": 0}, where
    if row["case"] == "idle":
        assert figures["threads"] >= 1, where
        assert figures["rss"] > 1, where


def test_a_suite_that_is_not_there() -> None:
    done = run("nothing", "--quick")
    assert done.returncode == 2
    assert "no suite 'nothing'; there are topics, latency" in done.stderr


MACHINE = {
    "when": "2026-01-02T03:04:05+00:00",
    "quick": False,
    "cpu": "A processor",
    "cores": 2,
    "kernel": "6.1",
    "python": "3.11.2",
    "aioros1": "0.1",
    "aiohttp": "3.10",
    "uvloop": "",
}
PAGE = """# A page

<!-- machine --><!-- end machine -->
kept
<!-- targets -->
what was there before
<!-- end targets -->
<!-- growth -->
<!-- end growth -->
the end
"""


def suite(
    title: str,
    ratio_of: str,
    better: str,
    *rows: tuple[str, str, dict[str, float]],
) -> dict[str, Any]:
    """A suite as ``run.py`` writes it, with what ratios it would have left out."""
    keys = dict.fromkeys(key for _, _, figures in rows for key in figures)
    return {
        "title": title,
        "base": "smallest",
        "figures": {key: {"title": key, "format": ",.2f", "better": better} for key in keys},
        "contenders": {who: {"label": who, "version": "1"} for _, who, _ in rows},
        "missing": ["without cros: nobody knows where it is"],
        "rows": [
            {
                "case": case,
                "contender": who,
                "beside": "",
                "median": figures,
                "lost": 0,
                "ratio_of": ratio_of,
                "growth": None,
                "errors": [],
                "runs": [figures],
                "ratios": {"rospy": 2.0} if who == "aioros1" else {},
            }
            for case, who, figures in rows
        ],
    }


def write_report(folder: Path, *suites: dict[str, Any]) -> subprocess.CompletedProcess[str]:
    files = []
    for number, written in enumerate(suites):
        files.append(folder / f"{number}.json")
        files[-1].write_text(json.dumps({"machine": MACHINE, **written}))
    script = RUN.with_name("report.py")
    command = [sys.executable, str(script), *map(str, files), "--docs", str(folder)]
    return subprocess.run(command, capture_output=True, text=True)


def test_a_report_says_what_was_reached(tmp_path: Path) -> None:
    page = tmp_path / "performance.md"
    page.write_text(PAGE)
    name = "String 32 B"
    topics = suite(
        *("Topics", "rate", "more"),
        (name, "aioros1", {"rate": 800.0, "cpu_per_million": 1.25}),
        (name, "aioros1-uvloop", {"rate": 390.0, "cpu_per_million": 1.25}),
        (name, "rospy", {"rate": 100.0}),
        (name, "roscpp", {"rate": 100.0}),
    )
    name = "32 B, same core"
    latency = suite(
        *("Latency", "p50", "less"),
        (name, "aioros1", {"p50": 10.0}),
        (name, "rospy", {"p50": 13.0}),
        (name, "roscpp", {"p50": 30.0}),
    )
    stale = suite("Latency", "p50", "less", (name, "aioros1", {"p50": 99.0}))
    done = write_report(
        tmp_path, {"suites": {"latency": stale}}, {"suites": {"topics": topics, "latency": latency}}
    )
    assert done.returncode == 0, done.stderr
    text = page.read_text()
    rows = {line.split(" | ")[0].strip("| "): line.split(" | ") for line in text.splitlines()}
    assert rows["machine"][1] == "A processor, 2 cores, kernel 6.1 |"
    _, stock, uvloop, _ = rows["String, `async for`, nothing lost"]
    assert stock == (
        "met<br>8.00× roscpp (≥ 4×)<br>8.00× rospy (≥ 6×)"
        "<br>CPU s per million 1.25 (≤ 1.30)<br>lost 0% (≤ 0%)"
    )
    assert uvloop.startswith("**not met**<br>**3.90× roscpp (≥ 4×)**<br>**3.90× rospy (≥ 6×)**<br>")
    # 1.3 times better than rospy, which was 1.31 times worse than cROS.
    _, stock, uvloop, remark = rows["Ping-pong, 32 B, same core"]
    assert "≈ 0.99× cROS, *estimated from rospy* (≥ 1×)" in stock
    assert "<br>3.00× roscpp (≥ 2×)" in stock
    assert uvloop.startswith("not measured<br>")
    assert "cROS was not on the machine" in remark
    assert rows["TransformStamped"][1].startswith("not measured<br>")
    assert "what was there before" not in text
    assert "kept\n" in text
    assert text.endswith("the end\n")
    tables = (tmp_path / "performance-tables.md").read_text()
    assert "Without cros: nobody knows where it is." in tables
    assert "| String 32 B | aioros1 | 800.00 | 1.25 | 2.00 |" in tables
    plot = ElementTree.parse(tmp_path / "img" / "performance.svg")
    words = [element.text or "" for element in plot.iter() if element.tag.endswith("}text")]
    assert {"rospy", "topics: String 32 B", "latency: 32 B, same core"} <= set(words)
    # Once more with the same figures, and nothing changes.
    assert (
        write_report(tmp_path, {"suites": {"topics": topics, "latency": latency}}).returncode == 0
    )
    assert page.read_text() == text


def test_a_report_is_of_one_machine(tmp_path: Path) -> None:
    (tmp_path / "performance.md").write_text(PAGE)
    other = {"machine": {**MACHINE, "cores": 4}, "suites": {}}
    done = write_report(tmp_path, {"suites": {}}, other)
    assert done.returncode == 1
    assert "1.json: cores is 4, and 2 in the files before" in done.stderr


def test_a_report_into_a_page_without_its_place(tmp_path: Path) -> None:
    (tmp_path / "performance.md").write_text(PAGE.replace("<!-- end growth -->", ""))
    done = write_report(tmp_path, {"suites": {}})
    assert done.returncode == 1
    assert "performance.md has no <!-- growth --> ... <!-- end growth -->" in done.stderr


def test_the_ways_through_the_code_are_counted() -> None:
    command = [sys.executable, str(RUN.parent / "ways.py"), "publish"]
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONWARNINGS"}
    environment["PYTHONPATH"] = str(RUN.parents[1])
    table = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    *_, row = table.stdout.splitlines()
    calls, files, moves, returns = (int(cell) for cell in row.split("|")[2:-1])
    assert calls > moves >= files - 1
    assert returns == moves - (files - 1)
    traced = subprocess.run(
        [*command, "--trace"], env=environment, capture_output=True, text=True, check=True
    )
    name, first, *others = traced.stdout.splitlines()
    assert name == "publish:"
    assert first.split()[1] == "Publisher.publish"
    assert len(others) == calls - 1
