"""Composites: several roles and tasks of a node as one object."""

from __future__ import annotations

import asyncio

import pytest

import aioros1
from aioros1.msg.std_msgs import String
from aioros1.node.composite import Composite


class Relay(Composite):
    """Publishes on one topic what comes on another."""

    def __init__(self, node, source="a", target="b", fail_at=None):
        super().__init__(node, f"{source} to {target}")
        self.source, self.target, self.fail_at = source, target, fail_at
        self.log = []

    async def _open(self):
        self.pub = await self._own(self.node.advertise(self.target, String))
        if self.fail_at == "open":
            raise ValueError("cannot open")
        self.sub = await self._own(self.node.subscribe(self.source, String))
        self._create_task(self._relay())

    async def _relay(self):
        try:
            async for message in self.sub:
                if self.fail_at == message.data:
                    raise ValueError(message.data)
                self.pub.publish(message)
        except asyncio.CancelledError:
            self.log.append("cancelled")
            raise

    async def _close(self):
        assert self.pub.is_open
        assert self.sub.is_open
        self.log.append("close")

    def _abort(self):
        self.log.append("abort")

    def send(self, data):
        self._check_open()
        self.pub.publish(data=data)


async def passes(node, relay, data="hello"):
    async with node.advertise(relay.source, String) as pub, node.subscribe(relay.target) as sub:
        await pub.wait_for_subscribers(timeout=20)
        await sub.wait_for_publishers(timeout=20)
        pub.publish(data=data)
        return (await sub.get(timeout=20)).data == data


async def test_it_is_open_within_its_block(make_node):
    node = await make_node()
    relay = Relay(node)
    assert not relay.is_open
    assert repr(relay) == "<Relay a to b of /node, new>"
    async with relay as same:
        assert same is relay
        assert relay.is_open
        assert (relay.node, relay.name) == (node, "a to b")
        assert await passes(node, relay)
    assert not relay.is_open
    assert relay.log == ["close", "cancelled"]
    assert node.roles == ()
    assert repr(relay) == "<Relay a to b of /node, closed>"


async def test_await_opens_it_and_close_closes_it(make_node):
    node = await make_node()
    relay = await Relay(node)
    assert relay.is_open
    assert len(node.roles) == 2
    await asyncio.gather(relay.close(), relay.close())
    await relay.close()
    assert relay.log == ["close", "cancelled"]
    assert node.roles == ()
    with pytest.raises(aioros1.ClosedError, match="Relay a to b is closed"):
        relay.send("late")
    with pytest.raises(RuntimeError, match="opened before"):
        await relay


async def test_it_is_closed_with_its_node_before_the_roles(make_node, master):
    async with aioros1.Node("node", master_uri=master.uri, host="localhost") as node:
        relay = await Relay(node)
    assert relay.log == ["close", "cancelled"]
    with pytest.raises(aioros1.ClosedError, match="the node was closed"):
        relay.send("late")


async def test_a_node_that_is_dropped_drops_it(make_node, master):
    node = await aioros1.Node("node", master_uri=master.uri, host="localhost").start()
    relay = await Relay(node)
    node.abort()
    assert not relay.is_open
    await node.wait_closed()
    assert "abort" in relay.log


@pytest.mark.parametrize("error", [ValueError, asyncio.CancelledError])
async def test_one_that_fails_to_drop_keeps_no_other_from_it(master, error):
    dropped = []

    class Fragile(Composite):
        def _abort(self):
            dropped.append(self.name)
            raise error(self.name)

    class Pair(Fragile):
        async def _open(self):
            await self._own(Fragile(self.node, "first"))
            await self._own(Fragile(self.node, "second"))

    node = await aioros1.Node("node", master_uri=master.uri, host="localhost").start()
    events = node.events()
    await Pair(node, "pair")
    await Fragile(node, "last")
    node.abort()
    assert sorted(dropped) == ["first", "last", "pair", "second"]
    async with asyncio.timeout(20):
        async for _ in events:
            pass
    assert await node.wait_closed() == "aborted"


async def test_one_within_another(make_node):
    node = await make_node()

    class Pair(Composite):
        async def _open(self):
            self.first = await self._own(Relay(self.node, "a", "b"))
            self.second = await self._own(Relay(self.node, "b", "c"))

    async with Pair(node) as pair:
        assert await passes(node, pair.first)
        assert await passes(node, pair.second)
    assert not pair.first.is_open
    assert not pair.second.is_open
    assert node.roles == ()


@pytest.mark.parametrize("closed_by", ["itself", "node"])
async def test_what_it_owns_is_open_when_it_closes(master, closed_by):
    closed = []

    class Inner(Composite):
        async def _close(self):
            closed.append("inner")

    class Outer(Composite):
        async def _open(self):
            self.inner = await self._own(Inner(self.node))

        async def _close(self):
            closed.append(("outer", self.inner.is_open))

    async with aioros1.Node("node", master_uri=master.uri, host="localhost") as node:
        outer = await Outer(node)
        if closed_by == "itself":
            await outer.close()
    assert closed == [("outer", True), "inner"]


