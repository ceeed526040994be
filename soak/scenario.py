"""What a scenario is: a fault, how often, what is promised meanwhile, and what was seen."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from dataclasses import dataclass, field

__all__ = ["Scenario", "Seen"]


@dataclass
class Seen:
    """What came of a run. ``problems`` is empty if everything promised was kept."""

    text: str
    """The figures, for the table."""

    problems: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class Scenario:
    """``await run(times)`` does something bad so many times, and checks what is promised."""

    name: str
    fault: str
    """What is done, as the table says it."""

    unit: str
    """What there are ``times`` of."""

    promised: str
    run: Callable[[int], Awaitable[Seen]]
    quick: int
    """As often as is enough for a test."""

    short: int
    """As often as takes a minute or two."""

    full: int
    """As often as the table asks for."""

    is_size: bool = False
    """Whether ``times`` is how much there is at once, and not how often something happens: the
    most memory that is needed is no leak."""
