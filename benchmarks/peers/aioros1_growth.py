"""What only the suites of growth ask of this library's peer: ``ring`` and ``host``."""

from __future__ import annotations

import asyncio
import gc
import os
import signal
import time
from contextlib import AsyncExitStack
from pathlib import Path
from typing import Any

from aioros1_peer import TOPIC, Options
from measures import cpu, report

import aioros1
from aioros1.msg.std_msgs import String
from aioros1.srv.std_srvs import SetBool

__all__ = ["MODES"]


def memory() -> int:
    """Bytes of memory that this process has at the moment."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE")


async def ring(options: Options) -> None:
    """``nodes`` nodes in this loop, each of which publishes to the next."""
    nodes, count = options.number("nodes"), options.number("count")
    async with aioros1.Node("first") as first, first.subscribe("first", String):
        pass  # what only the first node of a process costs: modules that are imported
    gc.collect()
    before, start = memory(), time.perf_counter()
    pubs, subs = [], []
    stack = AsyncExitStack()
    for i in range(nodes):
        node = await stack.enter_async_context(aioros1.Node(f"ring_{i}"))
        enter = stack.enter_async_context
        pubs.append(await enter(node.advertise(f"ring_{i}", String, queue_size=1000)))
        topic = f"ring_{(i or nodes) - 1}"
        subs.append(await enter(node.subscribe(topic, String, queue_size=1000, overflow="block")))
    for pub in pubs:
        await pub.wait_for_subscribers(timeout=60)
    opened = time.perf_counter() - start
    gc.collect()
    used_memory = memory() - before
    each = count // nodes
    used, start = cpu(), time.perf_counter()
    receivers = [asyncio.create_task(take(sub, each)) for sub in subs]
    message = String(data="x" * options.number("size"))
    for _ in range(each):
        for pub in pubs:
            await pub.send(message)
    received = sum(await asyncio.gather(*receivers))
    seconds, used = time.perf_counter() - start, cpu() - used
    start = time.perf_counter()
    await stack.aclose()
    closed = time.perf_counter() - start
    report(
        received=received, seconds=seconds, cpu=used, opened=opened, closed=closed,
        memory=used_memory,
    )  # fmt: skip


async def take(sub: Any, count: int) -> int:
    received = 0
    async for _ in sub:
        received += 1
        if received == count:
            break
    return received


async def host(options: Options) -> None:
    """There for others to connect to; a message now and then shows which are gone."""

    def flip(request: SetBool.Request) -> SetBool.Response:
        return SetBool.Response(success=request.data, message="ok")

    def tell() -> None:
        gc.collect()
        report(tasks=len(asyncio.all_tasks()), objects=len(gc.get_objects()))

    async with (
        aioros1.Node("host") as node,
        node.advertise(TOPIC, String) as pub,
        node.advertise_service("flip", SetBool, flip),
    ):
        asyncio.get_running_loop().add_signal_handler(signal.SIGUSR1, tell)
        report(ready=1)
        async for _ in node.rate(10):
            pub.publish(data="x")


MODES = {mode.__name__: mode for mode in (ring, host)}
