"""A real rosmaster that has forgotten a node, in ways that do not show."""

from __future__ import annotations

import asyncio
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from . import debian
from .processes import until
from .rosmaster import RealMaster
from .world import World, xmlrpc_call

if TYPE_CHECKING:
    import aioros1

STRING = "std_msgs/String"
SET_BOOL = "std_srvs/SetBool"
CONTAINER = ("unshare", "--pid", "--fork", "--kill-child")


@pytest.fixture
def container(tmp_path: Path) -> Iterator[RealMaster]:
    """A rosmaster that is process 1, as in a container, and has no run id."""
    if subprocess.run([*CONTAINER, "true"], capture_output=True, check=False).returncode:
        pytest.skip("needs the right to make a namespace of processes")
    master = RealMaster(tmp_path, CONTAINER)
    try:
        master.start()
        yield master
    finally:
        master.kill()


async def open_all(node: aioros1.Node) -> tuple[Any, ...]:
    return (
        await node.advertise("/chatter", STRING),
        await node.subscribe("/heard", STRING),
        await node.advertise_service("/flip", SET_BOOL, lambda request: {"success": True}),
        await node.subscribe_param("/gain", default=0),
    )


def listed(uri: str) -> list[list[str]]:
    """The topics and services that the master lists of the node."""
    _, _, state = xmlrpc_call(uri, "getSystemState", "/looker")
    return [[name for name, nodes in part if "/faithful" in nodes] for part in state]


def cleanup(world: World) -> bytes:
    command = ["/usr/bin/rosnode", "cleanup"]
    done = subprocess.run(command, env=world.env, input=b"y\n", capture_output=True, check=False)
    return done.stdout


ALL = [["/chatter"], ["/heard"], ["/flip"]]


async def test_a_master_in_a_container_that_was_started_again(
    container: RealMaster, tmp_path: Path
) -> None:
    import aioros1

    assert xmlrpc_call(container.uri, "getPid", "/looker")[2] == 1
    world = World("rosmaster", container.uri, tmp_path)
    async with world.node("faithful", heartbeat=1.0, rosout=False, logger_services=False) as node:
        roles = await open_all(node)
        events: list[Any] = []

        async def watch() -> None:
            async for event in node.events():
                events.append(type(event))  # noqa: PERF401 - looked at meanwhile

        watcher = asyncio.create_task(watch())
        await asyncio.sleep(0)
        container.kill()
        container.start()
        await until(lambda: listed(container.uri) == ALL, what="all to be registered again")
        await until(lambda: aioros1.MasterRestarted in events, what="the restart to be told")
        xmlrpc_call(container.uri, "setParam", "/looker", "/gain", 5)
        assert await roles[-1].wait_for(lambda value: value == 5, timeout=20) == 5
    await watcher
    assert listed(container.uri) == [[], [], []]


async def test_rosnode_cleanup_while_the_loop_is_blocked(
    own_real_master: RealMaster, tmp_path: Path
) -> None:
    """It takes the node for dead, and rosmaster knows its name all the same."""
    debian.require("rosnode")
    uri = own_real_master.uri
    world = World("rosmaster", uri, tmp_path)
    async with world.node("faithful", heartbeat=0.5, rosout=False, logger_services=False) as node:
        roles = await open_all(node)
        output = cleanup(world)  # which blocks the loop for as long as it runs
        assert b"/faithful" in output
        assert listed(uri) == [[], [], []]
        assert xmlrpc_call(uri, "lookupNode", "/looker", "/faithful")[0] == 1
        await until(lambda: listed(uri) == ALL, what="all to be registered again")
        xmlrpc_call(uri, "setParam", "/looker", "/gain", 5)
        assert await roles[-1].wait_for(lambda value: value == 5, timeout=20) == 5
