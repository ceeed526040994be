"""What a node tells others to connect to. tests/hosts has the same between real addresses."""

from __future__ import annotations

import pytest

from aioros1 import own_address
from aioros1.own_address import OwnAddress

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
    assert await address.find() == listens
    assert address.host == told


async def test_an_address_that_was_found_has_a_successor_once_it_is_lost(routes):
    routes["192.0.2.1"] = "10.0.0.2"
    address = OwnAddress(None, None, REMOTE)
    await address.find()
    assert await address.successor() is None
    routes["192.0.2.1"] = "10.0.0.3"
    assert await address.successor() == "10.0.0.3"
    # As long as it is there, it need not be the one that faces the master.
    routes["198.51.100.1"] = "10.0.0.2"
    assert await address.successor() is None
    routes.clear()  # no network at all
    assert await address.successor() is None


@pytest.mark.parametrize(("given", "bind"), [("10.0.0.2", None), (None, "10.0.0.2")])
async def test_an_address_that_was_given_has_none(routes, given, bind):
    routes["192.0.2.1"] = "10.0.0.3"
    address = OwnAddress(given, bind, REMOTE)
    await address.find()
    assert await address.successor() is None


async def test_no_network_at_the_start_is_made_good(routes):
    address = OwnAddress(None, None, REMOTE)
    await address.find()
    assert address.host == "localhost"
    routes["192.0.2.1"] = "10.0.0.3"
    assert await address.successor() == "10.0.0.3"
