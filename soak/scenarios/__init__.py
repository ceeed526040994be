"""The scenarios, by name."""

from __future__ import annotations

from soak.scenario import Scenario
from soak.scenarios import (
    chaos,
    churn,
    cut_connections,
    lossless,
    many_nodes,
    master_restarts,
    parameters,
    registrations,
    stalled_peers,
    two_loops,
)

__all__ = ["SCENARIOS"]

MODULES = (
    master_restarts,
    chaos,
    registrations,
    cut_connections,
    lossless,
    many_nodes,
    stalled_peers,
    two_loops,
    parameters,
    churn,
)
SCENARIOS: dict[str, Scenario] = {module.SCENARIO.name: module.SCENARIO for module in MODULES}
