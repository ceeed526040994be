"""A web application with a ROS node in it: both live in one event loop.

python examples/web_app.py [port]

    GET  /chatter         the last message, as JSON
    POST /chatter         publish the JSON object in the body, {"data": "hello"}
    GET  /chatter/stream  a websocket that gets every message
    POST /sum             what the service add_two_ints says to {"a": 1, "b": 2}
"""

import asyncio
import sys
import weakref
from collections.abc import AsyncIterator

from aiohttp import WSCloseCode, web

import aioros1
from aioros1.contrib.aiohttp import NODE, node_ctx
from aioros1.msg.std_msgs import String
from aioros1.srv.roscpp_tutorials import TwoInts

PUBLISHER = web.AppKey("publisher", aioros1.Publisher)
SUBSCRIBER = web.AppKey("subscriber", aioros1.Subscriber)
SOCKETS = web.AppKey("sockets", weakref.WeakSet)


async def topics(app: web.Application) -> AsyncIterator[None]:
    """What the application has open as long as it runs."""
    async with (
        app[NODE].advertise("chatter", String) as pub,
        app[NODE].subscribe("chatter", String, queue_size=1) as sub,
    ):
        app[PUBLISHER], app[SUBSCRIBER] = pub, sub
        yield


async def last(request: web.Request) -> web.Response:
    message = request.app[SUBSCRIBER].latest
    if message is None:
        raise web.HTTPNotFound(text="nothing was said yet")
    return web.json_response(message.to_dict(json=True))


async def publish(request: web.Request) -> web.Response:
    try:
        message = String.from_dict(await request.json())
        request.app[PUBLISHER].publish(message)
    except (ValueError, aioros1.SerializationError) as error:
        raise web.HTTPBadRequest(text=str(error)) from error
    return web.Response(status=204)


async def add(request: web.Request) -> web.Response:
    try:
        numbers = TwoInts.Request.from_dict(await request.json())
        answer = await request.app[NODE].call("add_two_ints", TwoInts, numbers, timeout=5)
    except (ValueError, aioros1.SerializationError) as error:
        raise web.HTTPBadRequest(text=str(error)) from error
    except (aioros1.ServiceError, aioros1.MasterError, TimeoutError) as error:
        raise web.HTTPBadGateway(text=str(error)) from error
    return web.json_response(answer.to_dict(json=True))


async def stream(request: web.Request) -> web.WebSocketResponse:
    socket = web.WebSocketResponse()
    await socket.prepare(request)
    request.app[SOCKETS].add(socket)
    # Every browser has a queue of its own, so a slow one loses messages and the others
    # do not. All of them share one connection to each publisher.
    async with request.app[NODE].subscribe("chatter", String) as sub:
        forwarding = asyncio.create_task(forward(sub, socket))
        try:
            async for _ in socket:  # until the browser leaves
                pass
        finally:
            forwarding.cancel()
    return socket


async def forward(sub: aioros1.Subscriber, socket: web.WebSocketResponse) -> None:
    async for message in sub:
        await socket.send_json(message.to_dict(json=True))
    await socket.close(code=WSCloseCode.GOING_AWAY)  # somebody has ended the node


async def close_sockets(app: web.Application) -> None:
    for socket in set(app[SOCKETS]):
        await socket.close(code=WSCloseCode.GOING_AWAY)


def make_app() -> web.Application:
    app = web.Application()
    app[SOCKETS] = weakref.WeakSet()
    app.cleanup_ctx.extend([node_ctx("web_app"), topics])
    app.on_shutdown.append(close_sockets)
    app.add_routes(
        [
            web.get("/chatter", last),
            web.post("/chatter", publish),
            web.get("/chatter/stream", stream),
            web.post("/sum", add),
        ]
    )
    return app


if __name__ == "__main__":
    web.run_app(make_app(), host="localhost", port=int((sys.argv[1:] or ["8080"])[0]))
