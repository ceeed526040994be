"""How the rules tell of what breaks them: all of it at once."""

from __future__ import annotations

from collections.abc import Iterable

import pytest

__all__ = ["report"]


def report(what: str, found: Iterable[str]) -> None:
    """Fail with all that was found, one a line, if there is any."""
    lines = sorted(found)
    if lines:
        pytest.fail("\n".join([f"{len(lines)} {what}:", *lines]), pytrace=False)
