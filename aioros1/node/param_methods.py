"""The methods of a node that are about parameters."""

from __future__ import annotations

from typing import Any

from aioros1.core.opening import Opening
from aioros1.params.params import Params
from aioros1.params.subscriber import ParamSubscriber

__all__ = ["ParamMethods"]


class ParamMethods:
    """The part of :class:`~aioros1.Node` that is about parameters."""

    _params: Params

    def subscribe_param(self, key: str, *, default: Any = ...) -> Opening[ParamSubscriber]:
        """Follow a parameter and all below it.

        ``default`` is its value while it is not set. Raises
        :class:`~aioros1.MasterError`, :class:`~aioros1.InvalidNameError` and
        :class:`~aioros1.ClosedError`.
        """
        return Opening(self._params.subscribe(key, default), f"subscriber of parameter {key}")

    async def get_param(self, key: str, default: Any = ...) -> Any:
        """The value of a parameter, or a dict of all below it.

        Raises :class:`KeyError` when it is not set and there is no default,
        :class:`~aioros1.MasterUnreachable`, and :class:`~aioros1.MasterError` for an answer
        that cannot be read, because it is beyond the limits perhaps.
        """
        return await self._params.get(key, default)

    async def set_param(self, key: str, value: Any) -> None:
        """Set a parameter: bool, int, float, str, list, dict, bytes or datetime.

        Raises :class:`TypeError`, :class:`ValueError` or :class:`OverflowError` for what
        XML-RPC cannot carry, and :class:`~aioros1.MasterError`. When it is cancelled the
        parameter is set all the same, before whatever is set or deleted next.
        """
        await self._params.set(key, value)

    async def has_param(self, key: str) -> bool:
        """Whether a parameter is set. Raises :class:`~aioros1.MasterError`."""
        return await self._params.has(key)

    async def delete_param(self, key: str) -> None:
        """Delete a parameter and all below it.

        Raises :class:`KeyError` when it is not set, :class:`~aioros1.MasterUnreachable`, and
        :class:`~aioros1.MasterError` for an answer that is none of a master. When it is
        cancelled it goes on, as :meth:`set_param` does.
        """
        await self._params.delete(key)

    async def search_param(self, key: str) -> str | None:
        """The full key of the nearest parameter of that name: in the node's private
        namespace, then in its namespace and up to the root. None if there is none.

        Raises :class:`~aioros1.MasterUnreachable`, and :class:`~aioros1.MasterError` for an
        answer that is none of a master.
        """
        return await self._params.search(key)

    async def get_param_names(self) -> list[str]:
        """The keys of all parameters. Raises :class:`~aioros1.MasterError`."""
        return await self._params.names()

    async def get_param_cached(self, key: str, default: Any = ...) -> Any:
        """As :meth:`get_param`, but follows the parameter from the first time on, so that
        the master is not asked again."""
        return await self._params.get_cached(key, default)
