"""The address a node announces, and how it finds another when its machine loses that one."""

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

    ``given`` is the host from the arguments or the environment, and ``words`` how it was
    written. ``bind`` is where to listen; a single address to listen on is also announced.
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
        """The host to announce, if it is given; None if the node has to find it."""

    @property
    def is_given(self) -> bool:
        """Whether the host is given, so that the node need not find it."""
        return self.given is not None

    async def find(self) -> tuple[str, str]:
        """Find the address when none is given.

        Returns the host to announce, and the address to listen on.
        """
        told = self.given if self.given is not None else await self._facing() or "localhost"
        if self._bind is not None:
            return told, self._bind
        if self.is_given:
            return told, bind_address_for(told)
        # Also when there is no network yet, and only localhost can be announced.
        return told, every_interface(told)

    async def doubt(self) -> str | None:
        """Describe what seems wrong with a given address, if anything does.

        This looks up names, which may take a while. A doubt is no error: this machine may have
        a name that only others know, and an address that only a router knows.
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
        """The address to announce now, if this machine no longer has the address ``told``.

        As long as the machine has it, others can keep using it, whichever address faces the
        master now.
        """
        if self.is_given or told is None or is_local(told):
            return None
        return await self._facing()

    async def _facing(self) -> str | None:
        """The address of this machine that faces the master, if there is one."""
        with contextlib.suppress(OSError):
            for _, address in await resolve(self._master):
                with contextlib.suppress(OSError):
                    return local_address_facing(address)
        return None
