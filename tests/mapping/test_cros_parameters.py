"""The parameter server."""

from __future__ import annotations

import asyncio
import datetime

import pytest

import aioros1

VALUES = {
    "bool": True,
    "int": -5,
    "double": 2.5,
    "string": "text, ü & <tags>",
    "array": [1, "two", [3.0]],
    "struct": {"p": 1.0, "deeper": {"i": 2}},
    "datetime": datetime.datetime(2024, 2, 29, 12, 30, 15),
    "binary": b"\0\1\xff",
}


@pytest.mark.parametrize("kind", VALUES)
async def test_cRosApiSetParam(pair, kind):
    setter, getter = pair
    await setter.set_param("value", VALUES[kind])
    value = await getter.get_param("/value")
    assert value == VALUES[kind]
    assert type(value) is type(VALUES[kind])


async def test_cRosApiSetParam_of_a_private_name(pair):
    setter, getter = pair
    await setter.set_param("~rate", 10)
    assert await getter.get_param("/talker/rate") == 10


async def test_cRosApiSetParam_of_what_is_no_parameter(make_node):
    node = await make_node()
    with pytest.raises(TypeError, match="None"):
        await node.set_param("value", None)
    with pytest.raises(OverflowError, match="32 bits"):
        await node.set_param("value", {"deep": [2**31]})
    assert not await node.has_param("value")


async def test_cRosApiGetParam(make_node):
    node = await make_node()
    await node.set_param("gains", {"p": 1, "i": {"max": 2}})
    assert await node.get_param("gains/i/max") == 2
    assert await node.get_param("gains") == {"p": 1, "i": {"max": 2}}


async def test_cRosApiGetParam_that_is_not_set(make_node):
    node = await make_node()
    with pytest.raises(KeyError, match="/rate"):
        await node.get_param("rate")
    assert await node.get_param("rate", 5) == 5
    assert await node.get_param("rate", default=None) is None


async def test_cRosApiDeleteParam(make_node):
    node = await make_node()
    await node.set_param("gains", {"p": 1, "i": 2})
    await node.delete_param("gains/p")
    assert await node.get_param("gains") == {"i": 2}
    with pytest.raises(KeyError, match="/gains/p"):
        await node.delete_param("gains/p")


async def test_cRosApiDeleteParam_is_seen_once_by_whoever_does_it(pair):
    """The master tells of a deletion to the one who asked for it, too."""
    deleter, other = pair
    async with deleter.subscribe_param("rate", default=0) as psub, asyncio.timeout(30):
        await deleter.set_param("rate", 1)
        await deleter.delete_param("rate")
        await other.set_param("rate", 2)
        updates = [(await anext(psub)).value]
        while updates[-1] != 2:
            updates.append((await anext(psub)).value)
        assert updates == [1, {}, 2]


async def test_cRosApiGetParamNames(make_node):
    node = await make_node()
    await node.set_param("gains", {"p": 1, "i": 2})
    assert {"/gains/p", "/gains/i", "/run_id"} <= set(await node.get_param_names())


async def test_cRosApiSearchParam(make_node):
    node = await make_node("talker", namespace="robot")
    assert await node.search_param("rate") is None
    await node.set_param("/rate", 1)
    assert await node.search_param("rate") == "/rate"
    await node.set_param("/robot/rate", 2)
    assert await node.search_param("rate") == "/robot/rate"
    await node.set_param("~rate", 3)
    assert await node.search_param("rate") == "/robot/talker/rate"


async def test_cRosApiHasParam(make_node):
    node = await make_node()
    assert await node.has_param("rate") is False
    await node.set_param("rate", 0)
    assert await node.has_param("rate") is True


async def test_cRosApiSubscribeParam_waits_for_a_value(pair):
    setter, follower = pair
    async with follower.subscribe_param("rate") as psub:
        await setter.set_param("rate", 10)
        assert await psub.wait_for(lambda rate: rate > 5, timeout=30) == 10
        with pytest.raises(TimeoutError, match="/rate"):
            await psub.wait_for(lambda rate: rate > 50, timeout=0.01)


async def test_cRosApiSubscribeParam_sees_a_deletion(pair):
    setter, follower = pair
    await setter.set_param("rate", 10)
    async with follower.subscribe_param("rate", default=1) as psub:
        await setter.delete_param("rate")
        assert await psub.wait_for(lambda rate: rate != 10, timeout=30) == 1


async def test_cRosApiUnsubscribeParam_ends_the_updates(pair):
    setter, follower = pair
    psub = await follower.subscribe_param("rate", default=1)
    async with follower.subscribe_param("other", default=1) as other:
        await psub.close()
        await setter.set_param("rate", 10)
        await setter.set_param("other", 10)
        await other.wait_for(lambda value: value == 10, timeout=30)
    assert psub.stats.messages == 0
    with pytest.raises(aioros1.ClosedError):
        await psub.wait_for(lambda value: True)
