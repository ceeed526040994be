"""What a wait in vain says: what is in the way, and what the name may have been meant to be."""

from __future__ import annotations

import asyncio
import socket

import pytest

import aioros1
from aioros1.msg.geometry_msgs import Twist
from aioros1.msg.std_msgs import String
from aioros1.xmlrpc.client import XmlRpcClient
from aioros1.xmlrpc.master_proxy import MasterProxy


@pytest.fixture
async def node(make_node):
    return await make_node("node", namespace="/robot")


@pytest.fixture
async def other(make_node):
    return await make_node("other")


async def late(waiting):
    with pytest.raises(TimeoutError) as caught:
        await waiting
    assert str(caught.value).isprintable()
    return str(caught.value)


async def test_publishers_that_are_not_there(node, other):
    async with node.advertise("cmd_vel", Twist), other.subscribe("cmd_vel", Twist) as sub:
        text = await late(sub.wait_for_publishers(timeout=0.5))
        assert text.endswith(
            "the master knows no publisher of /cmd_vel, but it knows /robot/cmd_vel"
        )
        text = await late(other.wait_for_message("/robot/cmd_val", timeout=0.5))
        assert text.startswith("no message on /robot/cmd_val within 0.5 s")
        assert "but it knows /robot/cmd_vel" in text
        text = await late(sub.get(timeout=0.05))
        assert text.endswith("no publisher was announced")
    async with other.subscribe("quite_different", Twist) as sub:
        text = await late(sub.wait_for_publishers(timeout=0.5))
        assert text.endswith("the master knows no publisher of /quite_different")


async def test_publishers_that_do_not_publish(node, other):
    async with node.advertise("cmd_vel", Twist), other.subscribe("/robot/cmd_vel", Twist) as sub:
        await sub.wait_for_publishers(timeout=30)
        text = await late(sub.get(timeout=0.05))
        assert text == "subscriber /robot/cmd_vel: no message came within 0.05 s"
        text = await late(sub.wait_for_publishers(2, timeout=0.5))
        assert "the master lists /robot/node for /robot/cmd_vel" in text


@pytest.fixture
async def dead(master):
    """The master, as a node sees it that has died since."""
    client = XmlRpcClient()
    yield MasterProxy(client, master.uri, "/dead")
    await client.close()


async def test_publishers_that_cannot_be_reached(node, dead):
    with socket.socket() as sock:
        sock.bind(("127.0.0.1", 0))
        uri = f"http://127.0.0.1:{sock.getsockname()[1]}/"
        await dead.register_publisher("/dead", "std_msgs/String", uri)
        async with node.subscribe("/dead", String) as sub:
            text = await late(sub.wait_for_publishers(timeout=0.5))
            for words in (f"publisher at {uri}", "cannot connect: Connection refused"):
                assert words in text
            assert "Errno" not in text
            assert "Connection refused" in await late(sub.get(timeout=0.05))
            assert "Connection refused" in await late(node.wait_for_message("/dead", timeout=0.5))


async def test_subscribers(node, other):
    async with node.advertise("cmd_vel", Twist) as pub, other.subscribe("cmd_vel", Twist):
        text = await late(pub.wait_for_subscribers(timeout=0.5))
        assert "the master knows no subscriber of /robot/cmd_vel, but it knows /cmd_vel" in text
    async with node.advertise("cmd_vel", Twist) as pub, other.subscribe("/robot/cmd_vel", String):
        text = await late(pub.wait_for_subscribers(timeout=1))
        for words in ("/other", "was refused", "std_msgs/String", "geometry_msgs/Twist"):
            assert words in text


async def test_services(node, other, dead):
    async with node.advertise_service("flip", "std_srvs/SetBool", lambda request: None):
        text = await late(other.wait_for_service("flip", timeout=0.5))
        assert "the master knows no provider of /flip, but it knows /robot/flip" in text
        with pytest.raises(aioros1.ServiceNotFound, match=r"/flap.*but it knows /robot/flip"):
            await other.call("/robot/flap", "std_srvs/SetBool")
    with socket.socket() as sock:
        sock.bind(("127.0.0.1", 0))
        port = sock.getsockname()[1]
        await dead.register_service("/dead", f"rosrpc://127.0.0.1:{port}", "http://x:1/")
        text = await late(other.wait_for_service("/dead", timeout=0.5))
        assert f"cannot connect to 127.0.0.1:{port}: Connection refused" in text


async def test_an_unknown_node(node, other):
    with pytest.raises(aioros1.NodeNotFound, match=r"no node /node: .*") as caught:
        await other.peer("/node")
    assert isinstance(caught.value, aioros1.MasterError)
    assert isinstance(caught.value, LookupError)
    assert "\n" not in str(caught.value)
    async with node.advertise("chatter", String):
        with pytest.raises(aioros1.NodeNotFound, match="but it knows /robot/node"):
            await other.peer("/node")


async def test_waiting_without_a_timeout_asks_the_master_nothing_more(node, monkeypatch):
    asked = []
    ask = node.master.call

    async def call(method, *params, **options):
        asked.append(method)
        return await ask(method, *params, **options)

    monkeypatch.setattr(node.master, "call", call)
    async with node.subscribe("chatter", String) as sub:
        waiting = asyncio.ensure_future(sub.wait_for_publishers())
        await asyncio.sleep(0.5)
        waiting.cancel()
    assert "getSystemState" not in asked


async def test_a_value_that_does_not_fit_names_its_type_and_its_topic(node):
    async with node.advertise("cmd_vel", Twist) as pub:
        for publish in (
            lambda: pub.publish(linear={"x": "fast"}),
            lambda: pub.publish(Twist(linear=4)),
            lambda: pub.publish({"linear": {"x": None}}),
            lambda: pub.publish_every(1, linear=4),
        ):
            with pytest.raises(aioros1.SerializationError) as caught:
                publish()
            assert str(caught.value).startswith("linear")
            assert str(caught.value).endswith("(geometry_msgs/Twist on /robot/cmd_vel)")
        with pytest.raises(aioros1.SerializationError, match=r"\(geometry_msgs/Twist on /robot/"):
            await pub.send(linear=4)
        with pytest.raises(aioros1.SerializationError, match=r"on /robot/cmd_vel\)"):
            pub.publish(String())
    with pytest.raises(aioros1.SerializationError, match=r"^data: .*\(std_msgs/String\)$"):
        String(data=5).to_bytes()


async def test_a_call_that_does_not_fit_names_its_type_and_its_service(node, caplog):
    async with (
        node.advertise_service("flip", "std_srvs/SetBool", lambda request: {"message": 5}),
        node.advertise_service("ask", "std_srvs/SetBool") as provider,
        node.service_caller("flip", "std_srvs/SetBool") as caller,
    ):
        with pytest.raises(aioros1.SerializationError) as caught:
            await caller.call(data="yes")
        assert str(caught.value).startswith("data: ")
        assert str(caught.value).endswith("(std_srvs/SetBoolRequest to /robot/flip)")
        with pytest.raises(aioros1.ServiceError) as refused:
            await caller.call(data=True)
        assert "message: " in str(refused.value)
        assert "(std_srvs/SetBoolResponse from /robot/flip)" in str(refused.value)
        calling = asyncio.ensure_future(node.call("ask", "std_srvs/SetBool", data=True))
        call = await anext(provider)
        with pytest.raises(aioros1.SerializationError, match=r"SetBoolResponse from /robot/ask\)"):
            await call.reply(message=5)
        await call.reply(message="well")
        assert (await calling).message == "well"
    caplog.clear()
