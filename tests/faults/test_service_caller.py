"""Providers that misbehave, at a real caller."""

from __future__ import annotations

import asyncio
import socket
import struct

import pytest

import aioros1
from aioros1.srv.roscpp import SetLoggerLevel
from aioros1.srv.std_srvs import SetBool

from .peers import (
    PATIENCE,
    SET_BOOL_MD5,
    WRONG_MD5,
    flip_answer,
    flip_request,
    frame,
    header,
    refusing,
)

IMPATIENT = pytest.mark.parametrize(
    "timeouts", [aioros1.Timeouts(handshake=0.4, stall=0.4)], ids=["impatient"]
)
"""For tests of the timeouts; all others have time, however busy the machine is."""


@pytest.fixture
def timeouts() -> aioros1.Timeouts:
    return aioros1.Timeouts()


@pytest.fixture
async def node(make_node, timeouts):
    """The caller's node."""
    return await make_node("client", timeouts=timeouts)


@pytest.fixture
async def bystander(bystander_of, node):
    return await bystander_of(node)


@pytest.fixture
async def fake(make_provider):
    return await make_provider()


@pytest.fixture
async def caller(node, fake):
    async with node.service_caller("flip", SetBool, persistent=True, timeout=30) as caller:
        yield caller


@pytest.fixture(params=["persistent", "once"])
async def any_caller(node, fake, request):
    """A caller of either kind."""
    persistent = request.param == "persistent"
    async with node.service_caller("flip", SetBool, persistent=persistent, timeout=30) as caller:
        yield caller


async def answered(fake, caller, wire=None, *, message: str = "right") -> bool:
    """Whether a call gets its answer, by a new connection if none is given."""
    call = caller.send_request(data=True)
    wire = wire or await fake.called()
    assert await wire.frame() == b"\x01"
    await wire.send(flip_answer(True, message))
    return (await call).message == message


async def test_what_a_persistent_caller_sends(fake, caller):
    assert await answered(fake, caller)
    assert caller.connections[0].header["md5sum"] == SET_BOOL_MD5


async def test_an_error_in_the_header_is_raised_with_its_text(fake, any_caller, bystander):
    call = any_caller.send_request(data=True)
    wire = await fake.greeted()
    await wire.send(header({"error": "only for friends"}))
    with pytest.raises(aioros1.HandshakeError, match="only for friends"):
        await call
    assert await wire.is_closed()
    assert await bystander.is_served()
    assert await answered(fake, any_caller)


async def test_a_provider_of_another_definition_is_refused(fake, any_caller, bystander):
    call = any_caller.send_request(data=True)
    wire = await fake.greeted()
    await wire.send(header({"callerid": "/fake", "md5sum": WRONG_MD5}))
    with pytest.raises(aioros1.HandshakeError, match=WRONG_MD5):
        await call
    assert await wire.is_closed()  # and no request came
    assert await bystander.is_served()


async def test_a_probe_is_closed_by_the_prober(fake, any_caller):
    asking = asyncio.create_task(any_caller.is_available())
    wire = await fake.called()
    assert (wire.header["probe"], wire.header["md5sum"]) == ("1", "*")
    assert await asking
    assert await wire.is_closed()
    assert await answered(fake, any_caller)


@pytest.mark.parametrize("how", ["says nothing", "closes", "closes its side"])
async def test_a_provider_that_answers_no_probe_is_available(fake, node, any_caller, how):
    async def probed(asking):
        task = asyncio.create_task(asking)
        wire = await fake.greeted()
        assert set(wire.header) == {"callerid", "md5sum", "probe", "service"}
        if how == "closes":
            await wire.close()
        elif how == "closes its side":
            wire.writer.write_eof()
        result = await task
        assert await wire.is_closed()
        return result

    assert await probed(any_caller.is_available())
    await probed(node.wait_for_service("flip", timeout=30))
    assert await answered(fake, any_caller)


@pytest.mark.parametrize("how", ["refuses", "is of another kind", "breaks off"])
async def test_a_provider_that_refuses_a_probe_is_not_available(fake, any_caller, how):
    asking = asyncio.create_task(any_caller.is_available())
    wire = await fake.accept()
    if how == "refuses":
        await wire.read_header()
        await wire.send(header({"error": "only for friends"}))
    elif how == "is of another kind":
        await wire.read_header()
        await wire.send(b"HTTP/1.1 400 Bad Request\r\n\r\n")
    else:
        sock = wire.writer.get_extra_info("socket")
        sock.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        wire.abort()  # with a reset
    assert not await asking


