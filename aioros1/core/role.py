"""What all roles of a node have in common, and how one is opened."""

from __future__ import annotations

import asyncio
import builtins
from abc import ABC, abstractmethod
from collections.abc import Coroutine, Generator
from dataclasses import dataclass
from types import TracebackType
from typing import TYPE_CHECKING, Any, Generic, Self, TypeVar

from aioros1.errors import ClosedError

if TYPE_CHECKING:
    from aioros1.connection import ConnectionInfo
    from aioros1.node import Node

__all__ = ["NodeStats", "Opening", "Role", "RoleStats"]


@dataclass(slots=True)
class RoleStats:
    """Counters of one role since it was opened. They only ever grow."""

    messages: int = 0
    """Messages published or received, or calls made or answered."""

    bytes: int = 0
    """Bytes of those, counted once however many peers there are."""

    dropped: int = 0
    """Messages dropped from a full queue; a message for three peers counts for each."""

    errors: int = 0
    """Messages that could not be decoded, or calls that failed."""


@dataclass(frozen=True, slots=True)
class NodeStats:
    """Sums over the open roles of a node."""

    messages: int
    bytes: int
    dropped: int
    errors: int
    roles: int
    connections: int
    connections_refused: int
    """Connections closed at once because there were too many: ``connections``,
    ``xmlrpc_connections`` and ``connections_per_host`` of ``limits``."""
    connections_forbidden: int
    """Connections closed at once because their address is not in ``allow``."""
    requests_delayed: int
    """XML-RPC requests that had to wait for ``limits.requests_per_second``."""


class Role(ABC):
    """A publisher, subscriber, service provider, service caller or parameter subscriber.

    A role is open from the moment its factory on :class:`Node` hands it out. It is
    closed by :meth:`close`, by the end of the ``async with`` it was opened in, or with
    its node.
    """

    kind = "role"

    def __init__(self, node: Node, name: str) -> None:
        self._node = node
        self._name = name
        self._is_open = True
        self._closing: asyncio.Task[None] | None = None
        self.stats = RoleStats()

    @property
    def node(self) -> Node:
        """The node the role belongs to."""
        return self._node

    @property
    def name(self) -> str:
        """The resolved name of the topic, service or parameter."""
        return self._name

    @property
    def type(self) -> str:
        """``pkg/Type``; ``*`` for a subscriber to any type, empty for a parameter."""
        return ""

    @property
    def md5sum(self) -> str:
        """The md5sum of the definition; ``*`` for any."""
        return ""

    @property
    def definition(self) -> str:
        """The full text of the definition, its dependencies included."""
        return ""

    @property
    def is_open(self) -> bool:
        """Whether the role can be used; False once it is being closed."""
        return self._is_open

    @property
    def connections(self) -> tuple[ConnectionInfo, ...]:
        """The TCPROS connections the role uses now."""
        return ()

    async def close(self) -> None:
        """Take the role back from the master and free what it holds.

        May be called any number of times. What could not be said to the master, because
        it is gone, is logged and not raised. When it is cancelled, closing goes on.
        """
        if self._is_open:
            self._is_open = False
            self._closing = self._node._spawn(self._finish, name=f"close {self.kind} {self.name}")
        if self._closing is not None:
            await asyncio.wait({self._closing})

    async def _finish(self) -> None:
        try:
            await self._close()
        finally:
            self._node._roles.open.pop(self, None)

    @abstractmethod
    async def _close(self) -> None: ...

    def _abort(self) -> None:
        """The node has ended: wake up whoever waits here, tell nobody."""
        self._is_open = False

    def _check_open(self) -> None:
        if not self._is_open:
            raise self._closed_error()

    def _closed_error(self) -> ClosedError:
        reason = self._node.close_reason
        why = f": the node was closed ({reason})" if reason is not None else ""
        return ClosedError(f"{self.kind} {self._name} of {self._node.name} is closed{why}")

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(
        self,
        exc_type: builtins.type[BaseException] | None,
        exc: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        await self.close()

    def __repr__(self) -> str:
        state = "open" if self._is_open else "closed"
        return f"<{type(self).__name__} {self._name} [{self.type}] of {self._node.name}, {state}>"


R = TypeVar("R", bound=Role)


class Opening(Generic[R]):
    """A role on its way: await it, or use it with ``async with``.

    ::

        pub = await node.advertise("chatter", String)    # closed by pub.close()
        async with node.advertise("chatter", String) as pub:
            ...                                          # closed at the end
    """

    __slots__ = ("_coroutine", "_role")

    def __init__(self, coroutine: Coroutine[Any, Any, R]) -> None:
        # The coroutine itself and not a function that makes it, so that Python warns
        # of one that is never awaited.
        self._coroutine = coroutine

    def __await__(self) -> Generator[Any, None, R]:
        return self._coroutine.__await__()

    async def __aenter__(self) -> R:
        self._role = await self._coroutine
        return self._role

    async def __aexit__(
        self,
        exc_type: type[BaseException] | None,
        exc: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        await self._role.close()
