"""Asking other nodes, and being asked: the slave API from both sides."""

from __future__ import annotations

import asyncio
import os

import pytest

import aioros1
from aioros1.msg.std_msgs import String
from aioros1.srv.roscpp_tutorials import TwoInts
from aioros1.xmlrpc.client import XmlRpcClient


@pytest.fixture
async def peer(pair, until):
    """What ``/listener`` sees of ``/talker``, from which it has heard two messages."""
    talker, listener = pair
    pub = await talker.advertise("chatter", String)
    await talker.subscribe("orders", String)
    sub = await listener.subscribe("chatter", String)
    await pub.wait_for_subscribers(timeout=30)
    pub.publish(data="one")
    pub.publish(data="two")
    await until(lambda: sub.stats.messages == 2)
    return await listener.peer("/talker")


async def test_cRosApiGetBusStats(peer):
    """cROS answers with nothing; here the numbers are those of the connections."""
    stats = await peer.get_bus_stats()
    [published] = stats.publish
    assert (published.topic, published.bytes_published) == ("/chatter", 22)
    [subscribed] = stats.subscribe
    assert (subscribed.topic, subscribed.connections) == ("/orders", [])


async def test_BusStats_TopicPubStats_and_PubConnectionData(peer):
    [published] = (await peer.get_bus_stats()).publish
    [connection] = published.connections
    assert connection.connection_id > 0
    assert (connection.bytes_sent, connection.num_sent, connection.connected) == (22, 2, True)


async def test_BusStats_TopicSubStats_and_SubConnectionData(peer, pair):
    talker, _ = pair
    [subscribed] = (await (await talker.peer("/listener")).get_bus_stats()).subscribe
    assert subscribed.topic == "/chatter"
    [connection] = subscribed.connections
    assert (connection.bytes_received, connection.num_received) == (22, 2)
    assert (connection.drop_estimate, connection.connected) == (-1, True)


async def test_BusStats_ServiceStats(peer, pair):
    talker, listener = pair
    await talker.advertise_service("add", TwoInts, lambda request: {"sum": 0})
    await listener.call("add", TwoInts, a=1, b=2, timeout=30)
    stats = (await peer.get_bus_stats()).service
    assert (stats.num_requests, stats.bytes_received, stats.bytes_sent) == (1, 20, 13)


async def test_cRosApiGetBusInfo(peer, pair):
    talker, _ = pair
    [info] = await peer.get_bus_info()
    assert info.connection_id == talker.connections[0].id
    assert (info.destination, info.topic, info.connected) == ("/listener", "/chatter", True)


async def test_CrosTransportType_is_TCPROS(peer):
    [info] = await peer.get_bus_info()
    assert info.transport == "TCPROS"
    with pytest.raises(aioros1.PeerError) as caught:
        await peer.request_topic("/chatter", [["UDPROS", "header", "127.0.0.1", 9, 1500]])
    assert caught.value.code == 0


@pytest.mark.parametrize(
    ("name", "direction"), [("/talker", "o"), ("/listener", "i")], ids=["OUT", "IN"]
)
async def test_CrosTransportDirection(peer, pair, name, direction):
    [info] = await (await pair[0].peer(name)).get_bus_info()
    assert info.direction == direction


async def test_CrosTransportDirection_BOTH(peer, pair):
    talker, listener = pair
    provider = await talker.advertise_service("add", TwoInts, lambda request: {"sum": 0})
    async with listener.service_caller("add", TwoInts, persistent=True) as caller:
        await caller.call(a=1, b=2, timeout=30)
        rows = [info for info in await peer.get_bus_info() if info.topic == provider.name]
        assert [row.direction for row in rows] == ["b"]


async def test_cRosApiGetMasterUri(peer, master):
    assert await peer.get_master_uri() == master.uri


async def test_cRosApiShutdown(peer, pair):
    """cROS ignores the request; here the node ends, and says why."""
    talker, _ = pair
    await peer.shutdown("enough")
    reason = await asyncio.wait_for(talker.wait_closed(), 30)
    assert reason == "[/listener] enough"
    with pytest.raises(aioros1.PeerUnreachable):
        await peer.get_pid()


async def test_cRosApiGetPid(peer):
    assert await peer.get_pid() == os.getpid()


async def test_cRosApiGetPid_is_a_ping(peer):
    assert await peer.ping() > 0


async def test_cRosApiGetSubscriptions(peer):
    assert await peer.get_subscriptions() == [("/orders", "std_msgs/String")]


async def test_cRosApiGetPublications(peer):
    assert await peer.get_publications() == [("/chatter", "std_msgs/String")]


