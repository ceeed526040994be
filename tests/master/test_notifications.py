"""Who is told what, in which order, and that nobody waits for a node that hangs."""

from __future__ import annotations

import asyncio
import contextlib
import itertools
import resource
import socket
import struct
from collections.abc import Iterator
from typing import Any

import pytest

from aioros1.master import Master
from aioros1.master.notifier import Notifier
from aioros1.master.registry import PublisherUpdate, Shutdown
from aioros1.options import Timeouts
from aioros1.wire.xmlrpc import decode_call, encode_response
from aioros1.xmlrpc.client import XmlRpcClient
from aioros1.xmlrpc.server import XmlRpcServer

from .conftest import RecordingNode, free_port


async def test_the_old_node_is_told_to_end_and_its_subscribers_are_told(
    ask: Any, make_node: Any
) -> None:
    old, new, sub = [await make_node(name) for name in ("/dup", "/dup", "/sub")]
    await ask("registerSubscriber", "/sub", "/t", "a/T", sub.uri)
    await ask("registerPublisher", "/dup", "/t", "a/T", old.uri)
    await sub.has_been_told(1)
    await ask("registerPublisher", "/dup", "/other", "a/T", new.uri)
    (told,) = await old.has_been_told(1)
    assert told[:2] == ("shutdown", "/master")
    assert told[2] == "[/dup] Reason: new node registered with same name"
    await sub.has_been_told(2)
    assert sub.told == [
        ("publisherUpdate", "/master", "/t", [old.uri]),
        ("publisherUpdate", "/master", "/t", []),
    ]
    assert (await ask("lookupNode", "/c", "/dup"))[2] == new.uri


async def test_who_comes_to_the_address_of_an_old_node_is_not_told_to_end() -> None:
    """Not even when the old one did not answer before, so that it is told again."""
    told: list[str] = []
    registered: set[str] = set()

    class Client:
        async def call(self, uri: str, method: str, *params: Any) -> Any:
            told.append(method)
            registered.add(uri)
            raise TimeoutError("no answer")

    def is_wanted(message: Any) -> bool:
        return not isinstance(message, Shutdown) or message.api not in registered

    client: Any = Client()
    notifier = Notifier(client, is_wanted=is_wanted, on_unwanted=lambda update: None)
    notifier.send([Shutdown("http://a:1/", "/a", "[/a] Reason: replaced")])
    async with asyncio.timeout(20):
        while not told:
            await asyncio.sleep(0)
        # What comes next for that address waits behind it.
        registered.add("http://b:1/")
        notifier.send([Shutdown("http://b:1/", "/b", "[/b] Reason: replaced")])
        notifier.send([PublisherUpdate("http://b:1/", "/t", [])])
        while "publisherUpdate" not in told:
            await asyncio.sleep(0.01)
    await notifier.close()
    assert told.count("shutdown") == 1


async def test_subscribers_are_told_of_every_change_of_publishers(ask: Any, make_node: Any) -> None:
    sub = await make_node("/sub")
    await ask("registerSubscriber", "/sub", "/t", "a/T", sub.uri)
    for count, (method, params, publishers) in enumerate(
        [
            ("registerPublisher", ("a/T", "http://a:1/"), ["http://a:1/"]),
            ("registerPublisher", ("a/T", "http://a:1/"), ["http://a:1/"]),
            ("unregisterPublisher", ("http://a:1/",), []),
        ],
        1,
    ):
        await ask(method, "/pub", "/t", *params)
        assert (await sub.has_been_told(count))[-1] == (
            "publisherUpdate",
            "/master",
            "/t",
            publishers,
        )


async def test_nodes_that_hang_delay_nobody(master: Master, make_node: Any) -> None:
    """They accept connections and never answer; some of them do not even accept."""
    client = XmlRpcClient()
    silent = []
    for number in range(8):
        sock = socket.socket()
        sock.bind(("127.0.0.1", 0))
        sock.listen(1 if number % 2 else 0)
        silent.append(sock)
        uri = f"http://127.0.0.1:{sock.getsockname()[1]}/"
        await client.call(master.uri, "registerSubscriber", f"/hung{number}", "/t", "a/T", uri)
        await client.call(master.uri, "subscribeParam", f"/hung{number}", uri, "/k")
    good = await make_node("/good")
    await client.call(master.uri, "registerSubscriber", "/good", "/t", "a/T", good.uri)
    async with asyncio.timeout(30):  # much less than one of them takes to be given up 20 times
        for number in range(20):
            count = len(good.told)
            api = f"http://p{number}:1/"
            await client.call(master.uri, "registerPublisher", f"/p{number}", "/t", "a/T", api)
            await client.call(master.uri, "setParam", "/c", "/k", number)
            await good.has_been_told(count + 1)
    assert len(good.told[-1][3]) == 20
    await client.close()
    for sock in silent:
        sock.close()


