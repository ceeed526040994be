"""What nodes log, on /rosout and /rosout_agg."""

from __future__ import annotations

import asyncio
import logging
import os
import signal
import socket
import struct
import sys
import threading
from pathlib import Path

import pytest

import aioros1
from aioros1.xmlrpc.client import XmlRpcClient
from aioros1.xmlrpc.master_proxy import MasterProxy

LOG = "rosgraph_msgs/Log"
ROOT = Path(__file__).parent.parent.parent


@pytest.fixture
async def heard(make_node):
    """What comes on ``/rosout``; nothing is missed, for it was there first."""
    listener = await make_node("listener")
    async with listener.subscribe("/rosout", LOG, queue_size=1000) as sub:
        yield sub


async def take(sub, count):
    return [await sub.get(timeout=30) for _ in range(count)]


async def texts_until(sub, last):
    texts = []
    while not texts or texts[-1] != last:
        texts.append((await sub.get(timeout=30)).msg)
    return texts


async def test_the_master_relays_what_nodes_log():
    async with (
        aioros1.Master(host="localhost", port=0) as master,
        aioros1.Node("viewer", master_uri=master.uri, rosout=False) as viewer,
        viewer.subscribe("/rosout_agg", "rosgraph_msgs/Log", queue_size=100) as sub,
        aioros1.Node("worker", master_uri=master.uri) as worker,
    ):
        worker.log.warning("overheated: %d degrees", 91)
        record = await sub.get(timeout=30)
        assert (record.name, record.level, record.msg) == (
            "/worker",
            record.WARN,
            "overheated: 91 degrees",
        )
        assert record.file == __file__
        assert record.function == "test_the_master_relays_what_nodes_log"
        assert "/rosout" in record.topics
        assert record.header.seq > 0
        assert record.header.stamp.to_sec() > 0


@pytest.mark.parametrize(
    ("level", "expected"),
    [(1, 1), (10, 1), (15, 1), (20, 2), (25, 2), (30, 4), (40, 8), (50, 16), (60, 16)],
)
async def test_levels_in_between_count_as_the_one_below(make_node, heard, level, expected):
    node = await make_node("worker", rosout=True)
    node.log.setLevel(1)
    node.log.log(level, "x")
    assert (await heard.get(timeout=30)).level == expected
    node.log.setLevel(logging.INFO)


async def test_exceptions_and_stacks_are_in_the_text(make_node, heard):
    node = await make_node("worker", rosout=True)
    try:
        raise LookupError("no such joint")
    except LookupError:
        node.log.exception("cannot move")
    node.log.info("here", stack_info=True)
    failed, here = await take(heard, 2)
    assert failed.msg.startswith("cannot move\nTraceback (most recent call last):\n")
    assert failed.msg.endswith("LookupError: no such joint")
    assert failed.level == failed.ERROR
    assert here.msg.startswith("here\nStack (most recent call last):\n")


async def test_loggers_of_the_application_by_name(make_node, heard):
    node = await make_node("planner", rosout=["test_app", "test_app.deep"])
    logging.getLogger("test_app.deep.er").warning("from below")
    logging.getLogger("test_other").warning("not for the graph")
    logging.getLogger("test_app").info("not at the level of the application")
    node.log.logger.getChild("part").info("of a part of the node")
    node.log.info("the end")
    texts = await texts_until(heard, "the end")
    assert texts == ["from below", "of a part of the node", "the end"]
    await node.close()
    for name in ("test_app", "test_app.deep", "ros.planner"):
        assert logging.getLogger(name).handlers == []
        assert logging.getLogger(name).level == logging.NOTSET


@pytest.mark.parametrize("names", ["test_app", [""], ["root"], [None], 3])
def test_the_root_logger_is_not_to_be_had(names):
    with pytest.raises(ValueError, match="rosout must"):
        aioros1.Node("worker", rosout=names)


