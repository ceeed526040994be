"""How things end: roles, nodes, and everybody who waits for one of them."""

from __future__ import annotations

import asyncio
import contextlib
import subprocess
import sys

import pytest

import aioros1
from aioros1.msg.std_msgs import String
from aioros1.srv.std_srvs import SetBool
from aioros1.testing import FlakyProxy

from .peers import (
    PATIENCE,
    FakePeer,
    caller_header,
    dialled,
    flip_request,
    listening_ports,
    subscriber_header,
    until,
)


async def collect(iterator) -> list:
    return [item async for item in iterator]


async def started(*awaitables) -> list[asyncio.Task]:
    """Tasks that have got as far as they can without anything happening."""
    tasks = [asyncio.ensure_future(each) for each in awaitables]
    for _ in range(5):
        await asyncio.sleep(0)
    assert not any(task.done() for task in tasks), "it should have to wait"
    return tasks


def ports_of(node: aioros1.Node) -> set[int]:
    """The ports of its slave API and of its topics and services."""
    return {node.tcpros_address[1], int(node.uri.rstrip("/").rpartition(":")[2])}


async def are_free(ports: set[int]) -> bool:
    await until(lambda: not ports & listening_ports(), "nobody listens any more")
    return True


# Every loop ends.


@pytest.mark.parametrize("what", ["role", "node"])
@pytest.mark.parametrize("kind", ["subscriber", "events", "provider", "param"])
async def test_a_loop_over_a_role_ends_when_it_closes(make_node, kind, what):
    node = await make_node()
    role: aioros1.Role  # type: ignore[name-defined]
    if kind == "provider":
        role = await node.advertise_service("flip", SetBool)
    elif kind == "param":
        role = await node.subscribe_param("speed")
    else:
        role = await node.subscribe("chatter", String)
    loops = await started(
        collect(role.events() if kind == "events" else role),
        collect(role.events() if kind == "events" else role),
    )
    await (role if what == "role" else node).close()
    async with asyncio.timeout(PATIENCE):
        assert await asyncio.gather(*loops) == [[], []]
    # And one that begins afterwards ends at once.
    async with asyncio.timeout(PATIENCE):
        assert await collect(role.events() if kind == "events" else role) == []


async def test_loops_over_the_node_end_with_it(make_node):
    node = await make_node()
    loops = await started(collect(node.events()), collect(node.rate(0.01)))
    changes = asyncio.create_task(collect(node.graph.changes()))
    await node.close()
    async with asyncio.timeout(PATIENCE):
        await asyncio.gather(*loops, changes)


async def test_a_loop_ends_when_another_node_shuts_this_one_down(make_node):
    node, other = await make_node(), await make_node("other")
    sub = await node.subscribe("chatter", String)
    (loop,) = await started(collect(sub))
    await (await other.peer("/node")).shutdown("enough")
    async with asyncio.timeout(PATIENCE):
        assert await loop == []


# Whoever waits gets ClosedError, and no cancellation.


WAITS = {
    "get": ("subscriber", lambda role: role.get()),
    "wait_for_publishers": ("subscriber", lambda role: role.wait_for_publishers(9)),
    "wait_for_subscribers": ("publisher", lambda role: role.wait_for_subscribers(9)),
    "wait_for": ("param", lambda role: role.wait_for(lambda value: value == 9)),
}


@pytest.mark.parametrize(("kind", "wait"), WAITS.values(), ids=WAITS.keys())
@pytest.mark.parametrize("what", ["role", "node"])
@pytest.mark.parametrize("company", [False, True], ids=["alone", "with another"])
async def test_waiting_for_a_role_raises_closed_error(make_node, kind, wait, what, company):
    """Also when another role of the same name goes on living."""
    node = await make_node()
    openings = {
        "subscriber": lambda: node.subscribe("chatter", String),
        "publisher": lambda: node.advertise("chatter", String),
        "param": lambda: node.subscribe_param("speed"),
    }
    if company:
        await openings[kind]()
    role = await openings[kind]()
    (waiting,) = await started(wait(role))
    await (role if what == "role" else node).close()
    with pytest.raises(aioros1.ClosedError):
        await asyncio.wait_for(waiting, PATIENCE)


@pytest.mark.parametrize("how", ["send", "drain"])
@pytest.mark.parametrize("what", ["role", "node"])
async def test_waiting_for_room_raises_closed_error(make_node, how, what):
    node = await make_node(timeouts=aioros1.Timeouts(close=0.1))
    pub = await node.advertise("chatter", String, queue_size=1)
    async with dialled(node, subscriber_header()) as wire:
        await wire.read_header()
        wire.pause()
        await pub.wait_for_subscribers(timeout=30)
        with pytest.raises(TimeoutError):
            while True:
                await pub.send(data="x" * 500_000, timeout=0.05)
        (waiting,) = await started(pub.send(data="more") if how == "send" else pub.drain())
        await (pub if what == "role" else node).close()
        with pytest.raises(aioros1.ClosedError):
            await asyncio.wait_for(waiting, PATIENCE)


