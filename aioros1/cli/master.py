"""``aioros1 master``: a master and parameter server until it is told to end."""

from __future__ import annotations

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
    from aioros1.cli.serve import run  # here, as commands for definitions need no asyncio

    raise SystemExit(run(port=port, host=host, bind=bind, allow=allow))
