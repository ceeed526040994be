"""Noticing that the master is lost, back or replaced, and that our own address has changed.

Masters forget everything when they exit, and tell nobody. A node that registered only once
would then be missing from the graph, so it checks regularly who the master is, and registers
again when the master has changed. It does the same when its machine has a new address.
"""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import Awaitable, Callable, Iterable

from aioros1.core.context import Context
from aioros1.core.registration import Registration
from aioros1.errors import ClosedError, MasterError, MasterUnreachable
from aioros1.events import MasterLost, MasterRestarted
from aioros1.node.own_address import OwnAddress

__all__ = ["Heartbeat"]


class Heartbeat:
    """Follows the identity of one node's master."""

    def __init__(
        self, context: Context, own_address: OwnAddress, ask_time: Callable[[], Awaitable[None]]
    ) -> None:
        self._context = context
        self._own_address = own_address
        self._ask_time = ask_time  # find out which time the node follows
        self._identity: tuple[int, str] | None = None
        self._is_lost = False
        self._is_stale = False
        self._is_first = False  # the next master to answer is the first of this node
        self._is_stopped = False
        self.refusal: MasterError | None = None
        """The error of :meth:`greet`, if it failed."""

    def stop(self) -> None:
        """Stop registering again."""
        self._is_stopped = True

    @property
    def run_id(self) -> str | None:
        """The master's ``/run_id``; None before the first answer."""
        return None if self._identity is None else self._identity[1]

    async def greet(self) -> bool:
        """Ask once, without acting on the answer; return whether the master is there."""
        try:
            self._identity = await self._ask()
        except MasterError as error:
            self.refusal = error
            return False
        self._context.contact.reached()
        return True

    async def run(self, period: float) -> None:
        """Ask every ``period`` seconds."""
        while not self._is_stopped:
            await asyncio.sleep(period)
            await self._beat()

    async def _beat(self) -> None:
        context = self._context
        try:
            identity = await self._ask()
        except (MasterError, ClosedError) as error:
            if not self._is_lost and not self._is_stopped:
                self._is_lost = True
                if self._identity is None:
                    self._is_first = True  # there was none that could be lost
                    return
                uri = context.master.uri
                reason = error.in_short if isinstance(error, MasterError) else str(error)
                context.log.warning("lost the master at %s: %s", uri, reason)
                context.emit(MasterLost(uri, reason))
            return
        context.contact.reached()
        known, self._identity = self._identity, identity
        was_lost, self._is_lost = self._is_lost, False
        if self._is_stopped:
            return
        with contextlib.suppress(MasterError):  # tried again with the next heartbeat
            await self._ask_time()
        await self._move()
        if identity == known and not was_lost and not self._is_stale:
            await self._settle()
            return
        # Also after an outage of the same master, which may have missed registrations
        # sent meanwhile.
        self._is_stale = not await self._register_again()
        if self._is_stale:
            return
        is_first, self._is_first = self._is_first or known is None, False
        if is_first:
            return
        uri = context.master.uri
        context.log.warning("registered again at the master at %s", uri)
        context.emit(MasterRestarted(uri, identity[1]))

    async def _ask(self) -> tuple[int, str]:
        master = self._context.master
        pid = await master.get_pid()
        try:
            run_id = str(await master.get_param("/run_id"))
        except MasterUnreachable:
            raise
        except MasterError:
            run_id = ""  # not set, or deleted
        return pid, run_id

    async def _move(self) -> None:
        """Announce a new address if this machine no longer has the announced one."""
        context = self._context
        old = context.address.known_host
        new = await self._own_address.successor(old)
        if old is None or new is None:
            return
        context.log.warning("the address %s is lost; others are told %s now", old, new)
        # Unregister first: the master would take the same name at another address for
        # another node, and tell whoever has the old address now to shut down.
        self._is_stale = True
        await self._all(registration.withdraw() for registration in self._registrations)
        context.address.known_host = new
        context.connections.abort_at(old)
        context.xmlrpc.close_idle()

    async def _register_again(self) -> bool:
        """Register everything again, concurrently; return whether the master accepted all."""
        return await self._all(registration.renew() for registration in self._registrations)

    async def _settle(self) -> None:
        """Repeat requests to the master that failed or may have been lost."""
        behind = [registration for registration in self._registrations if registration.is_behind]
        if behind:
            await self._all(registration.settle() for registration in behind)

    @property
    def _registrations(self) -> tuple[Registration, ...]:
        return self._context.registrations.all

    async def _all(self, telling: Iterable[Awaitable[None]]) -> bool:
        results = await asyncio.gather(*telling, return_exceptions=True)
        failures = [result for result in results if isinstance(result, BaseException)]
        for failure in failures:
            if not isinstance(failure, MasterError):
                raise failure
            self._context.log.complain("cannot register: %s", failure)
        return not failures