@pytest.mark.parametrize("wait", ["wait_for_service", "sleep", "wait_for_message", "call"])
async def test_waiting_for_something_of_the_node_raises_closed_error(make_node, wait):
    node = await make_node()
    waits = {
        "wait_for_service": lambda: node.wait_for_service("nowhere"),
        "sleep": lambda: node.sleep(100),
        "wait_for_message": lambda: node.wait_for_message("nothing", String),
        "call": lambda: node.call("busy", SetBool),
    }
    async with (await make_node("other")).advertise_service("busy", SetBool) as provider:
        (waiting,) = await started(waits[wait]())
        if wait == "call":
            await anext(provider)
        await node.close()
        with pytest.raises(aioros1.ClosedError):
            await asyncio.wait_for(waiting, PATIENCE)


async def test_a_deferred_call_fails_when_its_provider_closes(make_node):
    node = await make_node()
    provider = await node.advertise_service("flip", SetBool)
    async with dialled(node, caller_header(), flip_request(True)) as wire:
        await wire.read_header()
        await asyncio.wait_for(anext(provider), 30)
        await provider.close()
        ok, text = await wire.answer()
        assert ok == 0
        assert b"shut down" in text


async def test_closed_roles_say_so_and_why(make_node):
    node = await make_node()
    pub = await node.advertise("chatter", String)
    sub = await node.subscribe("chatter", String)
    caller = await node.service_caller("flip", SetBool)
    await node.close()
    for use in (
        lambda: pub.publish(data="x"),
        lambda: pub.publish_raw(b""),
        sub.get_nowait,
        lambda: caller.send_request(data=True),
    ):
        with pytest.raises(aioros1.ClosedError, match="closed"):
            use()
    for opening in (
        node.advertise("chatter", String),
        node.subscribe("chatter"),
        node.advertise_service("flip", SetBool),
        node.service_caller("flip", SetBool),
        node.subscribe_param("speed"),
    ):
        with pytest.raises(aioros1.ClosedError):
            await opening
    assert not any(role.is_open for role in (pub, sub, caller))
    assert node.connections == ()


async def test_nothing_stays_registered(make_node):
    node, other = await make_node(), await make_node("other")
    await node.advertise("chatter", String)
    await node.subscribe("chatter", String)
    await node.advertise_service("flip", SetBool)
    await node.close()
    snapshot = await other.graph.snapshot()
    assert "/node" not in snapshot.nodes


# closing that is disturbed


async def test_a_role_whose_closing_was_cancelled_is_unregistered_with_its_node(make_node):
    node, other = await make_node(), await make_node("other")
    pub = await node.advertise("chatter", String, queue_size=100)
    async with dialled(node, subscriber_header()) as wire:
        await wire.read_header()
        wire.pause()
        await pub.wait_for_subscribers(timeout=30)
        for _ in range(50):
            pub.publish(data="x" * 500_000)
        (closing,) = await started(pub.close())
        closing.cancel()
        with pytest.raises(asyncio.CancelledError):
            await closing
    await node.close()
    assert "/node" not in (await other.graph.snapshot()).nodes


async def test_a_name_can_be_opened_again_after_a_cancelled_closing(make_node):
    node, other = await make_node(), await make_node("other")
    sub = await node.subscribe("chatter", String)
    closing = asyncio.create_task(sub.close())
    await asyncio.sleep(0)
    closing.cancel()
    with contextlib.suppress(asyncio.CancelledError):
        await closing
    async with (
        node.subscribe("chatter", String) as again,
        other.advertise("chatter", String) as pub,
    ):
        await pub.wait_for_subscribers(timeout=30)
        await again.wait_for_publishers(timeout=30)
        pub.publish(data="hi")
        assert (await again.get(timeout=30)).data == "hi"
    await node.close()
    assert "/node" not in (await other.graph.snapshot()).nodes


async def test_opening_that_is_cancelled_leaves_nothing_registered(make_node):
    node, other = await make_node(), await make_node("other")
    for opening in (
        lambda: node.advertise("chatter", String),
        lambda: node.subscribe("chatter", String),
        lambda: node.advertise_service("flip", SetBool),
    ):
        for steps in range(1, 20):
            task = asyncio.create_task(_opened(opening))
            for _ in range(steps):
                await asyncio.sleep(0)
            task.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await (await task).close()
    assert node.roles == ()
    assert "/node" not in (await other.graph.snapshot()).nodes


async def _opened(opening):
    return await opening()


