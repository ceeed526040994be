"""The awaitable that opens a role."""

from __future__ import annotations

from collections.abc import Coroutine, Generator
from types import TracebackType
from typing import Any, Generic, Protocol, TypeVar

from aioros1._public import public

__all__ = ["Opening"]


class _Closable(Protocol):
    async def close(self) -> None: ...


R = TypeVar("R", bound=_Closable)


@public
class Opening(Generic[R]):
    """Opens a role: await it, or use it with ``async with``.

    ::

        pub = await node.advertise("chatter", String)    # closed by pub.close()
        async with node.advertise("chatter", String) as pub:
            ...                                          # closed at the end

    Nothing happens until you do.
    """

    __slots__ = ("_coroutine", "_role", "_what")

    def __init__(self, coroutine: Coroutine[Any, Any, R], what: str) -> None:
        # Keep the coroutine itself, not a function that makes it, so that Python warns if it
        # is never awaited.
        self._coroutine = coroutine
        self._what = what

    def __await__(self) -> Generator[Any, None, R]:
        return self._coroutine.__await__()

    async def __aenter__(self) -> R:
        self._role = await self._coroutine
        return self._role

    async def __aexit__(
        self,
        exc_type: type[BaseException] | None,
        exc: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        await self._role.close()

    def __repr__(self) -> str:
        return f"<Opening of {self._what}: await it, or use it with async with>"
