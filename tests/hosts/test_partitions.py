"""A network that breaks in two, and is whole again."""

from __future__ import annotations

import time
from typing import Any

import pytest

from .network import Host, Network
from .remote import Program, RemoteError

pytestmark = pytest.mark.hosts

QUIET = {"rosout": False, "logger_services": False, "heartbeat": 0.2}
# What is short of these is no outage, and what is long is noticed soon.
SHORT = {"connect": 1.0, "xmlrpc": 0.5, "close": 1.0}


def start(program: Program, master: str, **timeouts: float) -> Program:
    """A program with a node that is named after its host."""
    program("start", program.name, master_uri=master, timeouts={**SHORT, **timeouts}, **QUIET)
    return program


def three(
    net: Network, *, eager: bool = True, **timeouts: float
) -> tuple[Host, Host, Host, Program, Program]:
    """The hosts of a master, a publisher and a subscriber; the programs of the last two.

    TCP doubles the time between two tries, and may sleep as long again as the network was
    away. ``eager`` kernels, if they can be told so, try once a second.
    """
    boss, one, two = hosts = [net.host(name) for name in ("boss", "one", "two")]
    if eager:
        for host in hosts:
            host.set("ipv4/tcp_rto_max_ms", 1000)
    master, pub, sub = (host.start() for host in hosts)
    uri = master("master")
    return boss, one, two, start(pub, uri, **timeouts), start(sub, uri, **timeouts)


def connect(publisher: Program, subscriber: Program, **options: Any) -> None:
    publisher("advertise", "/chatter", **options)
    subscriber("subscribe", "/chatter", **options)
    publisher("wait_for_subscribers", "/chatter")


def numbers(first: int, count: int) -> list[str]:
    return [str(number) for number in range(first, first + count)]


def assert_nothing_is_left(*programs: Program) -> None:
    for program in programs:
        program("close")
        assert program("left") == {"tasks": 0, "sockets": 0}


def test_half_a_minute(net: Network):
    """Longer than every timeout but those for what flows: nothing of that is lost."""
    _, one, _, pub, sub = three(net, stall=120)
    connect(pub, sub, overflow="block", queue_size=5)
    pub("serve", "/flip", "this is one")
    sub("serve", "/flop", "this is two")
    for program, service in ((sub, "/flip"), (pub, "/flop")):
        assert program("call", service, persistent=True)
    before = pub("connections", "/chatter"), sub("connections", "/chatter")
    pub("send", "/chatter", 10)
    assert sub("take", "/chatter", 10) == numbers(0, 10)
    one.cut()
    end = time.monotonic() + 30
    # More than the kernel has room for, so that the publisher has to wait.
    sending = pub.send("send", "/chatter", 400, size=50_000, first=10)
    taking = sub.send("take", "/chatter", 400)
    assert pub("event", "MasterLost")["uri"].startswith("http://10.77.1.2")
    for program, service in ((sub, "/flip"), (pub, "/flop")):
        with pytest.raises(RemoteError, match="TimeoutError"):
            program("call", service, timeout=0.5)
        with pytest.raises(RemoteError, match=r"TimeoutError|ServiceUnavailable|MasterUnreachable"):
            program("call", service, timeout=0.5)  # it has to connect again
    time.sleep(end - time.monotonic())
    one.mend()
    assert pub("event", "MasterRestarted")["uri"].startswith("http://10.77.1.2")
    assert taking.get(timeout=90) == numbers(10, 400)
    sending.get()
    assert (pub("connections", "/chatter"), sub("connections", "/chatter")) == before
    assert sub("call", "/flip", timeout=10) == "this is one"
    assert pub("call", "/flop", timeout=10) == "this is two"
    assert_nothing_is_left(pub, sub)