async def test_closing_frees_everything_when_the_master_is_gone(make_node, master):
    node = await make_node()
    pub = await node.advertise("chatter", String)
    await node.subscribe("other", String)
    await node.advertise_service("flip", SetBool)
    ports = ports_of(node)
    async with dialled(node, subscriber_header()) as wire:
        await wire.read_header()
        await pub.wait_for_subscribers(timeout=30)
        await master.close()
        async with asyncio.timeout(PATIENCE):
            await node.close()
        assert await wire.is_closed()
    assert await are_free(ports)


@pytest.fixture
async def hung_master():
    """Accepts connections and never answers; only what a node must have at its start."""
    peer = FakePeer("http://127.0.0.1:1/", "/nobody")
    await peer.start()
    yield peer
    await peer.close()


async def test_closing_takes_no_longer_than_its_timeout_when_the_master_hangs(master, make_node):
    async with FlakyProxy("localhost", master.port) as proxy:
        node = await make_node(master_uri=f"http://127.0.0.1:{proxy.port}/")
        pub = await node.advertise("chatter", String)
        await node.advertise_service("flip", SetBool)
        ports = ports_of(node)
        proxy.stall()  # from now on the master takes requests and answers none
        async with asyncio.timeout(PATIENCE):
            await node.close(timeout=0.2)
        assert not pub.is_open
        assert await are_free(ports)


async def test_a_start_that_is_cancelled_frees_everything(hung_master):
    before = listening_ports()
    node = aioros1.Node(
        "node", master_uri=f"http://127.0.0.1:{hung_master.port}/", host="localhost"
    )
    starting = asyncio.create_task(node.start())
    await hung_master.accept()
    ports = listening_ports() - before
    assert len(ports) == 2
    starting.cancel()
    with pytest.raises(asyncio.CancelledError):
        await starting
    assert await are_free(ports)
    await node.close()


async def test_a_start_that_fails_frees_everything(make_node, master):
    first = await make_node("first")
    taken = int(first.uri.rstrip("/").rpartition(":")[2])
    before = listening_ports()
    node = aioros1.Node("node", master_uri=master.uri, host="localhost", xmlrpc_port=taken)
    with pytest.raises(OSError, match=str(taken)):
        await node.start()
    await until(lambda: listening_ports() == before, "nobody listens any more")
    assert not node.is_open
    await node.close()


async def test_a_cancelled_close_goes_on_by_itself(make_node):
    node, other = await make_node(timeouts=aioros1.Timeouts(close=0.2)), await make_node("other")
    pub = await node.advertise("chatter", String, queue_size=100)
    async with dialled(node, subscriber_header()) as wire:
        await wire.read_header()
        wire.pause()
        await pub.wait_for_subscribers(timeout=30)
        for _ in range(50):
            pub.publish(data="x" * 500_000)
        (closing,) = await started(node.close())
        closing.cancel()
        with pytest.raises(asyncio.CancelledError):
            await closing
        async with asyncio.timeout(PATIENCE):
            assert await node.wait_closed() == "closed"
    assert node.state == "closed"
    assert await are_free(ports_of(node))
    assert other.is_open


async def test_aborting_ends_everything_at_once(make_node):
    node = await make_node()
    pub = await node.advertise("chatter", String)
    sub = await node.subscribe("chatter", String)
    await sub.wait_for_publishers(timeout=30)
    (loop,) = await started(collect(sub))
    async with dialled(node, subscriber_header()) as wire:
        await wire.read_header()
        node.abort()
        assert not pub.is_open
        async with asyncio.timeout(PATIENCE):
            assert await loop == []
            await node.wait_closed()
        assert await wire.is_closed()
    assert node.connections == ()


@pytest.mark.parametrize("what", ["node", "provider"])
@pytest.mark.parametrize("how", ["itself", "in a task", "without waiting"])
async def test_a_service_handler_closes_its_own_node_or_provider(make_node, what, how):
    """It does not wait for itself, and its call is answered."""
    # Long enough for the test to fail if anybody waits for that.
    node = await make_node(timeouts=aioros1.Timeouts(close=PATIENCE * 2))
    closing = set()

    async def handler(request):
        role = node if what == "node" else provider
        if how == "itself":
            await role.close()
        elif how == "in a task":
            await asyncio.gather(role.close(), asyncio.sleep(0))
        else:
            closing.add(asyncio.create_task(role.close()))
            await asyncio.sleep(0)
        return {"success": True}

    provider = await node.advertise_service("end", SetBool, handler)
    async with dialled(node, caller_header("/end"), flip_request(True)) as wire:
        await wire.read_header()
        assert (await wire.answer())[0] == 1
        async with asyncio.timeout(PATIENCE):
            assert await wire.is_closed()
            await provider.close()
            await (node.wait_closed() if what == "node" else provider.close())
            await asyncio.gather(*closing)
    assert not provider.is_open


