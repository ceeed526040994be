"""Subscribers with a callback."""

from __future__ import annotations

import asyncio
import functools

import pytest

import aioros1
from aioros1.msg.std_msgs import Header, String


async def until(condition):
    async with asyncio.timeout(20):
        while not condition():
            await asyncio.sleep(0.001)


async def test_a_plain_function_gets_each_message_in_order(make_node):
    node = await make_node()
    got = []
    async with (
        node.advertise("chatter", String) as pub,
        node.subscribe("chatter", String, got.append) as sub,
    ):
        await pub.wait_for_subscribers()
        for number in range(100):
            pub.publish(data=str(number))
        await until(lambda: len(got) == 100)
        assert got == [String(data=str(number)) for number in range(100)]
        assert sub.callback == got.append
        assert (sub.queued, sub.dropped, sub.stats.messages) == (0, 0, 100)
        assert sub.latest == String(data="99")


async def test_a_coroutine_function_is_awaited_message_by_message(make_node):
    node = await make_node()
    got, running = [], 0

    async def callback(message):
        nonlocal running
        running += 1
        assert running == 1
        for _ in range(3):
            await asyncio.sleep(0)
        got.append(message.data)
        running -= 1

    async with (
        node.advertise("chatter", String) as pub,
        node.subscribe("chatter", String, callback, queue_size=100),
    ):
        await pub.wait_for_subscribers()
        for number in range(50):
            pub.publish(data=str(number))
        await until(lambda: len(got) == 50)
        assert got == [str(number) for number in range(50)]


async def test_a_queue_stands_before_a_coroutine_function(make_node):
    """It drops as any queue does, and loses nothing with ``overflow="block"``."""
    node, other = await make_node("node"), await make_node("other")
    got, dropping, go_on = [], [], asyncio.Event()

    async def slow(message):
        await go_on.wait()
        got.append(message.data)

    async def slow_and_dropping(message):
        await go_on.wait()
        dropping.append(message.data)

    async with (
        node.advertise("chatter", String, queue_size=1000) as pub,
        node.subscribe("chatter", String, slow, queue_size=2, overflow="block"),
        other.subscribe("chatter", String, slow_and_dropping, queue_size=2) as drops,
    ):
        await pub.wait_for_subscribers(2)
        for number in range(20):
            pub.publish(data=str(number))
        await until(lambda: drops.stats.messages == 20)
        go_on.set()
        await until(lambda: len(got) == 20)
        assert got == [str(number) for number in range(20)]
        assert drops.dropped == 20 - len(dropping) > 10
        assert dropping[-1] == "19"


@pytest.mark.parametrize("kind", ["partial", "partial object", "object", "method"])
async def test_what_is_a_coroutine_function_is_seen(make_node, kind):
    node = await make_node()
    got = []

    class Sink:
        async def __call__(self, message):
            await asyncio.sleep(0)
            got.append(message)

        async def method(self, message):
            await self(message)

    async def two(first, message):
        await Sink()(message)

    sink = Sink()
    callback = {
        "partial": functools.partial(two, 1),
        "partial object": functools.partial(sink),
        "object": sink,
        "method": sink.method,
    }[kind]
    async with (
        node.advertise("chatter", String, latch=True) as pub,
        node.subscribe("chatter", String, callback),
    ):
        pub.publish(data="hello")
        await until(lambda: got == [String(data="hello")])


@pytest.mark.parametrize("is_async", [False, True])
async def test_latched_messages_come_first(make_node, is_async):
    talker, listener = await make_node("talker"), await make_node("listener")
    got, messages = [], []

    async def take_later(message):
        messages.append(message.data)

    def take(message):
        messages.append(message.data)

    async with (
        talker.advertise("chatter", String, latch=True) as pub,
        listener.subscribe("chatter", String, got.append),
    ):
        pub.publish(data="latched")
        await until(lambda: got)
        # The connection is there already: it is not the publisher that sends it again.
        async with listener.subscribe("chatter", String, take_later if is_async else take):
            pub.publish(data="next")
            await until(lambda: len(messages) == 2)
            assert messages == ["latched", "next"]


@pytest.mark.parametrize("is_async", [False, True])
async def test_exceptions_go_to_on_error_and_the_next_message_comes(make_node, is_async):
    errors, got = [], []
    node = await make_node(on_error=errors.append)

    def fail(message):
        got.append(message.data)
        raise ValueError(message.data)

    async def fail_later(message):
        await asyncio.sleep(0)
        fail(message)

    async with (
        node.advertise("chatter", String) as pub,
        node.subscribe("chatter", String, fail_later if is_async else fail),
    ):
        await pub.wait_for_subscribers()
        pub.publish(data="a")
        pub.publish(data="b")
        await until(lambda: len(errors) == 2)
        assert [str(error) for error in errors] == got == ["a", "b"]


async def test_an_exception_ends_the_node_by_default(make_node, master):
    node = await aioros1.Node("failing", master_uri=master.uri, host="localhost").start()

    def fail(message):
        raise ValueError("no")

    await node.subscribe("chatter", String, fail)
    async with (await make_node("talker")).advertise("chatter", String, latch=True) as pub:
        pub.publish(data="a")
        with pytest.raises(ValueError, match="no"):
            await node.wait_closed()
    assert "the callback of subscriber /chatter failed" in (node.close_reason or "")


