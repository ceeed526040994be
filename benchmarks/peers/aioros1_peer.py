"""One side of the topic benchmark, with this library: ``pub`` or ``sub``, count, size."""

from __future__ import annotations

import asyncio
import json
import sys
import time

import aioros1
from aioros1.msg.std_msgs import String

TOPIC = "benchmark"
OPTIONS = {"rosout": False, "logger_services": False, "host": "localhost"}


async def publish(count: int, size: int) -> None:
    async with (
        aioros1.Node("bench_pub", **OPTIONS) as node,
        node.advertise(TOPIC, String, queue_size=1000) as pub,
    ):
        await pub.wait_for_subscribers(timeout=30)
        message = String(data="x" * size)
        for _ in range(count):
            await pub.send(message)
        await pub.drain()


async def subscribe(count: int) -> None:
    async with (
        aioros1.Node("bench_sub", **OPTIONS) as node,
        node.subscribe(TOPIC, String, queue_size=1000, overflow="block") as sub,
    ):
        await sub.get(timeout=30)
        start = time.perf_counter()
        received = 1
        async for _ in sub:
            received += 1
            if received == count:
                break
        report(received, time.perf_counter() - start)


def report(received: int, seconds: float) -> None:
    print(json.dumps({"received": received, "seconds": seconds}), flush=True)


if __name__ == "__main__":
    if "--uvloop" in sys.argv:
        import uvloop

        run = uvloop.run
    else:
        run = asyncio.run
    role, count, size = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    run(publish(count, size) if role == "pub" else subscribe(count))
