"""All registrations of one node at the master."""

from __future__ import annotations

import asyncio

from aioros1.core.registration import Registration, Tell, Terms
from aioros1.errors import ClosedError, MasterError

__all__ = ["AT_ONCE", "Registrations"]

AT_ONCE = 6
"""Registration requests that may be in progress at a time. They have no timeout. The limit
leaves connections for requests that check for the master even if it answers none of these."""


class Registrations:
    """The registrations of one node at the master, by kind and name.

    It holds the entries that have users and those that the master must still be told of.
    """

    def __init__(self, terms: Terms) -> None:
        self._terms = terms

    @property
    def all(self) -> tuple[Registration, ...]:
        """Every entry."""
        return tuple(self._terms.table.values())

    def entry(self, kind: str, name: str, register: Tell, unregister: Tell) -> Registration:
        """Return the entry of that name. All its users share it, which keeps the requests about
        it in order."""
        registration = self._terms.table.get((kind, name))
        if registration is None:
            return Registration(self._terms, kind, name, register, unregister)
        registration.adopt(register, unregister)
        return registration

    async def end(self, *, only_unfinished: bool = False) -> None:
        """Unregister everything for good, even entries that have users."""
        ending = [
            registration.end()
            for registration in self.all
            if not (only_unfinished and registration.is_established)
        ]
        for error in await asyncio.gather(*ending, return_exceptions=True):
            if isinstance(error, BaseException) and not isinstance(
                error, MasterError | ClosedError
            ):
                raise error
