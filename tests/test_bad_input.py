"""Words, variables and masters that are wrong: what is refused, and with which text."""

from __future__ import annotations

import contextlib
from collections.abc import AsyncIterator

import pytest
from aiohttp import web

import aioros1

# --------------------------------------------------------------------------- words


@pytest.mark.parametrize(
    ("word", "error", "parts"),
    [
        ("_list:=[1,", ValueError, ["'[1,'", "expected a value in YAML"]),
        ("_o:=!!python/object:os.system {}", ValueError, ["expected a value in YAML"]),
        ("_n:=null", ValueError, ["'null'", "expected the value of a parameter"]),
        ("_n:=99999999999", ValueError, ["'99999999999'", "32 bits"]),
        ("_d:={1: 2}", ValueError, ["'{1: 2}'", "keys of a struct are strings"]),
        ("_d:=2026-01-01", ValueError, ["'2026-01-01'", "expected the value of a parameter"]),
        ("__name:=a/b", aioros1.InvalidNameError, ["'a/b'", "a single name like 'camera'"]),
        ("__name:=a b", aioros1.InvalidNameError, ["'a b'", "a single name like 'camera'"]),
        ("__ns:=~x", aioros1.InvalidNameError, ["'~x'", "expected one like '/robot/arm'"]),
        ("__master:=localhost:11311", ValueError, ["'localhost:11311'", "http://host:port"]),
        ("__ip:=10.0.0.2:80", ValueError, ["'10.0.0.2:80'", "without a port"]),
        ("__hostname:=http://robot", ValueError, ["'http://robot'", "without a port"]),
        ("__hostname:=my robot", ValueError, ["'my robot'", "'robot.local' or '10.0.0.2'"]),
        ("scan:=a b", aioros1.InvalidNameError, ["'a b'", "name to remap to"]),
        ("scan:=b:=c", aioros1.InvalidNameError, ["'b:=c'", "name to remap to"]),
    ],
)
def test_words_of_a_command_line(word, error, parts):
    with pytest.raises(error) as caught:
        aioros1.Node("demo", argv=[word])
    assert str(caught.value).startswith(f"{word}: ")
    for part in parts:
        assert part in str(caught.value)


@pytest.mark.parametrize("argv", ["_rate:=10", b"_rate:=10", [3], [b"_rate:=10"]])
def test_what_is_no_command_line(argv):
    with pytest.raises(TypeError, match=r"of a command line is a str|a list of words"):
        aioros1.Node("demo", argv=argv)


@pytest.mark.parametrize(
    ("option", "value", "expected"),
    [
        ("host", 3, "a str or None"),
        ("bind", ["10.0.0.1"], "a str or None"),
        ("remap", 3, "a mapping of names or None"),
        ("timeouts", 3, "aioros1.Timeouts"),
        ("limits", None, "aioros1.Limits"),
        ("heartbeat", "1", "a number of seconds or None"),
        ("use_sim_time", "no", "True, False or None"),
        ("logger_services", "no", "True or False"),
        ("anonymous", "no", "True or False"),
        ("store", "share/msg", "a MessageStore or None"),
        ("xmlrpc_port", "x", "a whole number from 0 to 65535"),
        ("xmlrpc_port", 65536, "a whole number from 0 to 65535"),
        ("tcpros_port", -1, "a whole number from 0 to 65535"),
        ("tcpros_port", True, "a whole number from 0 to 65535"),
    ],
)
def test_what_is_no_option(option, value, expected):
    with pytest.raises((TypeError, ValueError)) as caught:
        aioros1.Node("demo", **{option: value})
    assert str(caught.value) == f"{option} must be {expected}, got {value!r}"


async def test_what_cannot_be_called(make_node):
    node = await make_node()
    with pytest.raises(TypeError, match="the callback of a timer is a function, got 'tick'"):
        node.timer(1, "tick")
    with pytest.raises(TypeError, match="service flip: the handler is a function, got 'flip'"):
        await node.advertise_service("flip", "std_srvs/Empty", "flip")


async def test_what_is_no_value_of_a_parameter(make_node):
    node = await make_node()
    with pytest.raises(
        TypeError, match=r"parameter /arm\['joints'\]\[1\]: XML-RPC has no type for"
    ):
        await node.set_param("arm", {"joints": [1, object()]})
    assert not await node.has_param("arm")


