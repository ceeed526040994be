"""Tasks of a node, errors of the user's code, and jumps of the clock."""

from __future__ import annotations

import asyncio
import sys
from collections import Counter

import pytest

import aioros1
from aioros1.events import ClockJumped


async def test_a_task_ends_with_the_node(master):
    cancelled = asyncio.Event()

    async def run():
        try:
            await asyncio.Event().wait()
        except asyncio.CancelledError:
            cancelled.set()
            raise

    async with aioros1.Node("node", master_uri=master.uri, host="localhost") as node:
        task = node.create_task(run(), name="mine")
        assert task.get_name() == "mine"
        await asyncio.sleep(0)
    assert task.done()
    assert cancelled.is_set()


async def test_a_task_can_be_awaited_and_cancelled(make_node):
    node = await make_node()
    got = []

    async def run(item):
        got.append(item)

    await node.create_task(run(1))
    assert got == [1]
    task = node.create_task(asyncio.sleep(3600))
    await asyncio.sleep(0)
    task.cancel()
    with pytest.raises(asyncio.CancelledError):
        await task
    assert node.is_open


async def test_what_a_task_raises_goes_to_on_error(make_node):
    errors = []
    node = await make_node(on_error=errors.append)

    async def fail():
        raise ValueError("no")

    assert await node.create_task(fail()) is None
    assert str(errors[0]) == "no"
    node.handle_error(KeyError("mine"), "my callback")
    assert isinstance(errors[1], KeyError)


async def test_an_exception_of_a_task_ends_the_node_by_default(master):
    async def fail():
        raise ValueError("no")

    node = aioros1.Node("node", master_uri=master.uri, host="localhost")
    with pytest.raises(ValueError, match="no"):
        async with node:
            node.create_task(fail(), name="mine")
            await asyncio.Event().wait()
    assert node.close_reason == "mine failed: ValueError('no')"


async def test_a_task_that_never_began_is_no_warning(make_node):
    node = await make_node()
    node.create_task(asyncio.sleep(0)).cancel()
    await asyncio.sleep(0)


@pytest.mark.parametrize("what", [3, asyncio.sleep])
async def test_what_is_no_coroutine_is_refused_at_once(make_node, what):
    node = await make_node()
    with pytest.raises(TypeError, match=r"create_task\(\) takes a coroutine, got"):
        node.create_task(what)


async def test_a_cancellation_that_was_not_ours_is_an_error(make_node):
    errors = []
    node = await make_node(on_error=errors.append)

    async def await_what_somebody_cancels():
        other = asyncio.create_task(asyncio.sleep(3600))
        asyncio.get_running_loop().call_soon(other.cancel)
        await other

    await node.create_task(await_what_somebody_cancels())
    assert isinstance(errors[0].__cause__, asyncio.CancelledError)
    assert node.is_open


async def test_a_timer_goes_on_after_a_cancellation_that_was_not_its_own(make_node):
    errors, ticks = [], asyncio.Queue()
    node = await make_node(on_error=errors.append)

    async def tick(now):
        ticks.put_nowait(now)
        other = asyncio.create_task(asyncio.sleep(3600))
        other.cancel()
        await other

    timer = node.timer(0.001, tick)
    async with asyncio.timeout(20):
        for _ in range(3):
            await ticks.get()
    timer.cancel()
    assert all(isinstance(error.__cause__, asyncio.CancelledError) for error in errors)
    assert len(errors) >= 2


@pytest.mark.parametrize("in_a_group", [False, True])
async def test_the_end_of_the_node_is_no_error_of_a_task(master, in_a_group):
    async def wait(node):
        if not in_a_group:
            await node.sleep(3600)
        async with asyncio.TaskGroup() as group:
            group.create_task(node.sleep(3600))

    async with aioros1.Node("node", master_uri=master.uri, host="localhost") as node:
        node.create_task(wait(node))
        await asyncio.sleep(0)


async def test_on_error_that_fails_is_logged(make_node, caplog):
    def on_error(error):
        raise KeyError("in on_error")

    node = await make_node(on_error=on_error)
    node.handle_error(ValueError("first"), "mine")
    assert "on_error failed with ValueError('first')" in caplog.text


class Strange(BaseException):
    """Neither an error nor the end of the program."""


