"""A node in an application of Starlette, served by uvicorn; FastAPI takes the same lifespan.

python examples/starlette_app.py [port]

    POST /chatter         publish the JSON object in the body, {"data": "hello"}
    GET  /chatter/stream  every message, as server-sent events
    POST /sum             what the service add_two_ints says to {"a": 1, "b": 2}
    GET  /health          200 while the node is open, 503 when somebody has ended it
"""

import contextlib
import json
import sys
from collections.abc import AsyncIterator

import uvicorn
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import JSONResponse, PlainTextResponse, Response, StreamingResponse
from starlette.routing import Route

import aioros1
from aioros1.contrib.starlette import node_lifespan
from aioros1.msg.std_msgs import String
from aioros1.srv.roscpp_tutorials import TwoInts


@contextlib.asynccontextmanager
async def topics(app: Starlette) -> AsyncIterator[dict[str, aioros1.Publisher]]:
    """What the application has open as long as it runs."""
    async with app.state.node.advertise("chatter", String) as pub:
        yield {"publisher": pub}


async def publish(request: Request) -> Response:
    try:
        request.state.publisher.publish(String.from_dict(await request.json()))
    except (ValueError, aioros1.SerializationError) as error:
        return PlainTextResponse(str(error), 400)
    return Response(status_code=204)


async def stream(request: Request) -> Response:
    async def events() -> AsyncIterator[str]:
        # Cancelled, and so closed, when the browser leaves.
        async with request.state.node.subscribe("chatter", String) as sub:
            yield ": now\n\n"
            async for message in sub:
                yield f"data: {json.dumps(message.to_dict(json=True))}\n\n"

    return StreamingResponse(events(), media_type="text/event-stream")


async def add(request: Request) -> Response:
    try:
        numbers = TwoInts.Request.from_dict(await request.json())
        answer = await request.state.node.call("add_two_ints", TwoInts, numbers, timeout=5)
    except (ValueError, aioros1.SerializationError) as error:
        return PlainTextResponse(str(error), 400)
    except (aioros1.ServiceError, aioros1.MasterError, TimeoutError) as error:
        return PlainTextResponse(str(error), 502)
    return JSONResponse(answer.to_dict(json=True))


async def health(request: Request) -> Response:
    node = request.state.node
    return JSONResponse({"node": node.name, "state": node.state}, 200 if node.is_open else 503)


app = Starlette(
    routes=[
        Route("/chatter", publish, methods=["POST"]),
        Route("/chatter/stream", stream),
        Route("/sum", add, methods=["POST"]),
        Route("/health", health),
    ],
    lifespan=node_lifespan("starlette_app", inner=topics),
)


if __name__ == "__main__":
    # uvicorn waits for its clients before it ends the lifespan, and a stream has no end.
    port = int((sys.argv[1:] or ["8000"])[0])
    uvicorn.run(app, host="localhost", port=port, timeout_graceful_shutdown=1)
