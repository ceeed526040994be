"""Memory for large messages that is kept."""

from __future__ import annotations

import pytest

from aioros1.wire import allocation


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """The sizes of the blocks that are made and given back."""
    sizes: list[int] = []
    monkeypatch.setattr(allocation, "_kept", 0)
    monkeypatch.setattr(allocation, "bytes", sizes.append, raising=False)
    return sizes


def test_a_block_of_several_messages_once(made: list[int]) -> None:
    for _ in range(3):
        allocation.keep_memory(1_000_000)
    allocation.keep_memory(10_000)
    assert made == [16_000_000]


def test_growing_messages_ask_less_and_less(made: list[int]) -> None:
    for size in range(100_000, 1_000_000, 1_000):
        allocation.keep_memory(size)
    assert made == [1_600_000, 3_200_000, 6_400_000, 12_800_000, 25_600_000]


def test_it_is_bounded(made: list[int]) -> None:
    for size in (1 << 30, 1 << 31, 1 << 40):
        allocation.keep_memory(size)
    assert made == [31 << 20]
