"""The life of a node: cRosNodeCreate to cRosNodeDestroy, and what CrosNode holds."""

from __future__ import annotations

import asyncio
import os
import signal
import socket
import threading
from urllib.parse import urlsplit

import pytest

import aioros1
from aioros1.msg.std_msgs import String
from aioros1.srv.std_srvs import Empty
from aioros1.xmlrpc.client import XmlRpcClient

# ------------------------------------------------------------------ cRosNodeCreate


def test_cRosNodeCreate_does_no_io(monkeypatch):
    def refuse(*args, **kwargs):
        pytest.fail("a socket was made")

    monkeypatch.setattr(socket, "socket", refuse)
    node = aioros1.Node("talker", master_uri="http://localhost:11311")
    assert node.name == "/talker"
    assert node.state == "new"
    assert not node.is_open


async def test_cRosNodeCreate_then_start_is_known_to_others(make_node):
    node = await make_node("talker")
    async with node.advertise("chatter", String):
        assert await node.master.lookup_node("/talker") == node.uri


async def test_cRosNodeCreate_host_is_what_others_are_told(make_node):
    node = await make_node(host="127.0.0.1")
    assert urlsplit(node.uri).hostname == "127.0.0.1"
    assert node.tcpros_address[0] == "127.0.0.1"


async def test_cRosNodeCreate_roscore_host_and_roscore_port_are_the_master_uri(master):
    host, port = urlsplit(master.uri).hostname, master.port
    async with aioros1.Node("talker", master_uri=f"http://{host}:{port}") as node:
        assert await node.master.get_uri() == master.uri


def test_cRosNodeCreate_message_root_path_is_a_store(tmp_path):
    folder = tmp_path / "robot_msgs" / "msg"
    folder.mkdir(parents=True)
    (folder / "Wheel.msg").write_text("float64 speed\n")
    node = aioros1.Node("talker", store=aioros1.MessageStore([tmp_path]))
    assert node.store.load_msg("robot_msgs/Wheel")(speed=2.5).speed == 2.5


async def test_cRosNodeCreate_message_root_path_is_used_by_roles(make_node, tmp_path):
    folder = tmp_path / "robot_msgs" / "msg"
    folder.mkdir(parents=True)
    (folder / "Wheel.msg").write_text("float64 speed\n")
    node = await make_node(store=aioros1.MessageStore([tmp_path]))
    async with (
        node.advertise("wheel", "robot_msgs/Wheel", latch=True) as pub,
        node.subscribe("wheel", "robot_msgs/Wheel") as sub,
    ):
        pub.publish(speed=2.5)
        assert (await sub.get(timeout=30)).speed == 2.5


def test_cRosNodeCreate_takes_what_is_not_given_from_the_environment(monkeypatch):
    monkeypatch.setenv("ROS_MASTER_URI", "http://127.0.0.1:11399")
    monkeypatch.setenv("ROS_NAMESPACE", "robot")
    monkeypatch.setenv("ROS_IP", "127.0.0.1")
    node = aioros1.Node("talker")
    assert (node.master_uri, node.name, node.host) == (
        "http://127.0.0.1:11399",
        "/robot/talker",
        "127.0.0.1",
    )


def test_cRosNodeCreate_takes_a_command_line():
    words = ["__name:=speaker", "__ns:=robot", "__master:=http://127.0.0.1:11399", "a:=b"]
    node = aioros1.Node("talker", argv=words)
    assert (node.name, node.master_uri) == ("/robot/speaker", "http://127.0.0.1:11399")
    assert node.resolve_name("a") == "/robot/b"


def test_cRosNodeCreate_refuses_names_at_once():
    with pytest.raises(aioros1.InvalidNameError, match="not a node name"):
        aioros1.Node("no/slashes")


async def test_cRosNodeCreate_has_rosout_and_logger_services_of_its_own(make_node):
    node = await make_node("talker", rosout=True, logger_services=True)
    graph = await node.graph.wait_for(
        lambda graph: "/talker/set_logger_level" in graph.services, timeout=30
    )
    assert "/talker" in graph.publishers["/rosout"]
    assert graph.topic_types["/rosout"] == "rosgraph_msgs/Log"
    assert "/talker/get_loggers" in graph.services


async def test_cRosNodeCreate_without_rosout_and_logger_services(make_node):
    node = await make_node("talker", rosout=False, logger_services=False)
    async with node.advertise("chatter", String):
        graph = await node.graph.snapshot()
    assert "/talker" not in graph.publishers.get("/rosout", ())
    assert not [name for name in graph.services if name.startswith("/talker/")]


