"""Every row of the pages for users of cROS and rcl has a test, or says why it needs none."""

from __future__ import annotations

import ast
import re
from functools import cache
from pathlib import Path

import pytest

from .rows import SAME_AS, MappingTest, Row, all_rows, all_tests, main

TESTS = Path(__file__).parents[1]
ROWS = all_rows()
NAMES = (Path(__file__).parent / "names.txt").read_text().split()
"""What cROS and those parts of rcl offer, by name."""


def test_there_are_rows_and_tests():
    assert len(ROWS) > 200
    assert len(all_tests()) > 250


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.place)
def test_row_is_covered(row):
    assert not row.missing, f"{row.place}: neither a test nor a sentence for {row.missing}"
    assert row.tests or row.sentence


@cache
def functions_of(path: Path) -> set[str]:
    tree = ast.parse(path.read_text())
    return {
        node.name for node in tree.body if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
    }


@pytest.mark.parametrize("key", SAME_AS)
def test_what_is_listed_by_hand_exists(key):
    assert any(row.key == key for row in ROWS), "there is no such row any more"
    for place in SAME_AS[key]:
        file, function = place.split("::")
        assert function in functions_of(TESTS / file), place


def test_every_name_is_in_a_row():
    def is_meant(name: str, written: str, family: str) -> bool:
        """As rows abbreviate: ``Free`` after ``xmlrpcParamInit``, and ``…`` for anything."""
        pattern = r"\w*".join(map(re.escape, written.split("…")))
        return bool(re.fullmatch(pattern, name)) or (
            name.startswith(family[:4]) and bool(re.fullmatch(rf"\w*{pattern}", name))
        )

    written = [(name, row.names[0]) for row in ROWS for name in row.names]
    assert [name for name in NAMES if not any(is_meant(name, *each) for each in written)] == []


# --------------------------------------------------------------------------- of rows.py itself


def test_the_listing_has_every_row_and_its_tests(capsys):
    main()
    listing = capsys.readouterr().out
    assert "MISSING" not in listing
    for row in ROWS:
        assert f"{row.place}: {row.key}\n" in listing
    assert "    mapping/test_cros_nodes.py::test_CrosNode_pid\n" in listing


def test_a_row_without_a_test_is_found():
    row = Row("page:1", ("`cRosNodeCreate`, `cRosNodeFly`", "`node.fly()`", ""))
    assert row.missing == ["cRosNodeFly"]
    assert Row("page:1", ("what it sounds like", "`node.sing()`")).missing == [
        "what it sounds like"
    ]


def test_a_row_for_what_is_not_here_has_its_sentence():
    row = Row("page:1", ("`cRosNodeFly`", "nothing: nodes stay on the ground", ""))
    assert not row.missing
    assert row.sentence == "nothing: nodes stay on the ground"


@pytest.mark.parametrize(
    ("name", "beginning", "carries"),
    [
        ("cRosNodeStart", "", True),
        ("cRosNodeSta", "", False),
        ("RosNodeStart", "", False),
        ("Start", "cRos", True),
        ("Start", "xmlr", False),
        ("cRos…Start", "", True),
        ("cRosNode…", "", True),
        ("LEVEL", "", True),
    ],
)
def test_what_a_test_carries(name, beginning, carries):
    words = "test_cRosNodeStart_with_timeout\nLEVEL"
    assert MappingTest("file::function", words).carries(name, beginning) is carries
