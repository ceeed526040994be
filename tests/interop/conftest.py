"""Fixtures for the tests against the real ROS 1 programs of a Debian system.

A test takes ``under_rosmaster``, ``under_ours`` or, to run under both masters,
``under_each``. What is missing on the system skips a test, unless
``AIOROS1_REQUIRE_INTEROP=1`` says that everything has to be there.
``AIOROS1_INTEROP_LOOP=uvloop`` runs our side on uvloop.
"""

from __future__ import annotations

import asyncio
import os
from collections.abc import AsyncIterator, Callable, Iterator
from contextlib import asynccontextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from .cpp import compile_peer, shared_folder
from .processes import end_all
from .rosmaster import RealMaster
from .world import World

if TYPE_CHECKING:
    import aioros1

HERE = Path(__file__).parent


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        if HERE in item.path.parents:
            item.add_marker(pytest.mark.interop)


@pytest.hookimpl(optionalhook=True)
def pytest_asyncio_loop_factories() -> dict[str, Callable[[], asyncio.AbstractEventLoop]]:
    """One loop only: the time goes into starting programs."""
    if os.environ.get("AIOROS1_INTEROP_LOOP") == "uvloop":
        import uvloop

        return {"uvloop": uvloop.new_event_loop}
    return {"asyncio": asyncio.new_event_loop}


@pytest.fixture(autouse=True)
def _no_ros_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    """Our side must know nothing of ROS but what a test tells it."""
    for name in [name for name in os.environ if name.startswith("ROS_")]:
        monkeypatch.delenv(name)


@pytest.fixture(scope="session")
def cpp_peer(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> Callable[[], Path]:
    """Returns the compiled C++ program, or skips the test where it cannot be compiled."""
    try:
        program = compile_peer(shared_folder(request.config, tmp_path_factory))
    except pytest.skip.Exception as missing:
        reason = missing.msg

        def skip() -> Path:
            pytest.skip(reason)

        return skip
    return lambda: program


@pytest.fixture(scope="module")
def real_master(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RealMaster]:
    """A rosmaster that the tests of one module share."""
    master = RealMaster(tmp_path_factory.mktemp("rosmaster"))
    try:
        master.start()
        yield master
    finally:
        master.stop()


@pytest.fixture
def own_real_master(tmp_path: Path) -> Iterator[RealMaster]:
    """A rosmaster for a test that stops it."""
    master = RealMaster(tmp_path)
    try:
        master.start()
        yield master
    finally:
        master.stop()


@pytest.fixture
async def our_master() -> AsyncIterator[aioros1.Master]:
    """Our master in the loop of the test."""
    import aioros1

    async with aioros1.Master(host="localhost", port=0) as master:
        yield master


@asynccontextmanager
async def _world(kind: str, uri: str, folder: Path, cpp: Any) -> AsyncIterator[World]:
    world = World(kind, uri, folder, cpp)
    try:
        yield world
    finally:
        await end_all(world.processes)


@pytest.fixture
async def under_rosmaster(
    real_master: RealMaster, tmp_path: Path, cpp_peer: Callable[[], Path]
) -> AsyncIterator[World]:
    async with _world("rosmaster", real_master.uri, tmp_path, cpp_peer) as world:
        yield world


@pytest.fixture
async def under_ours(
    our_master: aioros1.Master, tmp_path: Path, cpp_peer: Callable[[], Path]
) -> AsyncIterator[World]:
    async with _world("aioros1", our_master.uri, tmp_path, cpp_peer) as world:
        yield world


@pytest.fixture(params=["rosmaster", "ours"])
async def under_each(
    request: pytest.FixtureRequest, tmp_path: Path, cpp_peer: Callable[[], Path]
) -> AsyncIterator[World]:
    """The test runs twice: under rosmaster and under our master."""
    if request.param == "rosmaster":
        uri = request.getfixturevalue("real_master").uri
        async with _world("rosmaster", uri, tmp_path, cpp_peer) as world:
            yield world
    else:
        import aioros1

        async with (
            aioros1.Master(host="localhost", port=0) as master,
            _world("aioros1", master.uri, tmp_path, cpp_peer) as world,
        ):
            yield world
