"""What type checkers know of nodes and roles. This file is checked, and run as well."""
# pyright: strict

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Mapping
from typing import Any, TypeAlias, assert_type

import aioros1
from aioros1 import (
    AnyMessage,
    MessageEvent,
    Publisher,
    ServiceCaller,
    ServiceProvider,
    Subscriber,
)
from aioros1.msg.std_msgs import Int32, String
from aioros1.srv.std_srvs import SetBool

MakeNode: TypeAlias = Callable[..., Awaitable[aioros1.Node]]


async def test_topics(make_node: MakeNode) -> None:
    node = await make_node()
    async with node.advertise("chatter", String) as pub, node.subscribe("chatter", String) as sub:
        assert_type(pub, Publisher[String])
        assert_type(sub, Subscriber[String])
        assert_type(sub.latest, String | None)
        await pub.wait_for_subscribers(timeout=30)
        pub.publish(String(data="1"))
        pub.publish(data="2")
        pub.publish({"data": "3"})
        await pub.send(pub.message(data="4"))
        assert_type(await sub.get(timeout=30), String)
        async for message in sub:
            assert_type(message, String)
            assert_type(message.data, str)
            break
        async for event in sub.events():
            assert_type(event, MessageEvent[String])
            assert_type(event.message.data, str)
            assert_type(event.header, Mapping[str, str])
            break
        await asyncio.sleep(0)
        while sub.queued == 0:
            await asyncio.sleep(0.001)
        assert_type(sub.get_nowait(), String)
    assert_type(await node.advertise("other", String, latch=True), Publisher[String])


async def test_topics_of_types_that_are_named(make_node: MakeNode) -> None:
    node = await make_node()
    pub = await node.advertise("chatter", "std_msgs/String", latch=True)
    assert_type(pub, Publisher[Any])
    pub.publish(data="hi")
    assert_type(await node.subscribe("chatter", "std_msgs/String"), Subscriber[Any])

    sub = await node.subscribe("chatter")
    message = await sub.get(timeout=30)
    assert_type(message.to_bytes(), bytes)
    data: str = message.data
    assert data == "hi"
    assert (await node.wait_for_message("chatter", "*", timeout=30)).data == data

    raw = await node.subscribe("chatter", String, raw=True)
    assert_type(raw, Subscriber[bytes])
    assert_type(await node.subscribe("chatter", raw=True), Subscriber[bytes])
    octets = await raw.get(timeout=30)
    pub.publish_raw(octets)
    assert String.from_bytes(octets).data == data

    assert_type(await node.wait_for_message("chatter", String, timeout=30), String)
    assert_type(await node.wait_for_message("chatter", "std_msgs/String", timeout=30), Any)


async def test_services(make_node: MakeNode) -> None:
    node = await make_node()

    def plain(request: SetBool.Request) -> SetBool.Response:
        return SetBool.Response(success=request.data)

    async def waiting(request: SetBool.Request) -> SetBool.Response | None:
        await asyncio.sleep(0)
        return SetBool.Response(success=True) if request.data else None

    async def by_fields(request: SetBool.Request) -> dict[str, Any]:
        return {"success": request.data}

    provider = await node.advertise_service("plain", SetBool, plain)
    assert_type(provider, ServiceProvider[SetBool.Request, SetBool.Response])
    await node.advertise_service("waiting", SetBool, waiting)
    await node.advertise_service("by_fields", SetBool, by_fields)
    await node.advertise_service("mute", SetBool, lambda request: {"success": request.data})
    for name in ("plain", "waiting", "by_fields", "mute"):
        reply = await node.call(name, SetBool, data=True, timeout=30)
        assert_type(reply, SetBool.Response)
        assert reply.success
    reply = await node.call("plain", SetBool, SetBool.Request(data=False), timeout=30)
    assert_type(reply.message, str)
    assert_type(await node.call("plain", "std_srvs/SetBool", {"data": True}, timeout=30), Any)

    async with node.service_caller("plain", SetBool) as caller:
        assert_type(caller, ServiceCaller[SetBool.Request, SetBool.Response])
        request = caller.request(data=True)
        assert_type(request, SetBool.Request)
        assert_type(await caller.call(request, timeout=30), SetBool.Response)
        assert_type(await caller(data=True), SetBool.Response)
        assert_type(await caller.send_request({"data": True}), SetBool.Response)
    named = await node.service_caller("plain", "std_srvs/SetBool", persistent=True)
    assert_type(named, ServiceCaller[Any, Any])


