"""Tells nodes what has changed, each at its own pace.

A node that hangs or is gone must never delay notifications to others: with three such nodes
rosmaster, which has three threads for this, goes silent for the whole graph. Here every node
has a queue and, while the queue is not empty, a task. A queue keeps only the newest message
about each thing, so it stays short and an old list of publishers never overtakes a newer one.

A message that does not arrive is sent again: nothing else would tell the node. The master may
have no descriptors left, or the node may be restarting its network, be busy or hang.
"""

from __future__ import annotations

import asyncio
import logging
import random
from collections import deque
from collections.abc import Callable, Iterable
from typing import Any

from aioros1.log.library_log import LibraryLog
from aioros1.master.parameters import ParamUpdate
from aioros1.master.registry import Notification, PublisherUpdate, Shutdown
from aioros1.quoting import printable
from aioros1.waiting import Mutex
from aioros1.wire.xmlrpc import XmlRpcError, XmlRpcFault
from aioros1.xmlrpc.client import HttpStatusError, XmlRpcClient

__all__ = ["Notifier"]

_LOG = logging.getLogger("aioros1.master")
_CALLER_ID = "/master"

# Parameter updates that may be queued for a follower of "/"; topics bound themselves.
_MAX_PENDING = 10_000

_FIRST_PAUSE, _LONGEST_PAUSE = 0.5, 30.0

_GIVE_UP = 600.0
"""Seconds in which a node may be out of reach. Dead nodes stay registered for ever."""

_GIVE_UP_SHUTDOWN = 10.0
"""The same for the request to end, as another program may get the address of a dead node."""

_TRY_AGAIN = (408, 429, 500, 502, 503, 504)
"""HTTP statuses of servers that may have time later."""

# Nodes to start notifying in one iteration of the event loop. A topic may have hundreds of
# subscribers; notifying all at once would hold up the requests that come meanwhile.
_PER_TURN = 2

# Characters of a text that is encoded once for all nodes.
_LARGE = 4096

# Publishers in a list that is encoded once for all subscribers.
_MANY = 50

_Slot = tuple[type, str, str]
"""The subject of a message: its kind, the topic or key, and the node for parameters."""