async def test_a_node_does_not_speak_for_one_below_its_name(make_node, heard):
    inner = await make_node("arm", namespace="/robot", rosout=True)
    outer = await make_node("robot", rosout=True)
    inner.log.info("of the arm")
    inner.log.logger.getChild("hand").info("of its hand")
    outer.log.info("of the robot")
    assert [(each.name, each.msg) for each in await take(heard, 3)] == [
        ("/robot/arm", "of the arm"),
        ("/robot/arm", "of its hand"),
        ("/robot", "of the robot"),
    ]


async def test_a_burst_is_relayed_whole(make_node):
    """roscore's rosout has queues without an end."""
    async with (
        aioros1.Master(host="localhost", port=0) as master,
        aioros1.Node("viewer", master_uri=master.uri, rosout=False) as viewer,
        viewer.subscribe("/rosout_agg", LOG, queue_size=10_000) as sub,
        aioros1.Node("worker", master_uri=master.uri, rosout=False) as worker,
        worker.advertise("/rosout", LOG, queue_size=3000) as pub,
    ):
        await pub.wait_for_subscribers(timeout=30)
        await sub.wait_for_publishers(timeout=30)
        for number in range(3000):
            pub.publish(line=number)
        assert [each.line for each in await take(sub, 3000)] == list(range(3000))


async def test_topics_are_left_out_where_the_graph_wants_that(make_node, heard):
    other = await make_node("other")
    for value, expected in ((True, []), (False, ["/rosout"])):
        await other.set_param("/rosout_disable_topics_generation", value)
        node = await make_node("worker", rosout=True)
        node.log.info("hello")
        assert (await heard.get(timeout=30)).topics == expected
        await node.close()


async def test_threads_lose_nothing(make_node, heard):
    node = await make_node("worker", rosout=["test_threads"])
    log = logging.getLogger("test_threads")

    def work(name):
        for number in range(50):
            log.warning("%s %d", name, number)

    threads = [threading.Thread(target=work, args=(name,)) for name in "abcd"]
    for thread in threads:
        thread.start()
    texts = [each.msg for each in await take(heard, 200)]
    for name in "abcd":
        assert [text for text in texts if text[0] == name] == [f"{name} {i}" for i in range(50)]
    for thread in threads:
        thread.join()
    await node.close()
    await asyncio.to_thread(work, "late")  # nobody hears it, and nothing breaks


async def test_what_was_logged_before_the_topic_had_subscribers(make_node):
    node = await make_node("worker", rosout=True)
    for number in range(3):
        node.log.info("early %d", number)
    other = await make_node("other")
    async with other.subscribe("/rosout", LOG, queue_size=10) as sub:
        assert [each.msg for each in await take(sub, 3)] == ["early 0", "early 1", "early 2"]


async def test_the_last_record_is_latched(make_node, heard):
    node = await make_node("worker", rosout=True)
    node.log.info("first")
    node.log.info("last")
    await take(heard, 2)
    other = await make_node("other")
    async with other.subscribe("/rosout", LOG) as late:
        assert (await late.get(timeout=30)).msg == "last"
        assert late.queued == 0


async def test_what_is_logged_while_the_node_closes_arrives(make_node, heard):
    node = await make_node("worker", rosout=True)

    async def work():
        try:
            async with node.subscribe("nothing", "std_msgs/String") as sub:
                try:
                    async for _ in sub:
                        pass
                finally:
                    node.log.info("the loop has ended")
        finally:
            node.log.info("and its subscriber is closed")

    working = asyncio.create_task(work())
    while not any(role.kind == "subscriber" for role in node.roles):
        await asyncio.sleep(0.001)
    for number in range(50):
        node.log.info("before %d", number)
    await node.close()
    await working
    texts = await texts_until(heard, "and its subscriber is closed")
    assert texts == [f"before {i}" for i in range(50)] + [
        "the loop has ended",
        "and its subscriber is closed",
    ]


async def test_what_a_short_life_has_to_say_arrives_everywhere(make_node, heard, master):
    other = await make_node("other")
    async with other.subscribe("/rosout", LOG, queue_size=10) as sub:
        async with aioros1.Node("brief", master_uri=master.uri, host="localhost") as node:
            node.log.error("no such device")
            node.log.info("the end")
        for each in (heard, sub):
            assert [record.msg for record in await take(each, 2)] == ["no such device", "the end"]


