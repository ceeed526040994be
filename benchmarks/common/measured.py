"""What earlier runs wrote with ``--json``, read again."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

__all__ = ["Measured", "read"]

Row = dict[str, Any]


@dataclass
class Measured:
    """The suites of one or several runs; of a suite that is in several, the last."""

    machine: dict[str, Any]
    suites: dict[str, dict[str, Any]]

    def row(self, suite: str, case: str, contender: str) -> Row | None:
        rows: list[Row] = self.suites.get(suite, {}).get("rows", [])
        return next((r for r in rows if (r["case"], r["contender"]) == (case, contender)), None)

    def figure(self, suite: str, case: str, contender: str, figure: str) -> float | None:
        """The median; of a loss, the worst."""
        row = self.row(suite, case, contender)
        if not row:
            return None
        value: float | None = row["lost"] if figure == "lost" else row["median"].get(figure)
        return value

    def times_better(
        self, suite: str, case: str, figure: str, contender: str, peer: str
    ) -> float | None:
        """How many times better than a peer: more a second, or less time."""
        row = self.row(suite, case, contender)
        if not row:
            return None
        ours = self.figure(suite, case, contender, figure)
        theirs = self.figure(suite, row["beside"] or case, peer, figure)
        if not ours or not theirs:
            return None
        more = self.suites[suite]["figures"][figure]["better"] == "more"
        return ours / theirs if more else theirs / ours

    def versions(self) -> dict[str, str]:
        """Of everybody who took part, by what they are called."""
        return {
            who["label"].split(",")[0]: who["version"]
            for suite in self.suites.values()
            for key, who in suite.get("contenders", {}).items()
            if not key.startswith("aioros1")
        }


def read(paths: Iterable[Path]) -> Measured:
    """Raises :exc:`ValueError` for runs of different machines or interpreters."""
    suites: dict[str, dict[str, Any]] = {}
    machine: dict[str, Any] = {}
    for path in paths:
        written = json.loads(path.read_text())
        found = written["machine"]
        for key in ("cpu", "cores", "kernel", "python"):
            if machine and machine[key] != found[key]:
                raise ValueError(
                    f"{path}: {key} is {found[key]!r}, and {machine[key]!r} in the files before; "
                    "figures of one table are of one machine"
                )
        machine = {**found, "quick": machine.get("quick", False) or found["quick"]}
        suites.update(written["suites"])
    return Measured(machine, suites)
