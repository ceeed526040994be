"""Subscribers that misbehave, at a real publisher."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import os
import socket
import struct

import pytest

import aioros1
from aioros1.msg.std_msgs import String

from .peers import (
    STRING_MD5,
    WRONG_MD5,
    caller_header,
    dialled,
    frame,
    header,
    subscriber_header,
    until,
)

IMPATIENT = pytest.mark.parametrize(
    "timeouts", [aioros1.Timeouts(handshake=0.4)], ids=["impatient"]
)
"""For tests of the timeouts; all others have time, however busy the machine is."""


@pytest.fixture
def timeouts() -> aioros1.Timeouts:
    return aioros1.Timeouts()


@pytest.fixture
async def node(make_node, timeouts):
    """The publisher's node."""
    return await make_node("talker", timeouts=timeouts)


@pytest.fixture
async def bystander(bystander_of, node):
    return await bystander_of(node)


@pytest.fixture
async def pub(node):
    async with node.advertise("chatter", String) as pub:
        yield pub


async def refusal(node: aioros1.Node, *parts: bytes) -> str:
    """The ``error`` that the node answers, and nothing else, before it closes."""
    async with dialled(node, *parts) as wire:
        answer = await wire.read_header()
        assert list(answer) == ["error"]
        assert await wire.is_closed()
        return answer["error"]


async def hears(wire, pub, text: str) -> bool:
    """Whether the connection is accepted and carries messages."""
    answer = await wire.read_header()
    assert "error" not in answer
    await until(lambda: pub.subscriber_count)
    pub.publish(data=text)
    return await wire.string() == text


async def test_a_subscriber_of_any_type_is_told_the_real_one(node, pub):
    async with dialled(node, subscriber_header(md5sum="*", type="*")) as wire:
        assert await hears(wire, pub, "hi")
        assert wire.header["type"] == "std_msgs/String"
        assert wire.header["md5sum"] == STRING_MD5
        assert wire.header["message_definition"] == String._full_text


@pytest.mark.parametrize("md5sum", [WRONG_MD5, STRING_MD5.upper()])
async def test_another_md5sum_is_refused_with_a_reason(node, pub, bystander, md5sum):
    error = await refusal(node, subscriber_header(md5sum=md5sum))
    assert md5sum in error
    assert STRING_MD5 in error
    assert pub.subscriber_count == 0
    assert await bystander.is_served()


async def test_another_type_name_with_the_same_md5sum_is_accepted(node, pub):
    async with dialled(node, subscriber_header(type="renamed_msgs/String")) as wire:
        assert await hears(wire, pub, "hi")


async def test_another_type_name_with_the_same_md5sum_is_logged(node, pub, caplog):
    async with dialled(node, subscriber_header(type="renamed_msgs/String")) as wire:
        assert await hears(wire, pub, "hi")
    warnings = [each.getMessage() for each in caplog.records if each.levelno == logging.WARNING]
    assert any("renamed_msgs/String" in text and "std_msgs/String" in text for text in warnings)


@pytest.mark.parametrize("missing", ["md5sum", "callerid"])
async def test_a_header_without_md5sum_or_callerid_is_refused(node, pub, bystander, missing):
    assert missing in await refusal(node, subscriber_header(**{missing: None}))
    assert await bystander.is_served()


async def test_a_header_without_a_type_is_accepted(node, pub):
    async with dialled(node, subscriber_header(type=None)) as wire:
        assert await hears(wire, pub, "hi")


async def test_a_header_without_topic_and_service_is_refused(node, pub, bystander):
    fields = {"callerid": "/fake", "md5sum": "*"}
    assert "neither topic nor service" in await refusal(node, header(fields))
    assert await bystander.is_served()


@pytest.mark.parametrize("topic", ["/unknown", "chatter", "", "/chatter/", "/calm/in"])
async def test_a_topic_that_is_not_published_is_refused(node, pub, bystander, topic):
    assert "does not publish" in await refusal(node, subscriber_header(topic))
    assert await bystander.is_served()


async def test_unknown_fields_and_equals_signs_do_no_harm(node, pub):
    extra = {"rock=et": "a=b", "empty": "", "": "x", "service": "/flip"}
    data = subscriber_header()[4:] + header(extra)[4:]
    async with dialled(node, frame(data)) as wire:
        assert await hears(wire, pub, "hi")
        assert pub.connections[0].header["rock"] == "et=a=b"


