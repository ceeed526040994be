"""Fixtures for tests on several hosts, which are network namespaces of this machine.

What is missing on the system skips a test, unless ``AIOROS1_REQUIRE_INTEROP=1`` says that
everything has to be there. ``AIOROS1_HOSTS_LOOP=uvloop`` runs the programs on uvloop.
"""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from .network import Network, network, sweep, why_not


@pytest.fixture(scope="session")
def _namespaces() -> str | None:
    reason = why_not()
    if reason is None:
        sweep()
    return reason


@pytest.fixture
def net(_namespaces: str | None) -> Iterator[Network]:
    """A network of this test alone."""
    if _namespaces is not None:
        pytest.skip(_namespaces)
    with network() as net:
        yield net


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    # It mostly sleeps. Begun last, it would be waited for.
    items.sort(key=lambda item: item.name != "test_half_a_minute")
