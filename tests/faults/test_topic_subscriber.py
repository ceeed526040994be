"""Publishers that misbehave, at a real subscriber."""

from __future__ import annotations

import asyncio
import logging
import os
import socket
import struct
import tracemalloc

import pytest

import aioros1
from aioros1.msg.std_msgs import String
from aioros1.net.backoff import Backoff
from aioros1.topics import subscription

from .peers import STRING_MD5, STRING_REPLY, WRONG_MD5, frame, header, refusing, string, until


@pytest.fixture(autouse=True)
def quick(monkeypatch):
    """Connections are tried again sooner than usual, and given up sooner."""
    monkeypatch.setattr(subscription, "Backoff", lambda: Backoff(0.01, 10.0))
    monkeypatch.setattr(subscription, "_GRACE", 0.1)


IMPATIENT = pytest.mark.parametrize(
    "timeouts", [aioros1.Timeouts(handshake=0.4, xmlrpc=0.4)], ids=["impatient"]
)
"""For tests of the timeouts; all others have time, however busy the machine is."""


@pytest.fixture
def timeouts() -> aioros1.Timeouts:
    return aioros1.Timeouts()


@pytest.fixture
async def node(make_node, timeouts):
    """The subscriber's node."""
    return await make_node("listener", timeouts=timeouts)


@pytest.fixture
async def bystander(bystander_of, node):
    return await bystander_of(node)


@pytest.fixture
async def fake(make_publisher):
    return await make_publisher()


@pytest.fixture
async def sub(node, fake):
    async with node.subscribe("chatter", String, queue_size=1000) as sub:
        yield sub


def reply(without: str = "", **changes: str) -> bytes:
    fields = {**STRING_REPLY, **changes}
    fields.pop(without, None)
    return header(fields)


async def recovers(fake, sub) -> bool:
    """Whether the subscriber connects again, and then hears what is right."""
    wire = await fake.subscribed()
    await wire.send(string("right"))
    return (await sub.get(timeout=30)).data == "right"


def warnings_of(caplog: pytest.LogCaptureFixture) -> list[str]:
    return [each.getMessage() for each in caplog.records if each.levelno == logging.WARNING]


# the handshake


async def test_a_publisher_of_another_definition_is_refused(fake, sub, bystander, caplog):
    wire = await fake.greeted()
    await wire.send(reply(md5sum=WRONG_MD5), string("not a string at all"))
    assert await wire.is_closed()
    assert await bystander.is_served()
    assert await recovers(fake, sub)
    assert sub.stats.messages == 1
    assert any(WRONG_MD5 in text and STRING_MD5 in text for text in warnings_of(caplog))


@pytest.mark.parametrize("missing", ["md5sum", "type"])
async def test_a_reply_without_md5sum_or_type_is_refused(fake, sub, bystander, missing):
    wire = await fake.greeted()
    await wire.send(reply(without=missing), string("wrong"))
    assert await wire.is_closed()
    assert await bystander.is_served()
    assert await recovers(fake, sub)
    assert sub.stats.messages == 1


async def test_an_error_in_the_reply_is_logged_with_its_text(fake, sub, bystander, caplog):
    wire = await fake.greeted()
    await wire.send(header({"error": "the robot sleeps"}), string("wrong"))
    assert await wire.is_closed()
    assert await bystander.is_served()
    assert await recovers(fake, sub)
    assert sub.stats.messages == 1
    assert any("the robot sleeps" in text for text in warnings_of(caplog))


@pytest.mark.parametrize(
    "noise",
    [b"HTTP/1.1 200 OK\r\n\r\n", struct.pack("<I", 0), b"\xff" * 100, reply()[:10]],
    ids=["http", "empty", "ones", "cut"],
)
async def test_a_reply_that_is_no_header_is_refused(fake, sub, bystander, noise):
    wire = await fake.greeted()
    await wire.send(noise)
    wire.writer.write_eof()
    assert await wire.is_closed()
    assert await bystander.is_served()
    assert await recovers(fake, sub)


@IMPATIENT
async def test_a_publisher_that_never_replies_is_given_up_and_tried_again(fake, sub, bystander):
    wire = await fake.greeted()
    assert await bystander.is_served()
    assert await wire.is_closed()
    assert await recovers(fake, sub)


