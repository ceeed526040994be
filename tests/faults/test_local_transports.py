"""Publishers that offer another way than TCP, and it leads nowhere: TCP is used instead."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import os
import socket
import sys

import pytest

import aioros1
from aioros1.msg.std_msgs import String

from .peers import string, until

pytestmark = pytest.mark.skipif(
    not sys.platform.startswith("linux"), reason="abstract Unix sockets are Linux's"
)

NOBODY = "aioros1." + "0" * 32
"""The name of a socket that nobody has."""


@pytest.fixture
async def node(make_node):
    """The subscriber's node."""
    return await make_node(
        "listener",
        local_transports=("unix", "intraprocess"),
        timeouts=aioros1.Timeouts(handshake=0.3),
    )


@pytest.fixture
def unix_socket():
    """A listening abstract socket, of a name that subscribers believe."""
    with socket.socket(socket.AF_UNIX) as sock:
        sock.bind("\0aioros1." + os.urandom(16).hex())
        sock.listen()
        sock.setblocking(False)
        yield sock


def instead_of_tcp(publisher, *answers):
    """Have ``publisher`` give these answers before it says where its TCP port is."""
    left = list(answers)
    publisher.ready = lambda: (
        [1, "ready", left.pop(0)] if left else [1, "ready", ["TCPROS", "127.0.0.1", publisher.port]]
    )


async def hears_over_tcp(node, publisher) -> None:
    async with node.subscribe("/chatter", String) as sub:
        wire = await publisher.subscribed()
        await sub.wait_for_publishers(timeout=30)
        await wire.send(string("hi"))
        assert (await sub.get(timeout=30)).data == "hi"
        assert [info.transport for info in sub.connections] == ["TCPROS"]


@pytest.mark.parametrize(
    "answer",
    [
        ["UNIXROS", NOBODY],
        ["UNIXROS", "aioros1."],
        ["UNIXROS", f"{NOBODY}0"],
        ["UNIXROS", 5],
        ["UNIXROS"],
        ["INTRAPROCESS", "0" * 32],
        ["INTRAPROCESS", ["0"]],
        ["INTRAPROCESS"],
        ["SOMETHING", "else"],
        [],
    ],
    ids=str,
)
async def test_a_way_that_leads_nowhere(node, make_publisher, caplog, answer):
    publisher = await make_publisher()
    instead_of_tcp(publisher, answer)
    await hears_over_tcp(node, publisher)
    assert publisher.requests == 2
    assert not [each for each in caplog.records if each.levelno >= logging.WARNING]


@pytest.mark.parametrize("answers", ["nothing", "the end"])
async def test_a_socket_that_does_not_shake_hands(
    node, make_publisher, unix_socket, caplog, answers
):
    publisher = await make_publisher()
    instead_of_tcp(publisher, ["UNIXROS", unix_socket.getsockname()[1:].decode()])

    async def accept() -> None:
        sock, _ = await asyncio.get_running_loop().sock_accept(unix_socket)
        with sock:
            if answers == "nothing":
                await until(lambda: publisher.requests == 2)

    accepting = asyncio.create_task(accept())
    await hears_over_tcp(node, publisher)
    await accepting
    assert publisher.requests == 2
    assert not [each for each in caplog.records if each.levelno >= logging.WARNING]


async def test_a_socket_that_is_overrun(node, make_publisher, unix_socket):
    publisher = await make_publisher()
    instead_of_tcp(publisher, ["UNIXROS", unix_socket.getsockname()[1:].decode()])
    with contextlib.ExitStack() as stack:
        with pytest.raises(BlockingIOError):
            while True:
                waiting = stack.enter_context(socket.socket(socket.AF_UNIX))
                waiting.setblocking(False)
                waiting.connect(unix_socket.getsockname())
        await hears_over_tcp(node, publisher)


async def test_a_socket_of_another_program_is_left_alone(node, make_publisher):
    publisher = await make_publisher()
    with socket.socket(socket.AF_UNIX) as sock:
        sock.bind("\0some-service-of-this-host")
        sock.listen()
        sock.setblocking(False)
        instead_of_tcp(publisher, ["UNIXROS", "some-service-of-this-host"])
        await hears_over_tcp(node, publisher)
        with pytest.raises(BlockingIOError):  # nobody has called
            sock.accept()


async def test_what_did_not_work_is_tried_again_when_the_publisher_is_announced(
    node, make_publisher
):
    publisher = await make_publisher()
    asked = []

    def ready():
        asked.append("unix" if publisher.requests in (1, 4) else "tcp")
        way = (
            ["UNIXROS", NOBODY] if asked[-1] == "unix" else ["TCPROS", "127.0.0.1", publisher.port]
        )
        return [1, "ready", way]

    publisher.ready = ready
    async with node.subscribe("/chatter", String) as sub:
        wire = await publisher.subscribed()
        await sub.wait_for_publishers(timeout=30)
        wire.abort()
        wire = await publisher.subscribed()
        await until(lambda: publisher.requests == 3)  # without a second try
        await publisher.unregister()
        await wire.close()
        await until(lambda: sub.publisher_count == 0)
        await publisher.register()
        await publisher.subscribed()
        await sub.wait_for_publishers(timeout=30)
        assert asked == ["unix", "tcp", "tcp", "unix", "tcp"]


async def test_a_node_that_did_not_ask_for_it_does_not_go_there(make_node, make_publisher, caplog):
    node = await make_node("listener")
    publisher = await make_publisher()
    instead_of_tcp(publisher, ["UNIXROS", NOBODY])
    async with node.subscribe("/chatter", String) as sub:
        await publisher.subscribed()
        await sub.wait_for_publishers(timeout=30)
    assert "cannot use ['UNIXROS'" in caplog.text
