"""Masters and nodes whose answers are not quite as written down, and are taken all the same."""

from __future__ import annotations

import asyncio
import gzip
from typing import Any

import pytest

from aioros1.errors import MasterError, PeerError, PeerUnreachable
from aioros1.wire.xmlrpc import XmlRpcError, encode_response
from aioros1.xmlrpc.client import XmlRpcClient
from aioros1.xmlrpc.master_proxy import MasterProxy
from aioros1.xmlrpc.node_proxy import BusInfo, NodeProxy

from .scripted import answering, client, http, request, scripted


def response(*values: str) -> bytes:
    params = "".join(f"<param><value>{each}</value></param>" for each in values)
    return f"<methodResponse><params>{params}</params></methodResponse>".encode()


def array(*values: str) -> str:
    data = "".join(f"<value>{each}</value>" for each in values)
    return f"<array><data>{data}</data></array>"


ONE, STATUS, PID = "<int>1</int>", "fine", "<int>77</int>"


@pytest.mark.parametrize(
    "body",
    [
        response(ONE, STATUS, PID),  # alpyro
        response(array("<boolean>1</boolean>", STATUS, PID)),
        response(array("<double>1.0</double>", STATUS, PID)),
        response(array("<i8>1</i8>", STATUS, PID)),
        response(array(ONE, "<ex:nil/>", PID)),
        response(array(ONE, STATUS, PID, "more")),
        response(array(ONE, "<int>0</int>", PID)),
        b"<?xml version='1.0' encoding='cp1252'?>" + response(array(ONE, "gr\xfc\xdfe", PID)),
    ],
    ids=["params", "bool", "double", "i8", "nil", "four", "number", "cp1252"],
)
async def test_an_answer_that_is_understood(body: bytes) -> None:
    async with client() as ours, scripted(answering(http(body))) as uri:
        assert await NodeProxy(ours, uri, "/me").get_pid() == 77
    async with client() as ours, scripted(answering(http(body))) as uri:
        assert await MasterProxy(ours, uri, "/me").get_pid() == 77


async def test_an_answer_without_a_value() -> None:
    async with client() as ours, scripted(answering(http(response(array(ONE, STATUS))))) as uri:
        await NodeProxy(ours, uri, "/me").shutdown()


@pytest.mark.parametrize(
    ("body", "code"),
    [
        (response("<int>-1</int>", "no", "<int>0</int>"), -1),
        (response(array("<boolean>0</boolean>", "no", "<int>0</int>")), 0),
        (response(array("<double>nan</double>", "no", "<int>0</int>")), -1),
        (response(array("<string>1</string>", "no", "<int>0</int>")), -1),
        (response(array()), -1),
    ],
    ids=["params", "bool", "nan", "text", "empty"],
)
async def test_an_answer_that_refuses(body: bytes, code: int) -> None:
    async with client() as ours, scripted(answering(http(body))) as uri:
        with pytest.raises(PeerError) as caught:
            await NodeProxy(ours, uri, "/me").get_pid()
        assert caught.value.code == code
    async with client() as ours, scripted(answering(http(body))) as uri:
        with pytest.raises(MasterError):
            await MasterProxy(ours, uri, "/me").get_pid()


