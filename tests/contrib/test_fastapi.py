"""A node in an application of FastAPI, as uvicorn serves it."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import AsyncIterator
from typing import Annotated, Any

import aiohttp
import pytest
import uvicorn
from fastapi import Depends, FastAPI, Request
from fastapi.responses import StreamingResponse

import aioros1
from aioros1.contrib.starlette import node_lifespan
from aioros1.net.hosts import bind_sockets

PATIENCE = 30


def node_of(request: Request) -> aioros1.Node:
    node: aioros1.Node = request.state.node
    return node


NodeOfApp = Annotated[aioros1.Node, Depends(node_of)]


@contextlib.asynccontextmanager
async def talking(app: FastAPI) -> AsyncIterator[dict[str, Any]]:
    async with app.state.node.advertise("chatter", "std_msgs/String", latch=True) as pub:
        yield {"publisher": pub}


@pytest.fixture
def app(master) -> FastAPI:
    lifespan = node_lifespan("web", inner=talking, master_uri=master.uri, host="localhost")
    app = FastAPI(lifespan=lifespan)

    @app.post("/say", status_code=204)
    async def say(request: Request, text: str) -> None:
        request.state.publisher.publish(data=text)

    @app.get("/last")
    async def last(node: NodeOfApp) -> dict[str, Any]:
        message = await node.wait_for_message("chatter", timeout=PATIENCE)
        return message.to_dict(json=True)

    @app.get("/name")
    def name(node: NodeOfApp) -> str:  # in a thread of FastAPI's
        return node.name

    @app.get("/stream")
    async def stream(node: NodeOfApp) -> StreamingResponse:
        async def words() -> AsyncIterator[str]:
            async with node.subscribe("chatter", "std_msgs/String") as sub:
                async for message in sub:
                    yield message.data

        return StreamingResponse(words())

    return app


@contextlib.asynccontextmanager
async def served(app: FastAPI) -> AsyncIterator[aiohttp.ClientSession]:
    config = uvicorn.Config(app, log_config=None, timeout_graceful_shutdown=1)
    server = uvicorn.Server(config)
    sockets = bind_sockets("localhost")
    serving = asyncio.create_task(server.serve(sockets))
    while not server.started:
        assert not serving.done(), "it has ended"
        await asyncio.sleep(0.01)
    url = f"http://localhost:{sockets[0].getsockname()[1]}"
    timeout = aiohttp.ClientTimeout(PATIENCE)
    try:
        async with aiohttp.ClientSession(url, timeout=timeout) as session:
            yield session
    finally:
        server.should_exit = True
        await serving


async def test_dependencies_and_the_lifespan_of_the_application(app, make_node):
    tester = await make_node("tester")
    async with served(app) as web:
        async with web.post("/say", params={"text": "hello"}) as response:
            assert response.status == 204
        heard = await tester.wait_for_message("chatter", timeout=PATIENCE)
        assert heard.data == "hello"
        async with web.get("/last") as response:
            assert await response.json() == {"data": "hello"}
        async with web.get("/name") as response:
            assert await response.json() == "/web"
        async with web.get("/stream") as response:
            assert await response.content.readexactly(5) == b"hello"
    assert not app.state.node.is_open
    assert "/web" not in (await tester.graph.snapshot()).nodes


async def test_a_mounted_application_has_the_node_of_the_outer_one(app):
    """The lifespan of what is mounted is never run; that is so in Starlette."""
    inner = FastAPI(lifespan=node_lifespan("inner"))

    @inner.get("/name")
    async def name(node: NodeOfApp) -> str:
        return node.name

    app.mount("/inner", inner)
    async with served(app) as web, web.get("/inner/name") as response:
        assert await response.json() == "/web"
