"""One registration of a node at the master, shared by the roles that need it.

A master may be slow, and most serve each connection in its own thread. A master may therefore
process an abandoned registration after the request that unregisters it, and keep a ghost.
To prevent this, requests about one entry are sent one after another: each waits until the
previous one is answered or its connection is gone. A task of the node sends them, without a
timeout. Callers wait as long as they like and may be cancelled; the request continues.
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
    """Settings and state that the entries of one node share."""

    node_name: str
    master_uri: str
    patience: float
    """How long a caller waits for the master, in seconds."""
    slots: asyncio.Semaphore
    """Each request acquires it, which limits how many are sent at a time."""
    supervisor: Supervisor
    emit: Callable[[Event], None]
    table: dict[tuple[str, str], Registration] = field(default_factory=dict)
    """By kind and name, the entries that have users or that the master must still be told of."""


class Registration:
    """Keeps an entry registered while it has users, even if the master forgets it.

    Made by :meth:`.Registrations.entry`. ``register`` and ``unregister`` call the master.
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
        self._is_at_master: bool | None = False  # None: unknown
        self._is_established = False  # registered, and not given up since
        self._is_outdated = False  # ignore the result of the request in progress
        self._has_ended = False
        self._is_withdrawn = False
        self._work: asyncio.Future[tuple[bool, Exception | None]] | None = None

    @property
    def is_behind(self) -> bool:
        """Whether the master is out of date and no request to it is in progress."""
        return self._work is None and self._is_at_master is not self._is_wanted

    @property
    def is_established(self) -> bool:
        """Whether the master has accepted the registration."""
        return self._is_established

    @property
    def _is_wanted(self) -> bool:
        return self.users > 0 and not (self._has_ended or self._is_withdrawn)

    def adopt(self, register: Tell, unregister: Tell) -> None:
        """Hand the entry to a new owner of the same name, which is registered from now on."""
        self._register = register
        self._unregister = unregister
        self._is_established = False
        self.forget()

    async def acquire(self, *, may_defer: bool = False) -> bool:
        """Add a user; return when the master has accepted the registration.

        With ``may_defer``, and without an answer of the master, the user stays: the heartbeat
        registers the entry when a master is there. Returns False then, otherwise True.

        Raises the master's error, and :class:`~aioros1.MasterUnreachable` when the answer
        takes longer than ``timeouts.xmlrpc``. After an error or a cancellation, nothing stays
        registered that was not registered before. A cancelled call waits for that, but no
        longer than for any request, and not if it is cancelled again. The node waits for it
        when it closes.
        """
        self.users += 1
        self._terms.table[self.kind, self.name] = self
        try:
            if self.users == 1 or not self._is_established:
                await self._settle(True)
            return True
        except BaseException as error:
            if may_defer and isinstance(error, MasterUnreachable):
                return False
            self.users -= 1
            if not self.users:
                await self._take_back(isinstance(error, asyncio.CancelledError))
            raise

    def defer(self) -> None:
        """Add a user, and leave it to the heartbeat to tell the master."""
        self.users += 1
        self._terms.table[self.kind, self.name] = self

    async def release(self) -> None:
        """Remove a user; unregister after the last one. Raises :class:`~aioros1.MasterError` if
        the master could not be told, which is retried when it is back."""
        self.users -= 1
        await self._settle(False)

    async def withdraw(self) -> None:
        """Unregister until :meth:`renew`. Raises as :meth:`release` does."""
        self._is_withdrawn = True
        await self._settle(False)

    async def renew(self) -> None:
        """Register again, if there are users. Raises as :meth:`acquire` does."""
        self._is_withdrawn = False
        self.forget()
        await self.settle()

    async def settle(self) -> None:
        """Bring the master up to date. Raises as :meth:`acquire` does."""
        await self._settle(self._is_wanted)

    async def end(self) -> None:
        """Unregister for good, even if there are users. Raises as :meth:`release` does."""
        self._has_ended = True
        await self._settle(False)

    def forget(self) -> None:
        """Assume that the master may have forgotten the entry."""
        if self._work is not None:
            self._is_outdated = True
        elif self._is_at_master:
            self._is_at_master = None

    async def _settle(self, wanted: bool) -> None:
        """Wait until the master has been told, unless another caller wants the opposite."""
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
                # Without the way it came, through a task that the caller does not know.
                raise failure.with_traceback(None) from None

    async def _take_back(self, waits: bool) -> None:
        if self._work is None and not self.is_behind:
            self._leave_if_idle()
            return
        with contextlib.suppress(ClosedError):  # too late: every connection is closed
            work = self._begin()
            if waits:
                await asyncio.wait({work}, timeout=self._terms.patience)

    def _begin(self) -> asyncio.Future[tuple[bool, Exception | None]]:
        """Start to tell the master unless that is in progress; return the future to wait for.

        Raises :class:`~aioros1.ClosedError` when it is too late.
        """
        if self._work is None:
            work = asyncio.get_running_loop().create_future()
            task = self._terms.supervisor.spawn(
                self._tell_all, work, name=f"{self._terms.node_name} tells of {self.name}"
            )
            # Not inside the task, which may be cancelled before it begins.
            task.add_done_callback(lambda _: self._work_ended(work))
            self._work = work
        return self._work

    async def _tell_all(self, work: asyncio.Future[tuple[bool, Exception | None]]) -> None:
        """Send requests until the master is up to date or a request fails."""
        wanted, failure = self._is_wanted, None
        # Repeat an outdated request even if it still says what is wanted.
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
        """Send one request; return the error if it fails."""
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
            if not error.was_sent:
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
