"""Callers that misbehave, at a real provider."""

from __future__ import annotations

import asyncio
import struct

import pytest

import aioros1
from aioros1.msg.std_msgs import String
from aioros1.srv.std_srvs import SetBool

from .peers import (
    SET_BOOL_MD5,
    WRONG_MD5,
    caller_header,
    dialled,
    flip_answer,
    flip_request,
    frame,
    string,
    subscriber_header,
    until,
)

PERSISTENT = {"persistent": "1"}


IMPATIENT = pytest.mark.parametrize(
    "timeouts", [aioros1.Timeouts(handshake=0.4, close=0.2)], ids=["impatient"]
)
"""For tests of the timeouts; all others have time, however busy the machine is."""


@pytest.fixture
def timeouts() -> aioros1.Timeouts:
    return aioros1.Timeouts()


@pytest.fixture
async def node(make_node, timeouts):
    """The provider's node."""
    return await make_node("server", timeouts=timeouts)


@pytest.fixture
async def bystander(bystander_of, node):
    return await bystander_of(node)


@pytest.fixture
async def flip(node):
    def handler(request):
        return {"success": not request.data, "message": "flipped"}

    async with node.advertise_service("flip", SetBool, handler) as provider:
        yield provider


FLIPPED = flip_answer(False, "flipped")


async def refusal(node: aioros1.Node, *parts: bytes) -> str:
    """The ``error`` that the node answers, and nothing else, before it closes."""
    async with dialled(node, *parts) as wire:
        answer = await wire.read_header()
        assert list(answer) == ["error"]
        assert await wire.is_closed()
        return answer["error"]


async def is_answered(wire) -> bool:
    await wire.send(flip_request(True))
    return await wire.take(len(FLIPPED)) == FLIPPED


async def test_a_caller_of_any_type_is_served(node, flip):
    async with dialled(node, caller_header(md5sum="*", type="*")) as wire:
        await wire.read_header()
        assert await is_answered(wire)


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"md5sum": WRONG_MD5}, WRONG_MD5),
        ({"md5sum": SET_BOOL_MD5.upper()}, SET_BOOL_MD5),
        ({"md5sum": None}, "no md5sum"),
        ({"callerid": None}, "no callerid"),
        ({"service": "/unknown"}, "/unknown"),
        ({"service": "flip"}, "no service flip"),
        ({"service": ""}, "no service"),
    ],
    ids=["md5sum", "upper case", "no md5sum", "no callerid", "unknown", "relative", "empty"],
)
async def test_a_wrong_header_is_refused_with_a_reason(node, flip, bystander, changes, reason):
    assert reason in await refusal(node, caller_header(**changes))
    assert await bystander.is_served()


async def test_a_probe_is_answered_and_closed(node, flip):
    async with dialled(node, caller_header(md5sum="*", probe="1")) as wire:
        assert (await wire.read_header())["callerid"] == "/server"
        assert await wire.is_closed()
    assert flip.stats.messages == 0


async def test_a_probe_with_another_md5sum_is_refused(node, flip):
    assert WRONG_MD5 in await refusal(node, caller_header(md5sum=WRONG_MD5, probe="1"))


async def test_the_reply_has_the_fields_of_rospy_and_of_roscpp(node, flip):
    async with dialled(node, caller_header()) as wire:
        assert await wire.read_header() == {
            "callerid": "/server",
            "md5sum": SET_BOOL_MD5,
            "request_type": "std_srvs/SetBoolRequest",
            "response_type": "std_srvs/SetBoolResponse",
            "service": "/flip",
            "type": "std_srvs/SetBool",
        }


@pytest.mark.parametrize("value", ["1", "true"])
async def test_a_persistent_connection_serves_many_calls(node, flip, value):
    async with dialled(node, caller_header(persistent=value)) as wire:
        await wire.read_header()
        for _ in range(3):
            assert await is_answered(wire)
        # Requests that are sent ahead are answered in turn.
        await wire.send(flip_request(True) * 3)
        assert await wire.take(3 * len(FLIPPED)) == 3 * FLIPPED
    assert flip.stats.messages == 6


@IMPATIENT
async def test_an_idle_persistent_connection_is_kept(node, flip):
    async with dialled(node, caller_header(**PERSISTENT)) as wire:
        await wire.read_header()
        assert await is_answered(wire)
        await asyncio.sleep(0.6)  # longer than timeouts.handshake
        assert await is_answered(wire)


