"""Noticing that the master is lost, back or replaced, and that our own address has changed.

Masters forget everything when they exit, and tell nobody. A node that registered only once
would then be missing from the graph, so it checks regularly who the master is and what it
lists, and registers again what is missing. It does the same when its machine has a new
address.
"""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable

from aioros1.core.context import Context
from aioros1.errors import ClosedError, MasterError, MasterUnreachable
from aioros1.events import MasterLost, MasterRestarted
from aioros1.net.connecting import is_exhausted
from aioros1.node.own_address import OwnAddress
from aioros1.node.roll_call import RollCall
from aioros1.xmlrpc.client import is_judgement
from aioros1.xmlrpc.master_proxy import identify

__all__ = ["Heartbeat"]

_LATE = 0.5
"""Seconds by which a beat is late when the event loop was blocked. Others may have taken the
node for dead meanwhile."""


class Heartbeat:
    """Keeps one node known to its master."""

    def __init__(
        self, context: Context, own_address: OwnAddress, ask_time: Callable[[], Awaitable[None]]
    ) -> None:
        self._context = context
        self._own_address = own_address
        self._ask_time = ask_time  # find out which time the node follows
        self._roll_call = RollCall(context)
        self._identity: tuple[int, str] | None = None
        self._losses = 0  # of connections to the master
        self._is_lost = False
        self._is_stale = False  # the master lacks everything, perhaps
        self._is_first = False  # the next master to answer is the first of this node
        self._is_stopped = False
        self._renewals = 0
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
        """Ask every ``period`` seconds. Nothing but the end of the node ends this."""
        loop = asyncio.get_running_loop()
        while not self._is_stopped:
            begin = loop.time()
            await asyncio.sleep(period)
            if loop.time() > begin + period + _LATE:
                self._roll_call.suspect()
            if not await self._is_done(self._beat):
                # Its connections, or what came over them, may be gone as well.
                self._roll_call.suspect()

    async def _is_done(self, step: Callable[[], Awaitable[None]]) -> bool:
        """Run one step, whose failure must not keep others from theirs."""
        try:
            await step()
        except (ClosedError, MasterUnreachable):
            return False  # the next beat will tell, or there is none
        except asyncio.CancelledError:
            task = asyncio.current_task()
            if task is not None and task.cancelling():
                raise
            return False  # of something else, which it has waited for
        except Exception as error:
            self._complain(f"heartbeat: {error!r}")
            return False
        return True

    async def _beat(self) -> None:
        context = self._context
        try:
            identity = await self._ask()
        except MasterError as error:
            self._missed(error)
            return
        context.contact.reached()
        known, self._identity = self._identity, identity
        was_lost, self._is_lost = self._is_lost, False
        if self._is_stopped:
            return
        await self._is_done(self._move)
        # Also after an outage of the same master, which may have missed registrations
        # sent meanwhile.
        if was_lost or self._is_stale or _is_another(known, identity):
            self._renew(is_news=known is not None)
        else:
            context.registrations.push()
            await self._is_done(self._look)
        await self._is_done(self._ask_time)

    async def _ask(self) -> tuple[int, str]:
        master = self._context.master
        pid = await identify(master)
        try:
            run_id = str(await master.get_param("/run_id"))
        except MasterError as error:
            if not is_judgement(error):
                raise
            run_id = ""  # not set, or deleted
        return pid, run_id

    def _missed(self, error: MasterError) -> None:
        """Act on a beat that the master did not answer."""
        context = self._context
        if is_exhausted(error):
            # This says nothing about the master.
            self._complain(f"cannot ask the master: {error}")
            self._roll_call.suspect()
        elif not self._is_lost and not self._is_stopped:
            self._is_lost = True
            if self._identity is None:
                self._is_first = True  # there was none that could be lost
                return
            uri, reason = context.master.uri, error.in_short
            context.log.warning("lost the master at %s: %s", uri, reason)
            context.emit(MasterLost(uri, reason))

    def _complain(self, text: str) -> None:
        """Log what goes wrong, and count it if it goes on."""
        self._context.log.complain("%s", text)

    async def _look(self) -> None:
        """Register again what the master does not list."""
        context = self._context
        losses = context.xmlrpc.losses(context.master.uri)
        if losses != self._losses:
            self._losses = losses
            self._roll_call.suspect()  # it may have been another master's connection
        found = await self._roll_call.look()
        if self._is_stopped:
            return
        if found.is_forgotten:
            context.log.warning("the master at %s has forgotten this node", context.master.uri)
            self._renew(is_news=True)
        for entry in found.missing:
            context.log.complain(
                "the master at %s has forgotten %s %s", context.master.uri, entry.kind, entry.name
            )
            entry.forget()
        context.registrations.push()

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
        await context.registrations.withdraw()
        context.address.known_host = new
        context.connections.abort_at(old)
        context.xmlrpc.close_idle()

    def _renew(self, *, is_news: bool) -> None:
        """Register everything again. The next beat does not wait for it."""
        self._is_stale = False
        self._renewals += 1
        context = self._context
        context.spawn(
            self._renew_all, self._renewals, is_news, name=f"{context.name} registers again"
        )

    async def _renew_all(self, renewal: int, is_news: bool) -> None:
        context = self._context
        entries = len(context.registrations.all)
        failures = await context.registrations.renew()
        if renewal != self._renewals or self._is_stopped:
            return  # the next one tells
        unreachable = [error for error in failures if isinstance(error, MasterUnreachable)]
        if unreachable and len(unreachable) == entries:
            self._is_stale = True
            return
        is_first, self._is_first = self._is_first, False
        if is_news and not is_first and self._identity is not None:
            uri = context.master.uri
            context.log.warning("registered again at the master at %s", uri)
            context.emit(MasterRestarted(uri, self._identity[1]))


def _is_another(known: tuple[int, str] | None, identity: tuple[int, str]) -> bool:
    """Whether a master that answers so is another one."""
    if known is None:
        return True
    if known[0] != identity[0] and known[0] and identity[0]:
        return True
    # roscore sets the id a moment after its master answers.
    return known[1] not in ("", identity[1])
