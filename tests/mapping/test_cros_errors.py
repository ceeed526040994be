"""Error codes: the exceptions that take their place, where they come from, what they say."""

from __future__ import annotations

import asyncio
import contextlib

import pytest

import aioros1
from aioros1.msg.std_msgs import Int32, String
from aioros1.srv.roscpp_tutorials import TwoInts
from aioros1.srv.std_srvs import SetBool
from aioros1.xmlrpc.server import XmlRpcServer


@contextlib.asynccontextmanager
async def rude_server(answer=b""):
    """A server that answers anything with ``answer``, and closes."""

    serving = set()

    async def serve(reader, writer):
        serving.add(asyncio.current_task())
        with contextlib.suppress(ConnectionError):
            await reader.read(1)
            writer.write(answer)
            writer.close()
            await writer.wait_closed()

    async with await asyncio.start_server(serve, "127.0.0.1", 0) as server:
        yield server.sockets[0].getsockname()[1]
        await asyncio.wait(serving, timeout=30)


# ------------------------------------------------------------------ cRosErrCodePack


def test_CROS_SUCCESS_ERR_PACK_is_no_exception():
    assert aioros1.load_msg("std_msgs/String") is String


@pytest.mark.parametrize(
    "function",
    [
        "cRosErrCodePack",
        "cRosErrCode",
        "cRosAddErrCode",
        "cRosAddErrCodeIfErr",
        "cRosAddErrCodePackIfErr",
        "cRosRemoveLastErrCode",
        "cRosGetLastErrCode",
    ],
)
async def test_error_has_the_one_before_it_as_its_cause(make_node, function):
    node = await make_node()
    with pytest.raises(aioros1.ServiceNotFound) as caught:
        await node.call("nothing", TwoInts, a=1, b=2, timeout=30)
    assert isinstance(caught.value.__cause__, aioros1.MasterError)
    assert caught.value.__cause__.code == -1


@pytest.mark.parametrize(
    "function", ["cRosGetErrCodeStr", "cRosErrCodePackStr", "cRosPrintErrCodePack"]
)
async def test_text_of_an_error(make_node, function):
    node = await make_node()
    with pytest.raises(aioros1.ServiceNotFound) as caught:
        await node.call("nothing", TwoInts, a=1, b=2, timeout=30)
    assert str(caught.value).startswith("service /nothing: no provider: ")


async def test_cRosErrCodePack_of_several_errors_is_an_ExceptionGroup(make_node):
    """As everything of asyncio: a TaskGroup collects them."""
    node = await make_node()
    with pytest.raises(ExceptionGroup) as caught:
        async with asyncio.TaskGroup() as group:
            group.create_task(node.get_param("one"))
            group.create_task(node.get_param("two"))
    assert {str(error) for error in caught.value.exceptions} <= {"'/one'", "'/two'"}


@pytest.mark.parametrize(
    "error",
    [
        aioros1.InvalidNameError,
        aioros1.MessageError,
        aioros1.MasterError,
        aioros1.PeerError,
        aioros1.HandshakeError,
        aioros1.ServiceError,
        aioros1.ClosedError,
    ],
)
def test_UNSPECIFIED_is_RosError(error):
    assert issubclass(error, aioros1.RosError)


# ------------------------------------------------------------------ wrong arguments


async def test_BAD_PARAM(make_node):
    node = await make_node()
    with pytest.raises(aioros1.InvalidNameError):
        await node.advertise("no blanks", String)
    with pytest.raises(TypeError):
        await node.advertise("chatter", 5)
    with pytest.raises(ValueError, match="overflow must be one of"):
        node.advertise("chatter", String, overflow="drop")
    with pytest.raises(ValueError, match="heartbeat must be positive"):
        aioros1.Node("talker", heartbeat=0)


async def test_MANY_PARAM(make_node):
    node = await make_node()
    async with node.advertise("chatter", String) as pub:
        with pytest.raises(TypeError, match="got both"):
            pub.publish(String(), data="x")


