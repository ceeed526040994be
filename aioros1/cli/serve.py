"""Runs a master until it is told to end: what ``aioros1 master`` does.

It imports neither cyclopts nor rich. They take as long as all of the master, which programs
wait for.
"""

from __future__ import annotations

import asyncio
import contextlib
import signal
import sys
from collections.abc import Sequence
from typing import Any

__all__ = ["plain_options", "run"]

_WORDS = ("--port", "--host", "--bind", "--allow")


def plain_options(words: Sequence[str]) -> dict[str, Any] | None:
    """The options of :func:`run` that plain words (``--port 0``) give, None if there are others."""
    options: dict[str, Any] = {}
    rest = iter(words)
    for word in rest:
        name, equals, value = word.partition("=")
        if name not in _WORDS:
            return None
        if not equals:
            value = next(rest, "")
        if not value or value.startswith("-"):
            return None
        if name == "--allow":
            options["allow"] = (*options.get("allow", ()), value)
        elif name == "--port":
            if not (value.isascii() and value.isdigit()):
                return None
            options["port"] = int(value)
        else:
            options[name[2:]] = value
    return options


def run(
    *,
    port: int = 11311,
    host: str | None = None,
    bind: str | None = None,
    allow: tuple[str, ...] = (),
) -> int:
    """Serve until SIGINT, SIGTERM or a request to shut down; returns the exit status."""
    return asyncio.run(_serve(host, port, bind, allow or None))


async def _serve(
    host: str | None, port: int, bind: str | None, allow: tuple[str, ...] | None
) -> int:
    from aioros1 import Master

    stop = asyncio.Event()
    loop = asyncio.get_running_loop()
    with contextlib.suppress(NotImplementedError):  # Windows has KeyboardInterrupt instead
        for number in (signal.SIGINT, signal.SIGTERM):
            loop.add_signal_handler(number, stop.set)
    try:
        core = Master(host, port, bind=bind, allow=allow)
        await core.start()
    except (OSError, ValueError) as error:
        print(f"aioros1 master: {_text(error)}", file=sys.stderr)
        return 1
    try:
        print(f"ROS_MASTER_URI={core.uri}", flush=True)
        waiting = {
            asyncio.create_task(stop.wait(), name="aioros1-cli-signal"),
            asyncio.create_task(core.wait_closed(), name="aioros1-cli-closed"),
        }
        try:
            await asyncio.wait(waiting, return_when=asyncio.FIRST_COMPLETED)
        finally:
            for task in waiting:
                task.cancel()
            await asyncio.gather(*waiting, return_exceptions=True)
    finally:
        await core.close()
    return 0


def _text(error: Exception) -> str:
    return (error.strerror if isinstance(error, OSError) else None) or str(error)
