"""A program on some host that does what it is told, by lines of JSON.

A request is ``{"id": 1, "do": "publish", "args": [...], "options": {...}}``; the method of
that name of :class:`Program` is called, in a task of its own, and what it returns or raises
is the answer.
"""

from __future__ import annotations

import asyncio
import gc
import json
import logging
import os
import sys
from pathlib import Path
from typing import Any

import aioros1
from aioros1.srv.std_srvs import SetBool


def connection(info: aioros1.ConnectionInfo) -> dict[str, Any]:
    return {"name": info.name, "peer": info.peer, "local": info.local, "remote": info.remote}


class Program:
    """A master, a node, and its roles by their names."""

    def __init__(self) -> None:
        self._master: aioros1.Master | None = None
        self._node: aioros1.Node | None = None
        self._events: Any = None
        self._publishers: dict[str, Any] = {}
        self._subscribers: dict[str, Any] = {}
        self._callers: dict[str, Any] = {}
        self._params: dict[str, Any] = {}
        self._begin = self._held()

    @property
    def node(self) -> aioros1.Node:
        assert self._node is not None
        return self._node

    # a master and a node

    async def master(self, **options: Any) -> str:
        self._master = aioros1.Master(rosout=False, **options)
        await self._master.start()
        return self._master.uri

    async def end_master(self) -> None:
        assert self._master is not None
        await self._master.close()

    async def start(self, name: str, **options: Any) -> dict[str, Any]:
        """Start the node; ``timeouts`` is a dict of those."""
        timeouts = aioros1.Timeouts(**options.pop("timeouts", {}))
        self._node = aioros1.Node(name, timeouts=timeouts, **options)
        self._events = self._node.events()
        await self._node.start()
        return await self.addresses()

    async def addresses(self) -> dict[str, Any]:
        return {"host": self.node.host, "uri": self.node.uri, "tcpros": self.node.tcpros_address}

    async def close(self) -> None:
        await self.node.close()
        self._publishers.clear()
        self._subscribers.clear()
        self._callers.clear()
        self._params.clear()
        self._events = self._node = None

    async def wait_for_master(self) -> None:
        await self.node.wait_for_master()

    async def event(self, kind: str) -> dict[str, Any]:
        """The next event of that kind, of those that nobody has asked for."""
        async for event in self._events:
            if type(event).__name__ == kind:
                names = ("uri", "reason", "run_id", "kind", "name")
                return {name: getattr(event, name) for name in names if hasattr(event, name)}
        raise RuntimeError("the node is closed")

    # topics

    async def advertise(self, topic: str, type: str = "std_msgs/String", **options: Any) -> None:
        self._publishers[topic] = await self.node.advertise(topic, type, **options)

    async def subscribe(self, topic: str, type: str = "std_msgs/String", **options: Any) -> None:
        self._subscribers[topic] = await self.node.subscribe(topic, type, **options)

    async def publish(self, topic: str, data: str) -> None:
        self._publishers[topic].publish(data=data)

    async def send(
        self, topic: str, count: int, pause: float = 0.0, size: int = 0, first: int = 0
    ) -> None:
        """Send numbers, losing none; each padded to ``size`` characters."""
        for number in range(first, first + count):
            await self._publishers[topic].send(data=f"{number:<{size}}")
            if pause:
                await asyncio.sleep(pause)

    async def repeat(self, topic: str, data: str, pause: float) -> None:
        """Publish the same for ever."""
        async for _ in self.node.rate(1 / pause):
            self._publishers[topic].publish(data=data)

    async def take(self, topic: str, count: int = 1) -> list[str]:
        """The next messages, without their padding."""
        sub = self._subscribers[topic]
        return [(await sub.get()).data.rstrip() for _ in range(count)]

    async def take_until(self, topic: str, data: str) -> int:
        """How many messages come before this one."""
        count = 0
        while (await self._subscribers[topic].get()).data != data:
            count += 1
        return count

    async def dropped(self, topic: str) -> int:
        roles = (self._publishers.get(topic), self._subscribers.get(topic))
        return sum(role.dropped for role in roles if role is not None)

    async def wait_for_subscribers(self, topic: str, n: int = 1) -> None:
        await self._publishers[topic].wait_for_subscribers(n)

    async def wait_for_publishers(self, topic: str, n: int = 1) -> None:
        await self._subscribers[topic].wait_for_publishers(n)

    async def subscriber_count(self, topic: str) -> int:
        return int(self._publishers[topic].subscriber_count)

    async def connections(self, name: str) -> list[dict[str, Any]]:
        return [connection(info) for info in self.node.connections if info.name == name]

    async def wait_for_connection(self, name: str) -> None:
        while not await self.connections(name):
            await asyncio.sleep(0.01)

    # services

    async def serve(self, service: str, text: str) -> None:
        """Answer every call with this text."""
        await self.node.advertise_service(
            service, SetBool, lambda request: {"success": request.data, "message": text}
        )

    async def serve_never(self, service: str) -> None:
        """Take calls, and answer none."""
        await self.node.advertise_service(service, SetBool)

    async def call(
        self, service: str, timeout: float | None = None, persistent: bool = False
    ) -> str:
        caller = self._callers.get(service)
        if caller is None:
            caller = await self.node.service_caller(service, SetBool, persistent=persistent)
            self._callers[service] = caller
        return str((await caller.call(data=True, timeout=timeout)).message)

    async def wait_for_service(self, service: str) -> None:
        await self.node.wait_for_service(service)

    # parameters

    async def set_param(self, key: str, value: Any) -> None:
        await self.node.set_param(key, value)

    async def get_param(self, key: str) -> Any:
        return await self.node.get_param(key)

    async def follow_param(self, key: str) -> Any:
        param = self._params[key] = await self.node.subscribe_param(key, default=None)
        return param.value

    async def wait_for_param(self, key: str, value: Any) -> None:
        await self._params[key].wait_for(lambda current: current == value)

    # what can be seen

    async def who(self, kind: str, name: str) -> list[str]:
        """The nodes that are registered so: ``publishers``, ``subscribers``, ``services``."""
        state = await self.node.master.get_system_state()
        return list(getattr(state, kind).get(name, []))

    async def look_up(self, name: str) -> str:
        return await self.node.master.lookup_node(name)

    async def reach(self, host: str, port: int) -> None:
        """Connect, and say nothing."""
        async with asyncio.timeout(10):
            _, writer = await asyncio.open_connection(host, port)
        writer.close()
        await writer.wait_closed()

    async def left(self) -> dict[str, int]:
        """How many tasks and sockets there are more than at the beginning."""
        end = asyncio.get_running_loop().time() + 5
        while True:
            gc.collect()
            held = self._held()
            left = {key: held[key] - self._begin[key] for key in held}
            left["tasks"] -= 1  # this very request
            if not any(left.values()) or asyncio.get_running_loop().time() > end:
                return left
            await asyncio.sleep(0.02)

    def _held(self) -> dict[str, int]:
        sockets = 0
        for path in Path("/proc/self/fd").iterdir():
            try:
                sockets += os.readlink(path).startswith("socket:")
            except OSError:
                pass  # the directory itself
        return {"tasks": len(asyncio.all_tasks()), "sockets": sockets}


async def main() -> None:
    loop = asyncio.get_running_loop()
    program = Program()
    reader = asyncio.StreamReader()
    await loop.connect_read_pipe(lambda: asyncio.StreamReaderProtocol(reader), sys.stdin)

    async def obey(request: dict[str, Any]) -> None:
        answer: dict[str, Any] = {"id": request["id"]}
        try:
            method = getattr(program, request["do"])
            answer["value"] = await method(*request["args"], **request["options"])
        except Exception as error:
            answer |= {"error": type(error).__name__, "text": str(error)}
        print(json.dumps(answer), flush=True)

    async with asyncio.TaskGroup() as group:
        while line := await reader.readline():
            group.create_task(obey(json.loads(line)))
        os._exit(0)  # whoever has told it what to do is gone


if __name__ == "__main__":
    logging.basicConfig(format="%(relativeCreated)d %(name)s %(message)s")
    if os.environ.get("AIOROS1_HOSTS_LOOP") == "uvloop":
        import uvloop

        uvloop.run(main())
    else:
        asyncio.run(main())
