"""Who says what before messages flow: all four sides, without a socket."""

from __future__ import annotations

import struct
from collections.abc import Mapping

import pytest

from aioros1.errors import HandshakeError
from aioros1.wire.handshake import Server, ServiceClient, ServiceOffer, TopicClient, TopicOffer
from aioros1.wire.header import decode_header, encode_header

MD5 = "992ce8a1687cec8c8bd883ec73ca41d1"
OTHER_MD5 = "0" * 32
CHATTER = TopicOffer("/chatter", "std_msgs/String", MD5, "string data\n")
ANYTHING = TopicOffer("/chatter", "*", "*", "")
FLIP = ServiceOffer("/flip", "std_srvs/SetBool", "09fb03525b03e7ea1fd3992bafd87e16")


def fields(data: bytes) -> dict[str, str]:
    """The fields of a whole header, as it goes over the wire."""
    (length,) = struct.unpack_from("<I", data)
    assert length == len(data) - 4
    return decode_header(data[4:])


def topic_client(wanted: TopicOffer = CHATTER, **options: bool) -> TopicClient:
    return TopicClient("peer:1", "/listener", wanted, **options)


def service_client(wanted: ServiceOffer = FLIP, **options: bool) -> ServiceClient:
    return ServiceClient("peer:1", "/caller", wanted, **options)


def served(header: Mapping[str, str]) -> Server:
    """The accepting side, after this header came."""
    server = Server("peer:1", max_bytes=1 << 20, max_fields=256)
    assert server.receive_data(encode_header(header))
    return server


REPLY = {"md5sum": MD5, "type": "std_msgs/String"}


# what all sides have in common


@pytest.mark.parametrize(
    "make",
    [topic_client, service_client, lambda: Server("peer:1", max_bytes=1 << 20, max_fields=256)],
)
class TestEverySide:
    def test_one_byte_at_a_time(self, make):
        side = make()
        data = encode_header({**REPLY, "callerid": "/x", "topic": "/chatter", "md5sum": "*"})
        for index in range(len(data) - 1):
            assert side.missing > 0
            assert not side.receive_data(data[index : index + 1])
        assert side.receive_data(data[-1:])
        assert side.header["md5sum"] == "*"

    def test_the_end_of_the_connection_is_an_error(self, make):
        side = make()
        side.receive_data(b"\x10\x00")
        with pytest.raises(HandshakeError, match="closed the connection instead of") as caught:
            side.receive_data(b"")
        assert caught.value.peer == "peer:1"

    @pytest.mark.parametrize("length", [0, 1 << 20 | 1, 0xFFFF_FFFF])
    def test_a_length_of_zero_or_beyond_the_limit_is_an_error(self, make, length):
        prefix = struct.pack("<I", length)
        with pytest.raises(HandshakeError, match="header"):
            make().receive_data(prefix)
        side = make()
        for byte in prefix[:3]:
            side.receive_data(bytes([byte]))
        with pytest.raises(HandshakeError, match="header"):
            side.receive_data(prefix[3:])

    @pytest.mark.parametrize("body", [b"\x00\x00\x00\x00", b"\x03\x00\x00\x00abc", b"\xff\0\0\0a"])
    def test_a_bad_field_is_an_error(self, make, body):
        with pytest.raises(HandshakeError, match="bad connection header"):
            make().receive_data(struct.pack("<I", len(body)) + body)


@pytest.mark.parametrize("make", [topic_client, service_client])
@pytest.mark.parametrize("text", ["no such topic", "", "caf\udce9"])
def test_an_error_in_the_header_is_raised_with_its_text(make, text):
    with pytest.raises(HandshakeError) as caught:
        make().receive_data(encode_header({"error": text}))
    assert (caught.value.peer, caught.value.text) == ("peer:1", text)


@pytest.mark.parametrize("make", [topic_client, service_client])
def test_an_error_counts_whatever_else_the_header_holds(make):
    with pytest.raises(HandshakeError, match="overloaded"):
        make().receive_data(encode_header({**REPLY, "md5sum": "*", "error": "overloaded"}))


# a subscriber


def test_the_header_of_a_subscriber():
    assert fields(topic_client().data_to_send()) == {
        "callerid": "/listener",
        "md5sum": MD5,
        "message_definition": "string data\n",
        "tcp_nodelay": "1",
        "topic": "/chatter",
        "type": "std_msgs/String",
    }
    assert fields(topic_client(tcp_nodelay=False).data_to_send())["tcp_nodelay"] == "0"


def test_what_a_subscriber_to_any_type_sends():
    sent = fields(topic_client(ANYTHING).data_to_send())
    assert (sent["md5sum"], sent["type"]) == ("*", "*")
    # Not an empty one, on which cROS and clients in Java give up.
    assert "message_definition" not in sent


