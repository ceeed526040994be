"""A node in a web application of aiohttp."""

from __future__ import annotations

import asyncio

import aiohttp
import pytest
from aiohttp import web

import aioros1
from aioros1.contrib.aiohttp import NODE, node_ctx

OTHER = web.AppKey("other", aioros1.Node)


async def started(app: web.Application) -> web.AppRunner:
    runner = web.AppRunner(app)
    await runner.setup()
    return runner


async def test_nodes_start_and_end_with_the_application(master):
    app = web.Application()
    options = {"master_uri": master.uri, "host": "localhost", "rosout": False}
    app.cleanup_ctx.append(node_ctx("one", **options))
    app.cleanup_ctx.append(node_ctx("two", key=OTHER, namespace="/ns", **options))
    assert NODE not in app
    runner = await started(app)
    one, two = app[NODE], app[OTHER]
    assert (one.name, two.name) == ("/one", "/ns/two")
    assert one.is_open
    assert two.is_open
    await runner.cleanup()
    assert (one.state, two.state) == ("closed", "closed")


async def test_what_comes_later_uses_the_node_and_ends_before_it(master):
    ended = []

    async def talk(app):
        async with app[NODE].advertise("chatter", "std_msgs/String"):
            yield
            ended.append(app[NODE].is_open)

    app = web.Application()
    app.cleanup_ctx.extend([node_ctx("web", master_uri=master.uri, host="localhost"), talk])
    runner = await started(app)
    await runner.cleanup()
    assert ended == [True]


async def test_an_application_does_not_start_without_its_node(master):
    app = web.Application()
    app.cleanup_ctx.append(node_ctx("web", master_uri=master.uri, xmlrpc_port=master.port))
    with pytest.raises(OSError, match="in use"):
        await started(app)


async def test_closing_the_node_at_shutdown_ends_handlers_that_stream(master, make_node):
    """aiohttp would wait a minute for them."""

    async def stream(request):
        response = web.StreamResponse()
        await response.prepare(request)
        async with request.app[NODE].subscribe("chatter", "std_msgs/String") as sub:
            async for message in sub:
                await response.write(message.data.encode())
        return response

    async def end_streams(app):
        await app[NODE].close()

    app = web.Application()
    app.cleanup_ctx.append(node_ctx("web", master_uri=master.uri, host="localhost"))
    app.on_shutdown.append(end_streams)
    app.router.add_get("/", stream)
    runner = await started(app)
    await web.TCPSite(runner, "localhost", 0).start()
    port = runner.addresses[0][1]
    node = await make_node("tester")
    async with (
        node.advertise("chatter", "std_msgs/String", latch=True) as pub,
        aiohttp.ClientSession() as session,
        session.get(f"http://localhost:{port}") as response,
    ):
        pub.publish(data="hello")
        assert await response.content.readexactly(5) == b"hello"
        await runner.cleanup()
        assert await response.content.read() == b""


async def test_an_error_in_a_callback_of_the_node_ends_the_application(master):
    """``on_error="raise"``: the task that started the application gets it."""

    def fail(now):
        raise LookupError("what?")

    async def serve():
        app = web.Application()
        app.cleanup_ctx.append(node_ctx("web", master_uri=master.uri, host="localhost"))
        runner = await started(app)
        try:
            app[NODE].timer(0.001, fail)
            await asyncio.Event().wait()
        finally:
            await runner.cleanup()

    with pytest.raises(LookupError, match=r"what\?"):
        await asyncio.wait_for(asyncio.create_task(serve()), 10)
