"""The base of what is made of several roles of a node, and lives as long as it."""

from __future__ import annotations

import asyncio
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
    """Several roles of one node, with tasks of their own, as one object.

    Action clients, transform listeners and bag recorders are such, and yours may be::

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
    block; ``await x`` opens it and returns it. It is closed by :meth:`close`, or with its
    node, before the roles of that. Then its tasks are cancelled, and what it owns is closed,
    the last first. If opening fails or is cancelled, what it had opened so far is closed.

    Derived classes have the methods that begin with an underscore for themselves:
    :meth:`_open`, :meth:`_close` and :meth:`_abort` are called and may be replaced,
    :meth:`_own`, :meth:`_create_task` and :meth:`_check_open` are there to be used.
    """

    def __init__(self, node: Node, name: str = "") -> None:
        if not isinstance(node, Node):
            raise TypeError(f"{type(self).__name__}: expected a Node first, got {node!r}")
        self._node = node
        self._name = name
        self._state = "new"
        self._owned: list[Any] = []
        self._tasks: set[asyncio.Task[None]] = set()
        self._opening: asyncio.Task[None] | None = None
        self._closing: asyncio.Task[None] | None = None

    @property
    def node(self) -> Node:
        """The node that it lives on."""
        return self._node

    @property
    def name(self) -> str:
        """What tells it from others of its kind."""
        return self._name

    @property
    def is_open(self) -> bool:
        """Whether it can be used."""
        return self._state == "open"

    def __await__(self) -> Generator[Any, None, Self]:
        return self._start().__await__()

    async def __aenter__(self) -> Self:
        return await self._start()

    async def __aexit__(
        self,
        exc_type: type[BaseException] | None,
        exc: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        await self.close()

    async def close(self) -> None:
        """Close it, with all that it owns. What is being opened is given up.

        You may call it any number of times. When the wait is cancelled, closing goes on. An
        exception of :meth:`_close` is logged.
        """
        if self._state == "new":
            self._state = "closed"
            return
        self._node._context.check_loop()
        self._end()
        if self._closing is not None and self._closing is not asyncio.current_task():
            await asyncio.wait({self._closing})

    # for derived classes

    async def _open(self) -> None:
        """Open what it is made of. Called once."""

    async def _close(self) -> None:
        """Say what is to be said to others. All that it owns is still open."""

    def _abort(self) -> None:
        """The node has ended: wake up whoever waits here, tell nobody."""

    async def _own(self, opening: Awaitable[M]) -> M:
        """Await what ``node.advertise`` and the like, or another composite, give; the open
        object, which is closed with this one."""
        member = await opening
        if self._state not in ("opening", "open"):
            await member.close()
            raise self._closed_error()
        if isinstance(member, Composite):
            # It is closed by this one and not by the node, which would do so too soon.
            self._node._context.members.pop(member, None)
        self._owned.append(member)
        return member

    def _create_task(
        self, coro: Coroutine[Any, Any, object], *, name: str | None = None
    ) -> asyncio.Task[None]:
        """Run a coroutine in a task that is cancelled when this is closed; otherwise as
        :meth:`aioros1.Node.create_task`."""
        if self._state not in ("opening", "open"):
            coro.close()
            raise self._closed_error()
        task = self._node.create_task(coro, name=name)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
        return task

    def _check_open(self) -> None:
        """Raise :class:`~aioros1.ClosedError` unless it is open, and :class:`RuntimeError`
        in another event loop than the node's."""
        if self._state != "open":
            raise self._closed_error()
        self._node._context.check_loop()

    # inside

    async def _start(self) -> Self:
        if self._state != "new":
            raise RuntimeError(f"{self!r} was opened before; make a new one")
        context = self._node._context
        context.check_open()
        self._state = "opening"
        context.members[self] = self._drop
        # In a task of its own, so that closing can end it, whoever closes.
        opening = self._opening = asyncio.create_task(self._run_open(), name=f"open {self!r}")
        try:
            await asyncio.wait({opening})
        except asyncio.CancelledError:
            await self.close()
            raise
        if not opening.cancelled() and opening.exception() is None:
            return self  # one of its tasks may have closed it already
        was_closed = self._state == "closed"
        await self.close()
        if was_closed:
            raise self._closed_error()
        await opening  # which raises
        raise AssertionError("opening had failed")

    async def _run_open(self) -> None:
        await self._open()
        if self._state != "opening":
            raise self._closed_error()
        self._state = "open"

    def _end(self) -> None:
        """Begin to close, once, in a task of the node, which no cancellation reaches."""
        if self._closing is None and self._state in ("opening", "open"):
            was_open = self._state == "open"
            self._state = "closed"
            try:
                self._closing = self._node._context.spawn(
                    self._finish, was_open, name=f"close {self!r}"
                )
            except ClosedError:  # the node has ended
                self._drop()

    async def _finish(self, was_open: bool) -> None:
        try:
            await self._end_opening()
            if was_open:
                await self._close()
        finally:
            try:
                await self._release()
            finally:
                self._node._context.members.pop(self, None)

    async def _end_opening(self) -> None:
        opening = self._opening
        assert opening is not None
        if not opening.done():
            opening.cancel()
            await asyncio.wait({opening})
        if not opening.cancelled():
            opening.exception()  # whoever opens it gets that, if it still wants to know

    async def _release(self) -> None:
        """Cancel the tasks, and close what is owned, the last first."""
        tasks = tuple(self._tasks)
        for task in tasks:
            task.cancel()
        if tasks:
            await asyncio.wait(tasks)
        while self._owned:
            await self._owned.pop().close()

    def _drop(self) -> None:
        """The node has ended, and there was no time to close."""
        self._state = "closed"
        if self._opening is not None:
            self._opening.cancel()
        for member in self._owned:
            if isinstance(member, Composite):
                member._drop()
        self._abort()

    def _closed_error(self) -> ClosedError:
        reason = self._node.close_reason
        why = f": the node was closed ({reason})" if reason is not None else ""
        name = f"{type(self).__name__} {self._name}".rstrip()
        return ClosedError(f"{name} is {self._state}, not open{why}")

    def __repr__(self) -> str:
        name = f" {self._name}" if self._name else ""
        return f"<{type(self).__name__}{name} of {self._node.name}, {self._state}>"
