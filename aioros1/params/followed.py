"""A parameter that a node follows, as registered at the master."""

from __future__ import annotations

import asyncio
import copy
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Protocol

from aioros1.core.shared import Shared
from aioros1.errors import MasterError
from aioros1.events import ParamUpdate
from aioros1.params.rereading import Rereading
from aioros1.params.tree import dig, graft, is_below, path_to, same

if TYPE_CHECKING:
    from aioros1.core.context import Context

__all__ = ["FollowedParam"]

_IN_DOUBT = 5.0
"""Seconds after a change of one's own in which notices may be older than that change. A
rosmaster sends them 25 to 80 ms late, and later if some other node does not respond. One that
comes later still is put right when the value is next read."""


_Change = tuple[str, Any]


_MAX_SAID = 1000
"""Keys that are remembered until the value is read; more of them are one change of it all."""


_MOST_OTHERS = 8
"""Readings after which a value counts even if others are announced all the time."""


class Following(Protocol):
    """What a followed parameter needs of a subscriber."""

    def _put(self, update: ParamUpdate) -> None:
        """Hand over an update."""


class FollowedParam(Shared[Following]):
    """A parameter that a node follows, for all its subscribers.

    The master announces the key that was set, which may be the followed key or one below
    it. When a key above was set, the master announces the followed key with its part of the
    value. ``{}`` stands for a parameter that is not set.

    Notices come in the order of the changes, but late, and none come of the node's own
    changes. So a notice says what holds only while the node itself changes nothing. Otherwise
    it says only where to look, and the value is read. It is also read some time after every
    notice and every change, so that the last value is right whatever was lost or overtaken.
    If it is another then, and nothing is announced until it is read once more, it counts.
    """

    kind = "parameter"

    def __init__(self, context: Context, key: str, table: dict[str, FollowedParam]) -> None:
        super().__init__(context, key, table)
        self.value: Any = {}
        """The value now, with everything below it."""
        self._rereading = Rereading(context, key, self._read, table)
        self._own = 0  # changes by this node that the master has not answered
        self._own_overlap = False
        self._doubtful_until = float("-inf")
        self._said: dict[str, None] = {}  # keys of notices that were not believed
        self._believed = 0  # notices
        # Readings in a row that another value came of, and the notices believed before the last.
        self._others = 0
        self._others_since = 0
        # For each reading in progress, what this node has set since it began.
        self._meanwhile: list[list[_Change]] = []

    def concerns(self, key: str) -> bool:
        """Whether setting ``key``, the followed key or one above or below, changes this."""
        return key == self.name or is_below(key, self.name) or is_below(self.name, key)

    def keep_true(self) -> None:
        """Begin to read the value now and then."""
        self._rereading.begin()

    def abort(self) -> None:
        """Do nothing: there are no connections."""

    # what the master announces

    def announced(self, key: str, value: Any) -> None:
        """The master says that ``key``, which :meth:`concerns` this, was set to ``value``."""
        if self._is_in_doubt:
            self._said[key if is_below(key, self.name) else self.name] = None
            if len(self._said) > _MAX_SAID:
                self._said = {self.name: None}
            self._rereading.soon()
        else:
            self._believed += 1
            self._apply(key, value)
            self._rereading.later()

    @property
    def _is_in_doubt(self) -> bool:
        """Whether a notice may be older than the value."""
        return (
            self._own > 0
            or not self.registration.is_established
            or asyncio.get_running_loop().time() < self._doubtful_until
        )

    def _doubt_notices(self) -> None:
        self._doubtful_until = asyncio.get_running_loop().time() + _IN_DOUBT

    # changes by this node

    def change_begins(self) -> None:
        """This node is about to change a key that concerns this."""
        self._own += 1
        self._own_overlap |= self._own > 1

    def change_ends(self) -> None:
        """The master has answered a change, or cannot be asked."""
        self._own -= 1
        self._doubt_notices()
        if not self._own and self._own_overlap:
            self._own_overlap = False
            self._rereading.soon()  # in which order the master made the changes is unknown
        else:
            self._rereading.later()

    def changed(self, key: str, value: Any) -> None:
        """This node has set ``key`` to ``value``; the master does not announce it."""
        for changes in self._meanwhile:
            changes.append((key, value))
        self._apply(key, value)

    def doubt(self) -> None:
        """Read the value as soon as possible: it may have changed."""
        self._doubt_notices()
        self._rereading.soon()

    # the value

    def _apply(self, key: str, value: Any) -> None:
        """Apply that ``key`` was set to ``value``, and tell subscribers."""
        key, value = self._for_this(key, value)
        path = path_to(key, self.name)
        if value == {} and dig(self.value, path) == {}:
            return  # already unset: the master also tells the node that deleted it
        self.value = graft(self.value, path, value)
        self._tell(key, value)

    def _tell(self, key: str, value: Any) -> None:
        for subscriber in self.roles:
            subscriber._put(ParamUpdate(key, copy.deepcopy(value)))
        self._context.emit(ParamUpdate(key, copy.deepcopy(value)))

    def _for_this(self, key: str, value: Any) -> tuple[str, Any]:
        if is_below(self.name, key):
            return self.name, dig(value, path_to(self.name, key))
        return key, value

    # reading it

    async def _read(self) -> bool:
        """Read the value at the master; return whether it was another than the one known.

        Raises :class:`~aioros1.MasterError`, and :class:`~aioros1.ClosedError`.
        """
        is_in_doubt = self._is_in_doubt or bool(self._said)
        said, self._said = self._said, {}
        believed = self._believed
        with self._recording() as own:
            try:
                value = await self._context.master.get_param(self.name)
            except BaseException as error:
                if not isinstance(error, MasterError) or not error.is_refusal:
                    self._said = said | self._said
                    raise
                value = {}  # it is not set
        if believed != self._believed:  # those notices may be newer than what was read
            self._said = said | self._said
            is_other = True
        elif not is_in_doubt and self._is_premature(value):
            is_other = True
        else:
            is_other = self._found(value, said, own)
        if self._said or own:
            self._rereading.soon()
        return is_other

    def _is_premature(self, value: Any) -> bool:
        """Whether ``value`` is another that will perhaps be announced in a moment.

        Taken over now, it would be followed by older ones that are still to be announced.
        """
        if same(value, self.value):
            self._others = 0
            return False
        is_quiet = self._others > 0 and self._others_since == self._believed
        self._others += 1
        self._others_since = self._believed
        if not is_quiet and self._others < _MOST_OTHERS:
            return True
        self._others = 0
        return False

    @contextmanager
    def _recording(self) -> Iterator[list[_Change]]:
        """Record the changes of this node, whose order with a reading is unknown."""
        changes: list[_Change] = []
        self._meanwhile.append(changes)
        try:
            yield changes
        finally:
            self._meanwhile = [each for each in self._meanwhile if each is not changes]

    def _found(self, value: Any, said: Iterable[str], own: Iterable[_Change]) -> bool:
        """Take over a value that was read, and the ``own`` changes since. Updates are told for
        the keys that were ``said`` to have changed, as far as they have, and for the rest."""
        for changed, new in own:
            key, part = self._for_this(changed, new)
            value = graft(value, path_to(key, self.name), part)
        is_other = False
        for key in said:
            path = path_to(key, self.name)
            part = dig(value, path)
            if not same(part, dig(self.value, path)):
                is_other = True
                self.value = graft(self.value, path, part)
                self._tell(key, part)
        is_all, self.value = same(value, self.value), value
        if not is_all:
            self._tell(self.name, value)
            # Nobody said so, and who says so now is late. If the master no longer knows that we
            # follow it, tell it again.
            self._doubt_notices()
            self.registration.confirm()
        return is_other or not is_all

    # at the master

    async def _register(self) -> None:
        context = self._context
        was_followed = self.registration.is_established
        believed = self._believed
        with self._recording() as own:
            value = await context.registrar.subscribe_param(self.name, context.address.uri)
        if not (was_followed or self.was_deferred):
            self.value = value  # that is no update
        self.was_deferred = False
        if believed == self._believed:
            self._found(value, (), own)  # it may have changed while the master was away
        if own or believed != self._believed:
            self._rereading.soon()

    async def _unregister(self) -> None:
        context = self._context
        await context.registrar.unsubscribe_param(self.name, context.address.uri)

    async def _let_go(self) -> None:
        self._rereading.end()
