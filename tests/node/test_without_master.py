"""Nodes whose master is not there yet."""

from __future__ import annotations

import asyncio
import logging
import socket
import subprocess
import sys
import traceback
from pathlib import Path

import pytest

import aioros1
from aioros1.msg.std_msgs import String
from aioros1.xmlrpc.server import XmlRpcServer

ROOT = Path(__file__).parents[2]


@pytest.fixture
def port():
    with socket.socket() as sock:
        sock.bind(("127.0.0.1", 0))
        return sock.getsockname()[1]


def node_at(port, policy, **options):
    options = {"heartbeat": 0.02, "host": "localhost"} | options
    return aioros1.Node(
        "demo", master_uri=f"http://localhost:{port}", without_master=policy, **options
    )


def master_at(port, **options):
    return aioros1.Master(host="localhost", port=port, rosout=False, **options)


async def until(predicate, what):
    async with asyncio.timeout(10):
        while not predicate():
            await asyncio.sleep(0.01)
    assert predicate(), what


OPENINGS = {
    "publisher": lambda node: node.advertise("chatter", String),
    "subscriber": lambda node: node.subscribe("chatter", String),
    "provider": lambda node: node.advertise_service("flip", "std_srvs/SetBool", lambda _: None),
    "param": lambda node: node.subscribe_param("/gain", default=1),
}
ASKING = {
    "get_param": lambda node: node.get_param("/gain"),
    "set_param": lambda node: node.set_param("/gain", 2),
    "has_param": lambda node: node.has_param("/gain"),
    "get_param_names": lambda node: node.get_param_names(),
    "get_param_cached": lambda node: node.get_param_cached("/gain"),
    "search_param": lambda node: node.search_param("/gain"),
    "delete_param": lambda node: node.delete_param("/gain"),
    "peer": lambda node: node.peer("/demo"),
}


# raise, the default


@pytest.mark.parametrize("ask", [*OPENINGS.values(), *ASKING.values()], ids=[*OPENINGS, *ASKING])
async def test_the_error_is_one_line_that_says_what_to_do(port, ask):
    async with node_at(port, "raise", heartbeat=None) as node:
        with pytest.raises(aioros1.MasterUnreachable) as caught:
            await ask(node)
    text = str(caught.value)
    assert "\n" not in text
    assert text.count("http://localhost:") == 1
    for words in (f"at http://localhost:{port}", "Connection refused", "`aioros1 master`"):
        assert words in text
    assert "ROS_MASTER_URI" in text
    assert 'without_master="wait"' in text
    assert "Errno" not in text
    assert text.count("refused") == 1  # not for each address
    # One traceback, without a chain of others.
    shown = "".join(traceback.format_exception(caught.value))
    assert shown.count("Traceback") == 1


async def test_a_uri_without_a_port_means_port_80_and_the_error_says_so():
    node = aioros1.Node("demo", master_uri="http://localhost", host="localhost", heartbeat=None)
    async with node:
        with pytest.raises(aioros1.MasterUnreachable) as caught:
            await node.advertise("chatter", String)
    assert "means port 80, did you mean http://localhost:11311?" in str(caught.value)


@pytest.mark.parametrize("policy", ["wait", "later"])
async def test_who_does_not_raise_says_so_too_about_a_uri_without_a_port(policy, caplog):
    async with aioros1.Node(
        "demo", master_uri="http://localhost", host="localhost", without_master=policy
    ) as node:
        opening = node.create_task(node.advertise("chatter", String).__aenter__())
        async with asyncio.timeout(20):
            while "did you mean http://localhost:11311?" not in caplog.text:
                await asyncio.sleep(0.01)
        opening.cancel()


def test_the_option_is_checked():
    with pytest.raises(ValueError, match=r"'raise', 'wait', 'later', got 'never'"):
        aioros1.Node("demo", without_master="never")
    with pytest.raises(ValueError, match="needs a heartbeat"):
        aioros1.Node("demo", without_master="later", heartbeat=None)


# wait