# ------------------------------------------------------------------ cRosNodeStart


async def test_cRosNodeStart_with_timeout_is_asyncio_timeout(make_node):
    node = await make_node()
    with pytest.raises(TimeoutError):
        async with asyncio.timeout(0.01):
            await node.wait_closed()
    assert node.is_open


async def test_cRosNodeStart_exit_flag_is_close(make_node):
    node = await make_node()
    running = asyncio.create_task(node.wait_closed())
    await asyncio.sleep(0)
    assert not running.done()
    await node.close()
    assert await asyncio.wait_for(running, 30) == "closed"


async def test_cRosNodeStart_exit_flag_is_cancellation(master):
    opened = asyncio.get_running_loop().create_future()

    async def program():
        async with aioros1.Node("talker", master_uri=master.uri) as node:
            opened.set_result(node)
            await node.wait_closed()

    running = asyncio.create_task(program())
    node = await asyncio.wait_for(opened, 30)
    running.cancel()
    with pytest.raises(asyncio.CancelledError):
        await running
    assert node.state == "closed"


def test_cRosNodeStart_of_a_script_is_run(unused_port):
    async def main(node):
        return node.name, node.is_open

    uri = f"http://127.0.0.1:{unused_port}"
    assert aioros1.run(main, "script", argv=[], master_uri=uri) == ("/script", True)


def test_cRosNodeStart_exit_flag_of_a_script_is_a_signal(unused_port):
    ended = []

    async def main(node):
        signal.raise_signal(signal.SIGINT)
        try:
            await asyncio.sleep(30)
        except asyncio.CancelledError:
            ended.append(node.is_open)
        return "orderly"

    uri = f"http://127.0.0.1:{unused_port}"
    assert aioros1.run(main, "script", argv=[], master_uri=uri) == "orderly"
    assert ended == [True]


async def test_CROS_INFINITE_TIMEOUT_is_None(pair):
    talker, listener = pair
    async with listener.subscribe("chatter", String) as sub:
        waiting = asyncio.create_task(sub.get(timeout=None))
        async with talker.advertise("chatter", String) as pub, asyncio.timeout(30):
            await pub.wait_for_subscribers(timeout=None)
            assert not waiting.done()
            await pub.send(data="at last", timeout=None)
            await pub.drain(timeout=None)
            assert (await waiting).data == "at last"


# ------------------------------------------------------------------ cRosNodeDoEventsLoop


async def test_cRosNodeDoEventsLoop_is_the_loop_of_the_application(pair):
    """Two nodes and a task that is not theirs go on in one loop."""
    talker, listener = pair
    ticks = 0

    async def tick():
        nonlocal ticks
        while True:
            await asyncio.sleep(0)
            ticks += 1

    ticking = asyncio.create_task(tick())
    async with (
        talker.advertise("chatter", String) as pub,
        listener.subscribe("chatter", String) as sub,
    ):
        await pub.wait_for_subscribers(timeout=30)
        pub.publish(data="hi")
        assert (await sub.get(timeout=30)).data == "hi"
    ticking.cancel()
    assert ticks > 1


def test_cRosNodeDoEventsLoop_in_a_synchronous_program_is_a_runner():
    """The program runs the loop, a step at a time, when it has time for it."""
    with asyncio.Runner() as runner:
        master = aioros1.Master(host="localhost", port=0)
        runner.run(master.start())
        node = runner.run(aioros1.Node("talker", master_uri=master.uri).start())

        async def open_roles():
            return await node.advertise("chatter", String), await node.subscribe("chatter", String)

        pub, sub = runner.run(open_roles())
        runner.run(pub.wait_for_subscribers(timeout=30))
        runner.run(pub.send(data="hi"))
        assert runner.run(sub.get(timeout=30)).data == "hi"
        runner.run(node.close())
        runner.run(master.close())


async def test_single_thread(pair):
    """As cROS: no thread is started, whatever a node does."""
    threads = threading.enumerate()
    talker, listener = pair
    async with (
        talker.advertise("chatter", String, latch=True) as pub,
        listener.subscribe("chatter", String) as sub,
        listener.advertise_service("nothing", Empty, lambda request: None),
    ):
        pub.publish(data="hi")
        await sub.get(timeout=30)
        await talker.call("nothing", Empty, timeout=30)
        assert threading.enumerate() == threads


