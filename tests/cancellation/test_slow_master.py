"""A master that obeys registrations late, as one that serves each connection in a thread may."""

from __future__ import annotations

import asyncio

import pytest

import aioros1
from aioros1.master.api import MasterApi
from aioros1.msg.std_msgs import String
from aioros1.testing import FlakyProxy


class Gate:
    """Holds ``registerPublisher`` back before the master obeys it, once it is closed."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.opened = asyncio.Event()
        self.opened.set()
        self.waiting = 0
        self.obeyed = 0
        methods = MasterApi.methods

        def slow(api: MasterApi):
            table = dict(methods(api))
            register = table["registerPublisher"]

            async def late(caller_id, topic, type, uri):
                self.waiting += 1
                await self.opened.wait()
                answer = register(caller_id, topic, type, uri)
                self.obeyed += 1
                return answer

            table["registerPublisher"] = late
            return table

        monkeypatch.setattr(MasterApi, "methods", slow)


@pytest.fixture
def gate(monkeypatch):
    return Gate(monkeypatch)


async def publishers(node):
    return (await node.master.get_system_state()).publishers


async def until(holds):
    async with asyncio.timeout(30):
        while not await holds():
            await asyncio.sleep(0.001)


async def opened(node, type=String):
    return await node.advertise("late", type)


@pytest.mark.parametrize("times", [1, 2])
@pytest.mark.parametrize("how", ["cancelled", "out of time"])
async def test_a_late_registration_leaves_no_ghost(gate, make_node, how, times):
    timeouts = aioros1.Timeouts(xmlrpc=0.1 if how == "out of time" else 5)
    node = await make_node("node", timeouts=timeouts, heartbeat=None)
    observer = await make_node("observer", heartbeat=None)
    gate.opened.clear()
    opening = asyncio.create_task(opened(node))

    async def it_waits():
        return gate.waiting == 1

    await until(it_waits)
    if how == "cancelled":
        for _ in range(times):
            opening.cancel()
            await asyncio.sleep(0)
            await asyncio.sleep(0)
        gate.opened.set()
        with pytest.raises(asyncio.CancelledError):
            await opening
    else:
        with pytest.raises(aioros1.MasterUnreachable, match="no answer of the master"):
            await opening
        for _ in range(times - 1):
            with pytest.raises(aioros1.MasterUnreachable):
                await opened(node)
        gate.opened.set()

    async def it_was_taken_back():
        return gate.obeyed and "/late" not in await publishers(observer)

    await until(it_was_taken_back)


async def test_the_next_role_of_the_name_waits_for_the_last_ones_request(gate, make_node):
    node = await make_node("node", heartbeat=None)
    gate.opened.clear()
    first = asyncio.create_task(opened(node))
    while not gate.waiting:
        await asyncio.sleep(0.001)
    for _ in range(2):  # the second time it does not wait for its taking back
        first.cancel()
        await asyncio.sleep(0)
    with pytest.raises(asyncio.CancelledError):
        await first
    second = asyncio.create_task(opened(node, "std_msgs/Int32"))
    await publishers(node)  # which is answered after whatever was asked before
    assert gate.waiting == 1
    gate.opened.set()
    await second
    assert (await publishers(node))["/late"] == ["/node"]
    assert ("/late", "std_msgs/Int32") in await node.master.get_topic_types()


async def test_closing_takes_back_what_is_on_its_way(gate, make_node):
    node, other = await make_node("node"), await make_node("other")
    gate.opened.clear()
    opening = asyncio.create_task(opened(node))
    while not gate.waiting:
        await asyncio.sleep(0.001)
    closing = asyncio.create_task(node.close())
    await asyncio.sleep(0.01)
    gate.opened.set()
    await closing
    with pytest.raises(aioros1.ClosedError):
        await opening
    assert "/late" not in await publishers(other)


async def test_what_could_not_be_taken_back_is_with_a_later_heartbeat(make_node, master):
    other = await make_node("other")
    async with FlakyProxy("localhost", master.port) as proxy:
        uri = f"http://127.0.0.1:{proxy.port}/"
        node = await make_node("node", heartbeat=0.01, master_uri=uri)
        role = await opened(node)
        proxy.refuse()
        proxy.cut()
        await role.close()
        assert "/late" in await publishers(other)
        proxy.accept()

        async def it_is_gone():
            return "/late" not in await publishers(other)

        await until(it_is_gone)
        await node.close()
