"""The near side of ``program.py``: requests as lines of JSON, and their answers."""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import sys
import threading
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import aioros1

__all__ = ["PATIENCE", "Pending", "Program", "RemoteError"]

PATIENCE = 40.0
"""Seconds to wait for something that normally takes a fraction of one."""

_SCRIPT = Path(__file__).parent / "program.py"


class RemoteError(Exception):
    """What a request raised over there: ``kind`` is the name of the exception's class."""

    def __init__(self, kind: str, text: str) -> None:
        super().__init__(f"{kind}: {text}")
        self.kind = kind


class Pending:
    """A request that was sent, and may have been answered."""

    def __init__(self, program: Program, number: int, what: str) -> None:
        self._program = program
        self._number = number
        self._what = what

    def get(self, timeout: float = PATIENCE) -> Any:
        """The answer. Raises :class:`RemoteError`."""
        return self._program._answer(self._number, self._what, timeout)


class Program:
    """One running ``program.py``."""

    def __init__(self, name: str, prefix: Sequence[str], environment: Mapping[str, str]) -> None:
        env = {key: value for key, value in os.environ.items() if not key.startswith("ROS_")}
        env["PYTHONPATH"] = str(Path(aioros1.__file__).parents[1])
        self.name = name
        self._popen = subprocess.Popen(
            [*prefix, sys.executable, "-W", "error", str(_SCRIPT)],
            env={**env, **environment},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            bufsize=1,
        )
        self._sent = 0
        self._answers: dict[int, dict[str, Any]] = {}
        self._log: list[str] = []
        self._news = threading.Condition()
        self._has_ended = False
        self._readers = [
            threading.Thread(target=target, daemon=True)
            for target in (self._read_answers, self._read_log)
        ]
        for reader in self._readers:
            reader.start()

    def send(self, command: str, *args: Any, **options: Any) -> Pending:
        """Ask for something, and do not wait for it."""
        self._sent += 1
        request = {"id": self._sent, "do": command, "args": args, "options": options}
        assert self._popen.stdin is not None
        self._popen.stdin.write(json.dumps(request) + "\n")
        return Pending(self, self._sent, f"{command} {args} {options}")

    def __call__(self, command: str, *args: Any, **options: Any) -> Any:
        """Ask for something, and wait for the answer. Raises :class:`RemoteError`."""
        return self.send(command, *args, **options).get()

    @property
    def log(self) -> str:
        """What it has written to standard error."""
        return "".join(self._log)

    def kill(self) -> None:
        """End it at once, without a word to anybody."""
        self._popen.kill()
        self._popen.wait()
        for reader in self._readers:
            reader.join()
        for stream in (self._popen.stdin, self._popen.stdout, self._popen.stderr):
            assert stream is not None
            with contextlib.suppress(BrokenPipeError):  # it had ended before
                stream.close()

    def _answer(self, number: int, what: str, timeout: float) -> Any:
        with self._news:
            done = self._news.wait_for(
                lambda: number in self._answers or self._has_ended, timeout=timeout
            )
            answer = self._answers.pop(number, None)
        if answer is None:
            state = "no answer in time" if not done else "it has ended"
            raise AssertionError(f"{self.name}: {what}: {state}\n{self.log}")
        if "error" in answer:
            raise RemoteError(answer["error"], answer["text"])
        return answer["value"]

    def _read_answers(self) -> None:
        assert self._popen.stdout is not None
        for line in self._popen.stdout:
            answer = json.loads(line)
            with self._news:
                self._answers[answer["id"]] = answer
                self._news.notify_all()
        with self._news:
            self._has_ended = True
            self._news.notify_all()

    def _read_log(self) -> None:
        assert self._popen.stderr is not None
        for line in self._popen.stderr:
            self._log.append(line)
