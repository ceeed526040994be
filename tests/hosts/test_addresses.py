"""What nodes on several hosts tell each other to connect to, and where they listen."""

from __future__ import annotations

import pytest

from .network import Host, Network
from .remote import Program, RemoteError

pytestmark = pytest.mark.hosts

QUIET = {"rosout": False, "logger_services": False}


def start(place: Host | Program, master: str, name: str = "", **options: object) -> Program:
    """A program with a node that is named after its host."""
    program = place.start() if isinstance(place, Host) else place
    program("start", name or place.name, master_uri=master, **QUIET, **options)
    return program


def topic_flows(publisher: Program, subscriber: Program, topic: str = "/chatter") -> None:
    publisher("advertise", topic)
    subscriber("subscribe", topic)
    publisher("wait_for_subscribers", topic)
    publisher("publish", topic, "hello")
    assert subscriber("take", topic) == ["hello"]


def test_everything_works_across_three_hosts_without_any_environment(net: Network):
    one, two, three = (net.host(name) for name in ("one", "two", "three"))
    a = one.start()
    uri = a("master")
    assert uri == f"http://{one.address}:11311/"
    b, c = start(two, uri), start(three, uri)
    told = a("start", "one", master_uri=uri, **QUIET)
    assert told["host"] == one.address
    assert told["uri"].startswith(f"http://{one.address}:")
    assert b("addresses")["host"] == two.address
    # Topics, from and to the host of the master, and between the others.
    topic_flows(a, b, "/from_one")
    topic_flows(b, a, "/to_one")
    topic_flows(b, c, "/past_one")
    (connection,) = c("connections", "/past_one")
    assert connection["remote"][0] == two.address
    # Services.
    b("serve", "/flip", "this is two")
    a("wait_for_service", "/flip")
    assert a("call", "/flip", timeout=10) == "this is two"
    assert c("call", "/flip", timeout=10) == "this is two"
    # Parameters, followed ones too.
    b("set_param", "/gain", 1)
    assert c("get_param", "/gain") == 1
    assert c("follow_param", "/gain") == 1
    b("set_param", "/gain", 2)
    c("wait_for_param", "/gain", 2)
    # A node that ends is gone for all.
    b("close")
    assert a("who", "publishers", "/past_one") == []
    assert b("left") == {"tasks": 0, "sockets": 0}


def test_a_master_on_loopback_of_the_same_host(net: Network):
    one, two = net.host("one"), net.host("two")
    boss = one.start()
    port = int(boss("master", host="0.0.0.0").rsplit(":")[-1].strip("/"))
    local = f"http://127.0.0.1:{port}"
    # Nodes that name the master by loopback tell loopback, and reach each other.
    a, b = start(boss, local, "a"), start(one, local, "b")
    assert a("addresses")["host"] == "127.0.0.1"
    topic_flows(a, b)
    # Others reach them only if they say how: by ROS_IP.
    c, d = one.start(ROS_IP=one.address), start(two, f"http://{one.address}:{port}")
    c("start", "c", master_uri=local, **QUIET)
    assert d("addresses")["host"] == two.address
    topic_flows(c, d, "/told")
    topic_flows(d, c, "/told_back")
    with pytest.raises(RemoteError, match="ConnectionRefusedError"):
        d("reach", one.address, a("addresses")["tcpros"][1])


def test_with_two_interfaces_the_one_that_faces_the_master_is_told(net: Network):
    middle, left, right = net.host("middle", 1, 2), net.host("left", 1), net.host("right", 2)
    a_boss, b_boss = left.start(), right.start()
    here, there = a_boss("master"), b_boss("master", host=right.address_on(2))
    # The same host, seen from both sides.
    a, b = start(middle, here), start(middle, there)
    assert a("addresses")["host"] == middle.address_on(1)
    assert b("addresses")["host"] == middle.address_on(2)
    topic_flows(a, start(a_boss, here))
    topic_flows(b, start(b_boss, there))


def test_ros_ip_and_host_say_what_is_told(net: Network):
    one, two = net.host("one", 1, 2), net.host("two", 1, 2)
    a, b = two.start(ROS_IP=two.address_on(2)), one.start(ROS_IP="10.0.0.99")
    uri = b("master", host=one.address)
    assert a("start", "a", master_uri=uri, **QUIET)["host"] == two.address_on(2)
    # An argument counts more than the environment.
    told = b("start", "b", master_uri=uri, host=one.address_on(2), **QUIET)
    assert told["host"] == one.address_on(2)
    topic_flows(a, b)
    (connection,) = b("connections", "/chatter")
    assert connection["remote"][0] == two.address_on(2)