async def test_a_short_life_ends_without_a_master_too():
    async with aioros1.Node("brief", master_uri="http://localhost:1/", host="localhost") as node:
        node.log.error("nobody is there")
    assert node.log.logger.handlers == []


async def test_a_known_subscriber_that_is_dead_does_not_hold_up_an_abort(make_node, monkeypatch):
    monkeypatch.setattr("aioros1.node.rosout._FIRST_SUBSCRIBERS", 60)
    other = await make_node("other")
    await other.master.register_subscriber("/rosout", LOG, "http://localhost:1/")
    node = await make_node("brief", rosout=True, timeouts=aioros1.Timeouts(close=60))
    node.log.info("hello")
    while not node.roles:
        await asyncio.sleep(0.001)
    closing = asyncio.create_task(node.close())
    while node.close_reason is None:
        await asyncio.sleep(0.001)
    node.abort()
    await closing
    assert node.state == "closed"


SCRIPT = """
import asyncio, aioros1
async def tick(node):
    try:
        async for now in node.rate(1000):
            node.log.once.info("ready")
    finally:
        node.log.info("the rate has ended")
async def main(node):
    try:
        async with asyncio.TaskGroup() as group:
            group.create_task(tick(node))
    finally:
        node.log.info("main has ended")
aioros1.run(main, "script")
"""


@pytest.mark.skipif(os.name != "posix", reason="ends a program by a signal")
async def test_what_a_script_says_in_finally_after_a_signal_arrives(heard, master):
    process = await asyncio.create_subprocess_exec(
        *(sys.executable, "-W", "error", "-c", SCRIPT),
        env={"ROS_MASTER_URI": master.uri, "PYTHONPATH": str(ROOT), "PATH": ""},
        stderr=asyncio.subprocess.PIPE,
    )
    assert (await heard.get(timeout=15)).msg == "ready"
    process.send_signal(signal.SIGINT)
    _, errors = await asyncio.wait_for(process.communicate(), 40)
    assert (errors, process.returncode) == (b"", 0)
    texts = await texts_until(heard, "main has ended")
    assert [text for text in texts if text.endswith("ended")] == [
        "the rate has ended",
        "main has ended",
    ]


async def test_what_is_logged_before_the_end_of_the_block_arrives(make_node, heard, master):
    with pytest.raises(LookupError):
        async with aioros1.Node("worker", master_uri=master.uri, host="localhost") as node:
            try:
                node.log.info("connected")
                assert (await heard.get(timeout=30)).msg == "connected"
                raise LookupError
            finally:
                node.log.info("in finally")
    assert (await heard.get(timeout=30)).msg == "in finally"


async def test_a_record_that_cannot_be_formatted_is_told_and_hurts_nobody(
    make_node, heard, capsys, monkeypatch
):
    class Broken:
        def __str__(self):
            raise RuntimeError("no text")

    node = await make_node("worker", rosout=True)
    # pytest's own handlers raise.
    monkeypatch.setattr(node.log.logger, "propagate", False)
    node.log.info("%d apples", "five")
    node.log.info(Broken())
    node.log.info("half of a pair: \ud800")
    node.log.logger.handle(logging.makeLogRecord({"msg": "made by hand", "levelno": 20}))
    assert [each.msg for each in await take(heard, 2)] == [
        "half of a pair: \\ud800",
        "made by hand",
    ]
    errors = capsys.readouterr().err
    assert errors.count("--- Logging error ---") == 2
    assert "Message: '%d apples'" in errors
    assert "RuntimeError: no text" in errors


async def test_what_no_handler_of_the_application_takes_is_printed_as_without_us(
    make_node, capsys, monkeypatch
):
    """logging prints warnings of a program that has set up nothing, each once."""
    names = ["test_silent"]
    node = await make_node("worker", rosout=names)
    await make_node("other", rosout=names)
    app = logging.getLogger("test_silent")
    for logger in (node.log.logger, app):
        monkeypatch.setattr(logger, "propagate", False)  # pytest has handlers
    for log in (node.log, app):
        log.info("not shown")
        log.warning("shown")
    assert capsys.readouterr().err == "shown\nshown\n"
    app.addHandler(handler := logging.NullHandler())
    app.warning("the application has seen to it")
    app.removeHandler(handler)
    monkeypatch.setattr(logging, "lastResort", None)
    app.warning("nor is it wanted")
    assert capsys.readouterr().err == ""


