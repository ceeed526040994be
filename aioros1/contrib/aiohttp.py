"""A node in an aiohttp web application."""

from __future__ import annotations

from collections.abc import AsyncIterator, Callable
from typing import Any

from aiohttp import web

from aioros1 import Node

__all__ = ["NODE", "node_ctx"]

NODE: web.AppKey[Node] = web.AppKey("node", Node)
"""``request.app[NODE]`` is the node."""


def node_ctx(
    name: str, *, key: web.AppKey[Node] = NODE, **options: Any
) -> Callable[[web.Application], AsyncIterator[None]]:
    """A node that starts and ends with an application; for ``app.cleanup_ctx``.

    ::

        app.cleanup_ctx.append(node_ctx("web"))

    ``app[key]`` is the node; an application with several nodes has a key for each. The
    options are those of :class:`~aioros1.Node`. If the node fails to start, so does the
    application.
    """

    async def ros(app: web.Application) -> AsyncIterator[None]:
        async with Node(name, **options) as node:
            app[key] = node
            yield

    return ros
