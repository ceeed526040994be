"""A host that gets another address while its node runs."""

from __future__ import annotations

import time

import pytest

from .network import Host, Network
from .remote import Program, RemoteError

pytestmark = pytest.mark.hosts

OPTIONS = {
    "rosout": False,
    "logger_services": False,
    "heartbeat": 0.2,
    "timeouts": {"connect": 1.0, "xmlrpc": 0.5, "close": 1.0, "keepalive": 1.0, "stall": 1.0},
}


def move(host: Host, old: str, new: str) -> None:
    host.take_address(old)
    host.give_address(new)
    host.default_route()


def flows(publisher: Program, subscriber: Program, topic: str, data: str) -> None:
    publisher("wait_for_subscribers", topic)
    subscriber("wait_for_publishers", topic)
    publisher("publish", topic, data)
    subscriber("take_until", topic, data)


def ends_up_with(program: Program, topic: str, expected: list[str]) -> None:
    """Wait until the connections of a topic are those from these addresses of its own."""
    end = time.monotonic() + 10
    while (local := [each["local"][0] for each in program("connections", topic)]) != expected:
        assert time.monotonic() < end, local
        time.sleep(0.01)


def test_a_node_tells_its_new_address(net: Network):
    one, two, three = (net.host(name) for name in ("one", "two", "three"))
    a, b, c = one.start(), two.start(), three.start()
    uri = a("master")
    a("start", "a", master_uri=uri, **OPTIONS)
    old, new = two.address, "10.77.1.99"
    told = b("start", "b", master_uri=uri, **OPTIONS)
    assert told["host"] == old
    for publisher, subscriber, topic in ((a, b, "/to_b"), (b, a, "/to_a")):
        publisher("advertise", topic)
        subscriber("subscribe", topic)
        flows(publisher, subscriber, topic, "before")
    b("serve", "/flip", "this is b")
    assert a("call", "/flip", persistent=True) == "this is b"
    b("follow_param", "/gain")
    # Whoever has the old address then, and even the port, must not be taken for the node.
    port = int(told["uri"].rsplit(":")[-1].strip("/"))
    c("start", "c", master_uri=uri, host=old, bind="0.0.0.0", xmlrpc_port=port, **OPTIONS)
    move(two, old, new)
    move(three, three.address, old)
    one.ip("neighbour", "flush", "all")
    assert b("event", "MasterLost")["uri"] == uri
    assert b("event", "MasterRestarted")["uri"] == uri
    told = b("addresses")
    assert told["host"] == new
    assert told["uri"] == f"http://{new}:{port}/"
    assert a("look_up", "/b") == told["uri"]
    flows(a, b, "/to_b", "after")
    flows(b, a, "/to_a", "after")
    # The connections of before end when nothing comes there any more.
    ends_up_with(a, "/to_a", [one.address])
    ends_up_with(b, "/to_b", [new])
    a("set_param", "/gain", 5)
    b("wait_for_param", "/gain", 5)
    assert a("who", "services", "/flip") == ["/b"]
    c("wait_for_master")
    assert c("addresses")["host"] == old
    b("close")
    assert b("left") == {"tasks": 0, "sockets": 0}
    assert a("who", "publishers", "/to_a") == a("who", "services", "/flip") == []


def test_calls_end_with_the_address_and_kept_connections_are_made_anew(net: Network):
    one, two = net.host("one"), net.host("two")
    a, b = one.start(), two.start()
    uri = a("master")
    a("start", "a", master_uri=uri, **OPTIONS)
    b("start", "b", master_uri=uri, **OPTIONS)
    a("serve", "/flip", "this is a")
    a("serve_never", "/never")
    assert b("call", "/flip", persistent=True) == "this is a"
    calling = b.send("call", "/never")
    b("wait_for_connection", "/never")
    move(two, two.address, "10.77.1.99")
    b("event", "MasterRestarted")
    with pytest.raises(RemoteError, match="ServiceUnavailable"):
        calling.get()
    assert b("call", "/flip", timeout=10) == "this is a"
    (connection,) = b("connections", "/flip")
    assert connection["local"][0] == "10.77.1.99"


def test_an_address_that_was_given_is_told_for_ever(net: Network):
    one, two = net.host("one"), net.host("two")
    a, b = one.start(), two.start(ROS_IP=two.address)
    uri = a("master")
    a("start", "a", master_uri=uri, **OPTIONS)
    told = b("start", "b", master_uri=uri, **OPTIONS)
    b("advertise", "/to_a")
    a("subscribe", "/to_a")
    flows(b, a, "/to_a", "before")
    move(two, two.address, "10.77.1.99")
    b("event", "MasterLost")
    b("event", "MasterRestarted")
    assert b("addresses") == told
    assert a("look_up", "/b") == told["uri"]
    # It is for whoever has said it to bring it back.
    move(two, "10.77.1.99", two.address)
    flows(b, a, "/to_a", "after")


def test_a_node_that_was_started_before_its_network(net: Network):
    one, two = net.host("one"), net.host("two")
    a, b = one.start(), two.start()
    uri = a("master")
    a("start", "a", master_uri=uri, **OPTIONS)
    two.take_address(two.address)
    assert b("start", "b", master_uri=uri, **OPTIONS)["host"] == "localhost"
    two.give_address(two.address)
    b("wait_for_master")
    b("advertise", "/to_a")
    a("subscribe", "/to_a")
    flows(b, a, "/to_a", "hello")
    assert b("addresses")["host"] == two.address
    assert a("look_up", "/b") == b("addresses")["uri"]
