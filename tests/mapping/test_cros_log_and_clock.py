"""Logging, and the time."""

from __future__ import annotations

import io
import logging
import time

import pytest

import aioros1
from aioros1.msg.rosgraph_msgs import Log
from aioros1.msg.std_msgs import String

LEVELS = {
    "ROS_DEBUG": ("debug", Log.DEBUG, 1),
    "ROS_INFO": ("info", Log.INFO, 2),
    "ROS_WARN": ("warning", Log.WARN, 4),
    "ROS_ERROR": ("error", Log.ERROR, 8),
    "ROS_FATAL": ("critical", Log.FATAL, 16),
}


@pytest.fixture
async def talker(make_node, keep_log_level):
    """A node that is heard on ``/rosout``, whatever the level."""
    node = await make_node("talker", namespace="robot", rosout=True, logger_services=True)
    keep_log_level(node.log.logger)
    node.log.setLevel(logging.DEBUG)
    return node


@pytest.fixture
async def rosout(talker, make_node):
    """What comes on ``/rosout``."""
    listener = await make_node("listener")
    async with listener.subscribe("/rosout", "rosgraph_msgs/Log", queue_size=100) as sub:
        await sub.wait_for_publishers(timeout=30)
        yield sub


async def hear(rosout, text):
    while (log := await rosout.get(timeout=30)).msg != text:
        pass
    return log


@pytest.mark.parametrize("macro", LEVELS)
async def test_logging_at_a_level(talker, rosout, macro):
    """CrosLogLevel: 1, 2, 4, 8, 16 are the levels of ``logging``."""
    method, level, number = LEVELS[macro]
    getattr(talker.log, method)("number %d", 5)
    assert (await hear(rosout, "number 5")).level == level == number


@pytest.mark.parametrize("function", ["PRINT_LOG", "cRosLogPrint", "cRosLogNew", "cRosLogFree"])
async def test_logging(talker, rosout, function):
    talker.log.log(logging.INFO, "hello")
    assert (await hear(rosout, "hello")).name == "/robot/talker"


async def test_CrosLog_has_level_name_msg_file_function_line_and_pubs(talker, rosout):
    async with talker.advertise("chatter", String):
        talker.log.warning("hello")
        log = await hear(rosout, "hello")
    assert (log.level, log.name, log.msg) == (Log.WARN, "/robot/talker", "hello")
    assert log.file == __file__
    assert log.function == "test_CrosLog_has_level_name_msg_file_function_line_and_pubs"
    assert log.line > 0
    assert set(log.topics) == {"/rosout", "/robot/chatter"}
    assert log.header.stamp.secs > 0


async def test_stringToLogLevel_is_the_service_set_logger_level(talker, make_node):
    other = await make_node("other")
    await other.wait_for_service("/robot/talker/set_logger_level", timeout=30)
    for text, level in (("debug", 10), ("info", 20), ("warn", 30), ("error", 40), ("fatal", 50)):
        await other.call(
            "/robot/talker/set_logger_level",
            "roscpp/SetLoggerLevel",
            logger=talker.log.logger.name,
            level=text,
            timeout=30,
        )
        assert talker.log.getEffectiveLevel() == level


async def test_LogLevelToString_is_the_service_get_loggers(talker, make_node):
    other = await make_node("other")
    await other.wait_for_service("/robot/talker/get_loggers", timeout=30)
    talker.log.setLevel(logging.ERROR)
    reply = await other.call("/robot/talker/get_loggers", "roscpp/GetLoggers", timeout=30)
    assert [(each.name, each.level) for each in reply.loggers] == [("ros.robot.talker", "error")]


@pytest.mark.parametrize("function", ["cRosOutStreamSet", "cRosOutStreamGet"])
async def test_where_the_log_goes_is_a_matter_of_handlers(make_node, function):
    node = await make_node("talker")
    stream = io.StringIO()
    handler = logging.StreamHandler(stream)
    node.log.logger.addHandler(handler)
    try:
        node.log.warning("hello")
    finally:
        node.log.logger.removeHandler(handler)
    assert stream.getvalue() == "hello\n"


@pytest.mark.parametrize(
    "function",
    [
        "PRINT_INFO",
        "PRINT_DEBUG",
        "PRINT_VDEBUG",
        "PRINT_VVDEBUG",
        "PRINT_ERROR",
        "CROS_DEBUG_LEVEL",
        "FLUSH_PRINT",
    ],
)
async def test_what_the_library_says_is_a_logger(caplog, function):
    with caplog.at_level("INFO", logger="aioros1"):
        async with aioros1.Master(host="localhost", port=0):
            pass
    assert [name for name, level, _ in caplog.record_tuples if level == logging.INFO] == [
        "aioros1.master",
        "aioros1.master",
    ]
    assert logging.getLogger("aioros1").handlers == []


# ------------------------------------------------------------------ the clock


@pytest.mark.parametrize(
    ("function", "read", "wall"),
    [
        ("cRosClockGetTimeMs", lambda now: now.to_nsec() // 10**6, lambda: time.time_ns() // 10**6),
        ("cRosClockGetTimeSecUsec", lambda now: now.to_nsec() // 10**3, None),
        ("cRosClockGetTimeVal", lambda now: (now.secs * 10**9 + now.nsecs) // 10**3, None),
        ("cRosClockGetTimeStamp", lambda now: now.to_sec(), time.time),
        ("cRosClockTimeStampToUSec", lambda now: round(now.to_sec() * 10**6), None),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
async def test_time_now(make_node, function, read, wall):
    node = await make_node()
    wall = wall or (lambda: time.time_ns() // 10**3)
    for now in (node.now, aioros1.Time.now):
        before = wall()
        found = read(now())
        assert before - 1 <= found <= wall() + 1


async def test_cRosClockGetTimeStamp_of_a_simulation(make_node, until):
    """The time of ``/clock``, where the node is told to follow it."""
    clock = await make_node("clock")
    node = await make_node(use_sim_time=True)
    assert node.now() == aioros1.Time()
    async with clock.advertise("/clock", "rosgraph_msgs/Clock", latch=True) as pub:
        pub.publish(clock=aioros1.Time(100, 5))
        await until(lambda: node.now() == aioros1.Time(100, 5))


def test_cRosClockTimeStampToUSec_is_exact():
    assert aioros1.Time(1_700_000_000, 123_456_789).to_nsec() // 1000 == 1_700_000_000_123_456
