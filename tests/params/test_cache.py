"""What is kept of parameters that are followed: a value each, and not much more."""

from __future__ import annotations

import asyncio
import collections
import gc
import random
import tracemalloc

import pytest

import aioros1


@pytest.fixture
async def pair(make_node):
    """One that sets, and one that follows."""
    return await make_node("setter"), await make_node("follower")


async def test_large_values_that_nobody_iterates_over_are_not_kept(pair):
    setter, follower = pair
    async with follower.subscribe_param("/k", default="") as psub:
        for number in range(45):
            await setter.set_param("/k", f"{number} " + "x" * 500_000)
        await psub.wait_for(lambda value: value.startswith("44 "), timeout=30)
        assert psub.stats.dropped >= 45 - 34
        first = await anext(psub)
        assert first.value[:3] not in ("0 x", "1 x")
        async with asyncio.timeout(30):
            while (await anext(psub)).value != psub.value:
                pass


async def test_the_cache_keeps_one_value_of_each_parameter(pair):
    setter, follower = pair
    assert await follower.get_param_cached("/k", None) is None
    tracemalloc.start()
    try:
        for number in range(45):
            await setter.set_param("/k", f"{number} " + "x" * 500_000)
            async with asyncio.timeout(30):
                while not (await follower.get_param_cached("/k", "")).startswith(f"{number} "):
                    await asyncio.sleep(0.001)
        gc.collect()
        assert tracemalloc.get_traced_memory()[0] < 10 * 500_000
    finally:
        tracemalloc.stop()


async def test_the_cache_follows_only_the_keys_that_were_asked_for_last(pair):
    setter, follower = pair
    keys = [f"/many/k{number}" for number in range(300)]
    await setter.set_param("/many", {key.rpartition("/")[2]: 1 for key in keys})
    for key in keys:
        assert await follower.get_param_cached(key) == 1
        assert await follower.get_param_cached(keys[0]) == 1
    followed = {role.name for role in follower.roles}
    assert len(followed) == 256
    assert {keys[0], keys[-1]} <= followed
    assert keys[1] not in followed
    await setter.set_param("/many", {key.rpartition("/")[2]: 2 for key in keys})
    for key in (keys[0], keys[1], keys[-1]):
        async with asyncio.timeout(30):
            while await follower.get_param_cached(key) != 2:
                await asyncio.sleep(0.001)


async def test_the_cache_follows_no_more_when_many_ask_at_once_and_some_give_up(pair):
    setter, follower = pair
    keys = [f"/many/k{number}" for number in range(300)]
    await setter.set_param("/many", {key.rpartition("/")[2]: 1 for key in keys})

    async def ask(key, patience=None):
        try:
            async with asyncio.timeout(patience):
                assert await follower.get_param_cached(key) == 1
        except TimeoutError:
            pass

    def followed():
        return {role for role in follower.roles if role.name.startswith("/many/")}

    chance = random.Random(1)
    for _ in range(2):
        await asyncio.gather(*(ask(chance.choice(keys)) for _ in range(900)))
    for key in keys:
        await ask(key, chance.uniform(0, 0.003))
    async with asyncio.timeout(30):
        while len(followed()) > 256:
            await asyncio.sleep(0.01)
    assert len({role.name for role in followed()}) == len(followed())


async def test_many_parameters_that_do_not_change_are_seldom_read(make_node, monkeypatch):
    """All nodes ask one master, and each may follow hundreds."""
    asked = collections.Counter()
    call = aioros1.MasterProxy.call

    async def counted(master, method, *params, **options):
        if master.caller_id == "/follower":
            asked[method] += 1
        return await call(master, method, *params, **options)

    monkeypatch.setattr(aioros1.MasterProxy, "call", counted)
    setter = await make_node("setter")
    follower = await make_node("follower", heartbeat=0.05)
    keys = [f"/many/k{number}" for number in range(200)]
    await setter.set_param("/many", {key.rpartition("/")[2]: 1 for key in keys})
    for key in keys:
        assert await follower.get_param_cached(key) == 1
    beats, readings = asked["getPid"], asked["getParam"]
    async with asyncio.timeout(30):
        while asked["getPid"] < beats + 60:
            await asyncio.sleep(0.05)
    # With four heartbeats between two readings of each, it would be fifteen times as many.
    assert asked["getParam"] - readings < 6 * len(keys)
    await setter.set_param(keys[7], 2)
    async with asyncio.timeout(30):
        while await follower.get_param_cached(keys[7]) != 2:
            await asyncio.sleep(0.01)


async def test_a_cached_parameter_whose_follower_was_closed_is_followed_again(pair):
    setter, follower = pair
    assert await follower.get_param_cached("/k", 0) == 0
    (role,) = (each for each in follower.roles if each.name == "/k")
    await role.close()
    await setter.set_param("/k", 1)
    assert await follower.get_param_cached("/k", 0) == 1
