"""Finding what a test has left behind."""

from __future__ import annotations

import asyncio
import contextlib
import functools
import gc
import os
import socket
import stat
import sys
import threading
import time
import warnings
from collections.abc import Callable, Iterator
from typing import Any

__all__ = ["LeakCheck"]

_PATIENCE = 1.0
"""Seconds for closing transports and threads to end; asyncio has no way to wait for them."""

_TURNS = 5
"""Iterations of the event loop for what closes late and looks like uvloop's own."""

_DIRECTORIES = ("/proc/self/fd", "/dev/fd")

_KINDS = (stat.S_IFSOCK, stat.S_IFIFO, stat.S_IFREG)
"""Kinds of files to check; devices and files without a kind, which event loops use, are not."""

_File = tuple[int, int, int]
"""The number of a file, and what tells it from earlier and later files with that number."""


class LeakCheck:
    """Records what exists when it is made, and reports what has been added since and remains.

    It finds tasks of an event loop, with the nodes they belong to; open sockets, pipes and
    files, where the system lists them; and threads. It ignores the threads in which the loop
    runs ``asyncio.to_thread`` and looks up addresses, because they belong to the loop.

    Make it, and call :meth:`leaks`, while the loop does not run: while it runs, uvloop has
    sockets of its own. Before :meth:`leaks`, :meth:`look_into_loop` checks the loop itself.
    """

    def __init__(self) -> None:
        _open_pipe_of_uvloop()
        self._threads = set(threading.enumerate())
        self._files = set(_open_files())
        self._found: list[str] = []
        self._executor: str | None = None

    async def look_into_loop(self, before: set[asyncio.Task[Any]]) -> None:
        """Find tasks that are not in ``before``, and wait a while for closing transports and
        threads to end."""
        left = asyncio.all_tasks() - before - {asyncio.current_task()}
        self._found += [*_unclosed(left), *sorted(f"task {task!r}" for task in left)]
        for _ in range(_TURNS):
            await asyncio.sleep(0)
        if self._new_threads():
            self._executor = await _executor_prefix()
        end = time.monotonic() + _PATIENCE
        while not left and time.monotonic() < end:
            new = [each for each in self._new_files() if not _is_nameless(each[0])]
            if not new and not self._new_threads():
                break
            await asyncio.sleep(0.01)

    def leaks(self, *, wait: bool) -> list[str]:
        """A line for each leak; with ``wait`` it first gives files and threads a while to end.

        After :meth:`look_into_loop` there is no need to ``wait``.
        """
        end = time.monotonic() + (_PATIENCE if wait else 0)
        while (self._new_files() or self._new_threads()) and time.monotonic() < end:
            time.sleep(0.01)
        if self._new_files() or self._new_threads():
            self._found[:0] = _unclosed_masters(self._new_files())
            # Garbage counts as a leak only if it warns that nobody closed it.
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always", ResourceWarning)
                gc.collect()
            self._found += sorted(
                str(each.message) for each in caught if each.category is ResourceWarning
            )
            self._found += sorted(f"thread {each!r}" for each in self._new_threads())
            self._found += [_describe(number) for number, *_ in self._new_files()]
        return self._found

    def _new_threads(self) -> list[threading.Thread]:
        return [
            each
            for each in threading.enumerate()
            if each not in self._threads
            # Python keeps a record of every C thread that has ever called it.
            and not isinstance(each, threading._DummyThread)
            and not (self._executor is not None and each.name.startswith(self._executor))
        ]

    def _new_files(self) -> list[_File]:
        kept = _pipes_of_multiprocessing()
        return sorted(each for each in set(_open_files()) - self._files if each[0] not in kept)


def _unclosed(tasks: set[asyncio.Task[Any]]) -> Iterator[str]:
    """The nodes that have one of ``tasks``, which are named after them."""
    node = sys.modules.get("aioros1.node")
    if tasks and node is not None:
        owners = {task.get_name() for task in tasks}
        for each in gc.get_objects():
            # type(), because reading the __class__ of an unknown object may run its code.
            if issubclass(type(each), node.Node) and f"node {each.name} supervisor" in owners:
                yield f"never closed: {each!r}"


def _unclosed_masters(files: list[_File]) -> Iterator[str]:
    """The masters that listen at one of ``files``."""
    server = sys.modules.get("aioros1.master.server")
    names = [_own_name(number) for number, *_ in files]
    ports = {name[1] for name in names if isinstance(name, tuple)}
    if ports and server is not None:
        for each in gc.get_objects():
            if issubclass(type(each), server.Master) and each.is_open and each.port in ports:
                yield f"never closed: {each!r}"


async def _executor_prefix() -> str | None:
    """The prefix of the thread names of the loop's executor, whatever the kind of loop."""
    running = asyncio.get_running_loop().run_in_executor(None, threading.current_thread)
    try:
        async with asyncio.timeout(_PATIENCE):
            thread = await running
    except TimeoutError:  # all threads are busy, and really are leaks
        return None
    return thread.name.rpartition("_")[0] + "_"


def _open_files() -> Iterator[_File]:
    """The open sockets, pipes and files; none where the system does not list them."""
    for directory in _DIRECTORIES:
        try:
            names = os.listdir(directory)
        except OSError:
            continue
        for name in names:
            # The descriptor used for listing is already closed.
            with contextlib.suppress(OSError, ValueError):
                number = int(name)
                status = os.fstat(number)
                # pytest redirects the standard streams back and forth.
                if number > 2 and stat.S_IFMT(status.st_mode) in _KINDS:
                    yield number, status.st_dev, status.st_ino
        return


def _open_pipe_of_uvloop() -> None:
    """Have uvloop open its pipe for signals, which its first loop does and the process keeps."""
    if (uvloop := sys.modules.get("uvloop")) is not None:
        _make_and_close(uvloop.new_event_loop)


@functools.cache
def _make_and_close(new_event_loop: Callable[[], asyncio.AbstractEventLoop]) -> None:
    new_event_loop().close()


def _pipes_of_multiprocessing() -> set[Any]:
    """Pipes to the helper processes that multiprocessing starts once and keeps."""
    helpers = {
        "resource_tracker": ("_resource_tracker", "_fd"),
        "forkserver": ("_forkserver", "_forkserver_alive_fd"),
    }
    return {
        getattr(getattr(sys.modules.get(f"multiprocessing.{name}"), helper, None), pipe, None)
        for name, (helper, pipe) in helpers.items()
    }


def _socket(number: int) -> socket.socket | None:
    """A copy of the socket with this number, or ``None`` if it is no socket."""
    copy = -1
    try:
        copy = os.dup(number)
        return socket.socket(fileno=copy)
    except OSError:
        if copy >= 0:
            os.close(copy)
        return None


def _own_name(number: int) -> Any:
    """The address of the socket with this number; ``None`` if it is no socket."""
    if (copy := _socket(number)) is None:
        return None
    with copy:
        return copy.getsockname()


def _is_nameless(number: int) -> bool:
    """Whether this is one of a pair of sockets, such as uvloop has while it runs."""
    return _own_name(number) in ("", b"")


def _describe(number: int) -> str:
    if (copy := _socket(number)) is None:
        with contextlib.suppress(OSError):
            return f"file {number}: {os.readlink(f'/proc/self/fd/{number}')}"
        return f"file {number}"
    with copy:
        peer = ""
        with contextlib.suppress(OSError):
            peer = f" connected to {copy.getpeername()}"
        return f"socket {number}: {copy.family.name} at {copy.getsockname()}{peer}"
