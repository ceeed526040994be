"""Tools to test programs that use ROS 1: they cause on purpose what goes wrong in the field.

The fixtures for pytest are in :mod:`aioros1.testing.pytest_plugin`. Names are imported on
first use, because pytest loads that module wherever aioros1 is installed.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from aioros1.testing.flaky_connection import FlakyConnection
    from aioros1.testing.flaky_proxy import FlakyProxy
    from aioros1.testing.makers import MakeFlakyProxy, MakeNode
    from aioros1.testing.proxied_node import NodeProxies, proxies_before
    from aioros1.testing.simulated_clock import SimulatedClock

_HOMES = {
    "FlakyConnection": "flaky_connection",
    "FlakyProxy": "flaky_proxy",
    "MakeFlakyProxy": "makers",
    "MakeNode": "makers",
    "NodeProxies": "proxied_node",
    "SimulatedClock": "simulated_clock",
    "proxies_before": "proxied_node",
}

__all__ = [
    "FlakyConnection",
    "FlakyProxy",
    "MakeFlakyProxy",
    "MakeNode",
    "NodeProxies",
    "SimulatedClock",
    "proxies_before",
]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
