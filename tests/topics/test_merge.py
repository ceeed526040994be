"""``aioros1.merge``: several subscribers as one iteration."""

from __future__ import annotations

import asyncio

import pytest

import aioros1
from aioros1.msg.std_msgs import Int32, String


@pytest.fixture
async def topics(make_node):
    """Two publishers, and a subscriber of each in another node."""
    talker, listener = await make_node("talker"), await make_node("listener")
    pubs = [await talker.advertise("a", String), await talker.advertise("b", Int32)]
    subs = [await listener.subscribe("a", String), await listener.subscribe("b", Int32)]
    for pub in pubs:
        await pub.wait_for_subscribers(timeout=30)
    return pubs, subs


async def until(condition):
    async with asyncio.timeout(30):
        while not condition():
            await asyncio.sleep(0.001)


async def has_queued(sub, number):
    await until(lambda: sub.queued == number)


async def test_messages_come_in_the_order_in_which_they_arrived(topics):
    (a, b), subs = topics
    for number in range(3):
        a.publish(data=str(number))
        await has_queued(subs[0], number + 1)
        b.publish(data=number)
        await has_queued(subs[1], number + 1)
    got = []
    async for topic, message in aioros1.merge(*subs):
        got.append((topic, message.data))
        if len(got) == 6:
            break
    assert got == [("/a", "0"), ("/b", 0), ("/a", "1"), ("/b", 1), ("/a", "2"), ("/b", 2)]


async def test_whoever_waits_is_woken_by_any_of_them(topics):
    (a, b), subs = topics
    merged = aioros1.merge(*subs)
    for pub, data, topic in ((b, 7, "/b"), (a, "x", "/a"), (b, 8, "/b")):
        waiting = asyncio.create_task(anext(merged))
        await asyncio.sleep(0)
        pub.publish(data=data)
        name, message = await asyncio.wait_for(waiting, 30)
        assert (name, message.data) == (topic, data)


async def test_nothing_is_lost_when_it_is_cancelled(topics):
    (a, _), subs = topics
    merged = aioros1.merge(*subs)
    waiting = asyncio.create_task(anext(merged))
    await asyncio.sleep(0)
    a.publish(data="kept")
    waiting.cancel()
    await asyncio.gather(waiting, return_exceptions=True)
    _, message = await asyncio.wait_for(anext(merged), 30)
    assert message.data == "kept"


async def test_it_ends_with_the_last_of_them(topics):
    (a, b), subs = topics
    got = []

    async def receive():
        async for _, message in aioros1.merge(*subs):
            got.append(message.data)

    receiving = asyncio.create_task(receive())
    a.publish(data="one")
    await until(lambda: got == ["one"])
    await subs[0].close()
    b.publish(data=2)
    await until(lambda: got == ["one", 2])
    assert not receiving.done()
    await subs[1].close()
    await asyncio.wait_for(receiving, 30)


async def test_a_message_that_cannot_be_decoded_is_skipped(topics):
    (a, b), subs = topics
    a.publish_raw(b"\xff\xff\xff\xff")
    await until(lambda: subs[0].queued == 1)
    b.publish(data=1)
    topic, message = await asyncio.wait_for(anext(aioros1.merge(*subs)), 30)
    assert (topic, message.data) == ("/b", 1)
    assert subs[0].stats.errors == 1


async def test_none_at_all():
    assert [each async for each in aioros1.merge()] == []


def test_what_is_no_subscriber():
    with pytest.raises(TypeError, match="merge takes subscribers, got 'chatter'"):
        aioros1.merge("chatter")
