"""Subscribers that take nothing, beside one that takes everything at 1 kHz."""

from __future__ import annotations

import asyncio
import socket
from typing import Any

import aioros1
from aioros1.wire.header import encode_header
from soak.messages import Numbered, Run
from soak.scenario import Scenario, Seen

HZ = 1_000.0
STALL = 0.5
PADDING = bytes(4_000)


async def run(times: int) -> Seen:
    """``times`` is how many messages."""
    async with (
        aioros1.Master(host="localhost", port=0, rosout=False) as master,
        aioros1.Node(
            "healthy_pub",
            master_uri=master.uri,
            timeouts=aioros1.Timeouts(stall=STALL),
            rosout=False,
        ) as here,
        aioros1.Node("healthy_sub", master_uri=master.uri, rosout=False) as there,
        here.advertise("steady", Numbered, queue_size=1000) as pub,
        there.subscribe("steady", Numbered, queue_size=1000, overflow="block") as sub,
    ):
        await pub.wait_for_subscribers(timeout=10)
        healthy = pub.connections[0]
        got, loop = Run(), asyncio.get_running_loop()
        longest = 0.0

        async def receive() -> None:
            nonlocal longest
            last = loop.time()
            async for message in sub:
                longest = max(longest, loop.time() - last)
                last = loop.time()
                got.got(message.number)
                if message.number == times - 1:
                    break

        receiving = asyncio.create_task(receive())
        cut_off: list[float] = []
        stalling = asyncio.create_task(_stall_again_and_again(here, pub, cut_off))
        sent = 0
        async for _ in here.rate(HZ):
            pub.publish(number=sent, padding=PADDING)
            sent += 1
            if sent == times:
                break
        problems: list[str] = []
        try:
            async with asyncio.timeout(30):
                await receiving
        except TimeoutError:
            problems.append(f"nothing came after {got.last} of {times}")
        stalling.cancel()
        (ended,) = await asyncio.gather(stalling, return_exceptions=True)
        if isinstance(ended, Exception):
            problems.append(f"a stalled peer: {ended!r}")
        if healthy.stats.dropped or got.count != times or got.problems:
            problems.append(
                f"the healthy one got {got.count} of {times}, {healthy.stats.dropped} dropped: "
                f"{got.problems[:3]}"
            )
        if not cut_off:
            problems.append("no stalled peer was cut off")
        text = (
            f"{len(cut_off):,} stalled peers cut off, the healthy one got every message, "
            f"{longest * 1e3:.0f} ms the longest wait"
        )
    return Seen(text, problems)


async def _stall_again_and_again(
    node: aioros1.Node, pub: aioros1.Publisher[Any], cut_off: list[float]
) -> None:
    """A subscriber that shakes hands and then takes nothing, until it is cut off; again."""
    loop = asyncio.get_running_loop()
    header = encode_header(
        {"callerid": "/stalled", "topic": pub.name, "type": pub.type, "md5sum": pub.md5sum}
    )
    while True:
        with socket.socket() as sock:
            sock.setblocking(False)
            sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            await loop.sock_connect(sock, node.tcpros_address)
            await loop.sock_sendall(sock, header)
            await pub.wait_for_subscribers(2, timeout=10)
            async with asyncio.timeout(60):
                while pub.subscriber_count == 2:
                    await asyncio.sleep(0.01)
        cut_off.append(loop.time())


SCENARIO = Scenario(
    "stalled-peers",
    "A subscriber that takes nothing, again and again, beside a healthy one at 1 kHz",
    "messages",
    "the healthy one gets every message in order; the stalled one is cut off after "
    "`timeouts.stall`",
    run,
    quick=1_500,
    short=60_000,
    full=600_000,
)
