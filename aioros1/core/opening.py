"""The awaitable that opens a role."""

from __future__ import annotations

from collections.abc import Coroutine, Generator
from types import TracebackType
from typing import TYPE_CHECKING, Any, Generic, NoReturn, Protocol, TypeVar

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

    __slots__ = ("_coroutine", "_method", "_role", "_what")

    def __init__(self, coroutine: Coroutine[Any, Any, R], method: str, what: str) -> None:
        # Python names the coroutine if it is never awaited, and users know the method.
        named: Any = coroutine
        named.__qualname__ = f"Node.{method}"
        # Keep the coroutine itself, not a function that makes it, so that Python warns if it
        # is never awaited.
        self._coroutine = coroutine
        self._method = method
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

    if not TYPE_CHECKING:  # checkers find these mistakes by themselves
        # What people use an opening for when they forget to await it.

        def __getattr__(self, name: str) -> NoReturn:
            if name.startswith("_"):
                raise AttributeError(f"'Opening' object has no attribute {name!r}")
            raise AttributeError(f"'Opening' object has no attribute {name!r}: {self._not_open()}")

        def __call__(self, *args: object, **kwargs: object) -> NoReturn:
            raise TypeError(f"an Opening cannot be called: {self._not_open()}")

        def __aiter__(self) -> NoReturn:
            raise TypeError(f"an Opening has nothing to iterate over: {self._not_open()}")

        def __enter__(self) -> NoReturn:
            raise TypeError(f"an Opening needs `async with`, not `with`: {self._not_open()}")

        def __exit__(self, *exc_info: object) -> None: ...

        __iter__ = __aiter__

        def _not_open(self) -> str:
            return (
                f"the {self._what} is not open yet. Await the call that opens it, as in "
                f"`x = await node.{self._method}(...)`, or use it with `async with`"
            )