async def test_what_it_had_opened_is_closed_when_opening_fails(make_node):
    node = await make_node()
    relay = Relay(node, fail_at="open")
    with pytest.raises(ValueError, match="cannot open"):
        await relay
    assert not relay.is_open
    assert not relay.pub.is_open
    assert node.roles == ()


async def test_what_it_had_opened_is_closed_when_opening_is_cancelled(make_node):
    node = await make_node()
    is_waiting = asyncio.Event()

    class Slow(Composite):
        async def _open(self):
            self.pub = await self._own(self.node.advertise("a", String))
            is_waiting.set()
            await asyncio.Event().wait()

    slow = Slow(node)
    task = asyncio.create_task(slow.__aenter__())
    await is_waiting.wait()
    task.cancel()
    with pytest.raises(asyncio.CancelledError):
        await task
    assert not slow.pub.is_open
    assert node.roles == ()


async def test_closing_it_while_it_opens(make_node):
    node = await make_node()
    go_on = asyncio.Event()

    class Slow(Composite):
        async def _open(self):
            self.pub = await self._own(self.node.advertise("a", String))
            await go_on.wait()

    slow = Slow(node, "s")
    task = asyncio.create_task(slow.__aenter__())
    while not node.roles:
        await asyncio.sleep(0)
    await slow.close()
    go_on.set()
    with pytest.raises(aioros1.ClosedError, match="Slow s is closed"):
        await task
    assert node.roles == ()


async def test_closing_ends_an_opening_that_never_would(make_node, master):
    """Whoever closes: the composite itself, or its node."""

    class Stuck(Composite):
        async def _open(self):
            self.pub = await self._own(self.node.advertise("a", String))
            await asyncio.Event().wait()

        async def _close(self):
            raise AssertionError("it was never open")

    quiet = {"rosout": False, "logger_services": False, "host": "localhost"}
    async with aioros1.Node("node", master_uri=master.uri, **quiet) as node:
        for closed_by in ("itself", "node"):
            stuck = Stuck(node, "s")
            task = asyncio.create_task(stuck.__aenter__())
            async with asyncio.timeout(20):
                while not node.roles:
                    await asyncio.sleep(0)
                await (stuck if closed_by == "itself" else node).close()
            with pytest.raises(aioros1.ClosedError, match="Stuck s is closed"):
                await task
            assert node.roles == ()


async def test_an_opening_that_is_cancelled_twice_leaves_nothing(make_node):
    node = await make_node()
    ended = asyncio.Event()

    class Slow(Composite):
        async def _open(self):
            self.pub = await self._own(self.node.advertise("a", String))
            self._create_task(self._run())
            await asyncio.Event().wait()

        async def _run(self):
            try:
                await asyncio.Event().wait()
            finally:
                await ended.wait()

    slow = Slow(node)
    task = asyncio.create_task(slow.__aenter__())
    while not node.roles:
        await asyncio.sleep(0)
    for _ in range(2):
        task.cancel()
        for _ in range(5):
            await asyncio.sleep(0)
    with pytest.raises(asyncio.CancelledError):
        await task
    ended.set()
    await slow.close()
    assert node.roles == ()


async def test_what_comes_too_late_is_closed_again(make_node):
    node = await make_node()
    relay = await Relay(node)
    await relay.close()
    with pytest.raises(aioros1.ClosedError):
        await relay._own(node.advertise("late", String))
    assert node.roles == ()


async def test_closing_within_close(make_node):
    node = await make_node()

    class Twice(Composite):
        async def _close(self):
            await self.close()

    async with asyncio.timeout(20):
        async with Twice(node):
            pass


async def test_closing_it_from_one_of_its_tasks(make_node):
    node = await make_node()

    class Once(Composite):
        async def _open(self):
            self._create_task(self._run())

        async def _run(self):
            await self.close()

    once = await Once(node)
    async with asyncio.timeout(20):
        while once.is_open:
            await asyncio.sleep(0)
        await once.close()
    assert node.is_open


async def test_an_exception_of_a_task_goes_to_on_error(make_node):
    errors = []
    node = await make_node(on_error=errors.append)
    async with Relay(node, fail_at="bad") as relay, node.advertise("a", String) as pub:
        await pub.wait_for_subscribers(timeout=20)
        pub.publish(data="bad")
        async with asyncio.timeout(20):
            while not errors:
                await asyncio.sleep(0)
        assert str(errors[0]) == "bad"
        assert relay.is_open


async def test_it_needs_an_open_node(make_node, master):
    with pytest.raises(TypeError, match=r"Relay: expected a Node first, got 'node'"):
        Relay("node")
    node = aioros1.Node("later", master_uri=master.uri)
    with pytest.raises(aioros1.ClosedError, match="/later is new, not open"):
        await Relay(node)
