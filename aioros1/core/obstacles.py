"""Why something that is waited for does not come, for the text of an error."""

from __future__ import annotations

import asyncio
import difflib
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import islice
from types import TracebackType
from typing import Literal, Self

from aioros1.core.context import Context
from aioros1.errors import ClosedError, MasterError
from aioros1.quoting import LONGEST, printable
from aioros1.waiting import Obstacle

__all__ = ["Hint", "similar_node", "similar_service"]

_SOON = 0.2
"""Seconds until the master is asked: most waits are over before."""

_SHOWN = 3
"""Names to mention."""

_COMPARED = 1000
"""Names to compare: each takes some 10 µs, in which nothing else happens."""

Kind = Literal["publishers", "subscribers", "services"]


class Hint(Obstacle):
    """What is in the way, and what the master knows of that name and of similar ones.

    Use it as a context manager around the wait. The master is asked once, in the background,
    and only if the wait has a ``timeout``, whose error is the only place for the hint.
    """

    def __init__(
        self,
        context: Context,
        kind: Kind,
        name: str,
        what: Callable[[], str],
        timeout: float | None,
    ) -> None:
        super().__init__(what)
        self._context = context
        self._kind: Kind = kind
        self._name = name
        self._timeout = timeout
        self._found = ""
        self._is_unknown = False  # to the master, which is all that there is to say
        self._timer: asyncio.TimerHandle | None = None
        self._task: asyncio.Task[None] | None = None

    def __str__(self) -> str:
        obstacle = "" if self._is_unknown else super().__str__()
        return "; ".join(filter(None, (obstacle, self._found)))

    def __enter__(self) -> Self:
        if self._timeout is not None and self._timeout > 0:
            loop = asyncio.get_running_loop()
            self._timer = loop.call_later(min(_SOON, self._timeout / 2), self._begin)
        return self

    def __exit__(
        self,
        exc_type: type[BaseException] | None,
        exc: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        # What is in the way now, and not after the clean-up that follows.
        obstacle = super().__str__()
        self._what = lambda: obstacle
        if self._timer is not None:
            self._timer.cancel()
        if self._task is not None:
            self._task.cancel()

    def _begin(self) -> None:
        try:
            self._task = self._context.spawn(self._look, name=f"who has {self._name}")
        except ClosedError:
            pass  # the node has ended, and the wait with it

    async def _look(self) -> None:
        try:
            state = await self._context.master.get_system_state()
        except MasterError as error:
            self._found = error.in_short
            return
        known: Mapping[str, Sequence[str]] = getattr(state, self._kind)
        if nodes := known.get(self._name):
            self._found = f"the master lists {_names(nodes)} for {self._name}"
        else:
            one = self._kind.removesuffix("s")
            one = "provider" if one == "service" else one
            self._is_unknown = True
            self._found = f"the master knows no {one} of {self._name}"
            self._found += _similar_to(self._name, known)


def _similar_to(name: str, known: Iterable[str]) -> str:
    """Words that mention the names most like ``name``; nothing if none is."""
    names = [each for each in islice(known, _COMPARED) if len(each) <= LONGEST]
    base = _base(name)
    # The commonest mistake is another namespace.
    found = [each for each in names if _base(each) == base]
    found += difflib.get_close_matches(name, names, _SHOWN, 0.75)
    bases = difflib.get_close_matches(base, {_base(each) for each in names}, _SHOWN, 0.8)
    found += [each for each in names if _base(each) in bases]
    others = [each for each in dict.fromkeys(found) if each != name]
    return f", but it knows {_names(others)}" if others else ""


def _base(name: str) -> str:
    return name.rpartition("/")[2]


async def similar_service(context: Context, name: str) -> str:
    """:func:`_similar_to` for the services that the master knows."""
    try:
        return _similar_to(name, (await context.master.get_system_state()).services)
    except MasterError:
        return ""


async def similar_node(context: Context, name: str) -> str:
    """:func:`_similar_to` for the nodes that the master knows."""
    try:
        state = await context.master.get_system_state()
    except MasterError:
        return ""
    nodes = (node for part in state for nodes in part.values() for node in nodes)
    return _similar_to(name, dict.fromkeys(nodes))


def _names(names: Sequence[str]) -> str:
    shown = [printable(each, 100) for each in names[:_SHOWN]]
    more = f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else ""
    return ", ".join(shown) + more
