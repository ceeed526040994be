"""The tables of slow tests name tests that exist."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from .suites import ONCE, SLOW, is_listed

TESTS = Path(__file__).parent


@pytest.mark.parametrize("entry", sorted({*SLOW, *ONCE}))
def test_what_is_listed_exists(entry: str) -> None:
    name, _, test = entry.partition("::")
    assert (TESTS / name).exists()
    if test:
        assert re.search(rf"def {test}\(", (TESTS / name).read_text(encoding="utf-8"))


def test_every_folder_has_quick_tests_but_for_those_of_other_programs() -> None:
    files = [path.relative_to(TESTS).as_posix() for path in TESTS.rglob("test_*.py")]
    quick = {file.rpartition("/")[0] for file in files if not is_listed(SLOW, file, "")}
    assert {file.rpartition("/")[0] for file in files} - quick == {"hosts", "interop"}


def test_folders_files_and_tests_are_listed() -> None:
    entries = ("hosts", "test_a.py", "net/test_b.py::test_c")
    assert is_listed(entries, "hosts/test_a.py", "test_x")
    assert is_listed(entries, "test_a.py", "test_x")
    assert is_listed(entries, "net/test_b.py", "test_c")
    assert not is_listed(entries, "net/test_b.py", "test_cd")
    assert not is_listed(entries, "net/test_a.py", "test_c")
    assert not is_listed(entries, "hostsmore/test_a.py", "test_c")
