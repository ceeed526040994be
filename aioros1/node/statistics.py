"""Traffic of each connection, on ``/statistics`` (https://wiki.ros.org/Topics#Topic_statistics).

rqt_graph and other tools show it. A node publishes it if the parameter ``/enable_statistics``
is true when it starts. Otherwise it costs one attribute look-up per socket read.
"""

from __future__ import annotations

import math
import struct
from typing import TYPE_CHECKING, Any
from weakref import WeakKeyDictionary

from aioros1.core.context import Context
from aioros1.errors import ClosedError, MasterUnreachable
from aioros1.params.params import Params
from aioros1.time import Duration, Time
from aioros1.topics.options import PublisherOptions
from aioros1.topics.publisher import Publisher
from aioros1.topics.topics import Topics

if TYPE_CHECKING:
    from aioros1.net.topic_links import IncomingLink, Received
    from aioros1.topics.subscription import Subscription

__all__ = ["Statistics"]

_SECOND = 1_000_000_000
_FIRST_WINDOW = _SECOND
_RETRY = 1.0
_LEFT_OUT = frozenset({"/statistics", "/clock"})
_HEADER = struct.Struct("<III")  # seq, and the stamp's seconds and nanoseconds

# Parameters and defaults: how many messages a window should have, and how many seconds.
_PARAMS: dict[str, float] = {
    "min_elements": 10,
    "max_elements": 100,
    "min_size": 4,
    "max_size": 64,
}


class Statistics:
    """Counts what a node receives, and publishes the statistics."""

    def __init__(self, context: Context, topics: Topics, params: Params) -> None:
        self._context = context
        self._topics = topics
        self._params = params
        self._publisher: Publisher[Any] | None = None
        self._windows: WeakKeyDictionary[IncomingLink, _Window] = WeakKeyDictionary()
        self._bounds = dict(_PARAMS)

    async def run(self) -> None:
        """Read the parameters, advertise the topic, and start to count."""
        while self._publisher is None:
            try:
                await self._begin()
            except MasterUnreachable:
                await self._context.pause(_RETRY)
        self._topics.watch(self.received)

    async def _begin(self) -> None:
        for name, default in _PARAMS.items():
            value = await self._params.get(f"/statistics_window_{name}", default)
            if isinstance(value, (int, float)):
                self._bounds[name] = value
        self._publisher = await self._topics.advertise(
            "/statistics", "rosgraph_msgs/TopicStatistics", PublisherOptions(queue_size=10)
        )

    def received(self, subscription: Subscription, frames: list[Received]) -> None:
        """Count what one connection received, and publish when its window is over."""
        if subscription.name in _LEFT_OUT or self._publisher is None:
            return
        batch = frames[0][0]
        link = batch.link
        window = self._windows.get(link)
        if window is None or batch.received < window.last:
            # The clock was set back, so what was measured means nothing.
            last_seq = None if window is None else window.last_seq
            window = _Window(batch.received, subscription.has_header, last_seq)
            self._windows[link] = window
        window.add(frames)
        if batch.received - window.begin < window.length:
            return
        try:
            self._publisher.publish(
                topic=subscription.name,
                node_pub=link.info.header.get("callerid", ""),
                node_sub=self._context.name,
                window_start=Time.from_nsec(window.begin),
                window_stop=Time.from_nsec(batch.received),
                **window.figures(),
            )
        except ClosedError:
            return
        length = window.next_length(self._bounds)
        self._windows[link] = _Window(batch.received, window.has_header, window.last_seq, length)


class _Window:
    """One window of a connection. All times are nanoseconds of the node's clock."""

    def __init__(
        self,
        begin: int,
        has_header: bool,
        last_seq: int | None = None,
        length: int = _FIRST_WINDOW,
    ) -> None:
        self.begin = begin
        self.has_header = has_header
        self.last_seq = last_seq
        self.length = length
        self.last = begin
        """When the last message arrived."""
        self._count = 0
        # Figures, and no values: the clock may stand still for hours while messages come.
        self._periods = _Figures()
        self._ages = _Figures()
        self._bytes = 0
        self._dropped = 0

    def add(self, frames: list[Received]) -> None:
        for batch, start, stop in frames:
            if self._count:
                self._periods.add(batch.received - self.last)
            self._count += 1
            self.last = batch.received
            self._bytes += stop - start + 4
            if not self.has_header or stop - start < _HEADER.size:
                continue
            seq, secs, nsecs = _HEADER.unpack_from(batch.data, start)
            self._ages.add(batch.received - secs * _SECOND - nsecs)
            # A publisher that restarts its count has not dropped anything.
            if self.last_seq is not None and seq > self.last_seq:
                self._dropped += seq - self.last_seq - 1
            self.last_seq = seq

    def figures(self) -> dict[str, Any]:
        return {
            "delivered_msgs": min(self._count, 0x7FFFFFFF),
            "dropped_msgs": min(self._dropped, 0x7FFFFFFF),
            "traffic": min(self._bytes, 0x7FFFFFFF),
            **self._periods.summary("period"),
            **self._ages.summary("stamp_age"),
        }

    def next_length(self, bounds: dict[str, float]) -> int:
        """The next window's length: longer after few messages, shorter after many, as in rospy
        and roscpp."""
        count, length = self._count, self.length
        if count > bounds["max_elements"] and length / 2 >= bounds["min_size"] * _SECOND:
            return length // 2
        if count < bounds["min_elements"] and length * 2 <= bounds["max_size"] * _SECOND:
            return length * 2
        return length


class _Figures:
    """The mean, the standard deviation and the maximum of numbers that are not kept."""

    def __init__(self) -> None:
        self._count = 0
        self._mean = 0.0
        self._squares = 0.0  # the sum of the squared distances from the mean
        self._max = 0

    def add(self, value: int) -> None:
        self._max = value if not self._count else max(self._max, value)
        self._count += 1
        distance = value - self._mean
        self._mean += distance / self._count
        self._squares += distance * (value - self._mean)

    def summary(self, name: str) -> dict[str, Duration]:
        """The fields of a message that begin with ``name``; none without numbers."""
        if not self._count:
            return {}
        figures = {
            "mean": self._mean,
            "stddev": math.sqrt(self._squares / self._count),
            "max": self._max,
        }
        return {
            f"{name}_{figure}": Duration.from_nsec(_within(round(value)))
            for figure, value in figures.items()
        }


def _within(nanoseconds: int) -> int:
    """Clip to what a duration can hold: a stamp of 0 is over half a century old."""
    limit = 0x7FFFFFFF * _SECOND
    return max(-limit, min(nanoseconds, limit))
