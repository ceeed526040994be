"""Tells nodes what has changed, each at its own pace.

A node that hangs or is gone must never delay notifications to others: with three such nodes
rosmaster, which has three threads for this, goes silent for the whole graph. Here every node
has a queue and, while the queue is not empty, a task. A queue keeps only the newest message
about each thing, so it stays short and an old list of publishers never overtakes a newer one.
"""

from __future__ import annotations

import asyncio
import logging
from collections import deque
from collections.abc import Callable, Iterable
from typing import Any

from aioros1.master.parameters import ParamUpdate
from aioros1.master.registry import Notification, PublisherUpdate
from aioros1.waiting import Mutex
from aioros1.wire.xmlrpc import XmlRpcError, XmlRpcFault
from aioros1.xmlrpc.client import XmlRpcClient

__all__ = ["Notifier"]

_LOG = logging.getLogger("aioros1.master")
_CALLER_ID = "/master"

# Parameter updates that may be queued for a follower of "/"; topics bound themselves.
_MAX_PENDING = 10_000

_FIRST_PAUSE, _LONGEST_PAUSE = 0.5, 30.0

# Nodes to start notifying in one iteration of the event loop. A topic may have hundreds of
# subscribers; notifying all at once would hold up the requests that come meanwhile.
_PER_TURN = 2

# Characters of a text that is encoded once for all nodes.
_LARGE = 4096

_Slot = tuple[type, str, str]
"""The subject of a message: its kind, the topic or key, and the node for parameters."""


class Notifier:
    """Sends notifications to nodes through ``client``.

    ``is_registered(api)`` tells whether to try again at a URI that did not answer in time.
    ``on_unwanted(update)`` is called when a node answers that it does not follow a
    parameter. Both are plain functions.
    """

    def __init__(
        self,
        client: XmlRpcClient,
        *,
        is_registered: Callable[[str], bool],
        on_unwanted: Callable[[ParamUpdate], object],
    ) -> None:
        self._client = client
        self._is_registered = is_registered
        self._on_unwanted = on_unwanted
        self._queues: dict[str, dict[_Slot, Notification]] = {}
        self._tasks: dict[str, asyncio.Task[None]] = {}
        self._waiting: deque[str] = deque()  # nodes with a queue but no task yet
        self._starter: asyncio.Task[None] | None = None
        self._closed = False
        self._encoding = Mutex()
        self._last: tuple[ParamUpdate, bytes] | None = None

    def send(self, notifications: Iterable[Notification]) -> None:
        """Queue messages; never waits."""
        if self._closed:
            return
        for message in notifications:
            api = message.api
            queue = self._queues.get(api)
            if queue is None:
                queue = self._queues[api] = {}
                self._waiting.append(api)
            slot = _slot(message)
            # To the end, not to the old place: otherwise an update of a namespace above or
            # below that was queued in between would have the last word.
            queue.pop(slot, None)
            queue[slot] = message
            if len(queue) > _MAX_PENDING:
                del queue[next(iter(queue))]
                _LOG.warning("%s takes no notifications; the oldest is dropped", api)
        if self._waiting and self._starter is None:
            self._starter = asyncio.create_task(self._start(), name="aioros1-master-notify")

    async def close(self) -> None:
        """Drop all messages that are queued or being sent."""
        self._closed = True
        tasks = list(self._tasks.values())
        if self._starter is not None:
            tasks.append(self._starter)
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
        self._queues.clear()

    async def _start(self) -> None:
        """Start a task for every node that waits for one, a few at a time."""
        try:
            while self._waiting:
                for _ in range(min(_PER_TURN, len(self._waiting))):
                    api = self._waiting.popleft()
                    work = self._work(api, self._queues[api])
                    self._tasks[api] = asyncio.create_task(
                        work, name=f"aioros1-master-notify {api}"
                    )
                await asyncio.sleep(0)
        finally:
            self._starter = None

    async def _work(self, api: str, queue: dict[_Slot, Notification]) -> None:
        pause = _FIRST_PAUSE
        try:
            while queue:
                slot = next(iter(queue))
                message = queue.pop(slot)
                try:
                    await self._tell(message)
                    pause = _FIRST_PAUSE
                except TimeoutError as error:
                    _LOG.warning("%s", error)
                    if not self._is_registered(api):
                        continue
                    # The node may still read this, even after what we send next. So send
                    # this, or what has replaced it, again until the node answers.
                    if slot not in queue:
                        rest = dict(queue)
                        queue.clear()
                        queue[slot] = message
                        queue.update(rest)
                    await asyncio.sleep(pause)
                    pause = min(pause * 2, _LONGEST_PAUSE)
                except (ConnectionError, XmlRpcError, XmlRpcFault) as error:
                    _LOG.info("%s", error)
                except Exception:
                    _LOG.exception("cannot tell %s: %s", api, message)
        finally:
            del self._tasks[api]
            del self._queues[api]
            if not self._tasks:
                self._last = None

    async def _tell(self, message: Notification) -> None:
        answer: Any
        call = self._client.call
        if isinstance(message, PublisherUpdate):
            answer = await call(
                message.api, "publisherUpdate", _CALLER_ID, message.topic, message.publishers
            )
        elif isinstance(message, ParamUpdate):
            params = _CALLER_ID, message.key, message.value
            if _is_large(message.value):
                answer = await call(message.api, "paramUpdate", body=await self._encode(message))
            else:
                answer = await call(message.api, "paramUpdate", *params)
            if isinstance(answer, list) and answer[:1] == [-1]:
                self._on_unwanted(message)
        else:
            answer = await call(message.api, "shutdown", _CALLER_ID, message.reason)
        _LOG.debug("%s answered %.200s", message.api, answer)

    async def _encode(self, message: ParamUpdate) -> bytes:
        """The request that tells of ``message``; the same bytes for all nodes that it is for.

        A large parameter may have hundreds of followers that take their time.
        """
        async with self._encoding:
            if self._last is not None:
                last, body = self._last
                if last.value is message.value and last.key == message.key:
                    return body
            body = await self._client.encode("paramUpdate", _CALLER_ID, message.key, message.value)
            self._last = message, body
            return body


def _is_large(value: Any) -> bool:
    if isinstance(value, dict | list):
        return bool(value)  # it would take long to find out
    return isinstance(value, str | bytes) and len(value) > _LARGE


def _slot(message: Notification) -> _Slot:
    if isinstance(message, PublisherUpdate):
        return PublisherUpdate, message.topic, ""
    if isinstance(message, ParamUpdate):
        return ParamUpdate, message.key, message.caller_id
    return type(message), message.caller_id, ""
