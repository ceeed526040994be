"""What an XML-RPC server does with too much, or from the wrong place; others are served."""

from __future__ import annotations

import asyncio
import contextlib
import socket
import sys
from collections.abc import AsyncIterator, Callable
from typing import Any

import pytest

from aioros1.wire.xmlrpc import XmlRpcFault, encode_call
from aioros1.xmlrpc.server import XmlRpcServer

from .test_server import PING, call, connected, serving, still_serves

ELSEWHERE = "127.0.0.2"
several_hosts = pytest.mark.skipif(
    sys.platform != "linux", reason="needs a loopback network with more than one address"
)


@pytest.fixture
def each_address_is_a_host(monkeypatch: pytest.MonkeyPatch) -> None:
    """As if the loopback addresses were different machines."""
    monkeypatch.setattr("aioros1.net.admission.host_of", str)
    monkeypatch.setattr("aioros1.net.admission.is_local", lambda address: False)


async def until(condition: Callable[[], bool]) -> None:
    async with asyncio.timeout(10):
        while not condition():
            await asyncio.sleep(0.002)


# ------------------------------------------------------------------- who may connect


@several_hosts
async def test_a_host_that_is_not_allowed_is_closed_before_a_byte_is_read() -> None:
    calls = []
    async with serving({"count": calls.append}, allow=["127.0.0.1"]) as server:
        async with connected(server, ELSEWHERE) as peer:
            with contextlib.suppress(ConnectionError):
                await peer.post(encode_call("count", ("/c",)))
            assert await peer.closed()
            assert await still_serves(server)
        assert (server.admission.forbidden, server.admission.refused, calls) == (1, 0, [])


async def test_an_empty_list_is_nobody() -> None:
    async with serving(allow=[]) as server, connected(server) as peer:
        assert await peer.closed()


@pytest.mark.skipif(not socket.has_dualstack_ipv6(), reason="needs IPv6")
@pytest.mark.parametrize(("allow", "is_allowed"), [("127.0.0.0/8", True), ("::/0", False)])
async def test_ipv4_over_a_socket_for_both_is_ipv4(allow: str, is_allowed: bool) -> None:
    async with serving(allow=[allow], host="::") as server:
        if is_allowed:
            assert await still_serves(server)
        else:
            async with connected(server) as peer:
                assert await peer.closed()


async def test_who_was_turned_away_leaves_nothing_behind() -> None:
    before = asyncio.all_tasks()
    async with serving(allow=[]) as server:
        for _ in range(50):
            async with connected(server) as peer:
                assert await peer.closed()
        assert asyncio.all_tasks() == before
        assert (server.admission.open, server.admission.forbidden) == (0, 50)


@pytest.mark.parametrize("origin", ["http://evil.example", "http://127.0.0.1:11311", "null", ""])
async def test_web_pages_are_refused(origin: str) -> None:
    calls: list[str] = []
    async with serving({"shutdown": calls.append}) as server, connected(server) as peer:
        await peer.post(
            encode_call("shutdown", ("/c",)), f"Origin: {origin}", "Content-Type: text/plain"
        )
        assert (await peer.answer())[0] == 403
        assert await peer.closed()
        assert calls == []
        assert await still_serves(server)


# ------------------------------------------------------------------- how many


async def test_connections_beyond_the_limit_are_closed_and_counted() -> None:
    async with serving(xmlrpc_connections=2) as server, connected(server) as one:
        async with connected(server) as two:
            for peer in (one, two):
                await peer.post(PING)
                assert await peer.value() == [1, "", "/c"]
            async with connected(server) as three:
                assert await three.closed()
            await one.post(PING)
            assert await one.value() == [1, "", "/c"]
            assert server.admission.refused == 1
        await until(lambda: server.admission.open == 1)
        assert await still_serves(server)


@several_hosts
@pytest.mark.usefixtures("each_address_is_a_host")
async def test_connections_of_one_host_beyond_its_limit() -> None:
    async with (
        serving(connections_per_host=2) as server,
        connected(server) as one,
        connected(server),
    ):
        async with connected(server) as three:
            assert await three.closed()
        assert await still_serves(server, ELSEWHERE)
        await one.post(PING)
        assert await one.value() == [1, "", "/c"]
        assert server.admission.refused == 1


# ------------------------------------------------------------------- how often


@contextlib.asynccontextmanager
async def asking(server: XmlRpcServer) -> AsyncIterator[asyncio.Task[Any]]:
    """A request whose answer is waited for."""
    async with connected(server) as peer:
        await peer.post(PING)
        task = asyncio.create_task(peer.value())
        try:
            yield task
        finally:
            task.cancel()
            await asyncio.wait({task})


