"""Who may connect to a node and a master, from where, and how often; others never notice."""

from __future__ import annotations

import asyncio
import contextlib
import sys
from collections.abc import AsyncIterator
from urllib.parse import urlsplit

import pytest

import aioros1
from aioros1.msg.std_msgs import String

from .peers import Wire, subscriber_header, until

pytestmark = pytest.mark.skipif(
    sys.platform != "linux", reason="needs a loopback network with more than one address"
)

HERE, ELSEWHERE = "127.0.0.1", "127.0.0.2"


@pytest.fixture
def each_address_is_a_host(monkeypatch):
    """As if the loopback addresses were different machines."""
    monkeypatch.setattr("aioros1.net.admission.host_of", str)
    monkeypatch.setattr("aioros1.net.admission.is_local", lambda address: False)


GET_PID = (
    b"POST / HTTP/1.1\r\nHost: x\r\nContent-Length: %d\r\n\r\n%s"
    % (len(call := b"<methodCall><methodName>getPid</methodName><params><param><value>/c</value>"
       b"</param></params></methodCall>"), call)
)  # fmt: skip


@contextlib.asynccontextmanager
async def dialled_from(source: str, port: int, *parts: bytes) -> AsyncIterator[Wire]:
    wire = Wire(*await asyncio.open_connection(HERE, port, local_addr=(source, 0)))
    try:
        with contextlib.suppress(ConnectionError):
            await wire.send(*parts)
        yield wire
    finally:
        wire.abort()
        await wire.close()


def ports(node: aioros1.Node) -> tuple[int, int]:
    port = urlsplit(node.uri).port
    assert port is not None
    return node.tcpros_address[1], port


async def is_answered(wire: Wire) -> bool:
    async with asyncio.timeout(30):
        return bool(await wire.reader.read(1))


# who


async def test_both_ports_of_a_node_turn_away_who_is_not_allowed(make_node, caplog):
    node = await make_node("talker", allow=[HERE])
    tcpros, xmlrpc = ports(node)
    async with node.advertise("chatter", String) as pub:
        for _ in range(3):
            async with dialled_from(ELSEWHERE, tcpros, subscriber_header()) as wire:
                assert await wire.is_closed()
            async with dialled_from(ELSEWHERE, xmlrpc, GET_PID) as wire:
                assert await wire.is_closed()
        assert (node.stats.connections_forbidden, node.stats.connections_refused) == (6, 0)
        assert pub.subscriber_count == 0
        async with dialled_from(HERE, xmlrpc, GET_PID) as wire:
            assert await is_answered(wire)
        listener = await make_node("listener", allow=["127.0.0.0/30"])
        async with listener.subscribe("chatter", String) as sub:
            await pub.wait_for_subscribers(timeout=30)
            pub.publish(data="hi")
            assert (await sub.get(timeout=30)).data == "hi"
    assert [record.getMessage() for record in caplog.records if "refused" in record.msg] == [
        f"refused a connection from {ELSEWHERE} to the {port} port: it is not in allow"
        for port in ("TCPROS", "XML-RPC")
    ]


async def test_a_master_turns_away_who_is_not_allowed(caplog):
    async with aioros1.Master("localhost", port=0, allow=[HERE]) as master:
        for _ in range(2):
            async with dialled_from(ELSEWHERE, master.port, GET_PID) as wire:
                assert await wire.is_closed()
        assert master.stats.connections_forbidden == 2
        async with aioros1.Node("node", master_uri=master.uri) as node:
            assert "/rosout" in (await node.graph.snapshot()).nodes
            aggregator = urlsplit(await node.master.lookup_node("/rosout")).port
            assert aggregator is not None
            async with dialled_from(ELSEWHERE, aggregator, GET_PID) as wire:
                assert await wire.is_closed()


async def test_a_node_needs_its_master_to_be_allowed(make_node):
    """The master is a caller like others: without it, news does not reach the node."""
    talker = await make_node("talker")
    listener = await make_node("listener", allow=[ELSEWHERE])
    async with listener.subscribe("chatter", String) as sub:
        await talker.advertise("chatter", String)
        await until(lambda: listener.stats.connections_forbidden)
        assert sub.publisher_count == 0


@pytest.mark.parametrize("transport", ["intraprocess", "unix"])
async def test_peers_past_tcp_are_of_this_host_and_allowed(make_node, transport):
    """What they ask for beforehand is asked over XML-RPC, where the list holds."""
    talker = await make_node("talker", allow=[HERE], local_transports=[transport])
    listener = await make_node("listener", local_transports=[transport])
    async with (
        talker.advertise("chatter", String) as pub,
        listener.subscribe("chatter", String) as sub,
    ):
        await pub.wait_for_subscribers(timeout=30)
        assert {info.transport for info in sub.connections} <= {"INTRAPROCESS", "UNIXROS"}
    assert talker.stats.connections_forbidden == 0


# how many


async def test_one_host_cannot_take_all_connections_of_a_node(make_node, each_address_is_a_host):
    node = await make_node("talker", limits=aioros1.Limits(connections_per_host=2))
    tcpros, xmlrpc = ports(node)
    async with node.advertise("chatter", String), contextlib.AsyncExitStack() as stack:
        for port, greeting in ((tcpros, subscriber_header()), (xmlrpc, GET_PID)):
            for _ in range(2):
                wire = await stack.enter_async_context(dialled_from(ELSEWHERE, port, greeting))
                assert await is_answered(wire)
            async with dialled_from(ELSEWHERE, port, greeting) as wire:
                assert await wire.is_closed()
            async with dialled_from(HERE, port, greeting) as wire:
                assert await is_answered(wire)
        assert node.stats.connections_refused == 2


