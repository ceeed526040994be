"""A node in an application of Starlette, FastAPI, or a framework with the same lifespan."""

from __future__ import annotations

import contextlib
from collections.abc import AsyncIterator, Callable, Mapping
from typing import Any

from aioros1 import Node

__all__ = ["Lifespan", "node_lifespan"]

Lifespan = Callable[[Any], contextlib.AbstractAsyncContextManager[Mapping[str, Any] | None]]
"""A function that takes the application and returns an asynchronous context manager."""


def node_lifespan(
    name: str, *, inner: Lifespan | None = None, key: str = "node", **options: Any
) -> Callable[[Any], contextlib.AbstractAsyncContextManager[dict[str, Any]]]:
    """A node that starts and ends with an application; for its ``lifespan``.

    ::

        app = Starlette(routes=routes, lifespan=node_lifespan("web"))

    ``request.state.node`` and ``app.state.node`` are the node; ``key`` replaces the name
    ``node``. ``inner`` is the application's own lifespan: it runs while the node is open,
    finds it in ``app.state``, and what it yields is in ``request.state`` too. For a second
    node, pass another call of this function as ``inner``. The other options are those of
    :class:`~aioros1.Node`. Raises :class:`ValueError` when ``inner`` itself yields something
    under ``key``.
    """

    @contextlib.asynccontextmanager
    async def lifespan(app: Any) -> AsyncIterator[dict[str, Any]]:
        async with contextlib.AsyncExitStack() as stack:
            node = await stack.enter_async_context(Node(name, **options))
            setattr(app.state, key, node)
            state = await stack.enter_async_context(inner(app)) if inner is not None else None
            if state and key in state:
                raise ValueError(f"the inner lifespan yields {key!r}, which is the node {name!r}")
            yield {key: node, **(state or {})}

    return lifespan
