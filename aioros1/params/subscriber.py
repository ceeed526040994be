"""Following a parameter."""

from __future__ import annotations

import copy
from collections import deque
from collections.abc import Callable
from typing import Any, Self

from aioros1._public import public
from aioros1.core.context import Context
from aioros1.core.role import Role
from aioros1.events import ParamUpdate
from aioros1.params.followed import FollowedParam
from aioros1.params.tree import weight
from aioros1.waiting import Waiters

__all__ = ["ParamSubscriber"]

_MAX_UPDATES = 1000
_MAX_WEIGHT = 16 << 20
"""Bytes of the updates that wait, roughly."""


@public
class ParamSubscriber(Role):
    """Follows a parameter and everything below it; made by
    :meth:`aioros1.Node.subscribe_param`."""

    kind = "parameter subscriber"
    _factory = "subscribe_param"

    def __init__(
        self, context: Context, followed: FollowedParam, default: Any, keeps_updates: bool
    ) -> None:
        super().__init__(context, followed.name)
        self._followed = followed
        self._default = default
        self._keeps_updates = keeps_updates
        self._updates: deque[tuple[ParamUpdate, int]] = deque()  # with their weights
        self._weight = 0
        self._arrived = Waiters()

    @property
    def value(self) -> Any:
        """A copy of the current value. Never asks the master.

        Raises :class:`KeyError` when the parameter is not set and there is no default.
        An empty dict counts as not set, because ROS 1 announces both in the same way.
        """
        value = self._followed.value
        if isinstance(value, dict) and not value:
            if self._default is ...:
                raise KeyError(self.name)
            return copy.deepcopy(self._default)
        return copy.deepcopy(value)

    def __aiter__(self) -> Self:
        self._context.check_iterator()
        return self

    async def __anext__(self) -> ParamUpdate:
        """The next update since the subscriber was opened."""
        while not self._updates:
            if not self._is_open:
                raise StopAsyncIteration
            await self._arrived.wait()
        return self._pop()

    async def wait_for(
        self, predicate: Callable[[Any], object], *, timeout: float | None = None
    ) -> Any:
        """Wait until ``predicate(value)`` is true, and return that value.

        The predicate is not called while the parameter is not set and has no default. Raises
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

    def _begin(self) -> None:
        """Drop the updates from before the subscriber was handed out: its value has them."""
        self._clear()

    def _put(self, update: ParamUpdate) -> None:
        self.stats.messages += 1
        if self._keeps_updates:
            added = weight(update.value)
            self._updates.append((update, added))
            self._weight += added
            # Most only look at the value, so what waits must not fill the memory.
            while len(self._updates) > _MAX_UPDATES or (
                self._weight > _MAX_WEIGHT and len(self._updates) > 1
            ):
                if not self.stats.dropped:
                    self._context.log.warning(
                        "parameter subscriber %s: an update was dropped, because %s wait to be "
                        "taken. `value` is right all the same. Further drops are only counted, in "
                        "`stats`",
                        *(self.name, len(self._updates)),
                    )
                self._pop()
                self.stats.dropped += 1
        self._arrived.wake()

    def _pop(self) -> ParamUpdate:
        update, removed = self._updates.popleft()
        self._weight -= removed
        return update

    def _clear(self) -> None:
        self._updates.clear()
        self._weight = 0

    def _abort(self) -> None:
        super()._abort()
        self._arrived.wake()

    async def _close(self) -> None:
        self._clear()
        self._arrived.wake()
        await self._followed.leave(self)
