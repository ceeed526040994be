"""Lists of publishers that anybody sends: long ones, and such that lead nowhere."""

from __future__ import annotations

import asyncio

import pytest

import aioros1
from aioros1.core import dialling
from aioros1.msg.std_msgs import String
from aioros1.net.backoff import Backoff
from aioros1.topics import subscription

from .peers import refusing, until


@pytest.fixture(autouse=True)
def quick(monkeypatch):
    monkeypatch.setattr(subscription, "Backoff", lambda: Backoff(0.01, 10.0))


@pytest.fixture
async def hung():
    """A server that accepts everybody and answers nobody; how many are connected."""
    writers: list[asyncio.StreamWriter] = []

    async def serve(reader, writer):
        writers.append(writer)
        try:
            await reader.read()
        finally:
            writers.remove(writer)
            writer.close()

    server = await asyncio.start_server(serve, "127.0.0.1", 0, backlog=1000)
    yield server.sockets[0].getsockname()[1], writers
    server.close()
    await until(lambda: not writers)


async def test_a_very_long_list_blocks_nobody(make_node, ask, bystander_of, caplog):
    node, talker = await make_node("listener"), await make_node("talker")
    bystander = await bystander_of(node)
    pub = await talker.advertise("chatter", String)
    sub = await node.subscribe("chatter", String)
    await pub.wait_for_subscribers(timeout=30)
    with refusing() as port:
        uris = [f"http://127.0.0.1:{port}/{number}" for number in range(30_000)]
        assert (await ask(node, "publisherUpdate", "/chatter", [talker.uri, *uris]))[0] == 1
        await bystander.is_served()
        pub.publish(data="still here")
        assert (await sub.get(timeout=30)).data == "still here"
        assert len(asyncio.all_tasks()) < 30_000
        assert (await ask(node, "publisherUpdate", "/chatter", [talker.uri]))[0] == 1
        await until(lambda: node.stats.publishers_followed <= 2)


async def test_few_connections_are_made_at_a_time(make_node, ask, hung, monkeypatch):
    port, writers = hung
    monkeypatch.setattr(dialling, "AT_ONCE", 5)
    node = await make_node("listener", timeouts=aioros1.Timeouts(xmlrpc=0.1))
    await node.subscribe("chatter", String)
    uris = [f"http://127.{number}.0.1:{port}/" for number in range(50)]
    most = 0
    await ask(node, "publisherUpdate", "/chatter", uris)
    for _ in range(50):
        most = max(most, len(writers))
        await asyncio.sleep(0.005)
    assert 0 < most <= 5


async def test_a_publisher_beyond_the_limit_is_heard_once_others_have_gone(make_node, ask):
    node = await make_node("listener", limits=aioros1.Limits(publishers=3))
    talker = await make_node("talker")
    pub = await talker.advertise("~chatter", String)
    await node.subscribe("talker/chatter", String)
    other = await node.subscribe("other", String)
    await pub.wait_for_subscribers(timeout=30)
    with refusing() as port:
        uris = [f"http://127.0.0.1:{port}/{number}" for number in range(10)]
        await ask(node, "publisherUpdate", "/other", uris)
        second = await make_node("second")
        await second.advertise("other", String)
        assert node.stats.publishers_followed == 3
    # The master has announced the second one alone, so that the others are left.
    await other.wait_for_publishers(timeout=30)


async def test_a_uri_without_end_is_left_out(make_node, ask):
    node, talker = await make_node("listener"), await make_node("talker")
    pub = await talker.advertise("~chatter", String)
    await node.subscribe("chatter", String)
    long = "http://" + "x" * 1_000_000
    assert (await ask(node, "publisherUpdate", "/chatter", [long, talker.uri]))[0] == 1
    assert node.stats.publishers_followed == 1
    assert pub.subscriber_count == 0


async def test_what_is_wrong_with_a_request_is_told_briefly(make_node, ask):
    node = await make_node("node")
    code, text, _ = await ask(node, "publisherUpdate", "/chatter", ["x" * 1_000_000])
    assert code == -1
    assert len(text) < 1_000
    code, text, _ = await ask(node, "requestTopic", "/" + "x" * 1_000_000, [["TCPROS"]])
    assert code == -1
    assert len(text) < 1_000