@pytest.mark.parametrize(
    ("variable", "value", "error", "expected"),
    [
        ("ROS_MASTER_URI", "rubbish", ValueError, "http://host:port"),
        ("ROS_NAMESPACE", "a b", aioros1.InvalidNameError, "expected one like '/robot/arm'"),
        ("ROS_IP", "10.0.0.2:80", ValueError, "without a port"),
        ("ROS_HOSTNAME", "my robot", ValueError, "'robot.local' or '10.0.0.2'"),
    ],
)
def test_variables_of_the_environment(monkeypatch, variable, value, error, expected):
    monkeypatch.setenv(variable, value)
    with pytest.raises(error) as caught:
        aioros1.Node("demo")
    assert str(caught.value).startswith(f"{variable}={value}: ")
    assert repr(value) in str(caught.value)
    assert expected in str(caught.value)


def test_what_is_said_with_more_weight_is_not_looked_at_twice(monkeypatch):
    """A wrong value that counts for nothing is no error."""
    monkeypatch.setenv("ROS_MASTER_URI", "rubbish")
    monkeypatch.setenv("ROS_IP", "my robot")
    node = aioros1.Node("demo", argv=["__master:=http://robot:1", "__ip:=10.0.0.2"])
    assert node.master_uri == "http://robot:1"


@pytest.mark.parametrize("words", [[], ["__name:=", "__ns:=", "__ip:=", "__master:="]])
def test_words_and_variables_that_are_empty_say_nothing(monkeypatch, words):
    for variable in ("ROS_MASTER_URI", "ROS_NAMESPACE", "ROS_IP", "ROS_HOSTNAME"):
        monkeypatch.setenv(variable, "")
    node = aioros1.Node("demo", argv=words)
    assert (node.name, node.master_uri) == ("/demo", "http://localhost:11311")


async def test_an_empty_parameter_has_to_be_quoted(make_node):
    """An assignment of nothing is ignored, as in rospy."""
    words = ["_none:=", "_text:=''", "_quoted:='7'", "_map:={a: [1, 2.5]}"]
    node = await make_node(argv=words)
    assert await node.get_param("~") == {"text": "", "quoted": "7", "map": {"a": [1, 2.5]}}


@pytest.mark.parametrize("name", ["1x", "a-b", "ü", "x.y"])
async def test_names_that_only_the_rules_forbid(make_node, name):
    """Every master takes them, and robots in the field use them."""
    node = await make_node(argv=[f"__name:={name}"])
    other = await make_node("other")
    async with node.advertise("chatter", "std_msgs/String"):
        assert await (await other.peer(f"/{name}")).get_master_uri() == node.master_uri


@pytest.mark.parametrize(
    "host", ["robot", "robot.local", "10.0.0.2", "fe80::1", "fe80::1%eth0", "no-such-host.invalid"]
)
def test_hosts_that_may_be_some(host):
    """Whether a name is known has to be said where it is used, and not here."""
    assert aioros1.Node("demo", argv=[f"__hostname:={host}"]).options.argv


# --------------------------------------------------------------------------- masters


@pytest.mark.parametrize(
    "uri",
    [
        *("rubbish", "robot:11311", "https://robot:1", "ftp://robot:1", "http://", "http://[::1"),
        *("http://robot:x", "http://robot:0", "http://robot:99999", "http://a b:1"),
        *(" http://robot:1", "http://robot:1\n", b"http://robot:1", 11311),
    ],
)
async def test_what_is_no_uri_of_a_master(uri):
    with pytest.raises(ValueError, match="expected http://host:port") as caught:
        aioros1.Node("demo", master_uri=uri)
    assert repr(uri) in str(caught.value)
    with pytest.raises(ValueError, match="expected http://host:port"):
        await aioros1.wait_for_master(uri, timeout=30)


@contextlib.asynccontextmanager
async def web_server(status: int, body: str, kind: str) -> AsyncIterator[str]:
    async def page(request: web.BaseRequest) -> web.Response:
        return web.Response(text=body, status=status, content_type=kind)

    runner = web.ServerRunner(web.Server(page))
    await runner.setup()
    try:
        await web.TCPSite(runner, "127.0.0.1", 0).start()
        yield f"http://127.0.0.1:{runner.addresses[0][1]}"
    finally:
        await runner.cleanup()


