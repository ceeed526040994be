"""One registration of a node at the master, shared by the roles that need it.

A master may be slow, and most serve each connection in its own thread. A master may therefore
process an abandoned registration after the request that unregisters it, and keep a ghost.
To prevent this, requests about one entry are sent one after another, by a task of the node.
Callers wait as long as they like and may be cancelled; the request continues.

A request that is not answered at all must not block the entry for ever. After a while it
becomes a straggler: it keeps its connection and nothing waits for it, so the next request can
be sent. When it is answered after all, the master is told once more what is wanted.
"""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import Awaitable, Callable
from dataclasses import dataclass, field

from aioros1.core.supervisor import Supervisor
from aioros1.core.time_taken import TimeTaken
from aioros1.errors import ClosedError, MasterError, MasterUnreachable
from aioros1.events import Event, RoleRegistered, RoleUnregistered
from aioros1.waiting import deadline
from aioros1.xmlrpc.client import is_judgement

__all__ = ["Registration", "Tell", "Terms"]

_AT_ONCE = 6
"""Registration requests that are sent at a time, while the master answers promptly."""

_HOLD = 0.05
"""The part of a caller's patience after which a request that waits for its answer no longer
counts in _AT_ONCE: a quarter of a second, unless ``timeouts.xmlrpc`` was changed."""

_STRAGGLERS = 16
"""The most requests of a node whose answer nothing waits for. Each has a connection."""

_MOST_PATIENT = 4
"""How many times longer to wait for the answer when several in a row did not come."""

_LONGEST_REST = 64.0
"""Seconds between two tries of an entry that the master refuses, at most."""