def test_a_publisher_that_means_the_same_is_accepted():
    client = topic_client()
    reply = {**REPLY, "message_definition": "string data", "latching": "1", "callerid": "/talker"}
    assert client.receive_data(encode_header(reply))
    assert client.agreed == TopicOffer("/chatter", "std_msgs/String", MD5, "string data", True)
    assert client.header == reply


def test_a_publisher_that_sends_only_what_is_required_is_accepted():
    # What is left out by the toolboxes that write these headers by hand: topic, callerid,
    # latching, and the definition.
    client = topic_client()
    assert client.receive_data(encode_header(REPLY))
    assert client.agreed == TopicOffer("/chatter", "std_msgs/String", MD5, "", False)


@pytest.mark.parametrize(
    ("latching", "expected"), [("1", True), ("true", True), ("0", False), ("", False)]
)
def test_latching(latching, expected):
    client = topic_client()
    client.receive_data(encode_header({**REPLY, "latching": latching}))
    assert client.agreed.latching is expected


@pytest.mark.parametrize(
    ("wanted", "theirs"), [(CHATTER, "*"), (ANYTHING, MD5), (ANYTHING, OTHER_MD5), (ANYTHING, "*")]
)
def test_any_md5sum_fits_on_either_side(wanted, theirs):
    client = topic_client(wanted)
    assert client.receive_data(encode_header({**REPLY, "md5sum": theirs}))
    assert client.agreed.md5sum == theirs


@pytest.mark.parametrize("theirs", [OTHER_MD5, MD5.upper(), ""])
def test_a_publisher_of_another_definition_is_refused(theirs):
    with pytest.raises(HandshakeError, match=f"md5sum {theirs} there.*md5sum {MD5} here"):
        topic_client().receive_data(encode_header({**REPLY, "md5sum": theirs}))


@pytest.mark.parametrize("missing", ["md5sum", "type"])
def test_a_publisher_that_does_not_say_what_it_publishes_is_refused(missing):
    reply = {name: value for name, value in REPLY.items() if name != missing}
    with pytest.raises(HandshakeError, match=f"its header has no {missing}"):
        topic_client().receive_data(encode_header(reply))


def test_a_publisher_of_the_same_definition_by_another_name_is_accepted():
    client = topic_client()
    assert client.receive_data(encode_header({**REPLY, "type": "renamed_msgs/String"}))
    assert client.agreed.type == "renamed_msgs/String"


# a service caller


def test_what_a_service_caller_sends():
    assert fields(service_client().data_to_send()) == {
        "callerid": "/caller",
        "md5sum": FLIP.md5sum,
        "service": "/flip",
    }


@pytest.mark.parametrize("option", ["persistent", "probe"])
def test_a_service_caller_says_so_only_if_it_is_persistent_or_a_probe(option):
    assert fields(service_client(**{option: True}).data_to_send())[option] == "1"
    assert option not in fields(service_client().data_to_send())


@pytest.mark.parametrize(
    "reply",
    [
        {"callerid": "/server", "md5sum": FLIP.md5sum, "service": "/flip", "type": FLIP.type},
        {"callerid": "/server", "md5sum": FLIP.md5sum, "request_type": "r", "response_type": "s"},
        {"md5sum": "*"},
        {"callerid": "/server"},
    ],
    ids=["rospy", "roscpp", "any", "only a name"],
)
def test_any_answer_of_a_service_without_an_error_is_accepted(reply):
    client = service_client()
    assert client.receive_data(encode_header(reply))
    assert client.header == reply


def test_a_service_of_another_definition_is_refused():
    with pytest.raises(HandshakeError, match=f"md5sum {OTHER_MD5} there"):
        service_client().receive_data(encode_header({"md5sum": OTHER_MD5, "type": "a/B"}))


# the accepting side

SUBSCRIBER = {
    "callerid": "/listener",
    "md5sum": MD5,
    "topic": "/chatter",
    "type": "std_msgs/String",
}
CALLER = {"callerid": "/caller", "md5sum": FLIP.md5sum, "service": "/flip", "type": FLIP.type}


def without(header: Mapping[str, str], name: str) -> dict[str, str]:
    return {key: value for key, value in header.items() if key != name}


def test_a_subscriber_is_recognised():
    server = served(SUBSCRIBER)
    assert (server.topic, server.service, server.caller_id) == ("/chatter", None, "/listener")


def test_a_service_caller_is_recognised():
    server = served(CALLER)
    assert (server.topic, server.service, server.caller_id) == (None, "/flip", "/caller")


def test_a_header_that_names_both_means_the_topic():
    server = served({**CALLER, "topic": "/chatter"})
    assert (server.topic, server.service) == ("/chatter", None)


@pytest.mark.parametrize("header", [SUBSCRIBER, CALLER], ids=["topic", "service"])
@pytest.mark.parametrize("missing", ["callerid", "md5sum"])
def test_a_header_without_caller_or_md5sum_is_refused(header, missing):
    with pytest.raises(HandshakeError, match=f"the connection header has no {missing}"):
        served(without(header, missing))