def test_ros_hostname_is_a_name_that_others_look_up(net: Network):
    one, two = net.host("one"), net.host("two")
    # Only here, and nowhere else, are these names known.
    names = {"boss": one.address, "robot": two.address, "localhost": "127.0.0.1"}
    one.know(names)
    two.know(names)
    a, boss = two.start(ROS_HOSTNAME="robot"), one.start(ROS_HOSTNAME="boss")
    assert boss("master") == "http://boss:11311/"
    b = start(one, "http://boss:11311", "b")
    told = a("start", "a", master_uri="http://boss:11311", **QUIET)
    assert told["uri"].startswith("http://robot:")
    assert b("addresses")["host"] == one.address
    topic_flows(a, b)
    a("serve", "/flip", "robot here")
    assert b("call", "/flip", timeout=10) == "robot here"
    # Who does not know the name hears nothing, and says why.
    three = net.host("three")
    three.know({})
    stranger = start(three, f"http://{one.address}:11311")
    stranger("subscribe", "/chatter")
    with pytest.raises(RemoteError, match=r"cannot connect to robot:\d+: "):
        stranger("call", "/flip", timeout=10)


def test_ipv6(net: Network):
    one, two = net.host("one"), net.host("two")
    if "fd77" not in one.ip("-6", "address"):
        pytest.skip("this kernel has no IPv6")
    boss = one.start()
    uri = boss("master", host=one.ipv6)
    assert uri == f"http://[{one.ipv6}]:11311/"
    # The address that faces the master is one of IPv6, and so is the way of the topic.
    a, b = start(two, uri), start(boss, uri)
    assert a("addresses")["host"] == two.ipv6
    topic_flows(a, b)
    (connection,) = b("connections", "/chatter")
    assert connection["remote"][0] == two.ipv6
    # Such a node listens on IPv4 as well; and ROS_IP may be of either kind.
    b("reach", two.address, a("addresses")["tcpros"][1])
    c = two.start(ROS_IP=two.ipv6)
    told = c("start", "c", master_uri=f"http://[{one.ipv6}]:11311", **QUIET)
    assert told["host"] == two.ipv6
    c("serve", "/flip", "this is six")
    assert b("call", "/flip", timeout=10) == "this is six"


def test_a_name_that_is_an_address_of_ipv6(net: Network):
    one, two = net.host("one"), net.host("two")
    if "fd77" not in one.ip("-6", "address"):
        pytest.skip("this kernel has no IPv6")
    names = {"boss": one.ipv6, "robot": two.ipv6}
    one.know(names)
    two.know(names)
    boss = one.start(ROS_HOSTNAME="boss", ROS_IPV6="on")
    robot = two.start(ROS_HOSTNAME="robot", ROS_IPV6="on")
    uri = boss("master")
    assert uri == "http://boss:11311/"
    assert robot("start", "robot", master_uri=uri, **QUIET)["host"] == "robot"
    boss("start", "boss", master_uri=uri, **QUIET)
    topic_flows(robot, boss)
    (connection,) = boss("connections", "/chatter")
    assert connection["remote"][0] == two.ipv6


def test_bound_to_one_interface_a_node_is_not_there_on_the_other(net: Network):
    one, two = net.host("one", 1, 2), net.host("two", 1, 2)
    b = one.start()
    uri = b("master")
    start(b, uri)
    # What it is bound to is what it tells, although another address faces the master.
    a = start(two, uri, bind=two.address_on(2))
    told = a("addresses")
    assert told["host"] == two.address_on(2)
    topic_flows(a, b)
    port, slave_port = told["tcpros"][1], int(told["uri"].rsplit(":")[-1].strip("/"))
    b("reach", two.address_on(2), port)
    for number in (port, slave_port):
        with pytest.raises(RemoteError, match="ConnectionRefusedError"):
            b("reach", two.address_on(1), number)
    # Not bound, it is there on all of them.
    everywhere = start(two, uri, "everywhere")("addresses")["tcpros"][1]
    b("reach", two.address_on(1), everywhere)
    b("reach", two.address_on(2), everywhere)


def test_a_master_on_a_network_without_a_gateway(net: Network):
    """As robots have it: there is nothing to tell, and others know where it is."""
    one, two = net.host("one"), net.host("two")
    one.ip("route", "del", "default")
    a = one.start()
    assert a("master") == "http://localhost:11311/"
    b = start(two, f"http://{one.address}:11311/")
    a("start", "one", master_uri=f"http://{one.address}:11311/", **QUIET)
    topic_flows(b, a)


def test_a_name_that_means_loopback_on_its_own_machine(net: Network):
    one, two = net.host("one"), net.host("two")
    # As the installers of Debian and Ubuntu write it; others know the address.
    one.know({"localhost": "127.0.0.1", "robot": "127.0.1.1"})
    two.know({"localhost": "127.0.0.1", "robot": one.address})
    boss = one.start()
    port = int(boss("master", host="0.0.0.0").rsplit(":")[-1].strip("/"))
    uri = f"http://robot:{port}"
    a, b, c = start(boss, uri, "a"), start(one, uri, "b"), start(two, uri, "c")
    assert a("addresses")["host"] == "robot"
    assert c("addresses")["host"] == two.address
    topic_flows(a, b, "/here")
    topic_flows(a, c, "/there")
    topic_flows(c, a, "/back")
    a("serve", "/flip", "robot here")
    assert c("call", "/flip", timeout=10) == "robot here"