async def test_the_last_of_repeated_fields_counts(node, pub):
    doubled = header({"topic": "/other", "md5sum": WRONG_MD5})[4:] + subscriber_header()[4:]
    async with dialled(node, frame(doubled)) as wire:
        assert await hears(wire, pub, "hi")


@pytest.mark.parametrize("bad", [frame(b""), frame(b"no separator")])
async def test_a_field_without_an_equals_sign_is_refused(node, pub, bystander, bad):
    assert "name=value" in await refusal(node, frame(subscriber_header()[4:] + bad))
    assert await bystander.is_served()


async def test_a_value_that_is_not_utf8_is_accepted(node, pub):
    data = subscriber_header()[4:] + frame(b"note=caf\xe9\xff")
    async with dialled(node, frame(data)) as wire:
        assert await hears(wire, pub, "hi")


@pytest.mark.parametrize("length", [0xFFFF_FFFF, 900_000_000, (1 << 20) + 1])
async def test_an_absurd_header_length_is_refused_at_once(node, pub, bystander, length):
    # One byte behind the length: neither waited for nor given room to.
    assert f"{length} bytes" in await refusal(node, struct.pack("<I", length) + b"x")
    assert await bystander.is_served()


async def test_a_large_header_within_the_limit_is_accepted(node, pub):
    async with dialled(node, subscriber_header(message_definition="#" * 900_000)) as wire:
        assert await hears(wire, pub, "hi")


async def test_a_header_of_no_bytes_is_refused(node, pub, bystander):
    assert "empty header" in await refusal(node, struct.pack("<I", 0))
    assert await bystander.is_served()


async def test_a_field_past_the_end_is_refused(node, pub, bystander):
    data = subscriber_header()[4:] + struct.pack("<I", 1000) + b"short=1"
    assert "passes the end" in await refusal(node, frame(data))
    assert await bystander.is_served()


async def test_a_header_in_small_pieces_is_accepted(node, pub):
    async with dialled(node) as wire:
        for byte in subscriber_header():
            await wire.send(bytes([byte]))
            await asyncio.sleep(0)
        assert await hears(wire, pub, "hi")


half_open = pytest.mark.parametrize(
    "said",
    [b"", subscriber_header()[:7], subscriber_header()[:-1]],
    ids=["nothing", "seven bytes", "all but a byte"],
)


@half_open
async def test_half_open_connection_blocks_nobody(make_node, bystander_of, said):
    node = await make_node("talker", timeouts=aioros1.Timeouts(handshake=30))
    bystander = await bystander_of(node)
    async with node.advertise("chatter", String) as pub, dialled(node, said):
        assert await bystander.is_served()
        async with dialled(node, subscriber_header()) as wire:
            assert await hears(wire, pub, "hi")


@IMPATIENT
@half_open
async def test_half_open_connection_is_closed_after_the_timeout(node, pub, bystander, said):
    async with dialled(node, said) as wire:
        assert "no whole connection header in 0.4 s" in (await wire.read_header())["error"]
        assert await wire.is_closed()
    assert await bystander.is_served()


@IMPATIENT
async def test_a_header_that_trickles_in_gets_no_extra_time(node, pub):
    async with dialled(node) as wire:

        async def trickle():
            for byte in subscriber_header():
                await wire.send(bytes([byte]))
                await asyncio.sleep(0.02)

        trickling = asyncio.create_task(trickle())
        assert "no whole connection header" in (await wire.read_header())["error"]
        trickling.cancel()
        await asyncio.wait({trickling})


async def test_many_half_open_connections_block_nobody(node, pub, bystander):
    async with contextlib.AsyncExitStack() as wires:
        for _ in range(50):
            await wires.enter_async_context(dialled(node, b"\x10"))
        assert await bystander.is_served()


async def test_bytes_after_the_subscribers_header_are_ignored(node, pub, bystander):
    async with dialled(node, subscriber_header() + b"stray") as wire:
        assert await hears(wire, pub, "hi")
        # More than all buffers on the way can hold, so it must have been taken.
        for _ in range(16):
            await wire.send(bytes(1 << 20))
        pub.publish(data="still here")
        assert await wire.string() == "still here"
    assert await bystander.is_served()


