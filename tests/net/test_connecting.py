"""Which of a host's addresses is connected to, and what becomes of the others."""

from __future__ import annotations

import asyncio
import socket
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import Any

import pytest

from aioros1.net import connecting
from aioros1.net.connecting import connect
from aioros1.net.hosts import bind_sockets

V4, V6 = socket.AF_INET, socket.AF_INET6


class Transport:
    def __init__(self) -> None:
        self.aborted = False

    def abort(self) -> None:
        self.aborted = True


class Network:
    """Addresses that behave as they are told, in place of the loop's connections."""

    def __init__(self, **addresses: Callable[[], Awaitable[Any]]) -> None:
        self.addresses = addresses
        self.tried: list[str] = []
        self.given_up: list[str] = []

    async def create_connection(
        self, factory: Any, host: str, port: int, *, family: socket.AddressFamily
    ) -> Any:
        self.tried.append(host)
        try:
            return await self.addresses[host](), host
        except asyncio.CancelledError:
            self.given_up.append(host)
            raise


async def silent() -> Any:
    await asyncio.sleep(3600)


async def refusing() -> Any:
    raise ConnectionRefusedError(111, "refused")


async def failing() -> Any:
    raise OSError(101, "unreachable")


async def accepting() -> Any:
    return Transport()


@pytest.fixture
def network(monkeypatch: pytest.MonkeyPatch) -> Callable[..., Network]:
    def make(**addresses: Callable[[], Awaitable[Any]]) -> Network:
        made = Network(**addresses)

        async def resolve(host: str) -> Any:
            return [(V6, address) for address in addresses]

        monkeypatch.setattr(connecting, "resolve", resolve)
        loop = asyncio.get_running_loop()
        monkeypatch.setattr(loop, "create_connection", made.create_connection, raising=False)
        return made

    return make


async def test_a_silent_address_does_not_hold_up_the_next(
    network: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(connecting, "STAGGER", 0.01)
    made = network(a=silent, b=silent, c=accepting, d=accepting)
    transport, host = await connect(asyncio.Protocol, "robot", 1)
    assert (host, made.tried) == ("c", ["a", "b", "c"])
    assert made.given_up == ["a", "b"] or made.given_up == ["b", "a"]
    assert not transport.aborted


async def test_after_a_refusal_the_next_is_tried_at_once(
    network: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(connecting, "STAGGER", 3600)
    made = network(a=refusing, b=accepting)
    assert (await connect(asyncio.Protocol, "robot", 1))[1] == "b"
    assert made.tried == ["a", "b"]


async def test_when_all_fail_the_error_says_why_each_did(network: Any) -> None:
    network(a=refusing, b=failing)
    with pytest.raises(OSError, match=r"refused, .*unreachable"):
        await connect(asyncio.Protocol, "robot", 1)
    for made in ({"a": refusing}, {"a": refusing, "b": refusing}):
        network(**made)
        with pytest.raises(ConnectionRefusedError, match=r"^\[Errno 111\] refused$"):
            await connect(asyncio.Protocol, "robot", 1)
    network()
    with pytest.raises(OSError, match="robot has no address"):
        await connect(asyncio.Protocol, "robot", 1)


async def test_the_second_of_two_that_answer_is_closed(
    network: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(connecting, "STAGGER", 0)
    go = asyncio.Event()
    made: list[Transport] = []

    async def late() -> Transport:
        await go.wait()
        made.append(Transport())
        return made[-1]

    network(a=late, b=late)
    call = asyncio.create_task(connect(asyncio.Protocol, "robot", 1))
    await asyncio.sleep(0.01)
    go.set()
    transport, _ = await call
    assert [each.aborted for each in made if each is not transport] == [True]
    assert not transport.aborted


async def test_a_cancelled_connect_leaves_no_attempt(
    network: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(connecting, "STAGGER", 0.01)
    made = network(a=silent, b=silent)
    call = asyncio.create_task(connect(asyncio.Protocol, "robot", 1))
    async with asyncio.timeout(10):
        while len(made.tried) < 2:
            await asyncio.sleep(0.001)
    call.cancel()
    with pytest.raises(asyncio.CancelledError):
        await call
    assert sorted(made.given_up) == ["a", "b"]


async def test_errors_of_another_kind_are_not_hidden(network: Any) -> None:
    async def broken() -> Any:
        raise ValueError("a mistake of ours")

    network(a=broken, b=accepting)
    with pytest.raises(ValueError, match="a mistake"):
        await connect(asyncio.Protocol, "robot", 1)


async def test_localhost_is_whichever_loopback_address_listens(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def getaddrinfo(*_: Any, **__: Any) -> Any:
        pytest.fail("asked the resolver")

    monkeypatch.setattr(socket, "getaddrinfo", getaddrinfo)
    for address in ("127.0.0.1", "::1"):
        try:
            (sock,) = bind_sockets(address)
        except OSError:
            pytest.skip("needs IPv6")
        with sock:
            transport, _ = await connect(asyncio.Protocol, "localhost", sock.getsockname()[1])
            assert transport.get_extra_info("peername")[0] == address
            transport.abort()
            await asyncio.sleep(0)
            await asyncio.sleep(0)


async def test_a_link_local_address_needs_its_interface() -> None:
    numeric = _link_local()
    if numeric is None:
        pytest.skip("needs a link-local address of IPv6")
    with socket.socket(V6, socket.SOCK_STREAM) as sock:
        sock.bind(("::", 0))
        sock.listen()
        for host in (numeric, f"[{numeric}]"):
            transport, _ = await connect(asyncio.Protocol, host, sock.getsockname()[1])
            assert transport.get_extra_info("peername")[0].partition("%")[0] in host
            transport.abort()
        port = sock.getsockname()[1]
    with pytest.raises(ConnectionRefusedError, match="refused"):
        await connect(asyncio.Protocol, numeric, port)
    await asyncio.sleep(0)


def _link_local() -> str | None:
    try:
        rows = [line.split() for line in Path("/proc/net/if_inet6").read_text().splitlines()]
    except OSError:
        return None
    for digits, _, _, scope, _, interface in rows:
        if scope == "20":
            return f"{socket.inet_ntop(V6, bytes.fromhex(digits))}%{interface}"
    return None
