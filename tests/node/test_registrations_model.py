"""Random faults between nodes and their master; in the calm after them, all is as it should be.

The long form is the scenario ``registrations`` of the soak.
"""

from __future__ import annotations

import random
import sys
from pathlib import Path

import pytest

sys.path.append(str(Path(__file__).parents[2]))

from soak.scenarios.registrations import play

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="it takes descriptors away")


@pytest.mark.parametrize("seed", range(3))
async def test_what_is_open_is_listed_and_nothing_else(
    seed: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("aioros1.node.roll_call._CONFIRM", 0.2)
    seen = await play(random.Random(seed), 8)
    assert not seen.problems
