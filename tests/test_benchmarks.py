"""The benchmarks run: a few messages in each suite, by this library alone."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

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
}
FIGURES = {
    "topics": {"rate", "lost", "cpu_per_million", "rss"},
    "latency": {"p50", "p99"},
    "services": {"rate", "lost", "p50", "p99"},
    "fanout": {"rate", "lost", "cpu_per_million", "rss"},
    "paced": {"publisher", "subscriber", "cpu", "lost"},
    "master": {"rate", "p50", "p99", "rss"},
}


def run(*words: str) -> subprocess.CompletedProcess[str]:
    # A test run may stop at any warning; the programs that are measured do not.
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONWARNINGS"}
    return subprocess.run(
        [sys.executable, str(RUN), *words], env=environment, capture_output=True, text=True
    )


@pytest.mark.timeout(300)  # some fifty processes, on a machine that may be busy
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
    if row["case"] == "idle":
        assert figures["threads"] >= 1, where
        assert figures["rss"] > 1, where


def test_a_suite_that_is_not_there() -> None:
    done = run("nothing", "--quick")
    assert done.returncode == 2
    assert "no suite 'nothing'; there are topics, latency" in done.stderr
