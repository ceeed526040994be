"""What a subscriber promises, whatever its publishers do."""

from __future__ import annotations

import asyncio
import contextlib
import gc
import tracemalloc
import weakref

import pytest

import aioros1
from aioros1.msg.std_msgs import String

from .peers import STRING_REPLY, header, string, until


@pytest.fixture
async def node(make_node):
    return await make_node("listener")


@pytest.fixture
async def fake(make_publisher):
    return await make_publisher()


def numbered(number: int, size: int = 0) -> str:
    return f"{number:08d}".ljust(size, ".")


def burst(*numbers: int, size: int = 0) -> bytes:
    return b"".join(string(numbered(number, size)) for number in numbers)


def taken(sub: aioros1.Subscriber) -> list[int]:
    """All that is in the queue."""
    return [int(sub.get_nowait().data[:8]) for _ in range(sub.queued)]


async def received(sub: aioros1.Subscriber, count: int) -> None:
    await until(lambda: sub.stats.messages == count, f"{count} messages came")


# queues


@pytest.mark.parametrize("together", [True, False])
async def test_drop_oldest_keeps_the_newest_and_counts_the_rest(node, fake, together):
    async with node.subscribe("chatter", String, queue_size=10) as sub:
        wire = await fake.subscribed()
        for part in [range(25)] if together else [range(7), range(7, 11), range(11, 25)]:
            await wire.send(burst(*part))
            await received(sub, part[-1] + 1)
        assert (sub.dropped, sub.stats.dropped, sub.queued) == (15, 15, 10)
        assert taken(sub) == [*range(15, 25)]
        await wire.send(burst(25))
        assert (await sub.get(timeout=30)).data == numbered(25)
        assert sub.dropped == 15


@pytest.mark.parametrize("together", [True, False])
async def test_drop_newest_keeps_the_oldest_and_counts_the_rest(node, fake, together):
    async with node.subscribe("chatter", String, queue_size=10, overflow="drop_newest") as sub:
        wire = await fake.subscribed()
        for part in [range(25)] if together else [range(7), range(7, 11), range(11, 25)]:
            await wire.send(burst(*part))
            await received(sub, part[-1] + 1)
        assert (sub.dropped, sub.queued) == (15, 10)
        assert taken(sub) == [*range(10)]
        await wire.send(burst(25))
        assert (await sub.get(timeout=30)).data == numbered(25)


async def test_what_is_dropped_was_never_decoded(node, fake):
    """A message that cannot be decoded is only an error when it is taken."""
    async with node.subscribe("chatter", String, queue_size=1) as sub:
        wire = await fake.subscribed()
        bad = b"\x04\x00\x00\x00" + b"\xff\xff\xff\xff"  # a string longer than its message
        await wire.send(bad, burst(1))
        await received(sub, 2)
        assert (await sub.get(timeout=30)).data == numbered(1)
        assert (sub.dropped, sub.stats.errors) == (1, 0)


@pytest.mark.parametrize("size", [0, 2_000, 100_000])
async def test_block_loses_nothing_and_keeps_the_order(node, fake, size):
    async with node.subscribe("chatter", String, queue_size=3, overflow="block") as sub:
        wire = await fake.subscribed()
        sending = asyncio.create_task(wire.send(burst(*range(200), size=size)))
        await until(lambda: sub.queued == 3)
        assert sub.queued == 3
        for number in range(200):
            assert (await sub.get(timeout=30)).data[:8] == numbered(number)
        await sending
        assert sub.dropped == 0


async def test_block_carries_the_pressure_back_to_the_publisher(node, fake):
    async with node.subscribe("chatter", String, queue_size=1, overflow="block") as sub:
        wire = await fake.subscribed()
        # More than the system buffers on both sides.
        sending = asyncio.create_task(wire.send(burst(*range(300), size=100_000)))
        await until(lambda: sub.queued)
        with pytest.raises(TimeoutError):
            await asyncio.wait_for(asyncio.shield(sending), 0.05)
        assert sub.stats.bytes < 2_000_000
        for number in range(300):
            assert (await sub.get(timeout=30)).data[:8] == numbered(number)
        await sending


async def test_block_with_a_publisher_that_ends_loses_nothing(node, fake):
    async with node.subscribe("chatter", String, queue_size=1, overflow="block") as sub:
        wire = await fake.subscribed()
        await wire.send(burst(*range(50), size=1_000))
        await wire.close()
        assert [(await sub.get(timeout=30)).data[:8] for _ in range(50)] == [
            numbered(number) for number in range(50)
        ]


@pytest.mark.parametrize("pub_overflow", ["block", "drop_oldest"])
async def test_ten_thousand_messages_and_a_subscriber_that_pauses(make_node, node, pub_overflow):
    """With send() on one side and block on the other not one is lost."""
    talker = await make_node("talker")
    count = 10_000
    async with (
        talker.advertise("chatter", String, queue_size=5, overflow=pub_overflow) as pub,
        node.subscribe("chatter", String, queue_size=5, overflow="block") as sub,
    ):
        await pub.wait_for_subscribers(timeout=30)
        await sub.wait_for_publishers(timeout=30)

        async def talk():
            for number in range(count):
                await pub.send(data=numbered(number, 2_000))

        talking = asyncio.create_task(talk())
        with pytest.raises(TimeoutError):
            while True:  # until no more fits into the buffers of the system
                await pub.drain(timeout=0.05)
                await asyncio.sleep(0)
        assert sub.queued == 5
        assert not talking.done()
        got = [int((await sub.get(timeout=30)).data[:8]) for _ in range(count)]
        await talking
        assert got == [*range(count)]
        assert pub.dropped == sub.dropped == 0


