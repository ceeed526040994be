"""The first exchange between a node and its master, once there is one."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from aioros1.core.context import Context
from aioros1.errors import MasterError, MasterUnreachable
from aioros1.node.sim_time import SimTime
from aioros1.params.params import Params
from aioros1.topics.topics import Topics
from aioros1.waiting import Mutex

__all__ = ["Introduction"]


class Introduction:
    """Sets the private parameters of the command line, and asks which time to follow and
    whether to publish statistics."""

    def __init__(
        self,
        context: Context,
        topics: Topics,
        params: Params,
        sim_time: SimTime,
        private_params: Mapping[str, Any],
    ) -> None:
        self._context = context
        self._topics = topics
        self._params = params
        self._sim_time = sim_time
        self._private_params = private_params
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
        params = self._params
        try:
            for key, value in self._private_params.items():
                await params.set(f"~{key}", value)
            has_statistics = await params.get("/enable_statistics", False) is True
            await self._sim_time.ask()
        except MasterUnreachable:
            return False
        # Everything that may fail, and is then repeated, is done.
        if has_statistics:
            from aioros1.node.statistics import Statistics  # here, since few nodes need it

            context = self._context
            statistics = Statistics(context, self._topics, params)
            context.spawn(statistics.run, name=f"{context.name} statistics")
        return True