def test_a_header_without_topic_and_service_is_refused():
    with pytest.raises(HandshakeError, match="neither topic nor service"):
        served(without(SUBSCRIBER, "topic"))


def test_an_error_names_the_caller_once_it_is_known():
    with pytest.raises(HandshakeError) as caught:
        served(without(SUBSCRIBER, "md5sum"))
    assert caught.value.peer == "/listener at peer:1"


@pytest.mark.parametrize("name", ["persistent", "probe"])
@pytest.mark.parametrize(
    ("value", "expected"),
    [("1", True), ("true", True), ("True", True), ("TRUE", True), ("0", False), ("", False)],
)
def test_values_of_persistent_and_probe(name, value, expected):
    assert getattr(served({**CALLER, name: value}), name) is expected


@pytest.mark.parametrize("name", ["persistent", "probe"])
def test_persistent_and_probe_are_off_by_default(name):
    assert getattr(served(CALLER), name) is False


def test_the_answer_to_a_subscriber():
    answer = fields(served(SUBSCRIBER).accept_topic("/talker", CHATTER))
    assert answer == {
        "callerid": "/talker",
        "latching": "0",
        "md5sum": MD5,
        "message_definition": "string data\n",
        "topic": "/chatter",
        "type": "std_msgs/String",
    }


def test_the_answer_says_that_the_topic_is_latched():
    latched = TopicOffer("/chatter", "std_msgs/String", MD5, "string data\n", latching=True)
    assert fields(served(SUBSCRIBER).accept_topic("/talker", latched))["latching"] == "1"


def test_fields_of_the_user_never_replace_the_standard_ones():
    answer = served(SUBSCRIBER).accept_topic("/talker", CHATTER, {"robot": "r2", "md5sum": "x"})
    assert fields(answer)["robot"] == "r2"
    assert fields(answer)["md5sum"] == MD5


@pytest.mark.parametrize(
    "header",
    [
        {**SUBSCRIBER, "md5sum": "*", "type": "*"},
        {**SUBSCRIBER, "type": "renamed_msgs/String"},
        without(SUBSCRIBER, "type"),
    ],
    ids=["any type", "another name", "no type"],
)
def test_subscribers_of_any_of_another_and_of_no_type_are_accepted(header):
    answer = fields(served(header).accept_topic("/talker", CHATTER))
    assert (answer["type"], answer["md5sum"]) == ("std_msgs/String", MD5)


@pytest.mark.parametrize("md5sum", [OTHER_MD5, MD5.upper(), ""])
@pytest.mark.parametrize("type", ["std_msgs/String", None])
def test_a_subscriber_with_another_md5sum_is_refused(md5sum, type):
    header = {**SUBSCRIBER, "md5sum": md5sum}
    server = served(header if type else without(header, "type"))
    with pytest.raises(HandshakeError) as caught:
        server.accept_topic("/talker", CHATTER)
    for word in ("/listener", "/chatter", md5sum, MD5):
        assert word in caught.value.text


def test_the_answer_to_a_service_caller_has_the_fields_of_rospy_and_of_roscpp():
    assert fields(served(CALLER).accept_service("/server", FLIP)) == {
        "callerid": "/server",
        "md5sum": FLIP.md5sum,
        "request_type": "std_srvs/SetBoolRequest",
        "response_type": "std_srvs/SetBoolResponse",
        "service": "/flip",
        "type": "std_srvs/SetBool",
    }


def test_a_caller_of_any_type_is_accepted():
    answer = served({**CALLER, "md5sum": "*", "type": "*"}).accept_service("/server", FLIP)
    assert fields(answer)["md5sum"] == FLIP.md5sum


@pytest.mark.parametrize("md5sum", [OTHER_MD5, FLIP.md5sum.upper()])
@pytest.mark.parametrize("probe", ["0", "1"])
def test_a_caller_with_another_md5sum_is_refused_probe_or_not(md5sum, probe):
    server = served({**CALLER, "md5sum": md5sum, "probe": probe})
    with pytest.raises(HandshakeError, match=f"wants service /flip .*{md5sum}"):
        server.accept_service("/server", FLIP)


def test_a_refusal_is_a_header_with_nothing_but_the_error():
    server = Server("peer:1", max_bytes=100, max_fields=10)
    assert fields(server.refuse("why not = because")) == {"error": "why not = because"}


def test_the_clients_of_this_library_are_accepted_by_its_servers():
    server = Server("peer:1", max_bytes=1 << 20, max_fields=256)
    client = topic_client()
    assert server.receive_data(client.data_to_send())
    assert client.receive_data(server.accept_topic("/talker", CHATTER))
    assert client.agreed == CHATTER
