"""Topics without TCP: the same rules within one host and within one loop."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import os
import sys
from collections.abc import AsyncIterator, Awaitable, Callable
from typing import Any

import pytest

import aioros1
from aioros1.msg.std_msgs import Int32, String
from aioros1.net import local_transports as local
from aioros1.xmlrpc.client import XmlRpcClient

needs_abstract_sockets = pytest.mark.skipif(
    not sys.platform.startswith("linux"), reason="abstract Unix sockets are Linux's"
)
NAMES = {"unix": "UNIXROS", "intraprocess": "INTRAPROCESS", "tcp": "TCPROS"}
LOCAL = [pytest.param("unix", marks=needs_abstract_sockets), "intraprocess"]


@pytest.fixture(params=[*LOCAL, "tcp"])
def transport(request) -> str:
    """The transport that both nodes of a test use: TCP too, so that the rules are the same."""
    return request.param


def using(transport: str) -> dict[str, Any]:
    return {"local_transports": () if transport == "tcp" else (transport,)}


@pytest.fixture
async def nodes(make_node, transport) -> AsyncIterator[tuple[aioros1.Node, aioros1.Node]]:
    """Two nodes, for a publisher and a subscriber, who talk over ``transport``."""
    pair = (
        await make_node("talker", **using(transport)),
        await make_node("listener", **using(transport)),
    )
    yield pair
    for node in pair:
        assert {info.transport for info in node.connections} <= {NAMES[transport]}


@pytest.fixture
async def ask() -> AsyncIterator[Callable[..., Awaitable[Any]]]:
    """``await ask(node, "getPid")``: the bare answer of a node's slave API."""
    client = XmlRpcClient()

    async def call(node: aioros1.Node, method: str, *params: Any) -> Any:
        return await client.call(node.uri, method, "/asker", *params)

    yield call
    await client.close()


async def until(condition: Callable[[], object]) -> None:
    async with asyncio.timeout(10):
        while not condition():
            await asyncio.sleep(0.002)


# the rules of topics


async def test_the_transport_is_told(nodes, transport, ask):
    talker, listener = nodes
    events = talker.events()
    async with (
        talker.advertise("chatter", String) as pub,
        listener.subscribe("chatter", String) as sub,
    ):
        await pub.wait_for_subscribers(timeout=30)
        await sub.wait_for_publishers(timeout=30)
        name = NAMES[transport]
        assert [info.transport for info in pub.connections] == [name]
        assert [info.transport for info in sub.connections] == [name]
        async for event in events:
            if isinstance(event, aioros1.PeerConnected):
                assert event.connection.transport == name
                break
        pub.publish(data="hi")
        assert (await sub.get(timeout=30)).data == "hi"
        for node, peer, direction in ((talker, "/listener", "o"), (listener, talker.uri, "i")):
            _, _, rows = await ask(node, "getBusInfo")
            [row] = [row for row in rows if row[4] == "/chatter"]
            assert row[1:6] == [peer, direction, name, "/chatter", True]
            assert row[6].startswith(f"{name} connection")
        _, _, [[[topic, size, [[number, sent, count, connected]]]], _, _] = await ask(
            talker, "getBusStats"
        )
        assert (topic, number, connected) == ("/chatter", pub.connections[0].id, True)
        assert (size, sent, count) == (10, 10, 1)
        _, _, [_, [[topic, [[number, received, count, _, _]]]], _] = await ask(
            listener, "getBusStats"
        )
        assert (topic, number) == ("/chatter", sub.connections[0].id)
        assert (received, count) == (10, 1)
        stats = sub.connections[0].stats
        assert (stats.messages, stats.bytes) == (1, 10)


async def test_order_and_nothing_lost(nodes):
    talker, listener = nodes
    count = 30_000
    async with (
        talker.advertise("n", Int32, queue_size=50, overflow="block") as pub,
        listener.subscribe("n", Int32, queue_size=30, overflow="block") as sub,
    ):
        await pub.wait_for_subscribers(timeout=30)

        async def send() -> None:
            for i in range(count):
                await pub.send(data=i)

        sending = asyncio.create_task(send())
        async with asyncio.timeout(30):
            for i in range(count):
                assert (await anext(sub)).data == i
        await sending
        assert (pub.dropped, sub.dropped) == (0, 0)


