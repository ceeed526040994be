"""``aioros1 master``: a master and parameter server until it is told to end."""

from __future__ import annotations

import contextlib
import signal
import sys
from typing import Annotated, TypeAlias

from cyclopts import Parameter

__all__ = ["master"]


Networks: TypeAlias = Annotated[
    tuple[str, ...],
    Parameter(
        name="--allow",
        negative=(),
        show_default=False,
        help="A network from which connections are taken, such as 127.0.0.0/8 or 10.0.0.5; "
        "can be repeated. All others are turned away. By default everybody is let in.",
    ),
]


def master(
    *, port: int = 11311, host: str | None = None, bind: str | None = None, allow: Networks = ()
) -> None:
    """Run a ROS master until SIGINT, SIGTERM or a request to shut down.

    Parameters
    ----------
    port
        TCP port; 0 takes a free one.
    host
        What others are told to reach the master by. With localhost it listens only there,
        else on every interface. By default ROS_HOSTNAME, ROS_IP, the address to listen on,
        or the address of this machine.
    bind
        The numeric address to listen on, if host does not say it: 127.0.0.1, or that of one
        interface.
    """
    import asyncio  # here, as is the master below: other commands and the help need neither

    raise SystemExit(asyncio.run(_serve(host, port, bind, allow or None)))


async def _serve(
    host: str | None, port: int, bind: str | None, allow: tuple[str, ...] | None
) -> int:
    import asyncio

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
