"""The base class of all roles of a node."""

from __future__ import annotations

import asyncio
import builtins
from abc import ABC, abstractmethod
from threading import get_ident
from types import TracebackType
from typing import TYPE_CHECKING, Any, ClassVar, Self

from aioros1._public import public
from aioros1.connection import ConnectionInfo
from aioros1.core.context import Context
from aioros1.core.stats import RoleStats
from aioros1.errors import ClosedError

__all__ = ["Role"]


@public
class Role(ABC):
    """A publisher, subscriber, service provider, service caller or parameter subscriber.

    A role is open from the moment its factory on :class:`~aioros1.Node` returns it. It closes
    when you call :meth:`close`, at the end of its ``async with`` block, or with its node.
    """

    kind = "role"
    """The kind of role, in a word or two."""

    _factory: ClassVar[str] = ""  # the method of a node that opens it

    if not TYPE_CHECKING:

        def __new__(cls, *args: Any, **kwargs: Any) -> Self:
            if not (args and isinstance(args[0], Context)):
                raise TypeError(
                    f"a {cls.kind} needs a node: use `await node.{cls._factory}(...)` in place of "
                    f"{cls.__name__}(...)"
                )
            return super().__new__(cls)

    def __init__(self, context: Context, name: str) -> None:
        self._context = context
        self._name = name
        self._is_open = True
        self._loop_state = context.loop_state
        self._closing: asyncio.Task[None] | None = None
        self.stats = RoleStats()
        """The role's counters."""

    @property
    def node(self) -> Any:
        """The :class:`~aioros1.Node` that the role belongs to."""
        return self._context.node

    @property
    def name(self) -> str:
        """The resolved name of the topic, service or parameter."""
        return self._name

    @property
    def type(self) -> str:
        """``pkg/Type``; ``*`` for any type, empty for a parameter."""
        return ""

    @property
    def md5sum(self) -> str:
        """The md5sum of the definition; ``*`` for any."""
        return ""

    @property
    def definition(self) -> str:
        """The full text of the definition, its dependencies included."""
        return ""

    @property
    def is_open(self) -> bool:
        """Whether you can use the role; False once it starts to close."""
        return self._is_open

    @property
    def connections(self) -> tuple[ConnectionInfo, ...]:
        """The TCPROS connections that the role uses now."""
        return ()

    async def close(self) -> None:
        """Unregister the role from the master and free its resources.

        You may call it any number of times. If the master is unreachable, the error is logged
        and not raised. If you cancel the call, closing continues.
        """
        self._start_closing()
        if self._closing is not None:
            await asyncio.wait({self._closing})

    def _start_closing(self) -> None:
        """Close in a task of the node, which goes on when whoever waits for it is cancelled."""
        if self._is_open:
            if get_ident() != self._loop_state.thread_id:
                self._context.check_loop()
            self._is_open = False
            self._closing = self._context.spawn(
                self._finish, name=f"close {self.kind} {self._name}"
            )

    @property
    def _is_closing(self) -> bool:
        return self._closing is not None and not self._closing.done()

    async def _finish(self) -> None:
        try:
            await self._close()
        finally:
            self._context.members.pop(self, None)

    @abstractmethod
    async def _close(self) -> None: ...

    def _abort(self) -> None:
        """Wake up everyone who waits for the role, without telling peers: the node has ended."""
        self._is_open = False

    def _check_open(self) -> None:
        if not self._is_open:
            raise self._closed_error()
        if get_ident() != self._loop_state.thread_id:
            self._context.check_loop()

    def _closed_error(self) -> ClosedError:
        reason = self._context.close_reason
        why = f": the node was closed ({reason})" if reason is not None else ""
        return ClosedError(f"{self.kind} {self._name} of {self._context.name} is closed{why}")

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(
        self,
        exc_type: builtins.type[BaseException] | None,
        exc: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        await self.close()

    def __repr__(self) -> str:
        state = "open" if self._is_open else "closed"
        kind = f" [{self.type}]" if self.type else ""
        return f"<{type(self).__name__} {self._name}{kind} of {self._context.name}, {state}>"
