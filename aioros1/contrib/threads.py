"""A node for programs without an event loop: it runs in its own loop, in a thread."""

from __future__ import annotations

import asyncio
import atexit
import contextlib
import threading
from collections.abc import AsyncIterable, AsyncIterator, Awaitable, Callable, Iterator
from concurrent.futures import Future
from types import TracebackType
from typing import Any, ParamSpec, Self, TypeVar, overload

from aioros1 import ClosedError, Node

__all__ = ["NodeThread"]

P = ParamSpec("P")
T = TypeVar("T")

_GRACE = 1.0
"""Seconds after the node is closed until coroutines that still run are cancelled."""

_LOOK = 0.5
"""Seconds between checks for Ctrl-C while the main thread waits: Python misses it just
before it begins to wait for a lock, and on Windows while it waits."""

_END: Any = object()


class NodeThread:
    """A node with its own event loop and thread, for programs that block.

    ::

        with NodeThread("gui") as ros:
            pub = ros.run(ros.node.advertise("chatter", String))
            ros.call(pub.publish, data="hello")

    The options are those of :class:`~aioros1.Node`; ``loop_factory`` is that of
    :class:`asyncio.Runner`, for example ``uvloop.new_event_loop``.

    You may call the methods of this class in any thread, also at the same time. The node and
    its roles belong to their loop: create their awaitables wherever you like and pass them
    to :meth:`run` or :meth:`submit`, and use :meth:`call` for their plain functions.

    When the node is closed, by whatever means, iterations end, and waits and calls raise
    :class:`~aioros1.ClosedError`. A coroutine that does not end by itself is cancelled a
    second later. If you never close the node, it is closed when the program exits. A forked
    process has neither the thread nor the node: using this object there raises
    :class:`~aioros1.ClosedError`, so make a new one.
    """

    def __init__(
        self,
        name: str,
        *,
        loop_factory: Callable[[], asyncio.AbstractEventLoop] | None = None,
        **options: Any,
    ) -> None:
        self.node = Node(name, **options)
        """The node."""
        self._loop_factory = loop_factory
        self._loop: asyncio.AbstractEventLoop | None = None
        self._thread: threading.Thread | None = None
        self._started: Future[None] = Future()
        # Whether the loop takes more work. Both adding work and closing the loop to it hold
        # the lock, so whatever was accepted is also started and comes to an end.
        self._lock = threading.Lock()
        self._is_open = False
        self._error: BaseException | None = None

    # life

    def start(self) -> Self:
        """Start the thread and the node; ``with`` does this.

        Raises as :meth:`Node.start` does, and :class:`RuntimeError` when it was already
        started.
        """
        with self._lock:
            if self._thread is not None:
                raise RuntimeError(f"node {self.node.name} was started before; make a new one")
            # A daemon, so that a program that forgets to close it can exit and close() runs.
            thread = threading.Thread(
                target=self._run_loop, name=f"node {self.node.name}", daemon=True
            )
            thread.start()
            self._thread = thread
            atexit.register(self.close)
        try:
            _result(self._started)
        except BaseException:  # KeyboardInterrupt too
            self.close()
            raise
        return self

    def close(self, timeout: float | None = None) -> None:
        """Close the node, and return when its thread has ended.

        You may call it any number of times, in any thread. ``timeout`` is as for
        :meth:`Node.close`. In the node's own thread it only starts to close.
        """
        if self._thread is None or self._is_left_behind:
            return
        self._started.exception()  # waits until it has started or failed to
        with self._lock:
            if self._is_open:
                self._schedule(self.node.close(timeout), None, Future())
                self._is_open = False
        if not self._is_inside():
            self._thread.join()
            atexit.unregister(self.close)

    @property
    def is_open(self) -> bool:
        """Whether the node is open and takes work."""
        return self._is_open and not self._is_left_behind

    def __enter__(self) -> Self:
        return self.start()

    def __exit__(
        self,
        exc_type: type[BaseException] | None,
        exc: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()
        # Like `async with node`: raise the error that closed the node in place of the
        # ClosedError that followed from it.
        if self._error is not None and (exc is None or isinstance(exc, ClosedError)):
            raise self._error

    # use

    def run(self, awaitable: Awaitable[T], timeout: float | None = None) -> T:
        """Await ``awaitable`` in the node's loop, and return its result or raise its error.

        After ``timeout`` seconds it is cancelled and this raises :class:`TimeoutError`. An
        interrupt of this wait, such as Ctrl-C, cancels it too. Raises
        :class:`~aioros1.ClosedError`, and :class:`RuntimeError` in the node's own thread,
        which would wait for itself.
        """
        return self._wait(awaitable, timeout)

    @overload
    def call(
        self, function: Callable[P, Awaitable[T]], /, *args: P.args, **kwargs: P.kwargs
    ) -> T: ...
    @overload
    def call(self, function: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> T: ...
    def call(self, function: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Any:
        """Call a function or coroutine function in the node's thread; returns its result.

        Raises as :meth:`run` does.
        """
        return self._wait(_call(function, args, kwargs))

    def submit(self, awaitable: Awaitable[T]) -> Future[T]:
        """Await ``awaitable`` in the node's loop without waiting for it here.

        Cancelling the future cancels the awaitable. Raises :class:`~aioros1.ClosedError`.
        """
        future: Future[T] = Future()
        self._submit(awaitable, None, future)
        return future

    def iterate(self, source: AsyncIterable[T]) -> Iterator[T]:
        """Iterate in this thread over a subscriber, a rate or another asynchronous iterable.

        Ends with ``source`` or with the node.
        """
        try:
            iterator: AsyncIterator[T] = self.call(aiter, source)
            while (item := self.call(_next, iterator)) is not _END:
                yield item
        except ClosedError:
            if self._is_open:
                raise

    def deliver(self, source: AsyncIterable[T], function: Callable[[T], object]) -> Future[None]:
        """Call ``function`` with every item of ``source``, in the node's thread.

        The function has to return soon, because the node waits for it. Good choices are
        ``put`` of a :class:`queue.SimpleQueue`, ``append`` of a :class:`collections.deque`,
        or a GUI toolkit's way to hand work to its own thread. The node's ``on_error`` handles
        exceptions. The future ends with ``source``; cancel it to stop earlier. Raises
        :class:`~aioros1.ClosedError`.
        """
        return self.submit(self._deliver(source, function))

    def __repr__(self) -> str:
        return f"<NodeThread {self.node.name} at {self.node.master_uri}, {self.node.state}>"

    # inside, called in any thread

    def _is_inside(self) -> bool:
        return threading.current_thread() is self._thread

    @property
    def _is_left_behind(self) -> bool:
        """Whether this process was forked from the one that has the thread."""
        return self._is_open and self._thread is not None and not self._thread.is_alive()

    def _closed_error(self) -> ClosedError:
        if self._is_left_behind:
            return ClosedError(
                f"node {self.node.name} is in the process that this one was forked from; "
                "make a new one here"
            )
        state = "closing" if self.node.state == "open" else self.node.state
        why = f" ({reason})" if (reason := self.node.close_reason) is not None else ""
        return ClosedError(f"node {self.node.name} is {state}, not open{why}")

    def _wait(self, awaitable: Awaitable[T], timeout: float | None = None) -> T:
        if self._is_inside():
            _discard(awaitable)
            raise RuntimeError(
                f"the thread of node {self.node.name} would wait for itself; use await there"
            )
        # Made here, so that an interrupt anywhere below finds it.
        future: Future[T] = Future()
        try:
            self._submit(awaitable, timeout, future)
            return _result(future)
        except BaseException:
            future.cancel()
            raise

    def _submit(self, awaitable: Awaitable[T], timeout: float | None, future: Future[T]) -> None:
        if not isinstance(awaitable, Awaitable):
            raise TypeError(f"expected an awaitable, got {awaitable!r}; call() is for functions")
        if not self._is_left_behind:  # in a forked process nobody would release the lock
            with self._lock:
                if self._is_open:
                    self._schedule(awaitable, timeout, future)
                    return
        _discard(awaitable)
        raise self._closed_error()

    def _schedule(self, awaitable: Awaitable[T], timeout: float | None, future: Future[T]) -> None:
        assert self._loop is not None
        self._loop.call_soon_threadsafe(self._begin, awaitable, timeout, future)

    # inside, in the node's thread

    def _run_loop(self) -> None:
        try:
            with asyncio.Runner(loop_factory=self._loop_factory) as runner:
                runner.run(self._live())
        except BaseException as error:
            self._error = error
            if not self._started.done():
                self._started.set_exception(error)

    async def _live(self) -> None:
        self._loop = asyncio.get_running_loop()
        try:
            async with self.node:
                self._is_open = True
                self._started.set_result(None)
                await self.node.wait_closed()
        finally:
            with self._lock:
                self._is_open = False
            await self._finish()

    async def _finish(self) -> None:
        """Let submitted coroutines end, so that nobody waits for ever."""
        await asyncio.sleep(0)  # the coroutine submitted last becomes a task ...
        await asyncio.sleep(0)  # ... and begins
        tasks = asyncio.all_tasks() - {asyncio.current_task()}
        if tasks:
            _, late = await asyncio.wait(tasks, timeout=_GRACE)
            for task in late:
                task.cancel()
            if late:
                await asyncio.wait(late)

    def _begin(self, awaitable: Awaitable[T], timeout: float | None, future: Future[T]) -> None:
        loop = asyncio.get_running_loop()
        task = loop.create_task(self._serve(awaitable, timeout, future), name=_name(awaitable))

        def cancel(future: Future[T]) -> None:
            if future.cancelled():
                with contextlib.suppress(RuntimeError):  # the loop has ended, and so has the task
                    loop.call_soon_threadsafe(task.cancel)

        future.add_done_callback(cancel)

    async def _serve(
        self, awaitable: Awaitable[T], timeout: float | None, future: Future[T]
    ) -> None:
        """Await ``awaitable``, and set its result or error in ``future``."""
        result: Any = None
        error: BaseException | None = None
        limit = asyncio.timeout(timeout)
        try:
            async with limit:
                result = await awaitable
        except asyncio.CancelledError:
            if self._is_open:
                future.cancel()
            else:
                error = self._closed_error()  # the user did not cancel it
        except TimeoutError as caught:
            error = caught
            if limit.expired():
                error = TimeoutError(f"{_name(awaitable)} did not end within {timeout:g} s")
        except BaseException as caught:  # SystemExit too is for the caller, not the loop
            error = caught
        if not future.set_running_or_notify_cancel():
            return
        if error is None:
            future.set_result(result)
        else:
            future.set_exception(error)

    async def _deliver(self, source: AsyncIterable[T], function: Callable[[T], object]) -> None:
        async for item in source:
            try:
                function(item)
            except Exception as error:
                self.node.handle_error(error, f"the callback {_name(function)}")


def _result(future: Future[T]) -> T:
    is_main = threading.current_thread() is threading.main_thread()
    while not future.done():
        with contextlib.suppress(TimeoutError):
            future.exception(_LOOK if is_main else None)
    return future.result()


async def _call(function: Callable[..., Any], args: tuple[Any, ...], kwargs: Any) -> Any:
    result = function(*args, **kwargs)
    return await result if isinstance(result, Awaitable) else result


async def _next(iterator: AsyncIterator[T]) -> T:
    return await anext(iterator, _END)


def _discard(awaitable: Awaitable[Any]) -> None:
    """Close a coroutine that will not be awaited, because Python warns about those."""
    close = getattr(awaitable.__await__(), "close", None)
    if close is not None:
        close()


def _name(what: object) -> str:
    return getattr(what, "__qualname__", None) or type(what).__name__
