"""A node whose master has forgotten it, for whatever reason, is registered again."""

from __future__ import annotations

import asyncio
import resource
import socket
import time

import pytest

import aioros1
from aioros1.master.api import MasterApi
from aioros1.msg.std_msgs import String

PLAIN = {"rosout": False, "logger_services": False}


class Watched:
    """The events of a node that concern its master."""

    def __init__(self, node: aioros1.Node) -> None:
        self.seen: list[object] = []
        self._events = node.events()
        self._task = asyncio.create_task(self._watch())

    async def _watch(self) -> None:
        async for event in self._events:
            if isinstance(event, aioros1.MasterLost | aioros1.MasterRestarted):
                self.seen.append(event)

    def count(self, kind: type) -> int:
        return sum(isinstance(event, kind) for event in self.seen)


async def until(holds):
    async with asyncio.timeout(30):
        while not await holds():
            await asyncio.sleep(0.005)


async def roles_of(observer, name="/node"):
    state = await observer.master.get_system_state()
    return [
        {topic for topic, nodes in part.items() if name in nodes}
        for part in (state.publishers, state.subscribers, state.services)
    ]


async def open_all(node):
    """A role of each kind."""
    await node.advertise("/out", String)
    await node.subscribe("/in", String)
    await node.advertise_service("/flip", "std_srvs/SetBool", lambda request: None)
    return await node.subscribe_param("/gain", default=1)


ALL = [{"/out"}, {"/in"}, {"/flip"}]


async def purge(observer, node, *, params):
    """What ``rosnode cleanup`` does with a node that did not answer."""
    master = aioros1.MasterProxy(observer.master._client, observer.master.uri, node.name)
    await master.unregister_publisher("/out", node.uri)
    await master.unregister_subscriber("/in", node.uri)
    await master.unregister_service("/flip", node.tcpros_uri)
    if params:
        await master.unsubscribe_param("/gain", node.uri)


async def test_a_master_that_was_replaced_by_one_of_the_same_ids(monkeypatch):
    """As rosmaster is, which is process 1 of its container and sets no run id."""
    methods = MasterApi.methods
    pid = {"getPid": lambda caller_id: [1, "", 1]}
    monkeypatch.setattr(MasterApi, "methods", lambda api: {**methods(api), **pid})
    params = {"/run_id": "same", "/gain": 1}
    options = {"host": "localhost", "rosout": False}
    async with aioros1.Master(port=0, params=params, **options) as old:
        node = aioros1.Node("node", master_uri=old.uri, host="localhost", heartbeat=0.2, **PLAIN)
        await node.start()
        watched = Watched(node)
        psub = await open_all(node)
    async with (
        aioros1.Master(port=old.port, params=params, **options) as new,
        aioros1.Node("observer", master_uri=new.uri, host="localhost", **PLAIN) as observer,
    ):
        await until(lambda: _is(observer, ALL))
        await until(lambda: _true(watched.count(aioros1.MasterRestarted) == 1))
        await observer.set_param("/gain", 2)
        assert await psub.wait_for(lambda value: value == 2, timeout=30) == 2
        await node.close()


async def _is(observer, expected):
    return await roles_of(observer) == expected


async def _true(value):
    return value


@pytest.mark.parametrize("params", [False, True])
async def test_a_node_that_was_unregistered_by_others(make_node, monkeypatch, params):
    """At a master that knows its name all the same, because it follows a parameter, or not."""
    monkeypatch.setattr("aioros1.node.roll_call._CONFIRM", 0.05)
    observer = await make_node("observer", heartbeat=None)
    node = await make_node("node", heartbeat=0.02, **PLAIN)
    watched = Watched(node)
    psub = await open_all(node)
    for number in range(3):
        await purge(observer, node, params=params)
        await until(lambda: _is(observer, ALL))
        await observer.set_param("/gain", 10 + number)
        wanted = 10 + number
        await psub.wait_for(lambda value, wanted=wanted: value == wanted, timeout=30)
    assert watched.count(aioros1.MasterLost) == 0


@pytest.mark.parametrize("role", ["publisher", "subscriber", "service"])
async def test_a_single_role_that_is_missing(make_node, role):
    observer = await make_node("observer", heartbeat=None)
    node = await make_node("node", heartbeat=0.02, **PLAIN)
    watched = Watched(node)
    await open_all(node)
    master = aioros1.MasterProxy(observer.master._client, observer.master.uri, node.name)
    if role == "publisher":
        await master.unregister_publisher("/out", node.uri)
    elif role == "subscriber":
        await master.unregister_subscriber("/in", node.uri)
    else:
        await master.unregister_service("/flip", node.tcpros_uri)
    await until(lambda: _is(observer, ALL))
    assert watched.seen == []


