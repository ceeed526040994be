"""What a master keeps for others, and what it answers beyond that."""

from __future__ import annotations

import asyncio
from typing import Any

import pytest

from aioros1 import Limits, Master
from aioros1.xmlrpc.client import XmlRpcClient

HERE = "http://127.0.0.1:1/"


@pytest.fixture
def limits() -> Limits:
    return Limits(registrations=10, parameter_bytes=100_000)


@pytest.fixture
async def bounded(limits: Limits) -> Any:
    async with Master("127.0.0.1", port=0, rosout=False, limits=limits) as master:
        client = XmlRpcClient()

        async def ask(method: str, *params: Any) -> Any:
            return await client.call(master.uri, method, *params)

        yield ask
        await client.close()


async def test_registrations_beyond_the_limit_are_refused(bounded: Any) -> None:
    topics = [f"/t{number}" for number in range(30)]
    codes = [
        (await bounded("registerSubscriber", "/a", topic, "std_msgs/String", HERE))[0]
        for topic in topics
    ]
    taken = codes.count(1)
    assert 0 < taken <= 10
    assert codes == [1] * taken + [-1] * (30 - taken)
    answer = await bounded("registerService", "/b", "/s", "rosrpc://h:1", HERE)
    assert answer[0] == -1
    assert "limits.registrations" in answer[1]
    assert (await bounded("subscribeParam", "/b", HERE, "/p"))[0] == -1
    # Who is registered may say so again, and go.
    assert (await bounded("registerSubscriber", "/a", "/t0", "std_msgs/String", HERE))[0] == 1
    assert (await bounded("unregisterSubscriber", "/a", "/t0", HERE))[2] == 1


async def test_parameters_beyond_the_limit_are_refused(bounded: Any) -> None:
    assert (await bounded("setParam", "/a", "/p", "x" * 80_000))[0] == 1
    code, text, _ = await bounded("setParam", "/a", "/q", "x" * 80_000)
    assert (code, "more than 100000 bytes of parameters" in text) == (-1, True)
    assert (await bounded("setParam", "/a", "/p", "y" * 80_000))[0] == 1
    assert (await bounded("deleteParam", "/a", "/p"))[0] == 1
    assert (await bounded("setParam", "/a", "/q", "x" * 80_000))[0] == 1


@pytest.mark.parametrize(
    ("method", "params"),
    [
        ("registerPublisher", ("/a", "{}", "std_msgs/String", HERE)),
        ("registerPublisher", ("/a", "/t", "std_msgs/{}", HERE)),
        ("registerPublisher", ("/a", "/t", "std_msgs/String", HERE + "{}")),
        ("registerService", ("/a", "{}", "rosrpc://h:1", HERE)),
        ("lookupNode", ("/a", "{}")),
        ("lookupNode", ("{}", "/a")),
        ("getPublishedTopics", ("/a", "{}")),
        ("getParam", ("/a", "{}")),
        ("setParam", ("/a", "{}", 1)),
        ("searchParam", ("/a", "{}")),
        ("searchParam", ("{}", "p")),
    ],
)
async def test_names_without_end_are_refused_briefly(
    bounded: Any, method: str, params: tuple[Any, ...]
) -> None:
    long = "/x" * 1_000_000
    code, text, _ = await bounded(
        method, *(each.format(long) if isinstance(each, str) else each for each in params)
    )
    assert code == -1
    assert len(text) < 1_000


async def test_a_multicall_has_one_answer_of_the_usual_size() -> None:
    limits = Limits(xmlrpc_bytes=1_000_000)
    async with Master("127.0.0.1", port=0, rosout=False, limits=limits) as master:
        client = XmlRpcClient()
        await client.call(master.uri, "setParam", "/a", "/p", "x" * 100_000)
        call = {"methodName": "getParam", "params": ["/a", "/p"]}
        results = await client.call(master.uri, "system.multicall", [call] * 2_000)
        answers = [each for each in results if isinstance(each, list)]
        faults = [each for each in results if isinstance(each, dict)]
        assert len(answers) + len(faults) == 2_000
        assert 5 <= len(answers) <= 10
        assert faults[0]["faultString"] == "the answer would be too large"
        await client.close()


async def test_others_are_served_while_a_large_parameter_is_set_and_read() -> None:
    """The loop goes on: it is blocked for no longer than a turn takes."""
    async with Master("127.0.0.1", port=0, rosout=False) as master:
        client, other = XmlRpcClient(), XmlRpcClient()
        value = {f"key{number}": [number, "text", 0.5] for number in range(5_000)}

        async def large() -> None:
            await client.call(master.uri, "setParam", "/a", "/p", value, timeout=60)
            assert (await client.call(master.uri, "getParam", "/a", "/p", timeout=60))[2] == value

        task = asyncio.create_task(large())
        served = 0
        while not task.done():
            assert (await other.call(master.uri, "hasParam", "/b", "/q", timeout=60))[2] is False
            served += 1
        await task
        assert served >= 3
        await client.close()
        await other.close()


async def test_a_namespace_of_large_parameters_arrives_whole() -> None:
    async with Master("127.0.0.1", port=0, rosout=False) as master:
        client = XmlRpcClient()
        text = "a & b < c > d \u00fc\n" * 50_000
        value = {"text": text, "bytes": b"\x00\x01\x02\xff" * 50_000, "k" * 2_000: [text]}
        await client.call(master.uri, "setParam", "/a", "/p", value, timeout=60)
        assert (await client.call(master.uri, "getParam", "/a", "/p", timeout=60))[2] == value
        call = {"methodName": "getParam", "params": ["/a", "/p/text"]}
        results = await client.call(master.uri, "system.multicall", [call] * 3, timeout=60)
        assert [each[0][2] for each in results] == [text] * 3
        await client.close()


async def test_a_small_struct_with_huge_names_does_not_stop_the_master() -> None:
    leaves: dict[str, Any] = {str(number): 1 for number in range(5_000)}
    value: Any = leaves
    for _ in range(60):
        value = {"k" * 100_000: value}
    async with Master("127.0.0.1", port=0, rosout=False) as master:
        client = XmlRpcClient()
        assert (await client.call(master.uri, "setParam", "/a", "/p", value, timeout=60))[0] == 1
        names = (await client.call(master.uri, "getParamNames", "/a", timeout=60))[2]
        assert "/run_id" in names
        assert max(map(len, names)) <= 1024
        await client.close()