async def test_everything_waits_until_a_master_answers_and_says_so_once(port, caplog):
    asking = {name: ask for name, ask in ASKING.items() if name not in ("delete_param", "peer")}
    async with node_at(port, "wait") as node:
        tasks = [
            asyncio.ensure_future(_opened(each(node)))
            for each in [*OPENINGS.values(), *asking.values()]
        ]
        await until(lambda: "waiting for a master" in caplog.text, "it to be said")
        await asyncio.sleep(0.3)
        assert not any(task.done() for task in tasks)
        async with master_at(port, params={"/gain": 2}):
            await asyncio.wait_for(asyncio.gather(*tasks), 10)
            assert len(node.roles) >= len(OPENINGS)
            state = await node.master.get_system_state()
            assert state.publishers["/chatter"] == ["/demo"]
            await node.close()
    said = [each for each in caplog.records if "waiting for a master" in each.getMessage()]
    assert len(said) == 1
    assert said[0].levelno == logging.WARNING
    assert f"http://localhost:{port}" in said[0].getMessage()
    assert "`aioros1 master`" in said[0].getMessage()


async def _opened(opening):
    return await opening


async def test_calls_wait_for_the_master_too_within_their_timeout(port):
    async with node_at(port, "wait") as node:
        with pytest.raises(TimeoutError, match="/flip"):
            await node.call("flip", "std_srvs/SetBool", timeout=0.2)
        with pytest.raises(TimeoutError, match="/chatter"):
            await node.wait_for_message("chatter", timeout=0.2)
        async with node.service_caller("flip", "std_srvs/SetBool", timeout=10) as caller:
            call = caller.send_request(data=True)
            async with master_at(port):
                with pytest.raises(aioros1.ServiceNotFound):
                    await call
                await node.close()


async def test_the_waiting_ends_with_a_cancellation_and_with_the_node(port):
    async with node_at(port, "wait") as node:
        with pytest.raises(TimeoutError):
            async with asyncio.timeout(0.1):
                await node.advertise("chatter", String)
        assert node.roles == ()
        waiting = asyncio.ensure_future(_opened(node.advertise("chatter", String)))
        asking = asyncio.ensure_future(node.get_param("/gain"))
        await asyncio.sleep(0.1)
    for task in (waiting, asking):
        with pytest.raises(aioros1.ClosedError):
            await task


async def test_the_parameters_of_the_command_line_come_before_the_first_answer(port):
    async with node_at(port, "wait", argv=["_rate:=5"]) as node:
        asking = asyncio.ensure_future(node.get_param("~rate", 1))
        await asyncio.sleep(0.1)
        async with master_at(port):
            assert await asyncio.wait_for(asking, 10) == 5
            await node.close()


# later


@pytest.mark.parametrize("heartbeat", [0.02, 0.3])
async def test_roles_are_open_at_once_and_registered_when_a_master_comes(port, caplog, heartbeat):
    async with node_at(port, "later", heartbeat=heartbeat) as node:
        events = node.events()
        pub, sub, provider, psub = [await each(node) for each in OPENINGS.values()]
        caller = await node.service_caller("flip", "std_srvs/SetBool")
        assert [each.is_open for each in (pub, sub, provider, psub, caller)] == [True] * 5
        assert psub.value == 1
        pub.publish(data="nobody hears this")
        assert node.stats.roles == 5
        with pytest.raises(aioros1.MasterUnreachable):
            await node.get_param("/gain")
        await asyncio.sleep(2 * heartbeat)
        assert caplog.text.count("no master answers") == 1
        assert f"http://localhost:{port}" in caplog.text
        async with master_at(port, params={"/gain": 2}) as master:
            await pub.wait_for_subscribers(timeout=10)
            await sub.wait_for_publishers(timeout=10)
            pub.publish(data="hello")
            assert (await sub.get(timeout=10)).data == "hello"
            assert (await asyncio.wait_for(anext(psub), 10)).value == 2
            assert psub.value == 2
            await caller.wait_for_service(timeout=10)
            await caller.call(data=True)
            seen = {}
            async with asyncio.timeout(10):
                async for event in events:
                    # None was lost, and none restarted.
                    assert not isinstance(event, aioros1.MasterLost | aioros1.MasterRestarted)
                    if isinstance(event, aioros1.RoleRegistered):
                        seen[event.kind, event.name] = True
                    if ("parameter", "/gain") in seen and len(seen) >= 4:
                        break
            assert node.run_id == master.run_id
            for _ in range(3):
                await asyncio.sleep(heartbeat)
            await node.close()
            assert not [
                event
                async for event in events
                if isinstance(event, aioros1.MasterLost | aioros1.MasterRestarted)
            ]
            state = await _state(master.uri)
            assert "/chatter" not in state.publishers
            assert "/flip" not in state.services


