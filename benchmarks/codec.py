"""Messages to bytes and back: beside genpy and the package rosbags, in one process.

    python benchmarks/codec.py [--varied] [--rounds N] [--json FILE] [--only ROW ...] [--alone]

Each library turns the same messages into the same bytes, and the bytes into messages of
its own, by what it offers its users: ``to_bytes`` and ``from_bytes`` here, ``serialize``
and ``deserialize`` of genpy (into one buffer that is used again, as rospy does it),
``serialize_ros1`` and ``deserialize_ros1`` of rosbags. The libraries take turns; a figure
is the best of the rounds, as whatever else a machine does only adds to it. Ratios say how
many times quicker ours is, geometric means are those of the rows above them. The rows
behind are of ``from_bytes(..., views=True)``, which copies no array, as rosbags does not.

genpy and its classes come from Debian's ROS: run this with a virtual environment made from
Debian's ``/usr/bin/python3`` that has aioros1 and rosbags.
"""

from __future__ import annotations

import argparse
import gc
import importlib
import json
import math
import platform
import statistics
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from io import BytesIO
from pathlib import Path
from typing import Any

from codec_messages import TYPES, make_messages

import aioros1

DEBIAN_PACKAGES = "/usr/lib/python3/dist-packages"
SECONDS = 0.02
"""How long one measurement takes, about."""

VIEWS = ", views"
"""What is added to the name of a row for decoding without copies."""

Call = Callable[[], object]


@dataclass
class Library:
    """What makes, for one type, a call that encodes or decodes all variants once."""

    name: str
    encode: Callable[[str, list[bytes]], Call]
    decode: Callable[[str, list[bytes]], Call]
    view: Callable[[str, list[bytes]], Call] | None = None


@dataclass
class Row:
    """The best times of one kind of message, in µs a message, by library."""

    name: str
    size: int
    out: dict[str, float] = field(default_factory=dict)
    into: dict[str, float] = field(default_factory=dict)


def main() -> None:
    options = parse()
    rows = run(options)
    if options.json:
        options.json.write_text(json.dumps([vars(row) for row in rows], indent=1))


