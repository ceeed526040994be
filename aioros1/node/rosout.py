"""Log records on ``/rosout``."""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections import deque
from typing import Any

from aioros1.core.context import Context
from aioros1.errors import ClosedError, MasterError
from aioros1.log.levels import LevelChanges, ros_level
from aioros1.log.library_log import ROSOUT
from aioros1.log.loggers import WeakHandler, topmost
from aioros1.params.params import Params
from aioros1.time import Time
from aioros1.topics.options import PublisherOptions
from aioros1.topics.publisher import Publisher
from aioros1.topics.topics import Topics
from aioros1.waiting import Waiters

__all__ = ["Rosout"]

_RETRY = 1.0

_WAITING = 10_000
"""The most records that wait to be published: from threads that log while the event loop is
busy, and from a node without a master."""

_FIRST_SUBSCRIBERS = 1.0
"""Seconds that the first records wait for subscribers."""


class Rosout:
    """Publishes the records of a node's logger, and of the other loggers that it names.

    Records logged in the node's event loop are published at once; records from other threads
    as soon as the loop gets to them. The first records wait until the topic is advertised and
    has its subscribers; the start of a node does not wait for that.
    """

    def __init__(
        self, context: Context, topics: Topics, params: Params, levels: LevelChanges
    ) -> None:
        self._context = context
        self._topics = topics
        self._params = params
        self._loop = asyncio.get_running_loop()
        self._publisher: Publisher[Any] | None = None
        self._waiting: deque[dict[str, Any]] = deque(maxlen=_WAITING)
        self._is_ready = False
        self._is_publishing = False
        self._is_scheduled = False
        self._has_topics = True
        self._is_awaited = True
        """Whether subscribers of the first records may still be connecting."""
        self._progress = Waiters()
        # As rosout does; the application's own handlers decide what else it shows.
        levels.set_default(logging.getLogger(context.loggers[0]), logging.INFO)
        self._handler = WeakHandler(topmost(context.loggers), self._take)

    def detach(self) -> None:
        """Restore the loggers."""
        self._handler.detach()
        self._is_ready = False
        self._waiting.clear()
        self._expect(False)

    async def run(self) -> None:
        """Advertise ``/rosout`` as soon as the master accepts it, then publish what waits."""
        options = PublisherOptions(latch=True, queue_size=100)
        while self._publisher is None:
            try:
                self._publisher = await self._topics.advertise(
                    ROSOUT, "rosgraph_msgs/Log", options, warns=False
                )
            except MasterError:
                self._expect(False)
                await self._context.pause(_RETRY)
        # As rospy and roscpp do, for nodes with many topics.
        with contextlib.suppress(MasterError):
            disabled = await self._params.get("/rosout_disable_topics_generation", False)
            self._has_topics = disabled is not True
        publication = self._topics.published(ROSOUT)
        known = publication.known_subscribers if publication is not None else 0
        self._expect(known > 0)
        with contextlib.suppress(TimeoutError):
            await self._publisher.wait_for_subscribers(max(1, known), timeout=_FIRST_SUBSCRIBERS)
        self._is_ready = True
        self._publish_waiting()
        self._expect(False)

    def _expect(self, is_awaited: bool) -> None:
        self._is_awaited = is_awaited
        self._progress.wake()

    async def settle(self, timeout: float) -> None:
        """Before the node closes, let subscribers that are connecting get the first records."""
        with contextlib.suppress(TimeoutError):
            async with asyncio.timeout(min(timeout, _FIRST_SUBSCRIBERS)):
                while self._waiting and self._is_awaited:
                    await self._progress.wait()

    def uses(self, role: object) -> bool:
        """Whether ``role`` is the publisher of ``/rosout``."""
        return role is self._publisher

    async def finish(self) -> None:
        """Publish what waits, then close the topic."""
        if self._publisher is not None:
            self._is_ready = True
            self._publish_waiting()
            await self._publisher.close()

    def _take(self, record: logging.LogRecord) -> None:
        if self._is_of_another(record):
            return
        fields = self._fields(record)
        is_here = _running_loop() is self._loop
        if is_here and self._is_publishing:
            return  # logged while publishing another record: it would never end
        self._waiting.append(fields)
        if self._is_ready:
            if is_here:
                self._publish_waiting()
            else:
                self._schedule()

    def _is_of_another(self, record: logging.LogRecord) -> bool:
        """Whether it comes from a node whose name, and thus its logger, is below ours."""
        own, name = self._context.loggers[0], self._context.name
        if f"{record.name}.".startswith(f"{own}."):
            # The handler of the nearest node is called first.
            record.__dict__.setdefault("ros_node", name)
        return getattr(record, "ros_node", name) != name

    def _fields(self, record: logging.LogRecord) -> dict[str, Any]:
        """The fields of a message, which do not change whatever the thread does next."""
        return {
            "header": {"stamp": Time.from_nsec(self._context.clock.nanoseconds())},
            "level": ros_level(record.levelno),
            "name": self._context.name,
            "msg": _sendable(self._handler.format(record)),
            # Records made by hand may have anything there.
            "file": _sendable(str(record.pathname)),
            "function": _sendable(str(record.funcName or "")),
            "line": record.lineno if record.lineno in range(1 << 32) else 0,
        }

    def _schedule(self) -> None:
        if not self._is_scheduled:
            self._is_scheduled = True
            # The loop may be closed although the node never was.
            with contextlib.suppress(RuntimeError):
                self._loop.call_soon_threadsafe(self._publish_waiting)

    def _publish_waiting(self) -> None:
        """Publish the records that wait. Call it only in the event loop."""
        self._is_scheduled = False
        publisher = self._publisher
        if publisher is None or self._is_publishing or not self._is_ready:
            return
        self._is_publishing = True
        try:
            topics = sorted(self._topics.publications) if self._has_topics else []
            # Leave records that threads add meanwhile, or a busy thread would block the loop.
            for _ in range(len(self._waiting)):
                publisher.publish(topics=topics, **self._waiting.popleft())
        except ClosedError:
            self._waiting.clear()  # a closed node no longer publishes
        finally:
            self._is_publishing = False


def _running_loop() -> asyncio.AbstractEventLoop | None:
    try:
        return asyncio.get_running_loop()
    except RuntimeError:
        return None


def _sendable(text: str) -> str:
    """Return the text, with escapes for anything that is no character."""
    return text if text.isascii() else text.encode("utf-8", "backslashreplace").decode()