# ------------------------------------------------------------------ cRosNodeDestroy


async def open_one_of_each(node):
    await node.advertise("out", String)
    await node.subscribe("in", String)
    await node.advertise_service("nothing", Empty, lambda request: None)
    await node.service_caller("nothing", Empty)
    await node.subscribe_param("rate", default=1)


async def test_cRosNodeDestroy_unregisters_every_role(recorder, make_node):
    node = await make_node("talker", master_uri=recorder.uri)
    await open_one_of_each(node)
    roles = node.roles
    await node.close()
    assert recorder.count("unregisterPublisher", "/talker", "/out") == 1
    assert recorder.count("unregisterSubscriber", "/talker", "/in") == 1
    assert recorder.count("unregisterService", "/talker", "/nothing") == 1
    assert recorder.count("unsubscribeParam", "/talker") == 1
    observer = await make_node("observer")
    assert "/talker" not in (await observer.graph.snapshot()).nodes
    assert [role.is_open for role in roles] == [False] * 5
    assert node.roles == ()


async def test_cRosNodeDestroy_twice_is_once(make_node):
    node = await make_node()
    await asyncio.gather(node.close(), node.close())
    await node.close()
    assert node.state == "closed"
    with pytest.raises(aioros1.ClosedError, match="is closed, not open"):
        await node.advertise("chatter", String)


async def test_cRosNodeDestroy_is_leaving_async_with(master):
    async with aioros1.Node("talker", master_uri=master.uri) as node:
        await open_one_of_each(node)
        assert node.is_open
    assert node.state == "closed"


async def test_cRosNodeDestroy_when_the_master_is_gone(master, make_node):
    node = await make_node()
    await open_one_of_each(node)
    await master.close()
    await node.close()
    assert node.state == "closed"
    assert node.connections == ()
    with pytest.raises(OSError, match=r"."):
        await asyncio.open_connection(*node.tcpros_address)


async def test_cRosNodeDestroy_gives_up_on_a_master_that_is_silent(make_node, silent_port):
    """CN_UNREGISTRATION_TIMEOUT: what cannot be told in time is dropped."""
    node = await make_node()
    await open_one_of_each(node)
    node.master.uri = f"http://127.0.0.1:{silent_port}/"
    async with asyncio.timeout(30):
        await node.close(timeout=0.05)
    assert node.state == "closed"


async def test_CN_UNREGISTRATION_TIMEOUT(make_node):
    assert aioros1.Timeouts().close == 3.0
    node = await make_node(timeouts=aioros1.Timeouts(close=1.0))
    assert node.options.timeouts.close == 1.0


# ------------------------------------------------------------------ the master


async def test_cRosWaitPortOpen_waits_for_the_master(unused_port):
    uri = f"http://127.0.0.1:{unused_port}"
    async with aioros1.Node("talker", master_uri=uri) as node:
        with pytest.raises(TimeoutError, match="no master at"):
            await node.wait_for_master(timeout=0.01)
    with pytest.raises(TimeoutError, match="no master at"):
        await aioros1.wait_for_master(uri, timeout=0.01)


async def test_cRosWaitPortOpen_returns_when_the_master_is_there(master, make_node):
    await aioros1.wait_for_master(master.uri, timeout=30)
    node = await make_node()
    await node.wait_for_master(timeout=30)
    assert node.run_id == master.run_id


async def test_cRosWaitPortOpen_a_node_may_be_started_before_its_master():
    async with aioros1.Master(host="localhost", port=0) as master:
        uri, port = master.uri, master.port
    async with aioros1.Node("talker", master_uri=uri) as node:
        waiting = asyncio.create_task(node.wait_for_master(timeout=30))
        await asyncio.sleep(0)
        async with aioros1.Master(host="localhost", port=port):
            await waiting
            async with node.advertise("chatter", String):
                assert await node.master.lookup_node("/talker") == node.uri


async def test_getPid_is_the_heartbeat(recorder, make_node, until):
    await make_node("talker", master_uri=recorder.uri, heartbeat=0.01)
    await until(lambda: recorder.count("getPid", "/talker") >= 3)


async def test_getPid_is_not_asked_without_heartbeat(recorder, make_node):
    node = await make_node("talker", master_uri=recorder.uri, heartbeat=None)
    asked = recorder.count("getPid")
    async with node.advertise("chatter", String):
        pass
    assert recorder.count("getPid") == asked == 1


