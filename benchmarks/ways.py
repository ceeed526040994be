"""How straight the ways through the code are: calls, files, and moves between files.

    python benchmarks/ways.py [WAY ...] [--trace]

Each way is what one node does for one thing, from its public call or the first byte to the end:

- *calls* of functions of the package, in the thread of the node. A coroutine counts when it
  begins and whenever it goes on, since a reader has to find the place again.
- *files* in which these functions are. The code that is generated for a type is one file.
- *moves*: calls that are in another file than the call before.
- *returns*: moves to a file that was left before. A way without any reads like a line.

The master and the peer are in another thread, with an event loop of their own, and do not count.
Nothing else runs in the node: no heartbeat, no log topic. ``--trace`` prints the calls one by
one, with the file of each. Which package is measured, ``PYTHONPATH`` says, so that trees
can be compared.
"""

from __future__ import annotations

import argparse
import asyncio
import contextlib
import gc
import sys
import threading
from collections import Counter
from collections.abc import AsyncIterator, Awaitable, Callable
from dataclasses import dataclass
from pathlib import Path
from types import FrameType, TracebackType
from typing import Any, Self

import aioros1

ROOT = Path(aioros1.__file__).parent
RUNS = 5
OPTIONS: dict[str, Any] = {"heartbeat": None, "rosout": False, "logger_services": False}
PATIENCE = 20.0


@dataclass(frozen=True)
class Call:
    """One call of a function of the package."""

    file: str
    function: str


class Way:
    """The calls of this thread while its blocks run."""

    def __init__(self) -> None:
        self.calls: list[Call] = []

    def __enter__(self) -> Self:
        gc.disable()  # it would call what is none of this way
        sys.setprofile(self._note)
        return self

    def __exit__(
        self,
        exc_type: type[BaseException] | None,
        exc: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        sys.setprofile(None)
        gc.enable()

    async def until(self, condition: Callable[[], bool]) -> None:
        """Count while the loop runs, until ``condition()``, which does not count."""
        async with asyncio.timeout(PATIENCE):
            while not condition():
                with self:
                    await asyncio.sleep(0)

    def _note(self, frame: FrameType, event: str, argument: object) -> None:
        if event == "call" and (file := _file(frame.f_code.co_filename)) is not None:
            self.calls.append(Call(file, frame.f_code.co_qualname))

    # figures

    @property
    def files(self) -> int:
        return len({call.file for call in self.calls})

    @property
    def moves(self) -> int:
        pairs = zip(self.calls, self.calls[1:], strict=False)
        return sum(before.file != call.file for before, call in pairs)

    @property
    def returns(self) -> int:
        """Every file but the first is moved to for a first time; the other moves go back."""
        return self.moves - max(self.files - 1, 0)

    @property
    def figures(self) -> tuple[int, int, int, int]:
        return len(self.calls), self.files, self.moves, self.returns


def _file(name: str) -> str | None:
    """The file within the package; nothing for code of others."""
    if name.startswith(str(ROOT)):
        return str(Path(name).relative_to(ROOT))
    return "generated code" if name.startswith("<codec of ") else None


class Elsewhere:
    """A thread with an event loop, in which there are a master and a node."""

    def __init__(self) -> None:
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever, daemon=True)

    async def __aenter__(self) -> Self:
        self._thread.start()
        self.master = aioros1.Master(host="localhost", port=0, rosout=False)
        await self.run(self.master.start())
        self.node = aioros1.Node("there", master_uri=self.master.uri, **OPTIONS)
        await self.run(self.node.start())
        return self

    async def __aexit__(self, *error: object) -> None:
        await self.run(self.node.close())
        await self.run(self.master.close())
        self._loop.call_soon_threadsafe(self._loop.stop)
        await asyncio.to_thread(self._thread.join)
        self._loop.close()

    async def run(self, awaitable: Awaitable[Any]) -> Any:
        return await asyncio.wrap_future(self.begin(awaitable))

    def begin(self, awaitable: Awaitable[Any]) -> Any:
        async def wait() -> Any:
            return await awaitable

        return asyncio.run_coroutine_threadsafe(wait(), self._loop)

    def call(self, function: Callable[..., object], *words: object) -> None:
        self._loop.call_soon_threadsafe(function, *words)


Measure = Callable[[aioros1.Node, Elsewhere, Way], Awaitable[None]]
TYPE = "std_msgs/String"
SERVICE = "std_srvs/SetBool"


async def publish(node: aioros1.Node, there: Elsewhere, way: Way) -> None:
    async with _topic(there, node) as (pub, sub):
        pub.publish(message := pub.message(data="hello"))
        await there.run(sub.get(timeout=PATIENCE))
        with way:
            pub.publish(message)
        await there.run(sub.get(timeout=PATIENCE))


async def receive(node: aioros1.Node, there: Elsewhere, way: Way) -> None:
    async with _topic(there, node, comes=True) as (pub, sub):
        messages, message = aiter(sub), pub.message(data="hello")
        there.call(pub.publish, message)
        await anext(messages)
        waiting = asyncio.ensure_future(anext(messages))
        with way:
            await asyncio.sleep(0)  # it begins to wait
        there.call(pub.publish, message)
        await way.until(waiting.done)
        await waiting