async def test_a_list_that_has_become_long_is_seldom_asked_for(make_node, monkeypatch):
    """All nodes ask for it, and the master has other things to do."""
    asked = []
    pause = 0.0
    get = aioros1.MasterProxy.get_system_state

    async def slower(master):
        asked.append(time.monotonic())
        await asyncio.sleep(pause)
        return await get(master)

    node = await make_node("node", heartbeat=0.02, **PLAIN)
    await node.advertise("/out", String)
    monkeypatch.setattr(aioros1.MasterProxy, "get_system_state", slower)
    await until(lambda: _true(len(asked) > 10))
    pause = 0.05
    del asked[:]
    # Of one node, it may take a twentieth of the time.
    await until(lambda: _true(len(asked) > 1 and asked[-1] - asked[-2] > 0.5))


@pytest.mark.parametrize("pause", [0.05, 1000.0])
async def test_a_followed_parameter_alone(make_node, monkeypatch, pause):
    """No master tells who follows what, so it is followed once more now and then, and when a
    value was not announced."""
    monkeypatch.setattr("aioros1.node.roll_call._CONFIRM", pause)
    asked = []
    follow = aioros1.MasterProxy.subscribe_param

    async def counted(master, key, uri):
        value = await follow(master, key, uri)
        asked.append(key)
        return value

    monkeypatch.setattr(aioros1.MasterProxy, "subscribe_param", counted)
    observer = await make_node("observer", heartbeat=None)
    node = await make_node("node", heartbeat=0.02, **PLAIN)
    events = node.events()
    psub = await open_all(node)
    master = aioros1.MasterProxy(observer.master._client, observer.master.uri, node.name)
    await master.unsubscribe_param("/gain", node.uri)
    await observer.set_param("/gain", 7)
    assert await psub.wait_for(lambda value: value == 7, timeout=30) == 7
    await until(lambda: _true(len(asked) > 1))
    await node.close()
    registered = [event async for event in events if isinstance(event, aioros1.RoleRegistered)]
    assert len(registered) == 4  # being followed once more is no news


async def test_a_service_that_another_node_provides_now_is_left_to_it(make_node):
    node = await make_node("node", heartbeat=0.02, **PLAIN)
    other = await make_node("other", heartbeat=0.02, **PLAIN)
    await open_all(node)
    provider = await other.advertise_service("/flip", "std_srvs/SetBool", lambda request: None)
    for _ in range(10):
        await asyncio.sleep(0.02)
        assert (await other.master.get_system_state()).services["/flip"] == ["/other"]
    # Nobody provides it once the other one has ended, but this one still does.
    await provider.close()
    await until(lambda: _is(other, ALL))


async def test_a_node_that_another_one_has_replaced_does_not_replace_it_in_turn(
    make_node, master, caplog
):
    """It was not told to end: the notice was lost, or the master sends none."""
    node = await make_node("node", heartbeat=0.02, **PLAIN)
    await open_all(node)
    uri = "http://127.0.0.1:1/"
    proxy = aioros1.MasterProxy(node.master._client, master.uri, "/node")
    await proxy.register_publisher("/elsewhere", "std_msgs/String", uri)
    async with asyncio.timeout(30):
        while node.is_open and not any(
            "another node" in each.getMessage() for each in caplog.records
        ):
            await asyncio.sleep(0.01)
    assert await node.master.lookup_node("/node") == uri if node.is_open else True


async def test_a_master_that_lists_nothing_is_not_told_all_the_time(monkeypatch, make_node):
    asked = []
    methods = MasterApi.methods

    def changed(api):
        table = dict(methods(api))
        register = table["registerPublisher"]
        table["registerPublisher"] = lambda *params: asked.append(params) or register(*params)
        table["getSystemState"] = lambda caller_id: [1, "", [[], [], []]]
        table["lookupNode"] = lambda caller_id, name: [-1, "unknown", ""]
        return table

    monkeypatch.setattr(MasterApi, "methods", changed)
    async with aioros1.Master(host="localhost", port=0, rosout=False) as master:
        options = {"master_uri": master.uri, "host": "localhost", "heartbeat": 0.01}
        async with aioros1.Node("node", **options, **PLAIN) as node:
            await node.advertise("/out", String)
            await asyncio.sleep(1)
    assert len(asked) <= 4


@pytest.mark.parametrize("lacking", ["getPid", "getPid getUri", "getPid getParam lookupNode"])
async def test_masters_that_lack_methods(monkeypatch, lacking):
    methods = MasterApi.methods

    def fewer(api):
        return {name: call for name, call in methods(api).items() if name not in lacking.split()}

    monkeypatch.setattr(MasterApi, "methods", fewer)
    options = {"host": "localhost", "rosout": False}
    async with aioros1.Master(port=0, **options) as master:
        await aioros1.wait_for_master(master.uri, timeout=30)
        node = aioros1.Node(
            "node", master_uri=master.uri, host="localhost", heartbeat=0.02, **PLAIN
        )
        await node.start()
        watched = Watched(node)
        await node.wait_for_master(timeout=30)
        await node.advertise("/out", String)
        assert await node.master.ping() >= 0
        for _ in range(10):
            await asyncio.sleep(0.02)
        assert watched.seen == []
    await until(lambda: _true(watched.count(aioros1.MasterLost) == 1))
    async with aioros1.Master(port=master.port, **options):
        await until(lambda: _true(watched.count(aioros1.MasterRestarted) == 1))
        assert "/out" in (await node.master.get_system_state()).publishers
        await node.close()


