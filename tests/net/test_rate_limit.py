"""Token buckets, and what is said seldom."""

from __future__ import annotations

import pytest

from aioros1.net.rate_limit import RateLimit, Seldom


def test_a_burst_is_free_and_what_is_beyond_waits_its_turn() -> None:
    limit = RateLimit(10, 3)
    assert [limit.take("a", 0) for _ in range(5)] == pytest.approx([0, 0, 0, 0.1, 0.2])


def test_keys_do_not_wait_for_each_other() -> None:
    limit = RateLimit(1, 1)
    assert limit.take("a", 0) == 0
    assert limit.take("a", 0) == 1
    assert limit.take("b", 0) == 0


def test_tokens_come_back_with_time_and_no_more_than_fit() -> None:
    limit = RateLimit(10, 2)
    assert [limit.take("a", 0), limit.take("a", 0)] == [0, 0]
    assert limit.take("a", 0.1) == pytest.approx(0)
    assert limit.take("a", 0.1) == pytest.approx(0.1)
    assert [limit.take("a", 100) for _ in range(3)] == pytest.approx([0, 0, 0.1])


def test_several_at_once() -> None:
    limit = RateLimit(10, 5)
    assert limit.take("a", 0, 5) == 0
    assert limit.take("a", 0, 10) == pytest.approx(1)
    assert limit.take("a", 0) == pytest.approx(1.1)
    assert limit.take("a", 0, 0) == pytest.approx(1.1)


def test_what_is_given_back_can_be_taken_again() -> None:
    limit = RateLimit(1, 1)
    assert [limit.take("a", 0) for _ in range(3)] == [0, 1, 2]
    limit.give_back("a", 2)
    assert limit.take("a", 0) == 1
    limit.give_back("unknown")
    assert limit.take("unknown", 0) == 0


def test_no_more_keys_are_kept_than_there_is_room_for() -> None:
    limit = RateLimit(1, 1, capacity=10)
    for number in range(1000):
        limit.take(str(number), 0)
        assert len(limit._full_at) <= 10
    assert limit.take("999", 0) == 1  # the last ones are still known
    assert limit.take("0", 0) == 0


def test_keys_that_have_rested_make_room_for_others() -> None:
    limit = RateLimit(1, 1, capacity=3)
    limit.take("busy", 0, 100)
    limit.take("a", 0)
    limit.take("b", 0)
    limit.take("c", 50)
    assert limit.take("busy", 50) == pytest.approx(50)


def test_each_key_is_spoken_of_once_in_a_while() -> None:
    seldom = Seldom(60)
    assert [seldom("a", now) for now in (0, 1, 59.9, 60, 61)] == [True, False, False, True, False]
    assert seldom("b", 61)


def test_of_many_keys_only_some_are_spoken_of() -> None:
    seldom = Seldom(60, capacity=3)
    assert [seldom(str(number), 0) for number in range(5)] == [True] * 3 + [False] * 2
    assert not seldom("0", 30)
    assert seldom("4", 60)
    assert [seldom(str(number), 61) for number in range(1000)].count(True) == 2
    assert len(seldom._spoken) == 3


@pytest.mark.parametrize("now", [0.0, 3120.123456789, 4096.7, 1e7 + 0.1])
@pytest.mark.parametrize("rate", [0.001, 50.0, 1e4])
def test_what_fits_the_burst_never_waits_whatever_the_clock_says(now: float, rate: float) -> None:
    limit = RateLimit(rate, 3)
    assert [limit.take("a", now) for _ in range(3)] == [0.0] * 3
    assert limit.take("a", now) == pytest.approx(1 / rate, rel=1e-3)