async def test_two_subscribers_of_one_node_share_the_connection_and_see_everything(node, fake):
    async with (
        node.subscribe("chatter", String, queue_size=100) as one,
        node.subscribe("chatter", String, queue_size=2) as two,
        node.subscribe("chatter", queue_size=100) as three,
    ):
        wire = await fake.subscribed()
        await wire.send(burst(*range(20)))
        await received(three, 20)
        assert (one.dropped, two.dropped, three.dropped) == (0, 18, 0)
        assert taken(one) == taken(three) == [*range(20)]
        assert taken(two) == [18, 19]
        assert fake.dials == 1


async def test_a_blocked_subscriber_is_let_go_when_it_closes(node, fake):
    async with node.subscribe("chatter", String, queue_size=1000) as other:
        wire = await fake.subscribed()
        async with node.subscribe("chatter", String, queue_size=1, overflow="block") as blocked:
            await wire.send(burst(*range(5)))
            await until(lambda: blocked.queued)
            await wire.send(burst(*range(5, 10)))
        assert [int((await other.get(timeout=30)).data[:8]) for _ in range(10)] == [*range(10)]


async def test_a_queue_of_one_holds_the_newest(make_node, node):
    talker = await make_node("talker")
    async with (
        talker.advertise("chatter", String, queue_size=10_000) as pub,
        node.subscribe("chatter", String, queue_size=1) as sub,
    ):
        await pub.wait_for_subscribers(timeout=30)
        for number in range(1_000):
            pub.publish(data=numbered(number, 5_000))
        await received(sub, 1_000)
        assert (await sub.get(timeout=30)).data[:8] == numbered(999)
        assert sub.dropped == 999


async def test_a_queue_is_bounded_in_memory_too(node, fake):
    """Messages that were dropped are not kept by the ones that arrived with them."""
    async with node.subscribe("chatter", String, queue_size=2) as sub:
        wire = await fake.subscribed()
        await sub.wait_for_publishers(timeout=30)
        tracemalloc.start()
        try:
            for number in range(20):
                await wire.send(burst(number, size=500_000))
            await received(sub, 20)
            assert sub.queued == 2
            assert tracemalloc.get_traced_memory()[0] < 4_000_000
        finally:
            tracemalloc.stop()


# order and latched messages


async def test_what_comes_behind_the_header_comes_first(node, fake):
    async with node.subscribe("chatter", String, queue_size=100) as sub:
        wire = await fake.greeted()
        await wire.send(header(STRING_REPLY) + burst(*range(50)))
        await wire.send(burst(*range(50, 100)))
        await received(sub, 100)
        assert taken(sub) == [*range(100)]


async def test_a_latched_message_reaches_subscribers_that_come_later(node, fake):
    async with node.subscribe("chatter", String) as one:
        wire = await fake.subscribed({"latching": "1"})
        await wire.send(burst(1, 2))
        await received(one, 2)
        async with node.subscribe("chatter", String) as two:
            assert (await two.get(timeout=30)).data == numbered(2)
        assert fake.dials == 1


async def test_get_that_is_cancelled_loses_nothing(node, fake):
    async with node.subscribe("chatter", String, queue_size=1000) as sub:
        wire = await fake.subscribed()

        async def talk() -> None:
            for number in range(300):
                await wire.send(burst(number))
                await asyncio.sleep(0.0002)

        talking = asyncio.create_task(talk())
        got: list[int] = []
        async with asyncio.timeout(10):
            while len(got) < 300:
                with contextlib.suppress(TimeoutError):
                    # About as long as a message takes, so that they often coincide.
                    message = await asyncio.wait_for(sub.get(), 0.0003)
                    got.append(int(message.data[:8]))
        await talking
        assert got == [*range(300)]


async def test_several_who_wait_share_the_messages(node, fake):
    async with node.subscribe("chatter", String) as sub:
        wire = await fake.subscribed()
        getting = [asyncio.create_task(sub.get(timeout=30)) for _ in range(5)]
        await asyncio.sleep(0)
        await wire.send(burst(*range(5)))
        got = [message.data for message in await asyncio.gather(*getting)]
        assert sorted(got) == [numbered(number) for number in range(5)]


async def test_publishers_that_come_and_go_leave_nothing(node, fake, open_files):
    async with node.subscribe("chatter", String, queue_size=100) as sub:

        async def once() -> None:
            wire = await fake.subscribed()
            await wire.send(burst(1))
            await sub.get(timeout=30)
            await wire.close()
            await until(lambda: not sub.connections)
            await fake.register()  # or the next one would have to wait

        await once()
        tasks, files = len(asyncio.all_tasks()), open_files()
        for _ in range(30):
            await once()
        await until(lambda: len(asyncio.all_tasks()) <= tasks + 2)
        await until(lambda: open_files() <= files + 2)


async def test_a_closed_subscriber_is_forgotten(node, fake):
    sub = await node.subscribe("chatter", String)
    wire = await fake.subscribed()
    await wire.send(burst(1))
    await sub.get(timeout=30)
    await sub.close()
    assert await wire.is_closed()
    gone = weakref.ref(sub)
    del sub
    await until(lambda: gc.collect() is not None and gone() is None)
