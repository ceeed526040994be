"""Fixtures for pytest and pytest-asyncio: a ROS graph for each test, and simulated time.

Asynchronous fixtures run in the event loop of the test, in both modes of pytest-asyncio.
"""

from __future__ import annotations

import contextlib
import sys
from collections.abc import AsyncIterator, Callable, Iterator
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    import asyncio

    from aioros1 import Master, Node
    from aioros1.testing.leaks import LeakCheck
    from aioros1.testing.makers import MakeFlakyProxy, MakeNode
    from aioros1.testing.simulated_clock import SimulatedClock

_ENVIRONMENT = ("ROS_IP", "ROS_HOSTNAME", "ROS_NAMESPACE", "ROS_IPV6")

# All plugins are loaded by the time this module is imported. Without pytest-asyncio nothing
# runs the asynchronous fixtures, and `_in_the_loop` says so.
_asyncio_plugin: Any = sys.modules.get("pytest_asyncio")
_async_fixture: Callable[..., Any] = (
    pytest.fixture if _asyncio_plugin is None else _asyncio_plugin.fixture
)


@pytest.fixture
def _in_the_loop(request: pytest.FixtureRequest) -> None:
    """Fail with a reason where an asynchronous fixture would not work."""
    if problem := _why_not(request):
        pytest.fail(f"the fixtures of aioros1 cannot be used here: {problem}", pytrace=False)


def _why_not(request: pytest.FixtureRequest) -> str | None:
    config = request.config
    plugin = sys.modules.get("pytest_asyncio.plugin")
    if plugin is None or not config.pluginmanager.is_registered(plugin):
        return "they need pytest-asyncio, which is not loaded; pip install pytest-asyncio"
    marker = request.node.get_closest_marker("asyncio")
    unittest = sys.modules.get("unittest")
    if request.cls is not None and unittest and issubclass(request.cls, unittest.TestCase):
        return (
            "the test is one of unittest, which runs it in an event loop of its own; open "
            "aioros1.Master and aioros1.Node in asyncSetUp(), with enterAsyncContext()"
        )
    if marker is None:
        kind = "anyio runs this test" if "anyio_backend" in request.fixturenames else "it is not"
        return (
            f"the test has to be run by pytest-asyncio, and {kind}; make it `async def`, and mark "
            "it with @pytest.mark.asyncio or set asyncio_mode = auto"
        )
    test = marker.kwargs.get("loop_scope") or config.getini("asyncio_default_test_loop_scope")
    fixture = config.getini("asyncio_default_fixture_loop_scope")
    if fixture in (None, "", "fixture-scope"):
        fixture = "function"
    if test != fixture:
        return (
            f"the event loop of the test is that of its {test}, and fixtures have one for each "
            f"{fixture}; set asyncio_default_fixture_loop_scope = {test}"
        )
    return None


@_async_fixture
async def ros_master(_in_the_loop: None) -> AsyncIterator[Master]:
    """A :class:`aioros1.Master` on a free port of localhost, with an empty graph.

    ``ROS_MASTER_URI`` points to it during the test, so that the code under test finds it;
    ``ROS_IP``, ``ROS_HOSTNAME``, ``ROS_NAMESPACE`` and ``ROS_IPV6`` are unset.
    """
    from aioros1 import Master

    # Without the node /rosout, so that the graph holds only what a test puts there.
    async with Master(host="localhost", port=0, rosout=False) as master:
        with pytest.MonkeyPatch.context() as patch:
            for name in _ENVIRONMENT:
                patch.delenv(name, raising=False)
            patch.setenv("ROS_MASTER_URI", master.uri)
            yield master


@_async_fixture
async def ros_clock(ros_master: Master) -> AsyncIterator[SimulatedClock]:
    """A :class:`~aioros1.testing.SimulatedClock` in the graph of ``ros_master``, from 1 s on.

    It starts before the nodes of ``make_node`` and ``ros_node``, and tracks them.
    """
    from aioros1.testing.simulated_clock import SimulatedClock

    async with SimulatedClock(ros_master.uri) as clock:
        yield clock


@pytest.fixture
def _clock_or_none(request: pytest.FixtureRequest, _in_the_loop: None) -> SimulatedClock | None:
    """The clock, set up before any node wherever it is among the test's arguments."""
    if "ros_clock" not in request.fixturenames:
        return None
    clock: SimulatedClock = request.getfixturevalue("ros_clock")
    return clock


@_async_fixture
async def make_node(
    ros_master: Master, _clock_or_none: SimulatedClock | None
) -> AsyncIterator[MakeNode]:
    """``await make_node("name", **options)``: a started node, closed after the test."""
    from aioros1.testing.makers import MakeNode

    async with contextlib.AsyncExitStack() as stack:
        yield MakeNode(ros_master.uri, stack, _clock_or_none)


@_async_fixture
async def ros_node(make_node: MakeNode) -> Node:
    """A started node, ``/node``, made by ``make_node``."""
    return await make_node("node")


@_async_fixture
async def flaky_proxy(_in_the_loop: None) -> AsyncIterator[MakeFlakyProxy]:
    """``await flaky_proxy(host, port, **options)``: an open
    :class:`~aioros1.testing.FlakyProxy`, closed after the test."""
    from aioros1.testing.makers import MakeFlakyProxy

    async with contextlib.AsyncExitStack() as stack:
        yield MakeFlakyProxy(stack)


@_async_fixture
async def _tasks_before(_in_the_loop: None) -> set[asyncio.Task[Any]]:
    import asyncio

    return asyncio.all_tasks()


@pytest.fixture
def no_leaks(request: pytest.FixtureRequest) -> Iterator[LeakCheck]:
    """Fail the test if it leaves anything behind.

    Looks for running tasks and nodes, open sockets and files, and threads, after the test's
    other fixtures of function scope have ended.
    """
    from aioros1.testing.leaks import LeakCheck

    if _is_asyncio(request):
        request.getfixturevalue("_tasks_before")  # the loop and its files exist now
    check = LeakCheck()
    yield check
    if leaks := check.leaks(wait=not _is_asyncio(request)):
        pytest.fail("\n  ".join(["left behind by the test:", *leaks]), pytrace=False)


@_async_fixture
async def _look_into_loop(
    no_leaks: LeakCheck, _tasks_before: set[asyncio.Task[Any]]
) -> AsyncIterator[None]:
    yield
    await no_leaks.look_into_loop(_tasks_before)


@pytest.fixture(autouse=True)
def _leaks_last(request: pytest.FixtureRequest) -> None:
    """Set up ``no_leaks``, if used, before all other fixtures, so that it ends after them."""
    marker = request.node.get_closest_marker("no_leaks")
    if marker is not None:
        wanted = bool(marker.args[0] if marker.args else marker.kwargs.get("check", True))
    else:
        wanted = bool(request.config.getini("aioros1_check_leaks"))
    if wanted or "no_leaks" in request.fixturenames:
        request.getfixturevalue("no_leaks")
        if _is_asyncio(request):
            request.getfixturevalue("_look_into_loop")


def _is_asyncio(request: pytest.FixtureRequest) -> bool:
    return request.node.get_closest_marker("asyncio") is not None
