"""How requests share an event loop: nobody holds it up, and everybody has a turn."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Generator

from aioros1.net.turns import SLICE, Turns


def busy(seconds: float) -> None:
    end = time.perf_counter() + seconds
    while time.perf_counter() < end:
        pass


async def short(turns: Turns, seconds: float) -> None:
    turn = await turns.take()
    busy(seconds)
    turn.end()


async def long(turns: Turns, steps: int) -> int:
    def work() -> Generator[None, None, int]:
        for _ in range(steps):
            busy(SLICE / 2)
            yield
        return steps

    return await (await turns.take()).run(work())


async def iterations_until(task: asyncio.Future[object]) -> int:
    count = 0
    while not task.done():
        count += 1
        await asyncio.sleep(0)
    return count


async def test_a_long_request_lets_others_run() -> None:
    turns = Turns(asyncio.get_running_loop())
    task = asyncio.ensure_future(long(turns, 30))
    assert await iterations_until(task) >= 10
    assert await task == 30


async def test_many_short_requests_at_once_let_others_run() -> None:
    turns = Turns(asyncio.get_running_loop())
    tasks = asyncio.gather(*(short(turns, SLICE / 5) for _ in range(100)))
    assert await iterations_until(tasks) >= 10


async def test_long_requests_take_turns() -> None:
    turns = Turns(asyncio.get_running_loop())
    ended: list[str] = []

    async def one(name: str, steps: int) -> None:
        await long(turns, steps)
        ended.append(name)

    await asyncio.gather(one("long", 100), one("not so long", 10))
    assert ended == ["not so long", "long"]


async def test_a_short_request_does_not_wait_for_a_long_one() -> None:
    turns = Turns(asyncio.get_running_loop())
    tasks = [asyncio.ensure_future(long(turns, 20)) for _ in range(10)]
    for _ in range(5):
        await asyncio.sleep(0)
    await short(turns, 0)
    assert not any(task.done() for task in tasks)
    await asyncio.gather(*tasks)


async def test_a_request_that_is_cancelled_while_it_waits_takes_no_turn() -> None:
    turns = Turns(asyncio.get_running_loop())
    tasks = [asyncio.ensure_future(short(turns, SLICE)) for _ in range(20)]
    await asyncio.sleep(0)
    for task in tasks[1:]:
        task.cancel()
    async with asyncio.timeout(30):
        await asyncio.wait(tasks)
        await short(turns, 0)
        assert await long(turns, 3) == 3