async def test_a_master_with_all_its_connections_taken(caplog):
    limits = aioros1.Limits(xmlrpc_connections=2)
    async with aioros1.Master("localhost", port=0, rosout=False, limits=limits) as master:
        async with (
            dialled_from(HERE, master.port, GET_PID) as one,
            dialled_from(HERE, master.port, GET_PID) as two,
            dialled_from(HERE, master.port, GET_PID) as three,
        ):
            assert await three.is_closed()
            assert await is_answered(one)
            assert await is_answered(two)
            assert (master.stats.connections, master.stats.connections_refused) == (2, 1)
        await until(lambda: master.stats.connections == 0)
        async with dialled_from(HERE, master.port, GET_PID) as wire:
            assert await is_answered(wire)
    assert "there are 2 already (limits.xmlrpc_connections)" in caplog.text


# how often


async def test_a_host_that_asks_a_master_too_often_delays_only_itself(
    make_node, each_address_is_a_host
):
    limits = aioros1.Limits(requests_per_second=0.001, requests_burst=200)
    async with (
        aioros1.Master("localhost", port=0, rosout=False, limits=limits) as master,
        dialled_from(ELSEWHERE, master.port, GET_PID * 201) as greedy,
    ):
        await until(lambda: master.stats.requests_delayed == 1)
        node = await make_node("node", master_uri=master.uri, heartbeat=None)
        await node.set_param("a", 1)
        assert await node.get_param("a") == 1
        assert await is_answered(greedy)  # what came before


async def test_a_node_that_has_to_wait_is_registered_all_the_same(make_node):
    limits = aioros1.Limits(requests_per_second=100, requests_burst=1)
    async with aioros1.Master("localhost", port=0, rosout=False, limits=limits) as master:
        nodes = [await make_node(f"node{n}", master_uri=master.uri) for n in range(3)]
        await asyncio.gather(
            *(node.advertise(f"~topic{number}", String) for node in nodes for number in range(5))
        )
        assert len((await nodes[0].graph.snapshot()).topics) >= 15
        assert master.stats.requests_delayed > 0


async def test_a_node_has_the_same_limits_for_its_slave_api(make_node, each_address_is_a_host):
    limits = aioros1.Limits(requests_per_second=0.001, requests_burst=3)
    node = await make_node("node", limits=limits)
    _, xmlrpc = ports(node)
    async with dialled_from(ELSEWHERE, xmlrpc, GET_PID * 4):
        await until(lambda: node.stats.requests_delayed == 1)
        async with dialled_from(HERE, xmlrpc, GET_PID) as wire:
            assert await is_answered(wire)


# what is in them


async def test_a_parameter_of_too_many_values_is_refused_and_named(make_node):
    limits = aioros1.Limits(xmlrpc_values=100)
    async with aioros1.Master("localhost", port=0, rosout=False, limits=limits) as master:
        node = await make_node("node", master_uri=master.uri)
        await node.set_param("fits", list(range(97)))  # beside the caller, the key and a list
        with pytest.raises(aioros1.MasterError, match="more than 100 values"):
            await node.set_param("too_many", list(range(98)))
        assert not await node.has_param("too_many")
        await node.set_param("readable", list(range(96)))  # beside two lists and two values
        careful = await make_node("careful", master_uri=master.uri, limits=limits)
        assert await careful.get_param("readable") == list(range(96))
        with pytest.raises(aioros1.MasterError, match="more than 100 values"):
            await careful.get_param("fits", "not the default: it is set, but cannot be read")
        assert await node.get_param("fits") == list(range(97))


async def test_limits_are_for_what_others_send(make_node):
    node = await make_node("node", limits=aioros1.Limits(xmlrpc_values=100))
    other = await make_node("other")
    await node.set_param("many", list(range(1000)))
    assert await other.get_param("many") == list(range(1000))


# wrong values


def test_networks_that_are_none():
    for make in (
        lambda: aioros1.Node("node", allow=["10.0.0.5/8"]),
        lambda: aioros1.Master(allow=["10.0.0.5/8"]),
    ):
        with pytest.raises(ValueError, match=r"allow: '10\.0\.0\.5/8' has host bits"):
            make()
    with pytest.raises(ValueError, match=r"got the string '10\.0\.0\.0/8'"):
        aioros1.Node("node", allow="10.0.0.0/8")


def test_the_list_as_it_was_understood_is_in_the_options():
    node = aioros1.Node("node", allow=["10.0.0.5", "::ffff:10.1.0.0/112", "fd00::/8"])
    assert node.options.allow == ("10.0.0.5/32", "10.1.0.0/16", "fd00::/8")
    assert aioros1.Node("node").options.allow is None


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("connections", 0),
        ("connections_per_host", -1),
        ("xmlrpc_connections", True),
        ("xmlrpc_values", 1.5),
        ("xmlrpc_timeout", 0),
        ("xmlrpc_timeout", None),
        ("message_bytes", "1 MB"),
        ("requests_per_second", 0),
        ("requests_per_second", float("nan")),
        ("requests_burst", 0.5),
    ],
)
def test_limits_that_are_none(name, value):
    with pytest.raises(ValueError, match=rf"limits\.{name} must be a positive") as caught:
        aioros1.Limits(**{name: value})
    assert str(caught.value).endswith(f"got {value!r}")
