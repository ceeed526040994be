"""A node is a guest in somebody else's program: it comes, goes, and leaves nothing."""

from __future__ import annotations

import asyncio
import gc
import logging
import os
import signal
import subprocess
import sys
import textwrap
import threading
import warnings
from pathlib import Path

import pytest

import aioros1
from aioros1.msg.std_msgs import String
from aioros1.srv.std_srvs import SetBool


def open_sockets() -> set[str]:
    """The sockets of this process, as the kernel names them."""
    found = set()
    for fd in os.listdir("/proc/self/fd"):
        try:
            target = os.readlink(f"/proc/self/fd/{fd}")
        except OSError:
            continue
        if target.startswith("socket:"):
            found.add(target)
    return found


async def graph_of_twenty_two() -> None:
    """A master, a node, and twenty more that all talk with it."""
    async with (
        aioros1.Master(host="localhost", port=0) as master,
        aioros1.Node("hub", master_uri=master.uri) as hub,
        hub.subscribe("chatter", String, queue_size=100) as sub,
        hub.advertise_service("flip", SetBool, lambda request: {"success": not request.data}),
        asyncio.TaskGroup() as group,
    ):
        for number in range(20):
            group.create_task(one_of_twenty(number, master.uri))
        heard = {(await sub.get(timeout=10)).data for _ in range(20)}
        assert heard == {str(number) for number in range(20)}


async def one_of_twenty(number: int, master_uri: str) -> None:
    async with (
        aioros1.Node(f"spoke{number}", master_uri=master_uri) as node,
        node.advertise("chatter", String) as pub,
    ):
        await pub.wait_for_subscribers(timeout=10)
        await pub.send(data=str(number))
        reply = await node.call("flip", SetBool, data=False, timeout=10)
        assert reply.success
        await pub.drain(timeout=10)


@pytest.mark.skipif(not Path("/proc/self/fd").is_dir(), reason="counts sockets in /proc")
async def test_twenty_two_nodes_start_stop_and_start_again_and_leave_nothing():
    sockets = open_sockets()
    threads = threading.enumerate()
    tasks = asyncio.all_tasks()
    for _ in range(2):
        await graph_of_twenty_two()
        await asyncio.sleep(0)  # transports that are closing tell their protocols
        gc.collect()
        assert asyncio.all_tasks() == tasks
        assert open_sockets() == sockets
        assert threading.enumerate() == threads


async def test_root_logger_signals_and_policy_are_left_alone(make_node):
    root = logging.getLogger()
    before = (root.level, list(root.handlers), root.filters[:])
    handlers = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    node = await make_node("guest", rosout=True, logger_services=True)
    node.log.warning("hello")
    assert (root.level, list(root.handlers), root.filters[:]) == before
    assert {number: signal.getsignal(number) for number in handlers} == handlers
    assert not logging.getLogger("aioros1").handlers


async def test_a_node_leaves_its_logger_as_it_was(make_node):
    logger = logging.getLogger("ros.guest")
    node = await make_node("guest", rosout=True)
    await node.close()
    assert not logger.handlers


async def test_two_masters_and_their_nodes_know_nothing_of_each_other():
    async with (
        aioros1.Master(host="localhost", port=0) as one,
        aioros1.Master(host="localhost", port=0) as other,
        aioros1.Node("same_name", master_uri=one.uri) as here,
        aioros1.Node("same_name", master_uri=other.uri) as there,
        here.advertise("chatter", String) as pub,
        there.subscribe("chatter", String) as sub,
    ):
        pub.publish(data="not for you")
        assert "/chatter" not in dict(await there.master.get_published_topics())
        assert here.is_open
        assert sub.publisher_count == 0


async def test_a_node_that_was_closed_is_not_started_again_but_a_new_one_is(make_node, master):
    node = await make_node("phoenix")
    await node.close()
    with pytest.raises(RuntimeError, match="started before"):
        await node.start()
    async with aioros1.Node("phoenix", master_uri=master.uri, host="localhost") as again:
        assert again.is_open