async def test_callbacks(make_node: MakeNode) -> None:
    node = await make_node()
    got: asyncio.Queue[str] = asyncio.Queue()

    def plain(message: String) -> None:
        assert_type(message.data, str)
        got.put_nowait(message.data)

    async def waiting(message: String) -> None:
        await got.put(message.data)

    def serialised(message: bytes) -> None:
        got.put_nowait(String.from_bytes(message).data)

    def anyhow(message: AnyMessage) -> None:
        got.put_nowait(message.data)

    pub = await node.advertise("chatter", String, latch=True)
    pub.publish(data="hi")
    assert_type(await node.subscribe("chatter", String, plain), Subscriber[String])
    assert_type(await node.subscribe("chatter", String, waiting), Subscriber[String])
    assert_type(await node.subscribe("chatter", String, serialised, raw=True), Subscriber[bytes])
    assert_type(await node.subscribe("chatter", "*", serialised, raw=True), Subscriber[bytes])
    named = await node.subscribe("chatter", "std_msgs/String", lambda m: got.put_nowait(m.data))
    assert_type(named, Subscriber[Any])
    anything = await node.subscribe("chatter", callback=anyhow)
    assert_type(anything, Subscriber[AnyMessage])
    for _ in range(6):
        assert await asyncio.wait_for(got.get(), 5) == "hi"


async def test_raw_services(make_node: MakeNode) -> None:
    node = await make_node()

    async def answer(request: bytes) -> bytes:
        return SetBool.Response(success=SetBool.Request.from_bytes(request).data).to_bytes()

    provider = await node.advertise_service("flip", SetBool, answer, raw=True)
    assert_type(provider, ServiceProvider[bytes, bytes])
    request = SetBool.Request(data=True).to_bytes()
    async with node.service_caller("flip", SetBool) as caller:
        assert_type(await caller.call_raw(request, timeout=5), bytes)
    async with node.service_caller("flip", SetBool, raw=True) as raw:
        assert SetBool.Response.from_bytes(await raw.call(request, timeout=5)).success
    async with node.advertise_service("any", "*", raw=True) as taker:
        assert_type(taker, ServiceProvider[bytes, bytes])


async def test_tasks(make_node: MakeNode) -> None:
    node = await make_node()

    async def work(count: int) -> str:
        await asyncio.sleep(0)
        return "done" * count

    task = node.create_task(work(2), name="work")
    assert_type(task, asyncio.Task[None])
    assert_type(await task, None)


class Relay(aioros1.Composite):
    """Two topics and a task."""

    def __init__(self, node: aioros1.Node) -> None:
        super().__init__(node, "relay")
        self.relayed = 0

    async def _open(self) -> None:
        self._pub = await self._own(self.node.advertise("copy", String, latch=True))
        assert_type(self._pub, Publisher[String])
        self._sub = await self._own(self.node.subscribe("chatter", String))
        assert_type(self._create_task(self._relay()), asyncio.Task[None])

    async def _relay(self) -> None:
        async for message in self._sub:
            self._pub.publish(message)
            self.relayed += 1


class Pair(aioros1.Composite):
    """A composite that owns another one."""

    async def _open(self) -> None:
        self.relay = await self._own(Relay(self.node))
        assert_type(self.relay, Relay)


async def test_composites(make_node: MakeNode) -> None:
    node = await make_node()
    pub = await node.advertise("chatter", String, latch=True)
    pub.publish(data="hi")
    async with Relay(node) as relay:
        assert_type(relay, Relay)
        assert_type(relay.node, aioros1.Node)
        assert_type(await node.wait_for_message("copy", String, timeout=5), String)
    pair = await Pair(node)
    assert_type(pair, Pair)
    assert_type(pair.relay.relayed, int)
    await pair.close()
    assert not pair.relay.is_open


async def test_calls_that_are_answered_later(make_node: MakeNode) -> None:
    node = await make_node()
    async with node.advertise_service("flip", SetBool) as provider:
        calling = asyncio.create_task(node.call("flip", SetBool, data=True, timeout=30))
        async for call in provider:
            assert_type(call.request, SetBool.Request)
            await call.reply(SetBool.Response(success=call.request.data))
            break
        assert_type(await calling, SetBool.Response)


class GenpyString:
    """What checkers see of a class of genpy's."""

    _type = "std_msgs/String"
    _md5sum = "992ce8a1687cec8c8bd883ec73ca41d1"

    def _check_types(self, exc: Any = None) -> None: ...
    def serialize(self, buff: Any) -> None: ...


class GenpySetBool:
    _type = "std_srvs/SetBool"
    _md5sum = "09fb03525b03e7ea1fd3992bafd87e16"
    _request_class = GenpyString
    _response_class = GenpyString


async def genpys_classes_are_accepted(node: aioros1.Node, pub: Publisher[String]) -> None:
    """Only checked: what is done with such is tested where there is a genpy."""
    pub.publish(GenpyString())
    await pub.send(GenpyString())
    assert_type(await node.advertise("chatter", GenpyString), Publisher[Any])
    assert_type(await node.subscribe("chatter", GenpyString), Subscriber[Any])
    assert_type(await node.service_caller("flip", GenpySetBool), ServiceCaller[Any, Any])


async def test_merged_topics(make_node: MakeNode) -> None:
    node = await make_node()
    async with (
        node.advertise("chatter", String, latch=True) as pub,
        node.subscribe("chatter", String) as one,
        node.subscribe("number", Int32) as other,
    ):
        pub.publish(data="1")
        merged = aioros1.merge(one, other)
        topic, message = await asyncio.wait_for(anext(merged), 30)
        assert_type(topic, str)
        assert_type(message, String | Int32)
