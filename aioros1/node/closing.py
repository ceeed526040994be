"""Closing everything that lives on a node."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

from aioros1.core.role import Role

if TYPE_CHECKING:
    from aioros1.core.context import Context, Member
    from aioros1.node.rosout import Rosout

__all__ = ["close_members"]

_LAST_TURNS = 10
"""Iterations of the event loop in which loops over roles, and their blocks, can finish."""


async def close_members(context: Context, rosout: Rosout | None, timeout: float) -> None:
    """Close everything that is open within ``timeout`` seconds: first composites, which use
    roles, then roles, and last ``/rosout``, which publishes what is logged meanwhile."""
    registrations = context.registrations
    try:
        async with asyncio.timeout(timeout):
            await _close(context, [each for each in context.members if not isinstance(each, Role)])
            roles: list[Member] = [
                each
                for each in context.members
                if isinstance(each, Role) and not (rosout is not None and rosout.uses(each))
            ]
            # Entries that are being opened, or not yet unregistered, have no open role.
            await asyncio.gather(
                _close_roles(context, roles, rosout), registrations.end(only_unfinished=True)
            )
            await registrations.end()
    except TimeoutError:
        context.log.warning("closed without having told everybody in %.3g s", timeout)


async def _close_roles(context: Context, roles: list[Member], rosout: Rosout | None) -> None:
    await _close(context, roles)
    if rosout is not None:
        # Code after a loop that has just ended may still log something.
        for _ in range(_LAST_TURNS):
            await asyncio.sleep(0)
        await rosout.finish()


async def _close(context: Context, members: list[Member]) -> None:
    results = await asyncio.gather(*(each.close() for each in members), return_exceptions=True)
    for member, result in zip(members, results, strict=True):
        if isinstance(result, Exception):
            context.report(result, f"closing {member}")