@pytest.mark.parametrize("error", [asyncio.CancelledError, GeneratorExit, Strange])
@pytest.mark.parametrize("transports", [(), ("intraprocess",)], ids=["tcp", "in-process"])
@pytest.mark.parametrize("is_async", [False, True], ids=["def", "async def"])
async def test_whatever_on_error_raises_everything_goes_on(
    make_node, caplog, error, transports, is_async
):
    """What failed is called again: the callback of a topic, a timer, and publish_every."""
    calls = Counter()

    def on_error(_):
        raise error("in on_error")

    def fail(what):
        calls[what] += 1
        raise ValueError(what)

    async def fail_later(what):
        fail(what)

    async def receive_later(_):
        fail("callback")

    receive = receive_later if is_async else lambda _: fail("callback")
    function = fail_later if is_async else fail
    node = await make_node("node", on_error=on_error, local_transports=transports)
    other = await make_node("other", local_transports=transports)
    await node.subscribe("topic", "std_msgs/String", receive)
    pub = await other.advertise("topic", "std_msgs/String")
    node.timer(0.01, lambda _: function("timer"))
    (await node.advertise("other", "std_msgs/String")).publish_every(0.01, lambda _: fail("every"))
    await pub.wait_for_subscribers(timeout=20)
    async with asyncio.timeout(10):
        while len(calls) < 3 or min(calls.values()) < 3:
            pub.publish(data="again")
            await asyncio.sleep(0.01)
    assert "on_error failed with ValueError('callback')" in caplog.text
    assert node.is_open


async def test_on_error_that_exits_ends_the_program(master):
    """As everywhere: the event loop itself raises it. Run in a loop of its own."""

    async def main():
        async with aioros1.Node(
            "node", master_uri=master.uri, host="localhost", on_error=lambda _: sys.exit(3)
        ) as node:
            node.handle_error(ValueError("first"), "mine")
            await asyncio.sleep(3600)

    with pytest.raises(SystemExit, match="3"):
        await asyncio.to_thread(asyncio.run, main())


async def test_on_error_that_would_have_to_be_awaited_is_refused():
    async def on_error(error):
        pass

    with pytest.raises(TypeError, match=r"on_error is called, not awaited: use `def`"):
        aioros1.Node("node", on_error=on_error)


async def test_a_node_that_is_not_open_takes_no_task(master):
    node = aioros1.Node("node", master_uri=master.uri)
    with pytest.raises(aioros1.ClosedError):
        node.create_task(asyncio.sleep(0))


async def test_a_clock_that_goes_backwards_is_an_event(make_node, ros_clock):
    node = await make_node()
    assert node.uses_sim_time
    events = node.events()
    await ros_clock.set(10)
    await ros_clock.set(5)
    await ros_clock.advance(1)
    await node.close()
    jumps = [event async for event in events if isinstance(event, ClockJumped)]
    assert jumps == [ClockJumped(aioros1.Time(10), aioros1.Time(5))]


async def test_beginning_and_ceasing_to_follow_the_clock_are_jumps(make_node, master):
    node = await make_node(heartbeat=0.01)
    events = node.events()
    assert not node.uses_sim_time
    for wanted in (True, False):
        await node.set_param("/use_sim_time", wanted)
        async with asyncio.timeout(20):
            async for event in events:
                if isinstance(event, ClockJumped):
                    break
        assert node.uses_sim_time is wanted
        zero, other = (event.now, event.before) if wanted else (event.before, event.now)
        assert zero.is_zero()
        assert not other.is_zero()


async def test_who_drives_the_clock_sees_what_is_awaited(make_node, ros_clock):
    node = await make_node()
    assert node.next_wakeup is None
    sleeping = asyncio.create_task(node.sleep(2))
    async with asyncio.timeout(20):
        while node.next_wakeup is None:
            await asyncio.sleep(0)
    assert node.next_wakeup == aioros1.Time(3)
    waiting = asyncio.create_task(node.wait_for_time(aioros1.Time(3)))
    await ros_clock.advance(2)
    await asyncio.gather(sleeping, waiting)
    with pytest.raises(TimeoutError):
        await node.wait_for_time(aioros1.Time(3, 1), timeout=0.01)
