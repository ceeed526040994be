"""Services as serialised bytes."""

from __future__ import annotations

import asyncio

import pytest

import aioros1
from aioros1.srv.std_srvs import Empty, SetBool

REQUEST = SetBool.Request(data=True).to_bytes()
RESPONSE = SetBool.Response(success=True, message="flipped").to_bytes()


@pytest.mark.parametrize("type", ["*", SetBool, "std_srvs/SetBool"])
@pytest.mark.parametrize("is_async", [False, True])
async def test_a_raw_provider_takes_and_gives_bytes(make_node, type, is_async):
    node = await make_node()
    got = []

    def answer(request):
        got.append(request)
        return bytearray(RESPONSE)

    async def answer_later(request):
        await asyncio.sleep(0)
        return answer(request)

    handler = answer_later if is_async else answer
    async with node.advertise_service("flip", type, handler, raw=True) as provider:
        reply = await node.call("flip", SetBool, data=True, timeout=20)
        assert (reply.success, reply.message) == (True, "flipped")
        assert got == [REQUEST]
        assert provider.type == ("*" if type == "*" else "std_srvs/SetBool")
        assert provider.stats.messages == 1


@pytest.mark.parametrize("persistent", [False, True])
async def test_any_caller_can_call_with_bytes(make_node, persistent):
    node = await make_node()
    async with (
        node.advertise_service("flip", SetBool, lambda request: {"success": request.data}),
        node.service_caller("flip", SetBool, persistent=persistent, timeout=20) as caller,
    ):
        expected = SetBool.Response(success=True).to_bytes()
        assert await caller.call_raw(REQUEST) == expected
        assert await caller.call_raw(memoryview(REQUEST), timeout=20) == expected
        assert (await caller.call(data=True)).success
        with pytest.raises(aioros1.SerializationError, match=r"expected serialised bytes, got 5"):
            await caller.call_raw(5)  # type: ignore[arg-type]


async def test_a_raw_caller_needs_no_type(make_node):
    """Not even one whose definition is here."""
    store = aioros1.MessageStore()
    store.add_text("arm_srvs/Grip", "float32 force\n---\nbool done")
    server, client = await make_node("server", store=store), await make_node("client")
    async with (
        server.advertise_service("grip", "arm_srvs/Grip", lambda request: {"done": True}),
        client.service_caller("grip", raw=True, timeout=20) as caller,
    ):
        assert (caller.type, caller.md5sum, caller.service_class) == ("*", "*", None)
        assert await caller.call_raw(bytes(4)) == b"\1"
        assert await caller.call(bytes(4)) == b"\1"
        with pytest.raises(TypeError, match="a caller of any type"):
            caller.request()


async def test_calls_of_a_raw_provider_are_answered_with_bytes(make_node):
    node = await make_node()
    async with node.advertise_service("flip", "*", raw=True) as provider:
        calling = asyncio.create_task(node.call("flip", SetBool, data=True, timeout=20))
        call = await asyncio.wait_for(anext(aiter(provider)), 20)
        assert call.request == REQUEST
        with pytest.raises(aioros1.SerializationError, match="expected serialised bytes"):
            await call.reply({"success": True})
        await call.reply(RESPONSE)
        assert (await calling).message == "flipped"


async def test_nothing_is_an_empty_response(make_node):
    node = await make_node()
    async with node.advertise_service("nothing", "*", lambda request: None, raw=True):
        assert await node.call("nothing", Empty, timeout=20) == Empty.Response()


async def test_what_is_not_bytes_is_the_providers_error(make_node):
    node = await make_node()
    async with node.advertise_service("flip", "*", lambda request: {"success": True}, raw=True):
        with pytest.raises(aioros1.ServiceError, match=r"bad response: .*expected serialised"):
            await node.call("flip", SetBool, timeout=20)


async def test_a_relay_of_any_service(make_node):
    """One name for another, whatever the type: what raw services are for."""
    node = await make_node()
    async with (
        node.advertise_service("flip", SetBool, lambda request: {"success": not request.data}),
        node.service_caller("flip", raw=True, persistent=True, timeout=20) as caller,
        node.advertise_service("relayed", "*", caller.call_raw, raw=True),
    ):
        assert [
            (await node.call("relayed", SetBool, data=data, timeout=20)).success
            for data in (True, False)
        ] == [False, True]
