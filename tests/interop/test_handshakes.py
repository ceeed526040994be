"""What each side of a handshake says first: the same fields from us as from rospy and roscpp."""

from __future__ import annotations

import asyncio
import contextlib
import socket
from collections.abc import AsyncIterator, Awaitable, Callable

import pytest

import aioros1

from ..faults.peers import (
    SET_BOOL_MD5,
    FakeProvider,
    FakePublisher,
    Wire,
    caller_header,
    flip_answer,
    header,
    subscriber_header,
)
from .world import World, xmlrpc_call

STRING = "std_msgs/String"
SET_BOOL = "std_srvs/SetBool"
EMPTY = "std_msgs/Empty"

Header = dict[str, str]
Next = Callable[[], Awaitable[Header]]
each_client = pytest.mark.parametrize("client", ["rospy", "roscpp"])


@pytest.fixture
async def world(under_ours: World) -> World:
    return under_ours


def without(fields: Header, *names: str) -> Header:
    return {name: value for name, value in fields.items() if name not in names}


# Who connects


@contextlib.asynccontextmanager
async def subscribers(world: World, topic: str, type: str = STRING) -> AsyncIterator[Next]:
    """Returns the header of the next one who subscribes to a topic."""
    publisher = FakePublisher(world.uri, "/recorder", topic, type)
    await publisher.start()
    await publisher.register()

    async def following() -> Header:
        return (await publisher.greeted()).header

    try:
        yield following
    finally:
        await publisher.close()


@pytest.mark.parametrize("type", [STRING, EMPTY, "*"])
async def test_a_subscriber(world: World, type: str) -> None:
    topic = world.unique("chatter")
    async with subscribers(world, topic) as following:
        async with world.node("ours") as node, node.subscribe(topic, type, tcp_nodelay=False):
            ours = await following()
        await world.rospy_ready("listener", topic, type, "--name", "ours")
        rospy = await following()
    # rospy has a definition even where there is none.
    assert ours == (rospy if rospy["message_definition"] else without(rospy, "message_definition"))


async def test_a_subscriber_of_roscpp(world: World) -> None:
    topic = world.unique("chatter")
    async with subscribers(world, topic) as following:
        async with world.node("ours") as node, node.subscribe(topic, STRING, tcp_nodelay=False):
            ours = await following()
        await world.roscpp_ready("listener", topic, STRING, "__name:=ours")
        roscpp = await following()
    assert without(ours, "message_definition") == roscpp


@contextlib.asynccontextmanager
async def callers(world: World, service: str) -> AsyncIterator[Next]:
    """Returns the header of the next one who asks for a service, and answers as a provider."""
    provider = FakeProvider(world.uri, "/recorder", service)
    await provider.start()
    await provider.register()

    async def serve(wire: Wire) -> None:
        with contextlib.suppress(OSError, asyncio.IncompleteReadError):
            reply = {"callerid": "/recorder", "md5sum": SET_BOOL_MD5, "type": SET_BOOL}
            await wire.send(header(reply))
            while "probe" not in wire.header:
                await wire.frame()
                await wire.send(flip_answer(True))

    async def following() -> Header:
        wire = await provider.greeted()
        tasks.append(asyncio.create_task(serve(wire)))
        return wire.header

    tasks: list[asyncio.Task[None]] = []
    try:
        yield following
    finally:
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
        await provider.close()


@each_client
@pytest.mark.parametrize("persistent", [False, True], ids=["plain", "persistent"])
async def test_a_caller_and_its_probe(world: World, client: str, persistent: bool) -> None:
    service = world.unique("flip")
    async with callers(world, service) as following:
        async with (
            world.node("ours") as node,
            node.service_caller(service, SET_BOOL, persistent=persistent, timeout=30) as caller,
        ):
            waiting = asyncio.create_task(caller.wait_for_service(timeout=30))
            our_probe = await following()
            await waiting
            calling = caller.send_request(data=True)
            our_call = await following()
            assert (await calling).success
        if client == "rospy":
            options = ["--name", "ours", *(["--persistent"] if persistent else [])]
            world.rospy("client", service, SET_BOOL, '{"data": true}', *options)
        else:
            world.roscpp("client", service, "1", "1" if persistent else "0", "__name:=ours")
        assert our_probe == await following()
        their_call = await following()
        if their_call.get("persistent") == "0":  # as roscpp says it; rospy leaves it out
            del their_call["persistent"]
        assert our_call == their_call


