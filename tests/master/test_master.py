"""A master as its users see it: over HTTP, and as an object."""

from __future__ import annotations

import asyncio
import gc
import os
import random
import re
import socket
import sys
import uuid
import warnings
from typing import Any
from urllib.parse import urlsplit

import aiohttp
import pytest

from aioros1.master import Master
from aioros1.master.process_id import process_id
from aioros1.node import Node
from aioros1.wire.xmlrpc import XmlRpcFault, decode_response
from aioros1.xmlrpc.client import XmlRpcClient

API = "http://127.0.0.1:1/"


async def post(master: Master, value: str, key: str = "/k", method: str = "setParam") -> Any:
    """A request with a value that our own client would not send."""
    body = (
        f"<methodCall><methodName>{method}</methodName><params><param><value>/c</value></param>"
        f"<param><value>{key}</value></param><param><value>{value}</value></param></params></methodCall>"
    )
    async with aiohttp.ClientSession() as session, session.post(master.uri, data=body) as response:
        assert response.status == 200
        return decode_response(await response.read())


# ------------------------------------------------------------------- parameters over HTTP


async def test_the_root_parameter_takes_only_dicts_and_cannot_be_deleted(ask: Any) -> None:
    assert await ask("setParam", "/c", "/", {"a": 1}) == [1, "parameter / set", 0]
    assert await ask("getParam", "/c", "/") == [1, "Parameter [/]", {"a": 1}]
    assert (await ask("setParam", "/c", "/", 5))[::2] == [-1, 0]
    assert await ask("deleteParam", "/c", "/") == [-1, "parameter [/] is not set", 0]
    assert await ask("deleteParam", "/c", "/x") == [-1, "parameter [/x] is not set", 0]


async def test_keys_are_resolved_by_the_server(ask: Any) -> None:
    await ask("setParam", "/ns/node", "a//b/", 1)
    await ask("setParam", "/ns/node", "~p", 2)
    assert await ask("getParam", "/c", "/ns/") == [
        1,
        "Parameter [/ns]",
        {"a": {"b": 1}, "node": {"p": 2}},
    ]


async def test_nothing_lies_below_a_value_and_empty_namespaces_stay(ask: Any) -> None:
    await ask("setParam", "/c", "/a/b", "text")
    assert await ask("hasParam", "/c", "/a/b/c") == [1, "/a/b/c", False]
    assert await ask("getParam", "/c", "/a/b/c") == [-1, "Parameter [/a/b/c] is not set", 0]
    await ask("deleteParam", "/c", "/a/b")
    assert await ask("getParam", "/c", "/a") == [1, "Parameter [/a]", {}]
    assert "/a" not in (await ask("getParamNames", "/c"))[2]


async def test_parameters_take_any_name_and_topics_refuse_spaces_and_colons(ask: Any) -> None:
    assert (await ask("setParam", "/c", "/a b/ü/1", 1))[0] == 1
    for topic in ("/1abc", "/a-b", "/ü"):
        assert (await ask("registerPublisher", "/p", topic, "a/T", API))[0] == 1
    for topic in ("a b", "a:b", "", "/", "//", 5):
        assert (await ask("registerPublisher", "/p", topic, "a/T", API))[::2] == [-1, []]
        assert (await ask("registerService", "/p", topic, "rosrpc://h:1", API))[::2] == [-1, 0]


async def test_search_param_goes_up_from_the_caller(ask: Any) -> None:
    await ask("setParam", "/c", "/ns/rel", {"x": 1})
    assert (await ask("searchParam", "/ns/node", "rel/y"))[::2] == [1, "/ns/rel/y"]
    assert (await ask("searchParam", "/ns/node", "none"))[::2] == [-1, ""]
    assert (await ask("searchParam", "/ns/node", "~rel"))[0] == 0
    assert (await ask("searchParam", "node", "rel"))[0] == 0


