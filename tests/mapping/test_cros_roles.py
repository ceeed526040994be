"""Registering, unregistering and releasing roles, their callbacks and their structs."""

from __future__ import annotations

import asyncio
import contextlib
import os
import socket
from urllib.parse import urlsplit

import pytest

import aioros1
from aioros1.msg.std_msgs import Int32, String
from aioros1.srv.roscpp_tutorials import TwoInts
from aioros1.srv.std_srvs import Empty, SetBool


def add(request):
    return {"sum": request.a + request.b}


# ------------------------------------------------------------------ subscribers


async def test_cRosApiRegisterSubscriber(make_node):
    node = await make_node()
    sub = await node.subscribe("chatter", "std_msgs/String")
    assert (sub.name, sub.type) == ("/chatter", "std_msgs/String")
    assert (await node.graph.snapshot()).subscribers["/chatter"] == {"/node"}


@pytest.mark.parametrize(("tcp_nodelay", "asked"), [(True, "1"), (False, "0")])
async def test_cRosApiRegisterSubscriber_takes_tcp_nodelay(pair, tcp_nodelay, asked):
    """What is asked of publishers is in the header they see."""
    talker, listener = pair
    async with (
        talker.advertise("chatter", String) as pub,
        listener.subscribe("chatter", String, tcp_nodelay=tcp_nodelay),
    ):
        await pub.wait_for_subscribers(timeout=30)
        assert pub.connections[0].header["tcp_nodelay"] == asked


async def test_SubscriberApiCallback_is_an_iteration(pair):
    talker, listener = pair
    async with (
        listener.subscribe("chatter", String) as sub,
        talker.advertise("chatter", String) as pub,
    ):
        await pub.wait_for_subscribers(timeout=30)
        for word in ("one", "two", "three"):
            pub.publish(data=word)
        heard = []
        async with asyncio.timeout(30):
            async for message in sub:
                heard.append(message.data)
                if len(heard) == 3:
                    break
        assert heard == ["one", "two", "three"]


async def test_SubscriberApiCallback_that_fails_raises_where_it_is(pair):
    talker, listener = pair
    async with (
        listener.subscribe("chatter", String) as sub,
        talker.advertise("chatter", String, latch=True) as pub,
    ):
        pub.publish(data="not a number")
        with pytest.raises(ValueError, match="not a number"):
            async for message in sub:
                int(message.data)
        pub.publish(data="7")
        assert (await sub.get(timeout=30)).data == "7"


async def test_cRosApiUnregisterSubscriber(make_node):
    node = await make_node()
    sub = await node.subscribe("chatter", String)
    await sub.close()
    assert "/chatter" not in (await node.graph.snapshot()).subscribers
    with pytest.raises(aioros1.ClosedError):
        sub.get_nowait()


async def test_cRosApiReleaseSubscriber_ends_the_iteration(make_node):
    node = await make_node()
    sub = await node.subscribe("chatter", String)

    async def listen():
        return [message async for message in sub]

    listening = asyncio.create_task(listen())
    await asyncio.sleep(0)
    await sub.close()
    assert await asyncio.wait_for(listening, 30) == []
    assert node.roles == ()


# ------------------------------------------------------------------ publishers


async def test_cRosApiRegisterPublisher(make_node):
    node = await make_node()
    pub = await node.advertise("chatter", "std_msgs/String")
    assert (pub.name, pub.type) == ("/chatter", "std_msgs/String")
    graph = await node.graph.snapshot()
    assert graph.publishers["/chatter"] == {"/node"}
    assert graph.topic_types["/chatter"] == "std_msgs/String"


async def test_PublisherApiCallback_with_loop_period_is_a_rate(pair):
    talker, listener = pair
    async with (
        listener.subscribe("count", Int32) as sub,
        talker.advertise("count", Int32) as pub,
    ):
        await pub.wait_for_subscribers(timeout=30)
        number = 0
        async with asyncio.timeout(30):
            async for _ in talker.rate(1000):
                pub.publish(data=number)
                number += 1
                if number == 3:
                    break
        assert [(await sub.get(timeout=30)).data for _ in range(3)] == [0, 1, 2]


async def test_PublisherApiCallback_with_loop_period_is_a_timer(pair):
    talker, listener = pair
    async with (
        listener.subscribe("count", Int32, queue_size=1000) as sub,
        talker.advertise("count", Int32) as pub,
    ):
        await pub.wait_for_subscribers(timeout=30)
        numbers = iter(range(1000))
        timer = talker.timer(0.001, lambda now: pub.publish(data=next(numbers)))
        try:
            assert [(await sub.get(timeout=30)).data for _ in range(3)] == [0, 1, 2]
        finally:
            timer.cancel()