async def test_closing_twice_and_at_the_same_time(make_node):
    node = await make_node()
    await asyncio.gather(node.close(), node.close())
    await node.close()
    assert node.state == "closed"


async def test_a_cancelled_close_still_frees_everything(make_node):
    node = await make_node()
    await node.advertise("chatter", String)
    closing = asyncio.create_task(node.close())
    await asyncio.sleep(0)
    closing.cancel()
    with pytest.raises(asyncio.CancelledError):
        await closing
    assert await node.wait_closed() == "closed"
    assert node.state == "closed"


async def test_closing_when_the_master_is_gone_frees_everything():
    async with aioros1.Master(host="localhost", port=0) as master:
        node = await aioros1.Node("orphan", master_uri=master.uri).start()
        pub = await node.advertise("chatter", String)
        sub = await node.subscribe("chatter", String)
        psub = await node.subscribe_param("/p", default=1)
    await node.close()
    assert [role.is_open for role in (pub, sub, psub)] == [False] * 3
    assert [message async for message in sub] == []


async def test_a_node_without_a_master_starts_and_its_roles_say_so():
    async with aioros1.Node("early", master_uri="http://localhost:9", host="localhost") as node:
        with pytest.raises(aioros1.MasterUnreachable):
            await node.advertise("chatter", String)
        with pytest.raises(ConnectionError):
            await node.subscribe("chatter", String)
        with pytest.raises(TimeoutError, match="no master at http://localhost:9 within"):
            await node.wait_for_master(timeout=0.05)
        assert node.roles == ()


def run_python(code: str) -> subprocess.CompletedProcess[str]:
    root = Path(__file__).parent.parent
    return subprocess.run(
        [sys.executable, "-W", "error", "-X", "dev", "-c", textwrap.dedent(code)],
        capture_output=True,
        text=True,
        timeout=30,
        cwd=root,
        check=False,
    )


def test_no_warning_in_debug_mode_with_warnings_as_errors():
    result = run_python(
        """
        import asyncio, logging, sys
        sys.path.insert(0, "tests")
        logging.basicConfig(level=logging.ERROR)
        from test_embedding import graph_of_twenty_two
        asyncio.run(graph_of_twenty_two(), debug=True)
        asyncio.run(graph_of_twenty_two(), debug=True)
        """
    )
    assert result.returncode == 0, result.stderr
    assert not result.stderr


def test_a_node_that_was_never_closed_is_warned_of():
    result = run_python(
        """
        import asyncio, warnings
        import aioros1
        async def main():
            node = await aioros1.Node("forgotten", master_uri="http://localhost:9",
                                      host="localhost").start()
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            asyncio.run(main())
        print([str(each.message) for each in caught if each.category is ResourceWarning])
        """
    )
    assert "node /forgotten was never closed" in result.stdout, result.stderr


def test_importing_the_package_loads_no_http_server():
    result = run_python("import sys, aioros1; print('aiohttp' in sys.modules)")
    assert result.stdout.strip() == "False"


def test_reading_definitions_needs_no_event_loop():
    result = run_python(
        """
        import sys
        from aioros1.msg.std_msgs import String
        assert String.from_bytes(String(data="x").to_bytes()) == String(data="x")
        print([name for name in ("asyncio", "aiohttp", "numpy") if name in sys.modules])
        """
    )
    assert result.stdout.strip() == "[]", result.stderr


def test_every_public_name_is_there_and_typed():
    stub = (Path(aioros1.__file__).parent / "__init__.pyi").read_text()
    declared = {line.rsplit(" as ", 1)[1] for line in stub.splitlines() if " as " in line}
    assert declared == set(aioros1.__all__)
    with warnings.catch_warnings():
        for name in aioros1.__all__:
            assert getattr(aioros1, name) is not None
