"""What a publisher promises, whatever its subscribers do."""

from __future__ import annotations

import asyncio
import contextlib
import socket

import pytest

import aioros1
from aioros1.events import PeerDisconnected
from aioros1.msg.geometry_msgs import PointStamped
from aioros1.msg.std_msgs import String

from .peers import PATIENCE, Wire, dialled, string, subscriber_header, until


@pytest.fixture
async def node(make_node):
    return await make_node("talker", timeouts=aioros1.Timeouts(close=1))


@contextlib.asynccontextmanager
async def listening(node, pub, topic="/chatter", count=1):
    """A raw subscriber whose connection is established on both sides."""
    async with dialled(node, subscriber_header(topic)) as wire:
        await wire.read_header()
        await pub.wait_for_subscribers(count, timeout=30)
        yield wire


def numbered(number: int, size: int = 0) -> str:
    return f"{number:08d}".ljust(size, ".")


async def numbers(wire, count: int) -> list[int]:
    return [int((await wire.string())[:8]) for _ in range(count)]


async def test_all_messages_published_in_one_turn_of_the_loop_arrive(node):
    async with node.advertise("chatter", String) as pub, listening(node, pub) as wire:
        for number in range(500):
            pub.publish(data=numbered(number))
        assert await numbers(wire, 500) == [*range(500)]


async def test_messages_published_just_before_the_publisher_closes_arrive(node):
    pub = await node.advertise("chatter", String)
    async with listening(node, pub) as wire:
        for number in range(50):
            pub.publish(data=numbered(number, 10_000))
        await pub.close()
        assert await numbers(wire, 50) == [*range(50)]
        assert await wire.is_closed()


async def test_closing_the_node_sends_what_was_published(make_node):
    node = await make_node("talker")
    pub = await node.advertise("chatter", String, queue_size=100)
    async with listening(node, pub) as wire:
        wire.pause()
        for number in range(50):
            pub.publish(data=numbered(number, 200_000))
        closing = asyncio.create_task(node.close())
        wire.resume()
        assert await numbers(wire, 50) == [*range(50)]
        await closing


async def test_order_is_kept_whatever_the_sizes(node):
    """Small messages are joined, large ones are not: neither overtakes the other."""
    sizes = [10, 70_000, 20, 60_000, 5_000, 200_000, 30, 30, 65_536, 65_000, 65_000]
    count = 20 * len(sizes)
    async with (
        node.advertise("chatter", String, queue_size=count) as pub,
        listening(node, pub) as wire,
    ):
        for number in range(count):
            pub.publish(data=numbered(number, sizes[number % len(sizes)]))
            if number % 7 == 0:
                await asyncio.sleep(0)
        assert await numbers(wire, count) == [*range(count)]
        assert pub.dropped == 0


