"""Where each kind of work is to get to, against the peers of the same run."""

from __future__ import annotations

import statistics
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from common.measured import Measured

__all__ = ["LOOPS", "NAMES", "TARGETS", "Check", "Found", "Target"]

LOOPS = {"aioros1": "stock asyncio", "aioros1-uvloop": "uvloop"}
NAMES = {"tcp": "C over TCP", "cros": "cROS"}
FLAT = 0.8
"""What is left of the smallest of a series counts as flat from here on: runs differ by that."""


@dataclass(frozen=True)
class Found:
    """What a check says of a run; ``met`` is None where nothing was measured."""

    text: str
    met: bool | None


class Check(Protocol):
    """One thing that is asked for."""

    def find(self, measured: Measured, contender: str) -> Found: ...


@dataclass(frozen=True)
class Against:
    """At least ``bound`` times better than a peer.

    ``stand_in`` is compared with where the peer is not there: another peer, and how many
    times better than it the missing one was when both were measured once.
    """

    suite: str
    case: str
    figure: str
    peer: str
    bound: float
    note: str = ""
    stand_in: tuple[str, float] | None = None

    def find(self, measured: Measured, contender: str) -> Found:
        what = (self.suite, self.case, self.figure, contender)
        times, sign = measured.times_better(*what, self.peer), ""
        name = NAMES.get(self.peer, self.peer)
        if times is None and self.stand_in:
            other, ahead = self.stand_in
            name = f"{name}, *estimated from {other}*"
            times = measured.times_better(*what, other)
            times = None if times is None else times / ahead
            sign = "≈ "
        note = f"{self.note}: " if self.note else ""
        asked = f"≥ {self.bound:g}×"
        if times is None:
            return Found(f"{note}{NAMES.get(self.peer, self.peer)} not measured ({asked})", None)
        return Found(f"{note}{sign}{times:.2f}× {name} ({asked})", times >= self.bound)


@dataclass(frozen=True)
class AtMost:
    """A figure by itself."""

    suite: str
    case: str
    figure: str
    bound: float
    title: str
    format: str = ".2f"

    def find(self, measured: Measured, contender: str) -> Found:
        value = measured.figure(self.suite, self.case, contender, self.figure)
        bound = format(self.bound, self.format)
        if value is None:
            return Found(f"{self.title} not measured (≤ {bound})", None)
        text = f"{self.title} {format(value, self.format)} (≤ {bound})"
        return Found(text, value <= self.bound)


@dataclass(frozen=True)
class Flat:
    """The largest of a series is as good as the smallest."""

    suite: str
    case: str
    title: str

    def find(self, measured: Measured, contender: str) -> Found:
        row = measured.row(self.suite, self.case, contender)
        if not row or row["growth"] is None:
            return Found(f"{self.title} not measured", None)
        return Found(f"{self.title}: {row['growth']:.2f} (≥ {FLAT})", row["growth"] >= FLAT)


@dataclass(frozen=True)
class NothingLeft:
    """No connection leaves a file descriptor, a thread or a task, or memory to speak of."""

    kind: str
    bytes_each: int = 16

    def find(self, measured: Measured, contender: str) -> Found:
        case = ("growth-connections", f"10,000 {self.kind} connections", contender)
        left = {
            name: measured.figure(*case, f"left_{key}")
            for key, name in (
                *(("fds", "file descriptors"), ("threads", "threads"), ("tasks", "tasks")),
                ("memory", "bytes each"),
            )
        }
        if any(value is None for value in left.values()):
            return Found(f"{self.kind}s: not measured", None)
        figures = {name: value or 0.0 for name, value in left.items()}
        text = ", ".join(f"{value:.0f} {name}" for name, value in figures.items())
        most = dict.fromkeys(figures, 0) | {"bytes each": self.bytes_each}
        met = all(figures[name] <= most[name] for name in figures)
        return Found(f"{self.kind}s: {text} (≤ 0; ≤ {self.bytes_each} bytes each)", met)


@dataclass(frozen=True)
class Codec:
    """Quicker than genpy, in the geometric mean, and nowhere slower. Knows no event loop."""

    out: float
    into: float

    def find(self, measured: Measured, contender: str) -> Found:
        rows = measured.suites.get("codec", {}).get("rows", [])
        ratios = {
            way: [row[way]["genpy"] / row[way]["aioros1"] for row in rows if "genpy" in row[way]]
            for way in ("out", "into")
        }
        # Decoding without copies is rows of its own, which have no "out".
        ratios["into"] = ratios["into"][: len(ratios["out"])]
        if not ratios["out"]:
            return Found("genpy not measured", None)
        out, into = (statistics.geometric_mean(ratios[way]) for way in ("out", "into"))
        worst = min(ratios["out"] + ratios["into"])
        return Found(
            f"out {out:.2f}× (≥ {self.out:g}×), in {into:.2f}× (≥ {self.into:g}×) genpy; "
            f"the least of all {worst:.2f}× (≥ 1×)",
            out >= self.out and into >= self.into and worst >= 1,
        )


@dataclass(frozen=True)
class Target:
    """A row of the table: ``uvloop`` is None where the same is asked for with uvloop."""

    key: str
    work: str
    stock: Sequence[Check]
    uvloop: Sequence[Check] | None = None

    def checks(self, contender: str) -> Sequence[Check]:
        with_uvloop = contender == "aioros1-uvloop"
        return self.stock if not with_uvloop or self.uvloop is None else self.uvloop