async def test_hundreds_of_nodes_leave_time_for_others() -> None:
    """Between any few of them the loop goes round, and the master can answer."""
    told: list[str] = []

    class Client:
        async def call(self, uri: str, method: str, *params: Any) -> Any:
            told.append(uri)
            return [1, "", 0]

    client: Any = Client()
    notifier = Notifier(client, is_wanted=lambda message: True, on_unwanted=lambda update: None)
    apis = [f"http://n{number}:1/" for number in range(300)]
    notifier.send(PublisherUpdate(api, "/t", []) for api in apis)
    assert told == []
    counts = [0]
    while counts[-1] < len(apis):
        await asyncio.sleep(0)
        counts.append(len(told))
    assert max(after - before for before, after in itertools.pairwise(counts)) < 10
    assert sorted(told) == sorted(apis)
    # Those that come while others wait are not forgotten.
    notifier.send(PublisherUpdate(api, "/u", []) for api in apis)
    await asyncio.sleep(0)
    notifier.send([PublisherUpdate("http://late:1/", "/u", [])])
    while len(told) <= 2 * len(apis):
        await asyncio.sleep(0)
    assert told[-1] == "http://late:1/"
    notifier.send(PublisherUpdate(api, "/v", []) for api in apis)
    await notifier.close()


async def test_a_node_that_hangs_gets_the_newest_list_and_only_that(
    ask: Any, make_node: Any
) -> None:
    sub = await make_node("/sub")
    sub.hold = asyncio.Event()
    await ask("registerSubscriber", "/sub", "/t", "a/T", sub.uri)
    for number in range(50):
        await ask("registerPublisher", f"/p{number}", "/t", "a/T", f"http://p{number}:1/")
    await sub.has_been_told(1)
    assert len(sub.told[0][3]) == 1
    sub.hold.set()
    await sub.until(lambda: len(sub.told[-1][3]) == 50)
    assert len(sub.told) <= 4


async def test_an_update_that_is_not_answered_in_time_is_sent_again(
    ask: Any, make_node: Any
) -> None:
    sub = await make_node("/sub")
    sub.hold = asyncio.Event()
    await ask("registerSubscriber", "/sub", "/t", "a/T", sub.uri)
    await ask("registerPublisher", "/p", "/t", "a/T", "http://p:1/")
    await sub.has_been_told(2)  # the first was given up
    assert sub.told == [("publisherUpdate", "/master", "/t", ["http://p:1/"])] * 2
    sub.hold.set()


async def test_a_node_that_has_left_is_not_told_again(
    ask: Any, make_node: Any, master: Master
) -> None:
    sub = await make_node("/sub")
    sub.hold = asyncio.Event()
    await ask("registerSubscriber", "/sub", "/t", "a/T", sub.uri)
    await ask("registerPublisher", "/p", "/t", "a/T", "http://p:1/")
    await sub.has_been_told(1)
    await ask("unregisterSubscriber", "/sub", "/t", sub.uri)
    await asyncio.sleep(1.2)  # longer than the timeout and the pause after it
    assert len(sub.told) == 1


async def test_dead_nodes_stay_registered(ask: Any) -> None:
    with socket.socket() as sock:
        sock.bind(("127.0.0.1", 0))
        dead = f"http://127.0.0.1:{sock.getsockname()[1]}/"
    await ask("registerSubscriber", "/dead", "/t", "a/T", dead)
    await ask("registerPublisher", "/p", "/t", "a/T", "http://p:1/")
    assert (await ask("lookupNode", "/c", "/dead")) == [1, "node api", dead]
    assert (await ask("getSystemState", "/c"))[2][1] == [["/t", ["/dead"]]]


async def test_publisher_lists_arrive_in_order(ask: Any, make_node: Any) -> None:
    sub = await make_node("/sub")
    await ask("registerSubscriber", "/sub", "/t", "a/T", sub.uri)
    await asyncio.gather(
        *(
            ask("registerPublisher", f"/p{number}", "/t", "a/T", f"http://p{number}:1/")
            for number in range(100)
        )
    )
    await sub.until(lambda: len(sub.told[-1][3]) == 100)
    sizes = [len(entry[3]) for entry in sub.told]
    assert sizes == sorted(sizes)


async def follow(ask: Any, node: Any, key: str) -> Any:
    code, _, value = await ask("subscribeParam", node.name, node.uri, key)
    assert code == 1
    return value


