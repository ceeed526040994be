"""The base class of objects made of several roles that live on a node."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import Awaitable, Coroutine, Generator
from types import TracebackType
from typing import Any, Self, TypeVar

from aioros1._public import public
from aioros1.core.context import Member
from aioros1.errors import ClosedError
from aioros1.node.node import Node

__all__ = ["Composite"]

M = TypeVar("M", bound=Member)


@public
class Composite:
    """Several roles of one node, with their own tasks, as one object.

    Action clients, transform listeners and bag recorders are composites. Yours can be, too::

        class Relay(aioros1.Composite):
            def __init__(self, node, source, target, type):
                super().__init__(node, f"{source} to {target}")
                self._topics = source, target, type

            async def _open(self):
                source, target, type = self._topics
                self._pub = await self._own(self.node.advertise(target, type))
                self._sub = await self._own(self.node.subscribe(source, type))
                self._create_task(self._relay())

            async def _relay(self):
                async for message in self._sub:
                    self._pub.publish(message)

        async with Relay(node, "a", "b", "std_msgs/String"):
            ...

    The constructor does no I/O. ``async with x`` opens it and closes it at the end of the
    block; ``await x`` opens it and returns it. It closes when you call :meth:`close`, or with
    its node, before the node's roles. Closing cancels its tasks and then closes what it owns,
    in reverse order. If opening fails or is cancelled, what it has opened so far is closed.

    Methods that begin with an underscore are for derived classes. Override :meth:`_open`,
    :meth:`_close` and :meth:`_abort`, which the base class calls. Call :meth:`_own`,
    :meth:`_create_task` and :meth:`_check_open`. You may use any other name for your own
    attributes.
    """

    # Private names have two underscores, so that derived classes can choose names freely.

    def __init__(self, node: Node, name: str = "") -> None:
        if not isinstance(node, Node):
            raise TypeError(f"{type(self).__name__}: expected a Node first, got {node!r}")
        self.__node = node
        self.__name = name
        self.__state = "new"
        self.__owned: list[Any] = []
        self.__tasks: set[asyncio.Task[None]] = set()
        self.__opening: asyncio.Task[None] | None = None
        self.__closing: asyncio.Task[None] | None = None

    @property
    def node(self) -> Node:
        """The node that the composite lives on."""
        return self.__node

    @property
    def name(self) -> str:
        """The name that distinguishes it from others of its kind."""
        return self.__name

    @property
    def is_open(self) -> bool:
        """Whether you can use it."""
        return self.__state == "open"

    def __await__(self) -> Generator[Any, None, Self]:
        return self.__start().__await__()

    async def __aenter__(self) -> Self:
        return await self.__start()

    async def __aexit__(
        self,
        exc_type: type[BaseException] | None,
        exc: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        await self.close()

    async def close(self) -> None:
        """Close it and everything it owns. If it is still opening, that is cancelled.

        You may call it any number of times. If you cancel the call, closing continues. An
        exception in :meth:`_close` is logged.
        """
        if self.__state == "new":
            self.__state = "closed"
            return
        self.__node._context.check_loop()
        self.__end()
        if self.__closing is not None and self.__closing is not asyncio.current_task():
            await asyncio.wait({self.__closing})

    # for derived classes

    async def _open(self) -> None:
        """Open the parts of the composite. Called once."""

    async def _close(self) -> None:
        """Tell others that it closes. Everything it owns is still open."""

    def _abort(self) -> None:
        """Wake up everyone who waits for it, without telling peers: the node has ended."""

    async def _own(self, opening: Awaitable[M]) -> M:
        """Open a role, as returned by ``node.advertise`` and the like, or another composite.
        Return the open object, which closes with this one."""
        member = await opening
        if self.__state not in ("opening", "open"):
            await member.close()
            raise self.__closed_error()
        if isinstance(member, Composite):
            # This composite closes it; the node would do so too soon.
            self.__node._context.members.pop(member, None)
        self.__owned.append(member)
        return member

    def _create_task(
        self, coro: Coroutine[Any, Any, object], *, name: str | None = None
    ) -> asyncio.Task[None]:
        """Run a coroutine in a task that is cancelled when the composite closes. Otherwise like
        :meth:`aioros1.Node.create_task`."""
        if self.__state not in ("opening", "open"):
            coro.close()
            raise self.__closed_error()
        # It ends when this closes, not before: what cleans up may still use it.
        task = self.__node._create_task(coro, name, "closed")
        self.__tasks.add(task)
        task.add_done_callback(self.__tasks.discard)
        return task

    def _check_open(self) -> None:
        """Raise :class:`~aioros1.ClosedError` unless it is open, and :class:`RuntimeError`
        in an event loop other than the node's."""
        if self.__state != "open":
            raise self.__closed_error()
        self.__node._context.check_loop()

    # inside

    async def __start(self) -> Self:
        if self.__state != "new":
            raise RuntimeError(f"{self!r} was opened before; make a new one")
        context = self.__node._context
        context.check_open()
        self.__state = "opening"
        context.members[self] = self.__drop
        # In its own task, so that closing can cancel it from any task.
        opening = self.__opening = asyncio.create_task(self.__run_open(), name=f"open {self!r}")
        try:
            await asyncio.wait({opening})
        except asyncio.CancelledError:
            await self.close()
            raise
        if not opening.cancelled() and opening.exception() is None:
            return self  # one of its own tasks may have closed it already
        was_closed = self.__state == "closed"
        await self.close()
        if was_closed:
            raise self.__closed_error()
        await opening  # raises
        raise AssertionError("opening had failed")

    async def __run_open(self) -> None:
        await self._open()
        if self.__state != "opening":
            raise self.__closed_error()
        self.__state = "open"

    def __end(self) -> None:
        """Start to close, once, in a task of the node that callers cannot cancel."""
        if self.__closing is None and self.__state in ("opening", "open"):
            was_open = self.__state == "open"
            self.__state = "closed"
            try:
                self.__closing = self.__node._context.spawn(
                    self.__finish, was_open, name=f"close {self!r}"
                )
            except ClosedError:  # the node has ended
                self.__drop()

    async def __finish(self, was_open: bool) -> None:
        try:
            await self.__end_opening()
            if was_open:
                await self._close()
        finally:
            try:
                await self.__release()
            finally:
                self.__node._context.members.pop(self, None)

    async def __end_opening(self) -> None:
        opening = self.__opening
        assert opening is not None
        if not opening.done():
            opening.cancel()
            await asyncio.wait({opening})
        if not opening.cancelled():
            opening.exception()  # the caller that opens it still gets the exception, if it waits

    async def __release(self) -> None:
        """Cancel the tasks, then close what is owned in reverse order."""
        tasks = tuple(self.__tasks)
        for task in tasks:
            task.cancel()
        if tasks:
            await asyncio.wait(tasks)
        while self.__owned:
            await self.__owned.pop().close()

    def __drop(self) -> None:
        """Drop everything: the node has ended before the composite could close."""
        self.__state = "closed"
        if self.__opening is not None:
            self.__opening.cancel()
        with contextlib.ExitStack() as stack:  # one that fails keeps no other from being dropped
            stack.callback(self._abort)
            for member in self.__owned:
                if isinstance(member, Composite):
                    stack.callback(member.__drop)

    def __closed_error(self) -> ClosedError:
        reason = self.__node.close_reason
        why = f": the node was closed ({reason})" if reason is not None else ""
        name = f"{type(self).__name__} {self.__name}".rstrip()
        return ClosedError(f"{name} is {self.__state}, not open{why}")

    def __repr__(self) -> str:
        name = f" {self.__name}" if self.__name else ""
        return f"<{type(self).__name__}{name} of {self.__node.name}, {self.__state}>"
