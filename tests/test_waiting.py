"""Waiting for what another part of the loop brings about."""

from __future__ import annotations

import asyncio
import gc
import socket
import time
import weakref

import pytest

from aioros1.waiting import Deadlines, Mutex, Waiters, deadline


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


# deadlines


async def test_the_error_of_a_deadline_says_what_took_too_long_and_why() -> None:
    with pytest.raises(TimeoutError, match=r"^no answer within 0\.01 s: it is busy$"):
        async with deadline(0.01, "no answer") as limit:
            limit.why = OSError("it is busy")
            await asyncio.Event().wait()


@pytest.mark.parametrize("seconds", [0, -1])
async def test_a_deadline_that_is_over_ends_the_block_where_it_waits(seconds: float) -> None:
    reached = False
    with pytest.raises(TimeoutError, match=r"^no answer within"):
        async with deadline(seconds, "no answer"):
            reached = True
            await asyncio.Event().wait()
    assert reached


async def test_a_block_that_ends_in_time_is_left_alone() -> None:
    async with deadline(0.01, "no answer"):
        await asyncio.sleep(0)
    async with deadline(None, "no answer"):
        pass
    await asyncio.sleep(0.02)


async def test_a_timeout_of_a_caller_further_up_passes_unchanged() -> None:
    with pytest.raises(TimeoutError, match=r"^outer within 0"):
        async with deadline(0, "outer"), deadline(60, "inner"):
            await asyncio.Event().wait()
    with pytest.raises(TimeoutError, match=r"^another$"):
        async with deadline(60, "inner"):
            raise TimeoutError("another")


async def test_a_deadline_does_not_hide_a_cancellation() -> None:
    async def wait() -> None:
        async with deadline(0, "no answer"):
            try:
                await asyncio.Event().wait()
            except asyncio.CancelledError:
                task.cancel()  # a second one, from elsewhere
                raise

    task = asyncio.create_task(wait())
    with pytest.raises(asyncio.CancelledError):
        await task


async def test_a_task_is_as_it_was_after_a_deadline() -> None:
    with pytest.raises(TimeoutError):
        async with deadline(0, "no answer"):
            await asyncio.Event().wait()
    task = asyncio.current_task()
    assert task is not None
    assert task.cancelling() == 0
    await asyncio.sleep(0)


async def test_all_running_deadlines_can_be_ended_together() -> None:
    limits = Deadlines()

    async def wait(seconds: float | None, what: str) -> None:
        async with limits.limit(seconds, what) as limit:
            limit.why = "closed"
            await asyncio.Event().wait()

    tasks = [asyncio.create_task(wait(seconds, f"{seconds}")) for seconds in (None, 60)]
    await asyncio.sleep(0)
    limits.expire()
    limits.expire()
    errors = await asyncio.gather(*tasks, return_exceptions=True)
    assert [str(error) for error in errors] == ["None: closed", "60 within 60 s: closed"]
    assert all(isinstance(error, TimeoutError) for error in errors)


async def test_expiring_is_for_blocks_that_run_and_for_no_others() -> None:
    limits = Deadlines()
    async with limits.limit(60, "before") as before:
        pass
    limits.expire()
    before.expire()
    async with limits.limit(60, "after"):
        await asyncio.sleep(0)
    async with limits.limit(60, "about to end"):
        limits.expire()  # it does not wait any more
    await asyncio.sleep(0)


async def test_the_end_of_all_blocks_can_be_waited_for() -> None:
    limits = Deadlines()
    await limits.wait_ended()
    log = []

    async def wait(name: str) -> None:
        async with limits.limit(None, name):
            try:
                await asyncio.Event().wait()
            finally:
                await asyncio.sleep(0)
                log.append(name)

    tasks = [asyncio.create_task(wait(name)) for name in "ab"]
    await asyncio.sleep(0)
    limits.expire()
    await limits.wait_ended()
    assert sorted(log) == ["a", "b"]
    await asyncio.wait(tasks)
    assert all(isinstance(task.exception(), TimeoutError) for task in tasks)


# the mutex


async def acquired(mutex: Mutex, log: list[int], number: int) -> None:
    async with mutex:
        log.append(number)
        await asyncio.sleep(0)


