"""Both sides of a benchmark in one event loop: ``ping_pong`` and ``pub_sub``."""

from __future__ import annotations

import asyncio

from aioros1_peer import Options, ping, pong, pub, sub

__all__ = ["MODES"]


async def ping_pong(options: Options) -> None:
    answering = asyncio.create_task(pong(options))
    await ping(options)
    answering.cancel()


async def pub_sub(options: Options) -> None:
    """What ``sub`` reports comes last; the CPU time in it is that of both."""
    sending = asyncio.create_task(pub(options))
    await sub(options)
    await sending


MODES = {mode.__name__: mode for mode in (ping_pong, pub_sub)}
