"""A network that loses packets."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from .network import Host, Network
from .remote import PATIENCE

QUIET = {"rosout": False, "logger_services": False}
MESSAGES = 10_000


def ten_thousand(net: Network, worsen: Callable[[Host], bool], reason: str) -> None:
    """Messages arrive in order, and services answer, when it is worse between two hosts."""
    one, two = net.host("one"), net.host("two")
    if not (worsen(one) and worsen(two)):
        pytest.skip(reason)
    a, b = one.start(), two.start()
    uri = a("master")
    a("start", "a", master_uri=uri, **QUIET)
    b("start", "b", master_uri=uri, **QUIET)
    a("advertise", "/chatter", overflow="block")
    b("subscribe", "/chatter", overflow="block")
    a("wait_for_subscribers", "/chatter")
    taking = b.send("take", "/chatter", MESSAGES)
    sending = a.send("send", "/chatter", MESSAGES, size=100)
    b("serve", "/flip", "this is b")
    for _ in range(10):
        assert a("call", "/flip") == "this is b"
    assert taking.get(3 * PATIENCE) == [str(number) for number in range(MESSAGES)]
    sending.get()
    assert a("dropped", "/chatter") == b("dropped", "/chatter") == 0


def test_loss_and_delay(net: Network):
    # Not needed in every run, hence no mark: a module of the kernel cannot be installed.
    ten_thousand(net, Host.disturb, "the kernel has no sch_netem, or there is no `tc`")


@pytest.mark.hosts
def test_loss(net: Network):
    ten_thousand(net, Host.lose, "there is no `nft`: apt-get install nftables")