async def test_a_handler_that_logs_ends(make_node, heard):
    node = await make_node("worker", rosout=["test_echo"])

    class Echo(logging.Handler):
        def emit(self, record):
            logging.getLogger("test_echo").warning("heard %s", record.getMessage())

    handler = Echo()
    node.log.logger.addHandler(handler)
    try:
        node.log.info("one")
        node.log.info("two")
    finally:
        node.log.logger.removeHandler(handler)
    assert {each.msg for each in await take(heard, 4)} == {"one", "two", "heard one", "heard two"}


async def test_what_publishing_itself_logs_is_not_published(make_node, heard, monkeypatch):
    """Or each record would bring the next, for ever."""
    node = await make_node("worker", rosout=True)
    node.log.info("ready")
    await take(heard, 1)
    publisher = next(role for role in node.roles if role.name == "/rosout")
    publish = type(publisher).publish
    calls = []

    def talkative(self, *args, **fields):
        calls.append(fields["msg"])
        node.log.warning("about to publish")
        publish(self, *args, **fields)

    monkeypatch.setattr(type(publisher), "publish", talkative)
    node.log.info("hello")
    assert (await heard.get(timeout=30)).msg == "hello"
    assert calls == ["hello"]


async def test_levels_come_back_unless_the_application_has_changed_them(make_node):
    logger = logging.getLogger("test_levels")
    logger.setLevel(logging.ERROR)
    other = await make_node("other")

    async def set_level(level):
        await other.call(
            "/worker/set_logger_level", "roscpp/SetLoggerLevel", logger="test_levels", level=level
        )

    for by_hand in (None, logging.CRITICAL):
        node = await make_node("worker", rosout=["test_levels"], logger_services=True)
        await other.wait_for_service("/worker/set_logger_level", timeout=30)
        await set_level("debug")
        await set_level("info")
        assert logger.level == logging.INFO
        if by_hand is not None:
            logger.setLevel(by_hand)
        await node.close()
        assert logger.level == (by_hand or logging.ERROR)
    logger.setLevel(logging.NOTSET)


async def test_levels_stay_while_another_node_needs_them(make_node):
    """As when a node of the same name takes the place of the first."""
    first = await make_node("worker", rosout=True)
    second = await make_node("worker", rosout=True)
    await asyncio.wait_for(first.wait_closed(), 30)
    assert second.log.isEnabledFor(logging.INFO)
    await second.close()
    assert second.log.logger.level == logging.NOTSET


async def test_levels_come_back_when_the_last_node_has_closed(make_node):
    logger = logging.getLogger("test_shared")
    other = await make_node("other")
    nodes = []
    for name, level in (("one", "debug"), ("two", "error")):
        nodes.append(await make_node(name, rosout=["test_shared"], logger_services=True))
        service = f"/{name}/set_logger_level"
        await other.wait_for_service(service, timeout=30)
        await other.call(service, "roscpp/SetLoggerLevel", logger="test_shared", level=level)
    for node, level in zip(nodes, (logging.ERROR, logging.NOTSET), strict=True):
        await node.close()
        assert logger.level == level


async def test_log_levels_are_served(make_node):
    node = await make_node("worker", rosout=True, logger_services=True)
    other = await make_node("other")
    name = "ros.worker"
    await other.wait_for_service("/worker/set_logger_level", timeout=30)
    await other.call(
        "/worker/set_logger_level", "roscpp/SetLoggerLevel", logger=name, level="DEBUG"
    )
    assert node.log.isEnabledFor(logging.DEBUG)
    reply = await other.call("/worker/get_loggers", "roscpp/GetLoggers")
    assert [(each.name, each.level) for each in reply.loggers] == [(name, "debug")]