async def test_PublisherApiCallback_that_fails_ends_the_node(master):
    def fail(now):
        raise ValueError("no data")

    with pytest.raises(ValueError, match="no data"):
        async with aioros1.Node("talker", master_uri=master.uri) as node, asyncio.timeout(30):
            node.timer(0.001, fail)
            await node.wait_closed()
    assert "no data" in node.close_reason


async def test_cRosApiUnregisterPublisher(make_node):
    node = await make_node()
    pub = await node.advertise("chatter", String)
    await pub.close()
    assert "/chatter" not in (await node.graph.snapshot()).publishers
    with pytest.raises(aioros1.ClosedError):
        pub.publish(data="late")


async def test_cRosApiReleasePublisher_sends_what_was_published(pair):
    talker, listener = pair
    async with listener.subscribe("chatter", String, queue_size=100) as sub:
        pub = await talker.advertise("chatter", String, queue_size=100)
        await pub.wait_for_subscribers(timeout=30)
        for number in range(50):
            pub.publish(data=str(number))
        await pub.close()
        assert [(await sub.get(timeout=30)).data for _ in range(50)] == [str(n) for n in range(50)]


# ------------------------------------------------------------------ service callers


async def test_cRosApiRegisterServiceCaller(pair):
    server, client = pair
    await server.advertise_service("add", TwoInts, add)
    caller = await client.service_caller("add", "roscpp_tutorials/TwoInts")
    assert (caller.name, caller.type) == ("/add", "roscpp_tutorials/TwoInts")
    assert (await caller.call(a=1, b=2, timeout=30)).sum == 3


async def test_cRosApiRegisterServiceCaller_says_nothing_to_the_master(recorder, make_node):
    node = await make_node("client", master_uri=recorder.uri, heartbeat=None)
    said = len(recorder.calls)
    async with node.service_caller("add", TwoInts):
        assert len(recorder.calls) == said


async def test_cRosApiRegisterServiceCaller_persistent_keeps_its_connection(pair):
    server, client = pair
    provider = await server.advertise_service("add", TwoInts, add)
    caller = await client.service_caller("add", TwoInts, persistent=True)
    await caller.call(a=1, b=2, timeout=30)
    [before] = caller.connections
    await caller.call(a=3, b=4, timeout=30)
    [after] = caller.connections
    assert before.id == after.id
    assert provider.connections[0].header["persistent"] == "1"


async def test_cRosApiRegisterServiceCaller_not_persistent_keeps_none(pair):
    server, client = pair
    await server.advertise_service("add", TwoInts, add)
    caller = await client.service_caller("add", TwoInts)
    await caller.call(a=1, b=2, timeout=30)
    assert caller.connections == ()


@pytest.mark.parametrize("tcp_nodelay", [True, False])
async def test_cRosApiRegisterServiceCaller_takes_tcp_nodelay(pair, tcp_nodelay):
    """It is a matter of the caller's own socket. The header has what that of rospy has."""
    server, client = pair
    provider = await server.advertise_service("add", TwoInts)
    async with client.service_caller(
        "add", TwoInts, persistent=True, tcp_nodelay=tcp_nodelay
    ) as caller:
        calling = caller.send_request(a=1, b=2, timeout=30)
        pending = await asyncio.wait_for(anext(provider), 30)
        assert "tcp_nodelay" not in pending.header
        with socket.socket(fileno=os.dup(caller.connections[0].fileno)) as sock:
            assert bool(sock.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY)) == tcp_nodelay
        await pending.reply(sum=3)
        assert (await calling).sum == 3


async def test_ServiceCallerApiCallback_is_an_awaited_call_in_a_loop(pair):
    """The two phases of the callback are what comes before and after ``await``."""
    server, client = pair
    await server.advertise_service("add", TwoInts, add)
    caller = await client.service_caller("add", TwoInts, persistent=True)
    total = 0
    async with asyncio.timeout(30):
        async for _ in client.rate(1000):
            total = (await caller.call(a=total, b=1)).sum
            if total == 3:
                break
    assert total == 3