class Notifier:
    """Sends notifications to nodes through ``client``.

    ``is_wanted(message)`` tells whether to try again what did not arrive.
    ``on_unwanted(update)`` is called when a node answers that it does not follow a
    parameter. Both are plain functions.
    """

    def __init__(
        self,
        client: XmlRpcClient,
        *,
        is_wanted: Callable[[Notification], bool],
        on_unwanted: Callable[[ParamUpdate], object],
    ) -> None:
        self._client = client
        self._log = LibraryLog(_LOG)
        self._is_wanted = is_wanted
        self._on_unwanted = on_unwanted
        self._queues: dict[str, dict[_Slot, Notification]] = {}
        self._tasks: dict[str, asyncio.Task[None]] = {}
        self._pauses: dict[str, asyncio.Event] = {}  # of nodes that are told again later
        self._waiting: deque[str] = deque()  # nodes with a queue but no task yet
        self._starter: asyncio.Task[None] | None = None
        self._closed = False
        self._encoding = Mutex()
        self._last: tuple[str, str, Any, bytes] | None = None

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
            if api in self._pauses:
                self._pauses[api].set()  # something may have changed there
            if len(queue) > _MAX_PENDING:
                del queue[next(iter(queue))]
                self._log.complain("%s takes no notifications; the oldest is dropped", api)
        if self._waiting and self._starter is None:
            self._starter = asyncio.create_task(self._start(), name="aioros1-master-notify")

    async def close(self) -> None:
        """Drop all messages that are queued or being sent."""
        self._closed = True
        self._log.close()
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
                        work, name=f"aioros1-master-notify {printable(api)}"
                    )
                await asyncio.sleep(0)
        finally:
            self._starter = None

    async def _work(self, api: str, queue: dict[_Slot, Notification]) -> None:
        loop = asyncio.get_running_loop()
        pause, failing_since, complaint = _FIRST_PAUSE, None, ""
        try:
            while queue:
                slot = next(iter(queue))
                message = queue.pop(slot)
                try:
                    await self._tell(message)
                except (TimeoutError, ConnectionError, HttpStatusError) as error:
                    if complaint != str(error):
                        complaint = str(error)
                        self._complain(error)
                    if failing_since is None:
                        failing_since = loop.time()
                    if isinstance(error, HttpStatusError) and error.status not in _TRY_AGAIN:
                        continue
                    # The node may have read this, or may still read it, even after what we
                    # send next. So send this again, or what has replaced it, until the node
                    # answers.
                    if slot not in queue:
                        rest = dict(queue)
                        queue.clear()
                        queue[slot] = message
                        queue.update(rest)
                    self._drop(queue, loop.time() - failing_since)
                    if queue:
                        await self._rest(api, pause)
                        pause = min(pause * 2, _LONGEST_PAUSE)
                        self._drop(queue, loop.time() - failing_since)
                except (XmlRpcError, XmlRpcFault) as error:
                    self._log.info("%s", error)
                except Exception:
                    self._log.exception("cannot tell %s: %s", api, message)
                else:
                    pause, failing_since, complaint = _FIRST_PAUSE, None, ""
        finally:
            del self._tasks[api]
            del self._queues[api]
            if not self._tasks:
                self._last = None

    async def _rest(self, api: str, seconds: float) -> None:
        """Wait before the next try, or until there is something new to tell."""
        woken = self._pauses[api] = asyncio.Event()
        try:
            async with asyncio.timeout(seconds * random.uniform(0.5, 1.0)):
                await woken.wait()
        except TimeoutError:
            pass
        finally:
            del self._pauses[api]

    def _drop(self, queue: dict[_Slot, Notification], seconds: float) -> None:
        """Drop what need not be told any more, or could not be for so many seconds."""
        for slot, message in list(queue.items()):
            limit = _GIVE_UP_SHUTDOWN if isinstance(message, Shutdown) else _GIVE_UP
            if seconds >= limit or not self._is_wanted(message):
                del queue[slot]

    async def _tell(self, message: Notification) -> None:
        answer: Any
        call = self._client.call
        if isinstance(message, PublisherUpdate):
            method, topic, publishers = "publisherUpdate", message.topic, message.publishers
            if len(publishers) > _MANY:
                body = await self._encode(method, topic, publishers)
                answer = await call(message.api, method, body=body)
            else:
                answer = await call(message.api, method, _CALLER_ID, topic, publishers)
        elif isinstance(message, ParamUpdate):
            method, key, value = "paramUpdate", message.key, message.value
            if _is_large(value):
                body = await self._encode(method, key, value)
                answer = await call(message.api, method, body=body)
            else:
                answer = await call(message.api, method, _CALLER_ID, key, value)
            if isinstance(answer, list) and answer[:1] == [-1]:
                self._on_unwanted(message)
        elif not self._is_wanted(message):
            return  # another node has come to that address meanwhile
        else:
            answer = await call(message.api, "shutdown", _CALLER_ID, message.reason)
        self._log.debug("%s answered %s", message.api, answer)

    def _complain(self, error: Exception) -> None:
        """A node that hangs is worth a warning; one that is gone may just have been killed.

        Anybody can register thousands of either.
        """
        if isinstance(error, TimeoutError):
            self._log.complain("%s", error)
        else:
            self._log.info("%s", error)

    async def _encode(self, method: str, name: str, value: Any) -> bytes:
        """The request that tells of ``value``; the same bytes for all nodes that it is for.

        A large parameter may have hundreds of followers that take their time, and a topic with
        many publishers as many subscribers.
        """
        async with self._encoding:
            if self._last is not None:
                *last, last_value, body = self._last
                if last_value is value and last == [method, name]:
                    return body
            body = await self._client.encode(method, _CALLER_ID, name, value)
            self._last = method, name, value, body
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
