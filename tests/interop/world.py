"""Everything a test needs under one master, whoever wrote that master."""

from __future__ import annotations

import asyncio
import contextlib
import itertools
import json
import random
import socket
import xmlrpc.client
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import debian
from .processes import PATIENCE, Process, Result, until

if TYPE_CHECKING:
    import aioros1

__all__ = ["World", "free_port", "xmlrpc_call"]

PEERS = Path(__file__).parent / "peers"
ROSPY_MODULES = ("rospy", "std_msgs", "std_srvs", "sensor_msgs", "geometry_msgs", "nav_msgs")

_numbers = itertools.count(1)


def free_port() -> int:
    """A port nobody listens on, for a program that cannot be told to take any.

    Not one that the system hands out for port 0, which somebody else could be given
    before the program has started.
    """
    while True:
        port = random.randrange(10_000, 30_000)
        with socket.socket() as probe, contextlib.suppress(OSError):
            probe.bind(("127.0.0.1", port))
            return port


def xmlrpc_call(uri: str, method: str, *args: Any) -> Any:
    """One blocking XML-RPC request that owes nothing to the library under test."""
    with xmlrpc.client.ServerProxy(uri, allow_none=False) as proxy:
        return getattr(proxy, method)(*args)


class World:
    """One master, and the processes and nodes that a test has put under it.

    ``kind`` is ``"rosmaster"`` or ``"aioros1"``. Processes are ended by the fixture;
    nodes are the test's own to close.
    """

    def __init__(
        self, kind: str, uri: str, folder: Path, cpp_peer: Callable[[], Path] | None = None
    ) -> None:
        self.kind = kind
        self.uri = uri
        self.folder = folder
        self.env = debian.environment(uri, folder / "ros_home")
        self.processes: list[Process] = []
        self._cpp_peer = cpp_peer

    # Names

    def unique(self, stem: str) -> str:
        """An absolute name that no other test of this run uses."""
        return f"/{stem}_{next(_numbers)}"

    # Processes

    def start(self, program: str, *args: str, env: dict[str, str] | None = None) -> Process:
        debian.require(program)
        process = Process(
            [program, *args],
            env={**self.env, **(env or {})},
            folder=self.folder,
            label=f"{next(_numbers):03}-{Path(program).name}",
        )
        self.processes.append(process)
        return process

    async def run(
        self,
        program: str,
        *args: str,
        timeout: float = PATIENCE,
        code: int | None = 0,
        env: dict[str, str] | None = None,
    ) -> Result:
        """Run a program to its end; its exit code must be ``code`` unless that is None."""
        process = self.start(program, *args, env=env)
        result = await process.wait(timeout=timeout)
        process.close()
        if code is not None:
            assert result.code == code, process.report()
        return result

    def rospy(self, script: str, *args: str) -> Process:
        """Start one of the rospy programs of the folder ``peers``."""
        debian.require_python(*ROSPY_MODULES)
        return self.start(debian.PYTHON, str(PEERS / f"{script}.py"), *args)

    async def rospy_ready(self, script: str, *args: str) -> Process:
        """As :meth:`rospy`, and wait until it has registered."""
        process = self.rospy(script, *args)
        await process.wait_values("ready")
        return process

    def roscpp(self, role: str, *args: str) -> Process:
        """Start the C++ program of the folder ``peers`` in one of its roles."""
        if self._cpp_peer is None:
            raise RuntimeError("this world has no compiler")
        return self.start(str(self._cpp_peer()), role, *args)

    async def roscpp_ready(self, role: str, *args: str) -> Process:
        process = self.roscpp(role, *args)
        await process.wait_values("ready")
        return process

    async def parse_yaml(self, text: str) -> Any:
        """What a tool wrote as YAML, read by Debian's Python."""
        process = self.start(debian.PYTHON, str(PEERS / "yaml_to_json.py"))
        process.tell(text)
        process.close()
        result = await process.wait()
        assert result.code == 0, process.report()
        return json.loads(result.stdout)

    # The master, asked by the standard library

    async def ask(self, method: str, *args: Any) -> Any:
        """The value of a successful request to the master."""
        code, status, value = await asyncio.to_thread(
            xmlrpc_call, self.uri, method, "/interop_test", *args
        )
        assert code == 1, status
        return value

    async def state(self) -> dict[str, dict[str, set[str]]]:
        """Who publishes, subscribes to and provides what."""
        value = await self.ask("getSystemState")
        names = ("publishers", "subscribers", "services")
        return {
            name: {topic: set(nodes) for topic, nodes in part}
            for name, part in zip(names, value, strict=True)
        }

    async def who(self, kind: str, name: str) -> set[str]:
        return (await self.state())[kind].get(name, set())

    async def wait_who(self, kind: str, name: str, expected: set[str]) -> None:
        """Wait until exactly ``expected`` nodes are registered so."""

        async def check() -> bool:
            return await self.who(kind, name) == expected

        await until(check, what=f"{kind} of {name} to be {expected}")

    async def traces(self, node: str) -> list[tuple[str, str]]:
        """Everything the master still has of a node."""
        state = await self.state()
        return [
            (kind, name)
            for kind, entries in state.items()
            for name, nodes in entries.items()
            if node in nodes
        ]

    async def wait_no_traces(self, node: str) -> None:
        async def check() -> bool:
            return not await self.traces(node)

        await until(check, what=f"the master to forget {node}")

    # Our side

    def node(self, name: str, **options: Any) -> aioros1.Node:
        import aioros1

        return aioros1.Node(name, master_uri=self.uri, host="localhost", **options)

    @staticmethod
    def fields(**values: Any) -> str:
        """Message fields as the rospy programs take them."""
        return json.dumps(values)
