"""Messages a second from one process to another over loopback."""

from __future__ import annotations

from common.contenders import Contender
from common.known import KEYS
from common.suite import Case, Figure, Suite
from common.world import World

__all__ = ["COLUMNS", "SUITE", "figures", "string_case", "string_suite"]

OURS = ("aioros1", "aioros1-uvloop")
COLUMNS = (
    Figure("rate", "messages/s", better="more"),
    Figure("lost", "lost", ".1%"),
    Figure("cpu_per_million", "CPU s/million", ",.2f", better="less"),
    Figure("rss", "MB, both", ",.0f"),
)
KINDS = {
    # Of the larger ones no more than memory holds: roscpp queues what it cannot send.
    "JointState x6": ("JointState", 0, 200_000),
    "TransformStamped": ("TransformStamped", 0, 500_000),
    "PointCloud2 1 MB": ("PointCloud2", 1_000_000, 1_000),
    "Image 6.2 MB": ("Image", 1920 * 1080 * 3, 200),
}
QUICK = 20


def cases(world: World) -> list[Case]:
    result = [string_case(32, QUICK if world.quick else 1_000_000)]
    for name, (kind, size, count) in KINDS.items():
        options = {"kind": kind, "size": size, "count": QUICK if world.quick else count}
        # cROS was never seen to take a message as large as an image.
        contenders = tuple(key for key in KEYS if kind != "Image" or key != "cros")
        result.append(Case(name, "rate", options, contenders))
        if size:
            options = {**options, "views": 1}
            result.append(Case(f"{name}, views", "rate", options, OURS, beside=name))
    return result


def string_case(size: int, count: int) -> Case:
    return Case(f"String {size} B", "rate", {"kind": "String", "size": size, "count": count})


def run(world: World, contender: Contender, case: Case) -> dict[str, float]:
    environment = world.environment()
    options = {**case.options, "count": contender.count(case.options["count"])}
    # Not pinned: a peer with several threads may use all cores.
    with (
        world.start(contender.arguments("sub", **options), environment) as sub,
        world.start(contender.arguments("pub", **options), environment) as pub,
    ):
        return figures(sub.finish(), pub.finish(), options["count"])


def figures(sub: dict[str, float], pub: dict[str, float], sent: int) -> dict[str, float]:
    """Of both sides' reports. CPU is user and system time, from the first message on."""
    received = sub["received"]
    result = {
        "received": received,
        "seconds": sub["seconds"],
        "rate": (received - 1) / max(sub["seconds"], 1e-9),
        "lost": 1 - received / sent,
        "cpu_per_million": (sub["cpu"] + pub["cpu"]) / received * 1e6,
        "cpu_total": sub["cpu_total"] + pub["cpu_total"],
    }
    if "rss" in sub and "rss" in pub:
        result["rss"] = (sub["rss"] + pub["rss"]) / 1e6
    return result


SUITE = Suite(
    "topics", "Topics: delivered messages, two processes", COLUMNS, cases, run, seconds=2.3
)


def string_suite(size: int, count: int) -> Suite:
    """Strings alone, of the size and number asked for."""
    title = f"Topics: {count:,} std_msgs/String a run, two processes"
    return Suite("topics", title, COLUMNS, lambda _: [string_case(size, count)], run)
