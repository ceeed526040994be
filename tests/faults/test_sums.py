"""What many connections hold together, each within its limits."""

from __future__ import annotations

import asyncio
import contextlib
import gzip
import struct
import tracemalloc
from urllib.parse import urlsplit

import pytest

import aioros1
from aioros1.msg.std_msgs import String
from aioros1.srv.std_srvs import SetBool

from .peers import Wire, caller_header, dialled, flip_request, header, subscriber_header, until

MB = 1 << 20
LIMITS = aioros1.Limits(bytes_in_flight=4 * MB, kept_header_bytes=MB)


@pytest.fixture
async def node(make_node):
    node = await make_node("talker", limits=LIMITS)
    await node.advertise("chatter", String)
    await node.advertise_service("flip", SetBool, lambda request: {"success": True})
    return node


@contextlib.asynccontextmanager
async def asked(uri: str, *parts: bytes):
    address = urlsplit(uri)
    wire = Wire(*await asyncio.open_connection(address.hostname, address.port))
    try:
        with contextlib.suppress(ConnectionError):
            await wire.send(*parts)
        yield wire
    finally:
        wire.abort()
        await wire.close()


def call(method: str, *params: str) -> bytes:
    values = "".join(f"<param><value>{each}</value></param>" for each in params)
    name = f"<methodName>{method}</methodName>"
    return f"<methodCall>{name}<params>{values}</params></methodCall>".encode()


def post(body: bytes, *fields: str, length: int | None = None) -> bytes:
    length = len(body) if length is None else length
    head = ["POST / HTTP/1.1", "Host: x", f"Content-Length: {length}", *fields, "", ""]
    return "\r\n".join(head).encode() + body


async def test_headers_that_never_end_are_bounded_in_sum(node, bystander_of):
    bystander = await bystander_of(node)
    half = header({"callerid": "/a", "md5sum": "*", "topic": "/chatter", "x": "x" * 900_000})[:-1]
    async with contextlib.AsyncExitStack() as stack:
        for _ in range(10):
            await stack.enter_async_context(dialled(node, half))
        await until(lambda: node.stats.connections_cut)
        assert node.stats.bytes_in_flight <= 4 * MB
        assert await bystander.is_served()
        # One with a header of the same size is served, too.
        definition = {"message_definition": "x" * 900_000}
        async with dialled(node, subscriber_header(**definition)) as wire:
            assert (await wire.read_header())["topic"] == "/chatter"
    await until(lambda: node.stats.bytes_in_flight == 0)


async def test_headers_that_are_kept_are_bounded_in_sum(node):
    async with contextlib.AsyncExitStack() as stack:
        for _ in range(10):
            definition = {"message_definition": "x" * 300_000, "tcp_nodelay": "1"}
            wire = await stack.enter_async_context(dialled(node, subscriber_header(**definition)))
            await wire.read_header()
        await until(lambda: node.stats.connections == 10)
        headers = [info.header for info in node.connections]
        assert sum(len(text) for each in headers for text in each.values()) < 2 * MB
        assert "message_definition" in headers[0]
        assert {"callerid", "topic", "md5sum", "type", "tcp_nodelay"} == set(headers[-1])


@pytest.mark.parametrize("field", ["callerid", "topic", "type"])
async def test_a_name_without_end_is_refused(node, field):
    async with dialled(node, subscriber_header(**{field: "/" + "x" * 100_000})) as wire:
        assert (await wire.read_header())["error"].endswith(
            f"the {field} has more than 1024 characters"
        )
        assert await wire.is_closed()


async def test_service_requests_that_never_end_are_bounded_in_sum(node, bystander_of):
    bystander = await bystander_of(node)
    half = [caller_header(persistent="1"), struct.pack("<I", 100 * MB), b"x" * MB]
    async with contextlib.AsyncExitStack() as stack:
        for _ in range(10):
            await stack.enter_async_context(dialled(node, *half))
        await until(lambda: node.stats.connections_cut)
        assert node.stats.bytes_in_flight <= 4 * MB
        assert await bystander.is_served()
    await until(lambda: node.stats.bytes_in_flight == 0)