def parse(words: Sequence[str] | None = None) -> argparse.Namespace:
    """The options of a command line; this program's own without ``words``."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--varied", action="store_true", help="every length differs")
    parser.add_argument("--rounds", type=int, default=25, help="measurements of each figure")
    parser.add_argument("--json", type=Path, help="write all results to this file")
    parser.add_argument("--only", nargs="+", choices=TYPES, help="only these rows")
    parser.add_argument("--alone", action="store_true", help="without the other libraries")
    return parser.parse_args(words)


def run(options: argparse.Namespace) -> list[Row]:
    """Measure, and print the table."""
    libraries = [ours()]
    if not options.alone:
        libraries += filter(None, (genpy(), rosbags()))
    rows = [measure(name, libraries, options) for name in options.only or TYPES]
    large = [row.name for row in rows if row.size >= 1 << 20]
    rows += [measure(name + VIEWS, libraries, options) for name in large]
    print_table(rows, libraries, options)
    return rows


# -- the libraries -------------------------------------------------------------------


def ours() -> Library:
    def encode(type_name: str, frames: list[bytes]) -> Call:
        cls = aioros1.load_msg(type_name)
        messages = [cls.from_bytes(frame) for frame in frames]
        check(frames, [message.to_bytes() for message in messages])

        def call() -> None:
            for message in messages:
                message.to_bytes()

        return call

    def decode(type_name: str, frames: list[bytes]) -> Call:
        cls = aioros1.load_msg(type_name)

        def call() -> None:
            for frame in frames:
                cls.from_bytes(frame)

        return call

    def view(type_name: str, frames: list[bytes]) -> Call:
        cls = aioros1.load_msg(type_name)

        def call() -> None:
            for frame in frames:
                cls.from_bytes(frame, views=True)

        return call

    return Library("aioros1", encode, decode, view)


def genpy() -> Library | None:
    if DEBIAN_PACKAGES not in sys.path:
        sys.path.append(DEBIAN_PACKAGES)
    try:
        importlib.import_module("genpy")
    except ImportError as error:
        print(f"without genpy: {error}")
        return None

    def load(type_name: str) -> Any:
        package, _, name = type_name.partition("/")
        return getattr(importlib.import_module(f"{package}.msg"), name)

    def encode(type_name: str, frames: list[bytes]) -> Call:
        cls = load(type_name)
        messages = [cls().deserialize(frame) for frame in frames]
        buffer = BytesIO()

        def serialize(message: Any) -> bytes:
            message.serialize(buffer)
            octets = buffer.getvalue()
            buffer.seek(0)
            buffer.truncate()
            return octets

        check(frames, [serialize(message) for message in messages])

        def call() -> None:
            for message in messages:
                message.serialize(buffer)
                buffer.getvalue()
                buffer.seek(0)
                buffer.truncate()

        return call

    def decode(type_name: str, frames: list[bytes]) -> Call:
        cls = load(type_name)

        def call() -> None:
            for frame in frames:
                cls().deserialize(frame)

        return call

    return Library("genpy", encode, decode)


def rosbags() -> Library | None:
    try:
        from rosbags.typesys import Stores, get_types_from_msg, get_typestore
    except ImportError as error:
        print(f"without rosbags: {error}")
        return None
    store = get_typestore(Stores.ROS1_NOETIC)

    def known(type_name: str) -> str:
        name = type_name.replace("/", "/msg/")
        if name not in store.fielddefs:
            types = get_types_from_msg(aioros1.load_msg(type_name)._full_text, name)
            store.register({key: types[key] for key in types if key not in store.fielddefs})
        return name

    def encode(type_name: str, frames: list[bytes]) -> Call:
        name = known(type_name)
        messages = [store.deserialize_ros1(frame, name) for frame in frames]
        check(frames, [bytes(store.serialize_ros1(message, name)) for message in messages])

        def call() -> None:
            for message in messages:
                store.serialize_ros1(message, name)

        return call

    def decode(type_name: str, frames: list[bytes]) -> Call:
        name = known(type_name)

        def call() -> None:
            for frame in frames:
                store.deserialize_ros1(frame, name)

        return call

    return Library("rosbags", encode, decode)


def check(frames: list[bytes], made: list[bytes]) -> None:
    """No figure for a library that makes other bytes."""
    if frames != made:
        raise SystemExit("the bytes differ")


# -- measuring -----------------------------------------------------------------------


def measure(name: str, libraries: list[Library], options: argparse.Namespace) -> Row:
    kind_of_row = name.removesuffix(VIEWS)
    type_name = TYPES[kind_of_row]
    cls = aioros1.load_msg(type_name)
    variants = make_messages(kind_of_row, varied=options.varied)
    frames = [cls.from_dict(values).to_bytes() for values in variants]
    row = Row(name, sum(map(len, frames)) // len(frames))
    views = name != kind_of_row
    for figures, kind in ((row.out, "encode"), (row.into, "decode")):
        if views and kind == "encode":
            continue
        calls = {
            lib.name: (lib.view if views and lib.view else getattr(lib, kind))(type_name, frames)
            for lib in libraries
        }
        repeats = {key: repeats_for(call) for key, call in calls.items()}
        turns = list(calls.items())
        for _ in range(options.rounds):
            turns.append(turns.pop(0))  # so that each comes after each other
            for key, call in turns:
                seconds = timed(call, repeats[key]) / repeats[key] / len(frames)
                figures[key] = min(figures.get(key, math.inf), seconds * 1e6)
    return row


def timed(call: Call, repeats: int) -> float:
    gc.collect()
    gc.disable()
    try:
        start = time.perf_counter()
        for _ in range(repeats):
            call()
        return time.perf_counter() - start
    finally:
        gc.enable()


def repeats_for(call: Call) -> int:
    """How often to call, after warming up, for a measurement to take long enough."""
    repeats = 1
    while (seconds := timed(call, repeats)) < SECONDS / 4:
        repeats *= 2
    return max(1, round(repeats * SECONDS / seconds))


# -- the table -----------------------------------------------------------------------


def print_table(rows: list[Row], libraries: list[Library], options: argparse.Namespace) -> None:
    peers = [lib.name for lib in libraries[1:]]
    kind = "every length differs" if options.varied else "a stream, names stay"
    print(f"Python {platform.python_version()}, µs a message; {kind}")
    head = ["", "bytes"]
    for direction in ("out", "in"):
        head += [direction, *(text for peer in peers for text in (peer, "ratio"))]
    counted = [row for row in rows if row.out]
    lines = [head, *(line(row, peers) for row in counted), mean_line(counted, peers)]
    lines += [line(row, peers) for row in rows if not row.out]
    widths = [max(len(cells[i]) for cells in lines) for i in range(len(head))]
    for cells in lines:
        first, *others = (cell.rjust(width) for cell, width in zip(cells, widths, strict=True))
        print("  ".join([cells[0].ljust(len(first)), *others]))


def line(row: Row, peers: list[str]) -> list[str]:
    cells = [row.name, f"{row.size:,}"]
    for figures in (row.out, row.into):
        if not figures:
            cells += [""] * (1 + 2 * len(peers))
            continue
        cells.append(f"{figures['aioros1']:.3g}")
        for peer in peers:
            cells += [f"{figures[peer]:.3g}", f"{figures[peer] / figures['aioros1']:.2f}x"]
    return cells


def mean_line(rows: list[Row], peers: list[str]) -> list[str]:
    cells = ["geometric mean", ""]
    for direction in ("out", "into"):
        cells.append("")
        for peer in peers:
            ratios = [getattr(r, direction)[peer] / getattr(r, direction)["aioros1"] for r in rows]
            cells += ["", f"{statistics.geometric_mean(ratios):.2f}x"]
    return cells


if __name__ == "__main__":
    main()