async def test_cRosApiReleaseServiceCaller(pair):
    server, client = pair
    await server.advertise_service("add", TwoInts, add)
    caller = await client.service_caller("add", TwoInts, persistent=True)
    await caller.call(a=1, b=2, timeout=30)
    await caller.close()
    assert caller.connections == ()
    with pytest.raises(aioros1.ClosedError):
        await caller.call(a=1, b=2)


# ------------------------------------------------------------------ service providers


async def test_cRosApiRegisterServiceProvider(pair):
    server, client = pair
    provider = await server.advertise_service("add", "roscpp_tutorials/TwoInts", add)
    assert (await client.graph.snapshot()).services["/add"] == {"/talker"}
    assert await client.master.lookup_service("/add") == provider.uri


@pytest.mark.parametrize("kind", ["function", "coroutine function"])
async def test_ServiceProviderApiCallback(pair, kind):
    async def add_later(request):
        await asyncio.sleep(0)
        return TwoInts.Response(sum=request.a + request.b)

    server, client = pair
    handler = add if kind == "function" else add_later
    await server.advertise_service("add", TwoInts, handler)
    assert (await client.call("add", TwoInts, a=2, b=3, timeout=30)).sum == 5


async def test_ServiceProviderApiCallback_may_return_nothing(pair):
    server, client = pair
    asked = []
    await server.advertise_service("flip", SetBool, asked.append)
    assert await client.call("flip", SetBool, data=True, timeout=30) == SetBool.Response()
    assert asked == [SetBool.Request(data=True)]


async def test_ServiceProviderApiCallback_that_fails_says_why(pair):
    """cROS returns 1 and cannot say more; here the caller gets the text."""

    async def refuse(request):
        raise aioros1.ServiceError("the gripper is open")

    server, client = pair
    await server.advertise_service("flip", SetBool, refuse)
    with pytest.raises(aioros1.ServiceError, match=r"^the gripper is open$"):
        await client.call("flip", SetBool, data=True, timeout=30)


async def test_ServiceProviderApiCallback_is_not_needed(pair):
    server, client = pair
    async with server.advertise_service("add", TwoInts) as provider:
        calls = [asyncio.create_task(client.call("add", TwoInts, a=n, b=1)) for n in (1, 2)]
        async with asyncio.timeout(30):
            first, second = await anext(provider), await anext(provider)
            assert first.caller_id == "/listener"
            await second.reply(sum=second.request.a + 1)
            await first.fail("too late")
            results = await asyncio.gather(*calls, return_exceptions=True)
        assert {type(result) for result in results} == {TwoInts.Response, aioros1.ServiceError}


async def test_cRosApiUnregisterServiceProvider(pair):
    server, client = pair
    provider = await server.advertise_service("add", TwoInts, add)
    await provider.close()
    assert "/add" not in (await client.graph.snapshot()).services
    with pytest.raises(aioros1.ServiceNotFound):
        await client.call("add", TwoInts, a=1, b=2, timeout=30)


async def test_cRosApiReleaseServiceProvider_ends_the_iteration(make_node):
    node = await make_node()
    provider = await node.advertise_service("add", TwoInts)

    async def serve():
        return [call async for call in provider]

    serving = asyncio.create_task(serve())
    await asyncio.sleep(0)
    await provider.close()
    assert await asyncio.wait_for(serving, 30) == []
    assert node.roles == ()


# ------------------------------------------------------------------ parameters


async def test_cRosApiSubscribeParam(pair):
    setter, follower = pair
    async with follower.subscribe_param("gains") as psub, asyncio.timeout(30):
        await setter.set_param("gains", {"p": 1.0})
        update = await anext(psub)
        assert (update.key, update.value) == ("/gains", {"p": 1.0})
        await setter.set_param("gains/d", 2.0)
        update = await anext(psub)
        assert (update.key, update.value) == ("/gains/d", 2.0)
        assert psub.value == {"p": 1.0, "d": 2.0}


async def test_cRosApiSubscribeParam_knows_the_value_at_once(pair):
    setter, follower = pair
    await setter.set_param("rate", 10)
    async with follower.subscribe_param("rate") as psub:
        assert psub.value == 10


async def test_cRosApiSubscribeParam_default(make_node):
    node = await make_node()
    async with node.subscribe_param("rate", default=5) as psub:
        assert psub.value == 5
    async with node.subscribe_param("rate") as psub:
        with pytest.raises(KeyError, match="/rate"):
            psub.value  # noqa: B018 - the reading of it is what fails


