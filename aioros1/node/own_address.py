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
        self._master_uri = master_uri
        self._master = urlsplit(master_uri).hostname or "localhost"
        self._tells_master = False  # the host of the URI, because it is this machine's name
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
        if self.given is not None:
            return self.given, self._bind or bind_address_for(self.given)
        # Without a network, only localhost can be announced yet.
        told, facing = await self._facing() or ("localhost", "localhost")
        # A name is no IPv6 address, but it may mean nothing else.
        return told, self._bind or every_interface(facing if ":" in facing else told)

    @property
    def can_be_doubted(self) -> bool:
        """Whether it takes a look-up to find out if others can use what they are told."""
        return self.is_given or self._tells_master

    async def doubt(self) -> str | None:
        """Describe what seems wrong with a given address, if anything does.

        This looks up names, which may take a while. A doubt is no error: this machine may have
        a name that only others know, and an address that only a router knows.
        """
        host, words = self.given, self._words
        if host is None and self._tells_master:
            host, words = self._master, f"master URI {self._master_uri}"
        if host is None or is_loopback(host):
            return None
        try:
            addresses = [address for _, address in await resolve(host)]
        except OSError as error:
            what = f"cannot be looked up here ({error.strerror or error})"
        else:
            if is_wildcard(host):
                what = "stands for all addresses"
            elif all(map(is_loopback, addresses)):
                what = f"is a loopback address here ({', '.join(addresses)})"
            elif any(map(is_local, addresses)):
                return None
            elif addresses == [host]:
                what = "is no address of this machine"
            else:
                what = f"is {', '.join(addresses)}, which is no address of this machine"
        return (
            f"{words}: {host!r} {what}, and others are told to connect there; "
            "expected a name or an address by which they reach this machine"
        )

    async def successor(self, told: str | None) -> str | None:
        """The address to announce now, if this machine no longer has the address ``told``.

        As long as the machine has it, others can keep using it, whichever address faces the
        master now.
        """
        if self.is_given or told is None or is_local(told):
            return None
        if self._tells_master and told == self._master:
            return None  # others look it up
        facing = await self._facing()
        return None if facing is None else facing[0]

    async def _facing(self) -> tuple[str, str] | None:
        """What to announce to be reached from where the master is, and the address of this
        machine that faces it; None if there is no way to it.

        The two are the same, unless the master's host is a name of this machine that means
        loopback here: the installers of Debian and Ubuntu write ``127.0.1.1 robot`` into
        ``/etc/hosts``. Others know the machine by that name and look up something else, so
        the name is announced, as by rospy and roscpp.
        """
        with contextlib.suppress(OSError):
            addresses = [address for _, address in await resolve(self._master)]
            for address in sorted(addresses, key=is_loopback):
                with contextlib.suppress(OSError):
                    facing = local_address_facing(address)
                    self._tells_master = is_loopback(facing)
                    return (self._master if self._tells_master else facing), facing
        return None