async def test_the_question_for_the_type(world: World) -> None:
    service = world.unique("flip")
    async with callers(world, service) as following:
        async with world.node("ours") as node:
            asking = asyncio.create_task(node.service_type(service))
            ours = await following()
            assert await asking == SET_BOOL
        tool = world.start("rosservice", "type", service)
        theirs = await following()
        assert (await tool.wait()).stdout.strip() == SET_BOOL
    assert without(ours, "callerid") == without(theirs, "callerid")


# Who is connected to


async def reply(host: str, port: int, sent: bytes) -> Header:
    """What a node answers to a header."""
    wire = Wire(*await asyncio.open_connection(host, port))
    try:
        await wire.send(sent)
        return await wire.read_header()
    finally:
        await wire.close()


async def publishers_reply(world: World, topic: str, name: str, latching: str) -> Header:
    uri = await world.ask("lookupNode", name)
    _, _, (_, host, port) = await asyncio.to_thread(
        *(xmlrpc_call, uri, "requestTopic", "/fake", topic, [["TCPROS"]])
    )
    answer = await reply(host, port, subscriber_header(topic, md5sum="*", type="*"))
    assert answer.pop("latching") == latching
    return answer


@each_client
@pytest.mark.parametrize("type", [STRING, EMPTY])
async def test_what_a_publisher_answers(world: World, client: str, type: str) -> None:
    topic = world.unique("chatter")
    async with world.node("ours") as node, node.advertise(topic, type, latch=True):
        ours = await publishers_reply(world, topic, "/ours", "1")
    if client == "rospy":
        fields = world.fields(data="hi") if type == STRING else "{}"
        await world.rospy_ready("talker", topic, type, fields, "--name", "ours")
    else:
        await world.roscpp_ready("talker", topic, type, "0", "100", "0", "__name:=ours")
    theirs = await publishers_reply(world, topic, "/ours", "0")
    # Where a definition ends, each generator of code decides.
    definitions = [each.pop("message_definition").split() for each in (ours, theirs)]
    assert definitions[0] == definitions[1]
    assert ours == theirs


@each_client
async def test_what_a_provider_answers(world: World, client: str) -> None:
    service = world.unique("flip")

    async def answer() -> Header:
        uri = await world.ask("lookupService", service)
        host, _, port = uri.removeprefix("rosrpc://").partition(":")
        return await reply(host, int(port), caller_header(service))

    async with (
        world.node("ours") as node,
        node.advertise_service(service, SET_BOOL, lambda request: None),
    ):
        ours = await answer()
    if client == "rospy":
        await world.rospy_ready("server", service, SET_BOOL, "--name", "ours")
    else:
        await world.roscpp_ready("server", service, "", "__name:=ours")
    theirs = await answer()
    # rospy sends `service` and roscpp the two other types; we send both.
    only = {"rospy": ("request_type", "response_type"), "roscpp": ("service",)}[client]
    assert without(ours, *only) == theirs


# Requests to masters and nodes


@contextlib.asynccontextmanager
async def requests(world: World) -> AsyncIterator[Callable[[], Awaitable[tuple[str, Header]]]]:
    """Takes itself for the master; returns the head of the next request."""
    heads: asyncio.Queue[tuple[str, Header]] = asyncio.Queue()

    async def serve(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        with contextlib.suppress(OSError, asyncio.IncompleteReadError):
            head = (await reader.readuntil(b"\r\n\r\n")).decode().removesuffix("\r\n\r\n")
            line, *fields = head.split("\r\n")
            pairs = (field.split(": ", 1) for field in fields)
            heads.put_nowait((line, {name.title(): value for name, value in pairs}))
        writer.close()

    server = await asyncio.start_server(serve, "localhost", 0, family=socket.AF_INET)
    world.uri = f"http://localhost:{server.sockets[0].getsockname()[1]}"
    world.env["ROS_MASTER_URI"] = world.uri
    try:
        yield heads.get
    finally:
        server.close()
        await server.wait_closed()


@each_client
async def test_the_head_of_a_request(world: World, client: str) -> None:
    async with requests(world) as following, asyncio.timeout(60):
        async with world.node("ours", heartbeat=None) as node:
            asking = asyncio.create_task(node.master.get_pid())
            line, ours = await following()
            with contextlib.suppress(aioros1.MasterError):
                await asking
        if client == "rospy":
            world.rospy("listener", "/chatter", STRING)
        else:
            world.roscpp("listener", "/chatter", STRING)
        their_line, theirs = await following()
    assert line == their_line
    # A field that is not there asks for the simplest answer. Nobody looks at the others.
    assert set(ours) | {"Accept-Encoding"} >= set(theirs)
    assert ours["Content-Type"] == theirs["Content-Type"]
    assert ours["Host"] == theirs["Host"]
