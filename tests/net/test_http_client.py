"""The client's connections: every shape of an answer, and which connections are kept."""

from __future__ import annotations

import asyncio
import socket
import threading
import tracemalloc
import xmlrpc.server
from collections.abc import Iterator
from typing import Any

import pytest

from aioros1.net import connecting, http_client
from aioros1.net.http_client import PER_SERVER, server_at
from aioros1.options import Limits
from aioros1.wire.xmlrpc import XmlRpcError, decode_call, encode_response
from aioros1.xmlrpc.client import XmlRpcClient

from ..xmlrpc.scripted import client, request, scripted
from ..xmlrpc.scripted import http as http_answer

VALUE = [1, "", "x" * 100]
BODY = encode_response(VALUE)


def chunks(end: bytes = b"0\r\n\r\n") -> bytes:
    pieces = (BODY[at : at + 7] for at in range(0, len(BODY), 7))
    return b"".join(b"%x\r\n%b\r\n" % (len(piece), piece) for piece in pieces) + end


def head(*fields: str, version: str = "1.1") -> bytes:
    return "\r\n".join([f"HTTP/{version} 200 OK", *fields, "", ""]).encode()


LENGTH = f"Content-length: {len(BODY)}"
CHUNKED = "Transfer-Encoding: chunked"

KEEPING = {
    "roscpp": head("Server: XMLRPC++ 0.7", "Content-Type: text/xml", LENGTH) + BODY,
    "Node.js": head("Connection: keep-alive", CHUNKED) + chunks(),
    "chunks and a trailer": head(CHUNKED) + chunks(b"0\r\nX-Sum: 1\r\n\r\n"),
    "HTTP/1.0 that keeps": head("Connection: Keep-Alive", LENGTH, version="1.0") + BODY,
    "lines of LF": head(LENGTH.upper()).replace(b"\r", b"") + BODY,
    "interim answer": b"HTTP/1.1 100 Continue\r\n\r\n" + head(LENGTH) + BODY,
}
CLOSING = {
    "HTTP/1.0": head(LENGTH, version="1.0") + BODY,
    "HTTP/1.0, no length": head(version="1.0") + BODY,
    "no length": head() + BODY,
    "close": head("Connection: close", LENGTH) + BODY,
    "close after chunks": head("Connection: close", CHUNKED) + chunks(),
}


