"""What of the user's code ends before the roles of its node close."""

from __future__ import annotations

import asyncio

import pytest

import aioros1
from aioros1.msg.std_msgs import String

PATIENCE = 30


async def robot(make_node, **options):
    """A node that drives, and a subscriber that is driven."""
    node, other = await make_node(**options), await make_node("other")
    pub = await node.advertise("cmd", String, queue_size=100)
    sub = await other.subscribe("cmd", String, queue_size=1000)
    await pub.wait_for_subscribers(timeout=PATIENCE)
    await sub.wait_for_publishers(timeout=PATIENCE)
    return node, pub, sub


async def heard(sub) -> list[str]:
    async with asyncio.timeout(PATIENCE):
        while sub.connections:
            await asyncio.sleep(0.001)
    return [sub.get_nowait().data for _ in range(sub.queued)]


async def close(node):
    await node.close()


async def shut_down(node):
    other = aioros1.Node("killer", master_uri=node.master_uri, host="localhost", rosout=False)
    async with other:
        await (await other.peer(node.name)).shutdown("enough")


async def replace(node):
    other = aioros1.Node(node.base_name, master_uri=node.master_uri, host="localhost")
    async with other:
        await other.advertise("other", String)
        await node.wait_closed()


# on_shutdown


@pytest.mark.parametrize("end", [close, shut_down])
async def test_callbacks_are_called_in_reverse_order_while_roles_are_open(make_node, end):
    node, pub, sub = await robot(make_node)
    order = []

    def first():
        order.append("first")
        pub.publish(data="first")

    @node.on_shutdown
    async def second():
        order.append("second")
        await asyncio.sleep(0.001)
        assert node.close_reason is not None
        await node.set_param("second", 2)
        await pub.send(data="second")

    assert node.on_shutdown(first) is first
    await end(node)
    await asyncio.wait_for(node.wait_closed(), PATIENCE)
    assert order == ["first", "second"]
    assert await heard(sub) == ["first", "second"]


async def test_callbacks_are_called_when_another_node_takes_the_name(make_node):
    node, _, _ = await robot(make_node)
    called = asyncio.Event()
    node.on_shutdown(called.set)
    await asyncio.wait_for(replace(node), PATIENCE)
    assert called.is_set()


async def test_callbacks_are_called_when_an_error_ends_the_node(master):
    called = []
    with pytest.raises(ValueError, match="mine"):
        async with aioros1.Node("node", master_uri=master.uri, host="localhost") as node:
            node.on_shutdown(lambda: called.append(node.is_open))
            node.handle_error(ValueError("mine"), "test")
            await asyncio.Event().wait()
    assert called == [True]


async def test_callbacks_can_be_given_before_the_start(master):
    called = []
    node = aioros1.Node("node", master_uri=master.uri, host="localhost")
    node.on_shutdown(lambda: called.append(node.is_open))
    async with node:
        pass
    assert called == [True]


async def test_a_callback_that_fails_keeps_no_other_from_its_turn(make_node):
    errors, called = [], []
    node = await make_node(on_error=errors.append)

    def fail():
        raise KeyError("first")

    async def cancel():
        raise asyncio.CancelledError

    node.on_shutdown(lambda: called.append("last"))
    node.on_shutdown(fail)
    node.on_shutdown(cancel)
    await node.close()
    assert called == ["last"]
    assert [type(error) for error in errors] == [RuntimeError, KeyError]


async def test_callbacks_that_do_not_end_keep_nobody_from_closing(make_node, caplog):
    """Those that come later are called all the same."""
    node, pub, sub = await robot(make_node, timeouts=aioros1.Timeouts(close=0.05))
    seen = []

    async def stop():
        pub.publish(data="stop")
        await asyncio.sleep(3600)

    async def hang():
        try:
            await asyncio.sleep(3600)
        finally:
            seen.append(node.is_open)

    async def ignore():
        while node.is_open:
            try:
                await asyncio.sleep(3600)
            except asyncio.CancelledError:
                seen.append("ignored")

    node.on_shutdown(stop)
    node.on_shutdown(hang)
    node.on_shutdown(ignore)
    await asyncio.wait_for(node.close(), PATIENCE)
    assert seen[:2] == ["ignored", True]
    assert await heard(sub) == ["stop"]
    assert "hang" in caplog.text


async def test_a_callback_may_close_the_node(make_node):
    node = await make_node(timeouts=aioros1.Timeouts(close=3600))
    called = []

    @node.on_shutdown
    async def end():
        await asyncio.gather(node.close())
        called.append(node.is_open)

    await asyncio.wait_for(node.close(), PATIENCE)
    assert called == [True]


@pytest.mark.parametrize("callback", [None, 3])
async def test_what_is_no_function_is_refused(make_node, callback):
    node = await make_node()
    with pytest.raises(TypeError, match=r"on_shutdown takes a function, got"):
        node.on_shutdown(callback)