Tell = Callable[[], Awaitable[object]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Terms:
    """Settings and state that the entries of one node share."""

    node_name: str
    master_uri: str
    patience: float
    """How long a caller waits for the master, in seconds."""
    supervisor: Supervisor
    emit: Callable[[Event], None]
    warn: Callable[[str], None]
    """Called with what went wrong when nobody waits for the outcome."""
    on_silence: Callable[[], None]
    """Called when a request was not answered: other connections may be dead as well."""
    slots: asyncio.Semaphore = field(default_factory=lambda: asyncio.Semaphore(_AT_ONCE))
    table: dict[tuple[str, str], Registration] = field(default_factory=dict)
    """By kind and name, the entries that have users or that the master must still be told of."""
    stragglers: dict[asyncio.Task[None], None] = field(default_factory=dict)
    """The requests that nothing waits for, oldest first."""


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
        self.requests = 0
        """How many requests were sent so far."""
        self.suspect_since: float | None = None
        """When a request was given up that the master may still process, by the loop's time."""
        self.told_at = 0.0
        """When the last request was answered, by the loop's time."""
        self.took = TimeTaken()
        """How long requests take."""
        self._terms = terms
        self._register = register
        self._unregister = unregister
        self._is_at_master: bool | None = False  # None: unknown
        self._is_established = False  # registered, and not given up since
        self._is_outdated = False  # ignore the result of the request in progress
        self._is_quiet = False  # registering again is no news
        self._has_ended = False
        self._is_withdrawn = False
        self._work: asyncio.Future[tuple[bool, Exception | None]] | None = None
        self._unanswered = 0  # requests in a row
        self._stragglers = 0
        self._complaint = ""
        self._refusals = 0  # in a row
        self._rests_until = 0.0  # by the loop's time

    @property
    def is_behind(self) -> bool:
        """Whether the master is out of date and no request to it is in progress."""
        return self._work is None and self._is_at_master is not self.is_wanted

    @property
    def is_settled(self) -> bool:
        """Whether the master was told what is wanted, as far as this node knows."""
        return self._work is None and self._is_at_master is self.is_wanted

    @property
    def is_established(self) -> bool:
        """Whether the master has accepted the registration."""
        return self._is_established

    @property
    def is_wanted(self) -> bool:
        """Whether the master should list the entry."""
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
        await self._settle(self.is_wanted)

    async def end(self) -> None:
        """Unregister for good, even if there are users. Raises as :meth:`release` does."""
        self._has_ended = True
        await self._settle(False)

    def push(self) -> None:
        """Bring the master up to date without waiting for it; failures become warnings.

        An entry that the master refuses rests for a while before it is tried again.
        """
        if self.is_behind and asyncio.get_running_loop().time() >= self._rests_until:
            with contextlib.suppress(ClosedError):  # too late: every connection is closed
                self._begin().add_done_callback(self._pushed)

    def confirm(self) -> None:
        """Register once more what is registered, with the next heartbeat, in case the master
        has forgotten it."""
        if self.is_settled and self._is_at_master:
            self._is_at_master = None
            self._is_quiet = True

    def forget(self) -> None:
        """Assume that the master may have forgotten the entry."""
        self._is_quiet = False
        if self._work is not None:
            self._is_outdated = True
        elif self._is_at_master:
            self._is_at_master = None

    def doubt(self) -> None:
        """Assume that the master may list the entry or not, and tell it what is wanted."""
        if self._work is not None:
            self._is_outdated = True
        else:
            self._is_at_master = None
            self._terms.table[self.kind, self.name] = self
            self.push()

    def trust(self) -> None:
        """Note that no request that was given up can still be processed."""
        self.suspect_since = None
        self._leave_if_idle()

    def complain(self, error: BaseException) -> None:
        """Warn of a failure, once until another one or a success."""
        if isinstance(error, MasterUnreachable) and not self._unanswered:
            return  # a master that is lost is so for all; the heartbeat says so
        if self._complaint != (text := str(error)):
            self._complaint = text
            self._terms.warn(f"cannot register {self.kind} {self.name}: {text}")

    async def _settle(self, wanted: bool) -> None:
        """Wait until the master has been told, unless another caller wants the opposite."""
        patience = self._terms.patience
        what = f"{self.kind} {self.name}: no answer of the master at {self._terms.master_uri}"
        joined = self._work  # of an earlier caller, which may be given up at any moment
        try:
            async with deadline(patience, what):
                while self._is_at_master is not wanted or self._is_outdated:
                    if self._has_ended and wanted:
                        raise self._closed()
                    if self.is_wanted is not wanted:
                        return
                    work = self._begin()
                    await asyncio.wait({work})
                    about, failure = work.result()
                    if failure is None or about is not wanted:
                        continue
                    if work is not joined or not self._unanswered:
                        # Without the way it came, through a task that the caller does not know.
                        raise failure.with_traceback(None) from None
        except TimeoutError as error:
            raise MasterUnreachable(str(error)) from None

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

    def _pushed(self, work: asyncio.Future[tuple[bool, Exception | None]]) -> None:
        _, failure = work.result()
        if failure is not None and not isinstance(failure, ClosedError):
            self.complain(failure)

    async def _tell_all(self, work: asyncio.Future[tuple[bool, Exception | None]]) -> None:
        """Send requests until the master is up to date or a request fails."""
        wanted, failure = self.is_wanted, None
        # Repeat an outdated request even if it still says what is wanted.
        while failure is None and (
            self._is_at_master is not (wanted := self.is_wanted) or self._is_outdated
        ):
            failure = await self._tell(wanted)
        self._work = None
        work.set_result((wanted, failure))
        self._leave_if_idle()

    def _work_ended(self, work: asyncio.Future[tuple[bool, Exception | None]]) -> None:
        if not work.done():  # the node has ended
            self._work = None
            work.set_result((self.is_wanted, self._closed()))

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
        failure = await self._send(wanted)
        self._is_at_master = before if _was_not_sent(failure) else _outcome(wanted, failure)
        if failure is None:
            self._complaint = ""
        self._rest(failure)
        if self._is_outdated:
            self._is_outdated = False
            self._is_at_master = None
        elif wanted and failure is None:
            is_news = not (self._is_quiet and was_established)
            self._is_quiet = False
            self._is_established = True
            if is_news:
                terms.emit(RoleRegistered(self.kind, self.name))
        if was_established and not wanted:
            terms.emit(RoleUnregistered(self.kind, self.name))
        return failure

    def _rest(self, failure: Exception | None) -> None:
        """Rest longer and longer while the master, or this side, refuses the entry."""
        if failure is None or isinstance(failure, MasterUnreachable):
            self._refusals = 0
            self._rests_until = 0.0
            return
        rest = min(2.0**self._refusals, _LONGEST_REST)
        self._refusals = min(self._refusals + 1, 10)
        self._rests_until = asyncio.get_running_loop().time() + rest

    async def _send(self, wanted: bool) -> Exception | None:
        """Send one request, and wait for its answer; leave it alone if none comes."""
        terms = self._terms
        patience = terms.patience * min(2**self._unanswered, _MOST_PATIENT)
        hold = _HOLD * terms.patience
        answer: asyncio.Future[Exception | None] = asyncio.get_running_loop().create_future()
        async with terms.slots:
            self.requests += 1
            try:
                task = terms.supervisor.spawn(
                    self._request, answer, wanted, name=f"{terms.node_name} asks for {self.name}"
                )
            except ClosedError as error:
                return error
            task.add_done_callback(lambda _: self._request_ended(answer))
            is_done = await _comes(answer, hold)
        if is_done or await _comes(answer, patience - hold):
            self._unanswered = 0
            return answer.result()
        self._leave_alone(task, wanted)
        return MasterUnreachable(
            f"{self.kind} {self.name}: no answer of the master at {terms.master_uri} "
            f"within {patience:g} s"
        )

    async def _request(self, answer: asyncio.Future[Exception | None], wanted: bool) -> None:
        loop = asyncio.get_running_loop()
        begin = loop.time()
        try:
            await (self._register() if wanted else self._unregister())
            self.told_at = loop.time()
            self.took.add(self.told_at - begin)
        except Exception as error:
            answer.set_result(error)
        else:
            answer.set_result(None)

    def _request_ended(self, answer: asyncio.Future[Exception | None]) -> None:
        if not answer.done():  # the node has ended, or the request was given up
            answer.set_result(self._closed())

    def _leave_alone(self, task: asyncio.Task[None], wanted: bool) -> None:
        """Let a request go on that nothing waits for any longer."""
        stragglers = self._terms.stragglers
        self._unanswered += 1
        self._stragglers += 1
        stragglers[task] = None
        task.add_done_callback(lambda task: self._came_late(task, wanted))
        if len(stragglers) > _STRAGGLERS:
            next(iter(stragglers)).cancel()
        self._terms.on_silence()

    def _came_late(self, task: asyncio.Task[None], wanted: bool) -> None:
        """Tell the master once more if a straggler may have changed what it lists."""
        self._terms.stragglers.pop(task, None)
        self._stragglers -= 1
        if task.cancelled():
            self.suspect_since = task.get_loop().time()
        if wanted is self.is_wanted:
            self.push()
        else:
            self.doubt()
        self._leave_if_idle()

    def _leave_if_idle(self) -> None:
        is_used = self.users or self.is_behind or self._work
        if not (is_used or self._stragglers or self.suspect_since is not None):
            self._terms.table.pop((self.kind, self.name), None)


async def _comes(answer: asyncio.Future[Exception | None], seconds: float) -> bool:
    """Wait for an answer, at most for ``seconds``; return whether it has come."""
    with contextlib.suppress(TimeoutError):
        async with deadline(seconds, "no answer"):
            await asyncio.wait({answer})
    return answer.done()


def _was_not_sent(failure: Exception | None) -> bool:
    """Whether a request never reached a master: nobody listens, or it cannot be encoded."""
    if isinstance(failure, MasterUnreachable):
        return not failure.was_sent
    return isinstance(failure, TypeError | ValueError | OverflowError)


def _outcome(wanted: bool, failure: Exception | None) -> bool | None:
    """Whether the master lists the entry after a request; None if that is unknown."""
    if failure is None:
        return wanted
    # Without a judgement, the answer may be that of a proxy, or be damaged.
    return False if isinstance(failure, MasterError) and is_judgement(failure) else None
