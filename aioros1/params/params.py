"""All parameters of one node."""

from __future__ import annotations

import asyncio
import sys
from collections.abc import Awaitable, Callable
from typing import Any

from aioros1.core.context import Context
from aioros1.errors import ClosedError, MasterError, MasterUnreachable
from aioros1.options import WithoutMaster
from aioros1.params.cache import ParamCache
from aioros1.params.followed import FollowedParam
from aioros1.params.subscriber import ParamSubscriber
from aioros1.wire.xmlrpc import decode_response, encode_response

__all__ = ["Params"]


class Params:
    """The parameters that a node reads, changes and follows at the parameter server."""

    def __init__(self, context: Context) -> None:
        self.followed: dict[str, FollowedParam] = {}
        """By key, for as long as a subscriber uses them."""
        self._context = context
        self._cache = ParamCache(self.subscribe)
        # Changes on their way to the master whose callers were cancelled.
        self._left_alone: set[asyncio.Future[Exception | None]] = set()

    async def subscribe(
        self,
        key: str,
        default: Any,
        without_master: WithoutMaster = "raise",
        *,
        keeps_updates: bool = True,
    ) -> ParamSubscriber:
        """See :meth:`aioros1.Node.subscribe_param`.

        Without ``keeps_updates`` there is nothing to iterate over.
        """
        context = self._context
        key = self._key(key)
        followed = self.followed.get(key)
        if followed is None:
            followed = FollowedParam(context, key, self.followed)
        subscriber = ParamSubscriber(context, followed, default, keeps_updates)
        await followed.acquire(subscriber, without_master)
        await context.admit(subscriber, subscriber._abort)
        followed.keep_true()
        subscriber._begin()
        return subscriber

    async def get(self, key: str, default: Any = ...) -> Any:
        """See :meth:`aioros1.Node.get_param`."""
        key = self._key(key)
        try:
            return await self._context.master.get_param(key)
        except MasterError as error:
            if not error.is_refusal:
                raise
            if default is ...:
                raise KeyError(key) from None
            return default

    async def set(self, key: str, value: Any) -> None:
        """See :meth:`aioros1.Node.set_param`."""
        key = self._key(key)
        # Announce here what arrives at the master: a list for a tuple, and nothing that the
        # caller can still change. Limits apply only to what others send.
        document = encode_response(value, what=f"parameter {key}")
        value = decode_response(document, max_values=sys.maxsize)
        await self._change(key, value, lambda: self._context.master.set_param(key, value))

    async def has(self, key: str) -> bool:
        """See :meth:`aioros1.Node.has_param`."""
        return await self._context.master.has_param(self._key(key))

    async def delete(self, key: str) -> None:
        """See :meth:`aioros1.Node.delete_param`."""
        key = self._key(key)
        try:
            await self._change(key, {}, lambda: self._context.master.delete_param(key))
        except MasterError as error:
            if not error.is_refusal:
                raise
            raise KeyError(key) from None

    async def search(self, key: str) -> str | None:
        """See :meth:`aioros1.Node.search_param`."""
        try:
            return await self._context.master.search_param(key)
        except MasterError as error:
            if not error.is_refusal:
                raise
            return None

    async def names(self) -> list[str]:
        """See :meth:`aioros1.Node.get_param_names`."""
        return await self._context.master.get_param_names()

    async def get_cached(self, key: str, default: Any = ...) -> Any:
        """See :meth:`aioros1.Node.get_param_cached`."""
        return await self._cache.get(self._key(key), default)

    def announced(self, key: str, value: Any) -> bool:
        """Pass a notice of the master on to the parameters it concerns; returns whether there
        are any."""
        concerned = self._concerned(key)
        for followed in concerned:
            followed.announced(key, value)
        return bool(concerned)

    def _concerned(self, key: str) -> list[FollowedParam]:
        return [followed for followed in self.followed.values() if followed.concerns(key)]

    async def _change(
        self, key: str, value: Any, tell_master: Callable[[], Awaitable[None]]
    ) -> None:
        """Change a parameter, in a task of the node.

        A cancelled caller cannot know whether the master got the change. So the change runs
        to its end: giving up half-way could leave the node's followers of the parameter with
        another value than the master. The next change must not overtake it either.
        """
        while self._left_alone:
            await asyncio.wait(self._left_alone)
        outcome: asyncio.Future[Exception | None] = asyncio.get_running_loop().create_future()
        task = self._context.spawn(
            self._changing, outcome, key, value, tell_master, name=f"change {key}"
        )
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
        concerned = self._concerned(key)
        for followed in concerned:
            followed.change_begins()
        try:
            await tell_master()
            # The master tells everybody except the node that made the change.
            for followed in self._concerned(key):
                followed.changed(key, value)
        except Exception as error:
            if isinstance(error, MasterUnreachable):  # it may have made the change
                for followed in self._concerned(key):
                    followed.doubt()
            outcome.set_result(error)
        else:
            outcome.set_result(None)
        finally:
            for followed in concerned:
                followed.change_ends()
            for followed in self._concerned(key):
                if followed not in concerned:  # it did not know, and may have believed a notice
                    followed.doubt()

    def _key(self, key: str) -> str:
        self._context.check_open()
        return "/" if key == "/" else self._context.resolve_name(key)


def _end(outcome: asyncio.Future[Exception | None], key: str) -> None:
    if not outcome.done():  # the node was closed, perhaps before the task began
        outcome.set_result(ClosedError(f"parameter {key}: the node is closed"))
