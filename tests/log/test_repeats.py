"""Complaints that come again are counted, in bounded memory."""

from __future__ import annotations

import asyncio
import logging

from aioros1.log.library_log import LibraryLog
from aioros1.log.repeats import Repeats


def test_the_first_is_said_and_the_others_are_counted():
    repeats = Repeats()
    assert repeats.is_new("%s is late", "/a", ("/a",), 0.0)
    assert repeats.is_new("%s is late", "/b", ("/b",), 0.0)
    assert repeats.is_new("%s is early", "/a", ("/a",), 0.0)
    assert not any(repeats.is_new("%s is late", "/a", ("/a",), second) for second in range(12))
    assert not list(repeats.due(59.0))
    assert list(repeats.due(60.0)) == [("%s is late", ("/a",), "12 more times in the last minute")]
    # While it goes on, ever more seldom.
    assert not repeats.is_new("%s is late", "/a", ("/a",), 61.0)
    assert not list(repeats.due(120.0))
    assert list(repeats.due(180.0)) == [("%s is late", ("/a",), "once more in the last 2 minutes")]
    assert not list(repeats.due(420.0))
    # What did not come again is forgotten, and news again.
    assert not repeats
    assert repeats.is_new("%s is late", "/a", ("/a",), 421.0)


def test_the_longest_period_is_an_hour():
    repeats = Repeats()
    repeats.is_new("x", 1, (), 0.0)
    said = []
    for minute in range(1, 60 * 24):
        repeats.is_new("x", 1, (), minute * 60.0)
        said += list(repeats.due(minute * 60.0))
    assert len(said) < 6 + 24
    assert said[-1][2] == "60 more times in the last hour"


def test_many_different_ones_are_not_told_apart_for_ever():
    repeats = Repeats(capacity=3)
    new = [repeats.is_new("%s is late", n, (n,), 0.0) for n in range(1000)]
    assert new == [True] * 3 + [False] * 997
    # Another kind has room of its own.
    assert repeats.is_new("%s is early", 1, (1,), 0.0)
    assert list(repeats.due(60.0)) == [("… is late", (), "997 others in the last minute")]
    assert repeats.is_new("%s is late", 5, (5,), 61.0)


async def test_the_count_is_logged_when_the_time_is_over(caplog):
    log = LibraryLog(logging.getLogger("ros.test"), Repeats(0.05))
    for _ in range(8):
        log.complain("%s is late", "/a")
    async with asyncio.timeout(10):
        while len(caplog.records) < 2:
            await asyncio.sleep(0.01)
    assert [each.getMessage() for each in caplog.records[:2]] == [
        "/a is late",
        "/a is late (7 more times in the last 0.05 s)",
    ]
    log.close()


async def test_a_closed_log_has_no_timer(caplog):
    log = LibraryLog(logging.getLogger("ros.test"), Repeats(0.01))
    log.complain("%s is late", "/a")
    log.complain("%s is late", "/a")
    log.close()
    log.complain("%s is late", "/b")
    await asyncio.sleep(0.05)
    assert [each.getMessage() for each in caplog.records] == ["/a is late", "/b is late"]


def test_what_is_logged_is_one_line_of_bounded_length(caplog):
    log = LibraryLog(logging.getLogger("ros.test"))
    log.warning("%s: %s, %d and %.1f", "/a\nERROR forged\x1b[2J", ValueError("x" * 10**6), 3, 2.5)
    (record,) = caplog.records
    text = record.getMessage()
    assert text.isprintable()
    assert text.startswith(r"/a\nERROR forged\x1b[2J: xxx")
    assert text.endswith("… (1000000 characters), 3 and 2.5")
    assert len(text) < 1200
    assert record.funcName == "test_what_is_logged_is_one_line_of_bounded_length"
