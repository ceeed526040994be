"""A master that goes and comes back, whichever it is."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any

import pytest

from .processes import end_all, until
from .rosmaster import RealMaster
from .world import World

STRING = "std_msgs/String"
SET_BOOL = "std_srvs/SetBool"


class OurMaster:
    """Our master behind the few methods that `RealMaster` has."""

    def __init__(self) -> None:
        import aioros1

        self._make = aioros1.Master
        self._port = 0
        self._master: Any = None
        self.uri = ""

    async def start(self) -> None:
        self._master = self._make(host="localhost", port=self._port)
        await self._master.__aenter__()
        self.uri = self._master.uri
        self._port = int(self.uri.rstrip("/").rpartition(":")[2])

    async def stop(self) -> None:
        if self._master is not None:
            await self._master.__aexit__(None, None, None)
            self._master = None


async def _blocking_or_not(step: Any) -> None:
    result = step()
    if asyncio.iscoroutine(result):
        await result


@pytest.mark.parametrize("kind", ["rosmaster", "aioros1"])
async def test_everything_is_registered_again(kind: str, tmp_path: Path) -> None:
    """A rospy program that starts under the new master finds our node."""
    import aioros1

    master = RealMaster(tmp_path) if kind == "rosmaster" else OurMaster()
    await _blocking_or_not(master.start)
    world = World(kind, master.uri, tmp_path)
    try:
        async with (
            world.node("faithful", heartbeat=0.3) as node,
            node.advertise("/chatter", STRING, latch=True) as pub,
            node.subscribe("/heard", STRING) as sub,
            node.advertise_service("/flip", SET_BOOL, lambda request: {"success": True}),
        ):
            pub.publish(data="for those to come")
            events: list[Any] = []

            async def watch() -> None:
                async for event in node.events():
                    events.append(type(event))  # noqa: PERF401 - looked at meanwhile

            watcher = asyncio.create_task(watch())
            await asyncio.sleep(0)
            await _blocking_or_not(master.stop)
            await until(lambda: aioros1.MasterLost in events, what="the loss to be noticed")
            await _blocking_or_not(master.start)
            await world.wait_who("publishers", "/chatter", {"/faithful"})
            await world.wait_who("subscribers", "/heard", {"/faithful"})
            await world.wait_who("services", "/flip", {"/faithful"})
            await until(lambda: aioros1.MasterRestarted in events, what="the return to be told")

            listener = world.rospy("listener", "/chatter", STRING)
            assert await listener.wait_values("message") == [{"data": "for those to come"}]
            await world.rospy_ready("talker", "/heard", STRING, world.fields(data="x"))
            assert (await sub.get(timeout=15)).data == "x"
            client = world.rospy("client", "/flip", SET_BOOL, '{"data": true}')
            assert (await client.wait_values("answer"))[0]["success"] is True
        await watcher
        assert await world.traces("/faithful") == []
    finally:
        await end_all(world.processes)
        await _blocking_or_not(master.stop)
