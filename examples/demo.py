"""A whole ROS graph in a few seconds, on a machine without ROS.

python examples/demo.py

It starts a master, a talker, a listener, a service and a follower of parameters, each in
a process of its own, shows what they say to one another, and ends all of them. The exit
code says whether everything came that should.
"""

import asyncio
import os
import sys
from contextlib import AsyncExitStack
from pathlib import Path

import aioros1

PATIENCE = 10.0
"""Seconds for anything that should happen."""

HERE = Path(__file__).resolve().parent


class DemoError(Exception):
    """Something did not come."""


def say(who: str, text: str) -> None:
    print(f"{who:>8} | {text}", flush=True)


class Child:
    """One process. What it prints is passed on with its name in front."""

    def __init__(self, name: str, *command: str, uri: str = "") -> None:
        self.name = name
        self.command = command
        self.uri = uri
        self.lines: list[str] = []
        self.has_ended = False
        self.news = asyncio.Condition()

    async def __aenter__(self) -> "Child":
        # Without what a ROS that is set up in this shell would change.
        environ = {key: value for key, value in os.environ.items() if not key.startswith("ROS_")}
        environ |= {"ROS_MASTER_URI": self.uri, "PYTHONUNBUFFERED": "1"}
        self.process = await asyncio.create_subprocess_exec(
            sys.executable,
            *self.command,
            env=environ,
            stdin=asyncio.subprocess.DEVNULL,
            stdout=asyncio.subprocess.PIPE,
            stderr=asyncio.subprocess.STDOUT,
        )
        self.relay = asyncio.create_task(self.pass_on())
        return self

    async def __aexit__(self, *exc_info: object) -> None:
        if self.process.returncode is None:  # something went wrong
            self.process.kill()
        await self.relay

    async def pass_on(self) -> None:
        assert self.process.stdout is not None
        async for line in self.process.stdout:
            self.lines.append(line.decode(errors="replace").rstrip())
            say(self.name, self.lines[-1])
            async with self.news:
                self.news.notify_all()
        await self.process.wait()
        self.has_ended = True
        async with self.news:
            self.news.notify_all()

    async def says(self, text: str, times: int = 1) -> str:
        """Wait for the line with ``text`` in it, or the ``times``-th one."""

        def found() -> list[str]:
            return [line for line in self.lines if text in line]

        try:
            async with asyncio.timeout(PATIENCE), self.news:
                await self.news.wait_for(lambda: len(found()) >= times or self.has_ended)
        except TimeoutError:
            raise DemoError(f"{self.name} did not print {text!r} in {PATIENCE:g} s") from None
        if len(found()) < times:
            raise DemoError(f"{self.name} ended before it printed {text!r}")
        return found()[times - 1]

    async def ends(self) -> None:
        """Wait for its end, which must be a clean one."""
        try:
            async with asyncio.timeout(PATIENCE):
                await asyncio.shield(self.relay)
        except TimeoutError:
            raise DemoError(f"{self.name} did not end in {PATIENCE:g} s") from None
        if self.process.returncode != 0:
            raise DemoError(f"{self.name} ended with exit code {self.process.returncode}")


async def demo() -> None:
    async with AsyncExitStack() as stack:

        async def start(name: str, script: str, *words: str, uri: str = "") -> Child:
            child = Child(name, str(HERE / script), *words, uri=uri)
            return await stack.enter_async_context(child)

        master = await start("master", "demo.py", "master")
        uri = (await master.says("ROS_MASTER_URI=")).partition("=")[2]

        nodes = {
            "/talker": await start("talker", "talker.py", "_rate:=5", uri=uri),
            "/listener": await start("listener", "listener.py", uri=uri),
            "/add_two_ints_server": await start("adder", "add_two_ints_server.py", uri=uri),
            "/parameters": await start("follower", "parameters.py", uri=uri),
        }
        client = await start("client", "add_two_ints_client.py", "3", "4", uri=uri)
        await client.says("3 + 4 = 7")
        await client.ends()
        await nodes["/listener"].says("/talker says: hello world", times=3)

        # This process is a node of the same graph, one that only asks.
        async with aioros1.Node(
            "demo", namespace="/", master_uri=uri, host="localhost",
            rosout=False, logger_services=False, heartbeat=None,
        ) as node:  # fmt: skip
            await nodes["/parameters"].says("following")
            await node.set_param("/parameters/gains/p", 2.5)
            await nodes["/parameters"].says("gains/p is now 2.5")

            graph = await node.graph.snapshot()
            say("demo", f"nodes of the graph: {', '.join(sorted(graph.nodes))}")

            # In ROS 1 any node can be asked to end, and so can the master.
            for name, child in nodes.items():
                await (await node.peer(name)).shutdown("the demo is over")
                await child.ends()
            await node.master.call("shutdown", "the demo is over")
            await master.ends()


async def run_master() -> None:
    async with aioros1.Master(host="localhost", port=0) as master:
        print(f"ROS_MASTER_URI={master.uri}")
        await master.wait_closed()


def main() -> int:
    try:
        if sys.argv[1:] == ["master"]:
            asyncio.run(run_master())
            return 0
        asyncio.run(demo())
    except KeyboardInterrupt:
        return 130
    except (DemoError, aioros1.RosError, TimeoutError) as error:
        print(f"demo: FAILED: {error}", file=sys.stderr)
        return 1
    say("demo", "everything came, and everything has ended")
    return 0


if __name__ == "__main__":
    sys.exit(main())