@pytest.mark.parametrize("persistent", [False, True])
async def test_a_node_that_calls_its_own_service_to_end_gets_the_answer(make_node, persistent):
    node = await make_node()

    async def handler(request):
        await node.close()
        return {"message": "good night"}

    await node.advertise_service("end", SetBool, handler)
    caller = await node.service_caller("end", SetBool, persistent=persistent)
    assert (await caller.call(timeout=PATIENCE)).message == "good night"
    await asyncio.wait_for(node.wait_closed(), PATIENCE)


async def test_a_service_handler_can_offer_its_service_again(make_node):
    node = await make_node()

    async def handler(request):
        await provider.close()
        again = await node.advertise_service("flip", SetBool, lambda _: {"message": "new"})
        return {"message": again.name}

    provider = await node.advertise_service("flip", SetBool, handler)
    assert (await node.call("flip", SetBool, timeout=PATIENCE)).message == "/flip"
    assert (await node.call("flip", SetBool, timeout=PATIENCE)).message == "new"


@pytest.mark.parametrize("filter_", ["always", "error"])
def test_a_node_that_was_never_closed_is_warned_of_and_freed(filter_):
    """Also when warnings are errors: what frees it must not depend on that."""
    script = (
        "import asyncio, aioros1\n"
        "async def main():\n"
        "    global node, sub\n"
        "    master = aioros1.Master(host='localhost', port=0)\n"
        "    async with master:\n"
        "        node = aioros1.Node('n', master_uri=master.uri, host='localhost', rosout=False)\n"
        "        await node.start()\n"
        "        sub = await node.subscribe('chatter', 'std_msgs/String')\n"
        "asyncio.run(main())\n"
        "print(node.state, sub.is_open)\n"
    )
    result = subprocess.run(
        [sys.executable, "-W", f"{filter_}::ResourceWarning", "-c", script],
        capture_output=True,
        text=True,
        timeout=30,
        check=False,
    )
    assert "node /n was never closed" in result.stderr
    assert result.stdout.split() == ["closed", "False"]


@pytest.mark.asyncio(loop_factories=["asyncio"])
@pytest.mark.parametrize("loop", ["asyncio", "uvloop"])
async def test_a_node_whose_loop_was_closed_is_warned_of_and_freed(master, loop):
    """Nothing that lives as long as the process, such as a logger, keeps it."""
    pytest.importorskip(loop)
    script = (
        "import asyncio, gc, logging, os, sys, weakref\n"
        f"import aioros1, {loop}\n"
        "def count():\n"
        "    gc.collect()\n"
        "    return len(os.listdir('/proc/self/fd'))\n"
        "async def main():\n"
        "    node = aioros1.Node('n', master_uri=sys.argv[1], host='localhost')\n"
        "    await node.start()\n"
        "    pub = await node.advertise('chatter', 'std_msgs/String')\n"
        "    sub = await node.subscribe('chatter', 'std_msgs/String')\n"
        "    await pub.wait_for_subscribers()\n"
        "    await sub.wait_for_publishers()\n"
        "    node.create_task(asyncio.sleep(3600))\n"
        "    node.timer(0.001, lambda now: pub.publish(data='x'))\n"
        "    node.on_shutdown(print)\n"
        "    await sub.get()\n"
        "    return node\n"
        f"first = {loop}.new_event_loop()\n"
        "first.run_until_complete(asyncio.sleep(0))\n"
        "first.close()\n"
        "before = count()\n"
        f"loop = {loop}.new_event_loop()\n"
        "node = loop.run_until_complete(main())\n"
        "loop.close()\n"
        "alive = weakref.ref(node)\n"
        "del node, loop\n"
        "print(count() - before, alive(), logging.getLogger('ros.n').handlers)\n"
    )
    result = await asyncio.to_thread(
        subprocess.run,
        [sys.executable, "-W", "always::ResourceWarning", "-c", script, master.uri],
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert "ResourceWarning: node /n was never closed" in result.stderr
    assert "Traceback" not in result.stderr
    assert result.stdout == "0 None []\n"


async def test_a_subscriber_that_comes_while_the_topic_closes_is_not_refused(make_node, caplog):
    """To the graph it is still published: the master has not been told yet."""
    node = await make_node(timeouts=aioros1.Timeouts(close=30, stall=60))
    pub = await node.advertise("chatter", String, queue_size=100)
    async with dialled(node, subscriber_header()) as stuck:
        await until(lambda: pub.subscriber_count == 1)
        for _ in range(20):
            pub.publish(data="x" * (1 << 20))  # more than the kernel takes
        closing = asyncio.create_task(pub.close())
        await until(lambda: not pub.is_open)
        async with dialled(node, subscriber_header()) as late:
            assert "error" not in await late.read_header()
            assert await late.reader.read() == b""
        stuck.abort()
        await closing
    assert not caplog.records
