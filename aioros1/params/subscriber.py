"""Following a parameter."""

from __future__ import annotations

import copy
from collections import deque
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Self

from aioros1.core.role import Role
from aioros1.events import ParamUpdate
from aioros1.waiting import Waiters

if TYPE_CHECKING:
    from aioros1.node import Node

__all__ = ["FollowedParam", "ParamSubscriber"]


class FollowedParam:
    """A parameter that a node follows, for all its subscribers.

    The master announces the key that was set, which may be the followed one, one below
    it, or, where the parameter was set through one above, the followed one with its
    part. ``{}`` stands for a parameter that is not set.
    """

    def __init__(self, node: Node, key: str) -> None:
        self.name = key
        self.value: Any = {}
        self.subscribers: list[ParamSubscriber] = []
        self._node = node
        self._updates = 0
        self.registration = node._roles.registration(
            "parameter", key, self._register, self._unregister
        )

    @property
    def is_used(self) -> bool:
        return bool(self.subscribers)

    def concerns(self, key: str) -> bool:
        """Whether setting ``key`` changes this parameter: it is it, above it or below it."""
        return key == self.name or _is_below(key, self.name) or _is_below(self.name, key)

    def update(self, key: str, value: Any) -> None:
        """``key`` was set to ``value``; it is the followed one, one below or one above it."""
        self._updates += 1
        if self.name != key and _is_below(self.name, key):
            value = _dig(value, _path(self.name, key))
            key = self.name
        path = [] if key == self.name else _path(key, self.name)
        if value == {} and _dig(self.value, path) == {}:
            return  # unset already: the master tells also the node that deleted it
        self.value = _graft(self.value, path, value) if path else value
        for subscriber in self.subscribers:
            subscriber._put(ParamUpdate(key, copy.deepcopy(value)))
        self._node._emit(ParamUpdate(key, copy.deepcopy(value)))

    async def _register(self) -> None:
        node = self._node
        updates = self._updates
        value = await node._registrar.subscribe_param(self.name, node.uri)
        if updates == self._updates and value != self.value:
            if self.subscribers:
                self.update(self.name, value)  # it changed while the master was away
            else:
                self.value = value

    async def _unregister(self) -> None:
        await self._node._registrar.unsubscribe_param(self.name, self._node.uri)


class ParamSubscriber(Role):
    """Follows a parameter and all below it; made by :meth:`Node.subscribe_param`."""

    kind = "parameter subscriber"

    def __init__(self, node: Node, followed: FollowedParam, default: Any) -> None:
        super().__init__(node, followed.name)
        self._followed = followed
        self._default = default
        self._updates: deque[ParamUpdate] = deque(maxlen=1000)
        self._arrived = Waiters()

    @property
    def value(self) -> Any:
        """The value now, a copy of it. Never asks the master.

        Raises :class:`KeyError` when the parameter is not set and there is no default.
        An empty dict counts as not set, because ROS 1 announces both alike.
        """
        value = self._followed.value
        if isinstance(value, dict) and not value:
            if self._default is ...:
                raise KeyError(self.name)
            return copy.deepcopy(self._default)
        return copy.deepcopy(value)

    def __aiter__(self) -> Self:
        return self

    async def __anext__(self) -> ParamUpdate:
        """The next update since the subscriber was opened."""
        while not self._updates:
            if not self._is_open:
                raise StopAsyncIteration
            await self._arrived.wait()
        return self._updates.popleft()

    async def wait_for(
        self, predicate: Callable[[Any], object], *, timeout: float | None = None
    ) -> Any:
        """Wait until ``predicate(value)`` is true, and return that value.

        A parameter that is not set, and has no default, is passed over. Raises
        :class:`TimeoutError` after ``timeout`` seconds, :class:`~aioros1.ClosedError`, and
        whatever the predicate raises. Takes nothing from the iteration.
        """
        found: list[Any] = []

        def holds() -> bool:
            self._check_open()
            try:
                value = self.value
            except KeyError:
                return False
            if predicate(value):
                found.append(value)
            return bool(found)

        await self._arrived.wait_until(
            holds, timeout=timeout, what=f"parameter {self.name} did not become as wanted"
        )
        return found[0]

    def _put(self, update: ParamUpdate) -> None:
        if len(self._updates) == self._updates.maxlen:
            self.stats.dropped += 1
        self._updates.append(update)
        self.stats.messages += 1
        self._arrived.wake()

    def _abort(self) -> None:
        super()._abort()
        self._arrived.wake()

    async def _close(self) -> None:
        self._updates.clear()
        self._arrived.wake()
        await self._node._roles.close_param_subscriber(self, self._followed)


def _is_below(key: str, other: str) -> bool:
    return other == "/" or key.startswith(other + "/")


def _path(key: str, above: str) -> list[str]:
    """The names that lead from ``above`` to ``key`` below it."""
    return key[len(above.rstrip("/")) + 1 :].split("/")


def _dig(value: Any, path: list[str]) -> Any:
    """The part of ``value`` at ``path``; ``{}`` where there is none."""
    for name in path:
        if not isinstance(value, dict) or name not in value:
            return {}
        value = value[name]
    return value


def _graft(tree: Any, path: list[str], value: Any) -> Any:
    """``tree`` with ``value`` at ``path``; what is in the way of the path is replaced.

    A deleted key, announced as ``{}``, is taken out.
    """
    tree = dict(tree) if isinstance(tree, dict) else {}
    name, *rest = path
    if rest:
        tree[name] = _graft(tree.get(name), rest, value)
    elif isinstance(value, dict) and not value:
        tree.pop(name, None)
    else:
        tree[name] = value
    return tree
