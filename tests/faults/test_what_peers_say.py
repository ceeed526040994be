"""What peers say goes into logs and errors as one line of bounded length, and not too often."""

from __future__ import annotations

import asyncio
import logging
import traceback

import pytest

import aioros1
from aioros1.msg.std_msgs import String
from aioros1.net.backoff import Backoff
from aioros1.topics import subscription
from aioros1.xmlrpc.server import XmlRpcServer

from .peers import (
    SET_BOOL_MD5,
    WRONG_MD5,
    caller_header,
    dialled,
    frame,
    header,
    subscriber_header,
    until,
)

EVIL = "/x\n[ERROR] [/robot]: forged\r\x1b[2J\x9b\u2028\u202e"
SHOWN = r"/x\n[ERROR] [/robot]: forged\r\x1b[2J\x9b\u2028\u202e"
# XML has no escape sequences.
XML, XML_SHOWN = (text.replace("\x1b", "").replace(r"\x1b", "") for text in (EVIL, SHOWN))
# Longer than what is shown, and within what a header may hold.
ENDLESS = "y" * 900


@pytest.fixture(autouse=True)
def quick(monkeypatch):
    """Connections are tried again sooner than usual."""
    monkeypatch.setattr(subscription, "Backoff", lambda: Backoff(0.01, 0.02))


@pytest.fixture
async def node(make_node):
    return await make_node("victim")


def lines(caplog):
    """What was logged, each of which has to be one line of bounded length."""
    found = [record.getMessage() for record in caplog.records if record.levelno >= logging.INFO]
    for text in found:
        assert text.isprintable(), text
        assert len(text) < 5000
    return found


async def logged(caplog, *words):
    def found():
        return next((text for text in lines(caplog) if all(word in text for word in words)), None)

    return await until(found, f"{words} in the log")


@pytest.mark.parametrize("long", [False, True], ids=["evil", "endless"])
@pytest.mark.parametrize("field", ["callerid", "topic", "type", "md5sum", "service"])
async def test_a_connection_that_is_refused(node, caplog, field, long):
    say = EVIL + ENDLESS if long else EVIL
    changes = {"md5sum": WRONG_MD5, field: say}
    async with node.advertise("chatter", String):
        make = caller_header if field == "service" else subscriber_header
        async with dialled(node, make(**changes)) as wire:
            assert "error" in await wire.read_header()
        text = await logged(caplog, "refused a connection of ", SHOWN)
    # It names the peer, not the node itself.
    who = SHOWN if field == "callerid" else "/fake"
    assert text.startswith(f"refused a connection of {who}")
    assert not text.startswith("refused a connection of /victim")


async def test_many_connections_that_are_refused_do_not_fill_the_log(node, caplog):
    async with node.advertise("chatter", String):
        for number in range(60):
            # The same one again, from other ports, and one with a new name each time.
            for name in ("/again", f"/new{number}"):
                async with dialled(
                    node, subscriber_header(md5sum=WRONG_MD5, callerid=name + ENDLESS)
                ) as wire:
                    assert "error" in await wire.read_header()
        refused = [text for text in lines(caplog) if "refused a connection" in text]
        assert len(refused) <= 32
        assert sum("/again" in text.split(" at ")[0] for text in refused) == 1
        assert sum(map(len, refused)) < 50_000


async def test_what_is_logged_is_published_on_rosout_as_one_line(make_node, caplog):
    viewer, node = await make_node("viewer"), await make_node("loud", rosout=True)
    async with (
        viewer.subscribe("/rosout", "rosgraph_msgs/Log", queue_size=100) as records,
        node.advertise("chatter", String),
    ):
        async with dialled(node, subscriber_header(md5sum=WRONG_MD5, callerid=EVIL)) as wire:
            await wire.read_header()
        async with asyncio.timeout(30):
            async for record in records:
                if "refused" in record.msg:
                    break
        assert record.msg.isprintable()
        assert SHOWN in record.msg


