"""Following a parameter."""

from __future__ import annotations

import copy
from collections import deque
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Self

from aioros1._public import public
from aioros1.core.role import Role
from aioros1.events import ParamUpdate
from aioros1.waiting import Waiters

if TYPE_CHECKING:
    from aioros1.core.context import Context
    from aioros1.params.followed import FollowedParam

__all__ = ["ParamSubscriber"]


@public
class ParamSubscriber(Role):
    """Follows a parameter and everything below it; made by
    :meth:`aioros1.Node.subscribe_param`."""

    kind = "parameter subscriber"

    def __init__(self, context: Context, followed: FollowedParam, default: Any) -> None:
        super().__init__(context, followed.name)
        self._followed = followed
        self._default = default
        self._updates: deque[ParamUpdate] = deque(maxlen=1000)
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
        return self._updates.popleft()

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
        self._updates.clear()

    def _put(self, update: ParamUpdate) -> None:
        if len(self._updates) == self._updates.maxlen:
            if not self.stats.dropped:
                self._context.log.warning(
                    "parameter subscriber %s: an update was dropped, because %s wait to be taken. "
                    "`value` is right all the same. Further drops are only counted, in `stats`",
                    *(self.name, self._updates.maxlen),
                )
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
        await self._followed.leave(self)
