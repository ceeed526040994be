"""Simulated time that a test drives."""

from __future__ import annotations

import asyncio
from types import TracebackType
from typing import Any, Self

from aioros1 import ClosedError, Duration, Node, Publisher, Time
from aioros1._public import public

__all__ = ["SimulatedClock"]

_PATIENCE = 5.0
"""Real seconds for a node to receive a new time, or for tasks to settle."""

_QUIET_TURNS = 5
"""Iterations of the event loop in which no task was ready to run. One is not enough:
``gather`` and the like wake through callbacks, one iteration for each."""


@public("aioros1.testing")
class SimulatedClock:
    """Publishes ``/clock``, and waits until its effects have happened.

    ::

        async with SimulatedClock(master.uri) as clock, Node("robot") as node:
            await clock.track(node)
            await clock.advance(10)

    Entering the block sets ``/use_sim_time`` to true and starts a node ``/simulated_clock``,
    which publishes, latched. The first time is ``start``, in seconds or as a
    :class:`~aioros1.Time`. It cannot be zero, which in ROS means that there is no time yet.
    Leaving the block deletes ``/use_sim_time``; nodes that are still open keep their time.

    :meth:`set` and :meth:`advance` return when two things have happened. First, every node
    that you gave to :meth:`track`, is open and follows ``/clock`` has the new time. Second,
    the tasks that it woke have run: each task of the event loop, except the caller, waits for
    something that has not happened, such as a later time, a message or real time. By then a
    sleep that is over has returned, and the code after it has run to its next wait; so have
    the bodies of rates and the callbacks of timers. Tasks also run in this way before the time
    changes, so a task that was just made has begun to wait. Messages on their way between
    nodes are not waited for, nor are other processes; they get ``/clock`` as from any
    simulator.
    """

    def __init__(self, master_uri: str | None = None, *, start: float | Time = 1.0) -> None:
        self._now = _moment(start)
        self._node = Node(
            "simulated_clock",
            namespace="/",
            master_uri=master_uri,
            rosout=False,
            logger_services=False,
            use_sim_time=False,
        )
        self._tracked: list[Node] = []
        self._lock = asyncio.Lock()
        self._publisher: Publisher[Any] | None = None

    async def __aenter__(self) -> Self:
        await self._node.__aenter__()
        try:
            await self._node.set_param("/use_sim_time", True)
            # No subscriber may miss a step, however quickly they come.
            self._publisher = await self._node.advertise(
                "/clock", "rosgraph_msgs/Clock", latch=True, overflow="block"
            )
            await self._publish(self._now)
        except BaseException:
            await self._node.close()
            raise
        return self

    async def __aexit__(
        self,
        exc_type: type[BaseException] | None,
        exc: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        try:
            if self._node.is_open and await self._node.has_param("/use_sim_time"):
                await self._node.delete_param("/use_sim_time")
        except ConnectionError:
            pass  # the master is gone, and the parameter with it
        finally:
            await self._node.__aexit__(exc_type, exc, traceback)

    def __repr__(self) -> str:
        state = "open" if self._node.is_open else "closed" if self._publisher else "new"
        return f"<SimulatedClock at {self._now} of {self._node.master_uri}, {state}>"

    @property
    def now(self) -> Time:
        """The time published last."""
        return self._now

    async def track(self, node: Node) -> None:
        """Wait until ``node`` has the time, now and at each change.

        The node has to be in the same event loop. The nodes of the pytest fixtures are
        already tracked. A node that was started before the clock adopts it with its next
        heartbeat. Raises :class:`TimeoutError` if the time does not reach the node.
        """
        self._tracked.append(node)
        # A node older than the clock learns of it like of any changed parameter.
        if node.uses_sim_time or self._will_follow(node):
            await self._wait_for(node)

    async def set(self, time: float | Time) -> None:
        """Jump to ``time``, in seconds or as a :class:`~aioros1.Time`, in one step.

        Rates and timers that should have ticked several times on the way tick once. A jump
        backwards ends all waits, as when a simulation starts over.

        Raises :class:`ValueError` for a time that is not after zero, and
        :class:`TimeoutError` as :meth:`advance` does.
        """
        moment = _moment(time)
        async with self._lock:
            await self._settle()
            await self._step(moment)

    async def advance(self, duration: float | Duration) -> None:
        """Let ``duration`` pass, in seconds or as a :class:`~aioros1.Duration`.

        The clock stops at every time that a tracked node waits for, in order, so that
        everything happens at its time: a rate of 10 ticks ten times in a second, each time
        with the right :attr:`now`.

        Raises :class:`ValueError` for a negative duration, and :class:`TimeoutError` when a
        step takes more than five real seconds: a node did not receive the time, or a task
        never waits for anything.
        """
        length = duration if isinstance(duration, Duration) else Duration.from_sec(duration)
        if length < Duration():
            raise ValueError(f"time cannot advance by {duration!r}; set() can jump backwards")
        async with self._lock:
            await self._settle()
            end = self._now + length
            while (stop := self._next_awaited()) is not None and stop < end:
                await self._step(stop)
            await self._step(end)

    def _next_awaited(self) -> Time | None:
        """The earliest time after now that a tracked node waits for."""
        moments = [
            moment
            for node in self._following()
            if (moment := node.next_wakeup) is not None and moment > self._now
        ]
        return min(moments, default=None)

    async def _step(self, moment: Time) -> None:
        await self._publish(moment)
        for node in self._following():
            await self._wait_for(node)
        await self._settle()

    async def _publish(self, moment: Time) -> None:
        assert self._publisher is not None, "a SimulatedClock is used with `async with`"
        await self._publisher.send(clock=moment, timeout=_PATIENCE)
        self._now = moment

    def _will_follow(self, node: Node) -> bool:
        is_ours = node.master_uri == self._node.master_uri
        return is_ours and node.is_open and node.options.use_sim_time is not False

    def _following(self) -> list[Node]:
        return [node for node in self._tracked if node.is_open and node.uses_sim_time]

    async def _wait_for(self, node: Node) -> None:
        try:
            await node.wait_for_time(self._now, timeout=_PATIENCE)
        except TimeoutError:
            raise TimeoutError(
                f"node {node.name} did not get the time {self._now} of /clock within "
                f"{_PATIENCE} s; it has {node.now()}"
            ) from None
        except ClosedError:
            pass  # the node no longer needs the time

    async def _settle(self) -> None:
        """Let tasks run until each of them waits for something that has not happened."""
        this = asyncio.current_task()
        loop = asyncio.get_running_loop()
        end = loop.time() + _PATIENCE
        quiet = 0
        while quiet < _QUIET_TURNS:
            await asyncio.sleep(0)
            ready = [task for task in asyncio.all_tasks() if task is not this and _is_ready(task)]
            quiet = 0 if ready else quiet + 1
            if ready and loop.time() > end:
                names = ", ".join(sorted(task.get_name() for task in ready))
                raise TimeoutError(f"tasks that never wait for anything in {_PATIENCE} s: {names}")


def _is_ready(task: asyncio.Task[object]) -> bool:
    # There is no public way to ask. asyncio's tasks, which uvloop uses too, have this
    # attribute in every version of Python.
    waiter = getattr(task, "_fut_waiter", None)
    return waiter is None or bool(waiter.done())


def _moment(time: float | Time) -> Time:
    moment = time if isinstance(time, Time) else Time.from_sec(time)
    if moment.is_zero():
        raise ValueError(f"simulated time must be after zero, which means no time, got {time!r}")
    return moment
