"""The table of a suite on the terminal, and all figures as JSON."""

from __future__ import annotations

import os
import platform
from datetime import UTC, datetime
from typing import Any

import aioros1
from common.suite import Results, Row
from common.versions import cpu_model, distribution

__all__ = ["as_json", "machine", "print_machine", "print_table"]


def print_table(results: Results) -> None:
    suite, peers = results.suite, results.peers
    runs = max((len(row.runs) for row in results.rows), default=0)
    head = ["", "", *(figure.title for figure in suite.figures)]
    head += [f"x {peer.label.split(',')[0]}" for peer in peers]
    series = any(row.case.base for row in results.rows)
    head += [f"x {suite.base}"] * series
    lines = [head]
    case = ""
    for row in results.rows:
        name = "" if row.case.name == case else row.case.name
        case = row.case.name
        ratios = [cell(results.ratio(row, peer), ".2f") for peer in peers]
        grown = [cell(results.growth(row), ".2f")] * series
        lines.append([name, row.contender.label, *cells(results, row), *ratios, *grown])
    print(f"\n{suite.title}")
    print(f"Medians of {runs} runs that took turns" if runs > 1 else "One run")
    if versions := [f"{peer.label.split(',')[0]} {peer.version}" for peer in peers]:
        print("Beside", ", ".join(versions))
    if peers:
        print("x: how many times better than that peer, by", ", ".join(ratio_titles(results)))
    if series:
        print(f"x {suite.base}: the same, than itself there; 1 is no difference")
    if results.quick:
        print("--quick: too few messages for the figures to mean anything.")
    print_aligned(lines)
    for text in results.missing:
        print(text)
    for row in results.rows:
        for error in row.errors:
            print(f"failed: {row.case.name}, {row.contender.label}: {error}")


def ratio_titles(results: Results) -> list[str]:
    used = {row.case.ratio for row in results.rows}
    return [figure.title for figure in results.suite.figures if figure.key in used]


def cells(results: Results, row: Row) -> list[str]:
    values = row.median
    if row.worst_loss is not None:
        values["lost"] = row.worst_loss
    return [cell(values.get(figure.key), figure.format) for figure in results.suite.figures]


def cell(value: float | None, text_format: str) -> str:
    return "" if value is None else format(value, text_format)


def print_aligned(lines: list[list[str]]) -> None:
    """The first two columns to the left, figures to the right."""
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    for line in lines:
        texts = [text.rjust(width) for text, width in zip(line, widths, strict=True)]
        texts[:2] = [text.ljust(width) for text, width in zip(line[:2], widths, strict=False)]
        print("  ".join(texts).rstrip())


def as_json(results: Results) -> dict[str, Any]:
    return {
        "title": results.suite.title,
        "base": results.suite.base,
        "figures": {
            f.key: {"title": f.title, "format": f.format, "better": f.better}
            for f in results.suite.figures
        },
        "contenders": {
            row.contender.key: {"label": row.contender.label, "version": row.contender.version}
            for row in results.rows
        },
        "missing": results.missing,
        "rows": [
            {
                "case": row.case.name,
                "contender": row.contender.key,
                "beside": row.case.beside,
                "median": row.median,
                "lost": row.worst_loss,
                "ratio_of": row.case.ratio,
                "ratios": {peer.key: results.ratio(row, peer) for peer in results.peers},
                "growth": results.growth(row),
                "runs": row.runs,
                "errors": row.errors,
            }
            for row in results.rows
        ],
    }


def machine(quick: bool) -> dict[str, Any]:
    """What the figures depend on."""
    return {
        "when": datetime.now(UTC).isoformat(timespec="seconds"),
        "quick": quick,
        "cpu": cpu_model(),
        "cores": os.cpu_count(),
        "kernel": platform.release(),
        "platform": platform.platform(),
        "python": platform.python_version(),
        "aioros1": aioros1.__version__,
        "aiohttp": distribution("aiohttp"),
        "uvloop": distribution("uvloop"),
    }


def print_machine(found: dict[str, Any]) -> None:
    print(f"{found['cpu']}, {found['cores']} cores, kernel {found['kernel']}")
    parts = [f"{name} {found[name]}" for name in ("aioros1", "aiohttp", "uvloop") if found[name]]
    print(", ".join([f"Python {found['python']}", *parts]))