@pytest.mark.parametrize(
    ("open_role", "use"),
    [
        (lambda node: node.subscribe_param("x"), lambda role: role.wait_for(bool)),
        (lambda node: node.advertise("x", String), lambda role: role.send(data="")),
        (lambda node: node.subscribe("x", String), lambda role: role.get()),
    ],
    ids=["PARAM_SUB_IND", "TOPIC_PUB_IND", "TOPIC_SUB_IND"],
)
async def test_role_that_is_closed(make_node, open_role, use):
    node = await make_node()
    role = await open_role(node)
    await role.close()
    with pytest.raises(aioros1.ClosedError, match="/x of /node is closed"):
        await use(role)


# ------------------------------------------------------------------ definitions


@pytest.mark.parametrize("code", ["OPEN_MSG_FILE", "READ_MSG_FILE", "LOAD_MSG_FILE"])
def test_message_that_is_not_found(code):
    with pytest.raises(aioros1.MessageNotFoundError, match=r"\.msg.* of robot_msgs/Nothing"):
        aioros1.load_msg("robot_msgs/Nothing")
    assert issubclass(aioros1.MessageNotFoundError, LookupError)


@pytest.mark.parametrize(
    "code", ["OPEN_SVC_FILE", "READ_SVC_FILE", "LOAD_SVC_FILE_REQ", "LOAD_SVC_FILE_RES"]
)
def test_service_that_is_not_found(code):
    with pytest.raises(aioros1.MessageNotFoundError, match=r"\.srv.* of robot_msgs/Nothing"):
        aioros1.load_srv("robot_msgs/Nothing")


@pytest.mark.parametrize(
    ("kind", "text", "line"),
    [
        ("msg", "string name\nnonsense/a/b c\n", 2),
        ("msg", "stringname\n", 1),
        ("action", "int32 a\n---\nint32 b\n", 0),
        ("msg", "int8 A=1000\n", 1),
    ],
    ids=["FILE_ENTRY_TYPE", "FILE_ENTRY_NO_SEP", "SVC_FILE_DELIM", "CREATE_CUSTOM_MSG"],
)
def test_definition_that_is_wrong(tmp_path, kind, text, line):
    path = tmp_path / "robot_msgs" / kind / f"Thing.{kind}"
    path.parent.mkdir(parents=True)
    path.write_text(text)
    store = aioros1.MessageStore([tmp_path])
    load = store.load_msg if kind == "msg" else store.load_action
    with pytest.raises(aioros1.MessageSpecError) as caught:
        load("robot_msgs/Thing")
    assert (caught.value.path, caught.value.line) == (str(path), line)
    assert str(path) in str(caught.value)


def test_DEPACK_INSUFF_DAT():
    with pytest.raises(aioros1.DeserializationError):
        Int32.from_bytes(b"\1\0\0")


async def test_DEPACK_INSUFF_DAT_of_a_received_message(pair):
    """It is counted and passed over; the next one comes through."""
    talker, listener = pair
    async with (
        talker.advertise("count", Int32) as pub,
        listener.subscribe("count", Int32) as sub,
    ):
        await pub.wait_for_subscribers(timeout=30)
        pub.publish_raw(b"\1\0\0")
        pub.publish(data=7)
        assert (await sub.get(timeout=30)).data == 7
        assert sub.stats.errors == 1


def test_DEPACK_NO_MSG_DEF():
    store = aioros1.MessageStore(parent=None)
    with pytest.raises(aioros1.MessageNotFoundError, match="lacks robot_msgs/Wheel"):
        store.add_definition("robot_msgs/Car", "Wheel wheel\n")


# ------------------------------------------------------------------ timeouts


async def test_UNREG_TIMEOUT_is_not_raised(make_node, silent_port):
    """A node that cannot say good-bye in time is closed all the same, and logs it."""
    node = await make_node()
    await node.advertise("chatter", String)
    node.master.uri = f"http://127.0.0.1:{silent_port}/"
    async with asyncio.timeout(30):
        await node.close(timeout=0.02)
    assert node.state == "closed"