async def test_unset_parameters_can_be_followed(ask: Any, make_node: Any) -> None:
    node = await make_node("/n")
    assert await follow(ask, node, "/unset") == {}
    await ask("setParam", "/c", "/unset", 5)
    assert await node.has_been_told(1) == [("paramUpdate", "/master", "/unset/", 5)]


async def test_a_follower_is_told_of_its_key_its_parents_and_its_children(
    ask: Any, make_node: Any
) -> None:
    node = await make_node("/n")
    await follow(ask, node, "/q/r")
    steps: list[tuple[str, str, Any, Any]] = [
        ("setParam", "/q/r", {"a": 1}, ("/q/r/", {"a": 1})),
        ("setParam", "/q/r", {"a": 1}, ("/q/r/", {"a": 1})),  # the same again
        ("setParam", "/q/r/c", 5, ("/q/r/c/", 5)),  # a child
        ("setParam", "/q", {"r": 7, "s": 8}, ("/q/r/", 7)),  # a parent
        ("setParam", "/q", {"s": 8}, ("/q/r/", {})),  # a parent without it
        ("setParam", "/q/rr", 1, None),  # a key that begins alike
        ("setParam", "/q/r", "x", ("/q/r/", "x")),
        ("deleteParam", "/q/r", None, ("/q/r/", {})),
        ("setParam", "/q/r", "y", ("/q/r/", "y")),
        ("deleteParam", "/q", None, ("/q/r/", {})),
        ("setParam", "/", {"q": {"r": 2}}, ("/q/r/", 2)),
    ]
    expected = []
    for method, key, value, told in steps:
        params = (key, value) if method == "setParam" else (key,)
        assert (await ask(method, "/c", *params))[0] == 1
        if told is not None:
            expected.append(("paramUpdate", "/master", *told))
            await node.has_been_told(len(expected))
    assert node.told == expected


async def test_the_node_that_sets_a_parameter_is_not_told(ask: Any, make_node: Any) -> None:
    node, other = await make_node("/n"), await make_node("/other")
    await follow(ask, node, "/k")
    await follow(ask, other, "/k")
    await ask("setParam", "/n", "/k", 1)
    await ask("setParam", "/c", "/k", 2)
    assert await node.has_been_told(1) == [("paramUpdate", "/master", "/k/", 2)]
    await other.until(lambda: other.told[-1][3] == 2)


async def test_unsubscribed_followers_are_not_told(ask: Any, make_node: Any) -> None:
    node, other = await make_node("/n"), await make_node("/other")
    await follow(ask, node, "/k")
    await follow(ask, other, "/k")
    answer = await ask("unsubscribeParam", "/n", node.uri, "/k/")
    assert answer == [1, "Unsubscribe to parameter [/k/]", 1] or answer[2] == 1
    await ask("setParam", "/c", "/k", 1)
    await other.has_been_told(1)
    assert node.told == []


async def test_a_node_that_answers_it_does_not_follow_is_forgotten(
    ask: Any, make_node: Any
) -> None:
    node = await make_node("/n")
    node.answer = [-1, "not subscribed", 0]
    await follow(ask, node, "/k")
    await ask("setParam", "/c", "/k/new", 1)  # rospy answers -1 to this, and still follows /k
    await node.has_been_told(1)
    await ask("setParam", "/c", "/k", 1)
    await node.has_been_told(2)
    async with asyncio.timeout(10):
        while (await ask("lookupNode", "/c", "/n"))[0] == 1:
            await asyncio.sleep(0)
    await ask("setParam", "/c", "/k", 2)
    assert len(node.told) == 2


async def test_the_order_of_overlapping_updates_is_kept(ask: Any, make_node: Any) -> None:
    """Whatever is merged while the node is busy, the last word is the last one said."""
    node = await make_node("/n")
    node.hold = asyncio.Event()
    await follow(ask, node, "/k")
    await ask("setParam", "/c", "/k/other", 0)
    await node.has_been_told(1)
    for key, value in [("/k", {"a": 1}), ("/k/a", 2), ("/k", {"a": 3}), ("/k/b", 4)]:
        await ask("setParam", "/c", key, value)
    node.hold.set()
    await node.until(lambda: node.told[-1][2] == "/k/b/")
    assert [entry[2:] for entry in node.told if entry[2] != "/k/other/"] == [
        ("/k/a/", 2),
        ("/k/", {"a": 3}),
        ("/k/b/", 4),
    ]


