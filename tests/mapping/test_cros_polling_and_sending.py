"""Receiving when one wants to, sending at once, calling at once."""

from __future__ import annotations

import asyncio
import contextlib

import pytest

import aioros1
from aioros1.msg.std_msgs import Int32, String, UInt8MultiArray
from aioros1.srv.roscpp_tutorials import TwoInts

BIG = bytes(1_000_000)
MANY = 64
"""So many of these are more than the sockets between two nodes hold."""


@contextlib.asynccontextmanager
async def connected(pair, type=Int32, *, publish=(), **subscribe):
    """A publisher and a subscriber that have found each other."""
    talker, listener = pair
    async with (
        talker.advertise("count", type, **dict(publish)) as pub,
        listener.subscribe("count", type, **subscribe) as sub,
    ):
        await pub.wait_for_subscribers(timeout=30)
        yield pub, sub


@contextlib.asynccontextmanager
async def unread(pair, **publish):
    """A publisher, and a subscriber that reads no further than its first message."""
    async with connected(
        pair, UInt8MultiArray, publish=publish, overflow="block", queue_size=1
    ) as roles:
        yield roles


# ------------------------------------------------------------------ cRosNodeReceiveTopicMsg


async def test_cRosNodeReceiveTopicMsg(pair):
    async with connected(pair) as (pub, sub):
        pub.publish(data=7)
        assert await sub.get(timeout=30) == Int32(data=7)


async def test_cRosNodeReceiveTopicMsg_with_timeout(make_node):
    node = await make_node()
    async with node.subscribe("count", Int32) as sub:
        with pytest.raises(TimeoutError, match="subscriber /count: no message came"):
            await sub.get(timeout=0.01)


async def test_cRosNodeReceiveTopicMsg_without_timeout_waits(pair):
    async with connected(pair) as (pub, sub):
        waiting = asyncio.create_task(sub.get())
        await asyncio.sleep(0)
        assert not waiting.done()
        pub.publish(data=7)
        assert (await asyncio.wait_for(waiting, 30)).data == 7


async def test_cRosNodeReceiveTopicMsg_with_timeout_zero_is_get_nowait(pair, until):
    async with connected(pair) as (pub, sub):
        with pytest.raises(asyncio.QueueEmpty):
            sub.get_nowait()
        pub.publish(data=7)
        await until(lambda: sub.queued)
        assert sub.get_nowait().data == 7


async def test_cRosNodeReceiveTopicMsg_that_times_out_loses_nothing(pair):
    async with connected(pair) as (pub, sub):
        with pytest.raises(TimeoutError):
            await sub.get(timeout=0.01)
        pub.publish(data=7)
        assert (await sub.get(timeout=30)).data == 7


async def test_cRosNodeReceiveTopicMsg_buff_overflow_is_dropped(pair, until):
    """The flag is a counter: that it has grown since one looked last is the flag."""
    async with connected(pair, queue_size=2) as (pub, sub):
        for number in range(5):
            pub.publish(data=number)
        await until(lambda: sub.stats.messages == 5)
        assert sub.dropped == 3
        assert [sub.get_nowait().data for _ in range(2)] == [3, 4]
        pub.publish(data=5)
        assert (await sub.get(timeout=30)).data == 5
        assert sub.dropped == 3


async def test_MAX_QUEUE_LEN_is_ten_and_the_oldest_goes(pair, until):
    async with connected(pair) as (pub, sub):
        assert (sub.options.queue_size, pub.options.queue_size) == (10, 10)
        assert (sub.options.overflow, pub.options.overflow) == ("drop_oldest", "drop_oldest")
        for number in range(12):
            pub.publish(data=number)
        await until(lambda: sub.stats.messages == 12)
        assert [sub.get_nowait().data for _ in range(10)] == list(range(2, 12))


# ------------------------------------------------------------------ sending


async def test_cRosNodeSendTopicMsg(pair):
    async with connected(pair) as (pub, sub):
        await pub.send(Int32(data=7), timeout=30)
        await pub.send(data=8, timeout=30)
        assert [(await sub.get(timeout=30)).data for _ in range(2)] == [7, 8]


async def test_cRosNodeSendTopicMsg_with_timeout_while_the_queue_is_full(pair):
    async with unread(pair, queue_size=2) as (pub, _), asyncio.timeout(10):
        with pytest.raises(TimeoutError, match="no room in the queue of a subscriber"):
            while True:
                await pub.send(data=BIG, timeout=0.05)
        assert pub.dropped == 0


async def test_cRosNodeSendTopicMsg_goes_on_when_there_is_room(pair):
    async with unread(pair, queue_size=2) as (pub, sub), asyncio.timeout(10):

        async def send():
            for number in range(MANY):
                await pub.send(data=BIG[number:])

        sending = asyncio.create_task(send())
        lengths = [len((await sub.get()).data) for _ in range(MANY)]
        await sending
        assert lengths == [len(BIG) - number for number in range(MANY)]
        assert pub.dropped == 0


async def test_cRosNodeSendTopicMsg_then_drain(pair):
    """Nothing waits in the program any more once ``drain`` has returned."""
    async with unread(pair, queue_size=MANY) as (pub, sub):
        for _ in range(MANY):
            pub.publish(data=BIG)
        with pytest.raises(TimeoutError, match="did not take all"):
            await pub.drain(timeout=0.01)
        draining = asyncio.create_task(pub.drain(timeout=10))
        for _ in range(MANY):
            await sub.get(timeout=30)
        await draining


async def test_cRosNodeQueueTopicMsg_never_waits(pair, until):
    async with connected(pair) as (pub, sub):
        assert pub.publish(data=7) is None
        await until(lambda: sub.queued)
        assert sub.get_nowait().data == 7