TIMEOUTS = {
    "RCV_TOP_TIMEOUT": (
        lambda node, roles: roles["sub"].get(timeout=0.01),
        "subscriber /count: no message came",
    ),
    "SEND_TOP_TIMEOUT": (
        lambda node, roles: roles["pub"].wait_for_subscribers(timeout=0.01),
        "publisher /other: 1 subscribers did not connect",
    ),
    "CALL_SVC_TIMEOUT": (
        lambda node, roles: roles["caller"].call(a=1, b=2, timeout=0.02),
        "service /add: no answer within 0.02 s",
    ),
    "CALL_INI_TIMEOUT": (
        lambda node, roles: node.wait_for_service("nowhere", timeout=0.02),
        "service /nowhere did not appear within 0.02 s",
    ),
    "SOCK_OPEN_TIMEOUT": (
        lambda node, roles: roles["sub"].wait_for_publishers(timeout=0.01),
        "subscriber /count: 1 publishers did not connect",
    ),
}


@pytest.mark.parametrize("code", TIMEOUTS)
async def test_timeout_says_who_waited_for_what(make_node, code):
    node = await make_node()
    roles = {
        "sub": await node.subscribe("count", Int32),
        "pub": await node.advertise("other", Int32),
        "provider": await node.advertise_service("add", TwoInts),  # never answers
        "caller": await node.service_caller("add", TwoInts),
    }
    wait, text = TIMEOUTS[code]
    with pytest.raises(TimeoutError, match=text):
        await wait(node, roles)


# ------------------------------------------------------------------ the user's own errors


async def test_TOP_PUB_CALLBACK(master):
    def fail(now):
        raise ZeroDivisionError("mine")

    with pytest.raises(ZeroDivisionError, match=r"^mine$"):
        async with aioros1.Node("talker", master_uri=master.uri) as node, asyncio.timeout(30):
            node.timer(0.001, fail, oneshot=True)
            await node.wait_closed()


async def test_TOP_PUB_CALLBACK_may_be_handed_to_a_function(make_node):
    seen = asyncio.get_running_loop().create_future()

    def fail(now):
        raise ZeroDivisionError("mine")

    node = await make_node(on_error=seen.set_result)
    node.timer(0.001, fail, oneshot=True)
    assert isinstance(await asyncio.wait_for(seen, 30), ZeroDivisionError)
    assert node.is_open


async def test_TOP_SUB_CALLBACK(make_node):
    node = await make_node()
    async with (
        node.advertise("count", Int32, latch=True) as pub,
        node.subscribe("count", Int32) as sub,
    ):
        pub.publish(data=0)
        with pytest.raises(ZeroDivisionError):
            async for message in sub:
                1 / message.data


@pytest.mark.parametrize("code", ["SVC_REQ_CALLBACK", "SVC_RES_CALLBACK"])
async def test_error_of_the_caller_is_raised_where_it_is(make_node, code):
    node = await make_node()
    await node.advertise_service("add", TwoInts, lambda request: None)
    async with node.service_caller("add", TwoInts) as caller:
        with pytest.raises(aioros1.SerializationError, match=r"^a: "):
            await caller.call(a="five", timeout=30)
        assert (await caller.call(timeout=30)).sum == 0


async def test_SVC_SER_CALLBACK(make_node):
    node = await make_node()

    def fail(request):
        raise ZeroDivisionError("mine")

    await node.advertise_service("add", TwoInts, fail)
    with pytest.raises(aioros1.ServiceError, match=r"^mine$"):
        await node.call("add", TwoInts, timeout=30)


async def test_SVC_RES_OK_BYTE(make_node, tcpros):
    """0 on the wire, and the text behind it, are the ServiceError of the caller."""
    node = await make_node()

    def refuse(request):
        raise aioros1.ServiceError("not now")

    await node.advertise_service("flip", SetBool, refuse)
    header = {"callerid": "/hand", "service": "/flip", "md5sum": "*"}
    async with tcpros(node.tcpros_address, header) as peer:
        assert await peer.call(b"\1") == (0, b"not now")
    with pytest.raises(aioros1.ServiceError) as caught:
        await node.call("flip", SetBool, timeout=30)
    assert caught.value.text == "not now"


# ------------------------------------------------------------------ connections


@pytest.mark.parametrize("code", ["XMLRPC_CLI_CONN", "XMLRPC_CLI_REFUS"])
async def test_master_that_is_not_there(unused_port, code):
    uri = f"http://127.0.0.1:{unused_port}"
    async with aioros1.Node("talker", master_uri=uri) as node:
        with pytest.raises(aioros1.MasterUnreachable) as caught:
            await node.get_param("rate")
        assert isinstance(caught.value, ConnectionError)
        with pytest.raises(aioros1.MasterUnreachable):
            await node.advertise("chatter", String)


