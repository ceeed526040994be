"""One direction of a connection through a :class:`.FlakyProxy`: its bytes and their faults.

This uses plain sockets instead of transports. Transports buffer what is written, so you could
neither tell which byte has passed nor stop the next one.
"""

from __future__ import annotations

import asyncio
import contextlib
import math
import random
import socket
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Literal

__all__ = ["ROOM", "ConnectionLost", "Direction", "Faults", "Flow"]

Direction = Literal["up", "down"]
"""From the client to the server, or back."""

ROOM = 64 * 1024
"""Bytes that a direction holds, beyond the system's buffers."""

_OVERHEAD = 256
"""Bytes added to the size of each piece, so that many small ones are bounded too."""

_SLICE = 0.02
"""Seconds' worth of bytes that a throttled direction lets through at once."""

_TURNS = 5
"""Iterations of the event loop that a script has to act, after its start or after
:meth:`FlakyConnection.passed`; several, because it may wait in ``wait_for`` or a task group."""


class ConnectionLost(ConnectionError):
    """A connection through the proxy ended while a script waited for its bytes."""


@dataclass(frozen=True, slots=True)
class Faults:
    """The faults of one direction."""

    stalled: bool = False
    rate: float | None = None
    delay: float = 0.0
    corruption: float = 0.0
    seed: int | None = None


