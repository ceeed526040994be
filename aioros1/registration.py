"""One entry of a node at the master, shared by the roles that need it."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable

from aioros1.errors import MasterError

__all__ = ["Registration"]


class Registration:
    """Registered while it has users, and again whenever the master has forgotten.

    ``register`` and ``unregister`` talk to the master. They never overlap: a role that
    closes while another one of the same name opens must not undo what that one did.
    """

    def __init__(
        self,
        kind: str,
        name: str,
        register: Callable[[], Awaitable[None]],
        unregister: Callable[[], Awaitable[object]],
    ) -> None:
        self.kind = kind
        self.name = name
        self.users = 0
        self._register = register
        self._unregister = unregister
        self._lock = asyncio.Lock()

    async def acquire(self) -> None:
        """One user more; returns when the master has accepted.

        Raises what the master answers; then, and when it is cancelled, nothing stays
        registered that was not before.
        """
        async with self._lock:
            if not self.users:
                try:
                    await self._register()
                except MasterError:
                    raise
                except BaseException:
                    # The request may have reached the master: take it back. Whoever
                    # cancelled us waits for that, but not longer than for any request.
                    await self._take_back()
                    raise
            self.users += 1

    async def release(self) -> None:
        """One user less. Raises :class:`~aioros1.MasterError` if the last one's
        leaving could not be told to the master."""
        async with self._lock:
            self.users -= 1
            if not self.users:
                await self._unregister()

    async def withdraw(self) -> None:
        """Take it back from the master, to be renewed. Raises :class:`~aioros1.MasterError`."""
        async with self._lock:
            if self.users:
                await self._unregister()

    async def renew(self) -> None:
        """Register again, if there are users."""
        async with self._lock:
            if self.users:
                await self._register()

    async def _take_back(self) -> None:
        try:
            await self._unregister()
        except MasterError:
            pass  # it is gone, and will know of nothing when it comes back
