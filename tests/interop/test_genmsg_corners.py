"""Odd definitions at the real genmsg: the answers in the table, and to thousands of others."""

from __future__ import annotations

import json
import random
import subprocess
from pathlib import Path
from typing import Any

from aioros1.errors import MessageError
from aioros1.idl import MessageStore

from ..idl.corners import CORNERS, DIFFERENT, FILES, OTHER
from . import debian

PEER = Path(__file__).parent / "peers" / "genmsg_corners.py"

# What random definitions are made of.
TYPES = [
    *("int8", "uint8", "int32", "uint64", "float32", "float64", "bool", "string", "char", "byte"),
    *("time", "duration", "Header", "std_msgs/Header", "Other", "geometry_msgs/Point"),
    *("corner_msgs/Other", "roslib/Header", "std_msgs/None", "/x", "a//b", "Int32", ""),
]
BRACKETS = ["[]", "[3]", "[0]", "[03]", "[ ]", "[1_0]", "[-1]", "[3]]", "[3][]", "[٣]", "[x]", "["]
SPACES = [" ", "  ", "\t", " \t", "\t ", "", "\x0b", "\xa0", "\u3000"]
NAMES = [
    *("x", "y", "Z", "header", "a_b", "u_", "from", "self"),
    *("_u", "1d", "x-y", "x/y", "a b", "é", "x.y", "", "x#c"),
]
VALUES = [
    *("1", "-1", "+1", "1_000", "0x10", "1e3", "007", "00", "127", "128", "255", "256", "-128"),
    *("-129", "9223372036854775807", "9223372036854775808", "18446744073709551616", "9" * 30),
    *("nan", "inf", "-infinity", "1e400", "1.5", "1.", ".5", "1_0.5", "-0.0", "1,5", "1f", "١٢"),
    *("True", "False", "true", "None", "[]", "'a'", "''", "{}", "()", "1j", "b''", "...", "1+1"),
    *("abc", "a b", " a # b", '"q"', "", "\t", "é", "1\r", "=", "a=b", "- 1", "1__0", "\ufeff1"),
]
LINES = ["", "# c", "# c = d", "\r", "\x0c", "\0", "---", "----", " ---", "--- x", "--", "# ---"]
ENDS = ["", "", "", " ", "\t", "\r", " # c", "#c", " z"]


def ask_genmsg(cases: list[tuple[str, str]]) -> list[dict[str, Any] | None]:
    debian.require_python("genmsg")
    debian.require_definitions("std_msgs", "ros-std-msgs")
    debian.require_definitions("geometry_msgs", "ros-geometry-msgs")
    answer = subprocess.run(
        [debian.PYTHON, str(PEER)],
        input=json.dumps({"cases": cases, "other": OTHER}),
        env=debian.environment("http://localhost:1", Path("/nonexistent")),
        capture_output=True,
        text=True,
        check=False,
    )
    assert answer.returncode == 0, answer.stderr
    answers: list[dict[str, Any] | None] = json.loads(answer.stdout)
    return answers


def read_here(kind: str, text: str) -> dict[str, Any] | None:
    """What the peer says of a definition, of ours."""
    store = MessageStore()
    store.add_text("corner_msgs/Other", OTHER)
    try:
        store.add_text("corner_msgs/Corner", text, kind=kind)  # type: ignore[arg-type]
        load = store.load_msg if kind == "msg" else store.load_srv
        cls: Any = load("corner_msgs/Corner")
    except MessageError:
        return None
    specs = [cls._spec] if kind == "msg" else [cls._spec.request, cls._spec.response]
    return {"md5sum": cls._md5sum, "specs": [show(spec) for spec in specs]}


def show(spec: Any) -> dict[str, Any]:
    return {
        "text": spec.text,
        "has_header": spec.has_header,
        "fields": [[f.name, f.type, f.base_type, f.array_len] for f in spec.fields],
        "constants": [[c.type, c.name, repr(c.value), c.text] for c in spec.constants],
    }


def test_the_table_has_the_answers_of_genmsg() -> None:
    rows = [(name, (kind, text), md5) for kind, name, text, md5 in CORNERS]
    rows += [(name, (kind, text), md5) for kind, name, text, md5, _ in DIFFERENT]
    for (name, _, md5), theirs in zip(rows, ask_genmsg([row[1] for row in rows]), strict=True):
        assert (theirs and theirs["md5sum"]) == md5, name


def test_files_of_the_table(tmp_path: Path) -> None:
    paths = [tmp_path / f"{number}.msg" for number in range(len(FILES))]
    for path, (_, content, _) in zip(paths, FILES, strict=True):
        path.write_bytes(content)
    answers = ask_genmsg([("file", str(path)) for path in paths])
    for (name, _, md5), theirs in zip(FILES, answers, strict=True):
        assert (theirs and theirs["md5sum"]) == md5, name


def test_fields_and_constants_of_the_table() -> None:
    """Beyond the MD5 sum: types as resolved, lengths of arrays, values of constants, texts."""
    cases = [(kind, text) for kind, _, text, _ in CORNERS]
    for (_, name, text, _), case, theirs in zip(CORNERS, cases, ask_genmsg(cases), strict=True):
        assert read_here(*case) == theirs, (name, text)


def test_random_definitions() -> None:
    seed = "corners"
    dice = random.Random(seed)
    cases = [random_definition(dice) for _ in range(5000)]
    answers = ask_genmsg(cases)
    for case, theirs in zip(cases, answers, strict=True):
        assert read_here(*case) == theirs, (seed, case)
    # Neither all right nor all wrong.
    assert 500 < sum(theirs is not None for theirs in answers) < 4500


def random_definition(dice: random.Random) -> tuple[str, str]:
    lines = [random_line(dice) for _ in range(dice.choice((1, 1, 1, 2, 2, 3)))]
    return dice.choice(("msg", "msg", "srv")), "\n".join(lines)


def random_line(dice: random.Random) -> str:
    def often(usual: list[str], odd: list[str]) -> str:
        return dice.choice(usual if dice.random() < 0.8 else odd)

    before = often([""], ["", " ", "\t", "\ufeff"])
    type_, space, name = often(TYPES[:16], TYPES), often([" "], SPACES), often(NAMES[:8], NAMES)
    sort = dice.random()
    if sort < 0.2:
        return dice.choice(LINES)
    if sort < 0.6:
        return before + type_ + often([""], BRACKETS) + space + name + dice.choice(ENDS)
    sign = often(["=", " = "], ["= ", " =", "\t=\t", "=="])
    return before + type_ + space + name + sign + dice.choice(VALUES) + dice.choice(ENDS)
