"""A master in a thread of its own, for tests that block."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Iterator
from concurrent.futures import Future

import pytest

import aioros1


@pytest.fixture
def master_uri() -> Iterator[str]:
    """The URI of a master that runs beside the test."""
    started: Future[str] = Future()
    stop = asyncio.Event()

    async def serve() -> None:
        nonlocal loop
        loop = asyncio.get_running_loop()
        async with aioros1.Master(host="localhost", port=0, rosout=False) as master:
            started.set_result(master.uri)
            await stop.wait()

    loop: asyncio.AbstractEventLoop
    thread = threading.Thread(target=lambda: asyncio.run(serve()))
    thread.start()
    try:
        yield started.result(timeout=10)
    finally:
        loop.call_soon_threadsafe(stop.set)
        thread.join()
