"""A parameter that a node follows, as registered at the master."""

from __future__ import annotations

import copy
from typing import TYPE_CHECKING, Any, Protocol

from aioros1.core.shared import Shared
from aioros1.events import ParamUpdate
from aioros1.params.tree import dig, graft, is_below, path_to

if TYPE_CHECKING:
    from aioros1.core.context import Context

__all__ = ["FollowedParam"]


class Following(Protocol):
    """What a followed parameter needs of a subscriber."""

    def _put(self, update: ParamUpdate) -> None:
        """Hand over an update."""


class FollowedParam(Shared[Following]):
    """A parameter that a node follows, for all its subscribers.

    The master announces the key that was set, which may be the followed key or one below
    it. When a key above was set, the master announces the followed key with its part of the
    value. ``{}`` stands for a parameter that is not set.
    """

    kind = "parameter"

    def __init__(self, context: Context, key: str, table: dict[str, FollowedParam]) -> None:
        super().__init__(context, key, table)
        self.value: Any = {}
        """The value now, with everything below it."""
        self._updates = 0

    def concerns(self, key: str) -> bool:
        """Whether setting ``key``, the followed key or one above or below, changes this."""
        return key == self.name or is_below(key, self.name) or is_below(self.name, key)

    def update(self, key: str, value: Any) -> None:
        """Apply that ``key``, the followed key or one above or below, was set to ``value``."""
        self._updates += 1
        if self.name != key and is_below(self.name, key):
            value = dig(value, path_to(self.name, key))
            key = self.name
        path = [] if key == self.name else path_to(key, self.name)
        if value == {} and dig(self.value, path) == {}:
            return  # already unset: the master also tells the node that deleted it
        self.value = graft(self.value, path, value) if path else value
        for subscriber in self.roles:
            subscriber._put(ParamUpdate(key, copy.deepcopy(value)))
        self._context.emit(ParamUpdate(key, copy.deepcopy(value)))

    def abort(self) -> None:
        """Do nothing: there are no connections."""

    # at the master

    async def _register(self) -> None:
        context = self._context
        updates = self._updates
        was_followed = self.registration.is_established
        value = await context.registrar.subscribe_param(self.name, context.address.uri)
        if updates == self._updates and value != self.value:
            if was_followed or self.was_deferred:
                self.update(self.name, value)  # it changed while the master was away
            else:
                self.value = value
        self.was_deferred = False

    async def _unregister(self) -> None:
        context = self._context
        await context.registrar.unsubscribe_param(self.name, context.address.uri)
