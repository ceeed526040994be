"""A master that a test controls."""

from __future__ import annotations

import pytest

from .scripted_master import ScriptedMaster


@pytest.fixture
def script(monkeypatch: pytest.MonkeyPatch) -> ScriptedMaster:
    """Has to come before the fixtures that start the master."""
    return ScriptedMaster(monkeypatch)
