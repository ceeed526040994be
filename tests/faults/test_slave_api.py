"""Right and wrong requests to the slave API of a node."""

from __future__ import annotations

import asyncio
import re

import pytest

import aioros1
from aioros1.msg.std_msgs import String
from aioros1.srv.std_srvs import SetBool
from aioros1.wire.xmlrpc import XmlRpcFault
from aioros1.xmlrpc.client import XmlRpcClient
from aioros1.xmlrpc.node_proxy import NodeProxy
from aioros1.xmlrpc.server import XmlRpcServer

from .peers import (
    caller_header,
    dialled,
    flip_answer,
    flip_request,
    string,
    subscriber_header,
    until,
)


@pytest.fixture
async def node(make_node):
    return await make_node("talker")


@pytest.fixture
async def bystander(bystander_of, node):
    return await bystander_of(node)


@pytest.fixture
async def pub(node):
    async with node.advertise("chatter", String) as pub:
        yield pub


UDPROS = ["UDPROS", "", "127.0.0.1", 1, 1500]


@pytest.mark.parametrize("protocols", [[["FOO"]], [["tcpros"]], [["FOO", 1], ["BAR"]]])
async def test_request_topic_without_a_common_protocol_answers_0(node, pub, ask, protocols):
    code, status, value = await ask(node, "requestTopic", "/chatter", protocols)
    assert (code, value) == (0, [])
    assert status


@pytest.mark.parametrize("topic", ["/unknown", "/calm/in", "chatter", "~"])
async def test_request_topic_for_an_unpublished_topic_answers_minus_1(
    node, pub, bystander, ask, topic
):
    code, status, _ = await ask(node, "requestTopic", topic, [["TCPROS"]])
    assert code == -1
    assert topic in status
    assert await bystander.is_served()


@pytest.mark.parametrize("protocols", ["TCPROS", [], {}, 1, ""])
async def test_request_topic_with_protocols_that_are_not_a_list_is_refused(
    node, pub, bystander, ask, protocols
):
    code, status, _ = await ask(node, "requestTopic", "/chatter", protocols)
    assert code == -1
    assert "protocols" in status
    assert await bystander.is_served()


@pytest.mark.parametrize("protocols", [[[]], ["TCPROS"], [1], [[[]]], [[{}]]])
async def test_request_topic_with_unknown_protocols_answers_0(node, pub, ask, protocols):
    code, status, _ = await ask(node, "requestTopic", "/chatter", protocols)
    assert code == -1
    assert "protocols" in status


@pytest.mark.parametrize("topic", ["", 1, [], {}])
async def test_request_topic_with_an_invalid_name_is_refused(node, pub, ask, topic):
    assert (await ask(node, "requestTopic", topic, [["TCPROS"]]))[0] == -1


async def test_request_topic_for_udpros_alone_answers_0(node, pub, ask):
    assert (await ask(node, "requestTopic", "/chatter", [UDPROS]))[0] == 0


@pytest.mark.parametrize(
    "before", [[UDPROS], [["UDPROS"]], [[]], [5], ["TCPROS"], [["FOO"], UDPROS]]
)
async def test_request_topic_skips_the_protocols_it_does_not_know(node, pub, ask, before):
    answer = await ask(node, "requestTopic", "/chatter", [*before, ["TCPROS"]])
    host, port = node.tcpros_address
    assert answer == [1, "ready", ["TCPROS", host, port]]


async def test_bus_stats_count_what_was_sent_and_received(node, pub, ask, make_node):
    other = await make_node("listener")
    async with (
        other.subscribe("chatter", String) as sub,
        node.advertise_service("flip", SetBool, lambda request: {"success": True}),
        dialled(node, caller_header(), flip_request(True)) as wire,
    ):
        await wire.read_header()
        assert (await wire.answer())[0] == 1
        await pub.wait_for_subscribers(timeout=30)
        for _ in range(3):
            pub.publish(data="hi")
            await sub.get(timeout=30)
        sent, received = 3 * len(string("hi")), len(flip_answer(True))
        code, _, (publish, subscribe, service) = await ask(node, "getBusStats")
        assert code == 1
        (connection,) = pub.connections
        assert publish == [["/chatter", sent, [[connection.id, sent, 3, True]]]]
        assert subscribe == []
        assert service == [1, len(flip_request(True)), received]
        code, _, (publish, subscribe, service) = await ask(other, "getBusStats")
        assert (code, publish, service) == (1, [], [0, 0, 0])
        (connection,) = sub.connections
        assert subscribe == [["/chatter", [[connection.id, sent, 3, -1, True]]]]


