"""Parameters that are read often, without asking the master each time."""

from __future__ import annotations

from typing import Any, Protocol

from aioros1.params.subscriber import ParamSubscriber

__all__ = ["ParamCache"]

_MAX_KEYS = 256
"""Keys that are followed at a time. The one that was not asked for longest makes room."""


class _Subscribe(Protocol):
    async def __call__(
        self, key: str, default: Any, *, keeps_updates: bool = True
    ) -> ParamSubscriber: ...


class ParamCache:
    """Follows each parameter from the first time it is asked for. Keeps its value only."""

    def __init__(self, subscribe: _Subscribe) -> None:
        self._subscribe = subscribe
        self._followed: dict[str, ParamSubscriber] = {}  # the one asked for last comes last

    async def get(self, key: str, default: Any) -> Any:
        """Return the value of ``key``, which is resolved. Raises as
        :meth:`aioros1.Node.get_param` does."""
        subscriber = self._followed.pop(key, None)
        surplus = None
        if subscriber is None or not subscriber.is_open:
            subscriber = await self._subscribe(key, ..., keeps_updates=False)
            # Another task may have done the same in the meantime.
            other = self._followed.pop(key, None)
            if other is not None and other.is_open:
                subscriber, surplus = other, subscriber
            elif len(self._followed) >= _MAX_KEYS:
                surplus = self._followed.pop(next(iter(self._followed)))
        # Before anything is waited for: what is followed and not here is followed for ever.
        self._followed[key] = subscriber
        if surplus is not None:
            await surplus.close()
        try:
            return subscriber.value
        except KeyError:
            if default is ...:
                raise
            return default
