"""Traffic of each connection, on ``/statistics`` (https://wiki.ros.org/Topics#Topic_statistics).

rqt_graph and other tools show it. A node publishes it if the parameter ``/enable_statistics``
is true when it starts. Otherwise it costs one attribute look-up per socket read.
"""

from __future__ import annotations

import statistics
import struct
from itertools import pairwise
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
        if window is None:
            window = self._windows[link] = _Window(batch.received, subscription.has_header)
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
        self._arrivals: list[int] = []
        self._ages: list[int] = []
        self._bytes = 0
        self._dropped = 0

    def add(self, frames: list[Received]) -> None:
        for batch, start, stop in frames:
            self._arrivals.append(batch.received)
            self._bytes += stop - start + 4
            if not self.has_header or stop - start < _HEADER.size:
                continue
            seq, secs, nsecs = _HEADER.unpack_from(batch.data, start)
            self._ages.append(batch.received - secs * _SECOND - nsecs)
            # A publisher that restarts its count has not dropped anything.
            if self.last_seq is not None and seq > self.last_seq:
                self._dropped += seq - self.last_seq - 1
            self.last_seq = seq

    def figures(self) -> dict[str, Any]:
        arrivals = self._arrivals
        periods = [after - before for before, after in pairwise(arrivals)]
        return {
            "delivered_msgs": len(arrivals),
            "dropped_msgs": min(self._dropped, 0x7FFFFFFF),
            "traffic": min(self._bytes, 0x7FFFFFFF),
            **_summary("period", periods),
            **_summary("stamp_age", self._ages),
        }

    def next_length(self, bounds: dict[str, float]) -> int:
        """The next window's length: longer after few messages, shorter after many, as in rospy
        and roscpp."""
        count, length = len(self._arrivals), self.length
        if count > bounds["max_elements"] and length / 2 >= bounds["min_size"] * _SECOND:
            return length // 2
        if count < bounds["min_elements"] and length * 2 <= bounds["max_size"] * _SECOND:
            return length * 2
        return length


def _summary(name: str, values: list[int]) -> dict[str, Duration]:
    if not values:
        return {}
    figures = {
        "mean": statistics.fmean(values),
        "stddev": statistics.pstdev(values),
        "max": max(values),
    }
    return {
        f"{name}_{figure}": Duration.from_nsec(_within(round(value)))
        for figure, value in figures.items()
    }


def _within(nanoseconds: int) -> int:
    """Clip to what a duration can hold: a stamp of 0 is over half a century old."""
    limit = 0x7FFFFFFF * _SECOND
    return max(-limit, min(nanoseconds, limit))