@pytest.mark.parametrize(
    "answer",
    [
        [[["/chatter", 10, [[1, 10, 2, True]]]], []],  # of roscpp: no triple at all
        [1, "", [[["/chatter", 10, [[1, 10, 2, True]]]], [], []]],
        [1, "", [[["/chatter", 10, [[1, 10, 2, True]]]], [["/a", [[1, 2, 3, True]]]], [0, 0, 0]]],
    ],
    ids=["roscpp", "rospy", "documented"],
)
async def test_bus_stats_of_others_are_understood(answer):
    server = XmlRpcServer({"getBusStats": lambda caller_id: answer})
    await server.start("127.0.0.1")
    client = XmlRpcClient()
    try:
        stats = await NodeProxy(client, f"http://127.0.0.1:{server.port}/", "/x").get_bus_stats()
    finally:
        await client.close()
        await server.close()
    (published,) = stats.publish
    assert published.topic == "/chatter"
    assert published.connections[0].bytes_sent == 10


async def test_bus_info_has_a_row_for_each_connection(node, pub, ask, make_node):
    other = await make_node("listener")
    async with (
        other.subscribe("chatter", String) as sub,
        node.advertise_service("flip", SetBool, lambda request: None),
        other.service_caller("flip", SetBool, persistent=True) as caller,
    ):
        await pub.wait_for_subscribers(timeout=30)
        await sub.wait_for_publishers(timeout=30)
        await caller.call(data=True)
        _, _, rows = await ask(node, "getBusInfo")
        assert [row[1:6] for row in rows] == [
            ["/listener", "o", "TCPROS", "/chatter", True],
            ["/listener", "b", "TCPROS", "/flip", True],
        ]
        _, _, rows = await ask(other, "getBusInfo")
        assert [row[1:6] for row in rows] == [
            [node.uri, "i", "TCPROS", "/chatter", True],
            ["/talker", "b", "TCPROS", "/flip", True],
        ]
        # rosnode info takes the addresses from the text.
        text = r"TCPROS connection on port \d+ to \[127\.0\.0\.1:\d+ on socket \d+\]"
        assert all(re.fullmatch(text, row[6]) for row in rows)
        assert len({row[0] for row in rows}) == len(rows)
    await until(lambda: not pub.connections)
    assert (await ask(node, "getBusInfo"))[2] == []


async def test_bus_info_survives_a_peer_whose_name_xml_cannot_carry(node, pub, ask):
    """Whoever connects chooses its name, and all others are shown as ever."""
    async with (
        dialled(node, subscriber_header(callerid="/a\0")),
        dialled(node, subscriber_header(callerid="/b\udcff")),
        dialled(node, subscriber_header(callerid="/é<")),
    ):
        await pub.wait_for_subscribers(3, timeout=30)
        code, _, rows = await ask(node, "getBusInfo")
        assert (code, {row[1] for row in rows}) == (1, {"/a?", "/b?", "/é<"})
        assert {info.peer for info in pub.connections} == {"/a\0", "/b\udcff", "/é<"}


async def test_publisher_update_for_an_unknown_topic_is_accepted(node, bystander, ask):
    code, _, _ = await ask(node, "publisherUpdate", "/unknown", ["http://127.0.0.1:1/"])
    assert code == 1
    assert await bystander.is_served()


@pytest.mark.parametrize("publishers", ["bad", ["bad"], [1], {}, 5, [["http://127.0.0.1:1/"]]])
async def test_publisher_update_with_invalid_publishers_is_refused(
    node, bystander, ask, publishers
):
    code, status, _ = await ask(node, "publisherUpdate", "/calm/in", publishers)
    assert code == -1
    assert "publishers" in status
    assert await bystander.is_served()


@pytest.mark.parametrize("uri", ["http://", "http://[", "http://x:y/", "http://a..b/", "http:// "])
async def test_publisher_update_survives_uris_that_lead_nowhere(node, bystander, ask, uri):
    async with node.subscribe("chatter", String):
        assert (await ask(node, "publisherUpdate", "/chatter", [uri]))[0] in (1, -1)
        assert await bystander.is_served()
        assert (await ask(node, "publisherUpdate", "/chatter", []))[0] == 1


@pytest.mark.parametrize("key", ["/unknown", "/unknown/", "/", "relative", "", 5])
async def test_param_update_for_a_key_that_is_not_followed_is_refused(node, bystander, ask, key):
    assert (await ask(node, "paramUpdate", key, 1))[0] == -1
    assert await bystander.is_served()


@pytest.mark.parametrize("key", ["/limits", "/limits/"])
async def test_param_update_for_a_followed_key_is_accepted(node, ask, key):
    async with node.subscribe_param("limits") as param:
        assert (await ask(node, "paramUpdate", key, {"speed": 1}))[0] == 1
        assert param.value == {"speed": 1}
        assert (await ask(node, "paramUpdate", "/limits/arm/force/", 2))[0] == 1
        assert param.value == {"speed": 1, "arm": {"force": 2}}
        assert (await ask(node, "paramUpdate", "/limits_of_others/", 3))[0] == -1
    assert (await ask(node, "paramUpdate", key, 1))[0] == -1


