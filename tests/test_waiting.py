"""Waiting for what another part of the loop brings about."""

from __future__ import annotations

import asyncio
import contextvars
import gc
import weakref

import pytest

from aioros1.waiting import Waiter, Waiters

Note = list[str]


async def wait_for(waiter: Waiter[str], notes: Note) -> None:
    try:
        notes.append(await waiter)
    except asyncio.CancelledError:
        notes.append("cancelled")
        raise


def make_waiter() -> Waiter[str]:
    return Waiter(loop=asyncio.get_running_loop())


async def begun(waiter: Waiter[str], notes: Note) -> asyncio.Task[None]:
    task = asyncio.create_task(wait_for(waiter, notes))
    await asyncio.sleep(0)
    return task


async def test_between_two_tasks_the_one_that_waits_runs_at_once() -> None:
    notes: Note = []
    waiter = make_waiter()
    task = await begun(waiter, notes)

    def arrive() -> None:
        waiter.resume("came")
        notes.append("afterwards")

    asyncio.get_running_loop().call_soon(arrive)
    await task
    assert notes == ["came", "afterwards"]


async def test_a_task_that_runs_is_not_interrupted() -> None:
    notes: Note = []
    waiter = make_waiter()
    task = await begun(waiter, notes)
    waiter.resume("came")
    notes.append("afterwards")
    await task
    assert notes == ["afterwards", "came"]


async def test_a_result_that_is_set_is_taken_in_the_next_turn() -> None:
    notes: Note = []
    waiter = make_waiter()
    task = await begun(waiter, notes)
    asyncio.get_running_loop().call_soon(waiter.set_result, "came")
    asyncio.get_running_loop().call_soon(notes.append, "before")
    await task
    assert notes == ["before", "came"]


async def test_an_exception_comes_as_of_any_future() -> None:
    waiter = make_waiter()
    task = await begun(waiter, [])
    waiter.set_exception(OSError("gone"))
    with pytest.raises(OSError, match="gone"):
        await task


async def test_a_result_that_is_there_before_anybody_waits() -> None:
    notes: Note = []
    waiter = make_waiter()
    waiter.resume("came")
    await wait_for(waiter, notes)
    assert notes == ["came"]


@pytest.mark.parametrize("what", ["task", "waiter"])
async def test_cancelling_the_task_or_what_it_waits_for(what: str) -> None:
    notes: Note = []
    waiter = make_waiter()
    task = await begun(waiter, notes)
    (task if what == "task" else waiter).cancel()
    with pytest.raises(asyncio.CancelledError):
        await task
    assert notes == ["cancelled"]
    assert waiter.cancelled()


async def test_a_timeout_of_the_caller() -> None:
    waiter = make_waiter()
    with pytest.raises(TimeoutError):
        async with asyncio.timeout(0.01):
            await waiter


async def test_who_goes_on_at_once_has_its_own_context() -> None:
    variable: contextvars.ContextVar[str] = contextvars.ContextVar("variable", default="outside")
    waiter = make_waiter()
    seen: Note = []

    async def wait() -> None:
        variable.set("inside")
        await waiter
        seen.append(variable.get())
        seen.append(str(asyncio.current_task() is task))

    task = asyncio.create_task(wait())
    await asyncio.sleep(0)
    asyncio.get_running_loop().call_soon(waiter.resume, "came")
    await task
    assert seen == ["inside", "True"]
    assert variable.get() == "outside"


async def test_a_failure_of_who_goes_on_is_its_own() -> None:
    waiter = make_waiter()

    async def fail() -> None:
        await waiter
        raise ValueError("mine")

    task = asyncio.create_task(fail())
    await asyncio.sleep(0)
    came = asyncio.get_running_loop().create_future()

    def arrive() -> None:
        waiter.resume("came")
        came.set_result("not disturbed")

    asyncio.get_running_loop().call_soon(arrive)
    assert await came == "not disturbed"
    with pytest.raises(ValueError, match="mine"):
        await task


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
        asyncio.get_running_loop().call_soon(waiters.resume)
        await asyncio.sleep(0)
        await asyncio.sleep(0)
        assert woken == 3 * turn
    for task in tasks:
        task.cancel()
    await asyncio.gather(*tasks, return_exceptions=True)


async def test_nothing_is_left_of_those_that_gave_up() -> None:
    waiters = Waiters()
    left = []
    for _ in range(3):
        task = asyncio.create_task(waiters.wait())
        await asyncio.sleep(0)
        left.append(weakref.ref(task))
        task.cancel()
        await asyncio.wait([task])
        del task
    gc.collect()
    assert [each() for each in left] == [None, None, None]
