"""What cROS parses and prepares by hand, seen from a socket that shares no code with us."""

from __future__ import annotations

import pytest

from aioros1.msg.std_msgs import String
from aioros1.srv.roscpp_tutorials import TwoInts
from aioros1.wire.frames import FrameReceiver
from aioros1.wire.handshake import ServiceClient, ServiceOffer, TopicClient, TopicOffer
from aioros1.wire.header import HeaderParser, decode_header, encode_header

SUBSCRIBER = {
    "callerid": "/by_hand",
    "md5sum": String._md5sum,
    "tcp_nodelay": "1",
    "topic": "/chatter",
    "type": "std_msgs/String",
}
CALLER = {
    "callerid": "/by_hand",
    "md5sum": TwoInts._md5sum,
    "service": "/add",
    "type": "roscpp_tutorials/TwoInts",
}
ONE_AND_TWO = bytes([1, *7 * [0], 2, *7 * [0]])
THREE = bytes([3, *7 * [0]])


@pytest.fixture
async def node(make_node):
    """Publishes ``/chatter``, latched, and provides ``/add``."""
    node = await make_node("talker")
    pub = await node.advertise("chatter", String, latch=True)
    pub.publish(data="hi")
    await node.advertise_service("add", TwoInts, lambda request: {"sum": request.a + request.b})
    return node


@pytest.mark.parametrize(
    ("tag", "value"),
    [
        ("callerid", "/talker"),
        ("topic", "/chatter"),
        ("type", "std_msgs/String"),
        ("md5sum", String._md5sum),
        ("message_definition", String._full_text),
        ("latching", "1"),
    ],
    ids=lambda value: value if str(value).isidentifier() else "",
)
async def test_tag_of_a_publisher(node, tcpros, tag, value):
    async with tcpros(node.tcpros_address, SUBSCRIBER) as peer:
        assert peer.header[tag] == value


@pytest.mark.parametrize(
    ("tag", "value"),
    [
        ("callerid", "/talker"),
        ("service", "/add"),
        ("type", "roscpp_tutorials/TwoInts"),
        ("md5sum", TwoInts._md5sum),
        ("request_type", "roscpp_tutorials/TwoIntsRequest"),
        ("response_type", "roscpp_tutorials/TwoIntsResponse"),
    ],
    ids=lambda value: value if str(value).isidentifier() else "",
)
async def test_tag_of_a_provider(node, tcpros, tag, value):
    async with tcpros(node.tcpros_address, CALLER) as peer:
        assert peer.header[tag] == value


async def test_tag_tcp_nodelay(node, tcpros):
    async with tcpros(node.tcpros_address, SUBSCRIBER) as peer:
        assert await peer.frame() == b"\2\0\0\0hi"
        assert node.connections[0].header["tcp_nodelay"] == "1"


async def test_tag_latching(node, tcpros):
    """What cROS only parses is done: the last message comes at once."""
    async with tcpros(node.tcpros_address, SUBSCRIBER) as peer:
        assert await peer.frame() == b"\2\0\0\0hi"


@pytest.mark.parametrize("persistent", [True, False])
async def test_tag_persistent(node, tcpros, persistent):
    fields = {**CALLER, "persistent": "1"} if persistent else CALLER
    async with tcpros(node.tcpros_address, fields) as peer:
        assert await peer.call(ONE_AND_TWO) == (1, THREE)
        if persistent:
            assert await peer.call(ONE_AND_TWO) == (1, THREE)
        else:
            assert await peer.is_closed()


async def test_tag_probe(node, tcpros):
    async with tcpros(node.tcpros_address, {**CALLER, "md5sum": "*", "probe": "1"}) as peer:
        assert peer.header["md5sum"] == TwoInts._md5sum
        assert await peer.is_closed()


@pytest.mark.parametrize(
    ("fields", "text"),
    [
        ({**SUBSCRIBER, "md5sum": "0" * 32}, "md5sum"),
        ({**SUBSCRIBER, "topic": "/nothing"}, "does not publish /nothing"),
        ({**CALLER, "service": "/nothing"}, "has no service /nothing"),
        ({"callerid": "/by_hand", "md5sum": "*"}, "neither topic nor service"),
        ({"topic": "/chatter", "callerid": "/by_hand"}, "no md5sum"),
    ],
    ids=["md5sum", "topic", "service", "neither", "missing"],
)
async def test_tag_error(node, tcpros, fields, text):
    """What cROS only parses is done: whoever is refused is told why."""
    async with tcpros(node.tcpros_address, fields) as peer:
        assert list(peer.header) == ["error"]
        assert text in peer.header["error"]
        assert await peer.is_closed()


@pytest.mark.parametrize("code", ["TCPROS_OK_BYTE_SUCCESS", "TCPROS_OK_BYTE_FAIL"])
async def test_ok_byte(node, tcpros, code):
    request = ONE_AND_TWO if code == "TCPROS_OK_BYTE_SUCCESS" else b"\1"
    async with tcpros(node.tcpros_address, CALLER) as peer:
        ok, answer = await peer.call(request)
    assert ok == (code == "TCPROS_OK_BYTE_SUCCESS")
    assert answer == THREE if ok else answer.startswith(b"bad request: ")


def test_cRosMessageParse_and_cRosMessagePrepare_of_a_header():
    """They are pure: octets in, octets out, however they are cut."""
    octets = encode_header(SUBSCRIBER)
    parser = HeaderParser()
    for number in range(len(octets) - 1):
        assert parser.feed(octets[number : number + 1]) is None
    assert parser.feed(octets[-1:]) == SUBSCRIBER == decode_header(octets[4:])


def test_cRosMessagePrepareSubcriptionHeader():
    wanted = TopicOffer("/chatter", "std_msgs/String", String._md5sum, String._full_text)
    side = TopicClient("peer", "/by_hand", wanted)
    assert decode_header(side.data_to_send()[4:]).items() >= SUBSCRIBER.items()


def test_cRosMessagePrepareServiceCallHeader():
    wanted = ServiceOffer("/add", "roscpp_tutorials/TwoInts", TwoInts._md5sum)
    side = ServiceClient("peer", "/by_hand", wanted, persistent=True)
    # No type, as in the headers of rospy and roscpp.
    sent = {name: value for name, value in CALLER.items() if name != "type"}
    assert decode_header(side.data_to_send()[4:]) == {**sent, "persistent": "1"}


def test_TcprosParserState_of_frames():
    """Frames come out whole, however the octets came in."""

    class Sink:
        def __init__(self):
            self.seen = []

        def batch(self, data):
            return data

        def frames(self, frames):
            self.seen += [bytes(data[start:stop]) for data, start, stop in frames]

    sink = Sink()
    receiver = FrameReceiver(sink, memoryview(bytearray(64)), max_bytes=100)
    for octet in b"\2\0\0\0hi\0\0\0\0\1\0\0\0x":
        receiver.feed(bytes([octet]))
    assert sink.seen == [b"hi", b"", b"x"]