async def test_a_parameter_follower_is_known_until_it_unsubscribes(ask: Any) -> None:
    await ask("subscribeParam", "/n", API, "/k")
    await ask("setParam", "/c", "/k", 1)
    await asyncio.sleep(0)
    assert (await ask("lookupNode", "/c", "/n"))[::2] == [1, API]
    await ask("unsubscribeParam", "/n", API, "/k")
    assert (await ask("lookupNode", "/c", "/n"))[::2] == [-1, ""]


# ------------------------------------------------------------------- values that would poison


@pytest.mark.parametrize("value", ["<int>2147483648</int>", "<i8>2147483648</i8>"])
async def test_ints_beyond_32_bits_are_refused(ask: Any, master: Master, value: str) -> None:
    with pytest.raises(XmlRpcFault, match=r"params\[2\]"):
        await post(master, value)
    assert (await ask("getParam", "/c", "/"))[0] == 1


@pytest.mark.parametrize(
    "value",
    [
        "<nil/>",
        "<array><data><value><nil/></value></data></array>",
        "<struct><member><name>a</name><value><nil/></value></member></struct>",
    ],
)
async def test_nil_is_refused(ask: Any, master: Master, value: str) -> None:
    code, text, _ = await post(master, value)
    assert code == -1
    assert "parameter [value]" in text
    assert (await ask("getParam", "/c", "/"))[0] == 1
    assert (await ask("hasParam", "/c", "/k"))[2] is False


@pytest.mark.parametrize("value", ["<int>x</int>", "<boolean>2</boolean>", "&#0;", "<double/>"])
async def test_malformed_values_are_faults(ask: Any, master: Master, value: str) -> None:
    with pytest.raises(XmlRpcFault):
        await post(master, value)
    assert (await ask("getPid", "/c"))[2] == os.getpid()  # as it has a free port


async def test_datetime_is_validated(ask: Any, master: Master) -> None:
    with pytest.raises(XmlRpcFault, match="not a dateTime"):
        await post(master, "<dateTime.iso8601>nope</dateTime.iso8601>")


async def test_slashes_and_empty_keys_in_structs_are_kept_as_they_are(ask: Any) -> None:
    await ask("setParam", "/c", "/d", {"x/y": 1, "": 2})
    assert (await ask("getParam", "/c", "/d"))[2] == {"x/y": 1, "": 2}
    assert (await ask("hasParam", "/c", "/d/x"))[2] is False


async def test_values_nested_too_deep_are_refused(ask: Any, master: Master) -> None:
    deep: Any = 1
    for _ in range(97):
        deep = [deep]
    assert (await ask("setParam", "/c", "/deep", deep))[0] == 1
    assert (await ask("setParam", "/c", "/a/b/deep", deep))[0] == -1
    assert (await ask("setParam", "/c", "/x" * 5000, 1))[0] == -1
    assert (await ask("getParam", "/c", "/"))[0] == 1


async def test_multicall_runs_its_calls_in_order(ask: Any) -> None:
    """rospy unregisters everything in one request when it ends."""
    set_, get = ("setParam", ["/c", "/m/x"]), ("getParam", ["/c", "/m"])
    calls: list[tuple[str, list[Any]]] = [
        (set_[0], [*set_[1], 1]),
        get,
        (set_[0], [*set_[1], 2]),
        get,
        ("registerPublisher", ["/p", "/t", "a/T", API]),
        ("unregisterPublisher", ["/p", "/t", API]),
    ]
    results = await ask(
        "system.multicall", [{"methodName": name, "params": params} for name, params in calls]
    )
    assert [result[0][2] for result in results] == [0, {"x": 1}, 0, {"x": 2}, [], 1]


@pytest.mark.parametrize(
    "method",
    ["getMasterUri", "publisherUpdate", "requestTopic", "system.listMethods", "__init__", "_api"],
)
async def test_methods_that_rosmaster_lacks_are_faults(ask: Any, method: str) -> None:
    with pytest.raises(XmlRpcFault, match="is not supported"):
        await ask(method, "/c")