class Serving:
    """Answers every request on a connection with ``answer``, in pieces of ``size``."""

    def __init__(self, answer: bytes, *, size: int = 1 << 20, closes: bool = False) -> None:
        self.answer = answer
        self.size = size
        self.closes = closes
        self.connections = 0
        self.open = 0
        self.requests: list[Any] = []
        self._changed = asyncio.Event()

    async def __call__(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self.connections += 1
        self.open += 1
        self._changed.set()
        try:
            while True:
                _, _, body = await request(reader)
                self.requests.append(decode_call(body))
                self._changed.set()
                await self.respond(reader, writer)
                if self.closes:
                    return
        finally:
            self.open -= 1
            self._changed.set()

    async def respond(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        for at in range(0, len(self.answer), self.size):
            writer.write(self.answer[at : at + self.size])
            await writer.drain()

    async def until(self, *, open: int) -> None:
        async with asyncio.timeout(10):
            while self.open != open:
                self._changed.clear()
                await self._changed.wait()

    async def has_been_asked(self, count: int) -> None:
        async with asyncio.timeout(10):
            while len(self.requests) < count:
                self._changed.clear()
                await self._changed.wait()


class Stuck(Serving):
    """Answers ``answer`` and never the rest of it."""

    async def respond(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        await super().respond(reader, writer)
        await reader.read()


# ------------------------------------------------------------------------------- shapes


@pytest.mark.parametrize("size", [1, 64, 1 << 20])
@pytest.mark.parametrize("shape", KEEPING)
async def test_answers_after_which_the_connection_is_kept(shape: str, size: int) -> None:
    serving = Serving(KEEPING[shape], size=size)
    async with scripted(serving) as uri, client() as ours:
        for _ in range(3):
            assert await ours.call(uri, "m") == VALUE
    assert serving.connections == 1


@pytest.mark.parametrize("size", [1, 1 << 20])
@pytest.mark.parametrize("shape", CLOSING)
async def test_answers_after_which_it_is_not(shape: str, size: int) -> None:
    serving = Serving(CLOSING[shape], size=size, closes=True)
    async with scripted(serving) as uri, client() as ours:
        for count in range(1, 4):
            assert await ours.call(uri, "m", count) == VALUE
            assert serving.connections == len(serving.requests) == count


@pytest.fixture(params=["HTTP/1.0", "HTTP/1.1"])
def python_server(request: pytest.FixtureRequest) -> Iterator[str]:
    """The server of Python's library, which rospy's and rosmaster's are made of."""

    class Handler(xmlrpc.server.SimpleXMLRPCRequestHandler):
        protocol_version = request.param
        rpc_paths = ("/", "/RPC2")

    with xmlrpc.server.SimpleXMLRPCServer(("127.0.0.1", 0), Handler, logRequests=False) as server:
        server.register_function(lambda *params: list(params), "echo")
        thread = threading.Thread(target=server.serve_forever, args=(0.01,))
        thread.start()
        yield f"http://127.0.0.1:{server.server_address[1]}"
        server.shutdown()
        thread.join()


async def test_the_server_of_the_standard_library(python_server: str) -> None:
    async with client() as ours:
        for number in range(3):
            assert await ours.call(python_server, "echo", number) == [number]
        big = "x" * 3_000_000
        assert await ours.call(python_server, "echo", big) == [big]


async def test_answers_are_large_or_too_large() -> None:
    big = "x" * 20_000_000
    serving = Serving(http_answer(encode_response(big)))
    async with scripted(serving) as uri, client() as ours:
        assert await ours.call(uri, "m") == big
        assert await ours.call(uri, "m") == big
        assert serving.connections == 1
        async with client(limits=Limits(xmlrpc_bytes=1_000_000)) as careful:
            with pytest.raises(XmlRpcError, match="more than 1000000 bytes"):
                await careful.call(uri, "m")
            await serving.until(open=1)


# ------------------------------------------------------------------------------- requests


async def test_requests_are_sent_no_faster_than_they_are_read() -> None:
    go = asyncio.Event()

    async def script(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        await go.wait()
        _, _, body = await request(reader)
        writer.write(http_answer(encode_response(len(body))))
        await reader.read()

    async with scripted(script) as uri, client() as ours:
        text = "x" * 30_000_000
        call = asyncio.create_task(ours.call(uri, "m", text))
        while not (connections := list(ours._http._open)):
            await asyncio.sleep(0)
        transport = connections[0]._transport
        sizes = []
        for _ in range(50):
            await asyncio.sleep(0)
            sizes.append(transport.get_write_buffer_size())
        assert 0 < max(sizes) < 1_000_000
        go.set()
        assert await call > len(text)


@pytest.mark.parametrize("then", ["keeps", "closes"])
async def test_a_request_may_be_refused_before_it_has_come(then: str) -> None:
    served: list[str] = []

    async def script(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        await reader.readuntil(b"\r\n\r\n")
        writer.write(http_answer(b"no", status="413 Too Large"))
        served.append("refused")
        if then == "keeps":
            await asyncio.sleep(3600)
        while await reader.read(1 << 20):  # or the answer is lost with the connection
            pass
        served.append("closed")

    async with scripted(script) as uri, client() as ours:
        with pytest.raises(XmlRpcError, match="status 413"):
            await ours.call(uri, "m", "x" * 30_000_000)
        with pytest.raises(XmlRpcError, match="status 413"):
            await ours.call(uri, "m", 1)
    assert served.count("refused") == 2  # on two connections


async def test_small_requests_are_sent_at_once() -> None:
    async with scripted(Serving(KEEPING["roscpp"])) as uri, client() as ours:
        await ours.call(uri, "m")
        (connection,) = ours._http._open
        sock = connection._transport.get_extra_info("socket")
        assert sock.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY)


@pytest.mark.parametrize(
    ("uri", "expected"),
    [
        ("http://h:1", ("h", 1, "POST /RPC2 HTTP/1.1\r\nHost: h:1\r\n")),
        ("HTTP://Robot.Local:1/", ("robot.local", 1, "POST / HTTP/1.1\r\nHost: robot.local:1\r\n")),
        ("http://h/x?y=z", ("h", 80, "POST /x?y=z HTTP/1.1\r\nHost: h:80\r\n")),
        ("http://[::1]:1/", ("::1", 1, "POST / HTTP/1.1\r\nHost: [::1]:1\r\n")),
        ("http://h:1/ü b", ("h", 1, "POST /%C3%BC%20b HTTP/1.1\r\nHost: h:1\r\n")),
        ("http://ü:1", ("xn--tda", 1, "POST /RPC2 HTTP/1.1\r\nHost: xn--tda:1\r\n")),
        ("http://h:1/ x\r\nY: z", ("h", 1, "POST /%20xY:%20z HTTP/1.1\r\nHost: h:1\r\n")),
        ("http://a b:1/", ("a b", 1, "POST / HTTP/1.1\r\nHost: a%20b:1\r\n")),
    ],
)  # fmt: skip
def test_where_a_request_goes(uri: str, expected: tuple[str, int, str]) -> None:
    server = server_at(uri, any_path=True)
    assert (server.host, server.port) == expected[:2]
    assert server.head.decode().startswith(expected[2])


@pytest.mark.parametrize(
    ("uri", "path"),
    [
        ("http://h:1", "/RPC2"),
        ("http://h:1/RPC2", "/RPC2"),
        ("http://h:1/", "/"),
        ("http://h:1//", "/"),
        ("http://h:1/containers/x/kill", "/"),
        ("http://h:1/RPC2/../x", "/"),
        ("http://h:1/RPC2?x=y", "/"),
        ("http://h:1?x=y", "/"),
        ("http://h:1/x%0d%0aY: z", "/"),
    ],
)
def test_a_path_is_not_believed(uri: str, path: str) -> None:
    assert server_at(uri).head.decode().startswith(f"POST {path} HTTP/1.1\r\nHost: h:1\r\n")


async def test_a_uri_without_end_is_refused_and_leaves_nothing_behind() -> None:
    async with client() as ours:
        tracemalloc.start()
        try:
            for number in range(20):
                uri = f"http://127.0.0.1:1/{number}" + "x" * 1_000_000
                with pytest.raises(ConnectionError, match="is not the URI of a ROS node") as caught:
                    await ours.call(uri, "m")
                assert len(str(caught.value)) < 1_000
            assert tracemalloc.get_traced_memory()[0] < 5_000_000
        finally:
            tracemalloc.stop()


# ------------------------------------------------------------------------------- connections


async def test_connections_to_one_server_are_bounded() -> None:
    serving = Serving(KEEPING["roscpp"])
    async with scripted(serving) as uri, client() as ours:
        calls = [ours.call(uri, "m", number) for number in range(5 * PER_SERVER)]
        assert await asyncio.gather(*calls) == [VALUE] * len(calls)
    assert serving.connections == PER_SERVER


async def test_a_call_that_is_cancelled_while_it_waits_takes_no_place() -> None:
    serving = Stuck(b"")
    async with scripted(serving) as uri, client() as ours:
        calls = [asyncio.create_task(ours.call(uri, "m")) for _ in range(PER_SERVER)]
        await serving.has_been_asked(PER_SERVER)
        waiting = [asyncio.create_task(ours.call(uri, "late", n)) for n in range(3)]
        await asyncio.sleep(0)
        waiting[0].cancel()
        calls[0].cancel()
        await serving.has_been_asked(PER_SERVER + 1)
        assert serving.requests[-1] == ("late", (1,))
        for call in (*calls, *waiting):
            call.cancel()
        await asyncio.gather(*calls, *waiting, return_exceptions=True)
        await serving.until(open=0)


async def test_idle_connections_are_closed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(http_client, "IDLE", 0.02)
    serving = Serving(KEEPING["roscpp"])
    async with scripted(serving) as uri, client() as ours:
        assert await ours.call(uri, "m") == VALUE
        await serving.until(open=0)
        assert await ours.call(uri, "m") == VALUE
        assert len(serving.requests) == serving.connections == 2


async def test_what_nobody_has_asked_for_ends_a_connection() -> None:
    class Talking(Serving):
        async def respond(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
            await super().respond(reader, writer)
            writer.write(b"HTTP/1.1 408 Request Timeout\r\nContent-Length: 0\r\n\r\n")

    serving = Talking(KEEPING["roscpp"])
    async with scripted(serving) as uri, client() as ours:
        for count in range(1, 4):
            assert await ours.call(uri, "m", count) == VALUE
            await serving.until(open=0)
            assert len(serving.requests) == count


@pytest.mark.parametrize("answer", [b"H", b"HTTP/1.1 200 OK\r\n", KEEPING["roscpp"][:-1]])
async def test_a_request_whose_answer_has_begun_is_not_sent_again(answer: bytes) -> None:
    class Half(Serving):
        async def respond(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
            if len(self.requests) > 1:
                self.answer, self.closes = answer, True
            await super().respond(reader, writer)

    serving = Half(KEEPING["roscpp"])
    async with scripted(serving) as uri, client() as ours:
        assert await ours.call(uri, "m") == VALUE
        with pytest.raises(ConnectionResetError, match="connection lost"):
            await ours.call(uri, "m")
    assert len(serving.requests) == 2


async def test_a_request_that_cannot_be_repeated_fails() -> None:
    """Nobody listens any more when the kept connection turns out to be closed."""
    servers: list[asyncio.Server] = []

    async def serve(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        await request(reader)
        writer.write(http_answer(encode_response(1)))
        await reader.read(1)  # the second request
        servers[0].close()
        writer.close()

    servers.append(await asyncio.start_server(serve, "127.0.0.1", 0))
    async with client() as ours:
        uri = f"http://127.0.0.1:{servers[0].sockets[0].getsockname()[1]}/"
        assert await ours.call(uri, "m") == 1
        # A reset, not a plain refusal: it may have been received the first time.
        with pytest.raises(ConnectionResetError, match="cannot connect"):
            await ours.call(uri, "m")


@pytest.mark.parametrize("begun", [b"", b"HTTP/1.1 2", KEEPING["roscpp"][:-1]])
async def test_a_connection_of_a_cancelled_call_is_never_used_again(begun: bytes) -> None:
    serving = Stuck(begun)
    async with scripted(serving) as uri, client() as ours:
        call = asyncio.create_task(ours.call(uri, "m", 1))
        await serving.has_been_asked(1)
        await asyncio.sleep(0)
        call.cancel()
        with pytest.raises(asyncio.CancelledError):
            await call
        await serving.until(open=0)
        with pytest.raises(TimeoutError):
            await ours.call(uri, "m", 2, timeout=0.05)
        await serving.until(open=0)
    assert serving.connections == 2


async def test_after_a_call_without_an_answer_no_kept_connection_is_trusted() -> None:
    """When the way to a server is gone, all of them are dead, and say nothing of it."""

    class Failing(Serving):
        async def respond(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
            if self.requests[-1][0] == "stuck":
                await reader.read()
            await super().respond(reader, writer)

    serving = Failing(KEEPING["roscpp"])
    async with scripted(serving) as uri, client() as ours:
        await asyncio.gather(*(ours.call(uri, "m", count) for count in range(3)))
        assert serving.open == 3
        with pytest.raises(TimeoutError):
            await ours.call(uri, "stuck", timeout=0.05)
        await serving.until(open=0)
        assert await ours.call(uri, "m") == VALUE
        ours.close_idle()
        await serving.until(open=0)
        assert await ours.call(uri, "m") == VALUE
        assert serving.connections == 5


async def test_closing_ends_calls_wherever_they_are(monkeypatch: pytest.MonkeyPatch) -> None:
    serving = Stuck(b"")
    async with scripted(serving) as uri:
        ours = XmlRpcClient()
        calls = [asyncio.create_task(ours.call(uri, "m")) for _ in range(PER_SERVER + 2)]
        await serving.has_been_asked(PER_SERVER)
        looking_up = asyncio.Event()

        async def resolve(host: str) -> Any:
            looking_up.set()
            await asyncio.sleep(3600)

        monkeypatch.setattr(connecting, "resolve", resolve)
        calls.append(asyncio.create_task(ours.call("http://robot:1/", "m")))
        await looking_up.wait()
        await ours.close()
        assert all(call.done() for call in calls)
        for call in calls:
            with pytest.raises(ConnectionError, match="the client was closed"):
                await call
        await serving.until(open=0)


async def test_closing_does_not_wait_for_ever_for_a_transport(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    async with scripted(Serving(KEEPING["roscpp"])) as uri:
        ours = XmlRpcClient()
        await ours.call(uri, "m")
        with monkeypatch.context() as patch:
            patch.setattr(http_client, "CLOSING", 0.01)
            patch.setattr(http_client._Connection, "abort", lambda self: None)
            await ours.close()
        await ours.close()


async def test_names_that_nobody_knows(monkeypatch: pytest.MonkeyPatch) -> None:
    async def resolve(host: str) -> Any:
        raise socket.gaierror(socket.EAI_NONAME, "Name or service not known")

    monkeypatch.setattr(connecting, "resolve", resolve)
    async with client() as ours:
        with pytest.raises(
            ConnectionError, match=r"m at http://robot:1/: cannot connect: .* known"
        ):
            await ours.call("http://robot:1/", "m")