@pytest.mark.parametrize("long", [False, True], ids=["evil", "endless"])
@pytest.mark.parametrize("field", ["error", "type", "md5sum"])
async def test_a_publisher_that_answers_so(node, make_publisher, caplog, field, long):
    say = EVIL + ENDLESS if long else EVIL
    fake = await make_publisher()
    answer = {"callerid": EVIL, "md5sum": WRONG_MD5, "type": "std_msgs/String", "topic": "/chatter"}
    async with node.subscribe("chatter", String) as sub:
        for _ in range(5):
            wire = await fake.greeted()
            await wire.send(header({**answer, field: say}))
        text = await logged(caplog, "subscriber /chatter", SHOWN)
        assert lines(caplog).count(text) == 1
        with pytest.raises(TimeoutError) as caught:
            await sub.wait_for_publishers(timeout=0.05)
        assert SHOWN in str(caught.value)
        assert str(caught.value).isprintable()
        assert len(str(caught.value)) < 5000


@pytest.mark.parametrize(
    "answer",
    [
        [0, XML, []],
        [1, XML, XML + ENDLESS],
        [1, "ready", ["TCPROS", XML, 80]],
        [1, "ready", ["TCPROS", XML + ENDLESS, 80]],
        XML + ENDLESS,
    ],
    ids=["refused", "nonsense", "host", "long host", "text"],
)
async def test_a_publisher_that_answers_request_topic_so(node, make_publisher, caplog, answer):
    fake = await make_publisher()
    fake.ready = answer
    async with node.subscribe("chatter", String):
        await until(lambda: fake.requests >= 3)
        await logged(caplog, "subscriber /chatter", r"forged\r")


async def test_an_address_that_somebody_announced(node, ask, caplog):
    async with node.subscribe("chatter", String):
        for uri in (f"http://{XML}", f"http://nobody.invalid/{XML}{ENDLESS}"):
            await ask(node, "publisherUpdate", "/chatter", [uri])
            await logged(caplog, "subscriber /chatter", r"forged\r")
            caplog.clear()
            await ask(node, "publisherUpdate", "/chatter", [])


async def test_being_told_to_end(make_node, ask, caplog):
    node = await make_node("told")
    await ask(node, "shutdown", XML + ENDLESS)
    reason = await node.wait_closed()
    assert reason.isprintable()
    assert XML_SHOWN in reason
    assert len(reason) < 1000
    with pytest.raises(aioros1.ClosedError) as caught:
        await node.get_param("x")
    assert str(caught.value).isprintable()
    lines(caplog)


@pytest.mark.parametrize("long", [False, True], ids=["evil", "endless"])
@pytest.mark.parametrize("way", ["status", "fault", "reason", "value"])
async def test_a_master(node, way, long, free_master):
    say = XML + ENDLESS if long else XML

    def answer(*args):
        if way == "fault":
            raise RuntimeError(say)
        return {"status": [-1, say, 0], "value": [1, "", {"x": say}], "reason": say}[way]

    asking = [lambda: node.master.get_pid(), lambda: node.advertise("chatter", String)]
    if way != "value":  # a list of strings is what the others answer
        asking += [lambda: node.peer("/other")]
    uri = await free_master({"getPid": answer, "registerPublisher": answer, "lookupNode": answer})
    async with aioros1.Node("n", master_uri=uri, host="localhost", heartbeat=None) as node:
        for ask in asking:
            with pytest.raises(aioros1.MasterError) as caught:
                await ask()
            _check(caught.value)


@pytest.fixture
async def free_master():
    servers = []

    async def start(methods):
        server = XmlRpcServer(methods, log=logging.getLogger("test.fake"))
        logging.getLogger("test.fake").disabled = True
        servers.append(server)
        await server.start("127.0.0.1")
        return f"http://127.0.0.1:{server.port}/"

    yield start
    for server in servers:
        await server.close()


def _check(error):
    """An error, however it is shown: in one line each, bounded, and without causes."""
    for text in (str(error), repr(error)):
        assert text.isprintable(), text
        assert len(text) < 5000
    shown = "".join(traceback.format_exception(error))
    assert shown.count("Traceback") == 1
    assert "\x1b" not in shown
    assert len(shown) < 20_000


