"""Where the programs live: a scratch folder, a master, an environment free of other ROS."""

from __future__ import annotations

import contextlib
import os
import sys
import tempfile
import time
import xmlrpc.client
from collections.abc import Collection, Iterator
from functools import cached_property
from pathlib import Path

from common import ROOT
from common.contenders import PEERS, Contender, Find, Missing, Places
from common.processes import BenchmarkError, Cores, Program, free_port

__all__ = ["World", "open_world"]


class World:
    """One scratch folder and, from when it is first needed, one master of our own.

    Which master it is makes no difference to messages, once nodes have found each other.
    """

    def __init__(self, places: Places, stack: contextlib.ExitStack, quick: bool) -> None:
        self.places = places
        self.quick = quick
        self._stack = stack
        self._found: dict[Find, Contender | Missing] = {}
        self._runs = 0
        self._logs = 0

    def find(
        self, known: dict[str, Find], wanted: Collection[str]
    ) -> tuple[list[Contender], list[str]]:
        """Those of ``wanted`` that can run here, and what to say of the others."""
        found, missing = [], []
        for key in known:
            if key not in wanted:
                continue
            if known[key] not in self._found:
                try:
                    self._found[known[key]] = known[key](self.places)
                except Missing as error:
                    self._found[known[key]] = error
            result = self._found[known[key]]
            if isinstance(result, Missing):
                missing.append(f"without {key}: {result}")
            else:
                found.append(result)
        return found, missing

    @cached_property
    def core_pairs(self) -> dict[str, tuple[Cores, Cores]]:
        """The cores of the two sides, by the name of the case."""
        if not hasattr(os, "sched_setaffinity"):
            return {"not pinned": (None, None)}
        cores = sorted(os.sched_getaffinity(0))
        pairs: dict[str, tuple[Cores, Cores]] = {"same core": (cores[0], cores[0])}
        if len(cores) > 1:
            pairs["across cores"] = (cores[0], cores[1])
        return pairs

    @cached_property
    def master_uri(self) -> str:
        command = (sys.executable, str(PEERS / "aioros1_master.py"))
        # Without /rosout, which would go on looking for the nodes of earlier runs.
        uri, program = self.start_master(command, "rosout=0")
        program.outlasts()
        self._stack.enter_context(program)
        return uri

    def environment(self, master_uri: str | None = None) -> dict[str, str]:
        """Of one run: its namespace keeps it apart from whatever ran before."""
        self._runs += 1
        result = {name: value for name, value in os.environ.items() if not name.startswith("ROS_")}
        result.update(
            ROS_MASTER_URI=master_uri or self.master_uri,
            ROS_HOSTNAME="localhost",
            ROS_HOME=str(self.places.scratch),
            ROS_PACKAGE_PATH="/usr/share",
            ROS_ROOT="/usr/share/ros",
            ROS_DISTRO="noetic",
            ROS_NAMESPACE=f"/run{self._runs}",
            BENCHMARK_TCP_PORT=str(free_port()),
            PATH=f"/usr/bin{os.pathsep}{result.get('PATH', '')}",
            PYTHONPATH=os.pathsep.join(filter(None, [str(ROOT), result.get("PYTHONPATH")])),
            PYTHONWARNINGS="ignore",
        )
        return result

    def start(self, command: list[str], environment: dict[str, str], core: Cores = None) -> Program:
        self._logs += 1
        return Program(command, environment, self.places.scratch / f"{self._logs}.log", core)

    def start_master(self, command: tuple[str, ...], *words: str) -> tuple[str, Program]:
        """A master started with ``command PORT words``, when it answers."""
        port = free_port()
        uri = f"http://localhost:{port}"
        program = self.start([*command, str(port), *words], self.environment(uri))
        for _ in range(600):
            try:
                xmlrpc.client.ServerProxy(uri).getPid("/benchmark")
            except OSError:
                time.sleep(0.02)
            else:
                return uri, program
        program.end()
        raise BenchmarkError(f"{program.name} did not answer")


@contextlib.contextmanager
def open_world(
    quick: bool = False, node_modules: Path | None = None, cros: Path | None = None
) -> Iterator[World]:
    with contextlib.ExitStack() as stack:
        scratch = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        yield World(Places(scratch, node_modules, cros), stack, quick)
