"""Parameters that a node follows: what the master announces, put together."""

from __future__ import annotations

import asyncio

import pytest

import aioros1


@pytest.fixture
async def pair(make_node):
    """One that sets, and one that follows."""
    return await make_node("setter"), await make_node("follower")


async def test_a_followed_scalar_becomes_a_dict_leaf_by_leaf(pair):
    """As ``rosparam set`` does it: one update for each leaf, below what was a number."""
    setter, follower = pair
    await setter.set_param("/k", 5)
    async with follower.subscribe_param("/k") as psub:
        assert psub.value == 5
        await setter.set_param("/k/a", 1)
        await setter.set_param("/k/b/c", [2])
        assert await psub.wait_for(lambda value: value == {"a": 1, "b": {"c": [2]}}, timeout=30)
        assert [(each.key, each.value) for each in (await anext(psub), await anext(psub))] == [
            ("/k/a", 1),
            ("/k/b/c", [2]),
        ]
        await setter.delete_param("/k/b/c")
        assert await psub.wait_for(lambda value: value.get("b") in ({}, None), timeout=30)
        await setter.set_param("/k", 6)
        assert await psub.wait_for(lambda value: value == 6, timeout=30)


async def test_a_cached_parameter_is_asked_for_once_and_followed(pair):
    setter, follower = pair
    with pytest.raises(KeyError, match="/gain"):
        await follower.get_param_cached("/gain")
    assert await follower.get_param_cached("/gain", 1) == 1
    await setter.set_param("/gain", 2)
    async with asyncio.timeout(30):
        while await follower.get_param_cached("/gain", 1) != 2:
            await asyncio.sleep(0.001)
    state = [role for role in follower.roles if isinstance(role, aioros1.ParamSubscriber)]
    assert len(state) == 1


async def test_what_one_sets_oneself_is_seen_at_once(make_node):
    node = await make_node()
    async with (
        node.subscribe_param("/a", default=None) as outer,
        node.subscribe_param("/a/b/c", default=None) as inner,
    ):
        await node.set_param("/a", {"b": {"c": 1}})
        assert (outer.value, inner.value) == ({"b": {"c": 1}}, 1)
        await node.set_param("/a/b/c", 2)
        assert (outer.value, inner.value) == ({"b": {"c": 2}}, 2)
        await node.delete_param("/a")
        assert (outer.value, inner.value) == (None, None)


async def test_a_followed_parameter_is_unsubscribed_with_its_last_follower(pair):
    setter, follower = pair
    first = await follower.subscribe_param("/k", default=0)
    second = await follower.subscribe_param("/k", default=0)
    await first.close()
    await setter.set_param("/k", 1)
    assert await second.wait_for(lambda value: value == 1, timeout=30) == 1
    await second.close()
    async with follower.subscribe_param("/other", default=0):  # a node known to the master
        peer = await setter.peer("/follower")
        with pytest.raises(aioros1.PeerError, match="not subscribed to parameter /k"):
            await peer.call("paramUpdate", "/k", 2)
    assert [update async for update in second] == []
