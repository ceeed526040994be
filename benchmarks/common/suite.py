"""A suite: cases, contenders that take turns at them, and figures of each."""

from __future__ import annotations

import statistics
import sys
from collections.abc import Callable, Collection
from dataclasses import dataclass, field
from typing import Any, Literal

from common.contenders import Contender, Find
from common.known import CLIENTS, KEYS
from common.processes import BenchmarkError
from common.progress import Progress
from common.world import World

__all__ = ["Case", "Figure", "Results", "Row", "Suite", "plan", "run_suite"]


@dataclass(frozen=True)
class Figure:
    """A column of the table. ``better`` says which direction is; without it, no ratio."""

    key: str
    title: str
    format: str = ",.0f"
    better: Literal["more", "less"] | None = None


@dataclass(frozen=True)
class Case:
    """What is measured: options for the suite, and who takes part.

    ``beside`` names a case with whose peers this one is compared; only this library runs it.
    ``base`` names the smallest case of a series, with which its contender is compared.
    ``ratio`` is the figure of which the ratios are.
    """

    name: str
    ratio: str
    options: dict[str, Any] = field(default_factory=dict)
    contenders: tuple[str, ...] = KEYS
    beside: str = ""
    base: str = ""


@dataclass(frozen=True)
class Suite:
    """``run`` measures one contender at one case, once; ``seconds`` is what that takes, about.

    ``base`` is the word for what a series is compared with.
    """

    name: str
    title: str
    figures: tuple[Figure, ...]
    cases: Callable[[World], list[Case]]
    run: Callable[[World, Contender, Case], dict[str, float]]
    known: dict[str, Find] = field(default_factory=lambda: CLIENTS)
    seconds: float = 3.0
    base: str = "smallest"


@dataclass
class Row:
    """All runs of one contender at one case."""

    case: Case
    contender: Contender
    runs: list[dict[str, float]] = field(default_factory=list)
    errors: list[str] = field(default_factory=list)

    @property
    def median(self) -> dict[str, float]:
        if not self.runs:
            return {}
        known = set(self.runs[0]).intersection(*self.runs)
        return {key: statistics.median(run[key] for run in self.runs) for key in sorted(known)}

    @property
    def worst_loss(self) -> float | None:
        """No median: a loss in one run of five is a loss."""
        return max((run["lost"] for run in self.runs if "lost" in run), default=None)


@dataclass
class Results:
    """What came of a suite, or is to come."""

    suite: Suite
    rows: list[Row]
    missing: list[str]
    quick: bool

    def seconds(self, runs: int) -> float:
        """What measuring it takes, about."""
        return 0 if self.quick else len(self.rows) * runs * self.suite.seconds

    @property
    def peers(self) -> list[Contender]:
        found = {row.contender.key: row.contender for row in self.rows}
        return [contender for contender in found.values() if not contender.ours]

    def ratio(self, row: Row, peer: Contender) -> float | None:
        """How many times better than this peer at the same case: more a second, or less time."""
        return self._times_better(row, row.case.beside or row.case.name, peer)

    def growth(self, row: Row) -> float | None:
        """What is left of the smallest case of its series: 1 if size makes no difference."""
        return self._times_better(row, row.case.base, row.contender) if row.case.base else None

    def _times_better(self, row: Row, case: str, contender: Contender) -> float | None:
        other = next(
            (r for r in self.rows if r.case.name == case and r.contender.key == contender.key), None
        )
        figure = next(f for f in self.suite.figures if f.key == row.case.ratio)
        mine = row.median.get(figure.key)
        theirs = other.median.get(figure.key) if other else None
        if not mine or not theirs:
            return None
        return mine / theirs if figure.better == "more" else theirs / mine


def plan(
    suite: Suite,
    world: World,
    only: Collection[str] = KEYS,
    parts: Collection[str] = ("",),
) -> Results:
    """What is to be measured: rows without figures.

    ``only`` names the contenders, ``parts`` are of the names of the cases wanted.
    """
    cases = [case for case in suite.cases(world) if any(part in case.name for part in parts)]
    wanted = {key for case in cases for key in case.contenders} & set(only)
    contenders, missing = world.find(suite.known, wanted)
    rows = [
        Row(case, contender)
        for case in cases
        for contender in contenders
        if contender.key in case.contenders and (contender.ours or not case.beside)
    ]
    return Results(suite, rows, missing, world.quick)


def run_suite(planned: Results, world: World, runs: int, progress: Progress) -> None:
    """Every contender in turn, as often as asked, so that a drift of the machine hits all."""
    suite = planned.suite
    for number in range(runs):
        for row in planned.rows:
            title = f"run {number + 1}: {suite.name}, {row.case.name}, {row.contender.label}"
            progress.measuring(title, suite.seconds)
            try:
                row.runs.append(suite.run(world, row.contender, row.case))
            except BenchmarkError as error:
                print(f"failed: {error}", file=sys.stderr)
                row.errors.append(str(error))