async def test_only_the_type_needs_an_answer(fake, make_node):
    node = await make_node("asker", timeouts=aioros1.Timeouts(handshake=0.05))
    with pytest.raises(aioros1.ServiceUnavailable, match="sent no whole connection header"):
        await node.service_type("flip")
    await (await fake.accept()).close()
    asking = asyncio.create_task(node.service_type("flip"))
    wire = await fake.greeted()
    await wire.close()
    with pytest.raises(aioros1.ServiceUnavailable, match="the other side closed it"):
        await asking


async def test_a_roscpp_provider_is_understood(fake, any_caller):
    call = any_caller.send_request(data=True)
    wire = await fake.greeted()
    fields = {"callerid": "/fake", "md5sum": SET_BOOL_MD5, "type": "std_srvs/SetBool"}
    types = {"request_type": "std_srvs/SetBoolRequest", "response_type": "std_srvs/SetBoolResponse"}
    await wire.send(header({**fields, **types}))
    assert await wire.frame() == b"\x01"
    await wire.send(flip_answer(True))
    assert (await call).success


@pytest.mark.parametrize("text", ["the arm is stuck", "", "caf\udce9"])
async def test_a_failed_call_raises_service_error_with_its_text(fake, any_caller, text):
    call = any_caller.send_request(data=True)
    wire = await fake.called()
    await wire.frame()
    await wire.send(b"\x00", frame(text.encode("utf-8", "surrogateescape")))
    with pytest.raises(aioros1.ServiceError) as caught:
        await call
    assert type(caught.value) is aioros1.ServiceError
    assert caught.value.text == text
    assert any_caller.stats.errors == 1


async def test_a_failed_call_leaves_the_persistent_connection_in_use(fake, caller):
    call = caller.send_request(data=True)
    wire = await fake.called()
    await wire.frame()
    await wire.send(b"\x00", frame(b"no"))
    with pytest.raises(aioros1.ServiceError, match="no"):
        await call
    assert await answered(fake, caller, wire)


async def test_a_provider_that_was_killed_is_an_error_at_once(fake, any_caller, bystander):
    with refusing() as port:
        await fake.register(f"rosrpc://127.0.0.1:{port}")
        async with asyncio.timeout(PATIENCE):
            with pytest.raises(aioros1.ServiceUnavailable, match="cannot connect"):
                await any_caller.call(data=True)
    assert await bystander.is_served()
    await fake.register()
    assert await answered(fake, any_caller)


async def test_an_unknown_service_is_not_found(node):
    with pytest.raises(aioros1.ServiceNotFound, match="/nowhere"):
        await node.call("nowhere", SetBool, timeout=30)


@pytest.mark.parametrize(
    "uri",
    [
        "http://127.0.0.1:1/",
        "rosrpc://",
        "rosrpc://host",
        "rosrpc://host:port",
        "rosrpc://127.0.0.1:0",
        "rosrpc://127.0.0.1:99999",
        "rosrpc://[::1",
        "rosrpc://a..b:1",
        "rosrpc://" + 70 * "a" + ":1",
        "rosrpc://no such host:1",
    ],
)
async def test_an_address_of_no_use_is_an_error_of_the_call(node, make_provider, uri):
    fake = await make_provider()
    await fake.register(uri)
    with pytest.raises(aioros1.ServiceUnavailable):
        await node.call("flip", SetBool, timeout=30)
    assert not await (await node.service_caller("flip", SetBool)).is_available()


@pytest.mark.parametrize(
    ("said", "how"),
    [
        (b"", "close"),
        (b"", "abort"),
        (b"\x01", "close"),
        (flip_answer(True)[:3], "abort"),
        (flip_answer(True)[:-1], "close"),
        (b"\x00\x05", "close"),
    ],
)
async def test_a_provider_that_is_lost_before_its_answer_is_an_error_at_once(
    fake, any_caller, bystander, said, how
):
    call = any_caller.send_request(data=True)
    wire = await fake.called()
    await wire.frame()
    await wire.send(said)
    await wire.close() if how == "close" else wire.abort()
    with pytest.raises(aioros1.ServiceUnavailable):
        await call
    assert await bystander.is_served()
    assert await answered(fake, any_caller)


