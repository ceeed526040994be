"""The first exchange between a node and its master, once there is one."""

from __future__ import annotations

from collections.abc import Awaitable

from aioros1.core.context import Context
from aioros1.errors import MasterError, MasterUnreachable
from aioros1.events import Broadcast, Event, EventStream, MasterRestarted
from aioros1.node.private_params import PrivateParams
from aioros1.node.sim_time import SimTime
from aioros1.params.params import Params
from aioros1.topics.topics import Topics
from aioros1.waiting import Mutex

__all__ = ["Introduction"]

_RETRY = 1.0


class Introduction:
    """Sets the private parameters of the command line, and asks which time to follow and
    whether to publish statistics."""

    def __init__(
        self,
        context: Context,
        topics: Topics,
        params: Params,
        sim_time: SimTime,
        private_params: PrivateParams,
        events: Broadcast[Event],
    ) -> None:
        self._context = context
        self._topics = topics
        self._params = params
        self._sim_time = sim_time
        self._private_params = private_params.values
        self._warning = private_params.warning
        self._events = events
        self._mutex = Mutex()
        self._is_made = False

    async def make(self) -> bool:
        """Make the introduction, once in the life of a node; return whether it is made.

        It is not if the master does not answer throughout. Then call this again.
        """
        if not self._is_made:
            async with self._mutex:
                if not self._is_made:
                    try:
                        self._is_made = await self._was_made()
                    except MasterError:
                        self._is_made = True  # it was refused, and would be again
                        raise
        return self._is_made

    async def _was_made(self) -> bool:
        params, context = self._params, self._context
        if self._warning:
            context.log.warning("%s", self._warning)
            self._warning = ""
        try:
            for key, value in self._private_params.items():
                await params.set(f"~{key}", value)
            has_statistics = await self._told(params.get("/enable_statistics", False)) is True
            await self._told(self._sim_time.ask())
        except MasterUnreachable:
            return False
        # Everything that may fail, and is then repeated, is done.
        if has_statistics:
            from aioros1.node.statistics import Statistics  # here, since few nodes need it

            statistics = Statistics(context, self._topics, params)
            context.spawn(statistics.run, name=f"{context.name} statistics")
        if self._private_params:
            context.spawn(
                self._keep_private_params,
                self._events.subscribe(),
                name=f"{context.name} private parameters",
            )
        return True

    async def _keep_private_params(self, events: EventStream[Event]) -> None:
        """Set the private parameters that a master does not have after it was restarted."""
        async for event in events:
            while isinstance(event, MasterRestarted):
                try:
                    for key, value in self._private_params.items():
                        if not await self._params.has(f"~{key}"):
                            await self._params.set(f"~{key}", value)
                    break
                except MasterUnreachable:
                    await self._context.pause(_RETRY)
                except MasterError as error:
                    self._context.log.warning("cannot set a private parameter: %s", error)
                    break

    async def _told(self, answer: Awaitable[object]) -> object:
        """What the master tells; None if it is one that cannot."""
        try:
            return await answer
        except MasterUnreachable:
            raise
        except MasterError as error:
            self._context.log.debug("the master does not tell: %s", error)
            return None
