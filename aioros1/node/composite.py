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
    :meth:`_own`, :meth:`_create_task` and :meth:`_check_open` are there to be used. All other
    names are free for them.
    """

    # What is our own has two underscores: derived classes choose names without looking here.

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
        """The node that it lives on."""
        return self.__node

    @property
    def name(self) -> str:
        """What tells it from others of its kind."""
        return self.__name

    @property
    def is_open(self) -> bool:
        """Whether it can be used."""
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
        """Close it, with all that it owns. What is being opened is given up.

        You may call it any number of times. When the wait is cancelled, closing goes on. An
        exception of :meth:`_close` is logged.
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
        """Open what it is made of. Called once."""

    async def _close(self) -> None:
        """Say what is to be said to others. All that it owns is still open."""

    def _abort(self) -> None:
        """The node has ended: wake up whoever waits here, tell nobody."""

    async def _own(self, opening: Awaitable[M]) -> M:
        """Await what ``node.advertise`` and the like, or another composite, give; the open
        object, which is closed with this one."""
        member = await opening
        if self.__state not in ("opening", "open"):
            await member.close()
            raise self.__closed_error()
        if isinstance(member, Composite):
            # It is closed by this one and not by the node, which would do so too soon.
            self.__node._context.members.pop(member, None)
        self.__owned.append(member)
        return member

    def _create_task(
        self, coro: Coroutine[Any, Any, object], *, name: str | None = None
    ) -> asyncio.Task[None]:
        """Run a coroutine in a task that is cancelled when this is closed; otherwise as
        :meth:`aioros1.Node.create_task`."""
        if self.__state not in ("opening", "open"):
            coro.close()
            raise self.__closed_error()
        task = self.__node.create_task(coro, name=name)
        self.__tasks.add(task)
        task.add_done_callback(self.__tasks.discard)
        return task

    def _check_open(self) -> None:
        """Raise :class:`~aioros1.ClosedError` unless it is open, and :class:`RuntimeError`
        in another event loop than the node's."""
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
        # In a task of its own, so that closing can end it, whoever closes.
        opening = self.__opening = asyncio.create_task(self.__run_open(), name=f"open {self!r}")
        try:
            await asyncio.wait({opening})
        except asyncio.CancelledError:
            await self.close()
            raise
        if not opening.cancelled() and opening.exception() is None:
            return self  # one of its tasks may have closed it already
        was_closed = self.__state == "closed"
        await self.close()
        if was_closed:
            raise self.__closed_error()
        await opening  # which raises
        raise AssertionError("opening had failed")

    async def __run_open(self) -> None:
        await self._open()
        if self.__state != "opening":
            raise self.__closed_error()
        self.__state = "open"

    def __end(self) -> None:
        """Begin to close, once, in a task of the node, which no cancellation reaches."""
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
            opening.exception()  # whoever opens it gets that, if it still wants to know

    async def __release(self) -> None:
        """Cancel the tasks, and close what is owned, the last first."""
        tasks = tuple(self.__tasks)
        for task in tasks:
            task.cancel()
        if tasks:
            await asyncio.wait(tasks)
        while self.__owned:
            await self.__owned.pop().close()

    def __drop(self) -> None:
        """The node has ended, and there was no time to close."""
        self.__state = "closed"
        if self.__opening is not None:
            self.__opening.cancel()
        for member in self.__owned:
            if isinstance(member, Composite):
                member.__drop()
        self._abort()

    def __closed_error(self) -> ClosedError:
        reason = self.__node.close_reason
        why = f": the node was closed ({reason})" if reason is not None else ""
        name = f"{type(self).__name__} {self.__name}".rstrip()
        return ClosedError(f"{name} is {self.__state}, not open{why}")

    def __repr__(self) -> str:
        name = f" {self.__name}" if self.__name else ""
        return f"<{type(self).__name__}{name} of {self.__node.name}, {self.__state}>"
