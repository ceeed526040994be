"""Which addresses may connect."""

from __future__ import annotations

from typing import Any

import pytest

from aioros1.net.allow import AllowList, parse_address


@pytest.mark.parametrize(
    ("networks", "inside", "outside"),
    [
        (["10.0.0.5"], ["10.0.0.5"], ["10.0.0.4", "10.0.0.6", "::a00:5"]),
        (["10.0.0.0/8"], ["10.0.0.0", "10.255.255.255"], ["9.255.255.255", "11.0.0.0"]),
        (["127.0.0.1/32"], ["127.0.0.1"], ["127.0.0.2", "::1"]),
        (["0.0.0.0/0"], ["0.0.0.0", "255.255.255.255"], ["::", "::1"]),
        (["fd00::/8"], ["fd00::", "fdff::1"], ["fc00::1", "fe00::", "10.0.0.5"]),
        (["::1"], ["::1"], ["::2", "127.0.0.1"]),
        (["::/0"], ["::", "fe80::1"], ["10.0.0.5"]),
        (["10.0.0.5", "fd00::/8"], ["10.0.0.5", "fd00::1"], ["10.0.0.6"]),
        ([], [], ["127.0.0.1", "::1"]),
    ],
)
def test_who_is_in_and_who_is_not(
    networks: list[str], inside: list[str], outside: list[str]
) -> None:
    allow = AllowList(networks)
    assert [text for text in inside if parse_address(text) not in allow] == []
    assert [text for text in outside if parse_address(text) in allow] == []


def test_without_a_list_everybody_is_in() -> None:
    allow = AllowList(None)
    assert allow.networks is None
    assert parse_address("203.0.113.1") in allow
    assert parse_address("2001:db8::1") in allow


def test_mapped_addresses_are_those_of_ipv4_on_both_sides() -> None:
    assert str(parse_address("::ffff:10.0.0.5")) == "10.0.0.5"
    assert parse_address("::ffff:10.0.0.5") in AllowList(["10.0.0.0/8"])
    assert parse_address("::ffff:10.0.0.5") not in AllowList(["::/0"])
    for text in ("::ffff:10.0.0.0/104", "::ffff:a00:0/104"):
        assert AllowList([text]).networks == ("10.0.0.0/8",)
    assert AllowList(["::ffff:10.0.0.5"]).networks == ("10.0.0.5/32",)


def test_the_interface_of_a_link_local_address_does_not_matter() -> None:
    assert parse_address("fe80::1%eth0") in AllowList(["fe80::/10"])


@pytest.mark.parametrize(
    "text",
    [
        "",
        "localhost",
        "robot.example",
        "10.0.0",
        "10.0.0.256",
        "10.0.0.0/33",
        "10.0.0.0/",
        "10.0.0.0/-8",
        "10.0.0.0/255.0.0.0",
        "10.0.0.0/0.255.255.255",
        "10.0.0.0/٨",
        " 10.0.0.5",
        "010.0.0.5",
        "fd00::/129",
        "fe80::1%eth0",
        "[::1]",
        "10.0.0.5:11311",
        "*",
        5,
        None,
        b"\x7f\x00\x00\x01",
    ],
)
def test_what_is_no_network(text: Any) -> None:
    with pytest.raises(ValueError, match=r"allow: expected an IPv4 or IPv6 address") as caught:
        AllowList(["10.0.0.0/8", text])
    assert str(caught.value).endswith(f"got {text!r}")


@pytest.mark.parametrize(
    ("text", "network", "host"),
    [
        ("10.0.0.5/8", "10.0.0.0/8", "10.0.0.5"),
        ("fd00::1/8", "fd00::/8", "fd00::1"),
        ("::ffff:10.0.0.5/104", "::ffff:10.0.0.0/104", "::ffff:10.0.0.5"),
    ],
)
def test_host_bits_are_refused_with_what_may_have_been_meant(
    text: str, network: str, host: str
) -> None:
    with pytest.raises(ValueError, match="has host bits") as caught:
        AllowList([text])
    assert repr(text) in str(caught.value)
    for meant in (network, host):
        assert AllowList([meant]).networks is not None
    quoted = str(caught.value).split("'")[3::2]
    assert [AllowList([each]).networks for each in quoted] == [
        AllowList([each]).networks for each in (network, host)
    ]


def test_a_string_is_not_a_list() -> None:
    with pytest.raises(ValueError, match=r"list of networks, got the string '10\.0\.0\.0/8'"):
        AllowList("10.0.0.0/8")
