"""What the rest of the graph sees once per name, however many roles use it.

Roles are the handles a program uses. They are cheap, and many may have the same name. All
roles of one name share one object: a publication, a subscription, a provided service or a
followed parameter. That object owns the connections and the registration at the master.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any, ClassVar, Generic, TypeVar

from aioros1.core.context import Context
from aioros1.options import WithoutMaster

__all__ = ["Shared"]

R = TypeVar("R")


class Shared(ABC, Generic[R]):
    """One name in ``table``, from the first role that acquires it to the last that leaves.

    A new object replaces an older one of the same name whose roles are closing. The two share
    their registration at the master.
    """

    kind: ClassVar[str]
    """Its kind in the events of a node."""

    def __init__(self, context: Context, name: str, table: dict[str, Any]) -> None:
        self.name = name
        self.roles: tuple[R, ...] = ()
        """The roles that use it, in the order they acquired it."""
        self._context = context
        self._table = table
        self.was_deferred = False
        """Whether a role was opened without a master."""
        table[name] = self
        self.registration = context.registrations.entry(
            self.kind, name, self._register, self._unregister
        )

    async def acquire(self, role: R, without_master: WithoutMaster = "raise") -> None:
        """Add ``role``; return when the master has accepted the registration, or when
        ``without_master`` says so.

        Raises the master's error, :class:`~aioros1.MasterUnreachable` and
        :class:`~aioros1.ClosedError`; the role is not added then.
        """
        # Peers may connect as soon as the master has registered us, before it answers us.
        self._join(role)
        try:
            await self._acquire(without_master)
        except BaseException:
            self._part(role)
            if not self.roles:
                self.abort()  # a peer may have connected already
            self._leave_table()
            raise

    async def _acquire(self, without_master: WithoutMaster) -> None:
        registration, contact = self.registration, self._context.contact
        if without_master == "wait":
            await contact.reach(registration.acquire)
        elif without_master == "later" and contact.obstacle:
            # It was missed a moment ago: a back end that opens many roles does not wait for
            # each of them. The heartbeat notices when it is back.
            registration.defer()
            self.was_deferred = True
        elif not await registration.acquire(may_defer=without_master == "later"):
            self.was_deferred = True
            contact.deferred()

    async def leave(self, role: R) -> None:
        """Remove ``role``; after the last one, unregister from the master."""
        self._part(role)
        if not self.roles:
            await self._let_go()
        try:
            await self.registration.release()
        except Exception as error:  # whatever it is, the rest must be freed
            self._context.log.debug("%s %s cannot be unregistered: %s", self.kind, self.name, error)
        self._leave_table()
        if not self.roles:
            await self._disconnect()

    @abstractmethod
    def abort(self) -> None:
        """Drop every connection at once."""

    def _join(self, role: R) -> None:
        self.roles += (role,)

    def _part(self, role: R) -> None:
        self.roles = tuple(each for each in self.roles if each is not role)

    async def _let_go(self) -> None:
        """Clean up after the last role has left, before the master is told."""

    async def _disconnect(self) -> None:
        """Clean up after the last role has left and the master was told."""

    @abstractmethod
    async def _register(self) -> None:
        """Register it at the master."""

    @abstractmethod
    async def _unregister(self) -> None:
        """Unregister it from the master."""

    def _leave_table(self) -> None:
        is_used = self.roles or self.registration.users
        if not is_used and self._table.get(self.name) is self:
            del self._table[self.name]
