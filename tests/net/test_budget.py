"""What many connections hold together, and which of them has to go."""

from __future__ import annotations

import pytest

from aioros1.net import budget
from aioros1.net.budget import FREE, Budget, Share

MB = 1 << 20


class Owners:
    """Names of owners that had to go, and a clock that is set by hand."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, limit: int) -> None:
        self.budget = Budget(limit)
        self.gone: list[str] = []
        self.now = 0.0
        monkeypatch.setattr(budget, "monotonic", lambda: self.now)

    def holding(self, name: str, size: int) -> Share:
        self.now += 1.0
        share = self.budget.share(lambda: self.gone.append(name))
        share.grow_to(FREE + size)
        return share


@pytest.fixture
def owners(monkeypatch: pytest.MonkeyPatch) -> Owners:
    return Owners(monkeypatch, 10 * MB)


def test_who_has_held_most_for_longest_has_to_go(owners: Owners) -> None:
    owners.holding("early", 4 * MB)
    owners.holding("late", 4 * MB)
    owners.holding("latest", 4 * MB)
    assert owners.gone == ["early"]
    assert owners.budget.used == 8 * MB
    assert owners.budget.cut == 1


def test_many_that_hold_little_do_not_stop_one_that_holds_more(owners: Owners) -> None:
    for number in range(1000):
        owners.holding(f"small {number}", 10_000)
    large = owners.holding("large", 2 * MB)
    assert not large.is_cut
    assert "small 0" in owners.gone
    assert owners.budget.used <= 10 * MB


def test_small_ones_are_never_counted(owners: Owners) -> None:
    owners.holding("large", 9 * MB)
    shares = [owners.holding(f"small {number}", 0) for number in range(10_000)]
    assert owners.gone == []
    assert not any(share.is_cut for share in shares)
    assert owners.budget.used == 9 * MB


def test_one_that_is_alone_may_hold_more(owners: Owners) -> None:
    alone = owners.holding("alone", 20 * MB)
    alone.grow_to(FREE + 40 * MB)
    assert owners.gone == []
    owners.holding("second", 1 * MB)
    assert owners.gone == ["alone"]
    assert owners.budget.used == 1 * MB


def test_who_grows_and_is_the_heaviest_has_to_go_itself(owners: Owners) -> None:
    slow = owners.holding("slow", 8 * MB)
    quick = owners.holding("quick", 1 * MB)
    slow.grow_to(FREE + 20 * MB)
    assert owners.gone == ["slow"]
    assert slow.is_cut
    assert not quick.is_cut
    slow.grow_to(FREE + 30 * MB)
    assert owners.budget.used == 1 * MB


def test_what_is_given_back_can_be_used_again(owners: Owners) -> None:
    for number in range(100):
        share = owners.holding(f"owner {number}", 6 * MB)
        share.close()
        share.close()
    assert owners.gone == []
    assert owners.budget.used == 0
