"""Fixtures for the tests of definitions and codecs."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest

SYSTEM_PYTHON = "/usr/bin/python3"


@cache
def _has_module(name: str) -> bool:
    if not Path(SYSTEM_PYTHON).exists():
        return False
    command = [SYSTEM_PYTHON, "-c", f"import {name}"]
    return subprocess.run(command, capture_output=True, check=False).returncode == 0


@pytest.fixture
def system_python() -> Callable[..., str]:
    """Run a script with the system's Python, where Debian installs ROS 1; gives its output."""

    def run(script: str, text: str = "", *, needs: str = "genpy") -> str:
        if not _has_module(needs):
            pytest.skip(f"{SYSTEM_PYTHON} has no {needs}")
        done = subprocess.run(
            [SYSTEM_PYTHON, "-c", script], input=text, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stderr
        return done.stdout

    return run
