"""Calls from another thread, or another event loop, are refused before anything happens."""

from __future__ import annotations

import asyncio
import threading

import pytest

import aioros1
from aioros1.msg.std_msgs import String
from aioros1.srv.std_srvs import SetBool

ELSEWHERE = r"(?s)thread 'elsewhere'.*belongs to the event loop in thread 'MainThread'.*NodeThread"


async def elsewhere(function):
    """Call ``function`` in another thread; what it raises is raised here."""
    outcome: asyncio.Future[object] = asyncio.get_running_loop().create_future()
    loop = asyncio.get_running_loop()

    def run():
        try:
            result = function()
        except BaseException as error:
            loop.call_soon_threadsafe(outcome.set_exception, error)
        else:
            loop.call_soon_threadsafe(outcome.set_result, result)

    thread = threading.Thread(target=run, name="elsewhere")
    thread.start()
    try:
        return await outcome
    finally:
        await asyncio.to_thread(thread.join)


async def test_publishing(make_node):
    node = await make_node()
    async with node.advertise("chatter", String) as pub, node.subscribe("chatter", String) as sub:
        await pub.wait_for_subscribers()
        for publish in (
            lambda: pub.publish(data="x"),
            lambda: pub.publish_raw(String(data="x").to_bytes()),
            lambda: asyncio.run(pub.send(data="x")),
        ):
            for _ in range(20):  # however long the burst
                with pytest.raises(RuntimeError, match=ELSEWHERE):
                    await elsewhere(publish)
        assert pub.stats.messages == 0
        pub.publish(data="here")
        assert (await sub.get(timeout=20)).data == "here"
        assert sub.stats.messages == 1


async def test_publishing_while_a_burst_is_collected(make_node):
    """The thread finds the loop in the middle of collecting."""
    node = await make_node()
    refused = []

    def publish():
        try:
            pub.publish(data="x")
        except RuntimeError as error:
            refused.append(str(error))

    async with (
        node.advertise("chatter", String) as pub,
        node.subscribe("chatter", String, queue_size=1000) as sub,
    ):
        await pub.wait_for_subscribers()
        for number in range(100):
            pub.publish(data=str(number))
            if number == 50:
                thread = threading.Thread(target=publish, name="elsewhere")
                thread.start()
                thread.join()
        got = [(await sub.get(timeout=20)).data for _ in range(100)]
        assert got == [str(number) for number in range(100)]
        assert len(refused) == 1


@pytest.mark.parametrize(
    "use",
    [
        lambda node: asyncio.run(node.get_param("/p")),
        lambda node: asyncio.run(node.set_param("/p", 1)),
        lambda node: asyncio.run(_open(node.advertise("b", String))),
        lambda node: asyncio.run(_open(node.subscribe("b", String))),
        lambda node: asyncio.run(_open(node.advertise_service("s", SetBool))),
        lambda node: asyncio.run(_open(node.service_caller("s", SetBool))),
        lambda node: asyncio.run(_open(node.subscribe_param("/p"))),
        lambda node: asyncio.run(node.call("s", SetBool)),
        lambda node: asyncio.run(node.close()),
        lambda node: asyncio.run(node.sleep(0)),
        lambda node: asyncio.run(node.wait_closed()),
        lambda node: asyncio.run(node.master.get_pid()),
        lambda node: asyncio.run(node.graph.snapshot()),
        lambda node: asyncio.run(_call(node.events)),
        lambda node: asyncio.run(_call(node.rate, 1)),
        lambda node: node.timer(1, print),
        lambda node: node.create_task(asyncio.sleep(0)),
    ],
)
async def test_whatever_a_node_does(make_node, use):
    node = await make_node()
    with pytest.raises(RuntimeError, match=ELSEWHERE):
        await elsewhere(lambda: use(node))
    assert node.is_open
    assert node.roles == ()
    await node.set_param("/p", 2)
    assert await node.get_param("/p") == 2


async def test_roles(make_node):
    node = await make_node()
    timer = node.timer(3600, print)
    async with (
        node.advertise("chatter", String) as pub,
        node.subscribe("chatter", String) as sub,
        node.advertise_service("s", SetBool, lambda request: None) as provider,
        node.service_caller("s", SetBool) as caller,
    ):
        for use in (
            lambda: pub.publish_every(1, data="x"),
            lambda: asyncio.run(pub.drain()),
            lambda: asyncio.run(sub.get()),
            lambda: sub.get_nowait(),
            lambda: asyncio.run(_call(aiter, sub)),
            lambda: asyncio.run(_call(sub.events)),
            timer.cancel,
            lambda: asyncio.run(caller.call(data=True)),
            *(lambda role=role: asyncio.run(role.close()) for role in (pub, sub, provider, caller)),
        ):
            with pytest.raises(RuntimeError, match=ELSEWHERE):
                await elsewhere(use)
        assert all(role.is_open for role in (pub, sub, provider, caller))
        assert node.is_open
    assert isinstance(node, aioros1.Node)


async def _open(opening):
    await opening


async def _call(function, *args):
    function(*args)


async def test_a_master(make_node, master):
    node = await make_node()
    with pytest.raises(RuntimeError, match=ELSEWHERE):
        await elsewhere(lambda: asyncio.run(master.close()))
    assert await node.get_param_names()


async def test_what_ends_a_node(make_node):
    node = await make_node()
    for use in (node.abort, lambda: node.handle_error(ValueError("no"), "mine")):
        with pytest.raises(RuntimeError, match=ELSEWHERE):
            await elsewhere(use)
    assert node.is_open
