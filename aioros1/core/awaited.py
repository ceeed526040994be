"""Code of the user that the end of a node waits for.

A service handler may close its node, and so may a callback of ``on_shutdown``. The node closes
once they have returned, so they must not wait for it. A context variable tells: it reaches the
tasks that such code starts and awaits, too.
"""

from __future__ import annotations

from contextvars import ContextVar

__all__ = ["Awaited", "awaits_caller"]


class Awaited:
    """A piece of the user's code, for whose end the ``owners`` wait while :attr:`is_awaited`."""

    __slots__ = ("_outer", "_owners", "is_awaited")

    def __init__(self, *owners: object, is_awaited: bool) -> None:
        self._owners = owners
        self.is_awaited = is_awaited
        """Whether the owners wait, or would wait as soon as they close."""
        self._outer: Awaited | None = None

    def enter(self) -> None:
        """Record that the running task, and all that it starts from now on, is this code."""
        self._outer = _CURRENT.get()
        _CURRENT.set(self)

    def leave(self) -> None:
        """Record that the code has ended; tasks that it has started may go on."""
        self.is_awaited = False
        self._outer = None  # or else a chain of tasks that start one another would grow

    @staticmethod
    def is_inside(owner: object) -> bool:
        code = _CURRENT.get()
        while code is not None:
            if code.is_awaited and any(each is owner for each in code._owners):
                return True
            code = code._outer
        return False


awaits_caller = Awaited.is_inside
"""Whether the running code is such that ``owner`` waits for its end."""

_CURRENT: ContextVar[Awaited | None] = ContextVar("aioros1.core.awaited", default=None)
