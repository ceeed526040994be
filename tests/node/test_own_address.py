"""What a node tells others to connect to. tests/hosts has the same between real addresses."""

from __future__ import annotations

import asyncio
import logging
import socket

import pytest

import aioros1
from aioros1.node import own_address
from aioros1.node.own_address import OwnAddress

REMOTE = "http://192.0.2.1:11311"  # reserved for documentation: never this machine


@pytest.fixture
def routes(monkeypatch: pytest.MonkeyPatch) -> dict[str, str]:
    """The addresses of this machine that face others, as a test says."""
    routes: dict[str, str] = {}

    def facing(remote: str) -> str:
        if remote not in routes:
            raise OSError("no route")
        return routes[remote]

    monkeypatch.setattr(own_address, "local_address_facing", facing)
    monkeypatch.setattr(own_address, "is_local", lambda host: host in routes.values())
    return routes


@pytest.mark.parametrize(
    ("given", "bind", "master", "told", "listens"),
    [
        ("robot", None, REMOTE, "robot", "0.0.0.0"),
        ("robot", "10.0.0.3", REMOTE, "robot", "10.0.0.3"),
        (None, "10.0.0.3", REMOTE, "10.0.0.3", "10.0.0.3"),
        (None, "0.0.0.0", REMOTE, "10.0.0.2", "0.0.0.0"),
        (None, "::", REMOTE, "10.0.0.2", "::"),
        (None, None, REMOTE, "10.0.0.2", "0.0.0.0"),
        (None, None, "http://[2001:db8::1]:11311", "2001:db8::2", "::"),
        (None, None, "http://localhost:11311", "localhost", "127.0.0.1"),
        (None, None, "http://127.0.0.1:11311", "127.0.0.1", "127.0.0.1"),
        (None, None, "http://198.51.100.1:11311", "localhost", "0.0.0.0"),  # no route
        (None, None, "http://no such host:11311", "localhost", "0.0.0.0"),
    ],
)
async def test_what_is_told_and_where_it_listens(routes, given, bind, master, told, listens):
    routes.update({"192.0.2.1": "10.0.0.2", "2001:db8::1": "2001:db8::2"})
    address = OwnAddress(given, bind, master)
    assert await address.find() == (told, listens)


async def test_an_address_that_was_found_has_a_successor_once_it_is_lost(routes):
    routes["192.0.2.1"] = "10.0.0.2"
    address = OwnAddress(None, None, REMOTE)
    told, _ = await address.find()
    assert await address.successor(told) is None
    routes["192.0.2.1"] = "10.0.0.3"
    assert await address.successor(told) == "10.0.0.3"
    # As long as it is there, it need not be the one that faces the master.
    routes["198.51.100.1"] = "10.0.0.2"
    assert await address.successor(told) is None
    routes.clear()  # no network at all
    assert await address.successor(told) is None


@pytest.mark.parametrize(("given", "bind"), [("10.0.0.2", None), (None, "10.0.0.2")])
async def test_an_address_that_was_given_has_none(routes, given, bind):
    routes["192.0.2.1"] = "10.0.0.3"
    address = OwnAddress(given, bind, REMOTE)
    told, _ = await address.find()
    assert await address.successor(told) is None


async def test_no_network_at_the_start_is_made_good(routes):
    address = OwnAddress(None, None, REMOTE)
    told, _ = await address.find()
    assert told == "localhost"
    routes["192.0.2.1"] = "10.0.0.3"
    assert await address.successor(told) == "10.0.0.3"


@pytest.fixture
def names(monkeypatch: pytest.MonkeyPatch, routes: dict[str, str]) -> dict[str, list[str]]:
    """What the names of hosts mean, as a test says; others cannot be looked up."""
    routes["192.0.2.1"] = "10.0.0.2"
    names: dict[str, list[str]] = {}

    async def resolve(host: str) -> list[tuple[socket.AddressFamily, str]]:
        if host[0].isdigit() or ":" in host:
            return [(socket.AF_INET6 if ":" in host else socket.AF_INET, host)]
        if host not in names:
            raise socket.gaierror(socket.EAI_NONAME, "Name or service not known")
        return [(socket.AF_INET, address) for address in names[host]]

    monkeypatch.setattr(own_address, "resolve", resolve)
    return names


@pytest.mark.parametrize(
    ("means", "told", "listens"),
    [
        # As the installers of Debian and Ubuntu write it into /etc/hosts.
        (["127.0.1.1"], "robot", "0.0.0.0"),
        (["127.0.0.1", "::1"], "robot", "0.0.0.0"),
        # Whoever looks up the name here gets nothing but an address of IPv6.
        (["::1"], "robot", "::"),
        # The address that others can use, wherever it stands.
        (["127.0.1.1", "10.0.0.2"], "10.0.0.2", "0.0.0.0"),
        (["::1", "2001:db8::2"], "2001:db8::2", "::"),
        # There is no way to that one.
        (["127.0.1.1", "10.0.0.77"], "robot", "0.0.0.0"),
    ],
)
async def test_a_master_on_this_machine_called_by_its_name(names, routes, means, told, listens):
    routes |= {each: each for each in ("127.0.0.1", "127.0.1.1", "::1", "10.0.0.2", "2001:db8::2")}
    names["robot"] = means
    address = OwnAddress(None, None, "http://robot:11311")
    assert await address.find() == (told, listens)
    doubt = await address.doubt() if address.can_be_doubted else None
    if told != "robot":
        assert doubt is None
    elif len(means) == 1:
        assert doubt is not None
        assert doubt.startswith(
            f"master URI http://robot:11311: 'robot' is a loopback address here ({means[0]}), "
            "and others are told"
        )
    # The name stays right when what it means changes.
    names["robot"] = ["10.0.0.3"]
    assert await address.successor("robot") is None or told != "robot"


