"""Which messages are collected, until when, and what failures leave behind."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import pytest

from aioros1.net import coalescing
from aioros1.net.coalescing import Coalescer
from aioros1.net.loop_state import loop_state


@pytest.fixture
def is_burst(monkeypatch: pytest.MonkeyPatch) -> Callable[[bool], None]:
    """Say whether messages follow each other closely; no test depends on the machine."""

    def say(value: bool) -> None:
        monkeypatch.setattr(coalescing, "BURST_GAP", float("inf") if value else 0.0)

    return say


async def test_a_message_alone_is_not_collected_and_a_burst_is(is_burst: Any) -> None:
    coalescer = loop_state().coalescer
    is_burst(False)
    coalescer.begin()
    coalescer.sent_alone()
    coalescer.begin()
    assert not coalescer.is_collecting
    is_burst(True)
    coalescer.begin()
    assert coalescer.is_collecting
    assert coalescer.collects_here()
    await asyncio.sleep(0)
    assert not coalescer.is_collecting


async def test_much_in_one_iteration_asks_for_a_pause(is_burst: Any) -> None:
    coalescer = loop_state().coalescer
    for _ in range(coalescing.MAX_ALONE - 1):
        coalescer.sent_alone()
    assert not coalescer.should_yield
    coalescer.sent_alone()
    assert coalescer.should_yield
    assert coalescer.is_collecting
    await asyncio.sleep(0)
    assert not coalescer.should_yield
    coalescer.sent_alone()
    assert not coalescer.should_yield


async def test_a_function_that_raises_is_reported_and_keeps_no_other_from_being_called() -> None:
    reports: list[dict[str, Any]] = []
    loop = asyncio.get_running_loop()
    loop.set_exception_handler(lambda _, context: reports.append(context))
    coalescer = loop_state().coalescer
    called: list[int] = []

    def fail() -> None:
        raise ValueError("a mistake")

    coalescer.collect()
    for number in range(3):
        coalescer.call_at_end(lambda number=number: called.append(number))
        coalescer.call_at_end(fail)
    while len(called) < 3:
        await asyncio.sleep(0)
    await asyncio.sleep(0)
    assert called == [0, 1, 2]
    assert [repr(report["exception"]) for report in reports] == ["ValueError('a mistake')"] * 3
    assert not coalescer.is_collecting
    coalescer.collect()
    coalescer.call_at_end(lambda: called.append(3))
    await asyncio.sleep(0)
    assert called[3:] == [3]


async def test_another_thread_is_refused_and_changes_nothing(is_burst: Any) -> None:
    coalescer = loop_state().coalescer
    is_burst(True)
    refused: list[str] = []

    def publish() -> None:
        try:
            coalescer.begin()
        except RuntimeError as error:
            refused.append(str(error))

    await asyncio.to_thread(publish)
    assert not coalescer.is_collecting
    coalescer.collect()
    elsewhere: list[bool] = []
    thread = threading.Thread(
        target=lambda: (elsewhere.append(coalescer.collects_here()), publish())
    )
    thread.start()
    thread.join()
    assert elsewhere == [False]
    assert coalescer.collects_here()
    assert ["publish() was called in thread" in text for text in refused] == [True, True]
    await asyncio.sleep(0)
    assert not coalescer.is_collecting


def test_a_closed_loop_collects_nothing() -> None:
    async def get() -> Coalescer:
        return loop_state().coalescer

    loop = asyncio.new_event_loop()
    coalescer = loop.run_until_complete(get())
    loop.close()
    for _ in range(2):
        with pytest.raises(RuntimeError, match="closed"):
            coalescer.collect()
        assert not coalescer.is_collecting


def test_a_burst_before_the_loop_runs_again_goes_out_when_it_does() -> None:
    called: list[int] = []

    async def get() -> Coalescer:
        return loop_state().coalescer

    loop = asyncio.new_event_loop()
    coalescer = loop.run_until_complete(get())
    coalescer.collect()
    coalescer.call_at_end(lambda: called.append(1))
    loop.run_until_complete(asyncio.sleep(0))
    loop.close()
    assert called == [1]
    assert not coalescer.is_collecting


def test_a_loop_that_goes_on_in_another_thread_collects_there() -> None:
    async def collect() -> Coalescer:
        coalescer = loop_state().coalescer
        coalescer.collect()
        return coalescer

    async def go_on() -> list[bool]:
        coalescer.begin()
        await asyncio.sleep(0)
        states = [coalescer.is_collecting]
        coalescer.collect()
        states.append(coalescer.collects_here())
        await asyncio.sleep(0)
        return [*states, coalescer.is_collecting]

    loop = asyncio.new_event_loop()
    coalescer = loop.run_until_complete(collect())
    with ThreadPoolExecutor(1) as pool:
        states = pool.submit(loop.run_until_complete, go_on()).result(30)
    loop.close()
    assert states == [False, True, False]
    assert not coalescer.collects_here()
