"""What a node tells others to connect to, and what becomes of that when it is lost."""

from __future__ import annotations

import contextlib
from urllib.parse import urlsplit

from aioros1.net.hosts import (
    bind_address_for,
    every_interface,
    is_local,
    is_loopback,
    is_wildcard,
    local_address_facing,
    resolve,
)

__all__ = ["OwnAddress"]


class OwnAddress:
    """The address of one node: the one it was given, or the one that faces its master.

    ``given`` is what arguments and environment say, and ``words`` how they say it; ``bind``
    is where to listen. One address to listen on is one to tell.
    """

    def __init__(
        self, given: str | None, bind: str | None, master_uri: str, *, words: str = ""
    ) -> None:
        self._words = words
        self._master = urlsplit(master_uri).hostname or "localhost"
        self._bind = bind
        if given is None and bind is not None and not is_wildcard(bind):
            given = bind
        if given is None and is_loopback(self._master):
            given = self._master
        self.given = given
        """What others are told, if something says it; None if it is to be found."""

    @property
    def is_given(self) -> bool:
        """Whether something says it, and it has not to be found."""
        return self.given is not None

    async def find(self) -> tuple[str, str]:
        """Look for an address that nobody has given.

        Returns what to tell others, and where to listen.
        """
        told = self.given if self.given is not None else await self._facing() or "localhost"
        if self._bind is not None:
            return told, self._bind
        if self.is_given:
            return told, bind_address_for(told)
        # Also when there is no network yet, and therefore nothing to tell but localhost.
        return told, every_interface(told)

    async def doubt(self) -> str | None:
        """What seems to be wrong with an address that was given, if anything does.

        A name is looked up, which takes as long as it takes. It is no error: this machine
        may have a name that only others know, and an address that only a router knows.
        """
        host = self.given
        if host is None or is_loopback(host):
            return None
        try:
            addresses = [address for _, address in await resolve(host)]
        except OSError as error:
            what = f"cannot be looked up here ({error.strerror or error})"
        else:
            if is_wildcard(host):
                what = "stands for all addresses"
            elif any(is_local(address) for address in addresses):
                return None
            elif addresses == [host]:
                what = "is no address of this machine"
            else:
                what = f"is {', '.join(addresses)}, which is no address of this machine"
        return (
            f"{self._words}: {host!r} {what}, and others are told to connect there; "
            "expected a name or an address by which they reach this machine"
        )

    async def successor(self, told: str | None) -> str | None:
        """What to tell now, if the address that was ``told`` is this machine's no more.

        As long as it is, others can go on using it, whatever faces the master now.
        """
        if self.is_given or told is None or is_local(told):
            return None
        return await self._facing()

    async def _facing(self) -> str | None:
        """The address of this machine that faces the master, if any does."""
        with contextlib.suppress(OSError):
            for _, address in await resolve(self._master):
                with contextlib.suppress(OSError):
                    return local_address_facing(address)
        return None
