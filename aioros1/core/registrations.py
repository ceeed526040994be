"""All registrations of one node at the master."""

from __future__ import annotations

import asyncio

from aioros1.core.registration import Registration, Tell, Terms

__all__ = ["Registrations"]


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

    async def renew(self) -> list[Exception]:
        """Register everything again, concurrently; return the errors of those that failed.

        An entry that fails is tried again with :meth:`push`, and does not delay the others.
        """
        entries = self.all
        results = await asyncio.gather(
            *(entry.renew() for entry in entries), return_exceptions=True
        )
        failures = []
        for entry, result in zip(entries, results, strict=True):
            if isinstance(result, Exception):
                failures.append(result)
                entry.complain(result)
        return failures

    async def withdraw(self) -> None:
        """Unregister everything until :meth:`renew`, as far as the master answers."""
        withdrawing = [entry.withdraw() for entry in self.all]
        await asyncio.gather(*withdrawing, return_exceptions=True)

    def push(self) -> None:
        """Repeat requests to the master that failed or may have been lost; never waits."""
        for entry in self.all:
            entry.push()

    async def end(self, *, only_unfinished: bool = False) -> None:
        """Unregister everything for good, even entries that have users, as far as possible."""
        ending = [
            registration.end()
            for registration in self.all
            if not (only_unfinished and registration.is_established)
        ]
        await asyncio.gather(*ending, return_exceptions=True)