async def test_cRosApiUnsubscribeParam(recorder, make_node):
    node = await make_node("follower", master_uri=recorder.uri)
    psub = await node.subscribe_param("rate", default=1)
    assert recorder.calls[-1] == ("subscribeParam", "/follower", node.uri, "/rate")
    await psub.close()
    assert recorder.calls[-1] == ("unsubscribeParam", "/follower", node.uri, "/rate")
    assert not psub.is_open
    assert [update async for update in psub] == []


# ------------------------------------------------------------------ NodeStatusApiCallback


async def test_NodeStatusApiCallback_is_an_iteration_of_events(make_node):
    node = await make_node()
    events = node.events()
    async with node.advertise("chatter", String):
        pass
    await node.close()
    assert [event async for event in events] == [
        aioros1.RoleRegistered("publisher", "/chatter"),
        aioros1.RoleUnregistered("publisher", "/chatter"),
    ]


@pytest.mark.parametrize(
    ("open_role", "kind", "name"),
    [
        (lambda node: node.advertise("x", String), "publisher", "/x"),
        (lambda node: node.subscribe("x", String), "subscriber", "/x"),
        (lambda node: node.advertise_service("x", Empty, lambda _: None), "service", "/x"),
        (lambda node: node.subscribe_param("x"), "parameter", "/x"),
    ],
    ids=[
        "PUBLISHER_UNREGISTERED",
        "SUBSCRIBER_UNREGISTERED",
        "SERVICE_PROVIDER_UNREGISTERED",
        "PARAM_SUBSCRIBED-PARAM_UNSUBSCRIBED",
    ],
)
async def test_CrosNodeStatus(make_node, open_role, kind, name):
    node = await make_node()
    events = node.events()
    async with asyncio.timeout(30):
        async with open_role(node):
            assert await anext(events) == aioros1.RoleRegistered(kind, name)
        assert await anext(events) == aioros1.RoleUnregistered(kind, name)


async def test_CrosNodeStatus_PARAM_UPDATE(pair):
    setter, follower = pair
    async with follower.subscribe_param("rate", default=0), asyncio.timeout(30):
        events = follower.events()
        await setter.set_param("rate", 10)
        assert await anext(events) == aioros1.ParamUpdate("/rate", 10)


async def test_CrosNodeStatusUsr_state_is_the_class_of_the_event(make_node):
    node = await make_node()
    events = node.events()
    async with node.advertise("x", String):
        match await anext(events):
            case aioros1.RoleRegistered(kind="publisher", name=name):
                assert name == "/x"
            case other:
                pytest.fail(f"{other!r}")


async def test_CrosNodeStatusUsr_parameter_key_and_parameter_value(make_node):
    node = await make_node()
    async with node.subscribe_param("gains", default={}), asyncio.timeout(30):
        events = node.events()
        await node.set_param("gains/p", [1, 2])
        event = await anext(events)
        assert (event.key, event.value) == ("/gains/p", [1, 2])


async def test_CrosNodeStatusUsr_xmlrpc_host_and_xmlrpc_port_are_the_peer(pair):
    """A subscriber knows its publisher by the URI of its node."""
    talker, listener = pair
    events = listener.events()
    async with (
        talker.advertise("chatter", String),
        listener.subscribe("chatter", String) as sub,
        asyncio.timeout(30),
    ):
        await sub.wait_for_publishers()
        connected = [await anext(events) for _ in range(2)][-1]
        assert isinstance(connected, aioros1.PeerConnected)
        assert (connected.kind, connected.name) == ("subscriber", "/chatter")
        assert urlsplit(connected.connection.peer).port == urlsplit(talker.uri).port


async def test_CrosNodeStatusUsr_provider_idx_is_the_name_of_the_role(pair):
    talker, listener = pair
    async with talker.advertise("chatter", String) as pub, asyncio.timeout(30):
        events = talker.events()
        async with listener.subscribe("chatter", String):
            connected = await anext(events)
            assert connected == aioros1.PeerConnected("publisher", "/chatter", pub.connections[0])
            assert connected.connection.peer == "/listener"
        gone = await anext(events)
        assert isinstance(gone, aioros1.PeerDisconnected)
        assert gone.connection == connected.connection


# ------------------------------------------------------------------ the structs


