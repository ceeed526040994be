"""Programs that are measured: started, pinned, listened to, and ended."""

from __future__ import annotations

import json
import os
import signal
import socket
import subprocess
import threading
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import Self

__all__ = ["BenchmarkError", "Cores", "Program", "free_port"]

TIMEOUT = 120
"""Seconds after which a program that does not end is taken as hanging."""

Cores = int | None
"""The core that a program is kept on; None is any."""


class BenchmarkError(Exception):
    """A program did not do what it was started for."""


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
        return port


class Program:
    """One process; what it writes, line by line of JSON, are its figures."""

    def __init__(
        self, command: Sequence[str], environment: Mapping[str, str], log: Path, core: Cores = None
    ) -> None:
        self.name = " ".join([Path(command[0]).name, *command[1:]])
        self._log = log
        with log.open("wb") as errors:
            self._process = subprocess.Popen(
                command, env=environment, stdout=subprocess.PIPE, stderr=errors
            )
        if core is not None:
            os.sched_setaffinity(self._process.pid, {core})
        self._watch = threading.Timer(TIMEOUT, self._process.kill)
        self._watch.daemon = True
        self._watch.start()

    @property
    def pid(self) -> int:
        return self._process.pid

    def outlasts(self) -> None:
        """It serves many runs, and is not hanging when it does not end for long."""
        self._watch.cancel()

    def report(self) -> dict[str, float]:
        """The next figures it writes."""
        assert self._process.stdout
        for line in self._process.stdout:
            if line.startswith(b"{"):  # roscpp logs to standard output as well
                figures: dict[str, float] = json.loads(line)
                return figures
        self.end()
        raise BenchmarkError(f"{self.name} ended without a figure: {self._last_words()}")

    def finish(self) -> dict[str, float]:
        """The last figures it writes, when it ended; and ``cpu_total``, from start to end."""
        assert self._process.stdout
        lines = [line for line in self._process.stdout if line.startswith(b"{")]
        _, ended, usage = os.wait4(self.pid, 0)
        self._process.returncode = os.waitstatus_to_exitcode(ended)
        self.end()
        if self._process.returncode or not lines:
            code = self._process.returncode
            raise BenchmarkError(f"{self.name} ended with {code}: {self._last_words()}")
        figures: dict[str, float] = json.loads(lines[-1])
        figures["cpu_total"] = usage.ru_utime + usage.ru_stime
        return figures

    def footprint(self) -> dict[str, float]:
        """Memory (bytes), threads and file descriptors at this moment; Linux only."""
        process = Path(f"/proc/{self.pid}")
        lines = (process / "status").read_text().splitlines()
        status = dict(line.split(":", 1) for line in lines)
        return {
            "rss": int(status["VmRSS"].split()[0]) * 1024,
            "threads": int(status["Threads"]),
            "fds": len(os.listdir(process / "fd")),
        }

    def ask(self) -> dict[str, float]:
        """What a program reports about itself when it gets SIGUSR1."""
        os.kill(self.pid, signal.SIGUSR1)
        return self.report()

    def end(self) -> None:
        """Make sure that it is gone."""
        self._watch.cancel()
        if self._process.poll() is None:
            self._process.terminate()
            try:
                self._process.wait(5)
            except subprocess.TimeoutExpired:
                self._process.kill()
                self._process.wait()
        if self._process.stdout:
            self._process.stdout.close()

    def _last_words(self) -> str:
        return self._log.read_text(errors="replace").strip()[-500:]

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        exc_type: type[BaseException] | None,
        exc: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.end()
