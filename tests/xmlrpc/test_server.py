"""The HTTP server of masters and nodes, and how it calls their methods."""

from __future__ import annotations

import asyncio
import contextlib
import gzip
import logging
import re
import socket
from collections.abc import AsyncIterator, Callable, Mapping
from typing import Any

import pytest

from aioros1.net.allow import AllowList
from aioros1.options import Limits
from aioros1.wire.xmlrpc import XmlRpcFault, decode_response, encode_call
from aioros1.xmlrpc.server import Reply, XmlRpcServer

PING = encode_call("ping", ("/c",))


def ping(caller_id: str) -> list[Any]:
    return [1, "", caller_id]


@contextlib.asynccontextmanager
async def serving(
    methods: Mapping[str, Callable[..., Any]] | None = None,
    *,
    allow: list[str] | None = None,
    host: str = "127.0.0.1",
    **limits: Any,
) -> AsyncIterator[XmlRpcServer]:
    server = XmlRpcServer(
        {"ping": ping, **(methods or {})}, limits=Limits(**limits), allow=AllowList(allow)
    )
    await server.start(host)
    try:
        yield server
    finally:
        await server.close()


class Peer:
    """A client that says exactly what it is told to."""

    def __init__(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self.reader = reader
        self.writer = writer

    async def send(self, data: bytes) -> None:
        self.writer.write(data)
        await self.writer.drain()

    async def post(
        self, body: bytes, *headers: str, path: str = "/RPC2", version: str = "1.1"
    ) -> None:
        head = [f"POST {path} HTTP/{version}", "Host: x", *headers]
        if not any(re.match("content-length|transfer", line, re.IGNORECASE) for line in headers):
            head.append(f"Content-Length: {len(body)}")
        await self.send("\r\n".join([*head, "", ""]).encode() + body)

    async def answer(self) -> tuple[int, dict[str, str], bytes]:
        async with asyncio.timeout(10):
            head = (await self.reader.readuntil(b"\r\n\r\n")).decode().split("\r\n")
            headers = dict(line.lower().split(": ", 1) for line in head[1:] if line)
            status = int(head[0].split(" ")[1])
            return (
                status,
                headers,
                await self.reader.readexactly(int(headers.get("content-length", 0))),
            )

    async def value(self) -> Any:
        status, headers, body = await self.answer()
        assert (status, headers["content-type"]) == (200, "text/xml")
        return decode_response(body)

    async def closed(self) -> bool:
        """Whether the server closes the connection, without another byte."""
        async with asyncio.timeout(10):
            try:
                return await self.reader.read() == b""
            except ConnectionResetError:  # what had been sent was not read
                return True


@contextlib.asynccontextmanager
async def connected(server: XmlRpcServer, source: str = "127.0.0.1") -> AsyncIterator[Peer]:
    reader, writer = await asyncio.open_connection("127.0.0.1", server.port, local_addr=(source, 0))
    try:
        yield Peer(reader, writer)
    finally:
        writer.close()
        with contextlib.suppress(ConnectionError):
            await writer.wait_closed()


async def call(server: XmlRpcServer, method: str, *params: Any, source: str = "127.0.0.1") -> Any:
    async with connected(server, source) as peer:
        await peer.post(encode_call(method, params))
        return await peer.value()


async def still_serves(server: XmlRpcServer, source: str = "127.0.0.1") -> bool:
    return bool(await call(server, "ping", "/c", source=source) == [1, "", "/c"])


# ------------------------------------------------------------------------------- HTTP


async def test_http_1_0_is_answered_and_closed() -> None:
    async with serving() as server, connected(server) as peer:
        await peer.post(PING, version="1.0")
        assert await peer.value() == [1, "", "/c"]
        assert await peer.closed()


async def test_connections_are_kept_and_requests_may_be_pipelined() -> None:
    async with serving() as server, connected(server) as peer:
        for _ in range(3):
            await peer.post(PING)
            assert await peer.value() == [1, "", "/c"]
        request = b"POST / HTTP/1.1\r\nHost: x\r\nContent-Length: %d\r\n\r\n" % len(PING) + PING
        await peer.send(request * 100)
        for _ in range(100):
            assert await peer.value() == [1, "", "/c"]


async def test_chunked_bodies_are_accepted() -> None:
    async with serving() as server, connected(server) as peer:
        chunks = b"".join(b"1\r\n" + PING[i : i + 1] + b"\r\n" for i in range(len(PING)))
        await peer.post(chunks + b"0\r\n\r\n", "Transfer-Encoding: chunked")
        assert await peer.value() == [1, "", "/c"]


async def test_expect_100_continue_is_answered() -> None:
    async with serving() as server, connected(server) as peer:
        await peer.post(b"", "Expect: 100-continue", f"Content-Length: {len(PING)}")
        status, _, _ = await peer.answer()
        assert status == 100
        await peer.send(PING)
        assert await peer.value() == [1, "", "/c"]


@pytest.mark.parametrize(
    ("header", "expected"),
    [("X-No: length", 411), ("Content-Length: ten", 400), ("Content-Length: -5", 400)],
)
async def test_a_missing_or_malformed_content_length_is_refused(header: str, expected: int) -> None:
    async with serving() as server, connected(server) as peer:
        await peer.send(f"POST / HTTP/1.1\r\nHost: x\r\n{header}\r\n\r\n".encode())
        status, _, _ = await peer.answer()
        assert status == expected
        assert await peer.closed()
        assert await still_serves(server)


async def test_a_body_beyond_the_limit_is_refused() -> None:
    async with serving(xmlrpc_bytes=1000) as server:
        async with connected(server) as peer:
            await peer.post(b"", f"Content-Length: {10**12}")
            status, _, _ = await peer.answer()
            assert status == 413
        async with connected(server) as peer:
            await peer.post(b"400\r\n" + b" " * 1024 + b"\r\n", "Transfer-Encoding: chunked")
            status, _, _ = await peer.answer()
            assert status == 413
        assert await still_serves(server)


async def test_a_body_that_never_arrives_times_out() -> None:
    async with serving(xmlrpc_timeout=0.2) as server, connected(server) as peer:
        await peer.post(PING[:10], f"Content-Length: {len(PING)}")
        assert await still_serves(server)  # meanwhile
        status, _, _ = await peer.answer()
        assert status == 408
        assert await peer.closed()


async def test_a_head_that_never_ends_times_out() -> None:
    async with serving(xmlrpc_timeout=0.2) as server, connected(server) as peer:
        await peer.send(b"POST / HTTP/1.1\r\nHost:")
        assert await still_serves(server)
        status, _, _ = await peer.answer()
        assert status == 408
        assert await peer.closed()


async def test_idle_connections_are_kept_longer_than_requests_may_take() -> None:
    async with serving(xmlrpc_timeout=0.1) as server, connected(server) as peer:
        await peer.post(PING)
        await peer.value()
        with pytest.raises(TimeoutError):
            await asyncio.wait_for(peer.reader.read(1), 0.4)
        await peer.post(PING)
        assert await peer.value() == [1, "", "/c"]


async def test_answer_that_is_never_read() -> None:
    big = "x" * (32 << 20)
    async with (
        serving({"big": lambda: big}, xmlrpc_timeout=0.2) as server,
        connected(server) as peer,
    ):
        await peer.post(encode_call("big", ()))
        assert await still_serves(server)
        async with asyncio.timeout(30):
            while server.admission.open:
                await asyncio.sleep(0.01)
            with contextlib.suppress(ConnectionError):
                data = await peer.reader.read(-1)
                assert len(data) < len(big)


@pytest.mark.parametrize("method", ["GET", "PUT", "HEAD", "DELETE"])
async def test_only_post_is_allowed(method: str) -> None:
    async with serving() as server, connected(server) as peer:
        await peer.send(f"{method} / HTTP/1.1\r\nHost: x\r\n\r\n".encode())
        status, _, _ = await asyncio.wait_for(peer.answer() if method != "HEAD" else head(peer), 10)
        assert status == 405
        await peer.post(PING)
        assert await peer.value() == [1, "", "/c"]


async def head(peer: Peer) -> tuple[int, dict[str, str], bytes]:
    line = (await peer.reader.readuntil(b"\r\n\r\n")).split(b" ")
    return int(line[1]), {}, b""


@pytest.mark.parametrize("path", ["/", "/RPC2", "/RPC2?x=1", "/other", "/RPC2/", "/a%20b", "/ü"])
async def test_any_path_is_served(path: str) -> None:
    async with serving() as server, connected(server) as peer:
        for each in (path, "/RPC2"):
            await peer.post(PING, path=each)
            assert await peer.value() == [1, "", "/c"]


@pytest.mark.parametrize("header", ["Content-Type: application/json", "X: y"])
async def test_content_type_does_not_matter(header: str) -> None:
    async with serving() as server, connected(server) as peer:
        await peer.post(PING, header)
        assert await peer.value() == [1, "", "/c"]


async def test_a_gzipped_body_is_accepted() -> None:
    async with serving() as server, connected(server) as peer:
        await peer.post(gzip.compress(PING), "Content-Encoding: gzip")
        assert await peer.value() == [1, "", "/c"]


@pytest.mark.parametrize(
    ("body", "coding", "expected"),
    [
        (gzip.compress(b" " * 10_000_000), "gzip", 413),
        (gzip.compress(PING)[:-10], "gzip", 400),
        (b"no gzip", "gzip", 400),
        (PING, "br", 415),
    ],
    ids=["too large inside", "cut short", "no gzip", "another coding"],
)
async def test_bad_gzip_and_other_codings_are_refused(
    body: bytes, coding: str, expected: int
) -> None:
    async with serving(xmlrpc_bytes=100_000) as server, connected(server) as peer:
        await peer.post(body, f"Content-Encoding: {coding}")
        status, _, _ = await peer.answer()
        assert status == expected
        assert await still_serves(server)


@pytest.mark.parametrize(
    "garbage",
    [
        b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + bytes(64),
        b"NO SUCH THING\r\n\r\n",
        b"POST / HTTP/1.1\r\nX: " + b"y" * 100_000 + b"\r\n\r\n",
        b"\r\n" * 10 + b"\x00\r\n\r\n",
    ],
    ids=["tls", "text", "100 kB header", "zeros"],
)
async def test_garbage_is_answered_or_closed_and_does_no_harm(
    garbage: bytes, caplog: pytest.LogCaptureFixture
) -> None:
    async with serving(xmlrpc_timeout=0.3) as server, connected(server) as peer:
        with contextlib.suppress(ConnectionError):
            await peer.send(garbage)
            status, _, _ = await peer.answer()
            assert status in (400, 408, 431)
            assert await peer.closed()
        assert await still_serves(server)
    assert [record for record in caplog.records if record.levelno >= logging.WARNING] == []


# What the standard does not allow, and the servers of ROS 1 take.

LENGTH = b"Content-Length: %d" % len(PING)
ODD_HEADS = {
    "line feeds": b"POST / HTTP/1.1\nHost: x\n" + LENGTH + b"\n\n",
    "a line feed at the end": b"POST / HTTP/1.1\r\nHost: x\r\n" + LENGTH + b"\r\n\n",
    "some line feeds": b"POST / HTTP/1.1\r\nHost: x\n" + LENGTH + b"\r\n\r\n",
    "folded": b"POST / HTTP/1.1\r\nHost: x\r\nX: a\r\n\tb\r\n  c\r\n" + LENGTH + b"\r\n\r\n",
    "folded length": b"POST / HTTP/1.1\nContent-Length:\n %d\nHost: x\n\n" % len(PING),
    "blank before colon": b"POST / HTTP/1.1\r\nHost: x\r\nContent-Length : %d\r\n\r\n" % len(PING),
    "empty lines before": b"\n\nPOST / HTTP/1.1\nHost: x\n" + LENGTH + b"\n\n",
    "no host": b"POST / HTTP/1.1\r\n" + LENGTH + b"\r\n\r\n",
    "9 kB line": b"POST / HTTP/1.1\r\nX: " + b"x" * 9000 + b"\r\n" + LENGTH + b"\r\n\r\n",
    "30 kB line": b"POST / HTTP/1.1\r\nX: " + b"x" * 30000 + b"\r\n" + LENGTH + b"\r\n\r\n",
    "9 kB path": b"POST /" + b"x" * 9000 + b" HTTP/1.1\r\n" + LENGTH + b"\r\n\r\n",
    "7 kB path, 60 lines": b"POST /"
    + b"x" * 7000
    + b" HTTP/1.1\r\n"
    + b"".join(b"X-%d: %d\r\n" % (number, number) for number in range(60))
    + LENGTH
    + b"\r\n\r\n",
    "letters": b"POST / HTTP/1.1\r\nhOST: x\r\ncONTENT-lENGTH:%d\r\n\r\n" % len(PING),
    "latin-1": b"POST / HTTP/1.1\r\nX: gr\xfc\xdfe\r\n" + LENGTH + b"\r\n\r\n",
}


@pytest.mark.parametrize("how", ["at once", "in pieces", "pipelined", "half-closed"])
@pytest.mark.parametrize("head", ODD_HEADS.values(), ids=ODD_HEADS.keys())
async def test_odd_heads_are_taken(head: bytes, how: str) -> None:
    async with serving() as server, connected(server) as peer:
        if how == "pipelined":
            await peer.send((head + PING) * 3)
        elif how == "in pieces":
            for begin in range(0, len(head), max(7, len(head) // 20)):
                await peer.send(head[begin : begin + max(7, len(head) // 20)])
                await asyncio.sleep(0)
            await peer.send(PING[:9])
            await asyncio.sleep(0)
            await peer.send(PING[9:])
        else:
            await peer.send(head + PING)
        if how == "half-closed":
            peer.writer.write_eof()
        for _ in range(3 if how == "pipelined" else 1):
            assert await peer.value() == [1, "", "/c"]
        if how == "half-closed":
            assert await peer.closed()
        else:
            await peer.send(head + PING)
            assert await peer.value() == [1, "", "/c"]


@pytest.mark.parametrize("requests", [1, 3])
@pytest.mark.parametrize("in_pieces", [False, True])
async def test_a_client_that_closes_its_side_gets_its_answers(
    requests: int, in_pieces: bool
) -> None:
    async with serving() as server, connected(server) as peer:
        for _ in range(requests):
            await peer.post(PING)
            if in_pieces:
                assert await peer.value() == [1, "", "/c"]
        peer.writer.write_eof()
        if not in_pieces:
            for _ in range(requests):
                assert await peer.value() == [1, "", "/c"]
        assert await peer.closed()
        assert await still_serves(server)


async def test_a_client_that_closes_its_side_waits_for_a_slow_method() -> None:
    begun, go = asyncio.Event(), asyncio.Event()

    async def slow(caller_id: str) -> Any:
        begun.set()
        await go.wait()
        return [1, "", caller_id]

    async with serving({"slow": slow}) as server, connected(server) as peer:
        await peer.post(encode_call("slow", ["/c"]))
        peer.writer.write_eof()
        await begun.wait()
        go.set()
        assert await peer.value() == [1, "", "/c"]
        assert await peer.closed()


@pytest.mark.parametrize(
    "half",
    [b"", b"POST / HT", b"POST / HTTP/1.1\r\nHost: x\r\n", b"POST / HTTP/1.1\n", b"\n"],
)
async def test_a_client_that_closes_its_side_too_early_is_closed(half: bytes) -> None:
    async with serving(xmlrpc_timeout=3600) as server, connected(server) as peer:
        await peer.send(half)
        peer.writer.write_eof()
        assert await peer.closed()


async def test_half_a_body_is_closed_with_its_client() -> None:
    async with serving(xmlrpc_timeout=3600) as server, connected(server) as peer:
        await peer.post(PING[:10], f"Content-Length: {len(PING)}")
        peer.writer.write_eof()
        assert await peer.closed()


@pytest.mark.parametrize("line", [b"x" * 30_000 + b"\r\n", b"x", b"X: y\r\n", b"X: y\n"])
async def test_a_head_without_an_end_is_refused(line: bytes) -> None:
    async with serving(xmlrpc_timeout=3600) as server, connected(server) as peer:
        with contextlib.suppress(ConnectionError):
            await peer.send(b"POST / HTTP/1.1\r\nX: ")
            for _ in range(100_000 // len(line)):
                await peer.send(line)
        with contextlib.suppress(ConnectionError):
            status, _, _ = await peer.answer()
            assert status in (400, 431)
            assert await peer.closed()
        assert await still_serves(server)


async def test_many_half_sent_requests_hold_nobody() -> None:
    async with serving() as server, contextlib.AsyncExitStack() as stack:
        for _ in range(50):
            peer = await stack.enter_async_context(connected(server))
            await peer.post(b"<", "Content-Length: 100")
        assert await still_serves(server)


# ------------------------------------------------------------------------------- calls


async def test_malformed_xml_is_a_fault_with_status_200() -> None:
    async with serving() as server, connected(server) as peer:
        for body in (b"", b"<methodCall>", b"<!DOCTYPE x><methodCall/>"):
            await peer.post(body)
            with pytest.raises(XmlRpcFault) as caught:
                await peer.value()
            assert caught.value.code == -32700


@pytest.mark.parametrize("name", ["nope", "_methods", "__init__", "ping.__call__", "", "start"])
async def test_unknown_methods_are_faults(name: str) -> None:
    async with serving() as server:
        with pytest.raises(XmlRpcFault, match="is not supported"):
            await call(server, name, "/c")


async def test_multicall_answers_each_call_by_itself() -> None:
    async def slow(caller_id: str) -> list[Any]:
        await asyncio.sleep(0)
        return [1, "slow", caller_id]

    def fails(caller_id: str) -> None:
        raise XmlRpcFault(7, "no")

    async with serving({"slow": slow, "fails": fails}) as server:
        results = await call(
            server,
            "system.multicall",
            [
                {"methodName": "ping", "params": ["/a"]},
                {"methodName": "slow", "params": ["/b"]},
                {"methodName": "nope", "params": []},
                {"methodName": "fails", "params": ["/c"]},
                {"methodName": "ping", "params": []},
                {"methodName": "system.multicall", "params": [[]]},
                {"methodName": "ping"},
                {"methodName": 5, "params": []},
                "ping",
                *[{"methodName": "ping", "params": ["/z"]}] * 100,
            ],
        )
        assert results[:2] == [[[1, "", "/a"]], [[1, "slow", "/b"]]]
        assert [result["faultCode"] for result in results[2:4]] == [-32601, 7]
        assert results[4] == [[-1, "missing required caller_id parameter", 0]]
        assert [result["faultCode"] for result in results[5:9]] == [-32602] * 4
        assert results[9:] == [[[1, "", "/z"]]] * 100


@pytest.mark.parametrize("params", [(), (1,), ([], [])])
async def test_multicall_takes_one_array(params: tuple[Any, ...]) -> None:
    async with serving() as server:
        with pytest.raises(XmlRpcFault, match="takes one array"):
            await call(server, "system.multicall", *params)


async def test_a_wrong_number_of_parameters_is_refused() -> None:
    def several(caller_id: str, a: int, b: int = 2, /, *, c: int = 3) -> list[Any]:
        raise TypeError("from inside")

    async with serving({"several": several, "any": lambda *all: list(all)}) as server:
        code, text, value = await call(server, "ping", "/c", 2)
        assert (code, value) == (-1, 0)
        assert "ping takes 1 parameters" in text
        assert (await call(server, "several", "/c"))[1].endswith("several takes 2 to 3 parameters")
        assert await call(server, "several") == [-1, "missing required caller_id parameter", 0]
        assert await call(server, "any", 1, 2) == [1, 2]
        with pytest.raises(XmlRpcFault, match="TypeError: from inside"):
            await call(server, "several", "/c", 1)


async def test_methods_that_fail_do_not_end_the_server(caplog: pytest.LogCaptureFixture) -> None:
    async def broken() -> None:
        raise RuntimeError("it <broke>")

    async with serving({"broken": broken, "none": lambda: None}) as server:
        with pytest.raises(XmlRpcFault, match="RuntimeError: it <broke>"):
            await call(server, "broken")
        with pytest.raises(XmlRpcFault, match="no type for None"):
            await call(server, "none")
        assert await still_serves(server)
    assert [record.levelname for record in caplog.records] == ["ERROR", "ERROR"]


async def test_reply_answers_first_and_acts_then() -> None:
    done = asyncio.Event()

    async def method() -> Reply:
        return Reply([1, "bye", 0], after=done.set)

    def wrong() -> Reply:
        return Reply(1, after=lambda: 1 // 0)

    async with serving({"shutdown": method, "wrong": wrong}) as server:
        assert await call(server, "shutdown") == [1, "bye", 0]
        await asyncio.wait_for(done.wait(), 10)
        done.clear()
        entry = {"methodName": "shutdown", "params": []}
        assert await call(server, "system.multicall", [entry]) == [[[1, "bye", 0]]]
        await asyncio.wait_for(done.wait(), 10)
        assert await call(server, "wrong") == 1
        assert await still_serves(server)


async def test_reply_acts_even_if_nobody_reads_the_answer() -> None:
    done = asyncio.Event()
    asked = asyncio.Event()
    gone = asyncio.Event()

    async def method() -> Reply:
        asked.set()
        await gone.wait()
        return Reply("x" * 10_000_000, after=done.set)

    async with serving({"shutdown": method}, xmlrpc_timeout=0.5) as server:
        async with connected(server) as peer:
            await peer.post(encode_call("shutdown", ()))
            await asked.wait()
            peer.writer.transport.abort()
        gone.set()
        await asyncio.wait_for(done.wait(), 10)


# ------------------------------------------------------------------------------- life


async def test_closing_leaves_nothing_behind() -> None:
    before = asyncio.all_tasks()
    server = XmlRpcServer({"ping": ping, "hang": lambda: asyncio.sleep(3600)})
    await server.start("127.0.0.1")
    async with connected(server) as idle, connected(server) as hung, connected(server) as half:
        await idle.post(PING)
        await idle.value()
        await hung.post(encode_call("hang", ()))
        await half.send(b"POST / HT")
        await still_serves(server)
        await server.close(timeout=0.05)
        assert asyncio.all_tasks() == before
        for peer in (idle, hung, half):
            with contextlib.suppress(ConnectionError):
                assert await peer.closed()
    with pytest.raises(ConnectionError):
        await asyncio.open_connection("127.0.0.1", server.port)
    await server.close()


async def test_a_method_cannot_close_its_server() -> None:
    async def method() -> None:
        await server.close()

    async with serving({"method": method}) as server:
        with pytest.raises(XmlRpcFault, match="cannot close its own server"):
            await call(server, "method")
        assert await still_serves(server)


async def test_requests_in_progress_may_finish() -> None:
    asked, go = asyncio.Event(), asyncio.Event()

    async def method() -> int:
        asked.set()
        await go.wait()
        return 5

    server = XmlRpcServer({"method": method})
    await server.start("127.0.0.1")
    async with connected(server) as peer:
        await peer.post(encode_call("method", ()))
        await asked.wait()
        closing = asyncio.create_task(server.close(timeout=30))
        await asyncio.sleep(0)
        go.set()
        assert await peer.value() == 5
        await closing


async def test_a_server_starts_once_and_says_why_it_cannot() -> None:
    async with serving() as server:
        with pytest.raises(RuntimeError):
            await server.start("127.0.0.1")
        other = XmlRpcServer({})
        with pytest.raises(OSError, match="cannot listen"):
            await other.start("127.0.0.1", server.port)
        await other.close()
    await XmlRpcServer({}).close()


async def test_a_connection_that_is_just_being_accepted_is_closed_too() -> None:
    """The kernel has it, and asyncio begins to take it, when the server closes."""
    server = XmlRpcServer({})
    await server.start("127.0.0.1")
    with contextlib.ExitStack() as stack:
        clients = [stack.enter_context(socket.socket()) for _ in range(20)]
        for client in clients:
            client.connect(("127.0.0.1", server.port))  # never waits: the kernel accepts
        await asyncio.sleep(0)  # the loop sees them
        await server.close()
        for client in clients:
            client.settimeout(20)
            with contextlib.suppress(ConnectionResetError):
                assert await asyncio.to_thread(client.recv, 1) == b""
