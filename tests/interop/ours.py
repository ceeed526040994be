"""Small things that many tests do with our roles."""

from __future__ import annotations

import asyncio
from typing import Any

from .processes import PATIENCE

__all__ = ["take", "take_until"]


async def take(role: Any, count: int, *, timeout: float = PATIENCE) -> list[Any]:
    """The next ``count`` items of a role."""
    async with asyncio.timeout(timeout):
        return [await anext(aiter(role)) for _ in range(count)]


async def take_until(role: Any, wanted: Any, *, timeout: float = PATIENCE) -> list[Any]:
    """The items of a role up to the first for which ``wanted(item)`` holds."""
    found: list[Any] = []
    async with asyncio.timeout(timeout):
        async for item in role:
            found.append(item)
            if wanted(item):
                break
    return found