@pytest.mark.parametrize("views", [False, True])
async def test_messages_of_all_sizes(nodes, views):
    talker, listener = nodes
    sizes = [0, 1, 4095, 65_000, 70_000, 5_000_000, 3, 300_000, 262_144]
    async with (
        talker.advertise("bytes", "std_msgs/UInt8MultiArray", queue_size=len(sizes)) as pub,
        listener.subscribe("bytes", queue_size=len(sizes), views=views) as sub,
    ):
        await pub.wait_for_subscribers(timeout=30)
        payloads = [os.urandom(size) for size in sizes]
        for payload in payloads:
            pub.publish(data=payload)
        for payload in payloads:
            assert bytes((await sub.get(timeout=30)).data) == payload


async def test_a_message_does_not_change_with_what_it_was_made_of(nodes):
    talker, listener = nodes
    async with (
        talker.advertise("bytes", "std_msgs/UInt8MultiArray") as pub,
        listener.subscribe("bytes", views=True) as sub,
    ):
        await pub.wait_for_subscribers(timeout=30)
        payload = bytearray(200_000)
        pub.publish(data=payload)
        pub.publish_raw(raw := bytearray(12) + bytearray(100))
        payload[:] = b"x" * len(payload)
        raw[:] = b"x" * len(raw)
        assert bytes((await sub.get(timeout=30)).data) == bytes(200_000)


async def test_a_latched_message_comes_first(nodes):
    talker, listener = nodes
    async with talker.advertise("map", String, latch=True) as pub:
        pub.publish(data="latched" * 20_000)
        async with listener.subscribe("map", String) as sub:
            assert (await sub.get(timeout=30)).data == "latched" * 20_000
            pub.publish(data="next")
            assert (await sub.get(timeout=30)).data == "next"
            async with listener.subscribe("map", String) as late:
                assert (await late.get(timeout=30)).data == "next"


@pytest.mark.parametrize(
    ("overflow", "kept"), [("drop_oldest", [7, 8, 9]), ("drop_newest", [0, 1, 2])]
)
async def test_a_subscriber_drops_by_its_own_policy(nodes, overflow, kept):
    talker, listener = nodes
    async with (
        talker.advertise("n", Int32, queue_size=100) as pub,
        listener.subscribe("n", Int32, queue_size=3, overflow=overflow) as sub,
    ):
        await pub.wait_for_subscribers(timeout=30)
        for i in range(10):
            pub.publish(data=i)
        await until(lambda: sub.stats.messages == 10)
        assert [sub.get_nowait().data for _ in range(3)] == kept
        assert (sub.dropped, pub.dropped) == (7, 0)


async def test_a_full_subscriber_makes_a_blocking_publisher_wait(nodes):
    talker, listener = nodes
    payload = bytes(200_000)
    async with (
        talker.advertise("big", "std_msgs/UInt8MultiArray", overflow="block", queue_size=2) as pub,
        listener.subscribe("big", overflow="block", queue_size=1) as sub,
    ):
        await pub.wait_for_subscribers(timeout=30)
        sent = 0
        async with asyncio.timeout(10):
            with pytest.raises(asyncio.QueueFull):
                while True:
                    pub.publish(data=payload[: 100_000 + sent])
                    sent += 1
                    await asyncio.sleep(0)
        assert sent > 3  # what is on its way has room too
        with pytest.raises(TimeoutError):
            await pub.drain(timeout=0.01)
        for i in range(sent):
            assert len((await sub.get(timeout=30)).data) == 100_000 + i
        await pub.send(data=b"last", timeout=30)
        assert (await sub.get(timeout=30)).data == b"last"
        await pub.drain(timeout=30)