async def test_a_connection_that_is_not_persistent_serves_one_call(node, flip, bystander):
    async with dialled(node, caller_header(), flip_request(True) * 2) as wire:
        await wire.read_header()
        assert await wire.take(len(FLIPPED)) == FLIPPED
        assert await wire.is_closed()
    assert flip.stats.messages == 1
    assert await bystander.is_served()


@pytest.mark.parametrize("persistent", ["0", "1"])
async def test_a_request_that_is_too_short_fails_and_ends_the_connection(
    node, flip, bystander, persistent
):
    header = caller_header(persistent=persistent)
    async with dialled(node, header, frame(b""), flip_request(True)) as wire:
        await wire.read_header()
        ok, text = await wire.answer()
        assert ok == 0
        assert b"bad request" in text
        assert await wire.is_closed()
    assert flip.stats.errors == 1
    assert await bystander.is_served()


async def test_bytes_behind_the_request_are_ignored(node, flip):
    async with dialled(node, caller_header(), frame(b"\x01excess")) as wire:
        await wire.read_header()
        assert await wire.take(len(FLIPPED)) == FLIPPED


@pytest.mark.parametrize("persistent", ["0", "1"])
async def test_an_absurd_length_is_refused_at_once(node, flip, bystander, persistent):
    async with dialled(node, caller_header(persistent=persistent), b"\xff\xff\xff\xff") as wire:
        await wire.read_header()
        ok, text = await wire.answer()
        assert ok == 0
        assert b"4294967295 bytes" in text
        assert await wire.is_closed()
    assert await bystander.is_served()


@IMPATIENT
@pytest.mark.parametrize(("persistent", "came"), [("0", 0), ("1", 100_000)])
async def test_a_request_that_never_arrives_is_given_up(node, flip, bystander, persistent, came):
    said = struct.pack("<I", 900_000_000) + bytes(came)
    async with dialled(node, caller_header(persistent=persistent), said) as wire:
        await wire.read_header()
        assert await bystander.is_served()
        ok, text = await wire.answer()
        assert ok == 0
        assert b"no whole request came in 0.4 s" in text
        assert await wire.is_closed()
    assert await bystander.is_served()


@IMPATIENT
async def test_a_caller_that_connects_and_makes_no_call_is_given_up(node, flip):
    async with dialled(node, caller_header()) as wire:
        await wire.read_header()
        assert (await wire.answer())[0] == 0
        assert await wire.is_closed()


@pytest.mark.parametrize("byte", [1, 7, 255])
async def test_any_true_byte_is_true(node, byte):
    seen = []

    def handler(request):
        seen.append(request.data)
        return {"success": request.data}

    async with (
        node.advertise_service("flip", SetBool, handler),
        dialled(node, caller_header(), frame(bytes([byte]))) as wire,
    ):
        await wire.read_header()
        assert await wire.answer() == (1, b"\x01" + frame(b""))
    assert seen == [True]


class Refusal(Exception):
    """What a handler raises."""


@pytest.mark.parametrize("kind", ["function", "coroutine function"])
async def test_an_exception_in_a_handler_is_sent_as_the_text_of_the_error(
    node, bystander, caplog, kind
):
    def fail(request):
        raise Refusal("the arm is stuck")

    async def fail_later(request):
        await asyncio.sleep(0)
        raise Refusal("the arm is stuck")

    handler = fail if kind == "function" else fail_later
    async with (
        node.advertise_service("flip", SetBool, handler) as provider,
        dialled(node, caller_header(**PERSISTENT)) as wire,
    ):
        await wire.read_header()
        for _ in range(2):  # the connection goes on being used
            await wire.send(flip_request(True))
            assert await wire.answer() == (0, b"the arm is stuck")
        assert provider.stats.errors == 2
        assert await bystander.is_served()
    assert "the arm is stuck" in caplog.text
    caplog.clear()


@pytest.mark.parametrize(
    "answer",
    [{"message": 5}, {"no_such_field": 1}, 5, "text"],
    ids=["value", "field", "int", "str"],
)
async def test_a_response_that_cannot_be_sent_is_an_error_for_the_caller(
    node, bystander, caplog, answer
):
    async with (
        node.advertise_service("flip", SetBool, lambda request: answer),
        dialled(node, caller_header(**PERSISTENT)) as wire,
    ):
        await wire.read_header()
        for _ in range(2):
            await wire.send(flip_request(True))
            ok, text = await wire.answer()
            assert ok == 0
            assert text
        assert await bystander.is_served()
    caplog.clear()


