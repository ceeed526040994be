"""Other people's programs: started, watched and, whatever happens, ended.

A program writes to files and is polled, so a test that fails leaves behind neither
pipes nor transports, and the event loop under test has nothing to do with it.
"""

from __future__ import annotations

import asyncio
import contextlib
import inspect
import json
import os
import re
import signal
import subprocess
import time
from collections.abc import Awaitable, Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

__all__ = ["PATIENCE", "Process", "Result", "end_all", "until"]

PATIENCE = 40.0
"""Seconds to wait for something that normally takes a fraction of one."""

POLL = 0.02
GRACE = ((signal.SIGINT, 4.0), (signal.SIGTERM, 2.0), (signal.SIGKILL, 5.0))


async def until(
    check: Callable[[], Any | Awaitable[Any]],
    *,
    what: str | Callable[[], str] = "the condition",
    timeout: float = PATIENCE,
) -> Any:
    """Call ``check`` until what it returns is true, and return that."""
    end = time.monotonic() + timeout
    while True:
        value = check()
        if inspect.isawaitable(value):
            value = await value
        if value:
            return value
        if time.monotonic() > end:
            text = what if isinstance(what, str) else what()
            raise AssertionError(f"not within {timeout} s: {text}")
        await asyncio.sleep(POLL)


@dataclass(frozen=True)
class Result:
    """What a program that ran to its end left behind."""

    code: int
    stdout: str
    stderr: str

    @property
    def text(self) -> str:
        return self.stdout + self.stderr


class Process:
    """One running program, leader of a process group of its own."""

    def __init__(
        self, argv: Sequence[str], *, env: Mapping[str, str], folder: Path, label: str
    ) -> None:
        self.argv = list(argv)
        self.label = label
        self._out = folder / f"{label}.out"
        self._err = folder / f"{label}.err"
        with self._out.open("wb") as out, self._err.open("wb") as err:
            self._popen = subprocess.Popen(
                self.argv,
                env=dict(env),
                cwd=folder,
                stdin=subprocess.PIPE,
                stdout=out,
                stderr=err,
                start_new_session=True,
            )

    @property
    def pid(self) -> int:
        return self._popen.pid

    @property
    def code(self) -> int | None:
        """The exit code, ``None`` while the program runs."""
        return self._popen.poll()

    @property
    def is_alive(self) -> bool:
        """Whether it, or what it has started, still runs."""
        return self.code is None or _group_is_alive(self.pid)

    @property
    def stdout(self) -> str:
        return self._out.read_text(errors="replace")

    @property
    def stderr(self) -> str:
        return self._err.read_text(errors="replace")

    def report(self) -> str:
        return (
            f"{' '.join(self.argv)} (exit code {self.code})\n"
            f"--- stdout\n{self.stdout[-3000:]}\n--- stderr\n{self.stderr[-3000:]}"
        )

    # What it says

    @property
    def records(self) -> list[dict[str, Any]]:
        """The complete lines of standard output that are JSON objects."""
        complete = self.stdout.rpartition("\n")[0]
        return [json.loads(line) for line in complete.splitlines() if line.startswith("{")]

    def values(self, key: str) -> list[Any]:
        """What the records that have ``key`` say about it."""
        return [record[key] for record in self.records if key in record]

    async def wait_values(
        self, key: str, count: int = 1, *, timeout: float = PATIENCE
    ) -> list[Any]:
        """Wait for ``count`` records that have ``key``; return what they say."""

        def check() -> list[Any] | None:
            found = self.values(key)
            if len(found) >= count:
                return found
            self._must_run()
            return None

        found: list[Any] = await until(
            check,
            what=lambda: f"{count} records with {key!r} from {self.report()}",
            timeout=timeout,
        )
        return found

    async def wait_text(
        self, pattern: str, *, timeout: float = PATIENCE, running: bool = True
    ) -> re.Match[str]:
        """Wait for ``pattern`` in what the program wrote to either stream."""

        def check() -> re.Match[str] | None:
            match = re.search(pattern, self.stdout + "\n" + self.stderr, re.MULTILINE)
            if match is None and running:
                self._must_run()
            return match

        found: re.Match[str] = await until(
            check, what=lambda: f"/{pattern}/ from {self.report()}", timeout=timeout
        )
        return found

    def _must_run(self) -> None:
        if self.code is not None:
            raise AssertionError(f"ended early: {self.report()}")

    def tell(self, text: str) -> None:
        """Write a line to its standard input."""
        assert self._popen.stdin is not None
        self._popen.stdin.write(text.encode() + b"\n")
        self._popen.stdin.flush()

    # How it ends

    async def wait(self, *, timeout: float = PATIENCE) -> Result:
        """Wait for the program to end by itself."""
        await until(
            lambda: self.code is not None,
            what=lambda: f"the end of {self.report()}",
            timeout=timeout,
        )
        return Result(self._popen.returncode, self.stdout, self.stderr)

    def signal(self, number: signal.Signals) -> None:
        """To the program and what it started."""
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self.pid, number)

    async def kill(self) -> None:
        """End it at once: it has no chance to say goodbye to anybody."""
        self.signal(signal.SIGKILL)
        await self.wait()

    async def end(self) -> None:
        """Ask politely, then firmly, then not at all."""
        await end_all([self])

    def close(self) -> None:
        """Its standard input comes to an end."""
        if self._popen.stdin is not None:
            with contextlib.suppress(BrokenPipeError):
                self._popen.stdin.close()


def _group_is_alive(group: int) -> bool:
    """Whether a process of the group runs, and is not just waiting to be reaped."""
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False  # without a look at every process there is
    for path in Path("/proc").glob("[0-9]*/stat"):
        try:
            state, _, group_of_it = path.read_text().rpartition(")")[2].split()[:3]
        except (OSError, ValueError):
            continue
        if int(group_of_it) == group and state not in "ZX":
            return True
    return False


async def end_all(processes: Sequence[Process]) -> None:
    """End all of ``processes``, side by side."""
    for process in processes:
        process.close()
    for number, patience in GRACE:
        running = [process for process in processes if process.is_alive]
        if not running:
            break
        for process in running:
            process.signal(number)
        for _ in range(round(patience / POLL)):
            if not any(process.is_alive for process in running):
                break
            await asyncio.sleep(POLL)
