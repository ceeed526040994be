"""Accepting connections when there is no room for them, and when the server closes."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import os
import resource
import socket
import subprocess
import sys
from collections.abc import Iterator
from typing import Any

import pytest

from aioros1.net import accepting as accepting_module
from aioros1.net.accepting import ListeningSocket
from aioros1.net.admission import Admission
from aioros1.net.hosts import bind_sockets

LOG = logging.getLogger("aioros1.test")


class Echo(asyncio.Protocol):
    """Tells each connection that it has been accepted."""

    def __init__(self, admission: Admission, host: str) -> None:
        self._admission = admission
        self._host = host

    def connection_made(self, transport: Any) -> None:
        transport.write(b"welcome")
        transport.close()

    def connection_lost(self, exc: Exception | None) -> None:
        self._admission.leave(self._host)


def door() -> Admission:
    return Admission("the port", total=("connections", 100), per_host=100, log=LOG)


def listening(admission: Admission) -> tuple[ListeningSocket, int, socket.socket]:
    sock = bind_sockets("127.0.0.1")[0]
    port = sock.getsockname()[1]
    accepting = ListeningSocket(
        sock, lambda host: Echo(admission, host), admission=admission, log=LOG
    )
    return accepting, port, sock


@contextlib.contextmanager
def no_descriptors() -> Iterator[None]:
    """Let the process open nothing more."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    with open(os.devnull) as file:
        first_free = file.fileno()
    resource.setrlimit(resource.RLIMIT_NOFILE, (first_free, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_NOFILE, (soft, hard))


async def received(sock: socket.socket) -> bytes:
    async with asyncio.timeout(30):
        return await asyncio.get_running_loop().sock_recv(sock, 100)


async def test_without_descriptors_connections_wait_and_the_log_says_so_once(
    caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(accepting_module, "_PAUSE", 0.01)
    admission = door()
    accepting, port, _ = listening(admission)
    with contextlib.ExitStack() as stack:
        clients = [stack.enter_context(socket.socket()) for _ in range(30)]
        with no_descriptors():
            for client in clients:
                client.setblocking(False)
                with contextlib.suppress(BlockingIOError):
                    client.connect(("127.0.0.1", port))
            async with asyncio.timeout(30):
                while not caplog.records:
                    await asyncio.sleep(0.01)
            await asyncio.sleep(0.1)  # it tries again some times, and says nothing
        for client in clients:
            assert await received(client) == b"welcome"
    (record,) = caplog.records
    assert "the port: cannot accept connections: Too many open files" in record.getMessage()
    accepting.close()
    await accepting.wait_closed()


async def test_connections_that_are_being_accepted_while_it_closes_are_closed() -> None:
    admission = door()
    accepting, port, _ = listening(admission)
    with contextlib.ExitStack() as stack:
        clients = [stack.enter_context(socket.socket()) for _ in range(100)]
        for client in clients:
            client.connect(("127.0.0.1", port))  # never waits: the kernel accepts
            client.setblocking(False)
        await asyncio.sleep(0)  # the loop sees them
        accepting.close()
        await accepting.wait_closed()
        for client in clients:
            with contextlib.suppress(ConnectionResetError):
                assert await received(client) in (b"", b"welcome")
    async with asyncio.timeout(30):
        while admission.open:
            await asyncio.sleep(0.01)


async def test_what_is_refused_costs_no_transport() -> None:
    admission = Admission("the port", total=("connections", 0), per_host=100, log=LOG)
    accepting, port, _ = listening(admission)
    with socket.socket() as client:
        client.connect(("127.0.0.1", port))
        client.setblocking(False)
        with contextlib.suppress(ConnectionResetError):
            assert await received(client) == b""
    assert (admission.open, admission.refused) == (0, 1)
    accepting.close()
    accepting.close()
    await accepting.wait_closed()


async def test_a_process_that_was_forked_does_not_go_on_accepting() -> None:
    accepting, port, sock = listening(door())
    with subprocess.Popen(  # noqa: ASYNC220 - it has to inherit the socket
        [sys.executable, "-c", "input()"], stdin=subprocess.PIPE, pass_fds=[sock.fileno()]
    ) as child:
        accepting.close()
        await accepting.wait_closed()
        with socket.socket() as client, pytest.raises(ConnectionRefusedError):
            client.connect(("127.0.0.1", port))
        child.communicate(b"\n")