async def test_nodes_that_answer_nonsense_get_the_next_message(ask: Any, make_node: Any) -> None:
    node = await make_node("/n")
    node.answer = "no triple"
    await ask("registerSubscriber", "/n", "/t", "a/T", node.uri)
    await ask("registerPublisher", "/p", "/t", "a/T", "http://p:1/")
    await node.has_been_told(1)
    node.answer = None  # this cannot be sent, and becomes a fault
    await ask("unregisterPublisher", "/p", "/t", "http://p:1/")
    await node.has_been_told(2)
    await ask("registerPublisher", "/p", "/t", "a/T", "http://p:1/")
    await node.has_been_told(3)


async def test_notifications_are_dropped_when_the_master_ends() -> None:
    before = asyncio.all_tasks()
    node = XmlRpcServer({"publisherUpdate": lambda *params: asyncio.sleep(3600)})
    await node.start("127.0.0.1")
    client = XmlRpcClient()
    async with Master("127.0.0.1", port=0, rosout=False) as master:
        uri = f"http://127.0.0.1:{node.port}/"
        await client.call(master.uri, "registerSubscriber", "/n", "/t", "a/T", uri)
        await client.call(master.uri, "registerPublisher", "/p", "/t", "a/T", "http://p:1/")
    await client.close()
    await node.close(timeout=0.01)
    assert asyncio.all_tasks() == before


# ------------------------------------------------------------------ notices that fail at first


class Flaky:
    """A server that does ``fail(writer)`` with the first requests, and then answers."""

    def __init__(self, times: int, fail: Any) -> None:
        self.left = times
        self.told: list[tuple[Any, ...]] = []
        self.came = asyncio.Event()
        self._fail = fail

    async def serve(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        with contextlib.suppress(ConnectionError, asyncio.IncompleteReadError):
            while True:
                head = await reader.readuntil(b"\r\n\r\n")
                length = int(head.lower().split(b"content-length: ")[1].split(b"\r\n")[0])
                body = await reader.readexactly(length)
                if self.left:
                    self.left -= 1
                    self._fail(writer)
                    continue
                self.told.append(decode_call(body))
                self.came.set()
                answer = encode_response([1, "", 0])
                writer.write(
                    b"HTTP/1.1 200 OK\r\nContent-Length: %d\r\n\r\n" % len(answer) + answer
                )
        writer.close()


def reset(writer: asyncio.StreamWriter) -> None:
    sock = writer.get_extra_info("socket")
    sock.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
    writer.transport.abort()


def busy(writer: asyncio.StreamWriter) -> None:
    writer.write(b"HTTP/1.1 503 Service Unavailable\r\nContent-Length: 0\r\n\r\n")


def nothing(writer: asyncio.StreamWriter) -> None:
    writer.close()


@pytest.mark.parametrize("kind", ["publisherUpdate", "paramUpdate"])
@pytest.mark.parametrize("fail", [reset, busy, nothing])
async def test_a_notice_that_fails_is_sent_again(
    ask: Any, monkeypatch: Any, fail: Any, kind: str
) -> None:
    monkeypatch.setattr("aioros1.master.notifier._FIRST_PAUSE", 0.01)
    flaky = Flaky(5, fail)
    async with await asyncio.start_server(flaky.serve, "127.0.0.1", 0) as server:
        uri = f"http://127.0.0.1:{server.sockets[0].getsockname()[1]}/"
        if kind == "paramUpdate":
            await ask("subscribeParam", "/n", uri, "/k")
            await ask("setParam", "/c", "/k", 1)
            await ask("setParam", "/c", "/k", 2)
            last: Any = ("/k/", 2)
        else:
            await ask("registerSubscriber", "/n", "/t", "a/T", uri)
            await ask("registerPublisher", "/p", "/t", "a/T", "http://p:1/")
            await ask("registerPublisher", "/q", "/t", "a/T", "http://q:1/")
            last = ("/t", ["http://p:1/", "http://q:1/"])
        async with asyncio.timeout(30):
            while not flaky.told or flaky.told[-1] != (kind, ("/master", *last)):
                flaky.came.clear()
                await flaky.came.wait()


async def test_a_node_that_comes_up_again_at_its_address_is_told(
    ask: Any, make_node: Any, monkeypatch: Any
) -> None:
    monkeypatch.setattr("aioros1.master.notifier._LONGEST_PAUSE", 0.05)
    port = free_port()
    uri = f"http://127.0.0.1:{port}/"
    await ask("registerSubscriber", "/n", "/t", "a/T", uri)
    await ask("registerPublisher", "/p", "/t", "a/T", "http://p:1/")
    await asyncio.sleep(0.1)
    node = RecordingNode("/n")
    await node.start(port)
    try:
        assert await node.has_been_told(1) == [
            ("publisherUpdate", "/master", "/t", ["http://p:1/"])
        ]
    finally:
        await node.close()


async def test_a_master_without_descriptors_tells_later(
    ask: Any, make_node: Any, monkeypatch: Any
) -> None:
    monkeypatch.setattr("aioros1.master.notifier._LONGEST_PAUSE", 0.05)
    sub = await make_node("/sub")
    await ask("registerSubscriber", "/sub", "/t", "a/T", sub.uri)
    with no_descriptors():
        # Over the connection that is open already.
        await ask("registerPublisher", "/p", "/t", "a/T", "http://p:1/")
        await asyncio.sleep(0.1)
        assert sub.told == []
    assert await sub.has_been_told(1) == [("publisherUpdate", "/master", "/t", ["http://p:1/"])]


@contextlib.contextmanager
def no_descriptors() -> Iterator[None]:
    limits = resource.getrlimit(resource.RLIMIT_NOFILE)
    with socket.socket() as spare:
        lowest = spare.fileno()
    try:
        resource.setrlimit(resource.RLIMIT_NOFILE, (lowest, limits[1]))
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_NOFILE, limits)


