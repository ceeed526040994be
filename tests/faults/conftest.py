"""Peers that misbehave, and a bystander who must not notice."""

from __future__ import annotations

import contextlib
import logging
import os
import sys
from collections.abc import AsyncIterator, Awaitable, Callable, Iterator
from typing import Any

import pytest

import aioros1
from aioros1.xmlrpc.client import XmlRpcClient

from .peers import Bystander, FakeProvider, FakePublisher


@pytest.fixture(autouse=True)
def nothing_unforeseen(caplog: pytest.LogCaptureFixture) -> Iterator[None]:
    """What a peer does wrong is a warning at most; an error is a fault of ours.

    Tests in which something of ours is meant to fail say ``caplog.clear()``.
    """
    yield
    errors = [each for each in caplog.get_records("call") if each.levelno >= logging.ERROR]
    assert not errors, "\n".join(each.getMessage() for each in errors)


@pytest.fixture
async def stack() -> AsyncIterator[contextlib.AsyncExitStack]:
    async with contextlib.AsyncExitStack() as stack:
        yield stack


@pytest.fixture
async def make_publisher(
    master: aioros1.Master, stack: contextlib.AsyncExitStack
) -> Callable[..., Awaitable[FakePublisher]]:
    """``await make_publisher()``: a fake publisher of strings, registered."""

    async def make(
        topic: str = "/chatter",
        type: str = "std_msgs/String",
        *,
        name: str = "/fake",
        register: bool = True,
    ) -> FakePublisher:
        publisher = FakePublisher(master.uri, name, topic, type)
        stack.push_async_callback(publisher.close)
        await publisher.start()
        if register:
            await publisher.register()
        return publisher

    return make


@pytest.fixture
async def make_provider(
    master: aioros1.Master, stack: contextlib.AsyncExitStack
) -> Callable[..., Awaitable[FakeProvider]]:
    """``await make_provider()``: a fake service, registered."""

    async def make(service: str = "/flip", *, name: str = "/fake") -> FakeProvider:
        provider = FakeProvider(master.uri, name, service)
        stack.push_async_callback(provider.close)
        await provider.start()
        await provider.register()
        return provider

    return make


@pytest.fixture
async def ask() -> AsyncIterator[Callable[..., Awaitable[Any]]]:
    """``await ask(node, "getPid")``: the bare answer of a node's slave API."""
    client = XmlRpcClient()

    async def call(node: aioros1.Node, method: str, *params: Any) -> Any:
        return await client.call(node.uri, method, "/asker", *params)

    yield call
    await client.close()


@pytest.fixture
async def bystander_of(
    make_node: Callable[..., Awaitable[aioros1.Node]], stack: contextlib.AsyncExitStack
) -> Callable[[aioros1.Node], Awaitable[Bystander]]:
    """``await bystander_of(node)``: topics and a service that go on being used."""

    async def make(node: aioros1.Node) -> Bystander:
        return await Bystander(stack).start(node, await make_node("bystander"))

    return make


@pytest.fixture
def open_files() -> Callable[[], int]:
    """How many files and sockets the process has open."""
    if not sys.platform.startswith("linux"):
        pytest.skip("needs /proc")
    return lambda: len(os.listdir("/proc/self/fd"))
