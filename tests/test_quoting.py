from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from aioros1.quoting import printable


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("/chatter", "/chatter"),
        ("Grüße, 世界 🙂", "Grüße, 世界 🙂"),
        ("a\nb\r\tc", r"a\nb\r\tc"),
        ("\x1b[2J\x07\x9b", r"\x1b[2J\x07\x9b"),
        ("one\u2028two\u2029three\x85four\x0bfive", r"one\u2028two\u2029three\x85four\x0bfive"),
        ("\u202etxt.exe\u200b", r"\u202etxt.exe\u200b"),
        ("\udcff\udc80", r"\xff\x80"),
        ("\ud800", r"\ud800"),
        (ValueError("a\nb"), r"a\nb"),
    ],
)
def test_what_is_no_visible_character_is_escaped(text, shown):
    assert printable(text) == shown


def test_a_long_text_is_cut_and_says_so():
    shown = printable("x" * 1_000_000)
    assert len(shown) == 300
    assert shown.startswith("xxx")
    assert shown.endswith("… (1000000 characters)")
    assert len(printable("\x00" * 250)) <= 300  # too long only when escaped


@given(st.text(), st.integers(min_value=30, max_value=400))
def test_it_is_one_line_within_the_limit_and_doing_it_twice_changes_nothing(text, limit):
    shown = printable(text, limit)
    assert len(shown) <= limit
    assert shown.isprintable()
    assert printable(shown, limit) == shown


def test_a_large_value_costs_no_more_than_what_is_shown():
    deep = {"a": [["x\n" * 10**6] * 10**6, list(range(10**6))]}
    for value in (deep, (deep,), [deep] * 50, b"x\n" * 10**6):
        shown = printable(value)
        assert len(shown) <= 300
        assert shown.isprintable()
    assert printable(["callerid", "md5sum"]) == "['callerid', 'md5sum']"