@pytest.mark.parametrize(
    ("method", "failure"),
    [
        ("registerPublisher", []),
        ("unregisterPublisher", 0),
        ("registerSubscriber", []),
        ("unregisterSubscriber", 0),
        ("registerService", 0),
        ("unregisterService", 0),
        ("lookupService", ""),
        ("lookupNode", ""),
        ("getPublishedTopics", 0),
        ("getTopicTypes", []),
        ("getSystemState", [[], [], []]),
        ("getUri", ""),
        ("getPid", -1),
        ("shutdown", 0),
        ("setParam", 0),
        ("getParam", 0),
        ("deleteParam", 0),
        ("hasParam", False),
        ("searchParam", 0),
        ("getParamNames", []),
        ("subscribeParam", 0),
        ("unsubscribeParam", 0),
    ],
)
async def test_missing_and_surplus_parameters_are_refused(
    ask: Any, method: str, failure: Any
) -> None:
    assert await ask(method) == [-1, "missing required caller_id parameter", failure]
    assert await ask(method, *["/c"] * 9) == [-1, "Error: bad call arity", failure]


# ------------------------------------------------------------------- the graph


async def test_system_state_topic_types_and_services(ask: Any) -> None:
    assert (await ask("unregisterPublisher", "/nobody", "/t", API))[::2] == [1, 0]
    await ask("registerPublisher", "/p", "/t", "a/T", API)
    await ask("registerSubscriber", "/s", "/t", "*", API)
    await ask("registerService", "/p", "/v", "rosrpc://127.0.0.1:2", API)
    assert await ask("getSystemState", "/c") == [
        1,
        "current system state",
        [[["/t", ["/p"]]], [["/t", ["/s"]]], [["/v", ["/p"]]]],
    ]
    assert (await ask("getTopicTypes", "/c"))[2] == [["/t", "a/T"]]
    assert (await ask("lookupService", "/c", "v"))[::2] == [1, "rosrpc://127.0.0.1:2"]


@pytest.mark.parametrize("topic_type", ["String", "a/b/c", "", 5])
async def test_malformed_types_are_refused(ask: Any, topic_type: Any) -> None:
    assert (await ask("registerPublisher", "/p", "/t", topic_type, API))[::2] == [-1, []]
    assert (await ask("registerSubscriber", "/p", "/t", topic_type, API))[::2] == [-1, []]


@pytest.mark.parametrize("api", ["https://h:1/", "", 5, "h:1"])
async def test_malformed_uris_are_refused(ask: Any, api: Any) -> None:
    assert (await ask("registerPublisher", "/p", "/t", "a/T", api))[::2] == [-1, []]
    assert (await ask("registerService", "/p", "/t", "rosrpc://h:1", api))[::2] == [-1, 0]


async def test_names_are_resolved_relative_to_the_caller(ask: Any) -> None:
    await ask("registerPublisher", "/ns/p", "t", "a/T", API)
    await ask("registerPublisher", "/ns/p", "/nst", "a/T", API)
    assert (await ask("getPublishedTopics", "/c", "/ns"))[2] == [["/ns/t", "a/T"]]
    assert len((await ask("getPublishedTopics", "/c", ""))[2]) == 2
    assert (await ask("lookupNode", "/ns/other", "p"))[2] == API


async def test_uris_are_kept_as_given(ask: Any) -> None:
    await ask("registerPublisher", "/a", "/t", "a/T", "http://h:1")
    await ask("registerPublisher", "/b", "/t", "a/T", "http://h:1/")
    assert (await ask("registerSubscriber", "/s", "/t", "a/T", API))[2] == [
        "http://h:1",
        "http://h:1/",
    ]


# ------------------------------------------------------------------- the object


async def test_what_a_new_master_has() -> None:
    async with Master(
        "localhost", port=0, rosout=False, params={"a": {"b": (1, 2)}, "/x/y": True}
    ) as master:
        assert re.fullmatch(r"http://localhost:\d+/", master.uri)
        assert master.uri == f"http://localhost:{master.port}/"
        assert master.is_open
        client = XmlRpcClient()
        assert (await client.call(master.uri, "getUri", "/c"))[2] == master.uri
        params = (await client.call(master.uri, "getParam", "/c", "/"))[2]
        await client.close()
    assert params == {
        "run_id": master.run_id,
        "rosdistro": "noetic\n",
        "rosversion": "1.15.15\n",
        "a": {"b": [1, 2]},
        "x": {"y": True},
    }
    assert uuid.UUID(master.run_id).version == 1
    assert not master.is_open
    assert await master.wait_closed() == "closed"


