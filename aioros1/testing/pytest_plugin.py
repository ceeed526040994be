"""The fixtures of :mod:`aioros1.testing.fixtures` for pytest, and their options.

pytest loads this wherever aioros1 is installed, whether a test uses it or not. So this module
imports nothing else, and the fixtures import what they need when they are used.
"""

from __future__ import annotations

from importlib import import_module

import pytest


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addini(
        "aioros1_check_leaks",
        "whether every test fails that leaves tasks, files or threads behind (fixture no_leaks)",
        type="bool",
        default=False,
    )


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line(
        "markers",
        "no_leaks(check=True): fail if the test leaves tasks, files or threads behind, as with "
        "the fixture no_leaks; no_leaks(False): not, whatever the option aioros1_check_leaks says",
    )
    # Only now is it known whether pytest-asyncio is loaded.
    config.pluginmanager.register(import_module("aioros1.testing.fixtures"), "aioros1-fixtures")
