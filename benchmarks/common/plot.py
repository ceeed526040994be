"""Bars of how many times better than each peer, as an SVG.

Written by hand: it is rectangles and words, the same bytes for the same figures, and no
package is needed for it. The colours are readable on white and on black, for a picture
does not know which of the two a page has.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from xml.sax.saxutils import escape

from common.measured import Measured
from common.targets import NAMES

__all__ = ["draw"]

COLOURS = {
    "rospy": "#4c8eda",
    "roscpp": "#d9822b",
    "tcp": "#8d929a",
    "foxglove": "#9b6dd6",
    "rosnodejs": "#3aa76d",
    "cros": "#d0525e",
    "rosmaster": "#2ba5a5",
}
TEXT = "#7a7f87"
LEFT, RIGHT, WIDTH = 240, 60, 860
BAR, GAP, TOP = 9, 8, 56


@dataclass
class Group:
    """A case: its name, and for each peer the ratios of the stock loop and of uvloop."""

    name: str
    bars: dict[str, tuple[float, float | None]]


def groups(measured: Measured) -> Iterator[Group]:
    for name, suite in measured.suites.items():
        if name == "codec" or name.startswith("growth-"):
            continue  # which have tables of their own
        for row in suite["rows"]:
            bars = {peer: ratio for peer, ratio in row["ratios"].items() if ratio}
            if row["contender"] != "aioros1" or not bars:
                continue
            fast = measured.row(name, row["case"], "aioros1-uvloop")
            other = fast["ratios"] if fast else {}
            yield Group(
                f"{name}: {row['case']}",
                {peer: (ratio, other.get(peer)) for peer, ratio in bars.items()},
            )


def draw(measured: Measured) -> str:
    found = list(groups(measured))
    ratios = [ratio for group in found for pair in group.bars.values() for ratio in pair if ratio]
    plot = Plot(min([0.5, *ratios]), max([10, *ratios]))
    peers = [peer for peer in COLOURS if any(peer in group.bars for group in found)]
    for number, peer in enumerate(peers):
        at = LEFT + number * 85
        plot.add(f'<rect x="{at}" y="8" width="10" height="10" fill="{COLOURS[peer]}"/>')
        plot.text(at + 14, 17, NAMES.get(peer, peer))
    for group in found:
        plot.group(group)
    plot.scale()
    plot.text(LEFT, plot.y + 20, "bars: stock asyncio; circles: uvloop; right of 1×: ahead")
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {plot.y + 24}"'
    font = f'font-family="sans-serif" font-size="11" fill="{TEXT}"'
    title = "<title>How many times better than each peer, on a logarithmic scale</title>"
    return "\n".join([f"{head} {font}>", title, *plot.lines, "</svg>"]) + "\n"


class Plot:
    """What is drawn so far, down to ``y``; from left to right is the logarithm of a ratio."""

    def __init__(self, low: float, high: float) -> None:
        self.lines: list[str] = []
        self.y = TOP
        self._low = math.floor(math.log10(low) * 2) / 2
        self._high = math.ceil(math.log10(high) * 2) / 2

    def x(self, ratio: float) -> float:
        share = (math.log10(ratio) - self._low) / (self._high - self._low)
        return LEFT + share * (WIDTH - LEFT - RIGHT)

    def add(self, element: str) -> None:
        self.lines.append(element)

    def text(self, x: float, y: float, words: str, anchor: str = "start", size: int = 11) -> None:
        place = f'x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="{size}"'
        self.add(f"<text {place}>{escape(words)}</text>")

    def group(self, group: Group) -> None:
        self.text(LEFT - 8, self.y + len(group.bars) * BAR / 2 + 4, group.name, "end")
        for peer, (stock, fast) in group.bars.items():
            start, end = sorted((self.x(1), self.x(stock)))
            colour = COLOURS.get(peer, TEXT)
            size = f'width="{max(end - start, 1):.1f}" height="{BAR - 2}"'
            self.add(f'<rect x="{start:.1f}" y="{self.y}" {size} fill="{colour}"/>')
            if fast:
                centre = f'cx="{self.x(fast):.1f}" cy="{self.y + BAR / 2 - 1}"'
                self.add(f'<circle {centre} r="3" fill="{colour}" stroke="{TEXT}"/>')
            at = max(self.x(stock), self.x(fast or stock), self.x(1)) + 7
            self.text(at, self.y + BAR - 2, f"{stock:.2g}", size=9)
            self.y += BAR
        self.y += GAP

    def scale(self) -> None:
        ends = f'y1="{TOP - 8}" y2="{self.y}"'
        for power in range(math.floor(self._low), math.ceil(self._high) + 1):
            for digit in (1, 2, 5):
                tick = digit * 10.0**power
                if 10**self._low <= tick <= 10**self._high:
                    x, width = self.x(tick), 1.5 if tick == 1 else 0.4
                    line = f'<line x1="{x:.1f}" x2="{x:.1f}" {ends} stroke="{TEXT}"'
                    self.add(f'{line} stroke-width="{width}"/>')
                    self.text(x, TOP - 14, f"{tick:g}×", "middle")
