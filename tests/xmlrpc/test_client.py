"""The client against our server, and against servers that misbehave."""

from __future__ import annotations

import asyncio
import gc

import pytest

import aioros1
from aioros1.net.hosts import bind_sockets
from aioros1.options import Limits, Timeouts
from aioros1.wire.xmlrpc import XmlRpcError, XmlRpcFault, decode_call, encode_response
from aioros1.xmlrpc.client import XmlRpcClient
from aioros1.xmlrpc.server import XmlRpcServer

from .scripted import answering, client, http, request, scripted

# ------------------------------------------------------------------------------- calls


async def test_calls_and_faults() -> None:
    server = XmlRpcServer({"echo": lambda *params: list(params)})
    await server.start("127.0.0.1")
    async with client() as ours:
        for uri in (f"http://127.0.0.1:{server.port}", f"http://localhost:{server.port}/"):
            assert await ours.call(uri, "echo", "/c", [1], {"a": b"x"}) == ["/c", [1], {"a": b"x"}]
            with pytest.raises(XmlRpcFault, match="is not supported"):
                await ours.call(uri, "nope")
        many = [ours.call(uri, "echo", n) for n in range(200)]
        assert await asyncio.gather(*many) == [[n] for n in range(200)]
    await server.close()


@pytest.mark.parametrize(("path", "expected"), [("", "/RPC2"), ("/", "/"), ("/x/y", "/x/y")])
async def test_requests_have_a_content_length_and_are_never_chunked(
    path: str, expected: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("http_proxy", "http://127.0.0.1:9")
    seen: list[tuple[str, dict[str, str], bytes]] = []

    async def script(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        while True:
            seen.append(await request(reader))
            writer.write(http(encode_response(len(seen)), "Set-Cookie: a=b"))

    async with scripted(script) as uri, client() as ours:
        uri = uri.rstrip("/") + path
        assert await ours.call(uri, "m", 1, any_path=True) == 1
        assert await ours.call(uri, "m", "ü" * 100_000, any_path=True) == 2
    for line, headers, _ in seen:
        assert line == f"POST {expected} HTTP/1.1"
        assert headers["content-type"] == "text/xml"
        assert not {"transfer-encoding", "accept-encoding", "cookie", "expect"} & set(headers)
    assert decode_call(seen[0][2]) == ("m", (1,))


async def test_parameters_that_cannot_be_sent() -> None:
    async with client() as ours:
        with pytest.raises(TypeError, match=r"params\[1\]"):
            await ours.call("http://127.0.0.1:1/", "m", "/c", None)


# ------------------------------------------------------------------------------- errors


async def test_nobody_listens() -> None:
    (sock,) = bind_sockets("127.0.0.1")
    port = sock.getsockname()[1]
    sock.close()
    async with client() as ours:
        with pytest.raises(
            ConnectionError, match=f"getPid at http://127.0.0.1:{port}/: cannot conn"
        ):
            await ours.call(f"http://127.0.0.1:{port}/", "getPid", "/c")
        with pytest.raises(ConnectionError, match="cannot connect"):
            await ours.call(f"http://localhost:{port}/", "getPid", "/c")


@pytest.mark.parametrize(
    "uri",
    [
        "",
        "nonsense",
        "https://h:1/",
        "rosrpc://h:1",
        "http://",
        "http://:1/",
        "http://h:x/",
        "http://[::/",
    ],
)
async def test_what_is_no_uri_of_a_node(uri: str) -> None:
    async with client() as ours:
        with pytest.raises(ConnectionError, match="is not the URI of a ROS node"):
            await ours.call(uri, "getPid", "/c")


async def test_no_answer_in_time() -> None:
    async with scripted(answering(b"")) as uri, client(timeouts=Timeouts(xmlrpc=0.1)) as ours:
        with pytest.raises(TimeoutError, match=rf"getPid at {uri}: no answer within 0.1 s"):
            await ours.call(uri, "getPid", "/c")
        with pytest.raises(TimeoutError, match=r"within 0\.05 s"):
            await ours.call(uri, "getPid", "/c", timeout=0.05)


@pytest.mark.parametrize(
    ("answer", "text"),
    [
        (http(b""), "empty"),  # roscpp, to a malformed request
        (http(b"no xml"), "not XML"),
        (http(b"<methodCall/>"), "expected a methodResponse"),
        (http(b"<!DOCTYPE x><methodResponse/>"), "document type"),
        (http(b"no", status="404 Not Found"), "status 404"),
        (http(b"", "Location: http://127.0.0.1:1/", status="302 Found"), "status 302"),
        (http(b"", status="500 Oops"), "status 500"),
        (b"SSH-2.0-OpenSSH_9\r\n\r\n", "not an HTTP answer"),
        (http(b"x" * 2000), "more than 1000 bytes"),
        (b"HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\n" + b"200\r\n" + b"x" * 512
         + b"\r\n200\r\n" + b"x" * 512 + b"\r\n0\r\n\r\n", "more than 1000 bytes"),
    ],
)  # fmt: skip
async def test_answers_that_are_nonsense(answer: bytes, text: str) -> None:
    limits = Limits(xmlrpc_bytes=1000)
    async with scripted(answering(answer)) as uri, client(limits=limits) as ours:
        with pytest.raises(XmlRpcError, match=text) as caught:
            await ours.call(uri, "getPid", "/c")
        assert f"getPid at {uri}" in str(caught.value)


@pytest.mark.parametrize("answer", [b"", b"HTTP/1.1 200 OK\r\nContent-Length: 100\r\n\r\nhalf"])
async def test_connection_lost(answer: bytes) -> None:
    count = 0

    async def script(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        nonlocal count
        count += 1
        await request(reader)
        writer.write(answer)

    async with scripted(script) as uri, client() as ours:
        with pytest.raises(ConnectionError, match="connection lost"):
            await ours.call(uri, "getPid", "/c")
    assert count == 1  # it may have been obeyed, and is not sent again


# ------------------------------------------------------------------------------- kept connections


async def test_a_connection_closed_while_idle_is_replaced_once() -> None:
    """The first request of a connection is answered; at the second it is closed."""
    connections = 0

    async def script(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        nonlocal connections
        connections += 1
        await request(reader)
        writer.write(http(encode_response(connections)))
        await reader.read(1)

    async with scripted(script) as uri, client() as ours:
        assert await ours.call(uri, "m") == 1
        assert await ours.call(uri, "m") == 2
        # Several kept connections, all of them stale.
        await asyncio.gather(*(ours.call(uri, "m") for _ in range(4)))
        before = connections
        await ours.call(uri, "m")
        assert connections == before + 1


async def test_a_second_loss_is_an_error() -> None:
    connections = 0

    async def script(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        nonlocal connections
        connections += 1
        await request(reader)
        if connections == 1:
            writer.write(http(encode_response(1)))
            await reader.read(1)

    async with scripted(script) as uri, client() as ours:
        assert await ours.call(uri, "m") == 1
        with pytest.raises(ConnectionError, match="connection lost"):
            await ours.call(uri, "m")
    assert connections == 2


async def test_server_that_was_restarted() -> None:
    server = XmlRpcServer({"m": lambda: 1})
    await server.start("127.0.0.1")
    port = server.port
    async with client() as ours:
        assert await ours.call(f"http://127.0.0.1:{port}", "m") == 1
        await server.close()
        server = XmlRpcServer({"m": lambda: 2})
        await server.start("127.0.0.1", port)
        assert await ours.call(f"http://127.0.0.1:{port}", "m") == 2
        await server.close()


# ------------------------------------------------------------------------------- life


async def test_cancelled_calls_leave_nothing() -> None:
    before = asyncio.all_tasks()
    arrived, left = asyncio.Event(), asyncio.Event()

    async def script(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        await request(reader)
        arrived.set()
        assert await reader.read() == b""
        left.set()

    async with scripted(script) as uri:
        ours = XmlRpcClient()
        call = asyncio.create_task(ours.call(uri, "m"))
        await arrived.wait()
        call.cancel()
        with pytest.raises(asyncio.CancelledError):
            await call
        await asyncio.wait_for(left.wait(), 10)
        await ours.close()
    await asyncio.sleep(0)
    assert asyncio.all_tasks() == before
    gc.collect()


async def test_closing_ends_calls_in_progress() -> None:
    arrived = asyncio.Event()

    async def script(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        await request(reader)
        arrived.set()
        await reader.read()

    async with scripted(script) as uri:
        ours = XmlRpcClient()
        call = asyncio.create_task(ours.call(uri, "m"))
        await arrived.wait()
        await ours.close()
        with pytest.raises(ConnectionError):
            await call
        with pytest.raises(aioros1.ClosedError, match="closed"):
            await ours.call(uri, "m")
        await ours.close()


async def test_a_client_that_was_never_used_needs_no_loop() -> None:
    await XmlRpcClient().close()