async def test_a_mutex_is_handed_over_in_the_order_of_coming() -> None:
    mutex = Mutex()
    log: list[int] = []
    mutex.is_held = True
    tasks = [asyncio.create_task(acquired(mutex, log, number)) for number in range(4)]
    await asyncio.sleep(0)
    assert not log
    mutex.release()
    await asyncio.gather(*tasks)
    assert log == [0, 1, 2, 3]
    assert not mutex.is_held


async def test_nobody_gets_in_between_two_who_wait() -> None:
    mutex = Mutex()
    async with mutex:
        assert mutex.is_held
        task = asyncio.create_task(mutex.acquire())
        await asyncio.sleep(0)
    assert mutex.is_held  # by the task, which has not run yet
    await task
    mutex.release()
    assert not mutex.is_held


async def test_who_is_cancelled_when_it_gets_the_mutex_passes_it_on() -> None:
    mutex = Mutex()
    await mutex.acquire()
    first = asyncio.create_task(mutex.acquire())
    second = asyncio.create_task(mutex.acquire())
    await asyncio.sleep(0)
    mutex.release()
    first.cancel()
    with pytest.raises(asyncio.CancelledError):
        await first
    await second
    mutex.release()
    assert not mutex.is_held


async def test_who_is_cancelled_before_is_passed_over() -> None:
    mutex = Mutex()
    await mutex.acquire()
    tasks = [asyncio.create_task(mutex.acquire()) for _ in range(4)]
    await asyncio.sleep(0)
    tasks[0].cancel()
    mutex.release()  # before the cancelled task has noticed
    await tasks[1]
    tasks[2].cancel()
    await asyncio.wait(tasks[2:3])
    mutex.release()
    await tasks[3]
    mutex.release()
    assert [task.cancelled() for task in tasks] == [True, False, True, False]
    assert not mutex.is_held


async def test_an_error_inside_releases_the_mutex() -> None:
    mutex = Mutex()
    with pytest.raises(ValueError, match="mistake"):
        async with mutex:
            raise ValueError("a mistake")
    assert not mutex.is_held


def test_a_mutex_belongs_to_no_event_loop_until_somebody_waits() -> None:
    mutex = Mutex()
    mutex.is_held = True
    mutex.release()
    for _ in range(2):
        asyncio.run(acquired(mutex, [], 0))
    with pytest.raises(RuntimeError, match="nobody holds"):
        mutex.release()


# a loop that is blocked


async def _echo(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
    while data := await reader.read(100):
        writer.write(data)
    writer.close()


@pytest.mark.parametrize("seconds", [0.02, 0.1])
async def test_what_came_in_time_counts_though_the_loop_looks_later(seconds: float) -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        reader, writer = await asyncio.open_connection(*server.getsockname())
        peer, _ = server.accept()
        with peer:
            async with deadline(seconds, "no answer"):
                asyncio.get_running_loop().call_soon(_answer_and_block, peer, seconds)
                assert await reader.read(100) == b"here"
        writer.close()


def _answer_and_block(peer: socket.socket, seconds: float) -> None:
    peer.send(b"here")
    time.sleep(2 * seconds)


async def test_time_in_which_the_loop_was_blocked_is_given_back() -> None:
    """Connecting and asking takes several iterations of the loop, which a look is too short for."""
    server = await asyncio.start_server(_echo, "127.0.0.1", 0)
    address = server.sockets[0].getsockname()
    async with server:
        async with deadline(0.2, "no answer"):
            asyncio.get_running_loop().call_soon(time.sleep, 0.5)
            reader, writer = await asyncio.open_connection(*address)
            writer.write(b"here")
            assert await reader.read(100) == b"here"
        writer.close()
        await writer.wait_closed()


async def test_a_loop_that_is_always_blocked_makes_no_limit_endless() -> None:
    async def block() -> None:
        while True:
            asyncio.get_running_loop().call_soon(time.sleep, 0.01)
            await asyncio.sleep(0)

    blocking = asyncio.create_task(block())
    with pytest.raises(TimeoutError, match="no answer within"):
        async with deadline(0.05, "no answer"):
            await asyncio.Event().wait()
    blocking.cancel()
