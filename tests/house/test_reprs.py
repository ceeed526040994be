"""What public objects tell of themselves, in a log or a debugger: what they are, their name
and their state, in one line; no secrets, and no whole definitions.

Data classes and tuples show their fields, and exceptions their text.
"""

from __future__ import annotations

import contextlib
import dataclasses
import re
from collections.abc import Awaitable, Callable
from typing import Any

import pytest

import aioros1
from aioros1.contrib.threads import NodeThread
from aioros1.msg.std_msgs import String
from aioros1.srv.std_srvs import SetBool
from aioros1.testing import FlakyProxy, MakeFlakyProxy, MakeNode, SimulatedClock
from aioros1.wire.frames import FrameReceiver
from aioros1.wire.handshake import Server, ServiceClient, ServiceOffer, TopicClient, TopicOffer
from aioros1.wire.header import HeaderParser
from aioros1.wire.http import AnswerReader

from .public import public_modules, public_names

one_loop = pytest.mark.asyncio(loop_factories=["asyncio"])


class Relay(aioros1.Composite):
    pass


def shown(value: object, master: aioros1.Master) -> str:
    """Its repr, without what is another in each run."""
    text = repr(value).replace(master.uri.rstrip("/"), "MASTER")
    return re.sub(r"(127\.0\.0\.1|localhost):\d+", "HOST", text)


@one_loop
async def test_what_lives_on_a_node(
    make_node: Callable[..., Awaitable[aioros1.Node]], master: aioros1.Master
) -> None:
    node = await make_node("n")
    opening = node.advertise("chatter", String)
    assert shown(opening, master) == (
        "<Opening of publisher chatter: await it, or use it with async with>"
    )
    pub = await opening
    sub = await node.subscribe("chatter", String)
    other = await node.subscribe("~private")
    provider = await node.advertise_service("flip", SetBool)
    caller = await node.service_caller("flip", SetBool)
    pending = caller.send_request(data=True)
    call = await anext(provider)
    relay = Relay(node, "front")
    table: dict[str, Any] = {
        "<Node /n at MASTER/, open>": node,
        "<Master at MASTER/, open>": master,
        "<Publisher /chatter [std_msgs/String] of /n, open>": pub,
        "<Subscriber /chatter [std_msgs/String] of /n, open>": sub,
        "<Subscriber /n/private [*] of /n, open>": other,
        "<Merge of /chatter, /n/private>": aioros1.merge(sub, other),
        "<ServiceProvider /flip [std_srvs/SetBool] of /n, open>": provider,
        "<ServiceCaller /flip [std_srvs/SetBool] of /n, open>": caller,
        "<ServiceCall of /n, waits for an answer>": call,
        "<ParamSubscriber /gain of /n, open>": await node.subscribe_param("gain"),
        "<Timer once after 60 s, running>": node.timer(60, print, oneshot=True),
        "<Rate of 10 Hz, 0 ticks missed>": node.rate(10),
        "<EventStream, 0 waiting, 0 dropped, open>": node.events(),
        "<Graph of the master at MASTER/>": node.graph,
        "<changes of <Graph of the master at MASTER/>>": node.graph.changes(),
        "<MasterProxy of MASTER/ for /n>": node.master,
        "<NodeProxy of /n at http://HOST/>": await node.peer("/n"),
        "<NodeLog of /n, logger ros.n>": node.log,
        "<Relay front of /n, new>": relay,
    }
    assert {expected: shown(value, master) for expected, value in table.items()} == {
        expected: expected for expected in table
    }
    assert "SparseLog" in repr(node.log.once)
    assert "PendingCall" in repr(pending)
    await call.reply(success=True)
    await pending
    assert shown(call, master) == "<ServiceCall of /n, answered>"
    await relay
    await node.close()
    assert shown(node, master) == "<Node /n at MASTER/, closed>"
    assert shown(pub, master) == "<Publisher /chatter [std_msgs/String] of /n, closed>"
    assert shown(relay, master) == "<Relay front of /n, closed>"


