"""One side of a benchmark, with this library: ``MODE name=value ...``, as every peer here.

``pub`` and ``sub``, ``ping`` and ``pong``, ``serve`` and ``call``, ``idle``; and ``latch``,
which holds one message for the peers whose start is measured; ``aioros1_growth.py``
and ``aioros1_one_loop.py`` have more. What was measured is written to standard output, as
one line of JSON.
"""

from __future__ import annotations

import asyncio
import sys
import time
from collections.abc import Callable, Coroutine
from contextlib import AsyncExitStack
from itertools import chain, repeat
from typing import Any

from measures import cpu, report, report_times

import aioros1

TOPIC = "benchmark"
LARGE = 1 << 16
"""Bytes from which on a queue is kept short: a thousand images would fill the memory."""

TRANSPORTS = {"": "TCPROS", "unix": "UNIXROS", "intraprocess": "INTRAPROCESS"}
"""The transport that connections have by ``local=...``."""

TYPES = {
    "String": "std_msgs/String",
    "JointState": "sensor_msgs/JointState",
    "TransformStamped": "geometry_msgs/TransformStamped",
    "PointCloud2": "sensor_msgs/PointCloud2",
    "Image": "sensor_msgs/Image",
}
FIELDS: dict[str, Any] = {
    "JointState": {
        "header": {"frame_id": "base_link"},
        "name": [f"joint_{i}" for i in range(6)],
        "position": [0.5] * 6,
        "velocity": [0.5] * 6,
        "effort": [0.5] * 6,
    },
    "TransformStamped": {
        "header": {"frame_id": "odom"},
        "child_frame_id": "base_link",
        "transform": {"rotation": {"w": 1.0}},
    },
}


class Options(dict[str, str]):
    """The words ``name=value`` of the command line."""

    def number(self, name: str, default: int = 0) -> int:
        return int(self.get(name, default))


def make_message(options: Options) -> Any:
    kind, size = options["kind"], options.number("size")
    if kind == "String":
        fields: dict[str, Any] = {"data": "x" * size}
    else:
        fields = FIELDS.get(kind) or {"header": {"frame_id": "camera"}, "data": bytes(size)}
    return aioros1.load_msg(TYPES[kind]).from_dict(fields)


def make_node(name: str, options: Options) -> aioros1.Node:
    local: Any = options.get("local")
    return aioros1.Node(name, local_transports=(local,) if local else ())


def check_transport(pub: aioros1.Publisher[Any], options: Options) -> None:
    """What is measured is what was asked for: nodes fall back to TCP without a word."""
    found = {connection.transport for connection in pub.connections}
    assert found == {TRANSPORTS[options.get("local", "")]}, found


def topics(options: Options, number: int = 1) -> list[str]:
    """The topic, ``number`` times; or those that ``topics=N`` asks for."""
    many = options.number("topics")
    return [f"{TOPIC}_{i}" for i in range(many)] if many else [TOPIC] * number


async def pub(options: Options) -> None:
    message = make_message(options)
    count, rate = options.number("count"), options.number("rate")
    queue_size = 10 if options.number("size") >= LARGE else 1000
    async with AsyncExitStack() as stack:
        node = await stack.enter_async_context(make_node("pub", options))
        start = time.perf_counter()
        pubs = [
            await stack.enter_async_context(
                node.advertise(topic, type(message), queue_size=queue_size)
            )
            for topic in topics(options)
        ]
        setup = time.perf_counter() - start
        for pub in pubs:
            await pub.wait_for_subscribers(options.number("links", 1), timeout=60)
            check_transport(pub, options)
        used, start = cpu(), time.perf_counter()
        if rate:
            async for _ in node.rate(rate):
                pubs[0].publish(message)
                count -= 1
                if not count:
                    break
        elif options.number("turns"):
            for pub in chain.from_iterable(repeat(pubs, count)):
                await pub.send(message)
                await asyncio.sleep(0)
        else:
            for pub in chain.from_iterable(repeat(pubs, count)):
                await pub.send(message)
        for pub in pubs:
            await pub.drain()
        report(cpu=cpu() - used, seconds=time.perf_counter() - start, setup=setup)


