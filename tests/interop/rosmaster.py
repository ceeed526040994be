"""The rosmaster program."""

from __future__ import annotations

import os
import signal
import subprocess
import time
from collections.abc import Sequence
from pathlib import Path

from . import debian
from .world import free_port, xmlrpc_call

__all__ = ["RealMaster"]


class RealMaster:
    """A rosmaster without rosout, that can be ended and started again on its port.

    ``within`` are the words of a program that runs it, in a session of its own.
    """

    def __init__(self, folder: Path, within: Sequence[str] = ()) -> None:
        debian.require("rosmaster")
        self._within = within
        self.port = free_port()
        self.uri = f"http://localhost:{self.port}"
        self._folder = folder
        self._popen: subprocess.Popen[bytes] | None = None
        self._log = folder / "rosmaster.log"

    def start(self) -> None:
        with self._log.open("ab") as log:
            self._popen = subprocess.Popen(
                [*self._within, "rosmaster", "--core", "-p", str(self.port)],
                env=debian.environment(self.uri, self._folder / "ros_home"),
                cwd=self._folder,
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=log,
                start_new_session=True,
            )
        end = time.monotonic() + 20
        while True:
            try:
                if xmlrpc_call(self.uri, "getPid", "/interop_test")[0] == 1:
                    return
            except OSError:
                if time.monotonic() > end or self._popen.poll() is not None:
                    self.stop()
                    raise AssertionError(f"no rosmaster: {self._log.read_text()}") from None
                time.sleep(0.02)

    def kill(self) -> None:
        """End it at once, and what runs it."""
        if self._popen is not None:
            os.killpg(self._popen.pid, signal.SIGKILL)
            self._popen.wait()
            self._popen = None

    def stop(self) -> None:
        if self._popen is None:
            return
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
            self._popen.send_signal(number)
            try:
                self._popen.wait(4)
                break
            except subprocess.TimeoutExpired:
                continue
        self._popen = None
