"""What a node takes from notices of the master that come late, or never, and what it reads."""

from __future__ import annotations

import asyncio

import pytest


@pytest.fixture
async def pair(make_node):
    """One that sets, and one that follows."""
    return await make_node("setter"), await make_node("follower")


async def test_a_notice_that_is_older_than_ones_own_change(pair):
    """rosmaster sends its notices 25 to 80 ms after the change."""
    setter, follower = pair
    async with follower.subscribe_param("/k", default=0) as psub:
        late = await setter.peer("/follower")
        await follower.set_param("/k", {"a": 2, "b": 2})
        await late.call("paramUpdate", "/k/", 1)
        await late.call("paramUpdate", "/k/a/", {})
        await late.call("paramUpdate", "/", {"k": {"a": 1}})
        assert psub.value == {"a": 2, "b": 2}
        await setter.set_param("/k/a", 3)
        await psub.wait_for(lambda value: value == {"a": 3, "b": 2}, timeout=30)
        updates = [await anext(psub), await anext(psub)]
        assert updates[0].value == {"a": 2, "b": 2}
        assert (updates[1].key, updates[1].value) == ("/k/a", 3)


async def test_a_notice_that_is_much_older(make_node):
    """Nothing says that it is, but the value is read again within a heartbeat."""
    follower = await make_node("follower", heartbeat=0.05)
    setter = await make_node("setter")
    await setter.set_param("/k", 2)
    async with follower.subscribe_param("/k") as psub:
        late = await setter.peer("/follower")
        await late.call("paramUpdate", "/k/", 1)
        await psub.wait_for(lambda value: value == 2, timeout=30)


async def test_a_notice_that_is_lost(make_node):
    """What nobody tells is found out, as rosmaster loses notices, and leaves some out."""
    follower = await make_node("follower", heartbeat=0.05)
    setter = await make_node("setter")
    async with follower.subscribe_param("/k", default=None) as psub:
        await follower.master.unsubscribe_param("/k", follower.uri)
        await setter.set_param("/k", {"a": float("nan"), "b": [1, 2]})
        await psub.wait_for(lambda value: value and value["b"] == [1, 2], timeout=30)
        await setter.set_param("/k/b", [1, True])
        await psub.wait_for(lambda value: value["b"][1] is True, timeout=30)
        assert (await anext(psub)).key == "/k"
        # By now, the master may have been told again who follows it.
        assert (await anext(psub)).key in ("/k", "/k/b")
        await setter.delete_param("/k")
        await psub.wait_for(lambda value: value is None, timeout=30)


async def test_a_subscription_that_the_master_has_lost(make_node):
    """rosmaster ends it when a node answers an old notice while it does not follow the key."""
    follower = await make_node("follower", heartbeat=0.05)
    setter = await make_node("setter")
    async with follower.subscribe_param("/k", default=None) as psub:
        await follower.master.unsubscribe_param("/k", follower.uri)
        await setter.set_param("/k", 1)
        await psub.wait_for(lambda value: value == 1, timeout=30)
        async with asyncio.timeout(30):
            while not await follower.master.unsubscribe_param("/k", follower.uri):
                await asyncio.sleep(0.01)


async def test_notices_of_very_many_keys(pair):
    """Whoever sends them, they are not all remembered."""
    setter, follower = pair
    async with follower.subscribe_param("/k", default=None) as psub:
        liar = await setter.peer("/follower")
        await follower.set_param("/k", {"a": 1})
        for number in range(1500):
            await liar.call("paramUpdate", f"/k/no{number}/", number)
        await setter.set_param("/k/b", 2)
        await psub.wait_for(lambda value: value == {"a": 1, "b": 2}, timeout=30)


async def test_changes_by_oneself_at_the_same_time(make_node):
    """The order of their answers is not that in which the master made them."""
    node = await make_node("node", heartbeat=0.05)
    async with (
        node.subscribe_param("/k", default=None) as outer,
        node.subscribe_param("/k/a", default=None) as inner,
    ):
        for turn in range(10):
            await asyncio.gather(
                *(node.set_param("/k", {"a": turn + number}) for number in range(3)),
                *(node.set_param("/k/a", turn - number) for number in range(3)),
            )
        value = await node.get_param("/k")
        await outer.wait_for(lambda seen: seen == value, timeout=30)
        await inner.wait_for(lambda seen: seen == value["a"], timeout=30)


async def test_following_begins_while_one_changes_it(make_node):
    node = await make_node("node", heartbeat=0.05)
    for number in range(10):
        key = f"/k{number}"
        _, psub = await asyncio.gather(
            node.set_param(f"{key}/a", number), node.subscribe_param(key, default=None)
        )
        await psub.wait_for(lambda value, number=number: value == {"a": number}, timeout=30)


async def test_a_value_at_rest_is_seldom_read(make_node, master):
    """Ever more seldom, and never for a node without heartbeats."""
    asked = []
    for name, heartbeat in (("idle", 0.02), ("none", None)):
        node = await make_node(name, heartbeat=heartbeat, rosout=False, logger_services=False)
        proxy = node.master
        call = proxy.get_param

        async def get_param(key, call=call, name=name):
            if key == "/k":
                asked.append(name)
            return await call(key)

        proxy.get_param = get_param
        await node.subscribe_param("/k", default=None)
    async with asyncio.timeout(30):
        while asked.count("idle") < 6:
            await asyncio.sleep(0.01)
    assert asked.count("none") <= 1
