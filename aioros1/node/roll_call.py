"""Comparing what the master lists of a node with what the node has open.

A master may have forgotten a node without having been restarted in a way that shows: it has
the same process id in its next container, or somebody has unregistered the node because it
did not answer for a moment (``rosnode cleanup``). Only the master's list of everything tells.
"""

from __future__ import annotations

import asyncio
from collections.abc import Mapping
from dataclasses import dataclass, field
from urllib.parse import urlsplit

from aioros1.core.context import Context
from aioros1.core.registration import Registration
from aioros1.core.time_taken import TimeTaken
from aioros1.errors import MasterError, MasterUnreachable
from aioros1.xmlrpc.client import is_judgement
from aioros1.xmlrpc.master_proxy import SystemState

__all__ = ["Found", "RollCall"]

_SHARE = 0.05
"""The part of a master's time that the comparisons of all its nodes may take together."""

_CONFIRM = 10.0
"""Seconds after which an entry of a kind that no master lists is registered once more."""

_ONCE_MORE = (0.0, 10.0, 60.0)
"""Seconds after a suspicion at which to compare. Who unregisters a node that did not answer
may take a while, as ``rosnode cleanup`` does, which asks its user first."""

_LATE_REQUESTS = 60.0
"""Seconds in which a master may still process a request whose connection was closed."""

_LONGEST_PAUSE = 600.0


@dataclass
class Found:
    """What the master lacks, as one look has shown."""

    is_forgotten: bool = False
    """Whether the master lists nothing of the node."""
    missing: list[Registration] = field(default_factory=list)
    """The entries it does not list, if it lists others."""


class RollCall:
    """Finds what the master lacks.

    Listing everything takes time that grows with the graph, and every node asks. So a node
    waits between two comparisons until those of all nodes together take only a small part of
    the master's time. Meanwhile it asks for its own name, which costs next to nothing.
    """

    def __init__(self, context: Context) -> None:
        self._context = context
        self._next = 0.0  # when to compare, by the loop's time
        self._once_more: list[float] = []  # when to compare as well
        self._took = TimeTaken()  # by a comparison
        self._absences = _Absences()
        self._taken: set[Registration] = set()  # services that other nodes provide now
        self._is_replaced = False

    def suspect(self) -> None:
        """Compare with the next look, and again later: something may have happened."""
        now = asyncio.get_running_loop().time()
        self._once_more = [now + seconds for seconds in _ONCE_MORE]

    async def look(self) -> Found:
        """Ask the master. Raises :class:`~aioros1.MasterError`."""
        told = {
            entry: entry.requests for entry in self._context.registrations.all if entry.is_settled
        }
        if not told:
            return Found()
        now = asyncio.get_running_loop().time()
        if self._is_due(now) and any(entry.kind in _LISTED for entry in told):
            found = await self._compare(told, now)
        else:
            is_known = await self._is_known()
            is_forgotten = not is_known and any(map(_is_registered, told.items()))
            found = Found(is_forgotten and self._absences.is_news(None, now))
            if is_known and not any(entry.kind in _LISTED for entry in told):
                self._absences.end(None)
        if not found.is_forgotten:
            self._confirm(told, now)
        return found

    def _is_due(self, now: float) -> bool:
        if self._once_more and now >= self._once_more[0]:
            self._once_more = [moment for moment in self._once_more if moment > now]
            return True
        return now >= self._next

    async def _compare(self, told: Mapping[Registration, int], now: float) -> Found:
        context = self._context
        loop = asyncio.get_running_loop()
        try:
            state = await context.master.get_system_state()
        except MasterUnreachable:
            self._next = now + (loop.time() - now) / _SHARE
            raise
        except MasterError as error:
            # A master that cannot list, or one whose list is too large to be read.
            context.log.debug("registrations cannot be compared: %s", error)
            self._next = now + _LONGEST_PAUSE
            return Found()
        self._took.add(loop.time() - now)
        self._next = now + self._took.seconds * max(len(_names(state)), 1) / _SHARE
        absent, is_listed = [], False
        taken, self._taken = self._taken, set()
        for entry, requests in told.items():
            part = _LISTED.get(entry.kind)
            if part is None or not _is_unchanged(entry, requests):
                continue
            nodes = getattr(state, part).get(entry.name, ())
            if context.name in nodes:
                is_listed = True
                self._absences.end(entry)
                self._absences.end(None)
            elif part == "services" and nodes:
                self._taken.add(entry)
            if not entry.is_wanted:
                if context.name in nodes:
                    entry.doubt()
            # A service that another node provides now is no longer ours.
            elif not nodes or (part != "services" and context.name not in nodes):
                absent.append(entry)
            if entry.suspect_since is not None and now > entry.suspect_since + _LATE_REQUESTS:
                entry.trust()
        if not absent:
            return Found()
        # If another node has our name, registering again would end that one.
        is_known = await self._is_known()
        if self._is_replaced:
            return Found()
        # A service that another node has taken and given up was not forgotten.
        if not (is_known and is_listed) and not taken.issuperset(absent):
            return Found(is_forgotten=self._absences.is_news(None, now))
        return Found(missing=[entry for entry in absent if self._absences.is_news(entry, now)])

    async def _is_known(self) -> bool:
        """Whether the master knows the node's name."""
        context = self._context
        try:
            uri = await context.master.lookup_node(context.name)
        except MasterError as error:
            if is_judgement(error):
                self._is_replaced = False
                return not error.is_refusal  # a fault says nothing
            raise
        was_replaced = self._is_replaced
        self._is_replaced = urlsplit(uri).netloc != urlsplit(context.address.uri).netloc
        if self._is_replaced and not was_replaced:
            context.log.warning(
                "the master knows another node of this name, at %s: what it does not list of "
                "this node is not registered again",
                uri,
            )
        return True

    def _confirm(self, told: Mapping[Registration, int], now: float) -> None:
        """Register again what no master lists, each so rarely that it costs little."""
        for entry, requests in told.items():
            if entry.kind not in _LISTED and _is_unchanged(entry, requests):
                pause = max(_CONFIRM, entry.took.seconds / _SHARE)
                if now >= entry.told_at + pause:
                    entry.confirm()


class _Absences:
    """What was missing lately, so that a master that never lists it is not told all the time.

    The key None is the node itself.
    """

    def __init__(self) -> None:
        self._pauses: dict[Registration | None, tuple[float, float]] = {}

    def is_news(self, key: Registration | None, now: float) -> bool:
        """Note that it is missing; return whether to register it again."""
        until, pause = self._pauses.get(key, (0.0, 0.5))
        if now < until:
            return False
        self._pauses[key] = now + pause, min(2 * pause, _LONGEST_PAUSE)
        return True

    def end(self, key: Registration | None) -> None:
        """Note that it is not missing."""
        self._pauses.pop(key, None)


_LISTED = {"publisher": "publishers", "subscriber": "subscribers", "service": "services"}
"""The kinds of entries that masters list, and in which part of the system state."""


def _names(state: SystemState) -> set[str]:
    return {node for part in state for nodes in part.values() for node in nodes}


def _is_unchanged(entry: Registration, requests: int) -> bool:
    """Whether no request about the entry was sent since ``requests`` were counted."""
    return entry.is_settled and entry.requests == requests


def _is_registered(told: tuple[Registration, int]) -> bool:
    entry, requests = told
    return entry.is_wanted and _is_unchanged(entry, requests)