@pytest.mark.parametrize(
    ("code", "answer"),
    [
        ("XMLRPC_CLI_WRITE", b""),
        ("XMLRPC_CLI_READ", b"HTTP/1.1 200 OK\r\nContent-Length: 9\r\n\r\n"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
async def test_master_that_hangs_up(make_node, code, answer):
    node = await make_node()
    async with rude_server(answer) as port:
        node.master.uri = f"http://127.0.0.1:{port}/"
        with pytest.raises(aioros1.MasterUnreachable):
            await node.get_param("rate")


async def test_XMLRPC_CLI_REFUS_of_a_node(pair):
    talker, listener = pair
    await talker.advertise("chatter", String)
    peer = await listener.peer("/talker")
    await talker.close()
    with pytest.raises(aioros1.PeerUnreachable) as caught:
        await peer.get_pid()
    assert isinstance(caught.value, ConnectionError)


@pytest.fixture
async def publisher_elsewhere():
    """A node of another graph that publishes, so that nobody is told of it by a master."""
    async with (
        aioros1.Master(host="localhost", port=0) as master,
        aioros1.Node("far", master_uri=master.uri, rosout=False, logger_services=False) as node,
        node.advertise("chatter", String, latch=True) as pub,
    ):
        pub.publish(data="hi")
        yield node


@pytest.mark.parametrize("code", ["TCPROS_CLI_CONN", "TCPROS_CLI_REFUS"])
async def test_publisher_that_is_not_there_is_tried_again(
    make_node, publisher_elsewhere, unused_port, code
):
    """Topics raise nothing: the publisher may come back, and does."""
    addresses = [publisher_elsewhere.tcpros_address, ("127.0.0.1", unused_port)]

    def request_topic(caller_id, topic, protocols):
        return [1, "ready", ["TCPROS", *(addresses.pop() if len(addresses) > 1 else addresses[0])]]

    node = await make_node()
    server = XmlRpcServer({"requestTopic": request_topic})
    await server.start("127.0.0.1")
    try:
        async with node.subscribe("chatter", String) as sub:
            peer = await node.peer(node.name)
            uri = f"http://127.0.0.1:{server.port}/"
            await peer.call("publisherUpdate", "/chatter", [uri])
            assert (await sub.get(timeout=30)).data == "hi"
    finally:
        await server.close()
    assert len(addresses) == 1


async def test_XMLRPC_CLI_REFUS_of_a_publisher_is_no_error(
    make_node, publisher_elsewhere, unused_port
):
    node = await make_node()
    async with node.subscribe("chatter", String) as sub:
        uris = [f"http://127.0.0.1:{unused_port}/", publisher_elsewhere.uri]
        await (await node.peer(node.name)).call("publisherUpdate", "/chatter", uris)
        assert (await sub.get(timeout=30)).data == "hi"


@pytest.mark.parametrize("code", ["RPCROS_CLI_CONN", "RPCROS_CLI_REFUS", "SOCK_OPEN_CONN"])
async def test_provider_that_is_not_there_is_raised(make_node, unused_port, code):
    node = await make_node()
    await node.master.register_service("/add", f"rosrpc://127.0.0.1:{unused_port}", node.uri)
    with pytest.raises(aioros1.ServiceUnavailable) as caught:
        await node.call("add", TwoInts, timeout=30)
    assert isinstance(caught.value, ConnectionError)


async def test_RPCROS_CLI_CONN_lost_before_the_answer(make_node):
    node = await make_node()
    async with rude_server() as port:
        await node.master.register_service("/add", f"rosrpc://127.0.0.1:{port}", node.uri)
        with pytest.raises((aioros1.HandshakeError, aioros1.ServiceUnavailable)):
            await node.call("add", TwoInts, timeout=30)


async def test_SELECT_FD_of_a_port_that_is_taken(make_node):
    first = await make_node("first")
    with pytest.raises(OSError, match=r"."):
        await make_node("second", tcpros_port=first.tcpros_address[1])
