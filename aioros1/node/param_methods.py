"""The parameter server, as a node uses it."""

from __future__ import annotations

import asyncio
import sys
from abc import ABC, abstractmethod
from collections.abc import Awaitable, Callable
from typing import TYPE_CHECKING, Any

from aioros1.core.role import Opening
from aioros1.errors import ClosedError, MasterError, MasterUnreachable
from aioros1.params.subscriber import ParamSubscriber
from aioros1.wire.xmlrpc import decode_response, encode_response

if TYPE_CHECKING:
    from aioros1.node.node_roles import Roles
    from aioros1.xmlrpc.master_proxy import MasterProxy

__all__ = ["ParamCalls"]


class ParamCalls(ABC):
    """The part of :class:`Node` that is about parameters."""

    master: MasterProxy
    _roles: Roles

    def __init__(self) -> None:
        self._cached: dict[str, ParamSubscriber] = {}
        self._left_alone: set[asyncio.Future[Exception | None]] = set()
        """Changes on their way to the master, for which nobody waits any more."""

    @abstractmethod
    def resolve_name(self, name: str) -> str: ...

    @abstractmethod
    def _check_open(self) -> None: ...

    @abstractmethod
    def _spawn(
        self, function: Callable[..., Awaitable[Any]], *args: Any, name: str
    ) -> asyncio.Task[None]: ...

    def subscribe_param(self, key: str, *, default: Any = ...) -> Opening[ParamSubscriber]:
        """Follow a parameter and all below it.

        ``default`` is its value while it is not set. Raises
        :class:`~aioros1.MasterError`, :class:`~aioros1.InvalidNameError` and
        :class:`~aioros1.ClosedError`.
        """
        return Opening(self._roles.subscribe_param(key, default))

    async def get_param(self, key: str, default: Any = ...) -> Any:
        """The value of a parameter, or a dict of all below it.

        Raises :class:`KeyError` when it is not set and there is no default,
        :class:`~aioros1.MasterUnreachable`, and :class:`~aioros1.MasterError` for an answer
        that cannot be read, because it is beyond the limits perhaps.
        """
        key = self._param_key(key)
        try:
            return await self.master.get_param(key)
        except MasterError as error:
            if not error.is_refusal:
                raise
            if default is ...:
                raise KeyError(key) from None
            return default

    async def set_param(self, key: str, value: Any) -> None:
        """Set a parameter: bool, int, float, str, list, dict, bytes or datetime.

        Raises :class:`TypeError`, :class:`ValueError` or :class:`OverflowError` for what
        XML-RPC cannot carry, and :class:`~aioros1.MasterError`. When it is cancelled the
        parameter is set all the same, before whatever is set or deleted next.
        """
        key = self._param_key(key)
        # What we tell is what arrives: a list for a tuple, and nothing that the caller can
        # still change. Limits are for what others send.
        document = encode_response(value, what=f"parameter {key}")
        value = decode_response(document, max_values=sys.maxsize)
        await self._change(key, value, lambda: self.master.set_param(key, value))

    async def has_param(self, key: str) -> bool:
        """Whether a parameter is set. Raises :class:`~aioros1.MasterError`."""
        return await self.master.has_param(self._param_key(key))

    async def delete_param(self, key: str) -> None:
        """Delete a parameter and all below it.

        Raises :class:`KeyError` when it is not set, :class:`~aioros1.MasterUnreachable`, and
        :class:`~aioros1.MasterError` for an answer that is none of a master. When it is
        cancelled it goes on, as :meth:`set_param` does.
        """
        key = self._param_key(key)
        try:
            await self._change(key, {}, lambda: self.master.delete_param(key))
        except MasterError as error:
            if not error.is_refusal:
                raise
            raise KeyError(key) from None

    async def _change(
        self, key: str, value: Any, tell_master: Callable[[], Awaitable[None]]
    ) -> None:
        """Change a parameter, in a task of the node.

        Who is cancelled cannot know whether the master has got it. So it is not given up
        half-way, which would leave those who follow the parameter here with another value
        than the master has; and the next change must not overtake it.
        """
        while self._left_alone:
            await asyncio.wait(self._left_alone)
        outcome: asyncio.Future[Exception | None] = asyncio.get_running_loop().create_future()
        task = self._spawn(self._changing, outcome, key, value, tell_master, name=f"change {key}")
        task.add_done_callback(lambda _: _end(outcome, key))
        try:
            await asyncio.wait((outcome,))
        except asyncio.CancelledError:
            if not outcome.done():
                self._left_alone.add(outcome)
                outcome.add_done_callback(self._left_alone.discard)
            raise
        if (error := outcome.result()) is not None:
            raise error

    async def _changing(
        self,
        outcome: asyncio.Future[Exception | None],
        key: str,
        value: Any,
        tell_master: Callable[[], Awaitable[None]],
    ) -> None:
        try:
            await tell_master()
            # The master tells everybody but the one who did it.
            self._roles.param_updated(key, value)
        except Exception as error:
            if isinstance(error, MasterUnreachable):
                self._roles.param_in_doubt(key)
            outcome.set_result(error)
        else:
            outcome.set_result(None)

    async def search_param(self, key: str) -> str | None:
        """The full key of the nearest parameter of that name: in the node's private
        namespace, then in its namespace and up to the root. None if there is none.

        Raises :class:`~aioros1.MasterUnreachable`, and :class:`~aioros1.MasterError` for an
        answer that is none of a master.
        """
        try:
            return await self.master.search_param(key)
        except MasterError as error:
            if not error.is_refusal:
                raise
            return None

    async def get_param_names(self) -> list[str]:
        """The keys of all parameters. Raises :class:`~aioros1.MasterError`."""
        return await self.master.get_param_names()

    async def get_param_cached(self, key: str, default: Any = ...) -> Any:
        """As :meth:`get_param`, but follows the parameter from the first time on, so that
        the master is not asked again."""
        resolved = self._param_key(key)
        subscriber = self._cached.get(resolved)
        if subscriber is None:
            subscriber = await self.subscribe_param(resolved)
            # Somebody else may have done the same in the meantime.
            if resolved in self._cached:
                await subscriber.close()
            subscriber = self._cached.setdefault(resolved, subscriber)
        try:
            return subscriber.value
        except KeyError:
            if default is ...:
                raise
            return default

    def _param_key(self, key: str) -> str:
        self._check_open()
        return "/" if key == "/" else self.resolve_name(key)


def _end(outcome: asyncio.Future[Exception | None], key: str) -> None:
    if not outcome.done():  # the node has ended, perhaps before the task began
        outcome.set_result(ClosedError(f"parameter {key}: the node is closed"))
