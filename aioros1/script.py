"""Running a program that is a single node, started from a shell and ended by a signal."""

from __future__ import annotations

import asyncio
import contextlib
import signal
import sys
from collections.abc import Callable, Coroutine, Iterator
from pathlib import Path
from typing import Any, TypeVar

from aioros1 import ClosedError, MasterUnreachable, Node
from aioros1._public import public

__all__ = ["run"]

T = TypeVar("T")


_GRACE = 1.0
"""Seconds that ``main`` has to return after its node closes, before it is cancelled."""


@public
def run(
    main: Callable[[Node], Coroutine[Any, Any, T]],
    name: str | None = None,
    *,
    loop_factory: Callable[[], asyncio.AbstractEventLoop] | None = None,
    **node_options: Any,
) -> T | None:
    """Run ``main(node)`` with a new node in a new event loop, and return its result.

    ``name`` defaults to the name of the script. The node uses the script's command line,
    unless ``argv`` is among the options. The node's log is also written to the file that
    ``__log:=`` names. ``loop_factory`` is passed to :class:`asyncio.Runner`, for example
    ``uvloop.new_event_loop``.

    SIGINT and SIGTERM close the node. Loops over roles and rates then end, and ``main``
    usually returns; if it does not, it is cancelled, and the result is None. A second signal
    cancels it at once. A signal while the node starts stops the start, and the result is None.

    Without a master, what ``main`` asks of it waits until one answers, and a line on standard
    error says so (``without_master="wait"``). With ``without_master="raise"``, and after
    ``main`` has raised :class:`~aioros1.MasterUnreachable`, the script ends with that one line
    and status 1.

    Use this function only in scripts: no other part of the library touches signals.
    """
    if name is None:
        name = Path(sys.argv[0]).stem or "aioros1"
    node_options.setdefault("argv", sys.argv[1:])
    node_options.setdefault("without_master", "wait")
    node = Node(name, **node_options)
    try:
        with _log_file(node), asyncio.Runner(loop_factory=loop_factory) as runner:
            return runner.run(_run(main, node))
    except (MasterUnreachable, ExceptionGroup) as error:
        if (missing := _missing_master(error)) is None:
            raise
        raise SystemExit(f"{node.name}: {missing}") from None


def _missing_master(error: Exception) -> Exception | None:
    """The error that there is no master, if ``error``, alone or as a group, says only that."""
    while isinstance(error, ExceptionGroup):
        if error.split(MasterUnreachable)[1] is not None:
            return None
        error = error.exceptions[0]
    return error


async def _run(main: Callable[[Node], Coroutine[Any, Any, T]], node: Node) -> T | None:
    signals = _Signals(node)
    try:
        async with node:
            signals.main = task = asyncio.create_task(main(node), name="main")
            try:
                await asyncio.wait({task})
            except asyncio.CancelledError:
                task.cancel()
                # While the node is open, since clean-up may need it.
                with contextlib.suppress(Exception, asyncio.CancelledError):
                    await task
                raise
        return await task
    except (asyncio.CancelledError, ClosedError):
        if signals.received:
            return None
        raise
    finally:
        signals.release()


class _Signals:
    """Handles SIGINT and SIGTERM while a script runs, from the start of its node until the
    node is closed."""

    def __init__(self, node: Node) -> None:
        self.received = False
        self.main: asyncio.Task[Any] | None = None
        """The task of ``main``; None while the node starts, when a signal stops the start."""
        self._node = node
        self._starting = asyncio.current_task()
        self._loop = asyncio.get_running_loop()
        self._ending: asyncio.Task[None] | None = None
        self._numbers: list[signal.Signals] = []
        for number in (signal.SIGINT, signal.SIGTERM):
            # Not available on Windows, or outside the main thread.
            with contextlib.suppress(NotImplementedError, ValueError, RuntimeError):
                self._loop.add_signal_handler(number, self._receive)
                self._numbers.append(number)

    def release(self) -> None:
        for number in self._numbers:
            self._loop.remove_signal_handler(number)

    def _receive(self) -> None:
        again, self.received = self.received, True
        if self.main is None:
            if not again and self._starting is not None:
                self._starting.cancel()
        elif again:
            self.main.cancel()
        else:
            self._ending = self._loop.create_task(self._end(self.main), name="end")

    async def _end(self, main: asyncio.Task[Any]) -> None:
        await self._node.close()
        await asyncio.wait({main}, timeout=_GRACE)
        main.cancel()


@contextlib.contextmanager
def _log_file(node: Node) -> Iterator[None]:
    """Write the log to the file that the command line names, if it names one and that works."""
    if node.log_file is None:
        yield
        return
    with contextlib.ExitStack() as stack:
        try:
            stack.enter_context(node.log.to_file(node.log_file))
        except OSError as error:
            node.log.warning("__log:=%s: no log is written there: %s", node.log_file, error)
        yield
