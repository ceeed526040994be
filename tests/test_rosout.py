"""What nodes log, on /rosout and /rosout_agg."""

from __future__ import annotations

import logging

import pytest

import aioros1


async def test_the_master_relays_what_nodes_log():
    async with (
        aioros1.Master(host="localhost", port=0) as master,
        aioros1.Node("viewer", master_uri=master.uri, rosout=False) as viewer,
        viewer.subscribe("/rosout_agg", "rosgraph_msgs/Log", queue_size=100) as sub,
        aioros1.Node("worker", master_uri=master.uri) as worker,
    ):
        worker.log.warning("overheated: %d degrees", 91)
        record = await sub.get(timeout=5)
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


async def test_log_levels_are_served(make_node):
    node = await make_node("worker", rosout=True, logger_services=True)
    other = await make_node("other")
    name = "ros.worker"
    await other.wait_for_service("/worker/set_logger_level", timeout=5)
    await other.call(
        "/worker/set_logger_level", "roscpp/SetLoggerLevel", logger=name, level="DEBUG"
    )
    assert node.log.isEnabledFor(logging.DEBUG)
    reply = await other.call("/worker/get_loggers", "roscpp/GetLoggers")
    assert [(each.name, each.level) for each in reply.loggers] == [(name, "debug")]


async def test_a_level_that_does_not_exist_is_refused_with_a_reason(make_node):
    await make_node("worker", logger_services=True)
    other = await make_node("other")
    await other.wait_for_service("/worker/set_logger_level", timeout=5)
    with pytest.raises(aioros1.ServiceError) as caught:
        await other.call(
            "/worker/set_logger_level", "roscpp/SetLoggerLevel", logger="x", level="loud"
        )
    expected = "unknown level 'loud', expected one of debug, info, warn, error, fatal"
    assert caught.value.text == expected
