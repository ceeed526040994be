"""Services that are seen and called without their type being known in advance."""

from __future__ import annotations

import asyncio
import contextlib
import struct
from collections.abc import AsyncIterator

import pytest

import aioros1
from aioros1.srv.std_srvs import SetBool, Trigger


def flip(request):
    return {"success": request.data, "message": "flipped"}


async def test_call_needs_no_type(make_node):
    node = await make_node("client", namespace="robot")
    async with (await make_node("server")).advertise_service("/robot/flip", SetBool, flip):
        assert await node.service_type("flip") == "std_srvs/SetBool"
        for arguments in [("flip",), ("/robot/flip", "*")]:
            reply = await node.call(*arguments, data=True, timeout=30)
            assert isinstance(reply, SetBool.Response)
            assert (reply.success, reply.message) == (True, "flipped")
        assert not (await node.call("flip", "*", {"data": False}, timeout=30)).success
        assert (await node.call("flip", "*", SetBool.Request(data=True), timeout=30)).success


@pytest.mark.parametrize("persistent", [False, True])
async def test_a_caller_takes_the_type_of_the_provider(make_node, persistent):
    node = await make_node()
    async with (
        node.advertise_service("flip", SetBool, flip) as provider,
        node.service_caller("flip", persistent=persistent, timeout=30) as caller,
    ):
        assert provider.stats.messages == 0  # a question is no call
        assert (caller.type, caller.md5sum) == (SetBool._type, SetBool._md5sum)
        assert caller.request(data=True) == SetBool.Request(data=True)
        assert [(await caller(data=data)).success for data in (True, False)] == [True, False]
        with pytest.raises(AttributeError, match="colour"):
            await caller(colour=3)


async def test_definitions_of_the_nodes_own_store(master):
    store = aioros1.MessageStore()
    store.add_text("arm_srvs/Grip", "float32 force\n---\nbool done")
    async with (
        aioros1.Node("arm", master_uri=master.uri, host="localhost", store=store) as node,
        node.advertise_service("grip", "arm_srvs/Grip", lambda request: {"done": True}),
    ):
        assert (await node.call("grip", force=0.5, timeout=30)).done


async def test_a_definition_that_is_not_here(make_node, tmp_path):
    store = aioros1.MessageStore()
    store.add_text("arm_srvs/Grip", "float32 force\n---\nbool done")
    server = await make_node("arm", store=store)
    client = await make_node("client", store=aioros1.MessageStore([tmp_path]))
    async with server.advertise_service("grip", "arm_srvs/Grip", lambda request: None):
        assert await client.service_type("grip") == "arm_srvs/Grip"
        with pytest.raises(aioros1.MessageNotFoundError) as caught:
            await client.call("grip", force=0.5, timeout=30)
        for part in ("service /grip of /arm", "arm_srvs/Grip", "searched", str(tmp_path)):
            assert part in str(caught.value)


async def test_another_definition_than_the_providers(make_node):
    ours, theirs = aioros1.MessageStore(), aioros1.MessageStore()
    ours.add_text("arm_srvs/Grip", "float64 force\n---\nbool done")
    theirs.add_text("arm_srvs/Grip", "float32 force\n---\nbool done")
    server, client = await make_node("arm", store=theirs), await make_node("client", store=ours)
    async with server.advertise_service("grip", "arm_srvs/Grip", lambda request: None):
        with pytest.raises(aioros1.Md5MismatchError) as caught:
            await client.service_caller("grip")
        for store in (ours, theirs):
            assert store.load_srv("arm_srvs/Grip")._md5sum in str(caught.value)
        assert "service /grip of /arm has type arm_srvs/Grip" in str(caught.value)


async def test_no_provider(make_node):
    node = await make_node()
    for ask in (node.service_type("nobody"), node.call("nobody", timeout=30)):
        with pytest.raises(aioros1.ServiceNotFound, match="/nobody"):
            await ask
    with pytest.raises(aioros1.InvalidNameError, match="'a b'"):
        await node.service_type("a b")


async def test_a_provider_of_another_type_comes_after(make_node):
    """A caller keeps the type that it was opened with."""
    node = await make_node()
    async with node.advertise_service("flip", SetBool, flip):
        caller = await node.service_caller("flip", timeout=30)
    async with node.advertise_service("flip", Trigger, lambda request: {"message": "new"}):
        with pytest.raises(aioros1.HandshakeError, match="md5sum"):
            await caller(data=True)
        assert (await node.call("flip", timeout=30)).message == "new"


# --------------------------------------------------------------------------- strange providers


@contextlib.asynccontextmanager
async def provider_that_says(node: aioros1.Node, *rows: str | None) -> AsyncIterator[asyncio.Event]:
    """A registered provider that answers every header with ``rows``, or not at all.

    The event is set once the first header is there.
    """
    held: set[asyncio.StreamWriter] = set()
    asked = asyncio.Event()

    async def answer(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        held.add(writer)
        (length,) = struct.unpack("<I", await reader.readexactly(4))
        await reader.readexactly(length)
        asked.set()
        if rows != (None,):
            fields = [str(row).encode() for row in rows]
            body = b"".join(struct.pack("<I", len(field)) + field for field in fields)
            writer.write(struct.pack("<I", len(body)) + body)

    server = await asyncio.start_server(answer, "127.0.0.1", 0)
    uri = f"rosrpc://127.0.0.1:{server.sockets[0].getsockname()[1]}"
    await node.master.register_service("/odd", uri, node.uri)
    try:
        yield asked
    finally:
        server.close()
        for writer in held:
            writer.close()
        await server.wait_closed()


@pytest.mark.parametrize("type", ["", "*", "SetBool", "a/b/c", "../../etc/passwd", "a b/C"])
async def test_what_is_no_type(make_node, type):
    node = await make_node()
    async with provider_that_says(node, "callerid=/strange", f"type={type}", "md5sum=*"):
        for ask in (node.service_type("odd"), node.call("odd", timeout=30)):
            with pytest.raises(aioros1.HandshakeError) as caught:
                await ask
            assert "/odd of /strange: expected its type as package/Type" in str(caught.value)
            assert repr(type) in str(caught.value)


async def test_a_provider_that_refuses(make_node):
    node = await make_node()
    async with provider_that_says(node, "error=go away"):
        with pytest.raises(aioros1.HandshakeError, match="go away"):
            await node.service_type("odd")


async def test_the_timeout_covers_the_question_for_the_type(make_node):
    node = await make_node(timeouts=aioros1.Timeouts(handshake=60))
    async with provider_that_says(node, None):
        with pytest.raises(TimeoutError, match=r"/odd: no answer within 0\.05 s"):
            await node.call("odd", timeout=0.05)
        with pytest.raises(TimeoutError, match=r"/odd: no answer within 0\.05 s"):
            await node.service_caller("odd", timeout=0.05)


@pytest.mark.parametrize("ask", ["service_type", "call", "service_caller", "is_available"])
async def test_closing_the_node_ends_the_question(make_node, ask):
    node = await make_node(timeouts=aioros1.Timeouts(handshake=60))
    other = await make_node("other")
    async with provider_that_says(other, None) as asked:
        if ask == "is_available":
            asking = (await node.service_caller("odd", SetBool)).is_available()
        else:
            asking = getattr(node, ask)("odd")

        async def wait() -> object:
            return await asking

        task = asyncio.create_task(wait())
        async with asyncio.timeout(30):
            await asked.wait()
            await node.close()
            with pytest.raises(aioros1.ClosedError):
                await task
