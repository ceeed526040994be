"""The graph: which nodes there are, and what each publishes, receives and provides."""

from __future__ import annotations

from collections.abc import AsyncIterator, Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from aioros1.errors import ClosedError, MasterError
from aioros1.waiting import deadline

if TYPE_CHECKING:
    from aioros1.node import Node

__all__ = ["Graph", "GraphChange", "GraphSnapshot"]


@dataclass(frozen=True, slots=True)
class GraphSnapshot:
    """The graph at one moment, as the master sees it."""

    publishers: Mapping[str, frozenset[str]]
    """Topic to the names of the nodes that publish it."""
    subscribers: Mapping[str, frozenset[str]]
    services: Mapping[str, frozenset[str]]
    topic_types: Mapping[str, str]

    @property
    def nodes(self) -> frozenset[str]:
        """Every node that is registered for something."""
        parts = (self.publishers, self.subscribers, self.services)
        return frozenset(node for part in parts for nodes in part.values() for node in nodes)

    @property
    def topics(self) -> frozenset[str]:
        """Every topic that is published or subscribed."""
        return frozenset(self.publishers) | frozenset(self.subscribers)

    def _edges(self) -> frozenset[tuple[str, str, str]]:
        parts = {
            "publisher": self.publishers,
            "subscriber": self.subscribers,
            "service": self.services,
        }
        return frozenset(
            (kind, name, node)
            for kind, part in parts.items()
            for name, nodes in part.items()
            for node in nodes
        )


@dataclass(frozen=True, slots=True)
class GraphChange:
    """What is different from one snapshot to the next."""

    snapshot: GraphSnapshot
    """The graph after the change."""
    added: frozenset[tuple[str, str, str]]
    """(kind, name, node) for each new registration; kinds are ``publisher``,
    ``subscriber`` and ``service``."""
    removed: frozenset[tuple[str, str, str]]


class Graph:
    """The graph that a node belongs to: ``node.graph``.

    The master announces new publishers to subscribers and nothing else to anybody, so
    following the graph means asking again and again.
    """

    def __init__(self, node: Node) -> None:
        self._node = node

    async def snapshot(self) -> GraphSnapshot:
        """The graph now. Raises :class:`~aioros1.MasterError`."""
        master = self._node.master
        state = await master.get_system_state()
        types = await master.get_topic_types()
        publishers, subscribers, services = (
            {name: frozenset(nodes) for name, nodes in part.items()} for part in state
        )
        return GraphSnapshot(publishers, subscribers, services, dict(types))

    async def changes(self, poll: float = 1.0) -> AsyncIterator[GraphChange]:
        """Yield what has changed since the call, looking every ``poll`` seconds.

        Ends when the node is closed. Raises :class:`~aioros1.MasterError`.
        """
        node = self._node
        try:
            before = await self.snapshot()
            while True:
                await node._pause(poll)
                now = await self.snapshot()
                old, new = before._edges(), now._edges()
                before = now
                if old != new:
                    yield GraphChange(now, new - old, old - new)
        except (ClosedError, MasterError):
            if node.is_open:
                raise

    async def wait_for(
        self,
        predicate: Callable[[GraphSnapshot], object],
        *,
        timeout: float | None = None,
        poll: float = 0.1,
    ) -> GraphSnapshot:
        """Wait until ``predicate(snapshot)`` is true, and return that snapshot.

        Raises :class:`TimeoutError` after ``timeout`` seconds, and
        :class:`~aioros1.MasterError` and :class:`~aioros1.ClosedError`.
        """
        async with deadline(timeout, "the graph did not become as wanted"):
            while not predicate(snapshot := await self.snapshot()):
                await self._node._pause(poll)
        return snapshot
