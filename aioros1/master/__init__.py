"""A ROS master and parameter server for one event loop."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from aioros1.master.server import Master

__all__ = ["Master"]


def __getattr__(name: str) -> Any:
    # The pure modules of this package work without the server, which needs aiohttp.
    if name == "Master":
        from aioros1.master.server import Master

        return Master
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