@pytest.mark.parametrize(
    ("overflow", "kept"), [("drop_oldest", "the last"), ("drop_newest", "an early")]
)
async def test_a_publisher_drops_for_a_connection_that_takes_nothing(nodes, overflow, kept):
    talker, listener = nodes
    payload = bytes(100_000)
    async with (
        talker.advertise("big", "std_msgs/UInt8MultiArray", overflow=overflow, queue_size=3) as pub,
        listener.subscribe("big", overflow="block", queue_size=1) as sub,
        listener.subscribe("big") as other,
    ):
        await pub.wait_for_subscribers(timeout=30)
        sent = 0
        async with asyncio.timeout(10):
            while not pub.dropped:
                pub.publish(data=sent.to_bytes(4, "little") + payload)
                sent += 1
                await asyncio.sleep(0)
        assert pub.connections[0].stats.dropped == pub.dropped == 1
        numbers = [
            int.from_bytes((await sub.get(timeout=30)).data[:4], "little") for _ in range(sent - 1)
        ]
        expected = list(range(sent))
        expected.remove(sent - 4 if kept == "the last" else sent - 1)
        assert numbers == expected
        await until(lambda: other.stats.messages == sent - 1)


async def test_one_that_takes_nothing_for_too_long_is_cut_off_and_no_other(
    make_node, transport, caplog
):
    talker = await make_node("talker", timeouts=aioros1.Timeouts(stall=0.2), **using(transport))
    stuck, lively = [await make_node(name, **using(transport)) for name in ("stuck", "lively")]
    async with (
        talker.advertise("big", "std_msgs/UInt8MultiArray", queue_size=1) as pub,
        stuck.subscribe("big", overflow="block", queue_size=1),
        lively.subscribe("big") as sub,
    ):
        await pub.wait_for_subscribers(2, timeout=30)
        async with asyncio.timeout(20):
            while pub.subscriber_count == 2:
                pub.publish(data=bytes(100_000))
                await sub.get(timeout=30)
                await asyncio.sleep(0)  # within a process, it may be there already
        assert [info.peer for info in pub.connections] == ["/lively"]
        assert "/stuck was cut off" in caplog.text


async def test_unsubscribing_and_subscribing_again(nodes):
    talker, listener = nodes
    async with talker.advertise("chatter", String) as pub:
        for attempt in range(3):
            async with listener.subscribe("chatter", String) as sub:
                await pub.wait_for_subscribers(timeout=30)
                pub.publish(data=str(attempt))
                assert (await sub.get(timeout=30)).data == str(attempt)
            await until(lambda: pub.subscriber_count == 0)


async def test_advertising_again(nodes, transport):
    talker, listener = nodes
    async with listener.subscribe("chatter", String) as sub:
        for attempt in range(3):
            async with talker.advertise("chatter", String) as pub:
                await pub.wait_for_subscribers(timeout=30)
                assert pub.connections[0].transport == NAMES[transport]
                pub.publish(data=str(attempt))
            # Closing has sent it first.
            assert (await sub.get(timeout=30)).data == str(attempt)
            await until(lambda: sub.publisher_count == 0)


@pytest.mark.parametrize("side", ["talker", "listener"])
async def test_the_death_of_either_side(nodes, make_node, transport, side):
    talker, listener = nodes
    pub = await talker.advertise("chatter", String)
    sub = await listener.subscribe("chatter", String)
    await pub.wait_for_subscribers(timeout=30)
    await sub.wait_for_publishers(timeout=30)
    if side == "talker":
        talker.abort()
        await until(lambda: sub.publisher_count == 0)
        again = await make_node("talker", **using(transport))
        async with again.advertise("chatter", String) as pub:
            await pub.wait_for_subscribers(timeout=30)
            pub.publish(data="again")
            assert (await sub.get(timeout=30)).data == "again"
    else:
        listener.abort()
        await until(lambda: pub.subscriber_count == 0)
        pub.publish(data="to nobody")
        again = await make_node("listener", **using(transport))
        async with again.subscribe("chatter", String) as sub:
            await pub.wait_for_subscribers(timeout=30)
            pub.publish(data="again")
            assert (await sub.get(timeout=30)).data == "again"


