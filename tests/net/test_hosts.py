"""Which addresses are called, listened on and told to others."""

from __future__ import annotations

import socket
from typing import Any

import pytest

from aioros1.net.hosts import (
    advertised_host,
    bind_address_for,
    bind_sockets,
    is_local,
    is_loopback,
    is_wildcard,
    local_address,
    local_address_facing,
    resolve,
    uri_host,
)

V4, V6 = socket.AF_INET, socket.AF_INET6


@pytest.mark.parametrize(
    ("host", "expected"),
    [
        ("127.0.0.1", [(V4, "127.0.0.1")]),
        ("10.1.2.3", [(V4, "10.1.2.3")]),
        ("::1", [(V6, "::1")]),
        ("[::1]", [(V6, "::1")]),
        ("localhost", [(V4, "127.0.0.1"), (V6, "::1")]),
        ("LocalHost.", [(V4, "127.0.0.1"), (V6, "::1")]),
    ],
)
async def test_numbers_and_localhost_need_no_thread(
    host: str, expected: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    def getaddrinfo(*_: Any, **__: Any) -> Any:
        pytest.fail("asked the resolver")

    monkeypatch.setattr(socket, "getaddrinfo", getaddrinfo)
    assert await resolve(host) == expected


async def test_names_are_looked_up(monkeypatch: pytest.MonkeyPatch) -> None:
    def getaddrinfo(host: str, port: object, **_: Any) -> Any:
        assert host == "robot"
        rows: list[tuple[int, tuple[Any, ...]]] = [
            (V4, ("10.0.0.1", 0)),
            (V4, ("10.0.0.1", 0)),
            (V6, ("fd00::1", 0, 0, 0)),
            (V6, ("fe80::1", 0, 0, 3)),
            (socket.AF_UNIX, ("x",)),
        ]
        return [(family, socket.SOCK_STREAM, 6, "", address) for family, address in rows]

    monkeypatch.setattr(socket, "getaddrinfo", getaddrinfo)
    assert await resolve("robot") == [(V4, "10.0.0.1"), (V6, "fd00::1"), (V6, "fe80::1%3")]


@pytest.mark.parametrize("host", ["a" * 64 + ".example", "a." * 200, "a..b", "a\0b", "\udc80"])
async def test_what_is_no_name_is_an_os_error(host: str) -> None:
    with pytest.raises(OSError, match="not a host name"):
        await resolve(host)


def test_the_address_that_faces_another() -> None:
    assert local_address_facing("127.0.0.1") == "127.0.0.1"
    with pytest.raises(ValueError, match="numeric"):
        local_address_facing("localhost")
    found = local_address()
    assert found is None or not is_loopback(found)


def test_advertised_host_follows_the_environment() -> None:
    assert advertised_host({"ROS_HOSTNAME": "robot", "ROS_IP": "10.0.0.1"}) == "robot"
    assert advertised_host({"ROS_HOSTNAME": "", "ROS_IP": "10.0.0.1"}) == "10.0.0.1"


def test_advertised_host_is_the_one_address_that_is_listened_on() -> None:
    assert advertised_host({}, bound="10.0.0.2") == "10.0.0.2"
    assert advertised_host({"ROS_IP": "10.0.0.1"}, bound="10.0.0.2") == "10.0.0.1"


@pytest.mark.parametrize(
    ("host", "expected"),
    [
        ("0.0.0.0", True),
        ("::", True),
        ("[::]", True),
        ("127.0.0.1", False),
        ("localhost", False),
        ("", False),
    ],
)
def test_wildcards(host: str, expected: bool) -> None:
    assert is_wildcard(host) == expected


def test_advertised_host_without_a_network(monkeypatch: pytest.MonkeyPatch) -> None:
    def no_route(remote: str) -> str:
        raise OSError("Network is unreachable")

    monkeypatch.setattr("aioros1.net.hosts.local_address_facing", no_route)
    assert local_address() is None
    assert advertised_host({}) is None


@pytest.mark.parametrize(
    ("host", "expected"),
    [
        ("localhost", "127.0.0.1"),
        ("127.0.0.1", "127.0.0.1"),
        ("127.0.1.1", "127.0.1.1"),
        ("::1", "::1"),
        ("[::1]", "::1"),
        ("robot", "0.0.0.0"),
        ("10.0.0.1", "0.0.0.0"),
        ("fe80::1", "::"),
    ],
)
def test_where_to_listen(host: str, expected: str) -> None:
    assert bind_address_for(host) == expected


def test_where_to_listen_if_names_may_be_of_ipv6(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_IPV6", "on")
    listening = {host: bind_address_for(host) for host in ("robot", "10.0.0.1", "localhost")}
    assert listening == {"robot": "::", "10.0.0.1": "0.0.0.0", "localhost": "127.0.0.1"}


def test_which_addresses_are_ours() -> None:
    assert is_local("127.0.0.1")
    # The first is reserved for documentation, the last no address at all.
    assert not any(is_local(host) for host in ("192.0.2.1", "2001:db8::1", "localhost"))


def test_which_addresses_are_all() -> None:
    assert all(is_wildcard(host) for host in ("0.0.0.0", "::", "[::]"))
    assert not any(is_wildcard(host) for host in ("127.0.0.1", "::1", "localhost", "robot"))


def test_hosts_in_uris() -> None:
    assert [uri_host(host) for host in ("robot", "10.0.0.1", "::1", "[::1]")] == [
        "robot",
        "10.0.0.1",
        "[::1]",
        "[::1]",
    ]


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost"])
def test_listening(host: str) -> None:
    (sock,) = bind_sockets(host)
    with sock, socket.create_connection(sock.getsockname(), timeout=30):
        assert sock.getsockname()[0] == "127.0.0.1"


@pytest.mark.skipif(not socket.has_ipv6, reason="needs IPv6")
def test_listening_on_both_kinds() -> None:
    try:
        (sock,) = bind_sockets("::")
    except OSError:
        pytest.skip("needs IPv6")
    with sock, socket.create_connection(("127.0.0.1", sock.getsockname()[1]), timeout=30):
        pass


def test_a_port_that_is_taken() -> None:
    (sock,) = bind_sockets("127.0.0.1")
    port = sock.getsockname()[1]
    with sock, pytest.raises(OSError, match=rf"cannot listen on 127\.0\.0\.1:{port}: ") as caught:
        bind_sockets("127.0.0.1", port)
    assert caught.value.errno


@pytest.mark.parametrize(("host", "port"), [("robot", 0), ("127.0.0.1", 65536), ("127.0.0.1", -1)])
def test_what_cannot_be_listened_on(host: str, port: int) -> None:
    with pytest.raises(ValueError, match="expected"):
        bind_sockets(host, port)