async def test_a_request_is_never_sent_twice(fake, any_caller):
    """Even on a connection that worked a moment before: the provider may have acted on it."""
    if any_caller.options.persistent:
        call = any_caller.send_request(data=True)
        wire = await fake.called()
        await wire.frame()
        await wire.send(flip_answer(True))
        await call
    else:
        wire = None
    dials = fake.dials
    call = any_caller.send_request(data=False)
    wire = wire or await fake.called()
    assert await wire.frame() == b"\x00"
    wire.abort()
    with pytest.raises(aioros1.ServiceUnavailable):
        await call
    assert fake.dials == max(dials, 1)


async def test_an_idle_connection_that_the_provider_closed_is_made_anew(fake, node, caller):
    call = caller.send_request(data=True)
    wire = await fake.called()
    await wire.frame()
    await wire.send(flip_answer(True))
    await call
    await wire.close()
    await node.has_param("/a_round_trip")  # in which the end is noticed
    assert await answered(fake, caller)
    assert fake.dials == 2


async def test_cancelled_call_leaves_no_late_answer(fake, caller, bystander):
    call = caller.send_request(data=True)
    wire = await fake.called()
    await wire.frame()
    call.cancel()
    with pytest.raises(asyncio.CancelledError):
        await call
    assert caller.connections == ()
    wire.writer.write(flip_answer(True, "late"))
    assert await wire.is_closed()
    assert await answered(fake, caller, message="in time")
    assert await bystander.is_served()


async def test_a_call_that_timed_out_leaves_no_late_answer(fake, any_caller):
    call = any_caller.send_request(data=True, timeout=0.05)
    wire = await fake.called()
    await wire.frame()
    with pytest.raises(TimeoutError):
        await call
    wire.writer.write(flip_answer(True, "late"))
    assert await wire.is_closed()
    assert await answered(fake, any_caller, message="in time")


async def test_half_an_answer_is_never_taken_for_the_start_of_the_next(fake, caller):
    call = caller.send_request(data=True, timeout=0.05)
    wire = await fake.called()
    await wire.frame()
    await wire.send(flip_answer(True, "half")[:-2])
    with pytest.raises(TimeoutError):
        await call
    assert await answered(fake, caller)


async def test_a_cancelled_call_does_not_hurt_the_one_that_waits_for_its_turn(fake, caller):
    first = caller.send_request(data=True)
    wire = await fake.called()
    await wire.frame()
    second = caller.send_request(data=False)
    third = caller.send_request(data=False)
    await asyncio.sleep(0)
    third.cancel()
    first.cancel()
    again = await fake.called()
    assert await again.frame() == b"\x00"
    await again.send(flip_answer(True, "second"))
    assert (await second).message == "second"


async def test_calls_of_a_persistent_caller_happen_one_after_the_other(fake, caller):
    calls = [caller.send_request(data=bool(number % 2)) for number in range(4)]
    wire = await fake.called()
    for number in range(4):
        assert await wire.frame() == bytes([number % 2])
        await wire.send(flip_answer(True, str(number)))
    assert [(await call).message for call in calls] == ["0", "1", "2", "3"]
    assert fake.dials == 1


async def test_calls_of_another_caller_overlap(node, fake):
    async with node.service_caller("flip", SetBool, timeout=30) as caller:
        calls = [caller.send_request(data=False) for _ in range(3)]
        wires = [await fake.called() for _ in calls]
        for number, wire in reversed([*enumerate(wires)]):
            assert await wire.frame() == b"\x00"
            await wire.send(flip_answer(True, str(number)))
        assert {(await call).message for call in calls} == {"0", "1", "2"}


@pytest.mark.parametrize("length", [0xFFFF_FFFF, 1_000_000_001])
async def test_an_answer_of_absurd_length_is_an_error(fake, any_caller, bystander, length):
    call = any_caller.send_request(data=True)
    wire = await fake.called()
    await wire.frame()
    await wire.send(b"\x01", struct.pack("<I", length))
    with pytest.raises(aioros1.ServiceUnavailable, match=f"{length} bytes"):
        await call
    assert await wire.is_closed()
    assert await bystander.is_served()