# messages


async def test_an_absurd_length_ends_the_connection_and_not_the_subscription(fake, sub, bystander):
    wire = await fake.subscribed()
    await wire.send(string("before"), b"\xff\xff\xff\xff", string("never"))
    assert await wire.is_closed()
    assert (await sub.get(timeout=30)).data == "before"
    assert await bystander.is_served()
    assert await recovers(fake, sub)


async def test_the_limit_of_message_bytes_is_an_option(make_node, fake):
    node = await make_node("listener", limits=aioros1.Limits(message_bytes=100))
    async with node.subscribe("chatter", String) as sub:
        wire = await fake.subscribed()
        await wire.send(string("x" * 96), string("x" * 97))
        assert await wire.is_closed()
        assert (await sub.get(timeout=30)).data == "x" * 96
        assert await recovers(fake, sub)
        assert sub.stats.messages == 2


@pytest.mark.parametrize("wrong", [b"\xff\xff\xff\xff", b""], ids=["an absurd length", "nothing"])
async def test_a_publisher_that_keeps_failing_is_asked_less_and_less_often(
    fake, sub, wrong, caplog
):
    """The handshake goes well each time; that alone is no reason to be quick again."""
    for _ in range(6):
        wire = await fake.subscribed()
        await wire.send(wrong)
        await wire.close()
    # Five delays that double, beginning with 0.01 s; half of each is certain.
    assert fake.dial_times[-1] - fake.dial_times[-2] >= 0.08
    # And the log is not filled with it.
    assert len(warnings_of(caplog)) <= 2


async def test_a_large_message_that_never_arrives_takes_no_memory(fake, sub, bystander):
    wire = await fake.subscribed()
    await sub.wait_for_publishers(timeout=30)
    tracemalloc.start()
    try:
        await wire.send(struct.pack("<I", 900_000_000) + bytes(1000))
        assert await bystander.is_served()
        assert tracemalloc.get_traced_memory()[1] < 20_000_000
    finally:
        tracemalloc.stop()


async def test_a_string_past_the_end_of_its_message_is_skipped(fake, sub, bystander):
    wire = await fake.subscribed()
    await wire.send(frame(struct.pack("<I", 1000) + b"short"), string("good"))
    assert (await sub.get(timeout=30)).data == "good"
    assert (sub.stats.messages, sub.stats.errors) == (2, 1)
    assert fake.dials == 1
    assert await bystander.is_served()


async def test_trailing_bytes_of_a_message_are_ignored(fake, sub):
    wire = await fake.subscribed()
    await wire.send(frame(frame(b"first") + b"excess"), string("second"))
    assert [(await sub.get(timeout=30)).data for _ in range(2)] == ["first", "second"]
    assert sub.stats.errors == 0


async def test_an_empty_frame_is_skipped_where_the_type_has_fields(fake, sub, bystander):
    wire = await fake.subscribed()
    await wire.send(frame(b""), string("good"))
    assert (await sub.get(timeout=30)).data == "good"
    assert sub.stats.errors == 1
    assert fake.dials == 1
    assert await bystander.is_served()


async def test_an_empty_frame_is_delivered_where_the_type_has_no_fields(node, make_publisher):
    empty = await make_publisher("/ticks", "std_msgs/Empty")
    async with node.subscribe("ticks", "std_msgs/Empty") as sub:
        wire = await empty.greeted()
        md5sum = "d41d8cd98f00b204e9800998ecf8427e"
        await wire.send(reply(type="std_msgs/Empty", md5sum=md5sum), frame(b"") * 3)
        for _ in range(3):
            await sub.get(timeout=30)


async def test_a_string_that_is_not_utf8_is_delivered(fake, sub):
    wire = await fake.subscribed()
    await wire.send(frame(frame(b"caf\xe9")), string("good"))
    message = await sub.get(timeout=30)
    assert message.data.encode("utf-8", "surrogateescape") == b"caf\xe9"
    assert (await sub.get(timeout=30)).data == "good"


async def test_many_messages_in_one_segment_behind_the_header(fake, sub):
    wire = await fake.greeted()
    texts = [f"number {number}" for number in range(100)]
    await wire.send(reply(), *map(string, texts))
    assert [(await sub.get(timeout=30)).data for _ in texts] == texts


