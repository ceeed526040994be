"""Logging over /rosout, aggregated by Debian's rosout node."""

from __future__ import annotations

import logging

from .ours import take_until
from .processes import Process, until
from .world import World

LOG = "rosgraph_msgs/Log"


async def rosout(world: World) -> Process:
    process = world.start("/usr/lib/rosout/rosout", "__name:=rosout")
    await world.wait_who("subscribers", "/rosout", {"/rosout"})
    return process


async def test_what_our_node_logs_reaches_everybody(under_rosmaster: World) -> None:
    world = under_rosmaster
    await rosout(world)
    echo = world.start("rostopic", "echo", "/rosout_agg")
    async with world.node("talkative") as node:
        await world.wait_who("publishers", "/rosout_agg", {"/rosout"})

        def heard() -> bool:
            node.log.warning("the pressure is %d", 42)
            return "the pressure is 42" in echo.stdout

        await until(heard, what=echo.report)
        await echo.wait_text(r'name: "/talkative"')
        await echo.wait_text(r"level: 4")


async def test_a_level_set_over_the_logger_service(under_rosmaster: World) -> None:
    """rqt_logger_level and rosconsole set it with this service."""
    world = under_rosmaster
    async with (
        world.node("quiet") as node,
        world.node("reader") as reader,
        reader.subscribe("/rosout", LOG, queue_size=100) as sub,
    ):
        await sub.wait_for_publishers(timeout=15)
        for level in ("error", "debug"):
            # Which loggers there are is the node's business; each is set.
            reply = await reader.call("/quiet/get_loggers", "roscpp/GetLoggers", timeout=10)
            assert reply.loggers
            for logger in reply.loggers:
                await world.run(
                    "rosservice",
                    "call",
                    "/quiet/set_logger_level",
                    f"{{logger: {logger.name}, level: {level}}}",
                )
            node.log.info("information under %s", level)
            node.log.error("error under %s", level)
        texts = await take_until(sub, lambda m: m.msg == "error under debug")
        own = [m.msg for m in texts if m.name == "/quiet"]
        assert "error under error" in own
        assert "information under debug" in own
        assert "information under error" not in own
    assert logging.getLogger().level == logging.WARNING
