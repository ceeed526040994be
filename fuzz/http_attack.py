"""Clients that send :mod:`fuzz.requests` over real connections, and judge every answer."""

from __future__ import annotations

import asyncio
import contextlib
import re
import xmlrpc.client
from collections import deque
from random import Random
from typing import cast
from xml.parsers import expat

from aioros1.wire.xmlrpc import XmlRpcFault, decode_response
from fuzz.requests import Request, Requests

__all__ = ["HttpAttack"]

_PATIENCE = 60.0
"""Seconds for an answer, however busy the machine is."""
_GLANCE = 0.01
"""Seconds that are spent on what may never be answered."""

# The version is that of the request, whatever that is.
_STATUS = re.compile(rb"HTTP/[0-9]\.[0-9] ([1-5][0-9]{2}) [ -~]*")
_FIELD = re.compile(rb"([A-Za-z0-9-]+): ?([ -~]*)")


class _Connection(asyncio.Protocol):
    """Cuts what comes into answers, and takes nothing that is not one."""

    def __init__(self) -> None:
        self.answers: deque[tuple[int, bytes]] = deque()
        self.bodies: deque[bool] = deque()  # whether the answers to come have a body
        self.is_lost = False
        self._data = b""
        self._change = asyncio.Event()
        self.failure: BaseException | None = None

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        self.transport = cast("asyncio.Transport", transport)

    def data_received(self, data: bytes) -> None:
        self._data += data
        try:
            while (answer := self._next()) is not None:
                self.answers.append(answer)
        except AssertionError as error:
            self.failure = error
        self._change.set()

    def connection_lost(self, exc: Exception | None) -> None:
        self.is_lost = True
        self._change.set()

    def _next(self) -> tuple[int, bytes] | None:
        head, end, rest = self._data.partition(b"\r\n\r\n")
        if not end:
            assert len(head) < 10_000, f"an endless head: {head[:200]!r}"
            return None
        line, *lines = head.split(b"\r\n")
        status = _STATUS.fullmatch(line)
        assert status is not None, f"not a status line: {line!r}"
        fields: dict[bytes, bytes] = {}
        for each in lines:
            field = _FIELD.fullmatch(each)
            assert field is not None, f"not a field: {each!r}"
            name = field[1].lower()
            assert name not in fields, f"twice: {each!r}"
            fields[name] = field[2]
        code = int(status[1])
        if code == 100:
            self._data = rest
            return self._next()
        assert b"transfer-encoding" not in fields, fields
        length = fields.get(b"content-length", b"")
        assert re.fullmatch(rb"[0-9]{1,9}", length), f"{code} without a length: {fields}"
        size = int(length) if not self.bodies or self.bodies[0] else 0
        if len(rest) < size:
            return None
        if self.bodies:
            self.bodies.popleft()
        self._data = rest[size:]
        if code == 200:
            assert fields.get(b"content-type", b"").startswith(b"text/xml"), fields
        return code, rest[:size]

    async def answer(self) -> tuple[int, bytes] | None:
        """The next answer; None when the connection ends before."""
        while True:
            if self.failure is not None:
                raise self.failure
            if self.answers:
                return self.answers.popleft()
            if self.is_lost:
                assert not self._data, f"half an answer: {self._data[:300]!r}"
                return None
            self._change.clear()
            await self._change.wait()


class HttpAttack:
    """One client after the other at one port, until ``take`` gives no more requests."""

    def __init__(
        self, random: Random, port: int, api: dict[str, tuple[str, ...]], batches: deque[bytes]
    ) -> None:
        self._random = random
        self._port = port
        self._requests = Requests(random, api)
        self._batches = batches  # what was sent last
        self.sent = self.answered = self.faults = self.refused = self.connections = 0

    async def run(self, budget: list[int]) -> None:
        """Send requests while ``budget``, which is shared, has some left."""
        while budget[0] > 0:
            await self._connect(budget)

    async def _connect(self, budget: list[int]) -> None:
        loop = asyncio.get_running_loop()
        _, connection = await loop.create_connection(_Connection, "127.0.0.1", self._port)
        self.connections += 1
        try:
            for _ in range(self._random.choice((1, 5, 50))):
                if budget[0] <= 0 or not await self._batch(connection, budget):
                    break
        finally:
            connection.transport.abort()
        # The transport of a loop is only gone a turn later.
        await asyncio.sleep(0)

    async def _batch(self, connection: _Connection, budget: list[int]) -> bool:
        """Send some requests, one behind the other; whether there may be more."""
        batch: list[Request] = []
        for _ in range(min(budget[0], self._random.choice((1, 1, 2, 4, 8, 16)))):
            batch.append(self._requests.next())
            if batch[-1].is_last:
                break
        budget[0] -= len(batch)
        self.sent += len(batch)
        data = b"".join(request.octets for request in batch)
        self._batches.append(data)
        connection.bodies.extend(request.has_body for request in batch if request.statuses)
        await self._write(connection, data)
        last = batch[-1]
        # aiohttp forgets what came in one piece with something broken, and refuses it all.
        is_doomed = not last.statuses or 400 in last.statuses
        async with asyncio.timeout(_PATIENCE):
            for request in batch:
                if request.statuses:
                    answer = await connection.answer()
                    if is_doomed and (answer[0] == 400 if answer else not last.statuses):
                        return False
                    assert answer is not None, f"no answer to {request.octets[:500]!r}"
                    status, body = answer
                    assert status in request.statuses, (
                        f"{status} {body[:200]!r} to {request.octets[:500]!r}"
                    )
                    self._judge(status, body)
        if not last.statuses:
            await self._glance(connection)
        else:
            assert not connection.answers, f"an answer too many: {connection.answers[0]}"
        return not last.is_last

    async def _write(self, connection: _Connection, data: bytes) -> None:
        if self._random.random() < 0.9:
            connection.transport.write(data)
            return
        for _ in range(3):
            at = self._random.randrange(len(data) + 1)
            connection.transport.write(data[:at])
            data = data[at:]
            await asyncio.sleep(0)
        connection.transport.write(data)

    async def _glance(self, connection: _Connection) -> None:
        """What comes, if anything does; sometimes nobody waits for it."""
        if self._random.random() < 0.3:
            return
        if self._random.random() < 0.3 and not connection.is_lost:
            with contextlib.suppress(OSError):  # the other side was quicker
                connection.transport.write_eof()
        try:
            async with asyncio.timeout(_GLANCE):
                while (answer := await connection.answer()) is not None:
                    self._judge(*answer)
        except TimeoutError:
            pass

    def _judge(self, status: int, body: bytes) -> None:
        if status != 200:
            assert 400 <= status < 500, f"status {status}: {body[:300]!r}"
            self.refused += 1
            return
        self.answered += 1
        try:
            expat.ParserCreate().Parse(body, True)
        except expat.ExpatError as error:
            raise AssertionError(f"not XML, {error}: {body[:500]!r}") from None
        try:
            decode_response(body)
        except XmlRpcFault as fault:
            # Else an exception that nobody expected, or an answer that could not be sent.
            assert fault.code in (-32700, -32601, -32602), f"fault {fault.code}: {fault.text}"
            self.faults += 1
        if self.answered % 16 == 0:
            try:
                xmlrpc.client.loads(body, use_builtin_types=True)
            except xmlrpc.client.Fault:
                pass