async def test_host_NULL_is_the_master(pair, master):
    """The calls that cROS sends to the master when no host is given."""
    node, _ = pair
    assert await node.master.get_pid() == os.getpid()
    assert await node.master.get_uri() == master.uri


async def test_host_is_found_by_the_name_of_the_node(pair):
    talker, listener = pair
    await talker.advertise("chatter", String)
    peer = await listener.peer("talker")
    assert (peer.name, peer.uri) == ("/talker", talker.uri)
    with pytest.raises(aioros1.MasterError):
        await listener.peer("/nobody")


# ------------------------------------------------------------------ being asked


@pytest.mark.parametrize(
    ("method", "params", "answer"),
    [
        ("getMasterUri", (), lambda node: node.master_uri),
        ("getPid", (), lambda node: os.getpid()),
        ("getSubscriptions", (), lambda node: [["/orders", "std_msgs/String"]]),
        ("getPublications", (), lambda node: [["/chatter", "std_msgs/String"]]),
        ("getName", (), lambda node: "/talker"),
        ("getUri", (), lambda node: node.uri),
        ("publisherUpdate", ("/orders", []), lambda node: 0),
        (
            "requestTopic",
            ("/chatter", [["UDPROS"], ["TCPROS"]]),
            lambda node: ["TCPROS", *node.tcpros_address],
        ),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
async def test_slave_method(peer, pair, method, params, answer):
    assert await peer.call(method, *params) == answer(pair[0])


async def test_slave_method_getBusInfo(peer, pair):
    """The row is one that rosnode reads its ports from."""
    [connection] = pair[0].connections
    [row] = await peer.call("getBusInfo")
    assert row[:6] == [connection.id, "/listener", "o", "TCPROS", "/chatter", True]
    assert row[6] == (
        f"TCPROS connection on port {connection.local[1]} to "
        f"[{connection.remote[0]}:{connection.remote[1]} on socket {connection.fileno}]"
    )


async def test_slave_method_getBusStats(peer):
    publish, subscribe, service = await peer.call("getBusStats")
    assert publish[0][:2] == ["/chatter", 22]
    assert publish[0][2][0][1:] == [22, 2, True]
    assert subscribe == [["/orders", []]]
    assert service == [0, 0, 0]


async def test_slave_method_paramUpdate(peer, pair):
    talker, _ = pair
    async with talker.subscribe_param("rate", default=0) as psub:
        assert await peer.call("paramUpdate", "/rate/", 5) == 0
        assert psub.value == 5
    with pytest.raises(aioros1.PeerError, match="not subscribed"):
        await peer.call("paramUpdate", "/rate/", 6)


async def test_slave_method_publisherUpdate_connects(peer, pair):
    """A publisher that another node, and not the master, tells of."""
    [sub] = [role for role in pair[0].roles if isinstance(role, aioros1.Subscriber)]
    async with (
        aioros1.Master(host="localhost", port=0) as elsewhere,
        aioros1.Node("far", master_uri=elsewhere.uri, rosout=False) as far,
        far.advertise("orders", String, latch=True) as pub,
    ):
        pub.publish(data="go")
        assert await peer.call("publisherUpdate", "/orders", [far.uri]) == 0
        assert (await sub.get(timeout=30)).data == "go"


async def test_slave_method_shutdown(peer, pair):
    assert await peer.call("shutdown", "enough") == 0
    assert "enough" in await asyncio.wait_for(pair[0].wait_closed(), 30)


async def test_slave_method_system_multicall(peer, pair):
    """Several methods in one request; it takes no name of a caller."""
    talker, _ = pair
    calls = [
        {"methodName": "getPid", "params": ["/listener"]},
        {"methodName": "getUri", "params": ["/listener"]},
    ]
    client = XmlRpcClient()
    try:
        answers = await client.call(talker.uri, "system.multicall", calls)
    finally:
        await client.close()
    assert [answer[0][2] for answer in answers] == [os.getpid(), talker.uri]


@pytest.mark.parametrize("function", ["getMethodName", "getMethodCode", "isRosSlaveApi"])
async def test_method_that_nodes_do_not_have_is_a_fault(peer, function):
    for method in ("getEverything", "registerPublisher", ""):
        with pytest.raises(aioros1.PeerError):
            await peer.call(method)


async def test_slave_method_with_wrong_parameters_is_code_minus_one(peer):
    with pytest.raises(aioros1.PeerError) as caught:
        await peer.call("requestTopic", 5, "x")
    assert caught.value.code == -1