async def test_what_answers_no_xmlrpc_is_no_master():
    async def answer(reader, writer):
        await reader.readuntil(b"\r\n\r\n")
        writer.write(b"HTTP/1.1 404 Not Found\r\nContent-Length: 0\r\n\r\n")
        writer.close()

    server = await asyncio.start_server(answer, "127.0.0.1", 0)
    async with server:
        port = server.sockets[0].getsockname()[1]
        with pytest.raises(TimeoutError, match="404"):
            await aioros1.wait_for_master(f"http://127.0.0.1:{port}", timeout=0.3)


async def test_a_blocked_loop_is_not_taken_for_a_lost_master():
    """The master is in another process, as what it answers has come while the loop was away."""
    from soak.masters import MasterProcess

    master = MasterProcess()
    await master.start()
    try:
        options = {"master_uri": master.uri, "host": "localhost", "heartbeat": 0.01}
        timeouts = aioros1.Timeouts(xmlrpc=0.1)
        async with aioros1.Node("node", timeouts=timeouts, **options, **PLAIN) as node:
            watched = Watched(node)
            await open_all(node)
            for number in range(20):
                asyncio.get_running_loop().call_soon(time.sleep, 0.15)
                await asyncio.sleep(0.003 * (number % 5))
            assert watched.seen == []
    finally:
        await master.kill()


async def test_without_descriptors_nothing_is_said_about_the_master(make_node):
    node = await make_node("node", heartbeat=None, host="127.0.0.1", **PLAIN)
    held = []
    limits = resource.getrlimit(resource.RLIMIT_NOFILE)
    spare = socket.socket()
    highest = spare.fileno()
    spare.close()
    node._context.xmlrpc.close_idle()
    await asyncio.sleep(0)
    try:
        resource.setrlimit(resource.RLIMIT_NOFILE, (highest + 4, limits[1]))
        try:
            while True:
                held.append(socket.socket())
        except OSError:
            pass
        with pytest.raises(aioros1.MasterUnreachable, match="Too many open files") as refused:
            await node.get_param("/gain")
    finally:
        for sock in held:
            sock.close()
        resource.setrlimit(resource.RLIMIT_NOFILE, limits)
    assert "no master is there" not in str(refused.value)


async def test_no_descriptors_for_a_moment(make_node, caplog):
    observer = await make_node("observer", heartbeat=None)
    node = await make_node("node", heartbeat=0.02, host="127.0.0.1", **PLAIN)
    await open_all(node)
    held = []
    limits = resource.getrlimit(resource.RLIMIT_NOFILE)
    spare = socket.socket()
    highest = spare.fileno()
    spare.close()
    try:
        resource.setrlimit(resource.RLIMIT_NOFILE, (highest + 4, limits[1]))
        try:
            while True:
                held.append(socket.socket())
        except OSError:
            pass
        await purge(observer, node, params=False)
        node._context.xmlrpc.close_idle()
        for _ in range(20):
            await asyncio.sleep(0.02)
    finally:
        for sock in held:
            sock.close()
        resource.setrlimit(resource.RLIMIT_NOFILE, limits)
    await until(lambda: _is(observer, ALL))
    await purge(observer, node, params=True)
    await until(lambda: _is(observer, ALL))


async def test_a_service_that_another_node_takes_and_gives_up(make_node, monkeypatch):
    """It is left to the other node, and then provided again, by the same master."""
    observer = await make_node("observer", heartbeat=None)
    monkeypatch.setattr("aioros1.node.roll_call._SHARE", 1e6)
    node = await make_node("node", heartbeat=0.02, **PLAIN)
    other = await make_node("other", heartbeat=0.02, **PLAIN)
    watched = [Watched(node), Watched(other)]
    await node.advertise_service("/flip", "std_srvs/SetBool", lambda request: None)
    beats = []
    ask = aioros1.MasterProxy.get_pid

    async def counted(master):
        beats.append(master.caller_id)
        return await ask(master)

    monkeypatch.setattr(aioros1.MasterProxy, "get_pid", counted)
    taken = await other.advertise_service("/flip", "std_srvs/SetBool", lambda request: None)
    await until(lambda: _true(beats.count("/node") > 20))
    assert (await observer.master.get_system_state()).services["/flip"] == ["/other"]
    await taken.close()
    await until(lambda: _is(observer, [set(), set(), {"/flip"}]))
    assert [each.seen for each in watched] == [[], []]
