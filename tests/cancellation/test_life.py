"""Starting and ending of nodes and masters, cancelled at every place where they suspend."""

from __future__ import annotations

import asyncio
import contextlib
import gc

import pytest

import aioros1

from .harness import WAYS, attempts
from .world import QUIET, World, _files, _tasks


async def nothing_is_left(tasks, files, world):
    async with asyncio.timeout(30):
        while _tasks() - tasks or len(_files()) > len(files) or world.registered():
            world.drop_idle_connections()
            await asyncio.sleep(0.001)
    gc.collect()
    assert not world.failures, world.failures


def new(world, **options):
    world.thing = aioros1.Node(
        "node", master_uri=world.master.uri, **(QUIET | {"logger_services": True} | options)
    )
    return world.thing


async def entered(world):
    async with new(world):
        await asyncio.sleep(0)


async def started(world):
    await new(world).start()


async def started_local(world):
    await new(world, local_transports=("unix", "intraprocess")).start()


async def closed(world):
    node = new(world)
    await asyncio.shield(asyncio.ensure_future(node.start()))
    await node.close()


async def waited_closed(world):
    node = new(world)
    await asyncio.shield(asyncio.ensure_future(node.start()))
    closing = asyncio.ensure_future(node.close())
    await node.wait_closed()
    await closing


async def master_entered(world):
    async with aioros1.Master(host="localhost", port=0) as master:
        assert master.is_open


ACTS = (entered, started, started_local, closed, waited_closed, master_entered)
"""Not :func:`aioros1.run`, which ends all tasks of its event loop, those of this test too; see
``tests/test_script_end.py``."""


@pytest.mark.parametrize("act", ACTS, ids=[act.__name__ for act in ACTS])
async def test_it_can_be_cancelled_anywhere(act, master):
    world = World(master)
    asyncio.get_running_loop().set_exception_handler(lambda _, what: world.failures.append(what))
    async with new(world):  # uvloop opens a file when the first one ends
        pass
    world.thing = None
    while world.registered():
        await asyncio.sleep(0.001)
    world.drop_idle_connections()
    tasks, files = _tasks(), _files()
    for way in WAYS:
        async for attempt in attempts(way, act, world):
            try:
                node = getattr(world, "thing", None)
                if node is not None:
                    with contextlib.suppress(aioros1.ClosedError):
                        await node.close()
                await nothing_is_left(tasks, files, world)
            except BaseException as error:
                error.add_note(f"after it was cut: {attempt.cut}")
                raise
