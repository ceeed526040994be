"""Nodes behind proxies that misbehave."""

from __future__ import annotations

import asyncio
import sys
import time

import pytest

import aioros1
from aioros1.msg.std_msgs import String, UInt8MultiArray
from aioros1.net.backoff import Backoff
from aioros1.srv.std_srvs import SetBool
from aioros1.testing import FlakyConnection, FlakyProxy, proxies_before
from aioros1.topics import subscription

from .ends import PATIENCE

pytestmark = pytest.mark.skipif(
    not sys.platform.startswith("linux"), reason="needs all of 127.0.0.0/8"
)


@pytest.fixture(autouse=True)
def quick(monkeypatch):
    """Connections are tried again sooner than usual."""
    monkeypatch.setattr(subscription, "Backoff", lambda: Backoff(0.01, 0.05))


@pytest.fixture
async def talker(make_node):
    """A node that tells others another address than the one at which it listens."""
    return await make_node("talker", host="127.0.0.2", bind="127.0.0.1")


@pytest.fixture
async def proxies(talker):
    async with proxies_before(talker) as proxies:
        yield proxies


@pytest.fixture
async def listener(make_node):
    return await make_node("listener")


@pytest.fixture
async def pub(talker, proxies):
    async with talker.advertise("chatter", String, latch=True) as pub:
        yield pub


@pytest.fixture
async def sub(pub, listener):
    async with listener.subscribe("chatter", String) as sub:
        pub.publish(data="first")
        assert (await sub.get(timeout=PATIENCE)).data == "first"
        yield sub


async def test_everybody_connects_through_the_proxies(talker, proxies, sub):
    assert (proxies.tcpros.host, proxies.tcpros.port) == talker.tcpros_address
    assert talker.uri == f"http://{proxies.slave_api.host}:{proxies.slave_api.port}/"
    assert len(proxies.tcpros.connections) == 1
    assert proxies.slave_api.accepted >= 1
    assert proxies.tcpros.connections[0].bytes_down > len("first")


async def test_a_subscriber_whose_connection_is_cut_comes_back(proxies, pub, sub):
    for _ in range(3):
        accepted = proxies.tcpros.accepted
        proxies.cut()
        async with asyncio.timeout(PATIENCE):
            await proxies.tcpros.wait_accepted(accepted + 1)
        assert (await sub.get(timeout=PATIENCE)).data == "first"  # it is latched
    assert sub.stats.messages == 4


async def test_a_subscriber_comes_back_when_it_is_no_longer_refused(proxies, pub, sub):
    proxies.tcpros.refuse()
    proxies.tcpros.cut()
    async with asyncio.timeout(PATIENCE):
        while sub.publisher_count:
            await asyncio.sleep(0.002)
    proxies.tcpros.accept()
    assert (await sub.get(timeout=PATIENCE)).data == "first"


async def cut_after(connection: FlakyConnection, bytes: int) -> None:
    """Cut it when so many more bytes have come down."""
    await connection.passed(connection.bytes_down + bytes, "down")
    connection.cut()


async def test_half_a_message_is_none(talker, proxies, listener):
    async with (
        talker.advertise("chatter", String) as pub,
        listener.subscribe("chatter", String) as sub,
    ):
        await pub.wait_for_subscribers(timeout=PATIENCE)
        await sub.wait_for_publishers(timeout=PATIENCE)
        cutting = asyncio.create_task(cut_after(proxies.tcpros.connections[0], 10))
        await asyncio.sleep(0)
        pub.publish(data="lost in the middle")
        async with asyncio.timeout(PATIENCE):
            await cutting
            await proxies.tcpros.wait_accepted(2)
            while not sub.queued:
                pub.publish(data="whole")
                await asyncio.sleep(0.002)
        assert sub.get_nowait().data == "whole"


async def test_a_stalled_subscriber_is_its_own_problem(talker, proxies, listener):
    """The talker's queue for it overflows, and that is counted; another one hears all."""
    async with (
        talker.advertise("blocks", UInt8MultiArray, queue_size=2) as pub,
        talker.subscribe("blocks", UInt8MultiArray, queue_size=1000) as other,
        listener.subscribe("blocks", UInt8MultiArray, queue_size=1000) as sub,
    ):
        await pub.wait_for_subscribers(2, timeout=PATIENCE)
        await sub.wait_for_publishers(timeout=PATIENCE)
        theirs = sub.connections[0].local[1]
        (stalled,) = [each for each in proxies.tcpros.connections if each.client[1] == theirs]
        stalled.stall("down")
        for _ in range(40):
            pub.publish(data=bytes(1 << 20))
            assert len((await other.get(timeout=PATIENCE)).data) == 1 << 20
        assert pub.dropped > 0
        assert other.dropped == 0
        assert sub.stats.messages == 0
        stalled.resume()
        for _ in range(40 - pub.dropped):
            await sub.get(timeout=PATIENCE)


async def test_a_subscriber_that_stalls_too_long_is_disconnected(make_node, listener):
    impatient = aioros1.Timeouts(stall=0.2)
    node = await make_node("talker", host="127.0.0.2", bind="127.0.0.1", timeouts=impatient)
    async with (
        proxies_before(node) as proxies,
        node.advertise("blocks", UInt8MultiArray, queue_size=100) as pub,
        listener.subscribe("blocks", UInt8MultiArray, queue_size=100) as sub,
    ):
        await pub.wait_for_subscribers(timeout=PATIENCE)
        proxies.tcpros.stall("down")
        for _ in range(40):
            pub.publish(data=bytes(1 << 20))
        async with asyncio.timeout(PATIENCE):
            while pub.subscriber_count:
                await asyncio.sleep(0.002)
        proxies.tcpros.resume()
        await pub.wait_for_subscribers(timeout=PATIENCE)
        await sub.wait_for_publishers(timeout=PATIENCE)