@pytest.mark.parametrize("long", [False, True], ids=["evil", "endless"])
async def test_a_provider(node, make_provider, caplog, long):
    say = EVIL + ENDLESS if long else EVIL
    fake = await make_provider()
    async with node.service_caller("flip", "std_srvs/SetBool") as caller:
        for reply, kind in (
            (header({"error": say}), aioros1.HandshakeError),
            (header({"callerid": say, "md5sum": WRONG_MD5, "type": say}), aioros1.HandshakeError),
            (
                header({"callerid": "/fake", "md5sum": SET_BOOL_MD5})
                + b"\x00"
                + frame(say.encode("utf-8", "surrogateescape")),
                aioros1.ServiceError,
            ),
        ):
            call = caller.send_request(data=True)
            wire = await fake.greeted()
            await wire.send(reply)
            with pytest.raises(kind) as caught:
                await call
            _check(caught.value)
        # A program gets what was said as it was said.
        assert caught.value.text == say
        await fake.register(f"rosrpc://{XML + ENDLESS if long else XML}")
        with pytest.raises(aioros1.ServiceUnavailable) as caught:
            await caller.call(data=True)
        _check(caught.value)
    opening = asyncio.ensure_future(_open(node.service_caller("flip")))
    await fake.register()
    wire = await fake.greeted()
    await wire.send(header({"callerid": say, "md5sum": SET_BOOL_MD5, "type": say}))
    with pytest.raises(aioros1.RosError) as caught:
        await opening
    assert str(caught.value).isprintable()


async def _open(opening):
    return await opening


async def test_a_connection_shows_its_peer_safely(node):
    async with node.advertise("chatter", String) as pub:
        events = node.events()
        async with dialled(node, subscriber_header(callerid=EVIL + ENDLESS)) as wire:
            await wire.read_header()
            await until(lambda: pub.connections)
            (info,) = pub.connections
            assert info.peer == EVIL + ENDLESS  # a program gets what was said
            async for event in events:
                if isinstance(event, aioros1.PeerConnected) and event.name == "/chatter":
                    break
            for shown in (repr(info), repr(event), repr(pub.connections)):
                assert SHOWN in shown
                assert shown.isprintable()
                assert len(shown) < 1500
                assert "message_definition" not in shown


async def test_a_message_event_does_not_show_the_definition(node, make_publisher):
    fake = await make_publisher()
    async with node.subscribe("chatter", String) as sub:
        wire = await fake.subscribed()
        await wire.send(frame(frame(b"hello")))
        await sub.get(timeout=30)
        shown = repr(sub.latest_event)
    assert "hello" in shown
    assert "message_definition" not in shown


async def test_a_type_that_differs_is_logged_once_on_each_side(make_node, caplog):
    talker, listener = await make_node("talker"), await make_node("listener")
    async with (
        talker.advertise("chatter", String) as pub,
        listener.subscribe("chatter", "std_msgs/Int32") as sub,
    ):
        with pytest.raises(TimeoutError) as late:
            await sub.wait_for_publishers(timeout=0.6)  # more than a dozen attempts
        for words in ("std_msgs/Int32", "std_msgs/String", "md5sum", "/chatter"):
            assert words in str(late.value)
        with pytest.raises(TimeoutError) as late:
            await pub.wait_for_subscribers(timeout=0.05)
        for words in ("/listener", "std_msgs/Int32", "std_msgs/String"):
            assert words in str(late.value)
    said = [text for text in lines(caplog) if "md5sum" in text]
    assert len(said) == 2, said
    assert any("subscriber /chatter" in text for text in said)
    assert any("refused a connection of /listener at" in text for text in said)


async def test_a_handler_that_fails_again_and_again_does_not_fill_the_log(node, caplog):
    def handler(request):
        raise ValueError("stuck")

    async with (
        node.advertise_service("flip", "std_srvs/SetBool", handler),
        node.service_caller("flip", "std_srvs/SetBool") as caller,
    ):
        for _ in range(20):
            with pytest.raises(aioros1.ServiceError, match="stuck"):
                await caller.call(data=True)
    assert sum("the handler failed" in text for text in lines(caplog)) == 1
    caplog.clear()