async def call(node: aioros1.Node, there: Elsewhere, way: Way) -> None:
    await there.run(there.node.advertise_service("flip", SERVICE, _answer))
    caller = await node.service_caller("flip", SERVICE, persistent=True)
    request = caller.request(data=True)
    await caller.call(request)
    with way:
        await caller.call(request)


async def answer(node: aioros1.Node, there: Elsewhere, way: Way) -> None:
    await node.advertise_service("flip", SERVICE, _answer)
    caller = await there.run(there.node.service_caller("flip", SERVICE, persistent=True))
    await there.run(caller.call(data=True))
    answered = there.begin(caller.call(data=True))
    await way.until(answered.done)


async def advertise(node: aioros1.Node, there: Elsewhere, way: Way) -> None:
    await node.get_param("/run_id")  # so that there is a connection to the master
    with way:
        await node.advertise("chatter", TYPE)


async def close(node: aioros1.Node, there: Elsewhere, way: Way) -> None:
    async with _topic(there, node) as (pub, sub):
        pub.publish(data="hello")
        await there.run(sub.get(timeout=PATIENCE))
        with way:
            await pub.close()


async def close_unconnected(node: aioros1.Node, there: Elsewhere, way: Way) -> None:
    pub = await node.advertise("chatter", TYPE)
    with way:
        await pub.close()


async def connect(node: aioros1.Node, there: Elsewhere, way: Way) -> None:
    sub = await node.subscribe("chatter", TYPE)
    advertised = there.begin(there.node.advertise("chatter", TYPE))
    await way.until(lambda: sub.publisher_count == 1)
    await asyncio.wrap_future(advertised)


async def set_param(node: aioros1.Node, there: Elsewhere, way: Way) -> None:
    await node.set_param("rate", 1)
    with way:
        await node.set_param("rate", 2)


async def get_param(node: aioros1.Node, there: Elsewhere, way: Way) -> None:
    await node.set_param("rate", 1)
    with way:
        await node.get_param("rate")


WAYS: dict[str, tuple[str, Measure]] = {
    "publish": ("`pub.publish()`, until it is written to a subscriber", publish),
    "receive": ("a message that arrives, until `async for` has it", receive),
    "call": ("`caller.call()`, persistent", call),
    "answer": ("a call that arrives, until its answer is written", answer),
    "advertise": ("`node.advertise()`, until the master has answered", advertise),
    "close": ("`pub.close()`, with a subscriber", close),
    "close-unconnected": ("`pub.close()`, without one", close_unconnected),
    "connect": ("`publisherUpdate`, until the publisher is connected", connect),
    "set-param": ("`node.set_param()`", set_param),
    "get-param": ("`node.get_param()`", get_param),
}


@contextlib.asynccontextmanager
async def _topic(
    there: Elsewhere, node: aioros1.Node, *, comes: bool = False
) -> AsyncIterator[tuple[Any, Any]]:
    """A publisher and a subscriber that are connected; the one here, the other there."""
    if comes:
        pub = await there.run(there.node.advertise("chatter", TYPE))
        sub = await node.subscribe("chatter", TYPE)
        await there.run(pub.wait_for_subscribers(timeout=PATIENCE))
        await sub.wait_for_publishers(timeout=PATIENCE)
    else:
        pub = await node.advertise("chatter", TYPE)
        sub = await there.run(there.node.subscribe("chatter", TYPE))
        await pub.wait_for_subscribers(timeout=PATIENCE)
        await there.run(sub.wait_for_publishers(timeout=PATIENCE))
    yield pub, sub


def _answer(request: Any) -> dict[str, Any]:
    return {"success": request.data, "message": ""}


async def measure(name: str) -> Way:
    """The way as it was most often in a few runs, each with a node and a master of its own."""
    ways = []
    for _ in range(RUNS):
        way = Way()
        async with (
            Elsewhere() as there,
            aioros1.Node("here", master_uri=there.master.uri, **OPTIONS) as node,
        ):
            await WAYS[name][1](node, there, way)
        ways.append(way)
    ((figures, _),) = Counter(way.figures for way in ways).most_common(1)
    return next(way for way in ways if way.figures == figures)


async def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("ways", nargs="*", metavar="WAY", help=", ".join(WAYS))
    parser.add_argument("--trace", action="store_true", help="print the calls")
    options = parser.parse_args()
    for name in options.ways:
        if name not in WAYS:
            parser.error(f"no way {name!r}; there are {', '.join(WAYS)}")
    names = options.ways or WAYS
    if options.trace:
        for name in names:
            print(f"{name}:")
            for call in (await measure(name)).calls:
                print(f"    {call.file:32} {call.function}")
        return
    print("| way | calls | files | moves | returns |", "|---|--:|--:|--:|--:|", sep="\n")
    for name in names:
        figures = (await measure(name)).figures
        print(f"| {WAYS[name][0]} |", " | ".join(map(str, figures)), "|", flush=True)


if __name__ == "__main__":
    asyncio.run(main())