@one_loop
async def test_what_tests_are_given(master: aioros1.Master) -> None:
    clock = SimulatedClock(master.uri)
    assert shown(clock, master) == "<SimulatedClock at 1.000000000 of MASTER/, new>"
    async with clock, contextlib.AsyncExitStack() as stack:
        assert shown(clock, master) == "<SimulatedClock at 1.000000000 of MASTER/, open>"
        make = MakeNode(master.uri, stack)
        assert shown(make, master) == "<MakeNode for the master at MASTER/>"
        make_proxy = MakeFlakyProxy(stack)
        await make_proxy("localhost", master.port)
        assert shown(make_proxy, master) == "<MakeFlakyProxy, 1 made>"
    assert shown(clock, master) == "<SimulatedClock at 1.000000000 of MASTER/, closed>"
    proxy = FlakyProxy("localhost", master.port)
    assert shown(proxy, master) == "<FlakyProxy at HOST before HOST, new>"
    async with proxy:
        assert shown(proxy, master) == "<FlakyProxy at HOST before HOST, open>"
        node = aioros1.Node("n", master_uri=f"http://localhost:{proxy.port}", host="localhost")
        async with node:
            (connection, *_) = proxy.connections
            assert shown(connection, master) == "<FlakyConnection 1 from HOST, open>"
    assert shown(proxy, master) == "<FlakyProxy at HOST before HOST, closed>"
    assert shown(connection, master) == "<FlakyConnection 1 from HOST, closed>"
    thread = NodeThread("gui", master_uri=master.uri)
    assert shown(thread, master) == "<NodeThread /gui at MASTER/, new>"


class Sink:
    def batch(self, data: bytes | memoryview) -> None: ...
    def frames(self, frames: list[Any]) -> None: ...


def test_the_wire() -> None:
    receiver = FrameReceiver(Sink(), memoryview(bytearray(1 << 16)), max_bytes=1 << 20)
    assert repr(receiver) == "<FrameReceiver, 0 frames in 0 bytes>"
    receiver.feed(b"\1\0\0\0x" + (10_000).to_bytes(4, "little") + bytes(100))
    assert repr(receiver) == (
        "<FrameReceiver, 1 frames in 109 bytes, 9900 bytes of the next are missing>"
    )
    parser = HeaderParser()
    parser.feed(b"abc")
    assert repr(parser) == "<HeaderParser, 3 bytes waiting>"
    reader = AnswerReader(max_bytes=100)
    assert repr(reader) == "<AnswerReader: no status yet, incomplete>"
    reader.receive_data(b"HTTP/1.1 200 OK\r\nContent-Length: 0\r\n\r\n")
    assert repr(reader) == "<AnswerReader: 200 OK, complete>"

    limits = {"max_bytes": 1000, "max_fields": 10}
    topic = TopicOffer("/chatter", "std_msgs/String", "*", "string data\n")
    client = TopicClient("/talker", "/listener", topic, **limits)
    server = Server("HOST", **limits)
    assert repr(client) == "<TopicClient: topic /chatter of /talker, waits for its header>"
    assert repr(server) == "<Server: a connection of HOST, waits for its header>"
    server.receive_data(client.data_to_send())
    assert repr(server) == "<Server: topic /chatter to /listener at HOST, has its header>"
    client.receive_data(server.accept_topic("/talker", topic))
    assert repr(client) == "<TopicClient: topic /chatter of /talker, has its header>"
    caller = ServiceClient("/server", "/me", ServiceOffer("/flip", "std_srvs/SetBool", "*"))
    assert repr(caller) == "<ServiceClient: service /flip of /server, waits for its header>"


def test_definitions_and_messages() -> None:
    store = aioros1.MessageStore(parent=None)
    store.add_text("p/T", "int32 number\n")
    store.load_msg("p/T")
    assert repr(store) == "<MessageStore: no directories, 1 added text, 1 type loaded>"
    assert repr(store.load_msg("p/T")(number=1)) == "T(number=1)"


SHOWN_ABOVE = {
    "EventStream", "Graph", "GraphChanges", "Master", "MasterProxy", "Merge", "MessageStore",
    "Node", "NodeLog", "NodeProxy", "Opening", "ParamSubscriber", "Publisher", "Rate",
    "ServiceCall", "ServiceCaller", "ServiceProvider", "Subscriber", "Timer", "PendingCall",
    "SparseLog", "Composite", "Role", "Message", "AnyMessage", "NodeThread", "FlakyConnection",
    "FlakyProxy", "MakeFlakyProxy", "MakeNode", "SimulatedClock", "AnswerReader",
    "FrameReceiver", "HeaderParser", "Server", "ServiceClient", "TopicClient", "Time",
    "Duration",
}  # fmt: skip


def test_all_of_them_are_here() -> None:
    others = {
        path.rpartition(".")[2]
        for path, one in public_names(public_modules()).items()
        if isinstance(one.value, type)
        and not dataclasses.is_dataclass(one.value)
        and not getattr(one.value, "_is_protocol", False)
        and not issubclass(one.value, (tuple, BaseException, aioros1.Service, aioros1.Action))
    }
    assert others == SHOWN_ABOVE