def test_CN_PING_LOOP_PERIOD():
    assert aioros1.Node("talker").options.heartbeat == 1.0


async def test_restartAdversing_registers_every_role_with_the_next_master():
    async with aioros1.Master(host="localhost", port=0) as master:
        port = master.port
        node = aioros1.Node(
            "talker",
            master_uri=master.uri,
            rosout=False,
            logger_services=False,
            heartbeat=0.02,
        )
        await node.start()
        await open_one_of_each(node)
        events = node.events()
    try:
        async with asyncio.timeout(10):
            assert isinstance(await anext(events), aioros1.MasterLost)
            async with aioros1.Master(host="localhost", port=port) as master:
                while not isinstance(event := await anext(events), aioros1.MasterRestarted):
                    pass
                assert event.run_id == master.run_id
                graph = await node.graph.snapshot()
                assert "/talker" in graph.publishers["/out"]
                assert "/talker" in graph.subscribers["/in"]
                assert "/talker" in graph.services["/nothing"]
                # And the parameter: the master tells those who follow it.
                async with aioros1.Node("other", master_uri=master.uri) as other:
                    await other.set_param("/rate", 7)
                [psub] = [role for role in node.roles if isinstance(role, aioros1.ParamSubscriber)]
                assert await psub.wait_for(lambda rate: rate == 7) == 7
    finally:
        await node.close()


# ------------------------------------------------------------------ CrosNode


async def test_CrosNode_name(make_node):
    assert (await make_node("talker", namespace="robot")).name == "/robot/talker"


async def test_CrosNode_host(make_node):
    assert (await make_node(host="127.0.0.1")).host == "127.0.0.1"


async def test_CrosNode_xmlrpc_port(make_node):
    node = await make_node()
    port = urlsplit(node.uri).port
    _, writer = await asyncio.open_connection("127.0.0.1", port)
    writer.close()
    await writer.wait_closed()


async def test_CrosNode_tcpros_port_and_rpcros_port_are_one(make_node):
    """Topics and services share a port, as in rospy and roscpp."""
    node = await make_node()
    async with node.advertise_service("nothing", Empty, lambda request: None):
        uri = urlsplit(await node.master.lookup_service("/nothing"))
        assert (uri.hostname, uri.port) == node.tcpros_address
    async with node.advertise("chatter", String):
        peer = await node.peer(node.name)
        chosen = await peer.request_topic("/chatter", [["TCPROS"]])
        assert chosen == ["TCPROS", *node.tcpros_address]


async def test_CrosNode_ports_can_be_chosen(make_node):
    first = await make_node("first")
    ports = urlsplit(first.uri).port, first.tcpros_address[1]
    await first.close()
    second = await make_node("second", xmlrpc_port=ports[0], tcpros_port=ports[1])
    assert (urlsplit(second.uri).port, second.tcpros_address[1]) == ports


async def test_CrosNode_pid(make_node):
    assert (await make_node()).pid == os.getpid()


async def test_CrosNode_roscore_pid(make_node):
    assert await (await make_node()).master.get_pid() == os.getpid()


async def test_CrosNode_roscore_host_and_roscore_port(master, make_node):
    node = await make_node()
    assert node.master_uri == master.uri
    assert urlsplit(node.master_uri).port == master.port


async def test_CrosNode_message_root_path(make_node, tmp_path):
    store = aioros1.MessageStore([tmp_path])
    assert (await make_node(store=store)).store is store


async def test_CrosNode_log_level(make_node, keep_log_level):
    node = await make_node("talker")
    keep_log_level(node.log.logger)
    node.log.setLevel("ERROR")
    assert node.log.logger.level == 40


# ------------------------------------------------------------------ limits and timeouts


async def test_CN_MAX_PUBLISHED_TOPICS_and_CN_MAX_SUBSCRIBED_TOPICS_are_no_limits(make_node):
    node = await make_node()
    for number in range(6):
        await node.advertise(f"out{number}", String)
        await node.subscribe(f"in{number}", String)
    graph = await node.graph.snapshot()
    assert {f"/out{number}" for number in range(6)} <= graph.publishers.keys()
    assert {f"/in{number}" for number in range(6)} <= graph.subscribers.keys()


async def test_CN_MAX_SERVICE_PROVIDERS_and_CN_MAX_SERVICE_CALLERS_are_no_limits(make_node):
    node = await make_node()
    for number in range(9):
        await node.advertise_service(f"nothing{number}", Empty, lambda request: None)
        caller = await node.service_caller(f"nothing{number}", Empty)
        await caller.call(timeout=30)
    assert len((await node.graph.snapshot()).services) == 9