async def test_the_master_forgets_a_parameter_that_is_no_longer_followed(node, make_node):
    other = await make_node("other")
    async with node.subscribe_param("limits"), node.subscribe_param("limits/speed"):
        await other.set_param("/limits/speed", 1)
        assert await other.master.lookup_node("/talker") == node.uri
    with pytest.raises(aioros1.MasterError):  # it has no other business there
        await other.master.lookup_node("/talker")


@pytest.mark.parametrize("reason", [("go home",), ("",), ()])
async def test_shutdown_is_answered_and_then_obeyed(node, ask, reason):
    assert (await ask(node, "shutdown", *reason))[0] == 1
    async with asyncio.timeout(30):
        why = await node.wait_closed()
    assert "/asker" in why
    assert "".join(reason) in why
    assert not node.is_open


@pytest.mark.parametrize("reason", [5, [], {}])
async def test_shutdown_with_a_reason_that_is_not_a_string_is_refused(node, bystander, ask, reason):
    assert (await ask(node, "shutdown", reason))[0] == -1
    assert await bystander.is_served()


@pytest.mark.parametrize("name", ["/other", "/talker/below", "/talk", "/"])
async def test_a_shutdown_that_is_meant_for_another_node_is_ignored(node, bystander, ask, name):
    """A master sends it to where that node was, and this one may have its port now."""
    reason = f"[{name}] Reason: new node registered with same name"
    code, text, _ = await ask(node, "shutdown", reason)
    assert code == -1
    assert f"this is /talker, not {name}" in text
    assert node.is_open


@pytest.mark.parametrize("text", ["new node registered with same name", "anything", ""])
async def test_a_shutdown_that_names_this_node_is_obeyed(node, ask, text):
    await ask(node, "shutdown", f"[{node.name}] Reason: {text}")
    async with asyncio.timeout(30):
        assert text in await node.wait_closed()


async def test_shutdown_ends_every_role_of_the_node(node, pub, ask, master):
    async with dialled(node, subscriber_header()) as wire:
        await wire.read_header()
        await ask(node, "shutdown", "enough")
        assert await wire.is_closed()
        await node.wait_closed()


async def test_name_uri_pid_and_master_uri_are_answered(node, ask, master):
    assert (await ask(node, "getName"))[::2] == [1, "/talker"]
    assert (await ask(node, "getUri"))[::2] == [1, node.uri]
    assert (await ask(node, "getPid"))[::2] == [1, node.pid]
    assert (await ask(node, "getMasterUri"))[::2] == [1, master.uri]


async def test_the_node_says_what_it_publishes_and_subscribes_to(node, pub, ask):
    async with node.subscribe("anything"):
        assert (await ask(node, "getPublications"))[2] == [["/chatter", "std_msgs/String"]]
        assert (await ask(node, "getSubscriptions"))[2] == [["/anything", "*"]]
    assert (await ask(node, "getSubscriptions"))[2] == []


async def test_a_storm_of_announcements_leaves_one_connection(node, make_publisher, bystander, ask):
    fake = await make_publisher(register=False)
    async with node.subscribe("chatter", String) as sub:
        await ask(node, "publisherUpdate", "/chatter", [fake.uri] * 5)
        wire = await fake.subscribed()
        await wire.send(string("before"))
        assert (await sub.get(timeout=30)).data == "before"
        for _ in range(100):
            await ask(node, "publisherUpdate", "/chatter", [])
            await ask(node, "publisherUpdate", "/chatter", [fake.uri, fake.uri])
        assert await bystander.is_served()
        assert fake.dials == 1
        assert sub.publisher_count == 1
        await wire.send(string("after"))
        assert (await sub.get(timeout=30)).data == "after"


async def test_a_flood_of_equal_announcements_leaves_one_connection(node, make_publisher, ask):
    fake = await make_publisher(register=False)
    async with node.subscribe("chatter", String) as sub:
        await asyncio.gather(
            *(ask(node, "publisherUpdate", "/chatter", [fake.uri] * 3) for _ in range(100))
        )
        wire = await fake.subscribed()
        await wire.send(string("hi"))
        assert (await sub.get(timeout=30)).data == "hi"
        assert (fake.requests, fake.dials) == (1, 1)


@pytest.mark.parametrize("method", ["_node", "__class__", "methods", "get_pid", "getPid.x", ""])
async def test_only_the_methods_of_the_api_can_be_called(node, bystander, ask, method):
    with pytest.raises(XmlRpcFault, match="not supported"):
        await ask(node, method)
    assert await bystander.is_served()


@pytest.mark.parametrize(
    ("method", "params"),
    [("requestTopic", ()), ("requestTopic", ("/a",)), ("getPid", (1,)), ("paramUpdate", ("/a",))],
)
async def test_a_wrong_number_of_parameters_is_answered_with_a_triple(node, ask, method, params):
    code, status, _ = await ask(node, method, *params)
    assert code == -1
    assert status
