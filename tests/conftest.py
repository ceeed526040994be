"""Fixtures of the whole suite: both event loops, a clean environment, and what must not block."""

from __future__ import annotations

import asyncio
import os
import signal
import sys
from collections.abc import Callable, Generator, Iterator
from pathlib import Path

import pytest
from blockbuster import blockbuster_ctx
from hypothesis import HealthCheck, settings

import aioros1

from .suites import ONCE, SLOW, is_listed

# The plugin that comes with the package. Where the package is installed, pytest has loaded it
# already, by another name; from which place, the interpreter's path decides, as for all of it.
_PLUGIN = "aioros1.testing.pytest_plugin"
pytest_plugins = ["pytester", *([] if _PLUGIN in sys.modules else [_PLUGIN])]

LOOPS: dict[str, Callable[[], asyncio.AbstractEventLoop]] = {"asyncio": asyncio.new_event_loop}
try:
    import uvloop
except ImportError:  # it is not made for every system
    pass
else:
    LOOPS["uvloop"] = uvloop.new_event_loop

# How long an example takes, depends on what else the machine does.
settings.register_profile(
    "any machine", deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("any machine")

HERE = Path(__file__).parent
PATH_FUNCTIONS = {"crawled", "directories", "find", "packages", "types"}
# What the real programs do on the wire, and several hosts, does not depend on our loop.
ONE_LOOP = {HERE / name for name in ("interop", "hosts")}


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        if HERE not in item.path.parents:
            continue
        file = item.path.relative_to(HERE).as_posix()
        test = getattr(item, "originalname", None) or item.name
        if is_listed(SLOW, file, test):
            item.add_marker(pytest.mark.slow)
            if not item.get_closest_marker("timeout"):
                # What fixtures start, or compile, has limits of its own.
                item.add_marker(pytest.mark.timeout(300, func_only=True))
        if is_listed(ONCE, file, test):
            item.add_marker(pytest.mark.once)


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


@pytest.fixture(scope="session", autouse=True)
def interruptible() -> Iterator[None]:
    """A shell's background job ignores SIGINT, and so would the programs that tests start."""
    previous = signal.getsignal(signal.SIGINT)
    if previous is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, previous)


@pytest.fixture(autouse=True)
def clean_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    """No test depends on the ROS that is, or is not, set up in the shell."""
    for name in ("ROS_MASTER_URI", "ROS_IP", "ROS_HOSTNAME", "ROS_NAMESPACE", "ROS_IPV6"):
        monkeypatch.delenv(name, raising=False)


@pytest.hookimpl(wrapper=True, specname="pytest_runtest_makereport")
def pytest_report_without_surrogates() -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Let a process of xdist tell what a test has logged that is no UTF-8."""
    report = yield
    report.sections = [
        (name, text.encode(errors="backslashreplace").decode()) for name, text in report.sections
    ]
    return report


@pytest.fixture(autouse=True)
def nothing_blocks(request: pytest.FixtureRequest) -> Iterator[None]:
    """The library makes no blocking call in the event loop, but to read small files once:
    definitions, from a local disk, and what the system says of itself, from its memory.
    """
    elsewhere = HERE / "hosts"  # where the library is in other processes
    if not request.node.get_closest_marker("asyncio") or elsewhere in request.path.parents:
        yield
        return
    with blockbuster_ctx("aioros1") as blockbuster:
        for function in blockbuster.functions.values():
            function.can_block_in("aioros1/idl/store.py", {"_source"})
            function.can_block_in("aioros1/idl/paths.py", PATH_FUNCTIONS)
            function.can_block_in("aioros1/net/local_transports.py", {"_host_key"})
            # Another thread is importing the same module.
            function.can_block_in("<frozen importlib._bootstrap>", {"acquire"})
        yield


@pytest.fixture
def master(ros_master: aioros1.Master) -> aioros1.Master:
    """The plugin's, by the name that most tests have for it."""
    return ros_master