async def test_where_it_is_bound_does_not_change_what_a_name_means(names, routes):
    routes["127.0.1.1"] = "127.0.1.1"
    names["robot"] = ["127.0.1.1"]
    assert await OwnAddress(None, "0.0.0.0", "http://robot:1").find() == ("robot", "0.0.0.0")
    assert await OwnAddress(None, "10.0.0.2", "http://robot:1").find() == ("10.0.0.2", "10.0.0.2")


@pytest.mark.parametrize("given", ["localhost", "127.0.0.1", "::1", "10.0.0.2", "robot"])
async def test_an_address_of_this_machine_is_not_doubted(names, given):
    names["robot"] = ["10.9.9.9", "10.0.0.2"]
    assert await OwnAddress(given, None, REMOTE).doubt() is None


@pytest.mark.parametrize(
    ("given", "what"),
    [
        ("no-such-host", "'no-such-host' cannot be looked up here (Name or service not known)"),
        ("10.9.9.9", "'10.9.9.9' is no address of this machine"),
        ("0.0.0.0", "'0.0.0.0' stands for all addresses"),
        ("other", "'other' is 10.9.9.9, 10.9.9.8, which is no address of this machine"),
        ("robot", "'robot' is a loopback address here (127.0.1.1)"),
    ],
)
async def test_an_address_that_others_can_hardly_use(names, given, what):
    names |= {"other": ["10.9.9.9", "10.9.9.8"], "robot": ["127.0.1.1"]}
    address = OwnAddress(given, None, REMOTE, words=f"ROS_HOSTNAME={given}")
    doubt = await address.doubt()
    assert doubt is not None
    assert doubt.startswith(f"ROS_HOSTNAME={given}: {what}, and others are told")


async def test_an_address_that_was_found_is_not_doubted(names):
    address = OwnAddress(None, None, REMOTE)
    await address.find()
    names.clear()
    assert await address.doubt() is None


@pytest.mark.parametrize(
    ("options", "variables", "words"),
    [
        ({"host": "nowhere"}, {"ROS_IP": "10.9.9.9"}, "host='nowhere'"),
        ({"argv": ["__ip:=10.9.9.9", "__hostname:=nowhere"]}, {}, "__hostname:=nowhere"),
        ({"argv": ["__ip:=nowhere"]}, {"ROS_HOSTNAME": "else"}, "__ip:=nowhere"),
        ({}, {"ROS_HOSTNAME": "nowhere", "ROS_IP": "10.9.9.9"}, "ROS_HOSTNAME=nowhere"),
        ({}, {"ROS_IP": "nowhere"}, "ROS_IP=nowhere"),
    ],
)
async def test_a_node_starts_and_warns_with_the_words(
    names, monkeypatch, caplog, options, variables, words
):
    for variable in ("ROS_HOSTNAME", "ROS_IP"):
        monkeypatch.setenv(variable, variables.get(variable, ""))
    async with asyncio.timeout(30):
        async with aioros1.Node("demo", master_uri="http://localhost:9", **options) as node:
            assert node.uri.startswith("http://nowhere:")
            while not (found := [each for each in caplog.records if each.name == "ros.demo"]):
                await asyncio.sleep(0.001)
    (record,) = found
    assert record.levelno == logging.WARNING
    assert record.getMessage().startswith(f"{words}: 'nowhere' cannot be looked up here")


async def test_a_node_that_names_the_master_by_the_name_of_this_machine(monkeypatch, caplog):
    system = socket.getaddrinfo

    def getaddrinfo(host, *args, **keywords):
        return system("127.0.1.1" if host == "robot" else host, *args, **keywords)

    monkeypatch.setattr(socket, "getaddrinfo", getaddrinfo)
    async with (
        asyncio.timeout(30),
        aioros1.Master("127.0.0.1", port=0, bind="0.0.0.0") as master,
        aioros1.Node("demo", master_uri=f"http://robot:{master.port}", rosout=False) as node,
        aioros1.Node("other", master_uri=f"http://robot:{master.port}", rosout=False) as other,
        node.advertise("chatter", "std_msgs/String") as pub,
        other.subscribe("chatter", "std_msgs/String"),
    ):
        assert node.uri.startswith("http://robot:")
        assert node.tcpros_address[0] == "robot"
        await pub.wait_for_subscribers()
        while not (found := [each for each in caplog.records if each.name == "ros.demo"]):
            await asyncio.sleep(0.001)
    assert "'robot' is a loopback address here (127.0.1.1)" in found[0].getMessage()


async def test_a_slow_look_up_delays_neither_start_nor_end(names, monkeypatch):
    async def resolve(host: str) -> list[tuple[socket.AddressFamily, str]]:
        await asyncio.Event().wait()
        raise AssertionError

    monkeypatch.setattr(own_address, "resolve", resolve)
    async with asyncio.timeout(30):
        async with aioros1.Node("demo", master_uri="http://localhost:9", host="nowhere"):
            pass