NEVER: dict[str, Any] = {"requests_per_second": 0.001}


@several_hosts
@pytest.mark.usefixtures("each_address_is_a_host")
async def test_requests_beyond_the_limit_wait_and_other_hosts_do_not() -> None:
    async with serving(**NEVER, requests_burst=2) as server:
        assert await still_serves(server)
        assert await still_serves(server)
        assert server.delayed == 0
        async with asking(server) as third:
            await until(lambda: server.delayed == 1)
            assert await still_serves(server, ELSEWHERE)
            assert not third.done()


async def test_requests_that_waited_are_answered() -> None:
    async with serving(requests_per_second=50, requests_burst=1) as server:
        for _ in range(5):
            assert await still_serves(server)
        assert 0 < server.delayed < 5


async def test_requests_that_are_refused_count_as_well() -> None:
    async with serving(**NEVER, requests_burst=1) as server:
        async with connected(server) as peer:
            await peer.send(b"GET / HTTP/1.1\r\n\r\n")
            assert (await peer.answer())[0] == 405
        async with asking(server):
            await until(lambda: server.delayed == 1)


async def test_calls_inside_a_multicall_count() -> None:
    ping = {"methodName": "ping", "params": ["/c"]}
    async with serving(**NEVER, requests_burst=4) as server:
        assert len(await call(server, "system.multicall", [ping] * 3)) == 3
        assert await still_serves(server)
        async with asking(server):
            await until(lambda: server.delayed == 1)


async def test_a_peer_that_does_not_wait_for_its_answer_is_forgotten() -> None:
    calls: list[str] = []
    async with serving({"count": calls.append}, **NEVER, requests_burst=1) as server:
        tasks = asyncio.all_tasks()
        assert await still_serves(server)
        for count in range(20):
            async with connected(server) as peer:
                await peer.post(encode_call("count", ("/c",)))
                await until(lambda count=count: server.delayed == count + 1)
        await until(lambda: server.admission.open == 0 and asyncio.all_tasks() <= tasks)
        assert calls == []
        # Nor does anybody else wait for them: 20 tokens are 20,000 seconds.
        assert server._rate is not None
        now = asyncio.get_running_loop().time()
        assert server._rate.take("127.0.0.1", now) <= 1000


@several_hosts
@pytest.mark.usefixtures("each_address_is_a_host")
async def test_nothing_is_read_without_end_from_who_waits() -> None:
    request = b"POST / HTTP/1.1\r\nHost: x\r\nContent-Length: %d\r\n\r\n" % len(PING) + PING
    async with serving(**NEVER, requests_burst=50) as server, connected(server) as peer:
        flood = asyncio.create_task(peer.send(request * (20_000_000 // len(request))))
        await until(lambda: server.delayed == 1)
        for _ in range(50):
            assert await still_serves(server, ELSEWHERE)
        assert not flood.done()
        peer.writer.transport.abort()
        await asyncio.wait({flood})
        assert isinstance(flood.exception(), ConnectionError | None)


async def test_closing_does_not_wait_for_who_waits() -> None:
    before = asyncio.all_tasks()
    async with serving(**NEVER, requests_burst=1) as server:
        assert await still_serves(server)
        async with connected(server) as peer:
            await peer.post(PING)
            await until(lambda: server.delayed == 1)
            await server.close(timeout=3600)
            assert await peer.closed()
            assert asyncio.all_tasks() == before


# ------------------------------------------------------------------- what is in them


async def test_values_beyond_the_limit() -> None:
    async with serving({"len": len}, xmlrpc_values=1001) as server:
        assert await call(server, "len", [0] * 1000) == 1000
        with pytest.raises(XmlRpcFault, match="more than 1001 values") as caught:
            await call(server, "len", [0] * 1001)
        assert caught.value.code == -32700
        assert await still_serves(server)


async def test_answers_that_are_never_read_do_not_pile_up() -> None:
    calls = 0

    def answer() -> str:
        nonlocal calls
        calls += 1
        return "x" * 40_000

    request = encode_call("answer", ())
    head = b"POST / HTTP/1.1\r\nHost: x\r\nContent-Length: %d\r\n\r\n" % len(request)
    async with (
        serving({"answer": answer}, xmlrpc_timeout=0.5) as server,
        connected(server) as peer,
    ):
        peer.reader._transport.pause_reading()  # type: ignore[attr-defined]
        with contextlib.suppress(ConnectionError):
            await peer.send((head + request) * 3000)
        await until(lambda: server.admission.open == 0)  # its patience is over
        assert calls < 1500
        assert await still_serves(server)
