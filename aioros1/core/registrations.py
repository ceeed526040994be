"""All entries of one node at the master."""

from __future__ import annotations

import asyncio

from aioros1.core.registration import Registration, Tell, Terms
from aioros1.errors import ClosedError, MasterError

__all__ = ["AT_ONCE", "Registrations"]

AT_ONCE = 6
"""Requests for registrations at a time. They have no limit of time, so that a master that
answers none of them must leave connections for others, which ask whether it is there."""


class Registrations:
    """The entries of one node at the master, by kind and name.

    There are those that have users, and those of which the master is yet to hear.
    """

    def __init__(self, terms: Terms) -> None:
        self._terms = terms

    @property
    def all(self) -> tuple[Registration, ...]:
        """Every entry."""
        return tuple(self._terms.table.values())

    def entry(self, kind: str, name: str, register: Tell, unregister: Tell) -> Registration:
        """The entry of that name: one for all that ever use it, so that what the master is
        told of it keeps its order."""
        registration = self._terms.table.get((kind, name))
        if registration is None:
            return Registration(self._terms, kind, name, register, unregister)
        registration.adopt(register, unregister)
        return registration

    async def end(self, *, only_unfinished: bool = False) -> None:
        """Take all of them back, whoever wants them or waits for them."""
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
