"""Waiting for what another part of the loop brings about."""

from __future__ import annotations

import asyncio
import gc
import weakref

import pytest

from aioros1.waiting import Waiters


async def started(waiters: Waiters, seconds: float | None = None) -> asyncio.Task[None]:
    task = asyncio.create_task(waiters.wait(seconds))
    await asyncio.sleep(0)
    return task


async def test_all_who_wait_look_again() -> None:
    waiters = Waiters()
    tasks = [await started(waiters) for _ in range(3)]
    waiters.wake()
    await asyncio.gather(*tasks)


async def test_who_waits_again_waits_for_the_next_time() -> None:
    waiters = Waiters()
    woken = 0

    async def count() -> None:
        nonlocal woken
        while True:
            await waiters.wait()
            woken += 1

    tasks = [asyncio.create_task(count()) for _ in range(3)]
    await asyncio.sleep(0)
    for turn in range(1, 4):
        waiters.wake()
        await asyncio.sleep(0)
        assert woken == 3 * turn
    for task in tasks:
        task.cancel()
    await asyncio.gather(*tasks, return_exceptions=True)


async def test_waiting_ends_with_the_time_and_without_an_error() -> None:
    waiters = Waiters()
    await waiters.wait(0.01)
    task = await started(waiters, 60)
    waiters.wake()
    await task


async def test_a_failure_is_for_all_now_and_later() -> None:
    waiters = Waiters()
    task = await started(waiters, 60)
    waiters.fail(OSError("gone"))
    for waiting in (task, waiters.wait()):
        with pytest.raises(OSError, match="gone"):
            await waiting


async def test_nothing_is_left_of_those_that_gave_up() -> None:
    waiters = Waiters()
    left = []
    for seconds in (None, 60):
        task = await started(waiters, seconds)
        left.append(weakref.ref(task))
        task.cancel()
        await asyncio.wait([task])
        del task
    gc.collect()
    assert [each() for each in left] == [None, None]