async def test_CN_MAX_PARAMETER_SUBSCRIPTIONS_is_no_limit(make_node):
    node = await make_node()
    subscribers = [await node.subscribe_param(f"rate{number}") for number in range(21)]
    await node.set_param("rate20", 5)
    assert subscribers[20].value == 5


async def test_CN_MAX_TCPROS_SERVER_CONNECTIONS_is_a_limit_of_safety(make_node):
    """The connection beyond ``limits.connections`` is closed at once, and counted."""
    node = await make_node(limits=aioros1.Limits(connections=1))
    _, first = await asyncio.open_connection(*node.tcpros_address)
    reader, second = await asyncio.open_connection(*node.tcpros_address)
    async with asyncio.timeout(30):
        assert await reader.read() == b""
    assert node.stats.connections_refused == 1
    for writer in (first, second):
        writer.close()
        await writer.wait_closed()


async def test_CN_IO_TIMEOUT_of_a_handshake(make_node):
    node = await make_node(timeouts=aioros1.Timeouts(handshake=0.02))
    reader, writer = await asyncio.open_connection(*node.tcpros_address)
    async with asyncio.timeout(30):
        answer = await reader.read()
    assert b"error=" in answer
    assert b"no whole connection header" in answer
    writer.close()
    await writer.wait_closed()


async def test_CN_IO_TIMEOUT_of_a_request_to_a_node(silent_port):
    client = XmlRpcClient(timeouts=aioros1.Timeouts(xmlrpc=0.02))
    peer = aioros1.NodeProxy(client, f"http://127.0.0.1:{silent_port}/", "/node")
    try:
        with pytest.raises(aioros1.PeerUnreachable):
            await peer.get_pid()
    finally:
        await client.close()


# ------------------------------------------------------------------ the rest


@pytest.mark.parametrize(
    ("name", "resolved"),
    [
        ("/chatter", "/chatter"),
        ("chatter", "/robot/chatter"),
        ("arm/joint", "/robot/arm/joint"),
        ("~rate", "/robot/talker/rate"),
        ("scan", "/robot/laser"),
    ],
)
def test_cRosNamespaceBuild(name, resolved):
    node = aioros1.Node("talker", namespace="robot", remap={"scan": "laser"})
    assert node.resolve_name(name) == resolved


@pytest.mark.parametrize(
    ("function", "type", "path"),
    [
        ("cRosGetMsgFilePath", "std_msgs/String", "std_msgs/msg/String.msg"),
        ("getMsgFilePath", "std_msgs/String", "std_msgs/msg/String.msg"),
        ("getSrvFilePath", "std_srvs/SetBool", "std_srvs/srv/SetBool.srv"),
    ],
    ids=lambda value: value,
)
def test_file_paths(function, type, path):
    found = aioros1.MessageStore().find(type)
    assert found.is_file()
    assert found.as_posix().endswith(path)


async def test_cRosNodeGetParameterValue(make_node):
    node = await make_node()
    await node.set_param("rate", 10)
    async with node.subscribe_param("rate") as psub:
        assert psub.value == 10


async def test_cRosNodeGetParameterValue_without_asking_the_master(recorder, make_node):
    node = await make_node(master_uri=recorder.uri)
    await node.set_param("rate", 10)
    for _ in range(3):
        assert await node.get_param_cached("rate") == 10
    assert recorder.count("subscribeParam") == 1
    assert recorder.count("getParam", "/node", "/rate") == 0


@pytest.mark.parametrize("probe", [False, True], ids=["SERVICECALL_MATLAB", "SERVICEPROBE_MATLAB"])
async def test_TCPROS_header_variants_of_MATLAB(make_node, tcpros, probe):
    """Headers with fewer fields than others send, in another order, and unknown ones."""
    node = await make_node()
    async with node.advertise_service("nothing", Empty, lambda request: None):
        fields = {
            "request_type": "std_srvs/EmptyRequest",
            "service": "/nothing",
            "response_type": "std_srvs/EmptyResponse",
            "md5sum": Empty._md5sum,
            "callerid": "/matlab_node",
        }
        if probe:
            fields["probe"] = "1"
        async with tcpros(node.tcpros_address, fields) as peer:
            assert peer.header["md5sum"] == Empty._md5sum
            if not probe:
                assert await peer.call(b"") == (1, b"")
