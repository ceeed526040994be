"""Lossless topics through proxies that stall, throttle and delay at random."""

from __future__ import annotations

import asyncio
import random
from typing import Any

import aioros1
from aioros1.testing import proxies_before
from aioros1.testing.proxied_node import NodeProxies
from soak.bystander import Bystander
from soak.messages import Numbered, Run
from soak.scenario import Scenario, Seen

TOPICS = 4
PATIENCE = 120.0
"""Seconds without a message after which the rest counts as lost."""


async def run(times: int) -> Seen:
    """``times`` is how many messages, on all topics together."""
    async with (
        aioros1.Master(host="localhost", port=0, rosout=False) as master,
        aioros1.Node(
            "sender", master_uri=master.uri, host="127.0.0.2", bind="127.0.0.1", rosout=False
        ) as sender,
        aioros1.Node("receiver", master_uri=master.uri, rosout=False) as receiver,
        proxies_before(sender) as proxies,
        Bystander(master.uri) as bystander,
    ):
        runs = [Run() for _ in range(TOPICS)]
        faults = [0]
        spoiling = asyncio.create_task(_spoil(proxies, faults))
        try:
            await asyncio.gather(
                *(
                    _topic(sender, receiver, number, times // TOPICS, got)
                    for number, got in enumerate(runs)
                )
            )
        finally:
            spoiling.cancel()
    problems = [text for got in runs for text in got.problems[:3]]
    arrived = sum(got.count for got in runs)
    if arrived != times // TOPICS * TOPICS:
        problems.append(f"{times // TOPICS * TOPICS} sent, {arrived} received")
    text = f"{arrived:,} messages in order through {faults[0]:,} faults; {bystander.text}"
    return Seen(text, problems + bystander.problems)


async def _topic(
    sender: aioros1.Node, receiver: aioros1.Node, number: int, count: int, got: Run
) -> None:
    """Send from one to the other, who stops to think now and then."""
    chance = random.Random(number)
    options: Any = {"queue_size": 100, "overflow": "block"}
    async with (
        sender.advertise(f"lossless_{number}", Numbered, **options) as pub,
        receiver.subscribe(f"lossless_{number}", Numbered, **options) as sub,
    ):
        await pub.wait_for_subscribers(timeout=30)

        async def send() -> None:
            for i in range(count):
                await pub.send(number=i)

        async def receive() -> None:
            async for message in sub:
                got.got(message.number)
                if message.number == count - 1:
                    break
                if message.number % 5_000 == 0:
                    await asyncio.sleep(chance.uniform(0, 0.1))

        async def watch() -> None:
            """Nobody waits for ever for what is lost."""
            last = -2
            while got.last != last:
                last = got.last
                await asyncio.sleep(PATIENCE)
            await sub.close()

        watching = asyncio.create_task(watch())
        sending = asyncio.create_task(send())
        try:
            await receive()
        finally:
            watching.cancel()
            sending.cancel()
            await asyncio.gather(watching, sending, return_exceptions=True)


async def _spoil(proxies: NodeProxies, faults: list[int]) -> None:
    """Now this fault, now that one, for a moment, on one connection or on all."""
    chance = random.Random(0)
    proxy = proxies.tcpros
    while True:
        await asyncio.sleep(chance.uniform(0, 0.02))
        where = chance.choice([proxy, *proxy.connections])
        direction = chance.choice(["up", "down", "both"])
        seconds = chance.uniform(0, 0.1)
        match chance.randrange(3):
            case 0:
                where.stall(direction)
                await asyncio.sleep(seconds)
                where.resume(direction)
            case 1:
                where.throttle(10 ** chance.uniform(4, 7), direction)
                await asyncio.sleep(seconds)
                where.throttle(None, direction)
            case _:
                where.delay(seconds, direction)
                await asyncio.sleep(seconds)
                where.delay(0, direction)
        faults[0] += 1


SCENARIO = Scenario(
    "lossless",
    'Topics with `overflow="block"` on both sides, through connections that stall, throttle and '
    "delay at random; subscribers pause at random",
    "messages",
    "every message arrives, in order",
    run,
    quick=20_000,
    short=1_000_000,
    full=10_000_000,
)
