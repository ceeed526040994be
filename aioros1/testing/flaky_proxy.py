"""A TCP proxy that misbehaves on purpose."""

from __future__ import annotations

import asyncio
import errno
import os
import socket
from collections.abc import Awaitable, Callable
from dataclasses import replace
from types import TracebackType
from typing import Any, Self

from aioros1 import ClosedError
from aioros1._public import public
from aioros1.testing.addresses import Address, addresses_of, host_and_port
from aioros1.testing.flaky_connection import (
    Directions,
    Flaky,
    FlakyConnection,
    directions,
)
from aioros1.testing.flow import ConnectionLost, Direction, Faults

__all__ = ["FlakyProxy", "Script"]

Script = Callable[[FlakyConnection], Awaitable[object]]
"""Controls a connection; called for each one, in a task of its own."""

_GONE_BEFORE = (errno.ECONNABORTED, errno.EINTR)


@public("aioros1.testing")
class FlakyProxy(Flaky):
    """A TCP proxy in front of ``host`` and ``port`` that gives connections faults on demand.

    ::

        async with FlakyProxy("127.0.0.1", 11311) as proxy:
            ...  # connect to proxy.host and proxy.port
            proxy.stall("down")

    It listens at ``listen_host`` and ``listen_port`` (0 takes a free one) while the block
    runs; entering raises :class:`OSError` if the port is taken. Leaving the block closes all
    connections.

    The faults (:meth:`stall`, :meth:`throttle`, :meth:`delay`, :meth:`corrupt`) apply to open
    connections and to later ones. A :class:`FlakyConnection` has the same methods for itself;
    of two contradictory faults the later one holds. The proxy resets a connection that the
    server refuses. When one side ends or resets a connection, the other side sees the same.

    ``script(connection)`` is called for each new connection once it has reached the server,
    and runs to its first pause before any byte passes. An exception of a script ends the
    block, which raises it (several at once as an :class:`ExceptionGroup`), except for the
    :class:`ConnectionError` of :meth:`FlakyConnection.passed`. The end of the block cancels
    scripts that still run. The block also ends, with an :class:`OSError`, when no more files
    can be opened for connections.

    The event loop must be able to watch sockets; the proactor event loop of Windows cannot.
    """

    def __init__(
        self,
        host: str,
        port: int,
        *,
        listen_host: str = "127.0.0.1",
        listen_port: int = 0,
        script: Script | None = None,
    ) -> None:
        _check_port("port", port, 1)
        _check_port("listen_port", listen_port, 0)
        self.host = listen_host
        """The address where it listens."""
        self.port = listen_port
        """The port where it listens; certain only while the block runs."""
        self.accepted = 0
        """How many connections it has accepted so far."""
        self._target = host, port
        self._addresses: list[Address] = []
        self._script = script
        self._scripts: set[asyncio.Task[None]] = set()
        self._failures: list[BaseException] = []
        self._connections: dict[int, FlakyConnection] = {}
        self._faults: dict[Direction, Faults] = {"up": Faults(), "down": Faults()}
        self._half_open = False
        self._socket: socket.socket | None = None
        self._family = socket.AF_INET
        self._listening = False
        self._came = asyncio.Event()  # replaced after each connection
        self._is_closed = False
        self._user: asyncio.Task[Any] | None = None
        self._user_cancelled = False
        self._entered = False

    def __repr__(self) -> str:
        state = "closed" if self._is_closed else "open" if self._entered else "new"
        here, there = host_and_port(*self._own), host_and_port(*self._target)
        return f"<FlakyProxy at {here} before {there}, {state}>"

    async def __aenter__(self) -> Self:
        if self._entered:
            raise RuntimeError(f"{self!r} cannot be used a second time")
        self._entered = True
        self._loop = asyncio.get_running_loop()
        self._user = asyncio.current_task()
        host, port = self._target
        self._addresses = await addresses_of(host, port)
        self._family, (self.host, _) = (await addresses_of(*self._own))[0]
        self._socket = self._bound()
        self.port = self._socket.getsockname()[1]
        try:
            self.accept()
        except BaseException:
            self._socket.close()
            raise
        return self

    async def __aexit__(
        self,
        exc_type: type[BaseException] | None,
        exc: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        user, self._user = self._user, None
        assert user is not None
        if self._user_cancelled:
            user.uncancel()  # the cancellation was ours
        self._stop_listening()
        self._is_closed = True
        self._wake()
        for connection in self.connections:
            connection.close()
        tasks = list(self._scripts)
        for task in tasks:
            task.cancel()
        if tasks:
            await asyncio.wait(tasks)
        if len(self._failures) == 1:
            raise self._failures[0]
        if self._failures:
            raise BaseExceptionGroup(f"scripts of {self!r} failed", self._failures)

    # connections

    @property
    def connections(self) -> tuple[FlakyConnection, ...]:
        """The open connections, oldest first."""
        return tuple(self._connections.values())

    async def wait_accepted(self, n: int) -> None:
        """Wait until ``n`` connections in total have been accepted.

        Raises :class:`~aioros1.ClosedError` when the proxy is closed.
        """
        while self.accepted < n:
            if self._is_closed:
                raise ClosedError(
                    f"the proxy at {host_and_port(*self._own)} is closed; "
                    f"{self.accepted} connections have come, not {n}"
                )
            await self._came.wait()

    def cut(self) -> None:
        """Reset every connection on both sides. New ones are still accepted."""
        self._take_waiting()
        for connection in self.connections:
            connection.cut()

    def refuse(self) -> None:
        """Refuse new connections, as if nothing listened; open ones go on.

        The proxy keeps the port meanwhile.
        """
        if self._listening:
            self._take_waiting()
            self._stop_listening()
            self._socket = self._bound()

    def accept(self) -> None:
        """Accept new connections again, on the same port."""
        if self._socket is not None and not self._listening:
            self._socket.listen(512)
            self._loop.add_reader(self._socket, self._take_waiting)
            self._listening = True

    def half_open(self, enabled: bool = True) -> None:
        """Accept new connections from now on, but do nothing with them: connect to no server,
        read nothing and send nothing, like a program that hangs.

        ``half_open(False)`` ends it for later connections.
        """
        self._take_waiting()
        self._half_open = enabled

    # inside

    @property
    def _own(self) -> tuple[str, int]:
        return self.host, self.port

    def _bound(self) -> socket.socket:
        """A socket that is bound but does not listen, so that connecting is refused."""
        sock = socket.socket(self._family, socket.SOCK_STREAM)
        try:
            sock.setblocking(False)
            if os.name == "posix":  # connections on the port may still be open
                sock.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            sock.bind(self._own)
        except OSError as error:
            sock.close()
            text = f"cannot listen on {host_and_port(*self._own)}: {error.strerror or error}"
            raise OSError(error.errno, text) from None
        except BaseException:
            sock.close()
            raise
        return sock

    def _stop_listening(self) -> None:
        if self._socket is not None:
            if self._listening:
                self._loop.remove_reader(self._socket)
                self._listening = False
            self._socket.close()
            self._socket = None

    def _take_waiting(self) -> None:
        while self._listening:
            assert self._socket is not None
            try:
                sock, address = self._socket.accept()
                sock.setblocking(False)
                self._take(sock, address[:2])
            except BlockingIOError:
                return
            except OSError as error:  # most likely too many open files
                if error.errno not in _GONE_BEFORE:
                    self._stop_listening()
                    # Later, because the caller must not be cancelled in the middle of this.
                    self._loop.call_soon(self._fail, error)

    def _take(self, sock: socket.socket, client: tuple[str, int]) -> None:
        self.accepted += 1
        number = self.accepted
        connection = FlakyConnection(sock, client, number, self._faults, self._closed)
        self._connections[number] = connection
        if self._half_open:
            self._run_script(connection)
        else:
            connection._connect(self._addresses, lambda: self._run_script(connection))
        self._wake()

    def _wake(self) -> None:
        """Let tasks that wait for connections check again."""
        self._came.set()
        self._came = asyncio.Event()

    def _closed(self, connection: FlakyConnection) -> None:
        del self._connections[connection.number]

    def _change(self, direction: Directions, **changes: Any) -> None:
        self._take_waiting()
        for way in directions(direction):
            self._faults[way] = replace(self._faults[way], **changes)
        for connection in self.connections:
            connection._change(direction, **changes)

    def _run_script(self, connection: FlakyConnection) -> None:
        if self._script is not None:
            name = f"script of {connection!r}"
            task = self._loop.create_task(self._call(self._script, connection), name=name)
            self._scripts.add(task)
            task.add_done_callback(self._script_ended)

    async def _call(self, script: Script, connection: FlakyConnection) -> None:
        try:
            await script(connection)
        except* ConnectionLost:
            pass  # scripts need not handle the end of a connection

    def _script_ended(self, task: asyncio.Task[None]) -> None:
        self._scripts.remove(task)
        if not task.cancelled() and (error := task.exception()) is not None:
            self._fail(error)

    def _fail(self, error: BaseException) -> None:
        """End the user's block."""
        self._failures.append(error)
        if self._user is not None and not self._user_cancelled:
            self._user_cancelled = self._user.cancel()


def _check_port(name: str, port: int, least: int) -> None:
    if not isinstance(port, int) or not least <= port <= 65535:
        raise ValueError(f"{name} must be a number from {least} to 65535, got {port!r}")