NO_TRIPLE = (
    "<?xml version='1.0'?><methodResponse><params><param><value>hello</value></param></params>"
    "</methodResponse>"
)

FAULT = (
    "<?xml version='1.0'?><methodResponse><fault><value><struct>"
    "<member><name>faultCode</name><value><int>7</int></value></member>"
    "<member><name>faultString</name><value><string>no such method</string></value></member>"
    "</struct></value></fault></methodResponse>"
)


@pytest.mark.parametrize(
    ("status", "body", "kind", "why"),
    [
        (200, "<html>Welcome!</html>", "text/html", "got a <html>; expected the answer of a ROS"),
        (200, "Welcome!", "text/plain", "expected the answer of a ROS master"),
        (200, "", "text/xml", "expected the answer of a ROS master"),
        (404, "", "text/plain", "HTTP status 404 Not Found; expected the answer of a ROS master"),
        (501, "", "text/plain", "HTTP status 501"),
        (200, NO_TRIPLE, "text/xml", "expected [code, status, value], got 'hello'"),
        (200, FAULT, "text/xml", "no such method (code 7)"),
    ],
    ids=["page", "text", "nothing", "404", "501", "xmlrpc", "fault"],
)
async def test_a_web_server_that_is_no_master(status, body, kind, why):
    async with (
        web_server(status, body, kind) as uri,
        aioros1.Node("demo", master_uri=uri, host="localhost", heartbeat=None) as node,
    ):
        waits = {
            "node": lambda: node.wait_for_master(timeout=0.2),
            "script": lambda: aioros1.wait_for_master(uri, timeout=0.2),
        }
        for wait in waits.values():
            with pytest.raises(TimeoutError) as late:
                await wait()
            assert f"no master at {uri} within 0.2 s: getPid at {uri}: " in str(late.value)
            assert why in str(late.value)
        with pytest.raises(TimeoutError, match="service /flip did not appear within") as late:
            await node.wait_for_service("flip", timeout=0.2)
        assert f"lookupService at {uri}: " in str(late.value)
        assert why in str(late.value)
        uses = {
            "registerPublisher": lambda: node.advertise("chatter", "std_msgs/String"),
            "getParam": lambda: node.get_param("rate"),
            "searchParam": lambda: node.search_param("rate"),
            "deleteParam": lambda: node.delete_param("rate"),
            "lookupService": lambda: node.call("flip", "std_srvs/Empty"),
            "lookupNode": lambda: node.peer("/other"),
            "getSystemState": node.graph.snapshot,
        }
        for method, use in uses.items():
            with pytest.raises(aioros1.MasterError) as caught:
                await use()
            assert str(caught.value).startswith(f"{method} at {uri}: ")
            assert str(caught.value).count(uri) == 1
            assert why in str(caught.value)
            assert not isinstance(caught.value, aioros1.MasterUnreachable)


async def test_a_web_server_is_no_master_while_an_error_is_handled():
    """What the application is busy with says nothing about an answer."""
    async with (
        web_server(200, NO_TRIPLE, "text/xml") as uri,
        aioros1.Node("demo", master_uri=uri, host="localhost", heartbeat=None) as node,
    ):
        try:
            raise KeyError("of the application")
        except KeyError:
            with pytest.raises(aioros1.MasterError) as caught:
                await node.master.ping()
        assert node.master.last_seen is None
        assert not caught.value.is_answer


@pytest.mark.parametrize("host", ["127.0.0.1", "no-such-host.invalid"])
async def test_a_master_that_is_not_there(host):
    uri = f"http://{host}:9"
    async with aioros1.Node("demo", master_uri=uri, host="localhost", heartbeat=None) as node:
        with pytest.raises(aioros1.MasterUnreachable, match="cannot connect") as caught:
            await node.advertise("chatter", "std_msgs/String")
        assert f"registerPublisher at {uri}" in str(caught.value)
        with pytest.raises(TimeoutError, match=r"within .* s: .*cannot connect") as late:
            await node.wait_for_master(timeout=0.2)
        assert f"no master at {uri}" in str(late.value)
