"""Peers whose names nobody answers for: others must not notice them."""

from __future__ import annotations

import asyncio
import socket
import threading
from collections.abc import Iterator
from typing import Any

import pytest

import aioros1
from aioros1.xmlrpc.client import XmlRpcClient

SLOW = [f"slow{number}.invalid" for number in range(40)]


async def register(master: aioros1.Master, method: str, name: str, *args: str) -> None:
    """Register ``name`` for a node at each of the slow names."""
    client = XmlRpcClient()
    for number, host in enumerate(SLOW):
        params = [each.format(number=number, host=host) for each in (name, *args)]
        code, *_ = await client.call(master.uri, method, f"/gone{number}", *params)
        assert code == 1
    await client.close()


@pytest.fixture
def held(monkeypatch: pytest.MonkeyPatch) -> Iterator[set[str]]:
    """The names that are being looked up, and are not answered before the test is over."""
    over = threading.Event()
    asked: set[str] = set()
    system = socket.getaddrinfo

    def getaddrinfo(host: Any, *args: Any, **keywords: Any) -> Any:
        if host in SLOW:
            asked.add(host)
            over.wait(60)
            raise socket.gaierror(socket.EAI_AGAIN, "Temporary failure in name resolution")
        if host == "robot":
            host = "127.0.0.1"
        return system(host, *args, **keywords)

    monkeypatch.setattr(socket, "getaddrinfo", getaddrinfo)
    yield asked
    over.set()


async def test_a_publisher_is_connected_beside_many_that_cannot_be_looked_up(
    master: aioros1.Master, held: set[str]
) -> None:
    options: dict[str, Any] = {"master_uri": master.uri, "rosout": False}
    async with (
        asyncio.timeout(30),
        aioros1.Node("listener", **options) as listener,
        aioros1.Node("talker", host="robot", **options) as talker,
        listener.subscribe("chatter", "std_msgs/String") as sub,
    ):
        uri = "http://{host}:1/"
        await register(master, "registerPublisher", "/chatter", "std_msgs/String", uri)
        while len(held) < len(SLOW):
            await asyncio.sleep(0.001)
        async with talker.advertise("chatter", "std_msgs/String") as pub:
            await pub.wait_for_subscribers()
            pub.publish(data="here")
            assert (await sub.get()).data == "here"
            assert await asyncio.to_thread(lambda: "the program's own") == "the program's own"


async def test_a_master_tells_a_subscriber_beside_many_that_cannot_be_looked_up(
    master: aioros1.Master, held: set[str]
) -> None:
    options: dict[str, Any] = {"master_uri": master.uri, "rosout": False}
    async with (
        asyncio.timeout(30),
        aioros1.Node("talker", **options) as talker,
        aioros1.Node("listener", host="robot", **options) as listener,
    ):
        uri = "http://{host}:1/"
        await register(master, "registerSubscriber", "/chatter", "std_msgs/String", uri)
        async with (
            listener.subscribe("chatter", "std_msgs/String") as sub,
            talker.advertise("chatter", "std_msgs/String"),
        ):
            await sub.wait_for_publishers()
            while len(held) < len(SLOW):
                await asyncio.sleep(0.001)


async def test_a_service_is_called_beside_many_that_cannot_be_looked_up(
    master: aioros1.Master, held: set[str]
) -> None:
    options: dict[str, Any] = {"master_uri": master.uri, "rosout": False}
    async with (
        asyncio.timeout(30),
        aioros1.Node("caller", **options) as caller,
        aioros1.Node("provider", host="robot", **options) as provider,
        provider.advertise_service("flip", "std_srvs/SetBool", lambda request: {"success": True}),
    ):
        await register(
            master, "registerService", "/gone{number}", "rosrpc://{host}:1", "http://{host}:1/"
        )
        calls = [
            asyncio.create_task(caller.call(f"/gone{number}", "std_srvs/Empty"))
            for number in range(len(SLOW))
        ]
        while len(held) < len(SLOW):
            await asyncio.sleep(0.001)
        assert (await caller.call("flip", "std_srvs/SetBool", data=True)).success
        for call in calls:
            call.cancel()
        await asyncio.wait(calls)