async def test_a_node_that_ends_instead_of_answering() -> None:
    """rospy does, when it is told to shut down."""

    async def end(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        await request(reader)

    async with client() as ours, scripted(end) as uri:
        await NodeProxy(ours, uri, "/me").shutdown("enough")
        with pytest.raises(PeerUnreachable, match="connection lost") as caught:
            await NodeProxy(ours, uri, "/me").get_pid()
        assert caught.value.was_lost
    async with client() as ours:
        with pytest.raises(PeerUnreachable, match="cannot connect"):
            await NodeProxy(ours, uri, "/me").shutdown("enough")


# gzip that nobody asked for


async def get(ours: XmlRpcClient, data: bytes) -> Any:
    async with scripted(answering(data)) as uri:
        return await ours.call(uri, "m")


@pytest.mark.parametrize("name", ["gzip", "x-gzip", "GZip"])
async def test_a_compressed_answer(name: str) -> None:
    body = gzip.compress(encode_response("x" * 1000))
    async with client() as ours:
        answer = http(body, f"Content-Encoding: {name}")
        assert await get(ours, answer) == "x" * 1000
        chunks = b"".join(b"1\r\n%c\r\n" % each for each in body) + b"0\r\n\r\n"
        head = f"HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\nContent-Encoding: {name}\r\n\r\n"
        assert await get(ours, head.encode() + chunks) == "x" * 1000


@pytest.mark.parametrize(
    ("body", "coding", "why"),
    [
        (b"no gzip at all", "gzip", "not gzip"),
        (gzip.compress(encode_response("x"))[:-9], "gzip", "ends early"),
        (gzip.compress(bytes(100 << 20)), "gzip", "more than 67108864 bytes"),
        (encode_response("x"), "br", "content-encoding: br"),
    ],
    ids=["none", "half", "bomb", "other"],
)
async def test_a_compressed_answer_that_is_refused(body: bytes, coding: str, why: str) -> None:
    async with client() as ours:
        with pytest.raises(XmlRpcError, match=f"(?i){why}"):
            await get(ours, http(body, f"Content-Encoding: {coding}"))


# rows


GOOD = [1, "/listener", "o", "TCPROS", "/chatter", True, "a connection"]
ROWS: list[tuple[Any, BusInfo | None]] = [
    (GOOD, BusInfo(1, "/listener", "o", "TCPROS", "/chatter", True, "a connection")),
    (GOOD[:6], BusInfo(1, "/listener", "o", "TCPROS", "/chatter", True)),
    (GOOD[:5], BusInfo(1, "/listener", "o", "TCPROS", "/chatter", True)),  # rosjava, roslisp
    ([*GOOD, "more", 2], BusInfo(*GOOD)),
    ([*GOOD[:5], 0], BusInfo(1, "/listener", "o", "TCPROS", "/chatter", False)),
    (["7", *GOOD[1:5]], BusInfo(7, "/listener", "o", "TCPROS", "/chatter", True)),
    (GOOD[:4], None),
    ([], None),
    ("a text", None),
    (5, None),
    (["nameless", *GOOD[1:]], None),
]


async def test_bus_info_of_any_shape_keeps_the_rows_that_can_be_read() -> None:
    rows = [row for row, _ in ROWS]
    async with client() as ours, scripted(answering(http(encode_response([1, "", rows])))) as uri:
        found = await NodeProxy(ours, uri, "/me").get_bus_info()
    assert found == [row for _, row in ROWS if row is not None]


async def test_bus_info_with_long_ids() -> None:
    number = 8070450532247928832  # of roscpp on some machines, in an i4
    row = array(f"<i4>{number}</i4>", "/a", "i", "TCPROS", "/t", "<boolean>1</boolean>")
    body = response(array(ONE, STATUS, array(row)))
    async with client() as ours, scripted(answering(http(body))) as uri:
        (found,) = await NodeProxy(ours, uri, "/me").get_bus_info()
    assert found == BusInfo(number, "/a", "i", "TCPROS", "/t", True)


async def test_bus_stats_of_any_shape_keep_the_rows_that_can_be_read() -> None:
    stats = [
        [["/a", 10, [[1, 10, 2, True], [2, 3], "odd"]], "odd", ["/b"]],
        [["/c", [[3, 10, 2, -1, True], [4]]], 5],
        ["odd"],
    ]
    async with client() as ours, scripted(answering(http(encode_response([1, "", stats])))) as uri:
        found = await NodeProxy(ours, uri, "/me").get_bus_stats()
    assert [(each.topic, len(each.connections)) for each in found.publish] == [("/a", 1)]
    assert [(each.topic, len(each.connections)) for each in found.subscribe] == [("/c", 1)]
    assert found.service is None


async def test_topics_of_any_shape() -> None:
    rows = [["/a", "std_msgs/String"], ["/b", "std_msgs/String", "more"], ["/c"], 5]
    async with client() as ours, scripted(answering(http(encode_response([1, "", rows])))) as uri:
        found = await NodeProxy(ours, uri, "/me").get_publications()
    assert [tuple(each) for each in found] == [
        ("/a", "std_msgs/String"),
        ("/b", "std_msgs/String"),
    ]


async def test_a_node_that_ends_without_answering():
    """As rospy does, when it is faster to end than to answer."""
    asked = []

    async def end(reader, writer):
        asked.append(await request(reader))

    async with scripted(end) as uri, client() as http_client:
        await NodeProxy(http_client, uri, "/caller").shutdown("enough")
    assert len(asked) == 1


async def test_a_node_that_is_not_there_cannot_be_told_to_end():
    async with scripted(lambda reader, writer: None) as uri:
        pass
    async with client() as http_client:
        with pytest.raises(PeerUnreachable):
            await NodeProxy(http_client, uri, "/caller").shutdown("enough")