@pytest.mark.parametrize("last", [70_000, 300_000])
async def test_a_connection_that_fills_up_in_the_middle_of_a_turn_loses_nothing(node, last):
    sizes = [100, 50_000, last]  # written at once, joined with others, written alone
    per_round, rounds = 120, 8
    async with (
        node.advertise("chatter", String, queue_size=10_000) as pub,
        listening(node, pub) as wire,
    ):
        for begin in range(0, rounds * per_round, per_round):
            wire.pause()
            # Shifted by a little each time, so that it is full at another place.
            pub.publish(data=numbered(begin, 5_003 * begin // per_round + 10))
            for number in range(begin + 1, begin + per_round):
                pub.publish(data=numbered(number, sizes[number % 3]))
                if number % 3 == 2:
                    await asyncio.sleep(0)
            wire.resume()
            assert await numbers(wire, per_round) == [*range(begin, begin + per_round)]
        assert pub.dropped == 0


async def test_one_serialisation_for_all_subscribers(node, monkeypatch):
    made = 0
    encode = String._frame

    def counting(message):
        nonlocal made
        made += 1
        return encode(message)

    monkeypatch.setattr(String, "_frame", counting)
    async with node.advertise("chatter", String) as pub, contextlib.AsyncExitStack() as stack:
        wires = [
            await stack.enter_async_context(listening(node, pub, count=count))
            for count in range(1, 6)
        ]
        for number in range(10):
            pub.publish(data=numbered(number))
        for wire in wires:
            assert await numbers(wire, 10) == [*range(10)]
    assert made == 10


# queues

BIG = 200_000
"""Bytes of a message of which few fit into the buffers of the system."""


async def fill(pub, count: int = 100) -> None:
    for number in range(count):
        pub.publish(data=numbered(number, BIG))


async def test_drop_oldest_keeps_the_newest_and_counts_the_rest(node):
    async with (
        node.advertise("chatter", String, queue_size=3) as pub,
        listening(node, pub) as wire,
    ):
        wire.pause()
        await fill(pub)
        dropped = pub.dropped
        wire.resume()
        got = await numbers(wire, 100 - dropped)
        taken = len(got) - 3  # by the system, before it was full
        assert got == [*range(taken), 97, 98, 99]
        assert dropped == 97 - taken > 0
        assert pub.connections[0].stats.dropped == pub.stats.dropped == dropped
        pub.publish(data=numbered(100))
        assert await numbers(wire, 1) == [100]


async def test_drop_newest_keeps_the_oldest_and_counts_the_rest(node):
    async with (
        node.advertise("chatter", String, queue_size=3, overflow="drop_newest") as pub,
        listening(node, pub) as wire,
    ):
        wire.pause()
        await fill(pub)
        dropped = pub.dropped
        wire.resume()
        assert await numbers(wire, 100 - dropped) == [*range(100 - dropped)]
        assert pub.connections[0].stats.dropped == dropped > 0
        pub.publish(data=numbered(100))
        assert await numbers(wire, 1) == [100]


async def test_block_raises_and_nobody_got_the_message(node):
    async with (
        node.advertise("chatter", String, queue_size=3, overflow="block") as pub,
        listening(node, pub) as slow,
        listening(node, pub, count=2) as quick,
    ):
        slow.pause()
        published = 0
        with pytest.raises(asyncio.QueueFull, match="use send"):
            for published in range(100):
                pub.publish(data=numbered(published, BIG))
        assert 3 < published < 100
        assert await numbers(quick, published) == [*range(published)]
        slow.resume()
        assert await numbers(slow, published) == [*range(published)]
        pub.publish(data=numbered(published))
        assert await numbers(quick, 1) == await numbers(slow, 1) == [published]
        assert pub.dropped == 0


async def test_each_subscriber_has_its_own_queue(node):
    async with (
        node.advertise("chatter", String, queue_size=3) as pub,
        listening(node, pub) as slow,
        listening(node, pub, count=2) as quick,
    ):
        slow.pause()
        for number in range(60):
            pub.publish(data=numbered(number, BIG))
            assert await numbers(quick, 1) == [number]
        one, two = (connection.stats.dropped for connection in pub.connections)
        assert sorted([one, two]) == [0, pub.dropped]


async def test_the_publishers_of_one_topic_have_queues_of_their_own(node):
    async with (
        node.advertise("chatter", String, queue_size=2) as one,
        node.advertise("chatter", String, queue_size=4, overflow="drop_newest") as two,
        listening(node, one) as wire,
    ):
        wire.pause()
        await fill(one)
        for number in range(1000, 1010):
            two.publish(data=numbered(number))
        assert two.dropped == 6
        wire.resume()
        got = await numbers(wire, 100 - one.dropped + 4)
        assert got[-6:] == [98, 99, 1000, 1001, 1002, 1003]


async def test_send_waits_for_room_and_can_be_cancelled(node):
    async with (
        node.advertise("chatter", String, queue_size=1) as pub,
        listening(node, pub) as wire,
    ):
        wire.pause()
        sent = 0
        with pytest.raises(TimeoutError):
            while True:
                await pub.send(data=numbered(sent, BIG), timeout=0.05)
                sent += 1
        assert pub.dropped == 0
        wire.resume()
        assert await numbers(wire, sent) == [*range(sent)]
        await pub.send(data=numbered(sent), timeout=30)
        assert await numbers(wire, 1) == [sent]


async def test_drain_waits_until_everything_is_taken(node):
    async with (
        node.advertise("chatter", String, queue_size=100) as pub,
        listening(node, pub) as wire,
    ):
        wire.pause()
        await fill(pub)
        with pytest.raises(TimeoutError):
            await pub.drain(timeout=0.02)
        wire.resume()
        assert await numbers(wire, 100) == [*range(100)]
        await pub.drain(timeout=30)


# stalled peers


async def test_a_stalled_subscriber_is_cut_off_and_the_others_never_notice(make_node):
    node = await make_node("talker", timeouts=aioros1.Timeouts(stall=0.15))
    events = node.events()
    async with (
        node.advertise("chatter", String, queue_size=1000) as pub,
        listening(node, pub) as quick,
        listening(node, pub, count=2) as stuck,
    ):
        stuck.pause()
        number = 0
        async with asyncio.timeout(30):
            while pub.subscriber_count == 2:
                pub.publish(data=numbered(number, BIG))
                assert await numbers(quick, 1) == [number]
                number += 1
                await asyncio.sleep(0.001)
        pub.publish(data=numbered(number))
        assert await numbers(quick, 1) == [number]
        async for event in events:
            if isinstance(event, PeerDisconnected):
                assert event.reason
                break


async def test_a_subscriber_that_takes_a_little_now_and_then_is_not_cut_off(make_node):
    node = await make_node("talker", timeouts=aioros1.Timeouts(stall=0.5))
    async with (
        node.advertise("chatter", String, queue_size=1000) as pub,
        listening(node, pub) as wire,
    ):
        wire.pause()
        await fill(pub)
        begin = asyncio.get_running_loop().time()
        taken = 0
        while asyncio.get_running_loop().time() - begin < 1.2:
            wire.resume()
            taken += len(await numbers(wire, 4))
            wire.pause()
            await asyncio.sleep(0.05)
            assert pub.subscriber_count == 1
        wire.resume()
        assert (await numbers(wire, 100 - taken))[-1] == 99


async def test_an_idle_subscriber_is_never_cut_off(make_node):
    node = await make_node("talker", timeouts=aioros1.Timeouts(stall=0.05))
    async with node.advertise("chatter", String) as pub, listening(node, pub) as wire:
        pub.publish(data=numbered(0))
        await asyncio.sleep(0.2)
        pub.publish(data=numbered(1))
        assert await numbers(wire, 2) == [0, 1]


async def test_closing_does_not_wait_for_a_stalled_subscriber(make_node):
    node = await make_node("talker", timeouts=aioros1.Timeouts(close=0.2))
    pub = await node.advertise("chatter", String, queue_size=1000)
    async with listening(node, pub) as wire:
        wire.pause()
        await fill(pub)
        async with asyncio.timeout(PATIENCE):
            await pub.close()
        assert not node.connections


# header.seq


async def test_seq_is_counted_by_each_publisher(node):
    async with (
        node.advertise("points", PointStamped) as one,
        node.advertise("points", PointStamped) as two,
        node.subscribe("points", PointStamped) as sub,
    ):
        await sub.wait_for_publishers(timeout=30)
        await one.wait_for_subscribers(timeout=30)
        message = PointStamped()
        message.header.seq = 99
        for publisher in (one, one, two):
            publisher.publish(message)
        one.publish(header={"frame_id": "map"})
        got = [(await sub.get(timeout=30)).header.seq for _ in range(4)]
        assert got == [1, 2, 1, 3]


async def test_connections_that_come_and_go_leave_nothing(node, open_files):
    async with node.advertise("chatter", String) as pub:
        async with listening(node, pub):
            pass
        await until(lambda: not pub.connections)
        tasks, files = len(asyncio.all_tasks()), open_files()
        for round_ in range(40):
            async with listening(node, pub) as wire:
                pub.publish(data="hi")
                if round_ % 4 == 0:
                    assert await wire.take(len(string("hi"))) == string("hi")
                if round_ % 2:
                    wire.abort()
            await until(lambda: not pub.connections)
        await until(lambda: len(asyncio.all_tasks()) <= tasks)
        await until(lambda: open_files() <= files)


async def test_a_connection_that_was_full_before_its_first_message_gets_each_once(make_node):
    """The header alone may be more than the kernel takes at once."""
    node = await make_node()
    headers = {"calibration": "x" * (8 << 20)}
    options = {"headers": headers, "queue_size": 100, "latch": True}
    async with node.advertise("chatter", String, **options) as pub:
        pub.publish(data="latched")
        host, port = node.tcpros_address
        with socket.socket() as sock:
            sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            sock.setblocking(False)
            loop = asyncio.get_running_loop()
            await loop.sock_connect(sock, (host, port))
            await loop.sock_sendall(sock, subscriber_header())
            await until(lambda: pub.subscriber_count == 1)
            for number in range(5):
                pub.publish(data=str(number))
            reader, writer = await asyncio.open_connection(sock=sock.dup())
        wire = Wire(reader, writer)
        assert len((await wire.read_header())["calibration"]) == 8 << 20
        for number in range(5, 10):
            pub.publish(data=str(number))
        got = [await wire.string() for _ in range(11)]
        assert got == ["latched", *map(str, range(10))], got
        assert (pub.subscriber_count, pub.dropped) == (1, 0)
        wire.abort()
        await wire.close()


# opened again while the last publisher of the topic is closing


async def stalled(node, pub, wire):
    """Fill the connection of a subscriber that reads nothing."""
    while not pub.dropped:
        pub.publish(data=numbered(0, 100_000))
        await asyncio.sleep(0)


async def test_a_publisher_opened_while_another_closes_keeps_its_subscribers(make_node):
    """Those that have connected again must not be cut off with the one that takes nothing."""
    node = await make_node("talker", timeouts=aioros1.Timeouts(close=0.5))
    listener = await make_node("listener")
    first = await node.advertise("/chatter", String)
    options = {"queue_size": 100, "overflow": "block"}
    async with listening(node, first) as stuck:
        await stalled(node, first, stuck)
        closing = asyncio.create_task(first.close())
        await asyncio.sleep(0)
        sub = await listener.subscribe("/chatter", String, **options)
        second = await node.advertise("/chatter", String, **options)
        assert second.subscriber_count == 0
        await second.wait_for_subscribers(timeout=30)
        (connection,) = second.connections
        for number in range(2_000):
            # Sending does not wait for the one that takes nothing.
            await second.send(data=numbered(number), timeout=30)
            if number % 20 == 0:
                await asyncio.sleep(0.01 if not closing.done() else 0)
        await closing
        for number in range(2_000, 2_100):
            await second.send(data=numbered(number), timeout=30)
        got = [int((await sub.get(timeout=30)).data[:8]) for _ in range(2_100)]
        assert got == [*range(2_100)]
        assert [each.id for each in second.connections] == [connection.id]


async def test_what_is_published_to_a_closing_connection_is_not_said_to_be_sent(make_node):
    """A subscriber that was connected to the last publisher has to connect again first."""
    node = await make_node("talker", timeouts=aioros1.Timeouts(close=0.5))
    listener = await make_node("listener")
    sub = await listener.subscribe("/chatter", String)
    for number in range(5):
        pub = await node.advertise("/chatter", String)
        await pub.wait_for_subscribers(timeout=30)
        pub.publish(data=numbered(number))
        closing = asyncio.create_task(pub.close())
        await asyncio.sleep(0)
        assert int((await sub.get(timeout=30)).data[:8]) == number
        pub = await node.advertise("/chatter", String)
        await pub.wait_for_subscribers(timeout=30)
        pub.publish(data=numbered(100 + number))
        assert int((await sub.get(timeout=30)).data[:8]) == 100 + number
        await closing
        await pub.close()
