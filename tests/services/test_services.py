"""Services without a handler: calls that are answered when their time has come."""

from __future__ import annotations

import asyncio

import pytest

import aioros1
from aioros1.srv.roscpp_tutorials import TwoInts
from aioros1.srv.std_srvs import SetBool


async def test_calls_are_answered_in_any_order(make_node):
    node = await make_node()
    async with node.advertise_service("add", TwoInts) as provider:
        calling = [
            asyncio.create_task(node.call("add", TwoInts, a=number, b=0)) for number in range(5)
        ]
        calls = [await anext(provider) for _ in range(5)]
        assert {call.caller_id for call in calls} == {"/node"}
        for call in reversed(calls):
            await call.reply(sum=10 * call.request.a)
        assert [reply.sum for reply in await asyncio.gather(*calling)] == [0, 10, 20, 30, 40]


async def test_a_call_is_failed_with_a_reason_and_answered_once(make_node):
    node = await make_node()
    async with node.advertise_service("flip", SetBool) as provider:
        calling = asyncio.create_task(node.call("flip", SetBool, data=True))
        call = await anext(provider)
        with pytest.raises(aioros1.SerializationError):
            await call.reply(message=5)
        await call.fail("the switch is stuck")
        with pytest.raises(RuntimeError, match="answered already"):
            await call.reply(success=True)
        with pytest.raises(aioros1.ServiceError, match="the switch is stuck"):
            await calling


async def test_calls_that_wait_when_the_provider_closes_fail_on_both_sides(make_node):
    node = await make_node()
    provider = await node.advertise_service("flip", SetBool)
    calling = asyncio.create_task(node.call("flip", SetBool, data=True))
    call = await anext(provider)
    await provider.close()
    with pytest.raises(aioros1.ServiceError, match="shut down"):
        await calling
    with pytest.raises(aioros1.ClosedError, match="/flip"):
        await call.reply(success=True)


async def test_no_more_calls_are_worked_on_than_wanted(make_node):
    node = await make_node()
    running: list[int] = []
    most = 0

    async def handler(request):
        nonlocal most
        running.append(request.a)
        most = max(most, len(running))
        await asyncio.sleep(0)
        await node.get_param_names()  # something that takes a few turns of the loop
        running.remove(request.a)
        return {"sum": request.a}

    async with node.advertise_service("add", TwoInts, handler, max_concurrency=2):
        calls = [node.call("add", TwoInts, a=number, b=0, timeout=10) for number in range(10)]
        replies = await asyncio.gather(*calls)
    assert [reply.sum for reply in replies] == list(range(10))
    assert most == 2


async def test_one_name_is_provided_once_by_a_node(make_node):
    node = await make_node()
    async with node.advertise_service("flip", SetBool, lambda request: None):
        with pytest.raises(ValueError, match="provides service /flip already"):
            await node.advertise_service("flip", SetBool, lambda request: None)
    async with node.advertise_service("flip", SetBool, lambda request: {"success": True}):
        assert (await node.call("flip", SetBool, data=True, timeout=30)).success


async def test_a_persistent_caller_finds_a_provider_that_was_restarted(make_node):
    node, other = await make_node(), await make_node("other")
    async with node.service_caller("flip", SetBool, persistent=True, timeout=30) as caller:
        async with node.advertise_service("flip", SetBool, lambda request: {"message": "old"}):
            assert (await caller.call(data=True)).message == "old"
        with pytest.raises(aioros1.ServiceNotFound):
            await caller.call(data=True)
        async with other.advertise_service("flip", SetBool, lambda request: {"message": "new"}):
            await caller.wait_for_service(timeout=30)
            assert (await caller(data=True)).message == "new"
            assert caller.provider_uri == other.tcpros_uri


async def test_an_idle_caller_notices_that_its_provider_is_gone(make_node):
    node, other = await make_node(), await make_node("other")
    async with node.service_caller("flip", SetBool, persistent=True, timeout=30) as caller:
        async with other.advertise_service("flip", SetBool, lambda request: {"success": True}):
            await caller.call(data=True)
            (connection,) = caller.connections
            events = node.events()
        async with asyncio.timeout(30):
            async for event in events:
                if isinstance(event, aioros1.PeerDisconnected):
                    break
        assert (event.kind, event.connection) == ("service caller", connection)
        assert caller.connections == ()
        async with other.advertise_service("flip", SetBool, lambda request: {"success": True}):
            assert (await caller.call(data=True)).success
