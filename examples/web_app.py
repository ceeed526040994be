"""A web application with a ROS node in it: both live in one event loop.

python examples/web_app.py [port]

    GET  /chatter         the last message, as JSON
    POST /chatter         publish the JSON object in the body, {"data": "hello"}
    GET  /chatter/stream  a websocket that gets every message
"""

import asyncio
import sys
import weakref
from collections.abc import AsyncIterator

from aiohttp import WSCloseCode, web

import aioros1
from aioros1.msg.std_msgs import String

NODE = web.AppKey("node", aioros1.Node)
PUBLISHER = web.AppKey("publisher", aioros1.Publisher)
SUBSCRIBER = web.AppKey("subscriber", aioros1.Subscriber)
SOCKETS = web.AppKey("sockets", weakref.WeakSet)


async def ros(app: web.Application) -> AsyncIterator[None]:
    """The node starts and ends with the application."""
    async with (
        aioros1.Node("web_app") as node,
        node.advertise("chatter", String) as pub,
        node.subscribe("chatter", String, queue_size=1) as sub,
    ):
        app[NODE], app[PUBLISHER], app[SUBSCRIBER] = node, pub, sub
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


async def close_sockets(app: web.Application) -> None:
    for socket in set(app[SOCKETS]):
        await socket.close(code=WSCloseCode.GOING_AWAY)


def make_app() -> web.Application:
    app = web.Application()
    app[SOCKETS] = weakref.WeakSet()
    app.cleanup_ctx.append(ros)
    app.on_shutdown.append(close_sockets)
    app.add_routes(
        [
            web.get("/chatter", last),
            web.post("/chatter", publish),
            web.get("/chatter/stream", stream),
        ]
    )
    return app


if __name__ == "__main__":
    web.run_app(make_app(), host="localhost", port=int((sys.argv[1:] or ["8080"])[0]))
