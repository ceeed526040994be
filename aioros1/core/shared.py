"""What the rest of the graph sees once for each name, whatever number of roles use it.

Roles are what a program holds in its hands. They are cheap, and there may be many of one
name. Behind those of one name stands one object: a publication, a subscription, a provided
service, a followed parameter. It has the connections, and its entry at the master.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any, ClassVar, Generic, TypeVar

from aioros1.core.context import Context
from aioros1.errors import ClosedError, MasterError

__all__ = ["Shared"]

R = TypeVar("R")


class Shared(ABC, Generic[R]):
    """One name in ``table``, from the first role that acquires it to the last that leaves.

    A new one takes the place of an older one of the same name, whose roles are being closed.
    The two share their entry at the master.
    """

    kind: ClassVar[str]
    """What the events of a node call it."""

    def __init__(self, context: Context, name: str, table: dict[str, Any]) -> None:
        self.name = name
        self.roles: tuple[R, ...] = ()
        """The roles that use it, in the order in which they came."""
        self._context = context
        self._table = table
        table[name] = self
        self.registration = context.registrations.entry(
            self.kind, name, self._register, self._unregister
        )

    async def acquire(self, role: R) -> None:
        """Let ``role`` use it; return when the master has accepted.

        Raises what the master answers, :class:`~aioros1.MasterUnreachable` and
        :class:`~aioros1.ClosedError`; the role does not use it then.
        """
        # Peers may come as soon as the master knows, before we know that it does.
        self._join(role)
        try:
            await self.registration.acquire()
        except BaseException:
            self._part(role)
            if not self.roles:
                self.abort()  # somebody may have connected already
            self._leave_table()
            raise

    async def leave(self, role: R) -> None:
        """``role`` uses it no more; the last one takes it back from the master."""
        self._part(role)
        if not self.roles:
            await self._let_go()
        try:
            await self.registration.release()
        except (MasterError, ClosedError) as error:
            self._context.log.debug("%s %s cannot be unregistered: %s", self.kind, self.name, error)
        self._leave_table()
        if not self.roles:
            await self._disconnect()

    @abstractmethod
    def abort(self) -> None:
        """Drop all connections at once."""

    def _join(self, role: R) -> None:
        self.roles += (role,)

    def _part(self, role: R) -> None:
        self.roles = tuple(each for each in self.roles if each is not role)

    async def _let_go(self) -> None:
        """Nobody uses it, and the master does not know yet."""

    async def _disconnect(self) -> None:
        """Nobody uses it, and the master knows."""

    @abstractmethod
    async def _register(self) -> None:
        """Tell the master of it."""

    @abstractmethod
    async def _unregister(self) -> None:
        """Tell the master that it is no more."""

    def _leave_table(self) -> None:
        is_used = self.roles or self.registration.users
        if not is_used and self._table.get(self.name) is self:
            del self._table[self.name]
