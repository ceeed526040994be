"""Asking the master: cRosApiLookupNode and the like, their callbacks and results."""

from __future__ import annotations

import asyncio
import os

import pytest

import aioros1
from aioros1.msg.std_msgs import String
from aioros1.srv.std_srvs import Empty


@pytest.fixture
async def node(make_node):
    """A node that publishes, receives and provides, and has set a parameter."""
    node = await make_node("talker")
    await node.advertise("chatter", String)
    await node.subscribe("orders", String)
    await node.advertise_service("nothing", Empty, lambda request: None)
    await node.set_param("rate", 10)
    return node


async def test_cRosApiLookupNode(node):
    assert await node.master.lookup_node("/talker") == node.uri


async def test_cRosApiLookupNode_that_is_not_there(node):
    with pytest.raises(aioros1.MasterError, match="nobody"):
        await node.master.lookup_node("/nobody")


async def test_cRosApiGetPublishedTopics(node):
    topics = await node.master.get_published_topics()
    assert ("/chatter", "std_msgs/String") in topics
    assert "/orders" not in dict(topics)


async def test_cRosApiGetPublishedTopics_of_a_subgraph(node):
    async with node.advertise("arm/joint", String):
        topics = await node.master.get_published_topics("/arm")
        assert topics == [("/arm/joint", "std_msgs/String")]


async def test_cRosApiGetTopicTypes(node):
    types = dict(await node.master.get_topic_types())
    assert types["/chatter"] == types["/orders"] == "std_msgs/String"


async def test_cRosApiGetSystemState(node):
    state = await node.master.get_system_state()
    assert state.publishers["/chatter"] == ["/talker"]
    assert state.subscribers["/orders"] == ["/talker"]
    assert state.services["/nothing"] == ["/talker"]


async def test_cRosApiGetUri(node, master):
    assert await node.master.get_uri() == master.uri


async def test_cRosApiLookupService(node):
    host, port = node.tcpros_address
    assert await node.master.lookup_service("/nothing") == f"rosrpc://{host}:{port}"


async def test_cRosApiLookupService_that_is_not_there(node):
    with pytest.raises(aioros1.MasterError):
        await node.master.lookup_service("/something")


async def test_registerPublisher_and_unregisterPublisher(node, make_node):
    """Roles call these; tools may, too."""
    subscriber = await make_node("listener")
    await subscriber.subscribe("log", String)
    uris = await node.master.register_publisher("/log", "std_msgs/String", node.uri)
    assert uris == [subscriber.uri]
    assert await node.master.unregister_publisher("/log", node.uri) == 1
    assert await node.master.unregister_publisher("/log", node.uri) == 0


async def test_registerSubscriber_and_unregisterSubscriber(node, make_node):
    other = await make_node("other")
    uris = await other.master.register_subscriber("/chatter", "*", other.uri)
    assert uris == [node.uri]
    assert await other.master.unregister_subscriber("/chatter", other.uri) == 1
    assert await other.master.unregister_subscriber("/chatter", other.uri) == 0


async def test_registerService_and_unregisterService(node):
    uri = "rosrpc://127.0.0.1:9"
    await node.master.register_service("/more", uri, node.uri)
    assert await node.master.lookup_service("/more") == uri
    assert await node.master.unregister_service("/more", uri) == 1
    assert await node.master.unregister_service("/more", uri) == 0


# ------------------------------------------------------------------ callbacks and results

