"""Running a program that is a single node, started from a shell and ended by a signal."""

from __future__ import annotations

import asyncio
import contextlib
import inspect
import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Coroutine, Iterator
from pathlib import Path
from typing import Any, Generic, TypeVar

from aioros1 import ClosedError, MasterUnreachable, Node
from aioros1._public import public

__all__ = ["run"]

T = TypeVar("T")


_LATE = 1.0
"""Seconds that ``main`` has to end after it has closed its node itself, before it is cancelled,
and after that, before the program ends without it."""

_BLOCKED = 0.5
"""Seconds after which an event loop that has not received a signal counts as blocked."""

_LIBRARIES = ("aioros1", "aiohttp")
"""The packages whose tasks end with the node."""

_MOST_EXITS = 10
"""How many times the program may call ``sys.exit`` while it ends, before it ends at once."""


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

    SIGINT, SIGTERM, a shutdown from the graph (``rosnode kill``, a second node of the name) and
    an error of the node cancel ``main``. Its roles stay open for ``timeouts.close`` seconds, so
    that a ``finally`` can stop the robot; then the node closes. Tasks that ``main`` leaves behind
    are cancelled when it ends, before roles close. A second signal closes the node
    at once; if ``main`` blocks the event loop, it is interrupted by a :class:`KeyboardInterrupt`.
    A signal while the node starts stops the start.

    An end that was asked for is no error: the result is what ``main`` returns, or None if it
    ends by its cancellation or a :class:`~aioros1.ClosedError`. After a shutdown from the graph
    the reason is written to standard error. Any other exception of ``main`` is raised once the
    node is closed, and so is one in a callback that ended the node (``on_error="raise"``), and
    the :class:`SystemExit` of a ``sys.exit()`` anywhere in the program. If ``main`` or a task
    does not end although it was cancelled twice, the program exits without it, with status 1.

    Without a master, what ``main`` asks of it waits until one answers, and a line on standard
    error says so (``without_master="wait"``). With ``without_master="raise"``, and after
    ``main`` has raised :class:`~aioros1.MasterUnreachable`, the script ends with that one line
    and status 1.

    Use this function only in scripts: no other part of the library touches signals. Raises
    :class:`RuntimeError` outside the main thread, and where an event loop is running.
    """
    _check_place()
    _check_main(main)
    if name is None:
        name = Path(sys.argv[0]).stem or "aioros1"
    node_options.setdefault("argv", sys.argv[1:])
    node_options.setdefault("without_master", "wait")
    node = Node(name, **node_options)
    script = _Script(main, node)
    try:
        with _log_file(node):
            _run(script, loop_factory)
            return script.outcome()
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


def _check_place() -> None:
    if threading.current_thread() is not threading.main_thread():
        raise RuntimeError(
            "aioros1.run() handles signals, which Python allows only in the main thread: in "
            "another one, use aioros1.contrib.threads.NodeThread or `async with aioros1.Node(...)`"
        )
    try:
        asyncio.get_running_loop()
    except RuntimeError:
        return
    raise RuntimeError(
        "aioros1.run() starts an event loop, but one is running here: use "
        "`async with aioros1.Node(...)` in it"
    )


def _check_main(main: Any) -> None:
    if inspect.iscoroutine(main):
        main.close()  # Python warns about a coroutine that is never awaited
    if not callable(main):
        raise TypeError(f"run() takes a coroutine function, `main` and not `main()`, got {main!r}")


def _run(
    script: _Script[Any], loop_factory: Callable[[], asyncio.AbstractEventLoop] | None
) -> None:
    with contextlib.ExitStack() as stack:
        # Closing the runner waits for the threads of asyncio.to_thread, for ever if need be.
        threads: list[threading.Thread] = []
        late = threading.Timer(_LATE, _name_threads, (script.node_name, threads))
        late.daemon = True
        stack.callback(late.cancel)
        runner = stack.enter_context(asyncio.Runner(loop_factory=loop_factory))
        part = script.live()
        for _ in range(_MOST_EXITS):
            try:
                runner.run(part)
                break
            except (SystemExit, KeyboardInterrupt) as error:
                # From a task or a callback. The loop has stopped where it was, so go on there.
                script.exit = script.exit or error
                part = script.resume()
        else:
            part.close()
        with contextlib.suppress(SystemExit, KeyboardInterrupt):
            runner.run(script.end_rest())
        if script.is_left_behind:
            stack.pop_all()  # closing the runner would wait for ever
        else:
            threads.extend(threading.enumerate())  # Python starts one more, which waits for them
            late.start()


def _name_threads(node_name: str, threads: list[threading.Thread]) -> None:
    left = (each for each in threads if each.is_alive() and not each.daemon)
    names = ", ".join(each.name for each in left if each is not threading.main_thread())
    sys.stderr.write(f"{node_name} is closed; the program waits for its threads: {names}\n")


class _Script(Generic[T]):
    """The life of a script: its node starts, ``main`` runs, the node closes."""

    def __init__(self, main: Callable[[Node], Coroutine[Any, Any, T]], node: Node) -> None:
        self.exit: BaseException | None = None
        """A :class:`SystemExit` or :class:`KeyboardInterrupt` of the program."""
        self.is_left_behind = False
        """Whether ``main`` or a task goes on although the node is closed and it was cancelled."""
        self.node_name = node.name
        self._function = main
        self._node = node
        self._life: asyncio.Task[Any] | None = None
        self._main: asyncio.Task[None] | None = None
        self._result: T | None = None
        self._error: BaseException | None = None  # of main
        self._failure: BaseException | None = None  # of the node
        self._was_told = False  # whether main was running when the node was told to end
        self._signals = 0
        self._late = ""  # what is left behind
        self._closing: set[asyncio.Task[None]] = set()

    async def live(self) -> None:
        """Run to the end. Raises what the start of the node raises."""
        self._life = asyncio.current_task()
        with _handling_signals(asyncio.get_running_loop(), self._receive_signal):
            try:
                await self._node.start()
            except asyncio.CancelledError:
                if not self._signals:
                    raise
                return
            main = self._main = self._node.create_task(self._run_main(), name="main")
            closed = asyncio.create_task(self._node.wait_closed(), name="wait_closed")
            main.add_done_callback(lambda _: self._close())
            cancelled: asyncio.CancelledError | None = None
            while not closed.done():
                try:
                    await asyncio.wait((closed,))
                except asyncio.CancelledError as error:
                    cancelled = error
                    self._receive_signal()  # as if it had been one
            self._failure = closed.exception()
            if not await self._has_ended(main):
                self.is_left_behind = True
                self._late = repr(self._function)
            self._say_why()
            if cancelled is not None:
                raise cancelled

    async def resume(self) -> None:
        """Go on after the loop has stopped, and end."""
        assert self._life is not None
        self._close()
        await asyncio.wait((self._life,))
        self._life.result()

    async def end_rest(self) -> None:
        """Cancel all tasks that are left, as closing the runner does, but wait a while only."""
        rest = asyncio.all_tasks() - {asyncio.current_task()}
        for task in rest:
            task.cancel()
        if rest and (late := (await asyncio.wait(rest, timeout=_LATE))[1]):
            self.is_left_behind = True
            self._late = self._late or ", ".join(sorted(task.get_name() for task in late))

    def outcome(self) -> T | None:
        """Return the result of ``main``, or raise what there is to raise, after the end."""
        error = self._error
        if self._was_told and error is not None:
            error = _without_ends(error)
        if self.exit is not None:
            raise self.exit
        if isinstance(error, SystemExit):
            raise error
        if self.is_left_behind:
            raise SystemExit(f"{self._late} goes on although it was cancelled: left behind")
        if self._failure is not None:
            if error is not None:
                self._node.log.error("main failed while it ended", exc_info=error)
            raise self._failure
        if error is not None:
            raise error
        return self._result

    def _say_why(self) -> None:
        """Write why the graph has ended the node, unless there is more to say."""
        reason = self._node.close_reason
        if not self._was_told or self._signals or reason == "closed":
            return
        has_failed = self._error is not None and _without_ends(self._error) is not None
        if not (has_failed or self._failure or self.exit or self.is_left_behind):
            sys.stderr.write(f"{self.node_name} was shut down: {reason}\n")

    async def _run_main(self) -> None:
        try:
            coroutine = self._function(self._node)
            if not inspect.isawaitable(coroutine):
                raise TypeError(f"run() takes a coroutine function, got {self._function!r}")
            self._result = await coroutine
        except BaseException as error:  # SystemExit too has to wait for the node
            self._error = error
        finally:
            self._was_told = self._node.close_reason is not None
            await self._end_tasks()

    async def _end_tasks(self) -> None:
        """Cancel the tasks that ``main`` has left, as the end of the event loop would do, but
        while their roles are open."""
        left = {task for task in asyncio.all_tasks() if _is_of_program(task)}
        if not left:
            return
        for task in left:
            task.cancel()
        ended, _ = await asyncio.wait(left, timeout=self._node.timeouts.close)
        for task in ended:
            # It may have used a role that main has closed.
            error = None if task.cancelled() else _without_ends(task.exception())
            if error is not None and not isinstance(error, (SystemExit, KeyboardInterrupt)):
                self._node.log.error("%s failed while it ended", task.get_name(), exc_info=error)

    async def _has_ended(self, main: asyncio.Task[None]) -> bool:
        """Whether ``main`` ends, now that the node is closed."""
        # If the node has cancelled it, it has also waited for it. If main itself has closed
        # the node, it may be about to return.
        for _ in range(main.cancelling(), 2):
            await asyncio.wait((main,), timeout=_LATE)
            main.cancel()
        return main.done()

    def _receive_signal(self) -> None:
        self._signals += 1
        if self._main is not None:
            self._close(grace=None if self._signals == 1 else 0)
        elif self._signals == 1 and self._life is not None:
            self._life.cancel()  # the start

    def _close(self, grace: float | None = None) -> None:
        closing = asyncio.create_task(self._node.close(grace=grace), name="close")
        self._closing.add(closing)
        closing.add_done_callback(self._closing.discard)


def _is_of_program(task: asyncio.Task[Any]) -> bool:
    """Whether the code of a task is not of this library, nor of the HTTP server it uses."""
    frame = getattr(task.get_coro(), "cr_frame", None)
    module: str = "" if frame is None else frame.f_globals.get("__name__", "")
    return module.partition(".")[0] not in _LIBRARIES


def _without_ends(error: BaseException | None) -> BaseException | None:
    """What is left of an exception of ``main`` that was told to end."""
    ends = (asyncio.CancelledError, ClosedError)
    if isinstance(error, BaseExceptionGroup):
        return error.split(ends)[1]
    return None if isinstance(error, ends) else error


@contextlib.contextmanager
def _handling_signals(
    loop: asyncio.AbstractEventLoop, receive: Callable[[], object]
) -> Iterator[None]:
    """Call ``receive`` in the event loop for each SIGINT and SIGTERM.

    If the loop has not done so for a while, the code that blocks it is interrupted by the
    next signal, with :class:`KeyboardInterrupt`.
    """
    # Not loop.add_signal_handler(): nothing could interrupt a loop that is blocked.
    waiting_since: float | None = None
    owner = os.getpid()

    def handle(number: int, frame: object) -> None:
        nonlocal waiting_since
        if number == signal.SIGTERM and os.getpid() != owner:
            # A process that was forked from this one: it has to end, as Process.terminate()
            # asks. Ctrl-C reaches all of them, and workers may be needed to clean up.
            signal.signal(number, previous[signal.Signals(number)] or signal.SIG_DFL)
            os.kill(os.getpid(), number)
            return
        now = time.monotonic()
        if waiting_since is None:
            waiting_since = now
        elif now - waiting_since > _BLOCKED:
            waiting_since = None
            raise KeyboardInterrupt
        loop.call_soon_threadsafe(pass_on)

    def pass_on() -> None:
        nonlocal waiting_since
        waiting_since = None
        receive()

    numbers = (signal.SIGINT, signal.SIGTERM)
    previous = {number: signal.signal(number, handle) for number in numbers}
    try:
        yield
    finally:
        for number, handler in previous.items():
            if handler is not None:  # one that was not installed by Python
                signal.signal(number, handler)


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
