"""Who is let in to a port: the allow-list, the limits, and what is said of it."""

from __future__ import annotations

import logging
import os
import socket
import struct
from typing import Any

import pytest

from aioros1.net.admission import THIS_HOST, Admission
from aioros1.net.allow import AllowList
from aioros1.net.hosts import local_address

LOG = logging.getLogger("aioros1.test")


class Socket:
    """A socket with a family and, at its other end, a user."""

    def __init__(self, family: int, user: int = os.geteuid()) -> None:
        self.family = family
        self._user = user

    def getsockopt(self, *_: int) -> bytes:
        return struct.pack("3i", 1, self._user, 0)


def v4(host: str) -> tuple[Any, Any]:
    return Socket(socket.AF_INET), (host, 4242)


def v6(host: str) -> tuple[Any, Any]:
    return Socket(socket.AF_INET6), (host, 4242, 0, 0)


def door(allow: list[str] | None = None, *, total: int = 100, per_host: int = 100) -> Admission:
    return Admission(
        "the port",
        allow=AllowList(allow),
        total=("connections", total),
        per_host=per_host,
        log=LOG,
    )


async def test_hosts_are_told_apart_by_address() -> None:
    admission = door()
    assert admission.enter(*v4("10.0.0.5")) == "10.0.0.5"
    assert admission.enter(*v6("::ffff:10.0.0.5")) == "10.0.0.5"
    assert admission.enter(*v4("10.0.0.6")) == "10.0.0.6"
    assert admission.enter(*v6("2001:db8::1")) == "2001:db8::/64"
    assert admission.open == 4


@pytest.mark.parametrize(
    "addresses",
    [
        ["127.0.0.1", "127.0.0.2", "127.255.3.4", "::1", "::ffff:127.0.0.9"],
        ["2001:db8::1", "2001:db8::2", "2001:db8::ffff:ffff:ffff:ffff"],
        ["fe80::1%eth0", "fe80::1%eth1", "fe80::abcd"],
        ["10.0.0.5", "::ffff:10.0.0.5"],
    ],
    ids=["loopback", "an IPv6 subnet", "link-local", "mapped"],
)
async def test_one_machine_with_many_addresses_is_one_host(addresses: list[str]) -> None:
    admission = door(per_host=len(addresses))
    peers = [(v6 if ":" in address else v4)(address) for address in addresses]
    hosts = {admission.enter(*peer) for peer in peers}
    assert len(hosts) == 1
    assert [admission.enter(*peer) for peer in peers] == [None] * len(peers)
    assert admission.enter(*v4("10.9.9.9"))


async def test_the_addresses_of_this_machine_are_one_host() -> None:
    address = local_address()
    if address is None:
        pytest.skip("this machine has no address but loopback")
    admission = door(per_host=2)
    peer = (v6 if ":" in address else v4)(address)
    assert admission.enter(*v4("127.0.0.1")) == admission.enter(*peer)
    assert admission.enter(*peer) is admission.enter(*v4("127.0.0.1")) is None


async def test_only_what_is_allowed_is_let_in() -> None:
    admission = door(["10.0.0.0/8"])
    assert admission.enter(*v4("10.0.0.5"))
    assert admission.enter(*v6("::ffff:10.0.0.5"))
    assert admission.enter(*v4("127.0.0.1")) is None
    assert admission.enter(*v6("::1")) is None
    assert (admission.open, admission.forbidden, admission.refused) == (2, 2, 0)


@pytest.mark.parametrize(
    "peer",
    [(Socket(socket.AF_UNIX), ""), (Socket(socket.AF_UNIX, 0), ""), ()],
    ids=["unix", "root", "in process"],
)
async def test_peers_of_this_host_are_always_allowed_and_count_in_the_total(
    peer: tuple[Any, ...],
) -> None:
    admission = door([], total=2, per_host=1)
    assert [admission.enter(*peer) for _ in range(3)] == [THIS_HOST, THIS_HOST, None]
    assert (admission.forbidden, admission.refused) == (0, 1)
    admission.leave(THIS_HOST)
    assert admission.enter(*peer) == THIS_HOST


@pytest.mark.parametrize("allow", [None, [], ["127.0.0.0/8"]])
async def test_other_users_of_this_host_are_not_allowed(
    allow: list[str] | None, caplog: pytest.LogCaptureFixture
) -> None:
    admission, user = door(allow), os.geteuid() + 1
    peer: Any = Socket(socket.AF_UNIX, user)
    for _ in range(3):
        assert admission.enter(peer, "") is None
    assert (admission.open, admission.forbidden, admission.refused) == (0, 3, 0)
    assert caplog.messages == [
        (
            f"refused a connection from this host to the port: it belongs to user {user}, "
            f"and this process to {os.geteuid()}"
        )
    ]


@pytest.mark.parametrize("peername", [None, ("?", 4242)])
@pytest.mark.parametrize("allow", [None, ["10.0.0.0/8"]])
async def test_a_peer_that_has_gone_again_is_not_taken_for_one_of_this_host(
    peername: Any, allow: list[str] | None
) -> None:
    admission = door(allow)
    assert admission.enter(v4("")[0], peername) is None
    assert (admission.open, admission.forbidden, admission.refused) == (0, 0, 0)


async def test_the_limit_for_all() -> None:
    admission = door(total=2)
    assert admission.enter(*v4("10.0.0.1"))
    assert admission.enter(*v4("10.0.0.2"))
    assert admission.enter(*v4("10.0.0.3")) is None
    admission.leave("10.0.0.1")
    assert admission.enter(*v4("10.0.0.3"))
    assert (admission.open, admission.refused) == (2, 1)


async def test_the_limit_for_one_host_is_not_that_of_others() -> None:
    admission = door(per_host=2)
    assert [admission.enter(*v4("10.0.0.1")) for _ in range(3)] == ["10.0.0.1", "10.0.0.1", None]
    assert admission.enter(*v6("::ffff:10.0.0.1")) is None
    assert admission.enter(*v4("10.0.0.2"))
    admission.leave("10.0.0.1")
    assert admission.enter(*v4("10.0.0.1"))
    assert (admission.open, admission.refused) == (3, 2)


async def test_hosts_that_have_left_are_forgotten() -> None:
    admission = door()
    for number in range(200):
        host = admission.enter(*v4(f"10.0.0.{number}"))
        assert host is not None
        admission.leave(host)
    assert admission._hosts == {}


async def test_who_is_turned_away_is_named_once_with_the_reason(
    caplog: pytest.LogCaptureFixture,
) -> None:
    admission = door(["10.0.0.0/8"], total=3, per_host=2)
    for _ in range(3):
        admission.enter(*v4("127.0.0.1"))
    for host in ("10.0.0.1", "10.0.0.1", "10.0.0.1", "10.0.0.2", "10.0.0.3", "10.0.0.3"):
        admission.enter(*v4(host))
    assert [record.getMessage() for record in caplog.records] == [
        "refused a connection from 127.0.0.1 to the port: it is not in allow",
        (
            "refused a connection from 10.0.0.1 to the port: "
            "there are 2 from there already (limits.connections_per_host)"
        ),
        "refused a connection from 10.0.0.3 to the port: there are 3 already (limits.connections)",
    ]
    assert {record.levelname for record in caplog.records} == {"WARNING"}


async def test_a_flood_from_many_addresses_does_not_fill_the_log(
    caplog: pytest.LogCaptureFixture,
) -> None:
    admission = door([])
    for number in range(2000):
        admission.enter(*v4(f"10.0.{number // 200}.{number % 200}"))
    assert admission.forbidden == 2000
    assert len(caplog.records) == 256
