"""Runs an awaitable again and again, and cancels it at another place each time.

An awaitable that the library offers is a coroutine, and it suspends by yielding a future to
the task that runs it. :class:`Cut` sits between the two, and so knows every suspension.
"""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Awaitable, Callable, Generator
from dataclasses import dataclass
from typing import Any, TypeVar

__all__ = ["WAYS", "Attempt", "Cut", "attempts"]

T = TypeVar("T")

TURNS = 12
"""Turns of the loop after which the cancellation comes, at the most."""

PATIENCE = 30.0


@dataclass(frozen=True, slots=True)
class Cut:
    """Where and how an attempt is cancelled."""

    way: str
    number: int
    again: int = 0

    def __str__(self) -> str:
        return f"{self.way} {self.number}" + (f", again {self.again}" if self.again else "")


@dataclass(slots=True)
class Attempt:
    """What has become of one."""

    cut: Cut
    is_reached: bool = False
    """Whether there was such a place at all."""
    was_cut: bool = False
    was_cut_again: bool = False
    is_done: bool = False
    result: Any = None


class _Passage:
    """Awaits ``inner``, and cancels the task at the suspensions that ``cut`` names."""

    def __init__(self, inner: Awaitable[Any], attempt: Attempt, cancel: Callable[[], Any]) -> None:
        self._inner = inner
        self._attempt = attempt
        self._cancel = cancel

    def __await__(self) -> Generator[Any, Any, Any]:
        attempt, cut = self._attempt, self._attempt.cut
        iterator = self._inner.__await__()
        resume = iterator.__next__
        suspensions = cleaning = 0
        while True:
            try:
                future = resume()
            except StopIteration as stop:
                return stop.value
            suspensions += 1
            if attempt.was_cut:
                cleaning += 1
                if cleaning == cut.again:
                    attempt.was_cut_again = True
                    self._cancel()
            elif suspensions == cut.number:
                self._cut(future)
            try:
                yield future
            except BaseException as error:
                resume = _thrower(iterator, error)
            else:
                resume = iterator.__next__

    def _cut(self, future: asyncio.Future[Any] | None) -> None:
        match self._attempt.cut.way:
            case "suspended" | "twice":
                self._cancel_now()
            case "resumed" if future is not None:
                # Before the callback that the task adds itself: the result is there, and the
                # task is cancelled before it can see it.
                future.add_done_callback(lambda _: self._cancel_now())

    def _cancel_now(self) -> None:
        self._attempt.was_cut = True
        self._cancel()


def _thrower(iterator: Any, error: BaseException) -> Callable[[], Any]:
    return lambda: iterator.throw(error)


async def _attempt(make: Callable[[], Awaitable[Any]], cut: Cut) -> Attempt:
    attempt = Attempt(cut)
    loop = asyncio.get_running_loop()

    async def run() -> Any:
        if cut.way == "timeout":
            inner = Attempt(Cut("suspended", cut.number))
            try:
                async with asyncio.timeout(None) as limit:
                    # In the next turn of the loop, by which it may be over.
                    return await _Passage(make(), inner, lambda: limit.reschedule(loop.time()))
            except TimeoutError:
                if not limit.expired():
                    raise
                attempt.was_cut = True
                raise asyncio.CancelledError from None
            finally:
                attempt.is_reached = inner.was_cut
        return await _Passage(make(), attempt, cancel)

    def cancel() -> None:
        attempt.is_reached = attempt.was_cut = True
        task.cancel()

    def turn(left: int) -> None:
        if task.done():
            return
        if left:
            loop.call_soon(turn, left - 1)
        else:
            cancel()

    task = asyncio.create_task(run(), name=f"cut {cut}")
    if cut.way == "turn":
        loop.call_soon(turn, cut.number)
    done, _ = await asyncio.wait({task}, timeout=PATIENCE)
    if not done:
        task.cancel()
        await asyncio.wait({task}, timeout=PATIENCE)
        raise AssertionError(f"{cut}: it did not end in {PATIENCE} s")
    attempt.is_done = not task.cancelled()
    if attempt.is_done:
        attempt.result = task.result()  # or what it has raised
    assert not (attempt.was_cut and attempt.is_done), f"{cut}: the cancellation was swallowed"
    assert attempt.was_cut or attempt.is_done, f"{cut}: a cancellation was invented"
    return attempt


WAYS = ("suspended", "resumed", "timeout", "turn", "twice")


async def attempts(
    way: str,
    act: Callable[[T], Awaitable[Any]],
    world: T,
    before: Callable[[T], Awaitable[None]] | None = None,
) -> AsyncIterator[Attempt]:
    """One attempt after the other, cancelled one place later each time, up to one that
    was not cancelled because it was over before."""
    number = 0
    while way != "turn" or number < TURNS:
        number += 1
        again = 1 if way == "twice" else 0
        while True:
            if before is not None:
                await before(world)
            attempt = await _attempt(lambda: act(world), Cut(way, number, again))
            yield attempt
            if not attempt.was_cut_again:
                break
            again += 1
        if not attempt.is_reached:
            return