async def test_messages_byte_by_byte(fake, sub):
    wire = await fake.subscribed()
    texts = [f"number {number}" for number in range(5)]
    for byte in b"".join(map(string, texts)):
        await wire.send(bytes([byte]))
        await asyncio.sleep(0)
    assert [(await sub.get(timeout=30)).data for _ in texts] == texts


async def test_large_messages_behind_the_header(fake, sub):
    """More than a stream reader takes before it stops reading."""
    wire = await fake.greeted()
    texts = ["x" * 3_000_000, "small", "y" * 300_000, "z" * 65_536, "last"]
    await wire.send(reply(), *map(string, texts))
    assert [(await sub.get(timeout=30)).data for _ in texts] == texts


# the end of a connection, and its next beginning


@pytest.mark.parametrize("how", ["close", "abort", "write_eof"])
@pytest.mark.parametrize(
    "last", [b"", string("x")[:2], string("x")[:-1]], ids=["header", "length", "body"]
)
async def test_a_publisher_that_closes_is_connected_again(fake, sub, bystander, how, last):
    wire = await fake.subscribed()
    await wire.send(last)
    if how == "close":
        await wire.close()
    elif how == "abort":
        wire.abort()
    else:
        wire.writer.write_eof()
        assert await wire.is_closed()
    assert await recovers(fake, sub)
    assert await bystander.is_served()


async def test_messages_sent_just_before_the_end_arrive(fake, sub):
    wire = await fake.greeted()
    await wire.send(reply(), string("one"), string("two"))
    await wire.close()
    assert [(await sub.get(timeout=30)).data for _ in range(2)] == ["one", "two"]
    assert await recovers(fake, sub)


async def test_no_reconnection_once_the_master_no_longer_lists_the_publisher(fake, sub, node):
    wire = await fake.subscribed()
    await fake.unregister()
    assert await wire.is_closed()
    await until(lambda: sub.publisher_count == 0)
    await node.has_param("/a_round_trip")
    assert fake.dials == 1


NONSENSE = {
    "none in common, by rospy": [0, "no supported protocol implementations", []],
    "none in common, by roscpp": [0, "Unknown Error", 0],
    "refused": [-1, "not a publisher", 0],
    "no protocol": [1, "ready", []],
    "no list": [1, "ready", 0],
    "nothing": [1, "ready", {}],
    "text": [1, "ready", "TCPROS"],
    "FOO": [1, "ready", ["FOO", "127.0.0.1", 1]],
    "no address": [1, "ready", ["TCPROS"]],
    "no port": [1, "ready", ["TCPROS", "127.0.0.1"]],
    "port as text": [1, "ready", ["TCPROS", "127.0.0.1", "11311"]],
    "port 0": [1, "ready", ["TCPROS", "127.0.0.1", 0]],
    "port too large": [1, "ready", ["TCPROS", "127.0.0.1", 65536]],
    "no host": [1, "ready", ["TCPROS", "", 1]],
    "host too long": [1, "ready", ["TCPROS", "a" * 70 + ".b", 1]],
    "host not a name": [1, "ready", ["TCPROS", "a..b", 1]],
    "no triple": "ready",
    "short": [1, "ready"],
    "struct": {"code": 1},
}


@pytest.mark.parametrize("answer", NONSENSE.values(), ids=NONSENSE.keys())
async def test_a_nonsensical_answer_to_request_topic_is_survived(fake, node, bystander, answer):
    fake.ready = answer
    async with node.subscribe("chatter", String) as sub:
        await until(lambda: fake.requests)
        assert await bystander.is_served()
        fake.ready = None
        assert await recovers(fake, sub)


async def test_a_fault_in_answer_to_request_topic_is_survived(fake, node, bystander, caplog):
    def fail():
        raise ValueError("no")

    fake.ready = fail
    async with node.subscribe("chatter", String) as sub:
        await until(lambda: fake.requests)
        assert await bystander.is_served()
        fake.ready = None
        assert await recovers(fake, sub)
    caplog.clear()  # the fake one's own complaint