async def test_service_error_in_a_handler_is_an_answer_and_is_not_logged(node):
    def handler(request):
        raise aioros1.ServiceError("not today")

    async with (
        node.advertise_service("flip", SetBool, handler),
        dialled(node, caller_header(), flip_request(True)) as wire,
    ):
        await wire.read_header()
        assert await wire.answer() == (0, b"not today")


async def test_topics_and_services_share_one_port(node, flip):
    async with (
        node.advertise("chatter", String) as pub,
        dialled(node, caller_header(**PERSISTENT)) as call,
        dialled(node, subscriber_header()) as sub,
    ):
        await sub.read_header()
        await call.read_header()
        await pub.wait_for_subscribers(timeout=30)
        pub.publish(data="both")
        assert await sub.take(len(string("both"))) == string("both")
        assert await is_answered(call)


async def test_a_topic_cannot_be_called_and_a_service_cannot_be_subscribed_to(node, flip):
    assert "does not publish" in await refusal(node, subscriber_header("/flip"))
    async with node.advertise("chatter", "std_msgs/String"):
        assert "no service" in await refusal(node, caller_header("/chatter"))


async def test_a_slow_handler_delays_no_other_caller(node, bystander):
    release = asyncio.Event()

    async def handler(request):
        if request.data:
            await release.wait()
        return {"message": "flipped"}

    async with (
        node.advertise_service("flip", SetBool, handler),
        dialled(node, caller_header(), flip_request(True)) as slow,
        dialled(node, caller_header(), flip_request(False)) as quick,
    ):
        await slow.read_header()
        await quick.read_header()
        assert (await quick.answer())[0] == 1
        assert await bystander.is_served()
        release.set()
        assert (await slow.answer())[0] == 1


async def test_a_caller_that_never_reads_is_cut_off(make_node, bystander_of):
    node = await make_node("server", timeouts=aioros1.Timeouts(stall=0.2))
    bystander = await bystander_of(node)
    large = {"success": True, "message": "x" * 20_000_000}
    async with (
        node.advertise_service("flip", SetBool, lambda request: large) as provider,
        dialled(node, caller_header(), flip_request(True)) as wire,
    ):
        wire.pause()
        await until(lambda: provider.connections, "the call came")
        assert await bystander.is_served()
        await until(lambda: not provider.connections, "it was cut off")
    assert await bystander.is_served()


async def test_a_caller_that_leaves_before_the_answer_disturbs_nobody(node, bystander):
    release = asyncio.Event()
    served = []

    async def handler(request):
        served.append(request)
        await release.wait()

    async with node.advertise_service("flip", SetBool, handler) as provider:
        async with dialled(node, caller_header(**PERSISTENT), flip_request(True)) as wire:
            await until(lambda: served)
            wire.abort()
        release.set()
        await until(lambda: not provider.connections)
        assert await bystander.is_served()


async def test_closing_a_provider_lets_a_call_be_answered_and_ends_idle_connections(node):
    started, release = asyncio.Event(), asyncio.Event()

    async def handler(request):
        started.set()
        await release.wait()
        return {"success": False, "message": "flipped"}

    provider = await node.advertise_service("flip", SetBool, handler)
    async with (
        dialled(node, caller_header(**PERSISTENT)) as idle,
        dialled(node, caller_header(**PERSISTENT), flip_request(True)) as busy,
    ):
        await idle.read_header()
        await busy.read_header()
        await started.wait()
        closing = asyncio.create_task(provider.close())
        assert await idle.is_closed()
        release.set()
        assert await busy.take(len(FLIPPED)) == FLIPPED
        assert await busy.is_closed()
        await closing


@IMPATIENT
async def test_closing_a_provider_does_not_wait_for_ever_for_a_handler(node):
    started = asyncio.Event()

    async def handler(request):
        started.set()
        await asyncio.Event().wait()

    provider = await node.advertise_service("flip", SetBool, handler)
    async with dialled(node, caller_header(), flip_request(True)) as wire:
        await wire.read_header()
        await started.wait()
        async with asyncio.timeout(30):
            await provider.close()
        assert await wire.is_closed()
