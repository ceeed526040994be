"""Fixtures of the whole suite: both event loops, a master, nodes, and what must not be left."""

from __future__ import annotations

import asyncio
import contextlib
import os
from collections.abc import AsyncIterator, Callable, Generator, Iterator
from pathlib import Path
from typing import Any

import pytest
from blockbuster import blockbuster_ctx

import aioros1

LOOPS: dict[str, Callable[[], asyncio.AbstractEventLoop]] = {"asyncio": asyncio.new_event_loop}
try:
    import uvloop
except ImportError:  # it is not made for every system
    pass
else:
    LOOPS["uvloop"] = uvloop.new_event_loop

PATH_FUNCTIONS = {"crawled", "directories", "find", "packages", "types"}
# What the real programs do on the wire, and several hosts, does not depend on our loop.
ONE_LOOP = {Path(__file__).parent / name for name in ("interop", "hosts")}


def pytest_asyncio_loop_factories(
    config: pytest.Config, item: pytest.Item
) -> dict[str, Callable[[], asyncio.AbstractEventLoop]]:
    # Starting programs takes time; tests that should see both loops say so themselves.
    if ONE_LOOP.intersection(item.path.parents):
        return {"asyncio": LOOPS["asyncio"]}
    return LOOPS


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(
    item: pytest.Item, call: pytest.CallInfo[None]
) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Where everything has to be installed, a test that is skipped for lack of it fails."""
    report = yield
    required = os.environ.get("AIOROS1_REQUIRE_INTEROP") == "1"
    needs = any(item.get_closest_marker(name) for name in ("interop", "hosts"))
    if required and report.skipped and needs:
        report.outcome = "failed"
    return report


@pytest.fixture(autouse=True)
def clean_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    """No test depends on the ROS that is, or is not, set up in the shell."""
    for name in ("ROS_MASTER_URI", "ROS_IP", "ROS_HOSTNAME", "ROS_NAMESPACE", "ROS_IPV6"):
        monkeypatch.delenv(name, raising=False)


@pytest.fixture(autouse=True)
def no_task_left(request: pytest.FixtureRequest) -> Iterator[None]:
    """After an asynchronous test and its fixtures, no task of ours runs any more."""
    if not request.node.get_closest_marker("asyncio"):
        yield
        return
    runner: Any = request.getfixturevalue("_function_scoped_runner")
    yield
    left = asyncio.all_tasks(runner.get_loop())
    assert not left, f"tasks left behind: {left}"


@pytest.fixture(autouse=True)
def nothing_blocks(request: pytest.FixtureRequest) -> Iterator[None]:
    """The library makes no blocking call in the event loop, but to read small files once:
    definitions, from a local disk, and what the system says of itself, from its memory.
    """
    if not request.node.get_closest_marker("asyncio"):
        yield
        return
    with blockbuster_ctx("aioros1") as blockbuster:
        for function in blockbuster.functions.values():
            function.can_block_in("aioros1/idl/store.py", {"_source"})
            function.can_block_in("aioros1/idl/paths.py", PATH_FUNCTIONS)
            function.can_block_in("aioros1/net/local.py", {"_host_key"})
        yield


@pytest.fixture
async def master() -> AsyncIterator[aioros1.Master]:
    """A master of our own on a free port, and nothing else in its graph."""
    # Without the node /rosout, so that the graph holds what a test puts there.
    async with aioros1.Master(host="localhost", port=0, rosout=False) as master:
        yield master


class MakeNode:
    """Starts nodes that belong to the ``master`` fixture and are closed with the test."""

    def __init__(self, uri: str, stack: contextlib.AsyncExitStack) -> None:
        self._uri = uri
        self._stack = stack

    async def __call__(self, name: str = "node", **options: Any) -> aioros1.Node:
        options.setdefault("master_uri", self._uri)
        options.setdefault("host", "localhost")
        # Quiet, unless the test is about them: less to set up, and less in the graph.
        options.setdefault("rosout", False)
        options.setdefault("logger_services", False)
        return await self._stack.enter_async_context(aioros1.Node(name, **options))


@pytest.fixture
async def make_node(master: aioros1.Master) -> AsyncIterator[MakeNode]:
    """``await make_node("name", **options)``: a started node."""
    async with contextlib.AsyncExitStack() as stack:
        yield MakeNode(master.uri, stack)
