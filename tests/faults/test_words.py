"""What an error says, it says once."""

from __future__ import annotations

import asyncio
import contextlib
import re
from collections.abc import AsyncIterator, Callable
from typing import Any

import pytest

import aioros1
from aioros1.srv.std_srvs import SetBool

from .peers import header, refusing, until

_NAMED = re.compile(r"(?:service |subscriber |publisher at |/|\w+://)[\w./:\[\]]*[\w/]")


def said_twice(text: str) -> list[str]:
    """The names, addresses and phrases that stand twice in a text."""
    found = _NAMED.findall(text)
    doubled = {each for each in found if found.count(each) > 1 and len(each) > 6}
    halves = re.search(r"(\b[\w/. ]{6,}: )\1", text)
    return [*sorted(doubled), *([halves[1]] if halves else [])]


def test_it_is_seen_when_something_is_said_twice() -> None:
    assert said_twice("service /sv: service /sv: the master gives 'x'") == [
        "service /sv",
        "service /sv: ",
    ]
    assert said_twice("service /sv: the master gives 'rosrpc://x'") == []


@pytest.fixture
async def node(make_node: Any) -> aioros1.Node:
    return await make_node("demo", timeouts=aioros1.Timeouts(handshake=0.1, connect=0.1))


Ask = Callable[[aioros1.Node], Any]
ASKS: dict[str, Ask] = {
    "call": lambda node: node.call("sverige", SetBool, timeout=5),
    "call of any type": lambda node: node.call("sverige", timeout=5),
    "service_type": lambda node: node.service_type("sverige"),
    "wait_for_service": lambda node: node.wait_for_service("sverige", timeout=0.3),
}


async def error_of(node: aioros1.Node, ask: str) -> str:
    with pytest.raises((aioros1.RosError, TimeoutError)) as caught:
        await ASKS[ask](node)
    return str(caught.value)


@pytest.mark.parametrize("ask", ASKS)
@pytest.mark.parametrize(
    "uri", [None, "rosrpc://host", "rosrpc://a..b:1", "rosrpc://127.0.0.1:{port}"]
)
async def test_a_provider_that_cannot_be_reached(node, make_provider, ask, uri):
    with refusing() as port:
        if uri is not None:
            fake = await make_provider("/sverige")
            await fake.register(uri.format(port=port))
        text = await error_of(node, ask)
    assert "/sverige" in text
    assert not said_twice(text), text


@contextlib.asynccontextmanager
async def strange_provider(fake: Any, answer: bytes | None) -> AsyncIterator[None]:
    async def serve() -> None:
        while True:
            wire = await fake.greeted()
            if answer is None:
                await wire.close()
            else:
                await wire.send(answer)

    serving = asyncio.create_task(serve())
    try:
        yield
    finally:
        serving.cancel()
        await asyncio.wait([serving])


@pytest.mark.parametrize("ask", ["call", "call of any type", "service_type"])
@pytest.mark.parametrize(
    "answer",
    [b"", None, b"HTTP/1.1 400 Bad Request\r\n", header({"error": "no"}), header({"md5sum": "0"})],
    ids=["silent", "closes", "web", "refuses", "other"],
)
async def test_a_provider_of_another_kind(node, make_provider, ask, answer):
    async with strange_provider(await make_provider("/sverige"), answer):
        text = await error_of(node, ask)
    assert "/sverige" in text
    assert not said_twice(text), text


@pytest.mark.parametrize(
    "answer",
    [[0, "no", []], [1, "", ["FOO"]], [1, "", ["TCPROS", "a..b", 1]], "nonsense", None],
    ids=["no", "foo", "host", "nonsense", "refused"],
)
async def test_a_publisher_that_cannot_be_reached(node, make_publisher, caplog, answer):
    fake = await make_publisher("/sverige")
    with refusing() as port:
        fake.ready = answer or [1, "", ["TCPROS", "127.0.0.1", port]]
        async with node.subscribe("sverige", "std_msgs/String"):
            await until(lambda: [each for each in caplog.records if "sverige" in each.message])
    (text,) = {each.message for each in caplog.records if "subscriber /sverige" in each.message}
    assert fake.uri in text
    assert not said_twice(text), text