async def test_loggers_below_are_served_too(make_node):
    logging.getLogger("test_tree.a.b")
    node = await make_node("tall", rosout=["test_tree"], logger_services=True)
    node.log.logger.getChild("part").setLevel(logging.ERROR)
    other = await make_node("other")
    await other.wait_for_service("/tall/set_logger_level", timeout=30)
    # One that does not exist yet, as with rospy and roscpp.
    await other.call(
        "/tall/set_logger_level", "roscpp/SetLoggerLevel", logger="test_tree.new", level="fatal"
    )
    reply = await other.call("/tall/get_loggers", "roscpp/GetLoggers")
    assert [(each.name, each.level) for each in reply.loggers] == [
        ("ros.tall", "info"),
        ("test_tree", "warn"),
        ("ros.tall.part", "error"),
        ("test_tree.a.b", "warn"),
        ("test_tree.new", "fatal"),
    ]


async def test_a_level_that_does_not_exist_is_refused_with_a_reason(make_node):
    await make_node("worker", logger_services=True)
    other = await make_node("other")
    await other.wait_for_service("/worker/set_logger_level", timeout=30)
    with pytest.raises(aioros1.ServiceError) as caught:
        await other.call(
            "/worker/set_logger_level", "roscpp/SetLoggerLevel", logger="x", level="loud"
        )
    expected = "unknown level 'loud', expected one of debug, info, warn, error, fatal"
    assert caught.value.text == expected


@pytest.mark.parametrize("logger", ["", "root", "asyncio", "ros.workers"])
async def test_a_logger_of_somebody_else_is_refused_with_a_reason(make_node, logger):
    await make_node("worker", logger_services=True)
    other = await make_node("other")
    await other.wait_for_service("/worker/set_logger_level", timeout=30)
    with pytest.raises(aioros1.ServiceError) as caught:
        await other.call(
            "/worker/set_logger_level", "roscpp/SetLoggerLevel", logger=logger, level="debug"
        )
    expected = f"unknown logger {logger!r}, expected one of ros.worker, or one below"
    assert caught.value.text == expected


async def test_short_lives_are_no_reason_to_warn(caplog):
    """Whoever relays ``/rosout`` meets nodes that are not ready yet, or have just gone."""
    async with aioros1.Master(host="localhost", port=0) as master:

        async def live(number):
            node = aioros1.Node(f"short{number}", master_uri=master.uri, host="localhost")
            async with node:
                if number % 2:
                    await node.advertise("chatter", "std_msgs/String")

        for number in range(10):
            await live(number)
        await asyncio.gather(*map(live, range(10, 20)))
    assert [each.getMessage() for each in caplog.records if each.levelname != "INFO"] == []


async def test_a_node_that_is_gone_from_rosout_is_no_reason_to_warn(caplog):
    async with (
        aioros1.Master(host="localhost", port=0, rosout=False) as master,
        aioros1.Node("viewer", master_uri=master.uri, host="localhost", rosout=False) as viewer,
        viewer.subscribe("/rosout", "rosgraph_msgs/Log") as records,
    ):
        with socket.socket() as sock:
            sock.bind(("127.0.0.1", 0))
            gone = f"http://127.0.0.1:{sock.getsockname()[1]}/"
            caplog.set_level("DEBUG", logger="ros.viewer")
            client = XmlRpcClient()
            await MasterProxy(client, master.uri, "/gone").register_publisher(
                "/rosout", "rosgraph_msgs/Log", gone
            )
            async with asyncio.timeout(30):
                while gone not in caplog.text:
                    await asyncio.sleep(0.01)
            await client.close()
        # One that asks for the records of a node that has none.
        host, port = viewer.tcpros_address
        reader, writer = await asyncio.open_connection(host, port)
        fields = ["callerid=/rosout", f"md5sum={records.md5sum}", "topic=/rosout"]
        parts = b"".join(struct.pack("<I", len(each)) + each.encode() for each in fields)
        writer.write(struct.pack("<I", len(parts)) + parts)
        assert b"does not publish /rosout" in await reader.read()
        writer.close()
    assert [each.getMessage() for each in caplog.records if each.levelname == "WARNING"] == []
