"""``node.log``: what every place in the code logs once, or from time to time."""

from __future__ import annotations

import asyncio
import logging
import pickle
import threading

import pytest

import aioros1
from aioros1 import Duration, Time
from aioros1.log.node_log import NodeLog

SECOND = 1_000_000_000


class Hand:
    """A clock that is set by hand, and a log that goes by it."""

    def __init__(self) -> None:
        self.now = 0
        self.log = NodeLog("/test/log", lambda: self.now)


@pytest.fixture
def hand(caplog):
    caplog.set_level(logging.DEBUG, logger="ros.test.log")
    return Hand()


def test_it_is_an_adapter_of_the_logger_of_that_name(hand, caplog):
    assert isinstance(hand.log, logging.LoggerAdapter)
    assert hand.log.logger is logging.getLogger("ros.test.log")
    hand.log.info("at %d", 5, extra={"joint": "elbow"})
    (record,) = caplog.records
    assert record.getMessage() == "at 5"
    assert (record.ros_node, record.joint) == ("/test/log", "elbow")
    assert pickle.loads(pickle.dumps(record)).ros_node == "/test/log"


def test_once_for_each_place(hand, caplog):
    for number in range(3):
        hand.log.once.warning("first %d", number)
        hand.log.once.info("second %d", number)
        _ = hand.log.once.log(logging.ERROR, "third"), hand.log.once.error("same line")
    assert caplog.messages == ["first 0", "second 0", "third", "same line"]
    assert {record.ros_node for record in caplog.records} == {"/test/log"}


def test_a_level_that_is_off_uses_nothing_up(hand, caplog):
    for level in (logging.ERROR, logging.INFO):
        hand.log.setLevel(level)
        hand.log.once.info("hello")
    assert caplog.messages == ["hello"]


def test_the_place_is_that_of_the_caller(hand, caplog):
    def helper(text):
        hand.log.once.info(text, stacklevel=2)

    helper("a")
    helper("b")
    hand.log.throttle(1).error("c")
    assert caplog.messages == ["a", "b", "c"]
    assert {record.funcName for record in caplog.records} == {
        "test_the_place_is_that_of_the_caller"
    }
    assert {record.pathname for record in caplog.records} == {__file__}


def test_throttled_by_the_time_of_the_node(hand, caplog):
    for now in (0, 1, 4, 5, 6, 9.9, 10, 30):
        hand.now = round(now * SECOND)
        hand.log.throttle(5.0).info("%s", now)
        hand.log.throttle(Duration(100)).warning("rare")
    assert caplog.messages == ["0", "rare", "5", "10", "30"]


def test_a_clock_that_is_set_back_does_not_silence(hand, caplog):
    for now in (100, 101, 3, 4, 8):
        hand.now = now * SECOND
        hand.log.throttle(5).info("%d", now)
    assert caplog.messages == ["100", "3", "8"]


def test_identical_texts_are_held_back_and_others_are_not(hand, caplog):
    for now, state in ((0, "idle"), (1, "idle"), (2, "busy"), (3, "busy"), (7, "busy"), (8, "x")):
        hand.now = now * SECOND
        hand.log.throttle(5, identical=True).info("%s", state)
    assert caplog.messages == ["idle", "busy", "busy", "x"]


def test_every_method_can_be_thinned_out(hand, caplog):
    for _ in range(2):
        try:
            raise LookupError("gone")
        except LookupError:
            hand.log.once.exception("failed")
        hand.log.once.critical("fatal")
        hand.log.once.debug("details")
    assert caplog.messages == ["failed", "fatal", "details"]
    assert "LookupError: gone" in caplog.text


@pytest.mark.parametrize("period", [-1, float("nan"), Duration(-1)])
def test_a_period_must_not_be_negative(hand, period):
    with pytest.raises(ValueError, match="must not be negative, got"):
        hand.log.throttle(period)


def test_what_cannot_be_formatted_is_left_to_the_handlers(hand, capsys):
    stream = logging.StreamHandler()
    hand.log.logger.addHandler(stream)
    hand.log.logger.propagate = False
    try:
        hand.log.throttle(1, identical=True).info("%d", "five")
    finally:
        hand.log.logger.propagate = True
        hand.log.logger.removeHandler(stream)
    assert "--- Logging error ---" in capsys.readouterr().err


def test_code_that_is_made_at_run_time_fills_no_memory(hand, caplog):
    def log_at(line):
        exec(compile("\n" * line + "log.once.info('x')", "<made>", "exec"), {"log": hand.log})

    for line in range(3000):
        log_at(line)
    assert len(caplog.messages) == 3000
    log_at(2000)
    assert len(caplog.messages) == 3000
    log_at(0)  # which it has forgotten
    assert len(caplog.messages) == 3001


def test_once_among_threads(hand, caplog):
    def work():
        for _ in range(100):
            hand.log.once.info("hello")

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert caplog.messages == ["hello"]


async def test_two_nodes_have_places_of_their_own(make_node, caplog):
    nodes = [await make_node(name) for name in ("one", "two")]
    for _ in range(2):
        for node in nodes:
            node.log.once.warning("hello")
    assert [record.ros_node for record in caplog.records] == ["/one", "/two"]


async def test_simulated_time_throttles(make_node, caplog):
    clock = await make_node("clock")
    node = await make_node(use_sim_time=True)
    async with clock.advertise("/clock", "rosgraph_msgs/Clock", latch=True) as pub:
        for secs in (100, 101, 105, 20):
            pub.publish(clock=Time(secs))
            while node.now() != Time(secs):
                await asyncio.sleep(0.001)
            node.log.throttle(5).warning("%d", secs)
    assert caplog.messages == ["100", "105", "20"]


async def test_thinned_out_records_go_to_rosout(make_node):
    listener = await make_node("listener")
    async with listener.subscribe("/rosout", "rosgraph_msgs/Log", queue_size=10) as sub:
        node = await make_node("worker", rosout=True)
        for number in range(3):
            node.log.once.info("once %d", number)
        node.log.info("the end")
        first, last = [await sub.get(timeout=30) for _ in range(2)]
        assert (first.msg, last.msg) == ("once 0", "the end")
        assert (first.file, first.function, first.line) == (__file__, last.function, last.line - 1)


def test_the_types_are_those_of_adapters():
    node = aioros1.Node("typed")
    assert isinstance(node.log.once, logging.LoggerAdapter)
    assert isinstance(node.log.throttle(1), logging.LoggerAdapter)
