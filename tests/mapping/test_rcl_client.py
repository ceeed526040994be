"""rcl/client.h: service callers."""

from __future__ import annotations

import asyncio
import dataclasses

import pytest

import aioros1
from aioros1.services.caller import ServiceCallerOptions
from aioros1.srv.roscpp_tutorials import TwoInts


@pytest.fixture
async def client(pair):
    """A node; another one provides ``/add``."""
    server, client = pair
    await server.advertise_service("add", TwoInts, lambda request: {"sum": request.a + request.b})
    return client


async def test_rcl_client_t(client):
    async with client.service_caller("add", TwoInts) as caller:
        assert isinstance(caller, aioros1.ServiceCaller)
        assert caller in client.roles


async def test_rcl_client_options_t(client):
    async with client.service_caller(
        "add", TwoInts, persistent=True, timeout=30, tcp_nodelay=False
    ) as caller:
        assert caller.options == ServiceCallerOptions(
            persistent=True, timeout=30, tcp_nodelay=False
        )
        with pytest.raises(dataclasses.FrozenInstanceError):
            caller.options.timeout = 1


async def test_rcl_get_zero_initialized_client(client):
    """A caller on its way is not open yet, and has done nothing."""
    opening = client.service_caller("add", TwoInts)
    assert client.roles == ()
    async with opening as caller:
        assert caller.is_open
        assert client.roles == (caller,)


@pytest.mark.parametrize("type", [TwoInts, "roscpp_tutorials/TwoInts"], ids=["class", "name"])
async def test_rcl_client_init(client, type):
    async with client.service_caller("add", type) as caller:
        assert (await caller.call(a=1, b=2, timeout=30)).sum == 3


async def test_rcl_client_init_with_a_name_or_a_type_that_is_wrong(client):
    with pytest.raises(aioros1.InvalidNameError):
        await client.service_caller("not a name", TwoInts)
    with pytest.raises(aioros1.MessageNotFoundError):
        await client.service_caller("add", "roscpp_tutorials/Nothing")


async def test_rcl_client_fini(client):
    caller = await client.service_caller("add", TwoInts)
    await caller.close()
    await caller.close()
    assert not caller.is_open
    with pytest.raises(aioros1.ClosedError):
        await caller.call(a=1, b=2)
    with pytest.raises(aioros1.ClosedError):
        caller.send_request(a=1, b=2)
    assert (await client.call("add", TwoInts, a=1, b=2, timeout=30)).sum == 3


async def test_rcl_client_fini_during_a_call(pair):
    server, client = pair
    await server.advertise_service("never", TwoInts)
    caller = await client.service_caller("never", TwoInts, persistent=True)
    pending = caller.send_request(a=1, b=2)
    async with asyncio.timeout(30):
        while not caller.connections:
            await asyncio.sleep(0.001)
        await caller.close()
        with pytest.raises(aioros1.ClosedError):
            await pending


async def test_rcl_client_get_default_options(client):
    async with client.service_caller("add", TwoInts) as caller:
        assert caller.options == ServiceCallerOptions()
        assert caller.options == ServiceCallerOptions(
            persistent=False, timeout=None, tcp_nodelay=True
        )


async def test_rcl_send_request(client):
    """It returns at once, with a number that is this caller's own."""
    async with client.service_caller("add", TwoInts) as caller:
        calls = [caller.send_request(a=number, b=1) for number in range(3)]
        assert [call.sequence for call in calls] == [1, 2, 3]
        assert not any(call.done() for call in calls)
        async with asyncio.timeout(30):
            assert [(await call).sum for call in calls] == [1, 2, 3]


async def test_rcl_send_request_on_one_connection_answers_in_order(client):
    async with client.service_caller("add", TwoInts, persistent=True) as caller:
        calls = [caller.send_request(a=number, b=1) for number in range(3)]
        async with asyncio.timeout(30):
            assert [(await call).sum for call in calls] == [1, 2, 3]
        assert len(caller.connections) == 1


async def test_rcl_send_request_can_be_given_up(pair):
    server, client = pair
    provider = await server.advertise_service("never", TwoInts)
    async with client.service_caller("never", TwoInts) as caller:
        pending = caller.send_request(a=1, b=2)
        async with asyncio.timeout(30):
            await anext(provider)
            pending.cancel()
            with pytest.raises(asyncio.CancelledError):
                await pending
        assert caller.connections == ()


async def test_rcl_take_response(client):
    async with client.service_caller("add", TwoInts) as caller:
        pending = caller.send_request(TwoInts.Request(a=1, b=2), timeout=30)
        assert await pending == TwoInts.Response(sum=3)
        assert pending.done()


async def test_rcl_take_response_of_a_service_that_is_not_there(client):
    async with client.service_caller("nothing", TwoInts) as caller:
        pending = caller.send_request(a=1, b=2, timeout=30)
        with pytest.raises(aioros1.ServiceNotFound):
            await pending


async def test_rcl_client_get_service_name(make_node):
    node = await make_node("client", namespace="robot", remap={"add": "plus"})
    async with (
        node.service_caller("arm/add", TwoInts) as relative,
        node.service_caller("~add", TwoInts) as private,
        node.service_caller("add", TwoInts) as remapped,
    ):
        names = [caller.name for caller in (relative, private, remapped)]
        assert names == ["/robot/arm/add", "/robot/client/add", "/robot/plus"]


async def test_rcl_client_get_options(client):
    async with client.service_caller("add", TwoInts, persistent=True) as caller:
        assert caller.options.persistent is True


async def test_rcl_client_get_rmw_handle(client, pair):
    """What is below a caller is its connection."""
    server, _ = pair
    async with client.service_caller("add", TwoInts, persistent=True) as caller:
        await caller.call(a=1, b=2, timeout=30)
        [connection] = caller.connections
        assert (connection.transport, connection.direction) == ("TCPROS", "b")
        assert connection.peer == connection.header["callerid"] == "/talker"
        assert connection.remote[1] == server.tcpros_address[1]
        assert connection.fileno >= 0
        assert connection.stats.messages == 1


async def test_rcl_service_server_is_available(client):
    async with (
        client.service_caller("add", TwoInts) as caller,
        client.service_caller("nothing", TwoInts) as other,
    ):
        assert await caller.is_available()
        assert not await other.is_available()
        await caller.wait_for_service(timeout=30)
        with pytest.raises(TimeoutError, match="/nothing did not appear"):
            await other.wait_for_service(timeout=0.02)


async def test_rcl_service_server_is_available_once_it_is_provided(pair):
    server, client = pair
    async with client.service_caller("later", TwoInts) as caller:
        waiting = asyncio.create_task(caller.wait_for_service(timeout=30))
        await asyncio.sleep(0)
        assert not waiting.done()
        async with server.advertise_service("later", TwoInts, lambda request: None):
            await waiting
