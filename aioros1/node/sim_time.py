"""Which time a node follows: the parameter ``/use_sim_time`` and the topic ``/clock``.

https://wiki.ros.org/Clock
"""

from __future__ import annotations

import asyncio

from aioros1.core.context import Context
from aioros1.errors import MasterError
from aioros1.params.params import Params
from aioros1.topics.options import SubscriberOptions
from aioros1.topics.topics import Topics

__all__ = ["SimTime"]

_RETRY = 1.0

_SILENCE = 5.0
"""Seconds without a message on ``/clock`` before the node warns."""


class SimTime:
    """Makes the clock of a node follow ``/clock`` while simulated time is enabled.

    It is enabled while ``/use_sim_time`` is true, unless the options of the node decide. If
    the parameter was deleted, or is gone with its master, the node keeps the time it follows.
    """

    def __init__(self, context: Context, topics: Topics, params: Params) -> None:
        self._context = context
        self._topics = topics
        self._params = params
        self._following: asyncio.Task[None] | None = None

    async def ask(self) -> None:
        """Ask which time to follow, and follow it from now on.

        This happens with each heartbeat. Subscribing to the parameter would be quicker, but
        masters keep the subscriptions of killed nodes forever, and nothing cleans them up.
        Raises :class:`~aioros1.MasterError`.
        """
        wanted = self._context.options.use_sim_time
        if wanted is None:
            wanted = await self._params.get("/use_sim_time", None)
        if wanted is None or bool(wanted) is (self._following is not None):
            return
        clock = self._context.clock
        if wanted:
            clock.simulate()
            self._following = self._context.spawn(self._follow, name=f"{self._context.name} clock")
        elif self._following is not None:
            self._following.cancel()
            self._following = None
            clock.stop_simulating()

    async def _follow(self) -> None:
        """Take the time from ``/clock`` as soon as the master accepts the subscription."""
        while True:
            try:
                await self._take_time()
            except MasterError:
                await self._context.pause(_RETRY)
            else:
                return

    async def _take_time(self) -> None:
        clock = self._context.clock
        options = SubscriberOptions(queue_size=1)
        sub = await self._topics.subscribe(
            "/clock", "rosgraph_msgs/Clock", None, options, warns=False
        )
        async with sub:
            try:
                clock.set((await sub.get(timeout=_SILENCE)).clock)
            except TimeoutError:
                self._context.log.warning(
                    "time is simulated, but nothing came on /clock in %g s: it stands at zero, "
                    "and nothing that waits for it goes on",
                    _SILENCE,
                )
            async for message in sub:
                clock.set(message.clock)
