"""A graph in which things are cancelled, and what must be true of it afterwards."""

from __future__ import annotations

import asyncio
import collections
import contextlib
import gc
import itertools
import os
import sys
import time
from collections.abc import AsyncIterator, Callable
from typing import Any

import aioros1
from aioros1.msg.std_msgs import String
from aioros1.srv.std_srvs import SetBool

__all__ = ["World", "new_world"]

QUIET: dict[str, Any] = {"host": "localhost", "rosout": False, "logger_services": False}


class World:
    """A master, the node whose calls are cancelled, and another one."""

    def __init__(self, master: aioros1.Master) -> None:
        self.master = master
        self.numbers = itertools.count(1)
        self.failures: list[Any] = []
        """What the loop's exception handler was called with."""
        self._tasks: collections.Counter[str] = collections.Counter()
        self._files: list[str] = []

    def new_node(self, name: str, **options: Any) -> aioros1.Node:
        return aioros1.Node(name, master_uri=self.master.uri, **(QUIET | options))

    async def open(self, stack: contextlib.AsyncExitStack, **options: Any) -> None:
        enter = stack.enter_async_context
        self.node = await enter(self.new_node("node", **options))
        self.other = await enter(self.new_node("other", **options))
        self.pub = await enter(self.node.advertise("out", String))
        self.sub = await enter(self.node.subscribe("in", String, queue_size=1000))
        self.psub = await enter(self.node.subscribe_param("/followed", default=0))
        self.caller = await enter(self.node.service_caller("flip", SetBool, persistent=True))
        await enter(self.node.advertise_service("mine", SetBool, flip))
        await enter(self.other.advertise_service("flip", SetBool, flip))
        self.their_pub = await enter(self.other.advertise("in", String))
        self.their_sub = await enter(self.other.subscribe("out", String, queue_size=1000))
        await self.pub.wait_for_subscribers(timeout=30)
        await self.sub.wait_for_publishers(timeout=30)
        await self.probe()

    async def remember(self) -> None:
        """What is open now is all that may be open afterwards."""
        for _ in range(20):  # what was closed is gone after a few turns of the loop
            await self._calm()
            await asyncio.sleep(0.001)
        self._tasks, self._files = _tasks(), _files()

    async def check(self) -> None:
        """Nothing more than before, and at the master what the open roles say."""
        await self._calm()
        await self._until(lambda: not _tasks() - self._tasks, lambda: f"{_tasks() - self._tasks}")
        await self._until(
            lambda: len(_files()) <= len(self._files),
            lambda: f"files: {sorted(_files())}, before: {sorted(self._files)}",
        )
        await self._until(
            lambda: self.registered() == self.wanted(),
            lambda: f"the master has {self.registered()}, expected {self.wanted()}",
        )
        assert not self.failures, self.failures

    def registered(self) -> set[tuple[str, str, str]]:
        """All that the master has: (kind, name, node)."""
        registry = self.master._registry  # for the parameters, which no request lists
        parts = dict(
            zip(("publisher", "subscriber", "service"), registry.system_state()[2], strict=True)
        )
        found = {
            (kind, name, node)
            for kind, part in parts.items()
            for name, nodes in part
            for node in nodes
        }
        for key, nodes in registry.param_subscribers.items():
            found |= {("parameter subscriber", key.rstrip("/"), node) for node in nodes}
        return found

    def wanted(self) -> set[tuple[str, str, str]]:
        return {
            (role.kind, role.name, node.name)
            for node in (self.node, self.other)
            for role in node.roles
            if role.kind != "service caller"
        }

    async def probe(self) -> None:
        """Everything can be used as ever."""
        number = next(self.numbers)
        name = f"probe{number}"
        self.pub.publish(data=name)
        while (await self.their_sub.get(timeout=30)).data != name:
            pass
        self.their_pub.publish(data=name)
        while (await self.sub.get(timeout=30)).data != name:
            pass
        for data in (True, False):
            assert (await self.caller.call(data=data, timeout=30)).success is data
            assert (await self.other.call("mine", SetBool, data=data, timeout=30)).success is data
            assert (await self.node.call("flip", SetBool, data=data, timeout=30)).success is data
        await self.other.set_param("/followed", number)
        assert await self.psub.wait_for(lambda value: value == number, timeout=30) == number
        await self.node.set_param("/followed", -number)
        assert self.psub.value == -number == await self.other.get_param("/followed")
        async with (
            self.node.advertise("probe", String, latch=True) as pub,
            self.node.subscribe("probe", String) as sub,
            self.node.advertise_service("probe", SetBool, flip),
        ):
            pub.publish(data=name)
            assert (await sub.get(timeout=30)).data == name
            assert (await self.other.call("probe", SetBool, data=True, timeout=30)).success

    async def _calm(self) -> None:
        self.drop_idle_connections()

    async def _until(self, holds: Callable[[], bool], what: Callable[[], str]) -> None:
        end = time.monotonic() + 5
        while not holds():
            if time.monotonic() > end:
                raise AssertionError(what())
            await self._calm()
            await asyncio.sleep(0.0005)

    # All that reaches into the library: what can be neither seen nor, at a chosen turn of the
    # event loop, made to happen from outside.

    def drop_idle_connections(self) -> None:
        """Close what is only kept in case it is needed again."""
        if hasattr(self, "caller") and self.caller._kept and not self.caller._mutex.is_held:
            self.caller._drop(self.caller._kept)
        nodes = [self.node, self.other] if hasattr(self, "node") else []
        for client in (*(node._context.xmlrpc for node in nodes), self.master._client):
            for pool in client._http._pools.values():
                pool.close_idle(float("inf"))

    async def no_updates_left(self) -> None:
        """Take the updates of the followed parameter that nobody has taken."""
        while self.psub._updates:
            await anext(self.psub)

    def tell_of_param(self, value: Any) -> None:
        """Another node sets the followed parameter."""
        self.other.create_task(self.other.set_param("/followed", value))

    def tell_of_event(self, event: Any) -> None:
        """Something has happened that ``node.events()`` tells of."""
        self.node._context.emit(event)

    def lengthen_turn(self) -> None:
        """This turn of the loop has lasted so long that publishing must wait for the next."""
        self.pub._publication.coalescer.sent_much()


def flip(request: Any) -> dict[str, Any]:
    return {"success": request.data, "message": str(request.data)}


def _tasks() -> collections.Counter[str]:
    current = asyncio.current_task()
    return collections.Counter(
        # Without what tells one connection from the next.
        task.get_name().split(" 127.0.0.1")[0]
        if not task.get_name().startswith("Task-")
        else task.get_coro().__qualname__
        for task in asyncio.all_tasks()
        if task is not current
    )


def _files() -> list[str]:
    if not sys.platform.startswith("linux"):
        return []
    names = []
    for number in os.listdir("/proc/self/fd"):
        with contextlib.suppress(OSError):
            names.append(os.readlink(f"/proc/self/fd/{number}"))
    return names


@contextlib.asynccontextmanager
async def new_world(**options: Any) -> AsyncIterator[World]:
    loop = asyncio.get_running_loop()
    async with aioros1.Master(host="localhost", port=0, rosout=False) as master:
        world = World(master)
        loop.set_exception_handler(lambda _, context: world.failures.append(context))
        async with contextlib.AsyncExitStack() as stack:
            await world.open(stack, **options)
            yield world
            await world.probe()
        assert world.registered() == set()
        gc.collect()  # what was forgotten complains when it is collected
        await asyncio.sleep(0)
        assert not world.failures, world.failures