async def test_an_announcement_ends_the_back_off_at_once(fake, node, monkeypatch):
    monkeypatch.setattr(subscription, "Backoff", lambda: Backoff(60.0, 60.0))
    fake.ready = [0, "not yet", []]
    async with node.subscribe("chatter", String) as sub:
        await until(lambda: fake.requests)
        fake.ready = None
        await fake.register()
        assert await recovers(fake, sub)


@IMPATIENT
async def test_a_publisher_that_hangs_in_request_topic_holds_up_nobody(
    node, fake, make_publisher, bystander
):
    fake.hold = asyncio.Event()
    other = await make_publisher(name="/other")
    async with node.subscribe("chatter", String) as sub:
        await until(lambda: fake.requests)
        assert await recovers(other, sub)
        assert await bystander.is_served()
        await until(lambda: fake.requests > 1, "asked again after the timeout")
        fake.hold.set()
        assert await recovers(fake, sub)


async def test_a_publisher_that_is_not_there_holds_up_nobody(node, fake, make_publisher, bystander):
    other = await make_publisher(name="/other")
    with refusing() as port:
        fake.ready = [1, "ready", ["TCPROS", "127.0.0.1", port]]
        async with node.subscribe("chatter", String) as sub:
            assert await recovers(other, sub)
            await until(lambda: fake.requests > 1, "tried again")
            assert await bystander.is_served()
            fake.ready = None
            assert await recovers(fake, sub)


async def test_the_header_that_a_subscriber_sends(fake, sub):
    wire = await fake.subscribed()
    assert wire.header == {
        "callerid": "/listener",
        "md5sum": STRING_MD5,
        "message_definition": String._full_text,
        "tcp_nodelay": "1",
        "topic": "/chatter",
        "type": "std_msgs/String",
    }


async def test_tcp_nodelay_is_asked_for_unless_turned_off(fake, node):
    async with node.subscribe("chatter", String, tcp_nodelay=False):
        assert (await fake.subscribed()).header["tcp_nodelay"] == "0"


async def test_a_publisher_that_is_started_again_elsewhere_is_heard(
    fake, sub, make_publisher, bystander
):
    wire = await fake.subscribed()
    await wire.send(string("old"))
    assert (await sub.get(timeout=30)).data == "old"
    # Killed: the connection is gone, the registration is not.
    await fake.close()
    again = await make_publisher()
    assert await recovers(again, sub)
    assert await bystander.is_served()


# leaving the list of the master


async def test_a_message_on_its_way_when_the_publisher_leaves_the_list_arrives(
    fake, sub, node, ask
):
    """The announcement comes by another connection, and may overtake."""
    wire = await fake.subscribed()
    await sub.wait_for_publishers(timeout=30)
    assert (await ask(node, "publisherUpdate", "/chatter", []))[0] == 1
    await wire.send(string("farewell"))
    assert (await sub.get(timeout=30)).data == "farewell"


async def test_a_publisher_that_is_announced_again_at_once_is_not_heard_twice(fake, sub, node, ask):
    wire = await fake.subscribed()
    await wire.send(string("before"))
    assert (await sub.get(timeout=30)).data == "before"
    await ask(node, "publisherUpdate", "/chatter", [])
    await ask(node, "publisherUpdate", "/chatter", [fake.uri])
    wires = [wire]
    for _ in range(20):  # round trips, more than a second connection needs
        await ask(node, "getPid")
        if fake.dials > len(wires):
            wires.append(await fake.subscribed())
    for each in wires:
        each.writer.write(string("after"))
    await sub.get(timeout=30)
    for _ in range(20):
        await ask(node, "getPid")
    assert sub.queued == 0


@pytest.mark.parametrize("messages", [0, 1], ids=["header", "header and message"])
async def test_a_publisher_that_replies_and_resets_at_once_is_connected_again(
    fake, sub, bystander, messages
):
    for _ in range(3):
        wire = await fake.greeted()
        sock = wire.writer.get_extra_info("socket")
        with socket.socket(fileno=os.dup(sock.fileno())) as own:
            # Reply and reset arrive together: the subscriber sees both in one go.
            own.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
            own.send(header(STRING_REPLY) + string("lost") * messages)
            wire.abort()
    wire = await fake.subscribed()
    await wire.send(string("here"))
    while (await sub.get(timeout=30)).data != "here":
        pass