CALLS = {
    "LookupNodeCallback-LookupNodeResult": (
        lambda node: node.master.lookup_node("/talker"),
        lambda uri: "http://" in uri,
    ),
    "GetPublishedTopicsCallback-GetPublishedTopicsResult": (
        lambda node: node.master.get_published_topics(),
        lambda topics: ("/chatter", "std_msgs/String") in topics,
    ),
    "GetTopicTypesCallback-GetTopicTypesResult": (
        lambda node: node.master.get_topic_types(),
        lambda topics: (
            [pair.type for pair in topics if pair.name == "/chatter"] == ["std_msgs/String"]
        ),
    ),
    "GetSystemStateCallback-GetSystemStateResult": (
        lambda node: node.master.get_system_state(),
        lambda state: state.publishers["/chatter"] == ["/talker"],
    ),
    "GetUriCallback-GetUriResult": (
        lambda node: node.master.get_uri(),
        lambda uri: uri.startswith("http://"),
    ),
    "LookupServiceCallback-LookupServiceResult": (
        lambda node: node.master.lookup_service("/nothing"),
        lambda uri: uri.startswith("rosrpc://"),
    ),
    "GetBusStatsCallback-GetBusStatsResult": (
        lambda node: to_peer(node, "get_bus_stats"),
        lambda stats: [topic.topic for topic in stats.publish] == ["/chatter"],
    ),
    "GetBusInfoCallback-GetBusInfoResult": (
        lambda node: to_peer(node, "get_bus_info"),
        lambda info: info == [],
    ),
    "GetMasterUriCallback-GetMasterUriResult": (
        lambda node: to_peer(node, "get_master_uri"),
        lambda uri: "http://" in uri,
    ),
    "RequestShutdownCallback-RequestShutdownResult": (
        lambda node: to_peer(node, "shutdown", "enough"),
        lambda none: none is None,
    ),
    "GetPidCallback-GetPidResult": (
        lambda node: to_peer(node, "get_pid"),
        lambda pid: pid == os.getpid(),
    ),
    "GetSubscriptionsCallback-GetSubscriptionsResult": (
        lambda node: to_peer(node, "get_subscriptions"),
        lambda topics: topics == [("/orders", "std_msgs/String")],
    ),
    "GetPublicationsCallback-GetPublicationsResult": (
        lambda node: to_peer(node, "get_publications"),
        lambda topics: topics == [("/chatter", "std_msgs/String")],
    ),
    "DeleteParamCallback-DeleteParamResult": (
        lambda node: node.delete_param("/rate"),
        lambda none: none is None,
    ),
    "SetParamCallback-SetParamResult": (
        lambda node: node.set_param("/rate", 20),
        lambda none: none is None,
    ),
    "GetParamCallback-GetParamResult": (
        lambda node: node.get_param("/rate"),
        lambda value: value == 10,
    ),
    "SearchParamCallback-SearchParamResult": (
        lambda node: node.search_param("rate"),
        lambda key: key == "/rate",
    ),
    "HasParamCallback-HasParamResult": (
        lambda node: node.has_param("/rate"),
        lambda has: has is True,
    ),
    "GetParamNamesCallback-GetParamNamesResult": (
        lambda node: node.get_param_names(),
        lambda names: "/rate" in names,
    ),
}


async def to_peer(node, method, *args):
    return await getattr(await node.peer("/talker"), method)(*args)


@pytest.mark.parametrize("name", CALLS)
async def test_awaited_value_replaces_callback_and_result(node, name):
    """The value that is awaited is what the callback was given."""
    call, is_right = CALLS[name]
    assert is_right(await call(node))


async def test_callid_is_the_task(node):
    """What was asked can be given up, by cancelling whoever asks."""
    asking = [asyncio.create_task(node.master.get_uri()) for _ in range(3)]
    asking[1].cancel()
    answers = await asyncio.gather(*asking, return_exceptions=True)
    assert [isinstance(answer, str) for answer in answers] == [True, False, True]


async def test_Result_code_and_status_are_those_of_MasterError(node):
    with pytest.raises(aioros1.MasterError) as caught:
        await node.master.lookup_node("/nobody")
    assert caught.value.code == -1
    assert "nobody" in caught.value.status
    with pytest.raises(aioros1.MasterError) as caught:
        await node.master.call("getParam")
    assert caught.value.code == -1


async def test_TopicTypePair_is_TopicType(node):
    async with node.advertise("arm/joint", String):
        [pair] = await node.master.get_published_topics("/arm")
    assert (pair.name, pair.type) == pair == ("/arm/joint", "std_msgs/String")


async def test_ProviderState_is_a_dict_of_lists(node):
    for part in await node.master.get_system_state():
        assert isinstance(part, dict)
        assert all(isinstance(nodes, list) for nodes in part.values())


@pytest.mark.parametrize("function", ["cRosApiPrepareRequest", "cRosApiParseResponse"])
async def test_request_of_any_method(node, master, function):
    assert await node.master.call("getUri") == master.uri


async def test_isRosMasterApi(node):
    with pytest.raises(aioros1.MasterError, match="publisherUpdate"):
        await node.master.call("publisherUpdate", "/orders", [])
