"""Functions that are compiled when they are first called, if ever."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

__all__ = ["made_later"]


def made_later(make: Callable[[], Callable[..., Any]]) -> Callable[..., Any]:
    """A function that stands for what ``make`` returns, and calls ``make`` when called.

    Two threads that call it for the first time may both have it made; either is whole.
    """
    made: Callable[..., Any] | None = None

    def call(*arguments: Any) -> Any:
        nonlocal made
        function = made
        if function is None:
            made = function = make()
        return function(*arguments)

    return call