async def test_callbacks_are_refused_when_it_is_too_late(make_node):
    node = await make_node()
    refused = []

    @node.on_shutdown
    def too_late():
        try:
            node.on_shutdown(print)
        except aioros1.ClosedError as error:
            refused.append(error)

    await node.close()
    assert len(refused) == 1
    with pytest.raises(aioros1.ClosedError):
        node.on_shutdown(print)


async def test_aborting_calls_nothing(make_node):
    node = await make_node()
    called = []
    node.on_shutdown(lambda: called.append(1))
    node.abort()
    await node.wait_closed()
    assert called == []


async def test_aborting_while_a_callback_runs_ends_that_too(make_node, caplog):
    node = await make_node(timeouts=aioros1.Timeouts(close=3600))
    begun, called = asyncio.Event(), []
    node.on_shutdown(lambda: called.append(1))

    @node.on_shutdown
    async def hang():
        begun.set()
        await asyncio.sleep(3600)

    closing = asyncio.create_task(node.close())
    await asyncio.wait_for(begun.wait(), PATIENCE)
    node.abort()
    await asyncio.wait_for(closing, PATIENCE)
    assert called == []
    assert "ERROR" not in caplog.text


# tasks and timers


@pytest.mark.parametrize("end", [close, shut_down])
@pytest.mark.parametrize("what", ["task", "timer", "publish_every", "callback"])
async def test_they_are_cancelled_while_roles_are_open(make_node, end, what):
    node, pub, sub = await robot(make_node)
    begun = asyncio.Event()

    async def work(*args):
        begun.set()
        try:
            await asyncio.sleep(3600)
        finally:
            await asyncio.sleep(0.001)
            await pub.send(data="stop")

    if what == "task":
        node.create_task(work())
    elif what == "timer":
        node.timer(0.001, work)
    elif what == "publish_every":
        pub.publish_every(0.001, work)
    else:
        await node.subscribe("cmd", String, work)
        await pub.wait_for_subscribers(2, timeout=PATIENCE)
        pub.publish(data="drive")
    await asyncio.wait_for(begun.wait(), PATIENCE)
    await end(node)
    await asyncio.wait_for(node.wait_closed(), PATIENCE)
    assert (await heard(sub))[-1] == "stop"


async def test_nothing_drives_on_behind_the_back_of_what_cleans_up(make_node):
    node, pub, sub = await robot(make_node)
    node.timer(0.001, lambda now: pub.publish(data="drive"))
    pub.publish_every(0.001, data="drive")

    async def drive():
        while True:
            pub.publish(data="drive")
            await asyncio.sleep(0.001)

    node.create_task(drive())

    @node.on_shutdown
    async def stop():
        pub.publish(data="stop")
        await asyncio.sleep(0.05)

    async with asyncio.timeout(PATIENCE):
        await sub.wait_for_messages(10)
    await node.close()
    got = await heard(sub)
    assert got.index("stop") == len(got) - 1


@pytest.mark.parametrize("what", ["timer", "publish_every", "callback"])
async def test_those_that_catch_their_cancellation_end_all_the_same(make_node, what):
    node, pub, _ = await robot(make_node, timeouts=aioros1.Timeouts(close=3600))
    begun = asyncio.Event()

    async def work(*args):
        begun.set()
        try:
            await asyncio.sleep(3600)
        except asyncio.CancelledError:
            pass

    if what == "timer":
        node.timer(0.001, work)
    elif what == "publish_every":
        pub.publish_every(0.001, work)
    else:
        await node.subscribe("cmd", String, work)
        await pub.wait_for_subscribers(2, timeout=PATIENCE)
        for _ in range(5):
            pub.publish(data="drive")
    await asyncio.wait_for(begun.wait(), PATIENCE)
    await asyncio.wait_for(node.close(), PATIENCE)


async def test_a_task_that_ignores_its_cancellation_keeps_nobody_from_closing(make_node, caplog):
    node = await make_node(timeouts=aioros1.Timeouts(close=0.05))
    is_free = asyncio.Event()

    async def ignore():
        while not is_free.is_set():
            try:
                await is_free.wait()
            except asyncio.CancelledError:
                pass

    task = node.create_task(ignore(), name="stubborn")
    await asyncio.sleep(0)
    await asyncio.wait_for(node.close(), PATIENCE)
    assert node.state == "closed"
    assert "stubborn goes on although it was cancelled" in caplog.text
    is_free.set()
    await asyncio.wait({task}, timeout=PATIENCE)