async def test_cRosNodeQueueTopicMsg_fails_when_the_queue_is_full(pair):
    async with unread(pair, queue_size=2, overflow="block") as (pub, sub):
        with pytest.raises(asyncio.QueueFull):
            for _ in range(MANY):
                pub.publish(data=BIG)
        published = pub.stats.messages
        assert pub.dropped == 0
        for _ in range(published):
            await sub.get(timeout=30)
        pub.publish(data=b"room again")
        assert (await sub.get(timeout=30)).data == b"room again"


async def test_cRosNodeQueueTopicMsg_drops_the_oldest_by_default(pair):
    async with unread(pair, queue_size=2) as (pub, sub), asyncio.timeout(10):
        for _ in range(MANY):
            pub.publish(data=BIG)
        for word in (b"one", b"two", b"three"):
            pub.publish(data=word)
        dropped = pub.dropped
        heard = [(await sub.get()).data]
        while heard[-1] != b"three":
            heard.append((await sub.get()).data)
        assert [data for data in heard if data != BIG] == [b"two", b"three"]
        assert dropped == pub.dropped == MANY + 3 - len(heard)


# ------------------------------------------------------------------ calling


async def test_cRosNodeServiceCall(pair):
    server, client = pair
    await server.advertise_service("add", TwoInts, lambda request: {"sum": request.a + request.b})
    async with client.service_caller("add", TwoInts) as caller:
        assert (await caller.call(TwoInts.Request(a=1, b=2), timeout=30)).sum == 3
        assert (await caller(a=3, b=4, timeout=30)).sum == 7


async def test_cRosNodeServiceCall_with_timeout(pair):
    server, client = pair
    await server.advertise_service("add", TwoInts)  # and nobody answers
    async with client.service_caller("add", TwoInts) as caller:
        with pytest.raises(TimeoutError, match="service /add: no answer"):
            await caller.call(a=1, b=2, timeout=0.05)
        assert caller.connections == ()


async def test_cRosNodeServiceCall_with_the_timeout_of_the_caller(pair):
    server, client = pair
    await server.advertise_service("add", TwoInts)
    async with client.service_caller("add", TwoInts, timeout=0.05) as caller:
        with pytest.raises(TimeoutError):
            await caller.call(a=1, b=2)


async def test_cRosApiCreatePublisherMessage(pair):
    async with connected(pair) as (pub, sub):
        message = pub.message(data=7)
        assert type(message) is pub.message_class is Int32
        pub.publish(message)
        assert await sub.get(timeout=30) == message


async def test_cRosApiCreateServiceCallerRequest(pair):
    server, client = pair
    await server.advertise_service("add", TwoInts, lambda request: {"sum": request.a + request.b})
    async with client.service_caller("add", TwoInts) as caller:
        request = caller.request(a=1)
        request.b = 2
        assert type(request) is caller.service_class.Request
        assert (await caller.call(request, timeout=30)).sum == 3


# ------------------------------------------------------------------ packets and queues


async def test_cRosNodeSerializeOutgoingMessage(pair):
    """What is on the wire is ``to_bytes()``."""
    async with connected(pair, String) as (pub, sub):
        message = String(data="hi")
        pub.publish(message)
        async with asyncio.timeout(30):
            event = await anext(sub.events())
        assert event.raw == message.to_bytes() == b"\2\0\0\0hi"
        assert event.header["callerid"] == "/talker"


async def test_cRosNodeDeserializeIncomingPacket(pair):
    """What was received is ``from_bytes()`` of what was on the wire."""
    async with connected(pair, String) as (pub, sub):
        pub.publish_raw(b"\2\0\0\0hi")
        assert await sub.get(timeout=30) == String.from_bytes(b"\2\0\0\0hi")


@pytest.fixture
async def queue(pair, until):
    """A subscriber of three whose queue holds 1 and 2."""
    async with connected(pair, queue_size=3) as (pub, sub):
        pub.publish(data=1)
        pub.publish(data=2)
        await until(lambda: sub.queued == 2)
        yield pub, sub


async def test_cRosMessageQueueInit(make_node):
    node = await make_node()
    async with node.subscribe("count", Int32, queue_size=3) as sub:
        assert (sub.queued, sub.options.queue_size) == (0, 3)
    with pytest.raises(ValueError, match="at least 1"):
        node.subscribe("count", Int32, queue_size=0)


async def test_cRosMessageQueueUsage(queue):
    _, sub = queue
    assert sub.queued == 2


async def test_cRosMessageQueueVacancies(queue):
    _, sub = queue
    assert sub.options.queue_size - sub.queued == 1


async def test_cRosMessageQueueAdd(queue, until):
    pub, sub = queue
    pub.publish(data=3)
    await until(lambda: sub.queued == 3)


@pytest.mark.parametrize(
    "function", ["cRosMessageQueueGet", "cRosMessageQueueExtract", "cRosMessageQueueRemove"]
)
async def test_taking_from_the_queue(queue, function):
    _, sub = queue
    assert sub.get_nowait().data == 1
    assert sub.queued == 1


async def test_cRosMessageQueuePeekLast(queue):
    _, sub = queue
    assert sub.latest.data == 2
    assert sub.queued == 2


@pytest.mark.parametrize("function", ["cRosMessageQueueClear", "cRosMessageQueueRelease"])
async def test_emptying_the_queue(queue, function):
    _, sub = queue
    if function == "cRosMessageQueueClear":
        with pytest.raises(asyncio.QueueEmpty):
            while True:
                sub.get_nowait()
    else:
        await sub.close()
        with pytest.raises(aioros1.ClosedError):
            sub.get_nowait()
    assert sub.queued == 0
