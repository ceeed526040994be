"""What a subscriber tells of its queue, and of the newest message."""

from __future__ import annotations

import asyncio

import pytest

import aioros1
from aioros1.msg.std_msgs import String


@pytest.fixture
async def chatter(make_node):
    """A publisher and a subscriber that are connected."""
    talker, listener = await make_node("talker"), await make_node("listener")
    async with (
        talker.advertise("chatter", String, queue_size=100) as pub,
        listener.subscribe("chatter", String) as sub,
    ):
        await pub.wait_for_subscribers()
        yield pub, sub


async def test_peek_leaves_the_message_where_it_is(chatter):
    pub, sub = chatter
    assert sub.peek() is None
    assert sub.next_received is None
    pub.publish(data="a")
    pub.publish(data="b")
    await sub.wait_for_messages(2, timeout=20)
    event = sub.peek()
    assert event is not None
    assert (event.message, event.header["callerid"]) == (String(data="a"), "/talker")
    assert sub.next_received == event.received
    assert sub.queued == 2
    assert (await sub.get()).data == "a"
    assert sub.peek().message.data == "b"  # type: ignore[union-attr]


async def test_peek_skips_what_cannot_be_decoded(chatter):
    pub, sub = chatter
    pub.publish_raw(b"\xff\0\0\0short")
    pub.publish(data="good")
    await sub.wait_for_messages(2, timeout=20)
    event = sub.peek()
    assert event is not None
    assert event.message == String(data="good")
    assert (sub.queued, sub.stats.errors) == (1, 1)


async def test_the_latest_event(chatter):
    pub, sub = chatter
    assert sub.latest_event is None
    before = sub.node.now()
    pub.publish(data="a")
    assert (await sub.get(timeout=20)).data == "a"
    event = sub.latest_event
    assert event is not None
    assert event.message == sub.latest == String(data="a")
    assert event.raw == String(data="a").to_bytes()
    assert before <= event.received <= sub.node.now()


async def test_waiting_for_messages(chatter):
    pub, sub = chatter
    with pytest.raises(TimeoutError, match="2 messages did not come"):
        await sub.wait_for_messages(2, timeout=0.01)
    with pytest.raises(ValueError, match="11 messages never fit into a queue of 10"):
        await sub.wait_for_messages(11)
    waiting = asyncio.create_task(sub.wait_for_messages(2))
    pub.publish(data="a")
    pub.publish(data="b")
    await asyncio.wait_for(waiting, 20)
    assert [sub.get_nowait().data for _ in range(2)] == ["a", "b"]
    waiting = asyncio.create_task(sub.wait_for_messages())
    await asyncio.sleep(0)
    await sub.close()
    with pytest.raises(aioros1.ClosedError):
        await asyncio.wait_for(waiting, 20)


async def test_waiting_for_messages_of_a_queue_that_blocks(make_node):
    """What was read before the connection could be paused counts as well."""
    node = await make_node()
    async with (
        node.advertise("chatter", String, queue_size=100) as pub,
        node.subscribe("chatter", String, queue_size=2, overflow="block") as sub,
    ):
        await pub.wait_for_subscribers()
        for number in range(20):
            pub.publish(data=str(number))
        got = []
        for _ in range(10):
            await sub.wait_for_messages(2, timeout=20)
            assert sub.next_received is not None
            got += [sub.get_nowait().data, sub.get_nowait().data]
        assert got == [str(number) for number in range(20)]


async def test_arrival_callbacks(chatter):
    pub, sub = chatter
    arrived = asyncio.Event()
    sub.add_arrival_callback(arrived.set)
    pub.publish(data="a")
    await asyncio.wait_for(arrived.wait(), 20)
    assert sub.queued == 1
    arrived.clear()
    sub.remove_arrival_callback(arrived.set)
    sub.remove_arrival_callback(arrived.set)  # not there any more
    pub.publish(data="b")
    await sub.wait_for_messages(2, timeout=20)
    assert not arrived.is_set()
    sub.add_arrival_callback(arrived.set)
    await sub.close()
    assert arrived.is_set()


async def test_merge_goes_on_with_a_queue_that_blocks(make_node):
    node = await make_node()
    async with (
        node.advertise("a", String, queue_size=100) as pub,
        node.subscribe("a", String, queue_size=1, overflow="block") as a,
        node.subscribe("b", String) as b,
    ):
        await pub.wait_for_subscribers()
        for number in range(30):
            pub.publish(data=str(number))
        merged = aioros1.merge(a, b)
        async with asyncio.timeout(20):
            got = [(await anext(merged))[1].data for _ in range(30)]
        assert got == [str(number) for number in range(30)]