def test_a_pulled_cable(net: Network):
    boss, one, _, pub, sub = three(net)
    connect(pub, sub, overflow="block", queue_size=5)
    one.unplug()
    pub("event", "MasterLost")
    sending = pub.send("send", "/chatter", 100)
    one.plug()
    assert sub("take", "/chatter", 100) == numbers(0, 100)
    sending.get()
    pub("event", "MasterRestarted")
    # The master's own cable: topics go on flowing without it.
    boss.unplug()
    for program in (pub, sub):
        program("event", "MasterLost")
    pub("send", "/chatter", 10)
    assert sub("take", "/chatter", 10) == numbers(0, 10)
    boss.plug()
    pub("event", "MasterRestarted")
    sub("event", "MasterRestarted")
    assert pub("who", "subscribers", "/chatter") == ["/two"]
    assert_nothing_is_left(pub, sub)


def test_longer_than_a_stall(net: Network):
    """Who takes nothing for too long is cut off, and comes back when it can."""
    boss, _, two, pub, sub = three(net, stall=1.0, keepalive=4.0)
    other = start(net.host("three").start(), f"http://{boss.address}:11311")
    connect(pub, sub, queue_size=2, overflow="block")
    other("subscribe", "/chatter", queue_size=2, overflow="block")
    pub("wait_for_subscribers", "/chatter", 2)
    two.cut()
    # More than the kernel takes for the one; the other gets all of it.
    taking = other.send("take", "/chatter", 200)
    pub("send", "/chatter", 200, size=100_000)
    assert taking.get() == numbers(0, 200)
    gone = pub("event", "PeerDisconnected")
    assert gone["reason"] == "it took nothing for too long"
    assert pub("subscriber_count", "/chatter") == 1
    two.mend()
    pub("wait_for_subscribers", "/chatter", 2)
    repeating = pub.send("repeat", "/chatter", "back again", 0.05)
    assert sub("take_until", "/chatter", "back again") < 200
    other("close")
    assert_nothing_is_left(pub, sub)
    repeating.get()


def test_a_host_that_vanishes_and_its_node_that_comes_back_elsewhere(net: Network):
    """No FIN, no RST, nothing: only silence says that it is gone."""
    boss, _, two, pub, sub = three(net, eager=False, stall=1.0, keepalive=1.0)
    connect(pub, sub)
    pub("advertise", "/busy")
    sub("subscribe", "/busy")
    sub("advertise", "/back")
    pub("subscribe", "/back")
    pub("wait_for_publishers", "/back")
    sub("serve_never", "/never")
    pub("wait_for_subscribers", "/busy")
    pub.send("repeat", "/busy", "still there?", 0.05)
    sub("take", "/busy")
    before = pub("look_up", "/two")
    calling = pub.send("call", "/never")
    pub("wait_for_connection", "/never")
    two.vanish()
    events = disconnected(pub, 4)
    assert all(event["reason"] for event in events if event["kind"] != "service caller")
    lost = {(event["kind"], event["name"]) for event in events}
    assert lost == {
        ("publisher", "/chatter"),  # idle
        ("publisher", "/busy"),  # with something on its way
        ("subscriber", "/back"),
        ("service caller", "/never"),
    }
    with pytest.raises(RemoteError, match="ServiceUnavailable"):
        calling.get()
    assert pub("subscriber_count", "/busy") == 0
    # The other side has noticed as well.
    lost = {(event["kind"], event["name"]) for event in disconnected(sub, 3)}
    assert lost == {
        ("subscriber", "/chatter"),
        ("subscriber", "/busy"),
        ("publisher", "/back"),
    }
    # Nobody tells the master, which cannot know. The same node at another address does.
    assert pub("look_up", "/two") == before
    again = net.host("again").start()
    uri = again("start", "two", master_uri=f"http://{boss.address}:11311", **QUIET)["uri"]
    again("subscribe", "/busy")
    assert again("take", "/busy") == ["still there?"]
    assert pub("look_up", "/two") == uri != before
    assert pub("who", "subscribers", "/busy") == ["/two"]
    assert pub("who", "publishers", "/back") == []
    assert_nothing_is_left(pub, again, sub)


def disconnected(program: Program, count: int) -> list[dict[str, Any]]:
    return [program("event", "PeerDisconnected") for _ in range(count)]