async def sub(options: Options) -> None:
    count, number = options.number("count"), options.number("subscribers", 1)
    queue_size = 10 if options.number("size") >= LARGE else 1000
    async with AsyncExitStack() as stack:
        node = await stack.enter_async_context(make_node("sub", options))
        start = time.perf_counter()
        subs = [
            await stack.enter_async_context(
                node.subscribe(
                    topic,
                    TYPES[options["kind"]],
                    queue_size=queue_size,
                    overflow="block",
                    views=bool(options.number("views")),
                )
            )
            for topic in topics(options, number)
        ]
        setup = time.perf_counter() - start
        report(ready=1)
        await subs[0].get(timeout=60)
        used, start = cpu(), time.perf_counter()
        watch = asyncio.create_task(close_when_over(subs))
        received = 1 + sum(
            await asyncio.gather(
                receive(subs[0], count - 1), *(receive(sub, count) for sub in subs[1:])
            )
        )
        seconds = time.perf_counter() - start
        report(received=received, seconds=seconds, cpu=cpu() - used, setup=setup)
        watch.cancel()


async def receive(sub: Any, count: int) -> int:
    received = 0
    if count:
        async for _ in sub:
            received += 1
            if received == count:
                break
    return received


async def close_when_over(subs: list[Any]) -> None:
    """What has not come by some time after the publisher left is lost."""
    while any(sub.publisher_count or sub.queued for sub in subs):
        await asyncio.sleep(1)
    await asyncio.sleep(1)
    for sub in subs:
        await sub.close()


async def ping(options: Options) -> None:
    message = make_message(options)
    count = options.number("count")
    times = []
    async with (
        make_node("ping", options) as node,
        node.advertise("ping", type(message)) as pub,
        node.subscribe("pong", type(message), views=bool(options.number("views"))) as sub,
    ):
        await pub.wait_for_subscribers(timeout=60)
        await sub.wait_for_publishers(timeout=60)
        check_transport(pub, options)
        for _ in range(count + count // 10):
            start = time.perf_counter()
            pub.publish(message)
            await sub.get()
            times.append(time.perf_counter() - start)
    report_times(times[count // 10 :])


async def pong(options: Options) -> None:
    type_name = TYPES[options["kind"]]
    async with (
        make_node("pong", options) as node,
        node.subscribe("ping", type_name, views=bool(options.number("views"))) as sub,
        node.advertise("pong", type_name) as pub,
    ):
        async for message in sub:
            pub.publish(message)


async def serve(options: Options) -> None:
    from aioros1.srv.std_srvs import SetBool

    def handler(request: SetBool.Request) -> SetBool.Response:
        return SetBool.Response(success=request.data, message="ok")

    async with (
        aioros1.Node("serve") as node,
        node.advertise_service("flip", SetBool, handler) as provider,
    ):
        await provider.node.wait_closed()


async def call(options: Options) -> None:
    from aioros1.srv.std_srvs import SetBool

    count, persistent = options.number("count"), bool(options.number("persistent"))
    times = []
    async with (
        aioros1.Node("call") as node,
        node.service_caller("flip", SetBool, persistent=persistent) as caller,
    ):
        await caller.wait_for_service(timeout=60)
        request = SetBool.Request(data=True)
        for _ in range(count + count // 10):
            start = time.perf_counter()
            reply = await caller.call(request)
            times.append(time.perf_counter() - start)
        assert reply.success
    report_times(times[count // 10 :])


async def idle(options: Options) -> None:
    async with (
        aioros1.Node("idle") as node,
        node.advertise("out", "std_msgs/String"),
        node.subscribe("in", "std_msgs/String"),
    ):
        report(ready=1)
        await node.wait_closed()


async def latch(options: Options) -> None:
    async with (
        aioros1.Node("latch") as node,
        node.advertise(TOPIC, "std_msgs/String", latch=True) as pub,
    ):
        pub.publish(data="hello")
        report(ready=1)
        await node.wait_closed()


MODES = {mode.__name__: mode for mode in (pub, sub, ping, pong, serve, call, idle, latch)}


def find_mode(name: str) -> Callable[[Options], Coroutine[Any, Any, None]]:
    if name in MODES:
        return MODES[name]
    import aioros1_growth  # only here: what starts is measured as well
    import aioros1_one_loop

    return (aioros1_growth.MODES | aioros1_one_loop.MODES)[name]


if __name__ == "__main__":
    if "uvloop=1" in sys.argv:
        import uvloop

        run = uvloop.run
    else:
        run = asyncio.run
    words = Options(word.split("=", 1) for word in sys.argv[2:])
    run(find_mode(sys.argv[1])(words))