async def test_another_definition_is_refused_with_a_reason(nodes, caplog):
    talker, listener = nodes
    async with (
        talker.advertise("chatter", String) as pub,
        listener.subscribe("chatter", Int32),
    ):
        await until(lambda: "has md5sum" in caplog.text or "with md5sum" in caplog.text)
        assert pub.subscriber_count == 0


async def test_connections_count_against_the_limit(make_node, transport):
    talker = await make_node("talker", limits=aioros1.Limits(connections=1), **using(transport))
    async with contextlib.AsyncExitStack() as stack:
        pub = await stack.enter_async_context(talker.advertise("chatter", String))
        first, second = [await make_node(name, **using(transport)) for name in ("one", "two")]
        await stack.enter_async_context(first.subscribe("chatter", String))
        await pub.wait_for_subscribers(timeout=30)
        await stack.enter_async_context(second.subscribe("chatter", String))
        await until(lambda: talker.stats.connections_refused)
        assert pub.subscriber_count == 1


async def test_a_message_beyond_the_limit_closes_the_connection(make_node, transport):
    talker = await make_node("talker", **using(transport))
    listener = await make_node(
        "listener", limits=aioros1.Limits(message_bytes=1000), **using(transport)
    )
    events = listener.events()
    async with (
        talker.advertise("chatter", String) as pub,
        listener.subscribe("chatter", String) as sub,
    ):
        await pub.wait_for_subscribers(timeout=30)
        pub.publish(data="fits")
        pub.publish(data="x" * 1000)
        assert (await sub.get(timeout=30)).data == "fits"
        async with asyncio.timeout(30):
            async for event in events:
                if isinstance(event, aioros1.PeerDisconnected):
                    assert "1004 bytes" in event.reason
                    break


async def test_many_subscribers(nodes, make_node, transport):
    talker, _ = nodes
    async with contextlib.AsyncExitStack() as stack:
        pub = await stack.enter_async_context(talker.advertise("n", Int32, queue_size=1000))
        subs = []
        for i in range(20):
            node = await make_node(f"listener_{i}", **using(transport))
            subs.append(
                await stack.enter_async_context(node.subscribe("n", Int32, queue_size=1000))
            )
        await pub.wait_for_subscribers(20, timeout=30)
        for i in range(1000):
            pub.publish(data=i)
        for sub in subs:
            assert [(await sub.get(timeout=30)).data for _ in range(1000)] == list(range(1000))


async def test_a_node_that_hears_itself(make_node, transport):
    node = await make_node("node", **using(transport))
    async with node.advertise("n", Int32) as pub, node.subscribe("n", Int32) as sub:
        await pub.wait_for_subscribers(timeout=30)
        await sub.wait_for_publishers(timeout=30)
        assert pub.connections[0].transport == sub.connections[0].transport == NAMES[transport]
        pub.publish(data=1)
        assert (await sub.get(timeout=30)).data == 1


async def test_publishing_in_answer_to_a_message_is_no_recursion(nodes):
    talker, listener = nodes
    async with (
        talker.advertise("ping", Int32) as ping,
        listener.subscribe("ping", Int32) as heard,
        listener.advertise("pong", Int32) as pong,
        talker.subscribe("pong", Int32) as answers,
    ):
        await ping.wait_for_subscribers(timeout=30)
        await pong.wait_for_subscribers(timeout=30)

        async def answer() -> None:
            async for message in heard:
                pong.publish(data=message.data + 1)

        answering = asyncio.create_task(answer())
        ping.publish(data=0)
        async with asyncio.timeout(10):
            async for message in answers:
                if message.data >= 2000:
                    break
                ping.publish(data=message.data + 1)
        answering.cancel()
        await asyncio.wait({answering})


# who talks how with whom


async def transport_between(one: aioros1.Node, other: aioros1.Node) -> str:
    async with one.advertise("chatter", String) as pub, other.subscribe("chatter", String) as sub:
        await pub.wait_for_subscribers(timeout=30)
        pub.publish(data="hi")
        assert (await sub.get(timeout=30)).data == "hi"
        assert pub.connections[0].transport == sub.connections[0].transport
        return sub.connections[0].transport