@pytest.fixture
async def roles(pair):
    """One role of each kind by the name of its struct, all of them connected."""
    talker, listener = pair
    async with contextlib.AsyncExitStack() as stack:
        enter = stack.enter_async_context
        pub = await enter(talker.advertise("chatter", String, queue_size=3, tcp_nodelay=True))
        sub = await enter(listener.subscribe("chatter", String, queue_size=4))
        provider = await enter(talker.advertise_service("add", TwoInts, add, max_concurrency=2))
        caller = await enter(listener.service_caller("add", TwoInts, persistent=True))
        param = await enter(listener.subscribe_param("rate", default=1))
        await pub.wait_for_subscribers(timeout=30)
        await sub.wait_for_publishers(timeout=30)
        await caller.call(a=1, b=2, timeout=30)
        yield {
            "PublisherNode": pub,
            "SubscriberNode": sub,
            "ServiceProviderNode": provider,
            "ServiceCallerNode": caller,
            "ParameterSubscription": param,
        }


STRING_MD5 = "992ce8a1687cec8c8bd883ec73ca41d1"
TWO_INTS_MD5 = "6a2e34150c00229791cc89ff309fff21"


@pytest.mark.parametrize(
    ("struct", "name", "type", "md5sum", "definition"),
    [
        ("PublisherNode", "/chatter", "std_msgs/String", STRING_MD5, "string data"),
        ("SubscriberNode", "/chatter", "std_msgs/String", STRING_MD5, "string data"),
        ("ServiceProviderNode", "/add", "roscpp_tutorials/TwoInts", TWO_INTS_MD5, "int64 sum"),
        ("ServiceCallerNode", "/add", "roscpp_tutorials/TwoInts", TWO_INTS_MD5, "int64 sum"),
        ("ParameterSubscription", "/rate", "", "", ""),
    ],
    ids=lambda value: value if str(value).endswith(("Node", "Subscription")) else "",
)
async def test_struct_topic_name_topic_type_md5sum_and_message_definition(
    roles, struct, name, type, md5sum, definition
):
    role = roles[struct]
    assert (role.name, role.type, role.md5sum) == (name, type, md5sum)
    assert definition in role.definition


async def test_struct_options(roles):
    """tcp_nodelay, persistent and the sizes of queues are what a role was opened with."""
    assert roles["PublisherNode"].options.queue_size == 3
    assert roles["PublisherNode"].options.tcp_nodelay is True
    assert roles["SubscriberNode"].options.queue_size == 4
    assert roles["SubscriberNode"].options.tcp_nodelay is True
    assert roles["ServiceCallerNode"].options.persistent is True
    assert roles["ServiceCallerNode"].options.tcp_nodelay is True
    assert roles["ServiceProviderNode"].options.max_concurrency == 2


async def test_struct_msg_queue_and_msg_queue_overflow(roles, until):
    pub, sub = roles["PublisherNode"], roles["SubscriberNode"]
    for number in range(7):
        pub.publish(data=str(number))
    await until(lambda: sub.stats.messages == 7)
    assert (sub.queued, sub.dropped) == (4, 3)


async def test_struct_service_host_and_service_port(roles):
    caller, provider = roles["ServiceCallerNode"], roles["ServiceProviderNode"]
    assert caller.provider_uri == provider.uri
    assert urlsplit(caller.provider_uri).port == provider.node.tcpros_address[1]


async def test_struct_client_procs_are_connections(roles):
    pub, sub = roles["PublisherNode"], roles["SubscriberNode"]
    [out], [into] = pub.connections, sub.connections
    assert (out.direction, into.direction) == ("o", "i")
    assert out.remote == into.local
    provider, caller = roles["ServiceProviderNode"], roles["ServiceCallerNode"]
    assert provider.connections[0].remote == caller.connections[0].local


# ------------------------------------------------------------------ registration


async def test_registration_is_done_when_a_role_is_handed_out(pair):
    talker, listener = pair
    async with talker.advertise("chatter", String):
        assert "/chatter" in (await listener.graph.snapshot()).publishers


async def test_registration_refused_is_raised_and_leaves_nothing(make_node):
    node = await make_node()
    with pytest.raises(aioros1.MessageNotFoundError):
        await node.advertise("chatter", "no_such_msgs/Type")
    assert node.roles == ()


async def test_slot_of_a_role_is_free_after_it_was_closed(make_node):
    node = await make_node()
    for _ in range(3):
        async with node.advertise_service("add", TwoInts, add):
            assert (await node.call("add", TwoInts, a=1, b=1, timeout=30)).sum == 2
    with pytest.raises(aioros1.ServiceNotFound):
        await node.call("add", TwoInts, a=1, b=1, timeout=30)
