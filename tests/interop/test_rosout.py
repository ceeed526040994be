"""Logging over /rosout, aggregated by Debian's rosout node."""

from __future__ import annotations

import asyncio
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


async def test_rosout_as_rostopic_shows_it(under_rosmaster: World) -> None:
    """Fields of every kind, with the loggers of the application, up to the end of the node."""
    world = under_rosmaster
    log = logging.getLogger("interop_app.arm")
    async with world.node("shown", rosout=["interop_app"]) as node:
        echo = world.start("rostopic", "echo", "/rosout")

        def heard() -> bool:
            node.log.info("ready")
            return 'msg: "ready"' in echo.stdout

        await until(heard, what=echo.report)
        await asyncio.to_thread(log.error, "the arm is %s", "stuck")
        try:
            raise LookupError("no such joint")
        except LookupError:
            node.log.exception("cannot move")
        for _ in range(3):
            node.log.once.warning("only once")
        node.log.info("the last words")
    await echo.wait_text(r'msg: "the last words"')
    text = echo.stdout
    assert 'msg: "the arm is stuck"' in text
    assert "LookupError: no such joint" in text
    assert text.count('msg: "only once"') == 1
    assert 'function: "test_rosout_as_rostopic_shows_it"' in text
    assert f'file: "{__file__}"' in text
    assert "/rosout" in text


async def test_rosservice_is_told_why(under_rosmaster: World) -> None:
    world = under_rosmaster
    async with world.node("strict", rosout=["interop_strict"]) as node:
        await node.wait_for_service("~set_logger_level", timeout=15)
        listed = await world.run("rosservice", "call", "/strict/get_loggers")
        assert 'name: "ros.strict"' in listed.stdout
        assert 'name: "interop_strict"' in listed.stdout
        setter = ("rosservice", "call", "/strict/set_logger_level")
        await world.run(*setter, "{logger: interop_strict, level: Debug}")
        assert logging.getLogger("interop_strict").level == logging.DEBUG
        for request, why in (
            ("{logger: interop_strict, level: loud}", "unknown level 'loud'"),
            ("{logger: root, level: debug}", "unknown logger 'root'"),
        ):
            refused = await world.run(*setter, request, code=None)
            assert why in refused.text
    assert logging.getLogger("interop_strict").level == logging.NOTSET


async def test_a_short_life_is_heard_by_everybody(under_rosmaster: World) -> None:
    """Nothing waits for anybody but the end of the node, and nothing is lost."""
    world = under_rosmaster
    await rosout(world)
    echoes = [world.start("rostopic", "echo", topic) for topic in ("/rosout", "/rosout_agg")]
    async with world.node("talkative") as node:

        def heard() -> bool:
            node.log.info("ready")
            return all("ready" in echo.stdout for echo in echoes)

        await until(heard, what=echoes[1].report)
    async with world.node("brief") as node:
        for number in range(200):
            node.log.info("number %d", number)
    for echo in echoes:
        await echo.wait_text(r'msg: "number 199"')
        assert echo.stdout.count('msg: "number ') == 200