@pytest.mark.parametrize("is_async", [False, True])
async def test_a_cancellation_that_was_not_ours_is_an_error(make_node, is_async):
    """The next message comes, and other subscribers of the connection do not notice."""
    errors, got, others = [], [], []
    node = await make_node(on_error=errors.append)

    def fail(message):
        got.append(message.data)
        raise asyncio.CancelledError("of something else")

    async def fail_later(message):
        fail(message)

    async with (
        node.advertise("chatter", String) as pub,
        node.subscribe("chatter", String, fail_later if is_async else fail),
        node.subscribe("chatter", String, lambda message: others.append(message.data)) as other,
    ):
        await pub.wait_for_subscribers()
        for data in "abc":
            pub.publish(data=data)
        await until(lambda: len(got) == len(others) == 3)
        assert got == others == ["a", "b", "c"]
        assert all(isinstance(error.__cause__, asyncio.CancelledError) for error in errors)
        assert len(errors) == 3
        assert len(other.connections) == 1


async def test_the_end_of_the_node_is_no_error_of_a_callback(master):
    async with aioros1.Node("node", master_uri=master.uri, host="localhost") as node:
        begun = asyncio.Event()

        async def wait(message):
            begun.set()
            await node.sleep(3600)

        await node.subscribe("chatter", String, wait)
        pub = await node.advertise("chatter", String, latch=True)
        pub.publish(data="a")
        await asyncio.wait_for(begun.wait(), 20)


@pytest.mark.parametrize("is_async", [False, True])
async def test_closing_from_within(make_node, is_async):
    """No further message comes, and a coroutine function runs to its end."""
    node = await make_node()
    got, closed = [], asyncio.Event()

    async def close_and_go_on(message):
        got.append(message.data)
        await subscriber.close()
        await asyncio.sleep(0)
        closed.set()

    def close_soon(message):
        got.append(message.data)
        node.create_task(subscriber.close())
        subscriber_is_closing.append(True)

    subscriber_is_closing: list[bool] = []
    async with node.advertise("chatter", String, queue_size=100) as pub:
        subscriber = await node.subscribe(
            "chatter", String, close_and_go_on if is_async else close_soon, queue_size=100
        )
        await pub.wait_for_subscribers()
        for number in range(10):
            pub.publish(data=str(number))
        if is_async:
            await asyncio.wait_for(closed.wait(), 20)
            assert got == ["0"]
        await until(lambda: not subscriber.is_open and pub.subscriber_count == 0)
        assert node.is_open


async def test_closing_the_node_from_within(make_node):
    node = await make_node()

    async def close(message):
        await node.close()

    await node.subscribe("chatter", String, close)
    async with (await make_node("talker")).advertise("chatter", String, latch=True) as pub:
        pub.publish(data="end")
        assert await asyncio.wait_for(node.wait_closed(), 20) == "closed"


async def test_there_is_nothing_to_iterate(make_node):
    node = await make_node()
    async with node.subscribe("chatter", String, print) as sub:
        with pytest.raises(TypeError, match="/chatter has a callback"):
            await sub.get()
        with pytest.raises(TypeError, match="/chatter has a callback"):
            sub.get_nowait()
        with pytest.raises(TypeError, match="/chatter has a callback"):
            aiter(sub)
        with pytest.raises(TypeError, match="/chatter has a callback"):
            sub.events()
        with pytest.raises(TypeError, match="has a callback"):
            aioros1.merge(sub)


async def test_what_cannot_be_called_is_refused_at_once(make_node):
    node = await make_node()
    with pytest.raises(TypeError, match=r"subscriber chatter: the callback is a function, got 5"):
        node.subscribe("chatter", String, 5)  # type: ignore[call-overload]


async def test_an_awaitable_of_a_plain_function_is_an_error(make_node):
    """Nobody would await it."""
    errors = []
    node = await make_node(on_error=errors.append)

    async def later(message):
        raise AssertionError("never awaited")

    async with (
        node.advertise("chatter", String, latch=True) as pub,
        node.subscribe("chatter", String, lambda message: later(message)),
    ):
        pub.publish(data="a")
        await until(lambda: errors)
        assert isinstance(errors[0], TypeError)
        assert "make the callback `async def`" in str(errors[0])


@pytest.mark.parametrize("is_async", [False, True])
async def test_raw_and_any_type(make_node, is_async):
    node = await make_node()
    raw, objects = [], []

    async def take(message):
        objects.append(message)

    async with (
        node.advertise("chatter", String, latch=True) as pub,
        node.subscribe("chatter", "*", raw.append, raw=True),
        node.subscribe("chatter", callback=take if is_async else objects.append),
    ):
        pub.publish(data="hello")
        await until(lambda: raw and objects)
        assert raw == [String(data="hello").to_bytes()]
        assert objects[0].data == "hello"


async def test_a_message_that_cannot_be_decoded_is_skipped(make_node):
    node = await make_node()
    got = []
    async with (
        node.advertise("chatter", String) as pub,
        node.subscribe("chatter", String, got.append) as sub,
    ):
        await pub.wait_for_subscribers()
        pub.publish_raw(b"\xff\0\0\0short")
        pub.publish(data="good")
        await until(lambda: got)
        assert got == [String(data="good")]
        assert sub.stats.errors == 1


async def test_a_message_within_the_callback_is_answered_at_once(make_node):
    """Publishing from a callback is what a relay does."""
    node = await make_node()
    got = []
    async with (
        node.advertise("in", Header) as source,
        node.advertise("out", Header) as sink,
        node.subscribe("in", Header, sink.publish),
        node.subscribe("out", Header, lambda message: got.append(message.frame_id)),
    ):
        await source.wait_for_subscribers()
        await sink.wait_for_subscribers()
        for number in range(50):
            await source.send(frame_id=str(number))
        await until(lambda: len(got) == 50)
        assert got == [str(number) for number in range(50)]