async def _state(uri):
    async with aioros1.Node(
        "looker", master_uri=uri, host="localhost", rosout=False, logger_services=False
    ) as node:
        return await node.master.get_system_state()


async def test_roles_and_nodes_close_without_ever_having_had_a_master(port):
    async with node_at(port, "later") as node:
        roles = [await each(node) for each in OPENINGS.values()]
        second = await node.advertise("chatter", String)
        async with asyncio.timeout(3):
            for role in (*roles, second):
                await role.close()
        assert node.roles == ()
        await node.advertise("again", String)
    assert node.state == "closed"


async def test_what_was_closed_before_the_master_came_is_not_registered(port):
    async with node_at(port, "later") as node:
        await (await node.advertise("gone", String)).close()
        await node.advertise("kept", String)
        async with master_at(port):
            async with asyncio.timeout(10):
                while "/kept" not in (await node.graph.snapshot()).topics:
                    await asyncio.sleep(0.01)
            assert "/gone" not in (await node.graph.snapshot()).topics
            await node.close()


async def test_a_master_that_refuses_is_an_error_at_once(port):
    server = XmlRpcServer(
        {
            "getPid": lambda caller: [1, "", 1],
            "getParam": lambda caller, key: [-1, "not set", 0],
            "registerPublisher": lambda *args: [-1, "no room", 0],
            "unregisterPublisher": lambda *args: [1, "", 0],
        }
    )
    await server.start("127.0.0.1", port)
    for policy in ("wait", "later"):
        async with node_at(port, policy, rosout=False, logger_services=False) as node:
            with pytest.raises(aioros1.MasterError, match="no room"):
                await node.advertise("chatter", String)
            assert node.roles == ()
    await server.close()


async def test_the_parts_of_the_node_keep_what_they_have_to_say(port):
    async with node_at(port, "later", rosout=True) as node:
        node.log.warning("said before there was a master")
        async with (
            master_at(port) as master,
            aioros1.Node("listener", master_uri=master.uri, host="localhost") as listener,
            listener.subscribe("/rosout", "rosgraph_msgs/Log", queue_size=100) as sub,
        ):
            async with asyncio.timeout(10):
                async for message in sub:
                    if message.msg == "said before there was a master":
                        break
            await node.close()


# scripts

SCRIPT = """
import asyncio, sys
import aioros1

async def main(node):
    async with node.advertise("chatter", "std_msgs/String") as pub:
        print("open", flush=True)

aioros1.run(main, "talker"{options})
"""


def script(port, options=""):
    return subprocess.Popen(
        [sys.executable, "-c", SCRIPT.format(options=options)],
        env={"PYTHONPATH": str(ROOT), "ROS_MASTER_URI": f"http://localhost:{port}"},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def test_a_script_without_a_master_ends_with_one_line_if_told_so(port):
    process = script(port, ", without_master='raise'")
    out, err = process.communicate(timeout=30)
    assert (process.returncode, out) == (1, "")
    assert len(err.splitlines()) == 1
    assert f"registerPublisher at http://localhost:{port}: cannot connect" in err
    assert "`aioros1 master`" in err


def test_a_script_waits_for_the_master_by_default(port):
    process = script(port)
    try:
        assert "waiting for a master" in process.stderr.readline()

        async def serve():
            async with master_at(port):
                return await asyncio.to_thread(process.communicate, timeout=30)

        out, err = asyncio.run(serve())
        assert (process.returncode, out, err) == (0, "open\n", "")
    finally:
        process.kill()
        process.communicate()


async def test_a_master_that_does_not_answer_delays_only_the_first_role(make_silent):
    uri = await make_silent()
    timeouts = aioros1.Timeouts(xmlrpc=0.3)
    node = aioros1.Node(
        "demo", master_uri=uri, host="localhost", without_master="later", timeouts=timeouts
    )
    async with node:
        async with asyncio.timeout(5):  # not a hundred times that timeout
            for number in range(100):
                await node.advertise(f"topic{number}", String)
        assert len(node.roles) == 100
        await node.close(timeout=0.5)


@pytest.fixture
async def make_silent():
    """A port that accepts connections and never answers."""
    writers = []

    async def start():
        server = await asyncio.start_server(lambda _, writer: writers.append(writer), "127.0.0.1")
        writers.append(server)
        return f"http://127.0.0.1:{server.sockets[0].getsockname()[1]}"

    yield start
    for each in writers:
        each.close()
