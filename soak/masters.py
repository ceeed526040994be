"""A master in a process of its own, which can be killed and started again at once."""

from __future__ import annotations

import asyncio
import multiprocessing
import socket
from typing import Any

__all__ = ["MasterProcess"]

# Forked from a process that has everything imported already: a master that took a second
# to come up would make a thousand restarts take half an hour.
_context = multiprocessing.get_context("forkserver")
_context.set_forkserver_preload(["aioros1", "aioros1.master.server"])


def _serve(port: int, ready: Any) -> None:
    import aioros1

    async def main() -> None:
        async with aioros1.Master(host="localhost", port=port, rosout=False):
            ready.send(True)
            ready.close()
            await asyncio.get_running_loop().create_future()

    asyncio.run(main())


class MasterProcess:
    """A master at one URI, in one process after another."""

    def __init__(self) -> None:
        with socket.create_server(("127.0.0.1", 0)) as probe:
            self.port: int = probe.getsockname()[1]
        self.uri = f"http://localhost:{self.port}"
        self._process: Any = None

    async def start(self) -> None:
        """Return when it answers."""
        receiving, sending = _context.Pipe(duplex=False)
        self._process = _context.Process(target=_serve, args=(self.port, sending), daemon=True)
        self._process.start()
        sending.close()
        try:
            # Asked now and then, as a thread that waits would be one thread more.
            async with asyncio.timeout(30):
                while not receiving.poll():
                    await asyncio.sleep(0.002)
            receiving.recv()
        finally:
            receiving.close()

    async def kill(self) -> None:
        """End it without a word, as kill -9 does."""
        self._process.kill()
        while self._process.exitcode is None:
            await asyncio.sleep(0.001)
        self._process.close()
