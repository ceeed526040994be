"""A master and nodes that write down what they are told."""

from __future__ import annotations

import asyncio
import contextlib
import os
import random
import shutil
import signal
import socket
from collections.abc import AsyncIterator, Awaitable, Callable
from pathlib import Path
from typing import Any

import pytest

from aioros1.master import Master
from aioros1.options import Timeouts
from aioros1.xmlrpc.client import XmlRpcClient
from aioros1.xmlrpc.server import XmlRpcServer

ROSMASTER = shutil.which("rosmaster", path="/usr/bin:/opt/ros/noetic/bin")


class RecordingNode:
    """The slave API of a node: what it was called with, in order."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.told: list[tuple[Any, ...]] = []
        self.answer: Any = [1, "", 0]
        self.hold: asyncio.Event | None = None
        self._changed = asyncio.Event()
        self._server = XmlRpcServer(
            {
                method: self._method(method)
                for method in ("publisherUpdate", "paramUpdate", "shutdown")
            }
        )

    @property
    def uri(self) -> str:
        return f"http://127.0.0.1:{self._server.port}/"

    def _method(self, method: str) -> Callable[..., Awaitable[Any]]:
        async def record(*params: Any) -> Any:
            self.told.append((method, *params))
            self._changed.set()
            if self.hold is not None:
                await self.hold.wait()
            return self.answer

        return record

    async def until(self, condition: Callable[[], bool]) -> None:
        """Until ``condition`` holds after the node was told something."""
        async with asyncio.timeout(10):
            while not condition():
                self._changed.clear()
                await self._changed.wait()

    async def has_been_told(self, count: int) -> list[tuple[Any, ...]]:
        await self.until(lambda: len(self.told) >= count)
        return self.told

    async def start(self, port: int = 0) -> None:
        await self._server.start("127.0.0.1", port)

    async def close(self) -> None:
        await self._server.close(timeout=0.01)


@pytest.fixture
async def make_node() -> AsyncIterator[Callable[[str], Awaitable[RecordingNode]]]:
    async with contextlib.AsyncExitStack() as stack:

        async def make(name: str) -> RecordingNode:
            node = RecordingNode(name)
            await node.start()
            stack.push_async_callback(node.close)
            return node

        yield make


@pytest.fixture
async def master() -> AsyncIterator[Master]:
    async with Master("127.0.0.1", port=0, rosout=False, timeouts=Timeouts(xmlrpc=0.3)) as made:
        yield made


@pytest.fixture
async def ask(master: Master) -> AsyncIterator[Callable[..., Awaitable[Any]]]:
    """``await ask("getParam", "/caller", "/key")``: the whole answer of ``master``."""
    client = XmlRpcClient()

    async def call(method: str, *params: Any) -> Any:
        return await client.call(master.uri, method, *params)

    yield call
    await client.close()


def free_port() -> int:
    """A port nobody listens on, and that the system gives to nobody who asks for any."""
    while True:
        port = random.randrange(10_000, 30_000)
        with socket.socket() as probe, contextlib.suppress(OSError):
            probe.bind(("127.0.0.1", port))
            return port


@pytest.fixture
async def rosmaster(tmp_path: Path) -> AsyncIterator[str]:
    """The URI of a real master, with nothing in it."""
    if ROSMASTER is None:
        pytest.skip("needs the Debian package python3-rosmaster")
    port = free_port()
    environ = {k: v for k, v in os.environ.items() if not k.startswith(("ROS_", "PYTHON"))}
    environ |= {
        "ROS_MASTER_URI": f"http://localhost:{port}",
        "ROS_HOSTNAME": "localhost",
        "ROS_PACKAGE_PATH": "/usr/share",
        "ROS_ROOT": "/usr/share/ros",
        "ROS_DISTRO": "noetic",
        "ROS_HOME": str(tmp_path),
        "PATH": "/usr/bin:/bin",
    }
    process = await asyncio.create_subprocess_exec(
        ROSMASTER, "--core", "-p", str(port),
        env=environ, stdout=asyncio.subprocess.DEVNULL, stderr=asyncio.subprocess.DEVNULL,
    )  # fmt: skip
    try:
        uri = f"http://127.0.0.1:{port}"
        client = XmlRpcClient()
        async with asyncio.timeout(20):
            while True:
                try:
                    await client.call(uri, "getPid", "/c")
                    break
                except ConnectionError:
                    await asyncio.sleep(0.05)
        await client.close()
        yield uri
    finally:
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
            process.send_signal(number)
            with contextlib.suppress(TimeoutError):
                await asyncio.wait_for(process.wait(), 3)
                break