async def test_a_dead_node_is_given_up(ask: Any, monkeypatch: Any) -> None:
    monkeypatch.setattr("aioros1.master.notifier._GIVE_UP", 0.2)
    monkeypatch.setattr("aioros1.master.notifier._LONGEST_PAUSE", 0.05)
    await ask("registerSubscriber", "/n", "/t", "a/T", f"http://127.0.0.1:{free_port()}/")
    await ask("registerPublisher", "/p", "/t", "a/T", "http://p:1/")
    await asyncio.sleep(0)
    async with asyncio.timeout(30):
        while any("notify http" in task.get_name() for task in asyncio.all_tasks()):
            await asyncio.sleep(0.01)


async def test_a_node_that_has_left_is_not_tried_any_more(ask: Any) -> None:
    uri = f"http://127.0.0.1:{free_port()}/"
    await ask("registerSubscriber", "/n", "/t", "a/T", uri)
    await ask("registerSubscriber", "/n", "/other", "a/T", uri)
    await ask("registerPublisher", "/p", "/t", "a/T", "http://p:1/")
    await ask("unregisterSubscriber", "/n", "/t", uri)
    async with asyncio.timeout(30):
        while any("notify http" in task.get_name() for task in asyncio.all_tasks()):
            await asyncio.sleep(0.01)


async def test_many_nodes_that_hang_do_not_fill_the_log(caplog: pytest.LogCaptureFixture) -> None:
    timeouts = Timeouts(xmlrpc=0.3)
    client = XmlRpcClient()
    with socket.socket() as silent:
        silent.bind(("0.0.0.0", 0))
        silent.listen(100)
        port = silent.getsockname()[1]
        async with Master("127.0.0.1", port=0, rosout=False, timeouts=timeouts) as master:
            for number in range(60):
                uri = f"http://127.0.1.{number + 1}:{port}/"
                await client.call(master.uri, "registerSubscriber", f"/n{number}", "/t", "a/T", uri)
            await client.call(master.uri, "registerPublisher", "/p", "/t", "a/T", "http://p:1/")
            async with asyncio.timeout(10):
                while not any("no answer" in record.message for record in caplog.records):
                    await asyncio.sleep(0.01)
            await asyncio.sleep(0.5)  # the others have not answered either
    await client.close()
    assert sum("no answer" in record.message for record in caplog.records) <= 32


async def test_a_long_list_of_publishers_is_encoded_once_for_all_who_hang() -> None:
    """Each node that takes its time would have megabytes of its own otherwise."""
    bodies: list[bytes | None] = []
    encoder = XmlRpcClient()

    class Client:
        async def encode(self, method: str, *params: Any) -> bytes:
            return await encoder.encode(method, *params)

        async def call(self, uri: str, method: str, *params: Any, body: bytes | None = None) -> Any:
            bodies.append(body)
            await asyncio.sleep(3600)

    client: Any = Client()
    notifier = Notifier(client, is_wanted=lambda message: True, on_unwanted=lambda update: None)
    publishers = [f"http://p{number}:1/" for number in range(100)]
    notifier.send(PublisherUpdate(f"http://n{number}:1/", "/t", publishers) for number in range(20))
    async with asyncio.timeout(10):
        while len(bodies) < 20:
            await asyncio.sleep(0)
    await notifier.close()
    await encoder.close()
    first = bodies[0]
    assert first is not None
    assert all(each is first for each in bodies)
    assert decode_call(first) == ("publisherUpdate", ("/master", "/t", publishers))
