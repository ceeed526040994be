"""A process that was forked, and holds every socket of a node or a master that is closed."""

from __future__ import annotations

import asyncio
import contextlib
import multiprocessing
import os
import socket
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from urllib.parse import urlsplit

import pytest

import aioros1
from aioros1.msg.std_msgs import String
from aioros1.srv.std_srvs import SetBool

from .peers import caller_header, dialled, flip_answer, flip_request, subscriber_header, until

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="needs fork")


@contextlib.contextmanager
def forked() -> Iterator[int]:
    """A child that has every descriptor this process has now, until the end of the block."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(writing)
        os.read(reading, 1)  # until the parent closes it, or ends
        os._exit(0)
    os.close(reading)
    try:
        yield child
    finally:
        os.close(writing)
        os.waitpid(child, 0)


def refuses(host: str, port: int) -> bool:
    with socket.socket() as sock:
        sock.settimeout(30)
        return sock.connect_ex((host, port)) != 0


def ports(node: aioros1.Node) -> list[tuple[str, int]]:
    slave = urlsplit(node.uri)
    assert slave.hostname is not None
    assert slave.port is not None
    return [node.tcpros_address, (slave.hostname, slave.port)]


async def test_closing_a_node_ends_its_ports_and_connections(make_node):
    node = await make_node("talker")
    await node.advertise("chatter", String)
    await node.advertise_service("flip", SetBool, lambda request: {"success": request.data})
    async with (
        dialled(node, subscriber_header()) as subscriber,
        dialled(node, caller_header(persistent="1"), flip_request(True)) as caller,
        dialled(node, b"\x20\x00") as silent,
    ):
        slave = await asyncio.open_connection(*ports(node)[1])
        await subscriber.read_header()
        await caller.read_header()
        assert await caller.answer() == (1, flip_answer(True)[5:])
        with forked():
            await node.close()
            for host, port in ports(node):
                assert refuses(host, port)
            for wire in (subscriber, caller, silent):
                assert await wire.is_closed()
            assert await slave[0].read() == b""
        slave[1].close()


@pytest.mark.parametrize("transport", ["tcp", "unix"])
async def test_closing_roles_ends_their_connections(make_node, transport):
    local = [] if transport == "tcp" else ["unix"]
    here, there = [await make_node(name, local_transports=local) for name in ("here", "there")]
    pub = await here.advertise("chatter", String)
    sub = await there.subscribe("chatter", String)
    provider = await here.advertise_service("flip", SetBool, lambda request: {})
    caller = await there.service_caller("flip", SetBool, persistent=True)
    await pub.wait_for_subscribers(timeout=30)
    await caller.call(data=True, timeout=30)
    with forked():
        await sub.close()
        await until(lambda: not pub.subscriber_count)
        await caller.close()
        await until(lambda: not provider.connections)
        again = await there.subscribe("chatter", String)
        await pub.wait_for_subscribers(timeout=30)
        with forked():
            await pub.close()
            await until(lambda: not again.publisher_count)


async def test_what_was_published_before_the_end_arrives(make_node):
    here, there = await make_node("here"), await make_node("there")
    pub = await here.advertise("chatter", String, queue_size=100)
    sub = await there.subscribe("chatter", String, queue_size=100)
    await pub.wait_for_subscribers(timeout=30)
    with forked():
        for number in range(50):
            pub.publish(data=f"{number}" + "x" * 200_000)
        await pub.close()
        texts = [(await sub.get(timeout=30)).data.rstrip("x") for _ in range(50)]
    assert texts == [f"{number}" for number in range(50)]


async def test_closing_a_master_ends_its_port_and_connections():
    master = aioros1.Master("127.0.0.1", port=0, rosout=False)
    await master.start()
    port = master.port
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    await until(lambda: master.stats.connections == 1)
    with forked():
        await master.close()
        assert refuses("127.0.0.1", port)
        assert await reader.read() == b""
        # And another can take its place.
        async with aioros1.Master("127.0.0.1", port=port, rosout=False):
            pass
    writer.close()


async def test_a_request_that_is_cancelled_ends_its_connection(make_node, make_publisher):
    """The connections that a node makes, too: a server counts them until they end."""
    node = await make_node("node")
    begun, ended = asyncio.Event(), asyncio.Event()

    async def serve(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        while await reader.read(1000):
            begun.set()
        ended.set()
        writer.close()

    server = await asyncio.start_server(serve, "127.0.0.1", 0)
    uri = f"http://127.0.0.1:{server.sockets[0].getsockname()[1]}/"
    fake = await make_publisher(register=False)
    await fake.master.register_publisher("/chatter", "std_msgs/String", uri)
    sub = await node.subscribe("chatter", String)
    await begun.wait()
    with forked():
        await sub.close()
        await node.close()
        async with asyncio.timeout(30):
            await ended.wait()
    server.close()


async def test_a_pool_of_workers_does_not_keep_a_node_alive(make_node):
    node = await make_node("talker")
    await node.advertise("chatter", String)
    async with dialled(node, subscriber_header()) as wire:
        await wire.read_header()
        with ProcessPoolExecutor(1, multiprocessing.get_context("fork")) as pool:
            worker = pool.submit(os.getpid).result(30)
            await node.close()
            assert await wire.is_closed()
            assert all(refuses(host, port) for host, port in ports(node))
            assert worker != os.getpid()
