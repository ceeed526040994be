"""The parameter methods of a node."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from typing import Any, TypeVar

from aioros1.core.contact import Contact
from aioros1.core.opening import Opening
from aioros1.hints import explained, methods_of
from aioros1.node.introduction import Introduction
from aioros1.params.params import Params
from aioros1.params.subscriber import ParamSubscriber

__all__ = ["ParamMethods"]

T = TypeVar("T")


@methods_of("Node")
class ParamMethods:
    """The parameter methods of :class:`~aioros1.Node`."""

    _contact: Contact
    _introduction: Introduction
    _params: Params

    @explained
    def subscribe_param(self, key: str, *, default: Any = ...) -> Opening[ParamSubscriber]:
        """Follow a parameter and everything below it.

        ``default`` is its value while it is not set. Raises
        :class:`~aioros1.MasterError`, :class:`~aioros1.InvalidNameError` and
        :class:`~aioros1.ClosedError`.
        """
        opening = self._params.subscribe(key, default, self._contact.policy)
        return Opening(opening, "subscribe_param", f"subscriber of parameter {key}")

    async def get_param(self, key: str, default: Any = ...) -> Any:
        """Return the value of a parameter, or a dict of everything below it.

        Raises :class:`KeyError` when it is not set and there is no default,
        :class:`~aioros1.MasterUnreachable`, and :class:`~aioros1.MasterError` for an answer
        that cannot be read, for example because it exceeds the limits.
        """
        return await self._ask(lambda: self._params.get(key, default))

    async def set_param(self, key: str, value: Any) -> None:
        """Set a parameter to a bool, int, float, str, list, dict, bytes or datetime.

        Raises :class:`TypeError`, :class:`ValueError` or :class:`OverflowError` for values
        that XML-RPC cannot carry, and :class:`~aioros1.MasterError`. If you cancel the call,
        the parameter is still set, before the next one is set or deleted.
        """
        await self._ask(lambda: self._params.set(key, value))

    async def has_param(self, key: str) -> bool:
        """Whether a parameter is set. Raises :class:`~aioros1.MasterError`."""
        return await self._ask(lambda: self._params.has(key))

    async def delete_param(self, key: str) -> None:
        """Delete a parameter and everything below it.

        Raises :class:`KeyError` when it is not set, :class:`~aioros1.MasterUnreachable`, and
        :class:`~aioros1.MasterError` for an answer that is not a master's. If you cancel the
        call, the parameter is still deleted, as with :meth:`set_param`.
        """
        await self._ask(lambda: self._params.delete(key))

    async def search_param(self, key: str) -> str | None:
        """Return the full key of the nearest parameter of that name: in the node's private
        namespace, then in its namespace and up to the root. None if there is none.

        Raises :class:`~aioros1.MasterUnreachable`, and :class:`~aioros1.MasterError` for an
        answer that is not a master's.
        """
        return await self._ask(lambda: self._params.search(key))

    async def get_param_names(self) -> list[str]:
        """Return the keys of all parameters. Raises :class:`~aioros1.MasterError`."""
        return await self._ask(lambda: self._params.names())

    async def get_param_cached(self, key: str, default: Any = ...) -> Any:
        """Like :meth:`get_param`, but follow the parameter from the first call on, so that
        later calls do not ask the master.

        The node follows up to 256 parameters in this way. The one that was not asked for
        longest makes room for another.
        """
        return await self._ask(lambda: self._params.get_cached(key, default))

    async def _ask(self, ask: Callable[[], Awaitable[T]]) -> T:
        """Ask the master, once it has the parameters of the command line."""

        async def introduced() -> T:
            await self._introduction.make()
            return await ask()

        return await self._contact.reach(introduced)
