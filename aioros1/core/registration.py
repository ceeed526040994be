"""One entry of a node at the master, shared by the roles that need it.

A master may be slow, and most serve every connection in a thread of its own. So it may obey
a registration that nobody waits for any more after the request that takes it back, and keep
a ghost. Therefore requests about one entry go one after the other: the next is sent when the
last was answered, or when its connection is gone. They go in a task of the node, without a
limit of time. Those who want something of it wait for as long as they like, and may be
cancelled; that is no reason to hang up.
"""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import Awaitable, Callable
from dataclasses import dataclass, field

from aioros1.core.supervisor import Supervisor
from aioros1.errors import ClosedError, MasterError, MasterUnreachable
from aioros1.events import Event, RoleRegistered, RoleUnregistered

__all__ = ["Registration", "Tell", "Terms"]

Tell = Callable[[], Awaitable[object]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Terms:
    """What the entries of one node have in common."""

    node_name: str
    master_uri: str
    patience: float
    """Seconds that somebody waits for the master."""
    slots: asyncio.Semaphore
    """What each request gets hold of: not all of them are sent at a time."""
    supervisor: Supervisor
    emit: Callable[[Event], None]
    table: dict[tuple[str, str], Registration] = field(default_factory=dict)
    """By kind and name, those that have users, or of which the master is yet to hear."""


class Registration:
    """Registered while it has users, and again whenever the master has forgotten.

    Made by :meth:`.Registrations.entry`. ``register`` and ``unregister`` talk to the master.
    """

    def __init__(
        self, terms: Terms, kind: str, name: str, register: Tell, unregister: Tell
    ) -> None:
        self.kind = kind
        self.name = name
        self.users = 0
        self._terms = terms
        self._register = register
        self._unregister = unregister
        self._is_at_master: bool | None = False  # None: it may be, or not
        self._is_established = False  # registered, and not given up since
        self._is_outdated = False  # what the request in progress says will not count
        self._has_ended = False
        self._is_withdrawn = False
        self._work: asyncio.Future[tuple[bool, Exception | None]] | None = None

    @property
    def is_behind(self) -> bool:
        """Whether the master does not know what it should, and nothing is on its way to it."""
        return self._work is None and self._is_at_master is not self._is_wanted

    @property
    def is_established(self) -> bool:
        """Whether the master has accepted it."""
        return self._is_established

    @property
    def _is_wanted(self) -> bool:
        return self.users > 0 and not (self._has_ended or self._is_withdrawn)

    def adopt(self, register: Tell, unregister: Tell) -> None:
        """Somebody else of the same name: from now on the master is told so."""
        self._register = register
        self._unregister = unregister
        self._is_established = False
        self.forget()

    async def acquire(self) -> None:
        """One user more; returns when the master has accepted.

        Raises what the master answers, and :class:`~aioros1.MasterUnreachable` when that
        takes longer than ``timeouts.xmlrpc``. Then, and when it is cancelled, nothing stays
        registered that was not before; whoever cancels waits for that, but not longer than
        for any request, and not if he cancels again. The node waits for it when it closes.
        """
        self.users += 1
        self._terms.table[self.kind, self.name] = self
        try:
            if self.users == 1 or not self._is_established:
                await self._settle(True)
        except BaseException as error:
            self.users -= 1
            if not self.users:
                await self._take_back(isinstance(error, asyncio.CancelledError))
            raise

    async def release(self) -> None:
        """One user less. Raises :class:`~aioros1.MasterError` if the last one's
        leaving could not be told to the master; that is tried again when it is back."""
        self.users -= 1
        await self._settle(False)

    async def withdraw(self) -> None:
        """Take it back until it is renewed. Raises as :meth:`release` does."""
        self._is_withdrawn = True
        await self._settle(False)

    async def renew(self) -> None:
        """Tell the master again, if there are users. Raises as :meth:`acquire` does."""
        self._is_withdrawn = False
        self.forget()
        await self.settle()

    async def settle(self) -> None:
        """Tell the master what it could not be told before. Raises as :meth:`acquire`."""
        await self._settle(self._is_wanted)

    async def end(self) -> None:
        """Take it back, whoever wants it or waits for it. Raises as :meth:`release`."""
        self._has_ended = True
        await self._settle(False)

    def forget(self) -> None:
        """What the master was told does not count any more."""
        if self._work is not None:
            self._is_outdated = True
        elif self._is_at_master:
            self._is_at_master = None

    async def _settle(self, wanted: bool) -> None:
        """Wait until the master has been told, unless somebody else wants the opposite."""
        patience = self._terms.patience
        loop = asyncio.get_running_loop()
        end = loop.time() + patience
        while self._is_at_master is not wanted or self._is_outdated:
            if self._has_ended and wanted:
                raise self._closed()
            if self._is_wanted is not wanted:
                return
            work = self._begin()
            done, _ = await asyncio.wait({work}, timeout=end - loop.time())
            if not done:
                raise MasterUnreachable(
                    f"{self.kind} {self.name}: no answer of the master at "
                    f"{self._terms.master_uri} within {patience:g} s"
                )
            about, failure = work.result()
            if failure is not None and about is wanted:
                raise failure

    async def _take_back(self, waits: bool) -> None:
        if self._work is None and not self.is_behind:
            self._leave_if_idle()
            return
        with contextlib.suppress(ClosedError):  # too late: all connections are closed
            work = self._begin()
            if waits:
                await asyncio.wait({work}, timeout=self._terms.patience)

    def _begin(self) -> asyncio.Future[tuple[bool, Exception | None]]:
        """Tell the master, if nobody does so already; what is to be waited for then.

        Raises :class:`~aioros1.ClosedError` when it is too late for that.
        """
        if self._work is None:
            work = asyncio.get_running_loop().create_future()
            task = self._terms.supervisor.spawn(
                self._tell_all, work, name=f"{self._terms.node_name} tells of {self.name}"
            )
            # Not in the task, which may be cancelled before it begins.
            task.add_done_callback(lambda _: self._work_ended(work))
            self._work = work
        return self._work

    async def _tell_all(self, work: asyncio.Future[tuple[bool, Exception | None]]) -> None:
        """Tell the master until it knows what it should, or something fails."""
        wanted, failure = self._is_wanted, None
        # What is outdated is told again, even if it is still wanted as it was told.
        while failure is None and (
            self._is_at_master is not (wanted := self._is_wanted) or self._is_outdated
        ):
            failure = await self._tell(wanted)
        self._work = None
        work.set_result((wanted, failure))
        self._leave_if_idle()

    def _work_ended(self, work: asyncio.Future[tuple[bool, Exception | None]]) -> None:
        if not work.done():  # the node has ended
            self._work = None
            work.set_result((self._is_wanted, self._closed()))

    def _closed(self) -> ClosedError:
        reason = self._terms.supervisor.reason
        why = f" ({reason})" if reason is not None else ""
        return ClosedError(f"node {self._terms.node_name} is closing, not open{why}")

    async def _tell(self, wanted: bool) -> Exception | None:
        """One request; gives what came in the way."""
        terms, before = self._terms, self._is_at_master
        was_established = self._is_established
        self._is_established = was_established and wanted
        self._is_at_master, self._is_outdated = None, False
        failure: Exception | None = None
        try:
            async with terms.slots:
                await (self._register() if wanted else self._unregister())
            self._is_at_master = wanted
        except MasterUnreachable as error:
            failure = error
            if type(error.__cause__) is ConnectionError:  # nobody was there to hear it
                self._is_at_master = before
        except MasterError as error:
            failure = error
            self._is_at_master = False
        except Exception as error:
            failure = error
        if self._is_outdated:
            self._is_outdated = False
            self._is_at_master = None if self._is_at_master else self._is_at_master
        elif wanted and failure is None:
            self._is_established = True
            terms.emit(RoleRegistered(self.kind, self.name))
        if was_established and not wanted:
            terms.emit(RoleUnregistered(self.kind, self.name))
        return failure

    def _leave_if_idle(self) -> None:
        if not (self.users or self.is_behind or self._work):
            self._terms.table.pop((self.kind, self.name), None)