async def test_run_ids_differ() -> None:
    assert len({Master().run_id for _ in range(10)}) == 10


@pytest.mark.parametrize(
    ("params", "error", "text"),
    [
        ({"a": None}, TypeError, "parameter a: "),
        ({"a": 1 << 31}, OverflowError, "parameter a: "),
        ({"/": 5}, TypeError, "root of parameter tree"),
    ],
)
def test_parameters_that_cannot_be(params: Any, error: type[Exception], text: str) -> None:
    with pytest.raises(error, match=text):
        Master(params=params)


@pytest.mark.parametrize(
    ("host", "environ", "expected"),
    [
        ("127.0.0.1", {}, "127.0.0.1"),
        (None, {"ROS_HOSTNAME": "localhost"}, "localhost"),
        (None, {"ROS_IP": "127.0.0.1"}, "127.0.0.1"),
    ],
)
async def test_what_is_told_to_others(
    host: str | None, environ: dict[str, str], expected: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    for variable in ("ROS_HOSTNAME", "ROS_IP"):
        monkeypatch.delenv(variable, raising=False)
    for variable, value in environ.items():
        monkeypatch.setenv(variable, value)
    async with Master(host, port=0, rosout=False) as master:
        assert master.uri == f"http://{expected}:{master.port}/"


async def test_a_wildcard_is_never_told_to_others(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("aioros1.master.server.advertised_host", lambda bound: "192.0.2.7")
    for host in (None, "0.0.0.0"):
        async with Master(host, port=0, rosout=False) as master:
            assert master.uri == f"http://192.0.2.7:{master.port}/"
            client = XmlRpcClient()
            assert (await client.call(f"http://127.0.0.1:{master.port}/", "getUri", "/c"))[
                2
            ] == master.uri
            await client.close()


def is_listening(host: str, port: int) -> bool:
    with socket.socket() as sock:
        return sock.connect_ex((host, port)) == 0


@pytest.mark.skipif(sys.platform != "linux", reason="needs a second loopback address")
async def test_it_can_listen_on_one_address_only() -> None:
    async with Master(bind="127.0.0.2", port=0) as master:
        assert master.uri == f"http://127.0.0.2:{master.port}/"
        async with Node("node", master_uri=master.uri) as node:
            aggregator = urlsplit(await node.master.lookup_node("/rosout"))
        assert (aggregator.hostname, bool(aggregator.port)) == ("127.0.0.2", True)
        for port in (master.port, aggregator.port):
            assert await asyncio.to_thread(is_listening, "127.0.0.2", port)
            assert not await asyncio.to_thread(is_listening, "127.0.0.1", port)


async def test_what_it_tells_and_where_it_listens_can_differ(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("ROS_IP", "127.0.0.1")
    async with Master(bind="0.0.0.0", port=0, rosout=False) as master:
        assert urlsplit(master.uri).hostname == "127.0.0.1"
    async with Master("robot.example", bind="127.0.0.1", port=0, rosout=False) as master:
        assert urlsplit(master.uri).hostname == "robot.example"
        assert await asyncio.to_thread(is_listening, "127.0.0.1", master.port)


@pytest.mark.parametrize("bind", ["robot", "10.0.0.0/8", "eth0"])
async def test_where_it_cannot_listen(bind: str) -> None:
    with pytest.raises(ValueError, match=f"numeric address to listen on, got '{bind}'"):
        await Master("localhost", port=0, bind=bind).start()


async def test_a_list_without_this_machine_needs_a_master_without_rosout() -> None:
    with pytest.raises(ValueError, match=r"connects from 127\.0\.0\.1, which is not in 10\."):
        await Master("localhost", port=0, allow=["10.0.0.0/8"]).start()
    with pytest.raises(ValueError, match="not in the empty list"):
        await Master("localhost", port=0, allow=[]).start()
    async with Master("localhost", port=0, allow=["10.0.0.0/8"], rosout=False) as master:
        client = XmlRpcClient()
        with pytest.raises(ConnectionError):
            await client.call(master.uri, "getPid", "/c")
        await client.close()
        assert master.stats.connections_forbidden


async def test_shutdown_is_answered_and_then_obeyed(master: Master, ask: Any) -> None:
    assert await ask("shutdown", "/c", "enough") == [1, "shutdown", 0]
    reason = await asyncio.wait_for(master.wait_closed(), 10)
    assert reason == "external shutdown request from [/c]: enough"
    assert not master.is_open
    with pytest.raises(ConnectionError):
        await ask("getPid", "/c")
    await master.close()
    assert await master.wait_closed() == reason


async def test_closing_twice_and_at_once() -> None:
    before = asyncio.all_tasks()
    master = Master("127.0.0.1", port=0, rosout=False)
    await master.start()
    await asyncio.gather(*(master.close() for _ in range(5)))
    await master.close()
    await asyncio.sleep(0)
    assert asyncio.all_tasks() == before
    with pytest.raises(RuntimeError, match="once"):
        await master.start()


async def test_a_closer_that_is_cancelled_closes_all_the_same() -> None:
    master = Master("127.0.0.1", port=0, rosout=False)
    await master.start()
    closing = asyncio.create_task(master.close())
    await asyncio.sleep(0)
    closing.cancel()
    with pytest.raises(asyncio.CancelledError):
        await closing
    assert await asyncio.wait_for(master.wait_closed(), 10) == "closed"


async def test_a_port_that_is_taken(master: Master) -> None:
    other = Master("127.0.0.1", port=master.port, rosout=False)
    with pytest.raises(OSError, match=f"cannot listen on 127.0.0.1:{master.port}"):
        await other.start()
    assert other.uri == ""
    await other.close()


async def test_a_master_that_was_never_closed_says_so() -> None:
    master = Master("127.0.0.1", port=0, rosout=False)
    await master.start()
    with pytest.warns(ResourceWarning, match="unclosed master"):
        master.__del__()
    await master.close()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        del master
        gc.collect()


async def test_large_values(ask: Any) -> None:
    text = "<robot/>" * 500_000
    assert (await ask("setParam", "/c", "/robot_description", text))[0] == 1
    assert (await ask("getParam", "/c", "/robot_description"))[2] == text


async def test_several_masters_know_nothing_of_each_other() -> None:
    client = XmlRpcClient()
    async with (
        Master("127.0.0.1", port=0, rosout=False) as one,
        Master("127.0.0.1", port=0, rosout=False) as two,
    ):
        await client.call(one.uri, "setParam", "/c", "/k", 1)
        assert (await client.call(two.uri, "hasParam", "/c", "/k"))[2] is False
    await client.close()


async def test_masters_at_one_port_can_be_told_apart_by_their_process_id() -> None:
    """That is all that cROS asks for, and some masters are threads of one process."""
    seen = []
    client = XmlRpcClient()
    port = 0
    for _ in range(5):
        async with Master("127.0.0.1", port=port, rosout=False) as master:
            port = master.port
            seen.append((await client.call(master.uri, "getPid", "/c"))[2])
    await client.close()
    assert len(set(seen)) == 5
    assert {pid & 0x3FFFFF for pid in seen} == {os.getpid()}
    assert all(0 < pid < 1 << 31 for pid in seen)


async def test_masters_of_containers_can_be_told_apart(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each of them is process 1."""
    monkeypatch.setattr("os.getpid", lambda: 1)
    begin = random.randrange(1 << 20, 1 << 30)  # whom no other test has told of
    seen = {process_id(begin + number, is_free=False) for number in range(20)}
    assert len(seen) > 10
    assert process_id(1, is_free=True) == 1
