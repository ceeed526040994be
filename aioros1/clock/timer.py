"""Having a function called again and again."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from typing import TYPE_CHECKING, Any

from aioros1.clock.clock import to_nanoseconds
from aioros1.clock.rate import Rate
from aioros1.time import Duration, Time

if TYPE_CHECKING:
    from aioros1.node import Node

__all__ = ["Timer"]


class Timer:
    """Calls a function again and again; made by :meth:`Node.timer`."""

    def __init__(
        self,
        node: Node,
        period: float | Duration,
        callback: Callable[[Time], Any] | Callable[[Time], Awaitable[Any]],
        *,
        oneshot: bool,
    ) -> None:
        if not callable(callback):
            raise TypeError(f"a timer calls a function, got {callback!r}")
        nanoseconds = to_nanoseconds(period)
        if not nanoseconds > 0:
            raise ValueError(f"the period of a timer must be positive, got {period!r}")
        self._node = node
        self._rate = Rate(node._clock, nanoseconds)
        self._callback = callback
        self._oneshot = oneshot
        self._task = node._spawn(self._run, name=f"{node.name} timer")

    def cancel(self) -> None:
        """Call the function no more; a call that runs is cancelled."""
        self._task.cancel()

    async def _run(self) -> None:
        async for now in self._rate:
            try:
                result = self._callback(now)
                if asyncio.iscoroutine(result) or asyncio.isfuture(result):
                    await result
            except Exception as error:  # the user's code; what becomes of it is an option
                self._node._user_error(error, "the callback of a timer")
            if self._oneshot:
                return