def topic(case: str, peer: str, bound: float, note: str = "") -> Against:
    return Against("topics", case, "rate", peer, bound, note)


def nothing_lost(suite: str, case: str) -> AtMost:
    return AtMost(suite, case, "lost", 0, "lost", ".0%")


PING, CALL = "32 B, same core", "persistent, same core"
# Measured once on one machine, where cROS was: 12.6 µs beside rospy's 16.5, and 90,000
# calls a second beside 61,000.
CROS_PING, CROS_CALL = ("rospy", 16.5 / 12.6), ("rospy", 90 / 61)
CLOUD, IMAGE = "PointCloud2 1 MB", "Image 6.2 MB"


TARGETS = (
    Target(
        "string",
        "String, `async for`, nothing lost",
        (
            topic("String 32 B", "roscpp", 4),
            topic("String 32 B", "rospy", 6),
            AtMost("topics", "String 32 B", "cpu_per_million", 1.3, "CPU s per million"),
            nothing_lost("topics", "String 32 B"),
        ),
    ),
    Target(
        "transform",
        "TransformStamped",
        (topic("TransformStamped", "roscpp", 2.5),),
        (topic("TransformStamped", "roscpp", 3),),
    ),
    Target(
        "joints",
        "JointState, six joints",
        (topic("JointState x6", "roscpp", 1.2), topic("JointState x6", "rospy", 2.5)),
        (topic("JointState x6", "roscpp", 1.4), topic("JointState x6", "rospy", 2.5)),
    ),
    Target(
        "cloud",
        "PointCloud2, 1 MB",
        (
            topic(f"{CLOUD}, views", "roscpp", 3.5, "views"),
            topic(CLOUD, "roscpp", 2.5, "copied"),
        ),
    ),
    Target(
        "image",
        "Image, 6.2 MB",
        (
            topic(f"{IMAGE}, views", "tcp", 0.9, "views"),
            topic(f"{IMAGE}, views", "roscpp", 4, "views"),
            topic(IMAGE, "tcp", 0.6, "copied"),
        ),
    ),
    Target(
        "ping",
        "Ping-pong, 32 B, same core",
        (
            Against("latency", PING, "p50", "cros", 1, stand_in=CROS_PING),
            Against("latency", PING, "p50", "roscpp", 2),
        ),
        (
            Against("latency", PING, "p50", "cros", 1.25, stand_in=CROS_PING),
            Against("latency", PING, "p50", "roscpp", 2),
        ),
    ),
    Target(
        "ping-large",
        "Ping-pong, 1 MB",
        tuple(
            Against("latency", f"1 MB, {pinning}", "p50", "rospy", 2, pinning)
            for pinning in ("same core", "across cores")
        ),
    ),
    Target(
        "call",
        "Service, persistent, same core",
        (
            Against("services", CALL, "rate", "rospy", 1),
            Against("services", CALL, "rate", "roscpp", 3.5),
        ),
        (
            Against("services", CALL, "rate", "cros", 1, stand_in=CROS_CALL),
            Against("services", CALL, "rate", "roscpp", 3.5),
        ),
    ),
    Target(
        "call-once",
        "Service, one connection per call",
        (Against("services", "one connection per call", "rate", "roscpp", 1.5),),
    ),
    Target(
        "fan-out",
        "Fan-out to 50, nothing lost",
        (
            Against("fanout", "50 links", "rate", "rospy", 30),
            nothing_lost("fanout", "50 links"),
        ),
    ),
    Target(
        "paced",
        "Paced at 1 kHz, CPU of both",
        (Against("paced", "1000 Hz, String 32 B", "cpu", "rospy", 1),),
    ),
    Target(
        "master",
        "Master, look-ups a second",
        (
            Against("master", "1 client", "rate", "rosmaster", 1, "1 client"),
            Against("master", "8 clients", "rate", "rosmaster", 1.5, "8 clients"),
        ),
        (
            Against("master", "1 client", "rate", "rosmaster", 1.2, "1 client"),
            Against("master", "8 clients", "rate", "rosmaster", 2, "8 clients"),
        ),
    ),
    Target(
        "start",
        "Start to the first message; idle",
        (
            Against("startup", "first message", "ms", "rospy", 1, "first message"),
            Against("startup", "idle", "rss", "rospy", 1, "idle memory"),
            AtMost("startup", "idle", "threads", 1, "threads", ".0f"),
        ),
    ),
    Target("codec", "Codec, twelve types", (Codec(out=2.5, into=3),)),
    Target(
        "growth-topics",
        "1 to 1,000 topics in a node, CPU per message",
        (
            Flat("growth-topics", "1,000 topics, one a turn", "one a turn of the loop"),
            Flat("growth-topics", "1,000 topics", "as fast as it goes"),
        ),
    ),
    Target(
        "growth-connections",
        "10,000 connections leave nothing behind",
        (NothingLeft("topic"), NothingLeft("service")),
    ),
    Target(
        "growth-master",
        "Master at 10,000 registrations as fast as at 10",
        (Flat("growth-master", "10,000 registrations", "look-ups"),),
    ),
)