async def test_nothing_but_tcp_unless_asked_for(make_node):
    assert (await make_node("node")).options.local_transports == ()
    assert await transport_between(await make_node("a"), await make_node("b")) == "TCPROS"


@needs_abstract_sockets
@pytest.mark.parametrize(
    ("one", "other", "expected"),
    [
        (("intraprocess", "unix"), ["unix", "intraprocess"], "INTRAPROCESS"),
        ({"unix", "intraprocess"}, ("unix",), "UNIXROS"),
        (("intraprocess",), ("unix",), "TCPROS"),
        ((), ("unix", "intraprocess"), "TCPROS"),
        (("unix", "intraprocess"), (), "TCPROS"),
    ],
)
async def test_both_sides_must_want_it(make_node, one, other, expected):
    a = await make_node("a", local_transports=one)
    b = await make_node("b", local_transports=other)
    assert await transport_between(a, b) == expected


@pytest.mark.parametrize("value", ["unix", ("tcp",), (3,)])
def test_what_is_no_transport_is_named(value):
    with pytest.raises(ValueError, match=r"'intraprocess', 'unix', got"):
        aioros1.Node("node", local_transports=value)


async def test_another_loop_of_the_process_is_another_place(make_node, master):
    listener = await make_node("listener", local_transports=("intraprocess",))
    stop = asyncio.Event()
    loop = asyncio.get_running_loop()

    async def talk() -> None:
        async with (
            aioros1.Node(
                "talker",
                master_uri=master.uri,
                host="localhost",
                local_transports=("intraprocess",),
            ) as node,
            node.advertise("chatter", String, latch=True) as pub,
        ):
            pub.publish(data="from another loop")
            await asyncio.wrap_future(asyncio.run_coroutine_threadsafe(stop.wait(), loop))

    async with listener.subscribe("chatter", String) as sub:
        talking = asyncio.create_task(asyncio.to_thread(lambda: asyncio.run(talk())))
        assert (await sub.get(timeout=30)).data == "from another loop"
        assert sub.connections[0].transport == "TCPROS"
        stop.set()
        await talking


@needs_abstract_sockets
async def test_another_process_of_the_host(make_node, master):
    listener = await make_node("listener", local_transports=("intraprocess", "unix"))
    program = f"""
import asyncio, aioros1
async def main():
    options = dict(master_uri={master.uri!r}, host="localhost", rosout=False)
    async with aioros1.Node("talker", **options, local_transports=("intraprocess", "unix")) as node:
        async with node.advertise("chatter", "std_msgs/String", latch=True) as pub:
            pub.publish(data="from another process")
            await node.wait_closed()
asyncio.run(main())
"""
    async with listener.subscribe("chatter", String) as sub:
        process = await asyncio.create_subprocess_exec(sys.executable, "-c", program)
        try:
            assert (await sub.get(timeout=10)).data == "from another process"
            assert sub.connections[0].transport == "UNIXROS"
            process.kill()
            await until(lambda: sub.publisher_count == 0)
        finally:
            with contextlib.suppress(ProcessLookupError):
                process.kill()
            await process.wait()


@needs_abstract_sockets
@pytest.mark.skipif(os.name != "posix" or os.geteuid() != 0, reason="needs the right to be another")
@pytest.mark.parametrize(("user", "may"), [(65534, False), (0, True)])
async def test_another_user_of_the_host_is_refused(make_node, ask, caplog, user, may):
    node = await make_node("talker", local_transports=("unix",), allow=["127.0.0.1"])
    async with node.advertise("chatter", String, latch=True) as pub:
        pub.publish(data="for friends")
        _, _, (_, name) = await ask(
            node, "requestTopic", "/chatter", [["TCPROS"], offer_of("unix")]
        )
        program = f"""
import os, socket, struct
os.setuid({user})
fields = ["callerid=/other", "md5sum=*", "topic=/chatter", "type=*"]
body = b"".join(struct.pack("<I", len(each)) + each.encode() for each in fields)
with socket.socket(socket.AF_UNIX) as sock:
    sock.connect("\\0{name}")
    try:
        sock.sendall(struct.pack("<I", len(body)) + body)
        print(bool(sock.recv(1)))
    except OSError:
        print(False)
"""
        process = await asyncio.create_subprocess_exec(
            *(sys.executable, "-I", "-c", program), stdout=asyncio.subprocess.PIPE
        )
        told, _ = await process.communicate()
        assert told.decode() == f"{may}\n"
        assert node.stats.connections_forbidden == (0 if may else 1)
        if not may:
            assert "it belongs to user 65534, and this process to 0" in caplog.text
        # Whom it lets in over TCP, is for `allow` to say.
        assert pub.subscriber_count == 0 or may


