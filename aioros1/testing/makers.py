"""Makers of nodes and proxies that are closed after the test."""

from __future__ import annotations

import contextlib
from typing import Any

from aioros1 import Node
from aioros1._public import public
from aioros1.testing.flaky_proxy import FlakyProxy
from aioros1.testing.simulated_clock import SimulatedClock

__all__ = ["MakeFlakyProxy", "MakeNode"]


@public("aioros1.testing")
class MakeNode:
    """``await make_node("name", **options)``: a started node in the graph of ``master_uri``.

    Unless the options say otherwise, nodes are at ``localhost`` and have no ``/rosout`` and
    no services for logger levels. Other defaults are those of :class:`~aioros1.Node`. Nodes
    that follow simulated time have the time of ``clock`` from the start.
    """

    def __init__(
        self,
        master_uri: str,
        stack: contextlib.AsyncExitStack,
        clock: SimulatedClock | None = None,
    ) -> None:
        self._master_uri = master_uri
        self._stack = stack
        self._clock = clock

    def __repr__(self) -> str:
        clock = "" if self._clock is None else f", with the time of {self._clock!r}"
        return f"<MakeNode for the master at {self._master_uri}{clock}>"

    async def __call__(self, name: str = "node", **options: Any) -> Node:
        options.setdefault("master_uri", self._master_uri)
        options.setdefault("host", "localhost")
        # Without these there is less to set up, and less in the graph.
        options.setdefault("rosout", False)
        options.setdefault("logger_services", False)
        node = await self._stack.enter_async_context(Node(name, **options))
        if self._clock is not None:
            await self._clock.track(node)
        return node


@public("aioros1.testing")
class MakeFlakyProxy:
    """``await flaky_proxy(host, port, **options)``: an open :class:`FlakyProxy`."""

    def __init__(self, stack: contextlib.AsyncExitStack) -> None:
        self._stack = stack
        self._made = 0

    def __repr__(self) -> str:
        return f"<MakeFlakyProxy, {self._made} made>"

    async def __call__(self, host: str, port: int, **options: Any) -> FlakyProxy:
        proxy = await self._stack.enter_async_context(FlakyProxy(host, port, **options))
        self._made += 1
        return proxy