async def test_a_subscriber_that_never_reads_slows_nobody(make_node, node, bystander):
    payload = bytes(1_000_000)
    other = await make_node("listener")
    async with (
        node.advertise("big", "std_msgs/UInt8MultiArray", queue_size=3) as pub,
        other.subscribe("big", "std_msgs/UInt8MultiArray") as sub,
        dialled(node, subscriber_header("/big", md5sum="*")) as wire,
    ):
        await wire.read_header()
        wire.pause()
        await pub.wait_for_subscribers(2, timeout=30)
        for _ in range(20):
            pub.publish(data=payload)
            assert len((await sub.get(timeout=30)).data) == len(payload)
        assert sub.dropped == 0
        stuck = next(each for each in pub.connections if each.peer == "/fake")
        assert pub.dropped == stuck.stats.dropped > 0
        assert await bystander.is_served()


async def test_the_last_message_of_a_latched_topic_goes_to_each_newcomer(node, pub):
    async with node.advertise("fixed", String, latch=True) as latched:
        latched.publish(data="old")
        latched.publish(data="new")
        for _ in range(2):
            async with dialled(node, subscriber_header("/fixed")) as wire:
                assert (await wire.read_header())["latching"] == "1"
                assert await wire.string() == "new"
                latched.publish(data="new")
                assert await wire.string() == "new"
    async with dialled(node, subscriber_header()) as wire:
        assert (await wire.read_header())["latching"] == "0"


async def test_each_of_several_latched_publishers_of_a_topic_delivers(node):
    async with (
        node.advertise("fixed", String, latch=True) as one,
        node.advertise("fixed", String, latch=True) as two,
        node.advertise("fixed", String) as unlatched,
    ):
        one.publish(data="one")
        two.publish(data="two")
        unlatched.publish(data="gone")
        async with dialled(node, subscriber_header("/fixed")) as wire:
            await wire.read_header()
            assert {await wire.string(), await wire.string()} == {"one", "two"}


async def test_the_reply_has_the_fields_that_others_rely_on(node, pub):
    async with dialled(node, subscriber_header()) as wire:
        assert await wire.read_header() == {
            "callerid": "/talker",
            "latching": "0",
            "md5sum": STRING_MD5,
            "message_definition": String._full_text,
            "topic": "/chatter",
            "type": "std_msgs/String",
        }


async def test_additional_fields_of_the_user_are_sent(node):
    async with (
        node.advertise("chatter", String, headers={"robot": "r2"}),
        dialled(node, subscriber_header()) as wire,
    ):
        assert (await wire.read_header())["robot"] == "r2"


@pytest.mark.parametrize("asked", ["1", "0", None])
async def test_small_messages_are_never_held_back(node, pub, asked):
    async with dialled(node, subscriber_header(tcp_nodelay=asked)) as wire:
        await wire.read_header()
        await pub.wait_for_subscribers(timeout=30)
        with socket.socket(fileno=os.dup(pub.connections[0].fileno)) as sock:
            assert sock.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY)


@IMPATIENT
@pytest.mark.parametrize(
    "noise",
    [
        b"GET / HTTP/1.1\r\nHost: x\r\n\r\n",
        b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + bytes(500),  # TLS says hello
        bytes(4096),
        b"\xff" * 4096,
        caller_header()[:-3] + b"\xff",
    ],
    ids=["http", "tls", "zeros", "ones", "cut"],
)
async def test_noise_at_the_port_disturbs_nobody(node, pub, bystander, noise):
    async with dialled(node, noise) as wire:
        assert "error" in await wire.read_header()
    assert await bystander.is_served()


async def test_a_subscriber_that_leaves_in_the_middle_disturbs_nobody(node, pub, bystander):
    data = subscriber_header()
    for length in (0, 3, 4, 10, len(data) - 1, len(data)):
        async with dialled(node, data[:length]) as wire:
            wire.abort()
    await until(lambda: pub.subscriber_count == 0)
    pub.publish(data="to nobody")
    assert await bystander.is_served()


async def test_connections_beyond_the_limit_are_closed_and_counted(make_node):
    node = await make_node("talker", limits=aioros1.Limits(connections=2))
    async with (
        node.advertise("chatter", String) as pub,
        dialled(node, subscriber_header()) as one,
        dialled(node, b"\x01") as two,
    ):
        assert await hears(one, pub, "hi")
        async with dialled(node, subscriber_header()) as three:
            assert await three.is_closed()
        assert node.stats.connections_refused == 1
        two.abort()  # and its place becomes free again
        assert await served_at_last(node)


async def served_at_last(node: aioros1.Node) -> bool:
    """Dial until the connection is not closed at once."""
    async with asyncio.timeout(30):
        while True:
            async with dialled(node, subscriber_header()) as wire:
                with contextlib.suppress(asyncio.IncompleteReadError, ConnectionError):
                    return "md5sum" in await wire.read_header()