class Flow:
    """One direction: reads from one socket, writes to the other, and applies faults between.

    Everything happens in :meth:`_flow`, which does what is possible now and arranges to be
    called again when there may be more to do.
    """

    def __init__(
        self,
        way: Direction,
        number: int,
        faults: Faults,
        on_end: Callable[[], None],
        on_loss: Callable[[], None],
        *,
        sink: socket.socket | None = None,
    ) -> None:
        self.passed = 0
        self.ended = False  # the receiver has been told of the end
        self._name = f"{number}/{way}"
        self._on_end = on_end
        self._on_loss = on_loss
        self._loop = asyncio.get_running_loop()
        self._source: socket.socket | None = None
        self._sink = sink
        self._queue: deque[tuple[float, memoryview]] = deque()  # time of arrival; b"" is the end
        self._queued = 0
        self._harmed = 0  # bytes at the head of the queue that corruption has handled
        self._all_read = False
        self._reading = self._writing = False
        self._next = 0.0  # when a throttled direction may go on
        self._timer: asyncio.TimerHandle | None = None
        self._held = False
        self._stopped = False
        self._marks: list[tuple[int, asyncio.Future[bool]]] = []
        self._faults = faults
        self._corruption = _Corruption(faults, self._name)

    def begin(self, source: socket.socket, sink: socket.socket) -> None:
        if self._stopped:
            return
        self._source, self._sink = source, sink
        if self.ended:
            self._tell_end()
        self._hold(_TURNS)

    def change(self, **changes: Any) -> None:
        self._faults = replace(self._faults, **changes)
        if "rate" in changes:
            self._next = 0.0
        if "corruption" in changes:
            self._corruption = _Corruption(self._faults, self._name)
        self._flow()

    def shut(self) -> None:
        if not self.ended and not self._stopped:
            self._end()

    def stop(self) -> None:
        self._stopped = True
        self._queue.clear()
        self._cancel_timer()
        self._watch(reading=False, writing=False)
        self._settle()

    async def wait_passed(self, count: int) -> None:
        if self.passed < count and not self.ended and not self._stopped:
            mark = count, self._loop.create_future()
            self._marks.append(mark)
            try:
                await mark[1]
            finally:
                if mark in self._marks:
                    self._marks.remove(mark)
        if self.passed < count:
            raise ConnectionLost(
                f"connection {self._name} ended after {self.passed} bytes, "
                f"and {count} were waited for"
            )

    # the bytes

    def _readable(self) -> None:
        assert self._source is not None
        try:
            data = self._source.recv(self._room())
        except (BlockingIOError, InterruptedError):
            return
        except OSError:
            self._on_loss()
            return
        if not data:
            self._all_read = True
        if not self.ended:
            self._queue.append((time.monotonic(), memoryview(data)))
            self._queued += len(data)
        self._flow()

    def _flow(self) -> None:
        if self._stopped or self._source is None or self._sink is None:
            return
        self._cancel_timer()
        blocked = False
        while self._queue and not self._held and not self._faults.stalled:
            came, data = self._queue[0]
            wait = max(came + self._faults.delay, self._next) - time.monotonic()
            if wait > 0:
                # At least the resolution of event loops, or it would be called in vain.
                self._timer = self._loop.call_later(max(wait, 0.001), self._flow)
                break
            if not data:
                self._end()
                return
            try:
                sent = self._sink.send(self._piece(came, data))
            except (BlockingIOError, InterruptedError):
                blocked = True
                break
            except OSError:
                self._on_loss()
                return
            self._sent(sent)
        reading = not self._all_read and not self._faults.stalled and self._room() > 0
        self._watch(reading=reading, writing=blocked)

    def _piece(self, came: float, data: memoryview) -> memoryview:
        """The part of ``data``, the head of the queue, that may be sent now, corrupted if due."""
        count = len(data)
        if self._faults.rate is not None:
            count = min(count, max(1, int(self._faults.rate * _SLICE)))
        for mark, _ in self._marks:
            count = min(count, mark - self.passed)
        if self._faults.corruption and count > self._harmed:
            if data.readonly:
                data = memoryview(bytearray(data))
                self._queue[0] = came, data
            self._corruption.harm(data[self._harmed : count])
            self._harmed = count
        return data[:count]

    def _sent(self, count: int) -> None:
        came, data = self._queue.popleft()
        if count < len(data):
            self._queue.appendleft((came, data[count:]))
        self.passed += count
        self._queued -= count
        self._harmed = max(0, self._harmed - count)
        if self._faults.rate is not None:
            self._next = max(self._next, time.monotonic()) + count / self._faults.rate
        if any(mark <= self.passed for mark, _ in self._marks):
            self._settle()
            self._hold(_TURNS)

    def _end(self) -> None:
        self.ended = True
        self._queue.clear()
        self._queued = 0
        self._settle()
        self._tell_end()
        self._flow()
        self._on_end()

    def _tell_end(self) -> None:
        if self._sink is not None:
            with contextlib.suppress(OSError):  # the peer has already gone
                self._sink.shutdown(socket.SHUT_WR)

    # waiting

    def _room(self) -> int:
        return ROOM - self._queued - _OVERHEAD * len(self._queue)

    def _watch(self, *, reading: bool, writing: bool) -> None:
        if self._source is None or self._sink is None:
            return
        if reading != self._reading:
            self._reading = reading
            if reading:
                self._loop.add_reader(self._source, self._readable)
            else:
                self._loop.remove_reader(self._source)
        if writing != self._writing:
            self._writing = writing
            if writing:
                self._loop.add_writer(self._sink, self._flow)
            else:
                self._loop.remove_writer(self._sink)

    def _cancel_timer(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None

    def _hold(self, turns: int) -> None:
        """Let nothing pass for some iterations of the event loop."""
        self._held = turns > 0
        if self._held:
            self._loop.call_soon(self._hold, turns - 1)
        else:
            self._flow()

    def _settle(self) -> None:
        """Wake tasks that wait for bytes that have passed or never will."""
        over = self.ended or self._stopped
        for mark in list(self._marks):
            count, future = mark
            if over or count <= self.passed:
                self._marks.remove(mark)
                if not future.done():
                    future.set_result(True)


class _Corruption:
    """Changes random bytes; which ones does not depend on how the bytes are split."""

    def __init__(self, faults: Faults, name: str) -> None:
        self._probability = faults.corruption
        seed = None if faults.seed is None else f"{faults.seed}/{name}"
        self._random = random.Random(seed)
        self._gap = self._next_gap()

    def harm(self, data: memoryview) -> None:
        at = self._gap
        while at < len(data):
            data[at] ^= self._random.randrange(1, 256)
            at += 1 + self._next_gap()
        self._gap = at - len(data)

    def _next_gap(self) -> int:
        """How many bytes to leave before the next change: drawn once, not for each byte."""
        if not 0 < self._probability < 1:
            return 0
        drawn = math.log(1.0 - self._random.random()) / math.log1p(-self._probability)
        return int(min(drawn, 1e18))