async def test_what_was_answered_no_longer_counts(node):
    async with dialled(node, caller_header(persistent="1")) as wire:
        await wire.read_header()
        for _ in range(3):
            request = b"\x01" + b"x" * 500_000
            await wire.send(struct.pack("<I", len(request)), request)
            assert (await wire.answer())[0] == 1
            await wire.send(flip_request(True))
            assert (await wire.answer())[0] == 1
            await until(lambda: node.stats.bytes_in_flight == 0)


@pytest.fixture
async def narrow():
    async with aioros1.Master("127.0.0.1", port=0, rosout=False, limits=LIMITS) as master:
        yield master


async def test_bodies_that_never_end_are_bounded_in_sum(narrow, make_node):
    node = await make_node("node", master_uri=narrow.uri)
    half = post(b"x" * MB, length=10 * MB)
    async with contextlib.AsyncExitStack() as stack:
        for _ in range(10):
            await stack.enter_async_context(asked(narrow.uri, half))
        await until(lambda: narrow.stats.connections_cut)
        assert narrow.stats.bytes_in_flight <= 4 * MB
        await node.set_param("p", "x" * 2 * MB)
        assert await node.get_param("p") == "x" * 2 * MB
    await until(lambda: narrow.stats.bytes_in_flight == 0)


async def test_bodies_that_are_unpacked_are_bounded_in_sum(narrow, make_node):
    """They are waited for, so that what was unpacked stays."""
    node = await make_node("node", master_uri=narrow.uri)
    body = gzip.compress(b" " * 3 * MB + b"x" * 100)[:-10]
    async with contextlib.AsyncExitStack() as stack:
        for _ in range(5):
            request = post(body, "Content-Encoding: gzip", length=len(body) + 1)
            await stack.enter_async_context(asked(narrow.uri, request))
        await until(lambda: narrow.stats.connections_cut)
        assert narrow.stats.bytes_in_flight <= 4 * MB
        assert not await node.has_param("p")


@pytest.mark.parametrize("more", [b"x", b"x" * 5 * MB, gzip.compress(b"x")], ids=len)
async def test_nothing_may_follow_gzip_data(narrow, more):
    body = gzip.compress(call("getPid", "/a")) + more
    async with asked(narrow.uri, post(body, "Content-Encoding: gzip")) as wire:
        with contextlib.suppress(ConnectionError):
            assert (await wire.take(12)).endswith(b"400")


async def test_answers_that_nobody_reads_take_no_memory(make_node):
    async with aioros1.Master("127.0.0.1", port=0, rosout=False) as master:
        node = await make_node("node", master_uri=master.uri)
        await node.set_param("p", "x" * 8 * MB)
        async with contextlib.AsyncExitStack() as stack:
            for _ in range(5):
                wire = await stack.enter_async_context(asked(master.uri))
                wire.pause()
                await wire.send(post(call("getParam", "/a", "/p")))
            await until(lambda: master.stats.bytes_in_flight >= 5 * 7 * MB)
            unsent = sum(
                each.transport.get_write_buffer_size()
                for each in master._server._connections
                if each.transport is not None
            )
            assert unsent < 5 * MB
            assert await node.get_param("p") == "x" * 8 * MB
        await until(lambda: master.stats.bytes_in_flight == 0)


async def test_a_large_message_is_kept_once_for_all_who_do_not_read_it(make_node):
    node = await make_node("talker")
    body = bytes(range(256)) * (256 << 10)  # 64 MB
    publisher = await node.advertise("large", "std_msgs/UInt8MultiArray", latch=True)
    publisher.publish(data=body)
    tracemalloc.start()
    try:
        async with contextlib.AsyncExitStack() as stack:
            before, _ = tracemalloc.get_traced_memory()
            wires = []
            for _ in range(8):
                wire = await stack.enter_async_context(dialled(node))
                wire.pause()
                await wire.send(subscriber_header("/large", type="*", md5sum="*"))
                wires.append(wire)
            await publisher.wait_for_subscribers(8, timeout=10)
            now, _ = tracemalloc.get_traced_memory()
            assert now - before < 64 * MB  # a few of its own for each
            # Whoever reads gets all of it, and what comes behind it.
            publisher.publish(data=b"end")
            wires[3].resume()
            await wires[3].read_header()
            is_whole = (await wires[3].frame())[12:] == body
            assert is_whole
            assert (await wires[3].frame()).endswith(b"end")
    finally:
        tracemalloc.stop()
