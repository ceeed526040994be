"""Our master, some of whose requests are answered by a test."""

from __future__ import annotations

import asyncio
from collections import Counter
from collections.abc import Callable
from typing import Any

import pytest

from aioros1.master.api import MasterApi

HANG = object()
"""What a script returns to leave a request without an answer, for ever."""

Script = Callable[[str, tuple[Any, ...]], Any]


class ScriptedMaster:
    """Asks ``script(method, params)`` before the master obeys.

    It may return an answer, an exception to raise, :data:`HANG`, or None to let the master
    obey. Applies to every master that is started while it is used.
    """

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.script: Script = lambda method, params: None
        self.asked: Counter[str] = Counter()
        self.hanging: list[asyncio.Future[None]] = []
        methods = MasterApi.methods

        def scripted(api: MasterApi) -> dict[str, Callable[..., Any]]:
            return {name: self._method(name, call) for name, call in methods(api).items()}

        monkeypatch.setattr(MasterApi, "methods", scripted)

    def _method(self, name: str, obey: Callable[..., Any]) -> Callable[..., Any]:
        async def method(*params: Any) -> Any:
            self.asked[name] += 1
            answer = self.script(name, params)
            if answer is None:
                return obey(*params)
            if isinstance(answer, Exception):
                raise answer
            if answer is not HANG:
                return answer
            future = asyncio.get_running_loop().create_future()
            self.hanging.append(future)
            await future
            return obey(*params)

        return method

    def release(self) -> None:
        """Obey all that hangs."""
        for future in self.hanging:
            if not future.done():
                future.set_result(None)
        self.hanging.clear()
