"""Two nodes that nothing is done to, and who must not notice what is done to others."""

from __future__ import annotations

import asyncio
import contextlib
from types import TracebackType
from typing import Any, Self

import aioros1
from soak.messages import Numbered, Question, Run

__all__ = ["Bystander"]


class Bystander:
    """A publisher that sends steadily to a subscriber, and calls of a service between.

    None may be lost. How long one had to wait at most is told, and not judged: that is a
    matter of what else the machine does.
    """

    def __init__(self, master_uri: str, *, hz: float = 100.0, name: str = "bystander") -> None:
        options: dict[str, Any] = {"master_uri": master_uri, "rosout": False, "heartbeat": 0.2}
        self._here = aioros1.Node(f"{name}_here", **options)
        self._there = aioros1.Node(f"{name}_there", **options)
        self._name = name
        self._hz = hz
        self._run = Run()
        self._sent = 0
        self._calls = 0
        self._longest = 0.0
        self._problems: list[str] = []
        self._tasks: list[asyncio.Task[None]] = []
        self._stopping = asyncio.Event()

    @property
    def text(self) -> str:
        return (
            f"beside it {self._run.count:,} messages and {self._calls:,} calls, none lost, "
            f"{self._longest * 1e3:.0f} ms the longest wait"
        )

    @property
    def problems(self) -> list[str]:
        found = [f"bystander: {problem}" for problem in self._problems + self._run.problems]
        if self._run.count != self._sent:
            found.append(f"bystander: {self._sent} messages sent, {self._run.count} received")
        return found

    async def __aenter__(self) -> Self:
        await self._here.start()
        await self._there.start()
        topic, service = f"{self._name}/messages", f"{self._name}/echo"
        self._pub = await self._here.advertise(topic, Numbered, queue_size=1000)
        self._sub = await self._there.subscribe(topic, Numbered, queue_size=1000, overflow="block")
        await self._there.advertise_service(service, Question, _answer)
        self._caller = await self._here.service_caller(service, Question, persistent=True)
        await self._pub.wait_for_subscribers(timeout=30)
        # A kept connection needs the master once, to be made.
        await self._call(0)
        self._tasks = [asyncio.create_task(self._send()), asyncio.create_task(self._receive())]
        return self

    async def __aexit__(
        self,
        exc_type: type[BaseException] | None,
        exc: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self._stopping.set()
        sending, receiving = self._tasks
        await sending
        with contextlib.suppress(TimeoutError):  # told by what is missing
            async with asyncio.timeout(30):
                while self._run.count < self._sent:
                    await asyncio.sleep(0.01)
        await self._here.close()
        await self._there.close()
        await receiving

    async def _send(self) -> None:
        loop = asyncio.get_running_loop()
        try:
            while not self._stopping.is_set():
                begin = loop.time()
                self._pub.publish(life=0, number=self._sent)
                self._sent += 1
                if self._sent % 10 == 0:
                    await self._call(self._sent)
                await asyncio.sleep(1 / self._hz)
                self._longest = max(self._longest, loop.time() - begin - 1 / self._hz)
        except Exception as error:
            self._problems.append(f"sending: {error!r}")

    async def _call(self, number: int) -> None:
        reply = await self._caller.call(life=0, number=number, timeout=30)
        if reply.number != number:
            self._problems.append(f"call {number} was answered with {reply.number}")
        self._calls += 1

    async def _receive(self) -> None:
        async for message in self._sub:
            self._run.got(message.number)


def _answer(request: Any) -> Any:
    return Question.Response(life=request.life, number=request.number)
