"""One connection through a :class:`.FlakyProxy`, and the faults you can give it."""

from __future__ import annotations

import asyncio
import contextlib
import errno
import math
import socket
import struct
from collections.abc import Callable, Sequence
from typing import Any, Literal

from aioros1._public import public
from aioros1.testing.addresses import Address, host_and_port
from aioros1.testing.flow import ROOM, Direction, Faults, Flow

__all__ = [
    "Directions",
    "Flaky",
    "FlakyConnection",
    "directions",
]

Directions = Literal["up", "down", "both"]
"""The directions of a connection that a fault applies to."""

_BOTH: tuple[Direction, Direction] = ("up", "down")


class Flaky:
    """The faults that you can give a connection, or all connections of a proxy.

    ``direction`` is ``"up"`` (from the client to the server), ``"down"`` or ``"both"``.
    """

    def stall(self, direction: Directions = "both") -> None:
        """Let nothing pass, not even the end; the connections stay open.

        Nothing is read either, so the sender blocks once the system's buffers are full.
        """
        self._change(direction, stalled=True)

    def resume(self, direction: Directions = "both") -> None:
        """End :meth:`stall`; nothing was lost."""
        self._change(direction, stalled=False)

    def throttle(self, bytes_per_second: float | None, direction: Directions = "both") -> None:
        """Let at most this many bytes pass per second; ``None`` ends it."""
        rate = bytes_per_second
        if rate is not None and not 0 < rate < math.inf:
            raise ValueError(f"bytes_per_second must be positive or None, got {rate!r}")
        self._change(direction, rate=rate)

    def delay(self, seconds: float, direction: Directions = "both") -> None:
        """Delay every byte, and the end, by this many seconds; 0 ends it.

        At most 64 KiB are on their way in each direction, so a delay bounds the rate too.
        """
        if not 0 <= seconds < math.inf:
            raise ValueError(f"seconds must not be negative, got {seconds!r}")
        self._change(direction, delay=seconds)

    def corrupt(
        self, probability: float, direction: Directions = "both", *, seed: int | None = None
    ) -> None:
        """Change each byte to another with this probability; 0 ends it.

        With a ``seed``, the same bytes of the same connection are changed in every run.
        """
        if not 0 <= probability <= 1:
            raise ValueError(f"probability must be from 0 to 1, got {probability!r}")
        self._change(direction, corruption=probability, seed=seed)

    def _change(self, direction: Directions, **changes: Any) -> None:
        raise NotImplementedError


def directions(direction: Directions) -> tuple[Direction, ...]:
    """The one direction, or both. Raises :class:`ValueError` for anything else."""
    if direction == "both":
        return _BOTH
    if direction not in _BOTH:
        raise ValueError(f"direction must be 'up', 'down' or 'both', got {direction!r}")
    return (direction,)


@public("aioros1.testing")
class FlakyConnection(Flaky):
    """One connection from a client through the proxy to the server.

    A script of :class:`FlakyProxy` gets it as its argument, and ``connections`` of the proxy
    has those that are open.
    """

    def __init__(
        self,
        sock: socket.socket,
        client: tuple[str, int],
        number: int,
        faults: dict[Direction, Faults],
        on_closed: Callable[[FlakyConnection], None],
    ) -> None:
        self.number = number
        """The number of the connection in its proxy, from 1."""
        self.client = client
        """The address and port of the client."""
        self.is_open = True
        """Whether it can still carry bytes; False once any side has ended it."""
        self._loop = asyncio.get_running_loop()
        self._on_closed = on_closed
        self._closed = asyncio.Event()
        self._sockets = [sock]
        self._flows: dict[Direction, Flow] = {
            "up": Flow("up", number, faults["up"], self._ended, self.cut),
            "down": Flow("down", number, faults["down"], self._ended, self.cut, sink=sock),
        }

    def __repr__(self) -> str:
        state = "open" if self.is_open else "closed"
        return f"<FlakyConnection {self.number} from {host_and_port(*self.client)}, {state}>"

    @property
    def bytes_up(self) -> int:
        """How many bytes have passed from the client to the server."""
        return self._flows["up"].passed

    @property
    def bytes_down(self) -> int:
        """How many bytes have passed from the server to the client."""
        return self._flows["down"].passed

    async def passed(self, bytes: int, direction: Direction) -> None:
        """Wait until this many bytes have passed since the connection was made.

        They have been handed to the system, towards their receiver. The next byte has not,
        and will not be until the waiting task has run: a fault that it sets in its next step
        begins exactly there. Returns at once if that many have already passed.

        Raises :class:`ConnectionError` when this direction ends earlier.
        """
        if direction not in _BOTH:
            raise ValueError(f"direction must be 'up' or 'down', got {direction!r}")
        await self._flows[direction].wait_passed(bytes)

    async def wait_closed(self) -> None:
        """Wait until the connection has ended, whoever ended it."""
        await self._closed.wait()

    def cut(self) -> None:
        """Reset the connection on both sides."""
        self._end(reset=True)

    def close(self) -> None:
        """Close the connection properly on both sides; bytes that have not passed are lost."""
        self._end(reset=False)

    def shut(self, direction: Directions) -> None:
        """End one direction towards its receiver; the other one goes on.

        Bytes that have not passed, and those sent from now on, are lost.
        """
        for way in directions(direction):
            self._flows[way].shut()

    # for the proxy

    def _connect(self, addresses: Sequence[Address], then: Callable[[], object]) -> None:
        """Connect to the first of ``addresses`` that accepts, call ``then()`` and begin.
        Reset the client if none does."""
        for tried, (family, address) in enumerate(addresses, start=1):
            sock = socket.socket(family, socket.SOCK_STREAM)
            sock.setblocking(False)
            if sock.connect_ex(address) in (0, errno.EINPROGRESS):
                self._sockets.append(sock)
                self._loop.add_writer(sock, self._connected, addresses[tried:], then)
                return
            sock.close()
        self.cut()

    def _connected(self, others: Sequence[Address], then: Callable[[], object]) -> None:
        client, server = self._sockets
        self._loop.remove_writer(server)
        if server.getsockopt(socket.SOL_SOCKET, socket.SO_ERROR):
            self._sockets.pop().close()
            self._connect(others, then)
            return
        for sock in self._sockets:
            sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        then()
        self._flows["up"].begin(client, server)
        self._flows["down"].begin(server, client)

    def _change(self, direction: Directions, **changes: Any) -> None:
        for way in directions(direction):
            self._flows[way].change(**changes)

    def _ended(self) -> None:
        if all(flow.ended for flow in self._flows.values()):
            self.close()

    def _end(self, *, reset: bool) -> None:
        if not self.is_open:
            return
        self.is_open = False
        for flow in self._flows.values():
            flow.stop()
        for sock in self._sockets:
            self._loop.remove_writer(sock)  # it may still be connecting
            with contextlib.suppress(OSError):  # a socket that was reset has no options
                if reset:
                    sock.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
                else:
                    _read_away(sock)
            sock.close()
        self._closed.set()
        self._on_closed(self)


def _read_away(sock: socket.socket) -> None:
    """Read all that has come: the system resets a connection closed with unread bytes."""
    for _ in range(100):
        if not sock.recv(ROOM):
            return