@needs_abstract_sockets
async def test_another_host_is_answered_with_tcp(make_node, ask):
    node = await make_node("talker", local_transports=("intraprocess", "unix"))
    async with node.advertise("chatter", String):
        tcp = ["TCPROS", *node.tcpros_address]
        for extra in (
            ["UNIXROS", "0" * 32],
            ["UNIXROS"],
            ["UNIXROS", 5],
            [*offer_of("unix"), "more"],
            ["INTRAPROCESS", "0" * 32],
            ["INTRAPROCESS", ["?"]],
            ["SOMETHING", "else"],
        ):
            answer = await ask(node, "requestTopic", "/chatter", [["TCPROS"], extra])
            assert answer == [1, "ready", tcp]
        code, _, value = await ask(node, "requestTopic", "/chatter", [["UNIXROS", "0" * 32]])
        assert (code, value) == (0, [])
        wanted = [["TCPROS"], offer_of("unix")]
        _, _, value = await ask(node, "requestTopic", "/chatter", wanted)
        assert value[0] == "UNIXROS"


@needs_abstract_sockets
async def test_a_node_that_is_closed_leaves_no_socket(make_node, ask):
    node = await make_node("talker", local_transports=("intraprocess", "unix"))
    answers = []
    async with node.advertise("chatter", String):
        for transport in ("unix", "intraprocess"):
            wanted = [["TCPROS"], offer_of(transport)]
            _, _, answer = await ask(node, "requestTopic", "/chatter", wanted)
            stream = await a_subscriber(transport).connect(answer)
            stream.transport.abort()
            answers.append(answer)
        name = answers[0][1]
        assert await asyncio.to_thread(is_listed, name)
    await node.close()
    assert not await asyncio.to_thread(is_listed, name)
    for transport, answer in zip(("unix", "intraprocess"), answers, strict=True):
        with pytest.raises(ConnectionError):
            await a_subscriber(transport).connect(answer)


def a_subscriber(transport):
    """The subscriber's side of a local transport, without a node."""
    return local.LocalTransports((transport,), None)


def offer_of(transport):
    """What a subscriber of this loop asks for to be connected over ``transport``."""
    [offer] = a_subscriber(transport).offers()
    return offer


def is_listed(name: str) -> bool:
    with open("/proc/net/unix", encoding="ascii") as file:
        return any(line.rstrip().endswith(f"@{name}") for line in file)


async def test_where_there_are_no_unix_sockets_nothing_is_missed(make_node, monkeypatch, caplog):
    monkeypatch.setattr(local, "_host_key", lambda: None)
    a, b = [await make_node(name, local_transports=("unix",)) for name in "ab"]
    assert await transport_between(a, b) == "TCPROS"
    assert not [each for each in caplog.records if each.levelno >= logging.WARNING]


@needs_abstract_sockets
async def test_where_listening_is_forbidden_nothing_is_missed(make_node, monkeypatch, caplog):
    async def forbidden(self, address):
        raise PermissionError("a sandbox")

    monkeypatch.setattr("aioros1.net.tcpros.Listener.listen_unix", forbidden)
    a, b = [await make_node(name, local_transports=("unix",)) for name in "ab"]
    assert await transport_between(a, b) == "TCPROS"
    assert not [each for each in caplog.records if each.levelno >= logging.WARNING]