@IMPATIENT
async def test_an_answer_that_stops_halfway_is_given_up(fake, any_caller, bystander):
    call = any_caller.send_request(data=True, timeout=None)
    wire = await fake.called()
    await wire.frame()
    await wire.send(b"\x01", struct.pack("<I", 900_000_000))
    assert await bystander.is_served()
    with pytest.raises(aioros1.ServiceUnavailable):
        await call
    assert await wire.is_closed()


async def test_an_answer_that_cannot_be_read_is_an_error(fake, any_caller):
    call = any_caller.send_request(data=True)
    wire = await fake.called()
    await wire.frame()
    await wire.send(b"\x01", frame(b"\x01\xff\xff\xff\xff"))  # a string past the end
    with pytest.raises(aioros1.ServiceUnavailable, match="cannot be read"):
        await call
    assert await answered(fake, any_caller)


async def test_bytes_behind_the_response_are_ignored(fake, any_caller):
    call = any_caller.send_request(data=True)
    wire = await fake.called()
    await wire.frame()
    await wire.send(b"\x01", frame(b"\x01" + frame(b"hi") + b"excess"))
    assert (await call).message == "hi"


@IMPATIENT
async def test_a_provider_that_never_sends_a_header_is_given_up(fake, any_caller, bystander):
    call = any_caller.send_request(data=True)
    wire = await fake.greeted()
    assert await bystander.is_served()
    with pytest.raises(aioros1.ServiceUnavailable, match="no whole connection header"):
        await call
    assert await wire.is_closed()


@pytest.mark.parametrize("said", [b"", header({"md5sum": "*"})[:-1]], ids=["nothing", "half"])
async def test_a_provider_that_closes_instead_of_a_header_is_unavailable(fake, any_caller, said):
    call = any_caller.send_request(data=True)
    wire = await fake.greeted()
    await wire.send(said)
    await wire.close()
    with pytest.raises(aioros1.ServiceUnavailable):
        await call
    assert await answered(fake, any_caller)


@IMPATIENT
async def test_a_provider_that_takes_nothing_is_given_up(node, make_provider, bystander):
    fake = await make_provider("/level")
    large = "x" * 20_000_000
    call = asyncio.create_task(node.call("level", SetLoggerLevel, logger=large))
    wire = await fake.greeted()
    await wire.send(header({"callerid": "/fake", "md5sum": "*"}))
    wire.pause()
    assert await bystander.is_served()
    with pytest.raises(aioros1.ServiceUnavailable, match="took nothing"):
        await call


async def test_closing_the_caller_ends_its_calls_with_closed_error(fake, node):
    caller = await node.service_caller("flip", SetBool, persistent=True)
    calls = [caller.send_request(data=True) for _ in range(3)]
    wire = await fake.called()
    await wire.frame()
    await caller.close()
    for call in calls:
        with pytest.raises(aioros1.ClosedError):
            await call
    assert await wire.is_closed()


async def test_closing_the_node_ends_calls_with_closed_error(fake, make_node):
    node = await make_node("client")
    caller = await node.service_caller("flip", SetBool)
    call = caller.send_request(data=True)
    wire = await fake.called()
    await wire.frame()
    await node.close()
    with pytest.raises(aioros1.ClosedError):
        await call
    assert await wire.is_closed()


@pytest.mark.parametrize("what", ["caller", "node"])
async def test_closing_ends_a_call_that_is_still_shaking_hands(fake, make_node, what):
    node = await make_node("client")  # whose handshakes may take 10 s
    caller = await node.service_caller("flip", SetBool)
    call = caller.send_request(data=True)
    wire = await fake.greeted()
    await (caller if what == "caller" else node).close()
    async with asyncio.timeout(PATIENCE):
        with pytest.raises(aioros1.ClosedError):
            await call
    assert await wire.is_closed()


async def test_a_request_is_one_frame(fake, any_caller):
    call = any_caller.send_request(data=True)
    wire = await fake.called()
    assert await wire.take(5) == flip_request(True)
    await wire.send(flip_answer(True))
    await call
