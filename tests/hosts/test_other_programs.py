"""Debian's rospy and roscpp on one host, our node on another."""

from __future__ import annotations

from collections.abc import AsyncIterator, Callable
from pathlib import Path

import pytest

from ..interop import debian
from ..interop.cpp import compile_peer, shared_folder
from ..interop.processes import Process, end_all
from ..interop.world import PEERS, ROSPY_MODULES
from .network import Host, Network
from .remote import Program

pytestmark = pytest.mark.interop

Start = Callable[..., Process]


@pytest.fixture
async def start_on(tmp_path: Path) -> AsyncIterator[Start]:
    """``start_on(host, uri, label, *command)``: another program, on a host."""
    processes: list[Process] = []

    def start(host: Host, uri: str, label: str, *command: str) -> Process:
        env = debian.environment(uri, tmp_path / "ros_home")
        del env["ROS_HOSTNAME"]
        env["ROS_IP"] = host.address
        process = Process(host.command(*command), env=env, folder=tmp_path, label=label)
        processes.append(process)
        return process

    yield start
    await end_all(processes)


@pytest.fixture(scope="session")
def cpp_peer(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return compile_peer(shared_folder(request.config, tmp_path_factory))


def ours(net: Network) -> tuple[Host, str, Program]:
    one, two = net.host("one"), net.host("two")
    program = one.start()
    uri = program("master")
    program("start", "ours", master_uri=uri)
    return two, uri, program


async def test_rospy(net: Network, start_on: Start):
    debian.require_python(*ROSPY_MODULES)
    host, uri, a = ours(net)

    def rospy(script: str, *args: str) -> Process:
        return start_on(host, uri, script, debian.PYTHON, str(PEERS / f"{script}.py"), *args)

    a("advertise", "/to_rospy")
    a("subscribe", "/from_rospy")
    a("serve", "/ours", "this is ours")
    listener = rospy("listener", "/to_rospy", "std_msgs/String")
    talker = rospy("talker", "/from_rospy", "std_msgs/String", '{"data": "it is rospy"}')
    server = rospy("server", "/theirs", "std_srvs/SetBool", "--reply", '{"message": "hello"}')
    client = rospy("client", "/ours", "std_srvs/SetBool", '{"data": true}')
    assert a("take", "/from_rospy") == ["it is rospy"]
    (connection,) = a("connections", "/from_rospy")
    assert connection["remote"][0] == host.address
    a("wait_for_subscribers", "/to_rospy")
    a("publish", "/to_rospy", "it is us")
    assert await listener.wait_values("message") == [{"data": "it is us"}]
    await server.wait_values("ready")
    assert a("call", "/theirs", timeout=10) == "hello"
    answer = {"success": True, "message": "this is ours"}
    assert await client.wait_values("answer") == [answer]
    assert talker.is_alive


async def test_roscpp(net: Network, start_on: Start, cpp_peer: Path):
    host, uri, a = ours(net)

    def roscpp(role: str, *args: str) -> Process:
        return start_on(host, uri, role, str(cpp_peer), role, *args)

    a("advertise", "/to_roscpp")
    a("subscribe", "/from_roscpp")
    a("serve", "/ours", "this is ours")
    names = {role: f"__name:={role}" for role in ("listener", "talker", "server", "client")}
    string = "std_msgs/String"
    listener = roscpp("listener", "/to_roscpp", string, names["listener"])
    roscpp("talker", "/from_roscpp", string, "5", "100", "0", names["talker"])
    server = roscpp("server", "/theirs", "", names["server"])
    client = roscpp("client", "/ours", "1", "0", names["client"])
    heard = a("take", "/from_roscpp", 5)
    assert heard == [f"number {number}" for number in range(5)]
    a("wait_for_subscribers", "/to_roscpp")
    a("publish", "/to_roscpp", "it is us")
    assert await listener.wait_values("message") == [{"data": "it is us"}]
    await server.wait_values("ready")
    assert a("call", "/theirs", timeout=10) == "it is on"
    answer = {"success": True, "message": "this is ours"}
    assert await client.wait_values("answer") == [answer]