@pytest.mark.parametrize("way", ["up", "down"])
async def test_a_corrupted_handshake_is_tried_again(proxies, pub, listener, way):
    proxies.tcpros.corrupt(1, way)
    async with listener.subscribe("chatter", String) as sub:
        pub.publish(data="right")
        async with asyncio.timeout(PATIENCE):
            await proxies.tcpros.wait_accepted(3)
        assert sub.stats.messages == 0
        proxies.tcpros.corrupt(0)
        assert (await sub.get(timeout=PATIENCE)).data == "right"


async def test_messages_that_come_slowly_and_late_are_whole(proxies, pub, listener):
    proxies.tcpros.throttle(20_000)
    proxies.tcpros.delay(0.02)
    proxies.slave_api.delay(0.02)
    start = time.monotonic()
    async with listener.subscribe("chatter", String) as sub:
        pub.publish(data="x" * 4000)
        assert (await sub.get(timeout=PATIENCE)).data == "x" * 4000
    assert time.monotonic() - start >= 0.15


async def test_a_slave_api_that_is_silent_for_a_while(proxies, pub, listener):
    proxies.slave_api.stall()
    async with listener.subscribe("chatter", String) as sub:
        pub.publish(data="hello")
        async with asyncio.timeout(PATIENCE):
            await proxies.slave_api.wait_accepted(1)
        assert proxies.tcpros.accepted == 0
        proxies.slave_api.resume()
        assert (await sub.get(timeout=PATIENCE)).data == "hello"


# services


@pytest.fixture
async def calls(talker, proxies):
    """The requests that reached the service."""
    calls = []

    async def flip(request):
        calls.append(request.data)
        return {"success": not request.data}

    async with talker.advertise_service("flip", SetBool, flip):
        yield calls


async def test_a_call_to_a_service_that_says_nothing_ends_in_time(listener, proxies, calls):
    proxies.tcpros.half_open()
    with pytest.raises(TimeoutError):
        await listener.call("flip", SetBool, data=True, timeout=0.1)
    proxies.tcpros.half_open(False)
    assert not (await listener.call("flip", SetBool, data=True, timeout=PATIENCE)).success
    assert calls == [True]


async def test_a_call_to_a_service_that_refuses(listener, proxies, calls):
    proxies.tcpros.refuse()
    with pytest.raises(aioros1.ServiceUnavailable):
        await listener.call("flip", SetBool, data=True, timeout=PATIENCE)
    assert calls == []


async def test_a_call_whose_answer_is_cut_is_not_sent_again(listener, proxies, calls):
    async with listener.service_caller("flip", SetBool, persistent=True) as caller:
        await caller.call(data=False, timeout=PATIENCE)
        cutting = asyncio.create_task(cut_after(proxies.tcpros.connections[0], 1))
        await asyncio.sleep(0)
        with pytest.raises(ConnectionError):
            await caller.call(data=True, timeout=PATIENCE)
        await cutting
        assert calls == [False, True]
        assert not (await caller.call(data=True, timeout=PATIENCE)).success
    assert calls == [False, True, True]


# the master


async def test_a_proxy_before_a_master(master, make_node):
    port = int(master.uri.rstrip("/").rpartition(":")[2])
    async with FlakyProxy("localhost", port) as proxy:
        uri = f"http://{proxy.host}:{proxy.port}"
        node = await make_node("careful", master_uri=uri, heartbeat=0.02)
        await node.advertise("chatter", String)
        events = node.events()
        proxy.refuse()
        proxy.cut()
        async with asyncio.timeout(PATIENCE):
            async for event in events:
                if isinstance(event, aioros1.MasterLost):
                    break
        proxy.accept()
        await node.wait_for_master(timeout=PATIENCE)
        assert await node.master.lookup_node("/careful") == node.uri
        await node.close()


# mistakes


@pytest.mark.parametrize(
    "addresses",
    [
        {"host": "127.0.0.1", "bind": "127.0.0.1"},
        {"host": "127.0.0.1", "bind": "localhost"},
        {"host": "127.0.0.2", "bind": "0.0.0.0"},
        {"host": "127.0.0.2"},
        {"host": "localhost", "bind": "127.0.0.1"},
    ],
)
async def test_a_node_at_one_address_is_refused(make_node, addresses):
    node = await make_node("plain", **addresses)
    with pytest.raises(ValueError, match=r"expected a node whose host and bind "):
        async with proxies_before(node):
            pass


async def test_a_node_that_is_not_started_is_refused():
    node = aioros1.Node("later", host="127.0.0.2", bind="127.0.0.1")
    with pytest.raises(RuntimeError, match="needs a node that is started"):
        async with proxies_before(node):
            pass


async def test_another_system_is_refused(talker, monkeypatch):
    monkeypatch.setattr(sys, "platform", "darwin")
    with pytest.raises(RuntimeError, match=r"needs Linux .*, not darwin"):
        async with proxies_before(talker):
            pass


async def test_a_port_that_is_taken(talker, proxies):
    with pytest.raises(OSError, match=r"cannot listen on 127\.0\.0\.2:"):
        async with proxies_before(talker):
            pass
