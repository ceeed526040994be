"""The ROS graph: its nodes, and what each publishes, receives and provides."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Self

from aioros1._public import public
from aioros1.core.context import Context
from aioros1.errors import ClosedError, MasterError, MasterUnreachable
from aioros1.waiting import Obstacle, deadline

__all__ = ["Graph", "GraphChange", "GraphChanges", "GraphNode", "GraphSnapshot"]


@public
@dataclass(frozen=True, slots=True)
class GraphNode:
    """The topics and services that one node is registered for."""

    publishes: frozenset[str]
    """Topics that the node publishes."""
    subscribes: frozenset[str]
    """Topics that the node receives."""
    provides: frozenset[str]
    """Services that the node provides."""


@public
@dataclass(frozen=True, slots=True)
class GraphSnapshot:
    """The graph at one moment, as the master sees it."""

    publishers: Mapping[str, frozenset[str]]
    """Topic to the names of the nodes that publish it."""
    subscribers: Mapping[str, frozenset[str]]
    """Topic to the names of the nodes that receive it."""
    services: Mapping[str, frozenset[str]]
    """Service to the names of the nodes that provide it."""
    topic_types: Mapping[str, str]
    """Topic to its announced type."""

    @property
    def nodes(self) -> frozenset[str]:
        """Every node that is registered for something."""
        parts = (self.publishers, self.subscribers, self.services)
        return frozenset(node for part in parts for nodes in part.values() for node in nodes)

    @property
    def topics(self) -> frozenset[str]:
        """Every topic that is published or subscribed."""
        return frozenset(self.publishers) | frozenset(self.subscribers)

    @property
    def edges(self) -> frozenset[tuple[str, str, str]]:
        """(publisher, topic, subscriber) for all nodes that should be connected, as rqt_graph
        draws them. This includes nodes that subscribe to their own topics."""
        return frozenset(
            (publisher, topic, subscriber)
            for topic, publishers in self.publishers.items()
            for publisher in publishers
            for subscriber in self.subscribers.get(topic, ())
        )

    def node(self, name: str) -> GraphNode:
        """What the node of that full name does; empty if there is no such node."""
        parts = (self.publishers, self.subscribers, self.services)
        return GraphNode(
            *(frozenset(each for each, nodes in part.items() if name in nodes) for part in parts)
        )

    def _registrations(self) -> frozenset[tuple[str, str, str]]:
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


@public
@dataclass(frozen=True, slots=True)
class GraphChange:
    """The difference between one snapshot and the next."""

    snapshot: GraphSnapshot
    """The graph after the change."""
    added: frozenset[tuple[str, str, str]]
    """(kind, name, node) for each new registration; kinds are ``publisher``,
    ``subscriber`` and ``service``."""
    removed: frozenset[tuple[str, str, str]]
    """(kind, name, node) for each registration that is gone."""


@public
class Graph:
    """The graph that a node belongs to: ``node.graph``.

    The master tells subscribers about new publishers and announces nothing else, so following
    the graph requires polling.
    """

    def __init__(self, context: Context) -> None:
        self._context = context

    def __repr__(self) -> str:
        return f"<Graph of the master at {self._context.master.uri}>"

    async def snapshot(self) -> GraphSnapshot:
        """Return the current graph. Raises :class:`~aioros1.MasterError`."""
        master = self._context.master
        state = await master.get_system_state()
        types = await master.get_topic_types()
        publishers, subscribers, services = (
            {name: frozenset(nodes) for name, nodes in part.items()} for part in state
        )
        return GraphSnapshot(publishers, subscribers, services, dict(types))

    def changes(self, poll: float = 1.0) -> GraphChanges:
        """Iterate over changes since the iteration began, polling every ``poll`` seconds.

        The iteration ends when the node closes. It goes on while the master is away, which
        knows nothing of anybody when it is back: what it has lost by then is a change, and so
        is what has registered again. ``MasterLost`` is among the node's events.

        Raises :class:`ValueError` for a ``poll`` that is not positive.
        """
        return GraphChanges(self, _positive(poll))

    async def wait_for(
        self,
        predicate: Callable[[GraphSnapshot], object],
        *,
        timeout: float | None = None,
        poll: float = 0.1,
    ) -> GraphSnapshot:
        """Wait until ``predicate(snapshot)`` is true, and return that snapshot.

        While no master answers, this goes on asking. Raises :class:`TimeoutError` after
        ``timeout`` seconds, :class:`~aioros1.MasterError` when the master refuses,
        :class:`~aioros1.ClosedError`, what ``predicate`` raises, and :class:`ValueError` for a
        ``poll`` that is not positive.
        """
        _positive(poll)
        watch = _Watch(self)
        async with deadline(timeout, "the graph did not become as wanted") as limit:
            limit.why = Obstacle(lambda: watch.obstacle)
            while (snapshot := await watch.look()) is None or not predicate(snapshot):
                await self._context.pause(poll)
        return snapshot


@public
class GraphChanges:
    """An iterator over the changes of a graph; made by :meth:`Graph.changes`.

    You can continue it after an error or a cancellation: the next change includes everything
    that has changed meanwhile.
    """

    def __init__(self, graph: Graph, poll: float) -> None:
        self._graph = graph
        self._poll = poll
        self._watch = _Watch(graph)
        self._before: GraphSnapshot | None = None
        self._has_ended = False

    def __aiter__(self) -> Self:
        return self

    async def __anext__(self) -> GraphChange:
        """Wait for the next change. Raises :class:`~aioros1.MasterError` when the master
        refuses."""
        context = self._graph._context
        try:
            if self._before is None and not self._has_ended:
                self._before = await self._watch.look()
            while not self._has_ended:
                await context.pause(self._poll)
                now = await self._watch.look()
                if now is None:
                    continue
                before, self._before = self._before, now
                if before is None:
                    continue
                old, new = before._registrations(), now._registrations()
                if old != new:
                    return GraphChange(now, new - old, old - new)
        except (ClosedError, MasterError):
            if context.is_open:
                raise
        raise StopAsyncIteration

    async def aclose(self) -> None:
        """End the iteration. You need not call this: the iterator holds no resources."""
        self._has_ended = True

    def __repr__(self) -> str:
        return f"<changes of {self._graph!r}>"


class _Watch:
    """Looks at a graph again and again, whether its master is there or not."""

    def __init__(self, graph: Graph) -> None:
        self._graph = graph
        self._has_seen = False
        self.obstacle = ""
        """Why the last look was in vain; empty if it was not."""

    async def look(self) -> GraphSnapshot | None:
        """Return the current graph, or None while no master answers.

        Raises :class:`~aioros1.MasterError` when the master refuses, and for an answer that is
        none unless there were proper ones before. A master may end in the middle of one.
        """
        try:
            snapshot = await self._graph.snapshot()
        except MasterError as error:
            is_away = isinstance(error, MasterUnreachable) or self._has_seen
            if error.is_refusal or not is_away:
                raise
            self.obstacle = error.in_short
            return None
        self._has_seen = True
        self.obstacle = ""
        return snapshot


def _positive(poll: float) -> float:
    if not poll > 0:
        raise ValueError(f"poll: expected a positive number of seconds, got {poll!r}")
    return poll