@pytest.mark.parametrize("what", ["task", "timer", "callback"])
async def test_code_of_a_node_can_close_it_and_goes_on(make_node, what):
    node, pub, _ = await robot(make_node, timeouts=aioros1.Timeouts(close=3600))
    states: asyncio.Queue[str] = asyncio.Queue()

    async def end(*args):
        await node.close()
        states.put_nowait(node.state)

    if what == "task":
        node.create_task(end())
    elif what == "timer":
        node.timer(0.001, end)
    else:
        await node.subscribe("cmd", String, end)
        await pub.wait_for_subscribers(2, timeout=PATIENCE)
        pub.publish(data="end")
    assert await asyncio.wait_for(states.get(), PATIENCE) == "closed"


async def test_a_task_that_cleans_up_may_close_the_node(make_node):
    node = await make_node(timeouts=aioros1.Timeouts(close=3600))

    async def work():
        try:
            await asyncio.sleep(3600)
        finally:
            await asyncio.gather(node.close())

    node.create_task(work())
    await asyncio.sleep(0)
    await asyncio.wait_for(node.close(), PATIENCE)


async def test_tasks_that_are_started_to_clean_up_end_before_roles_close(make_node):
    node, pub, sub = await robot(make_node)

    async def stop():
        try:
            await asyncio.sleep(3600)
        finally:
            await pub.send(data="stop")

    async def work():
        try:
            await asyncio.sleep(3600)
        finally:
            node.create_task(stop())
            await asyncio.sleep(0.001)

    node.create_task(work())
    await asyncio.sleep(0)
    await node.close()
    assert await heard(sub) == ["stop"]


async def test_composites_stay_open_for_what_cleans_up(make_node):
    node = await make_node()
    got = []

    class Worker(aioros1.Composite):
        async def _open(self):
            self.jobs: asyncio.Queue[str] = asyncio.Queue()
            self._create_task(self._work())

        async def _work(self):
            while True:
                got.append(await self.jobs.get())
                self.jobs.task_done()

    worker = await Worker(node)

    @node.on_shutdown
    async def use():
        worker.jobs.put_nowait("last")
        await worker.jobs.join()

    await asyncio.wait_for(node.close(), PATIENCE)
    assert got == ["last"]


async def test_what_a_role_that_was_closed_raises_while_the_node_ends_is_no_error(make_node):
    errors = []
    node, pub, _ = await robot(make_node, on_error=errors.append)

    @node.on_shutdown
    async def stop():
        await pub.close()
        pub.publish(data="never")

    await node.close()
    assert errors == []


# the block of a node


async def test_a_block_that_an_error_cancels_cleans_up_while_roles_are_open(make_node, master):
    other = await make_node("other")
    sub = await other.subscribe("cmd", String)
    node = aioros1.Node("node", master_uri=master.uri, host="localhost")
    order = []
    with pytest.raises(ValueError, match="mine"):
        async with node:
            pub = await node.advertise("cmd", String)
            await pub.wait_for_subscribers(timeout=PATIENCE)
            node.on_shutdown(lambda: order.append("on_shutdown"))
            node.handle_error(ValueError("mine"), "test")
            try:
                await asyncio.sleep(3600)
            finally:
                await asyncio.sleep(0.01)
                await pub.send(data="stop")
                order.append("block")
    assert order == ["block", "on_shutdown"]
    assert (await sub.get(timeout=PATIENCE)).data == "stop"


async def test_a_block_that_an_error_cancels_may_close_the_node(master):
    node = aioros1.Node(
        "node",
        master_uri=master.uri,
        host="localhost",
        timeouts=aioros1.Timeouts(close=3600),
    )
    with pytest.raises(ValueError, match="mine"):
        async with asyncio.timeout(PATIENCE), node:
            node.handle_error(ValueError("mine"), "test")
            try:
                await asyncio.sleep(3600)
            finally:
                await node.close()


async def test_a_block_that_does_not_end_is_not_waited_for_longer_than_the_grace(master):
    node = aioros1.Node(
        "node",
        master_uri=master.uri,
        host="localhost",
        timeouts=aioros1.Timeouts(close=0.05),
    )
    with pytest.raises(ValueError, match="mine"):
        async with asyncio.timeout(PATIENCE), node:
            node.handle_error(ValueError("mine"), "test")
            try:
                await asyncio.sleep(3600)
            finally:
                await node.wait_closed()


# grace


async def test_grace_decides_how_long_each_step_takes(make_node):
    node = await make_node(timeouts=aioros1.Timeouts(close=3600))
    node.on_shutdown(lambda: asyncio.sleep(3600))
    await asyncio.wait_for(node.close(grace=0.01), PATIENCE)


async def test_another_call_shortens_the_grace(make_node):
    node = await make_node(timeouts=aioros1.Timeouts(close=3600))
    begun = asyncio.Event()

    async def clean_up():
        begun.set()
        await asyncio.sleep(3600)

    node.on_shutdown(clean_up)
    closing = asyncio.create_task(node.close())
    await asyncio.wait_for(begun.wait(), PATIENCE)
    await asyncio.wait_for(node.close(grace=0), PATIENCE)
    await closing
