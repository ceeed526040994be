"""Random changes of a small tree of parameters, and whether its followers end right."""

from __future__ import annotations

import asyncio
import contextlib
import random
from collections.abc import Awaitable, Mapping
from typing import Any, Protocol

import aioros1

__all__ = ["FOLLOWED", "Setter", "make_changes", "wait_until_right"]

FOLLOWED = ("", "/a", "/a/b", "/a/b/c", "/x")
"""What is followed below the root of the tree: keys above, below and beside one another."""

_KEYS = ("", "/a", "/a/b", "/a/b/c", "/a/b/d", "/a/e", "/x", "/x/y")


class Setter(Protocol):
    """Who changes parameters: a node of any library."""

    def set_param(self, key: str, value: Any, /) -> Awaitable[object]: ...

    def delete_param(self, key: str, /) -> Awaitable[object]: ...


def _value(chance: random.Random, depth: int = 0) -> Any:
    """A plain value, or a table of some."""
    if depth > 2 or chance.random() < 0.5:
        return chance.randrange(1000)
    names = chance.sample(["a", "b", "c", "d", "e", "x", "y"], chance.randrange(4))
    return {name: _value(chance, depth + 1) for name in names}


async def make_changes(
    setter: Setter, root: str, chance: random.Random, times: int, *, at_once: int = 1
) -> None:
    """Change parameters below ``root`` so many times, ``at_once`` of them side by side."""

    async def change() -> None:
        key = root + chance.choice(_KEYS)
        # The master may be gone; then nobody knows whether it was changed.
        with contextlib.suppress(aioros1.MasterUnreachable):
            if chance.random() < 0.35:
                with contextlib.suppress(KeyError):
                    await setter.delete_param(key)
            if chance.random() < 0.75:
                await setter.set_param(key, _value(chance))

    for _ in range(times):
        await asyncio.gather(*(change() for _ in range(at_once)))
        if chance.random() < 0.3:
            await asyncio.sleep(chance.random() * 0.05)


async def wait_until_right(
    reader: aioros1.Node,
    followers: Mapping[str, list[aioros1.ParamSubscriber]],
    *,
    timeout: float = 30,
) -> list[str]:
    """Wait until every follower has what the master has, also when notices that are late have
    come; return what is wrong after that."""
    wrong: list[str] = []
    looks = 0
    with contextlib.suppress(TimeoutError):
        async with asyncio.timeout(timeout):
            while True:
                wrong = []
                for key, subscribers in followers.items():
                    right = await reader.get_param(key, {})
                    wrong += [
                        f"{each.node.name} has {key} = {each.value}, the master {right}"
                        for each in subscribers
                        if each.value != right
                    ]
                looks = 0 if wrong else looks + 1
                if looks == 8:
                    break
                await asyncio.sleep(0.02)
    return wrong
