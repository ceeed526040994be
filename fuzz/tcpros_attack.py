"""Peers that talk to the TCPROS port of a node: subscribers, callers, and who knows what."""

from __future__ import annotations

import asyncio
import struct
from collections import deque
from random import Random

from aioros1.wire.header import decode_header, encode_header

__all__ = ["MAX_FRAME", "MAX_HEADER", "TcprosAttack"]

MAX_HEADER = 16 << 10
MAX_FRAME = 64 << 10
"""What the node under attack accepts."""

_PATIENCE = 60.0
_GLANCE = 0.01

_TOPIC = {
    "callerid": "/fuzzer/sub",
    "md5sum": "992ce8a1687cec8c8bd883ec73ca41d1",
    "message_definition": "string data\n",
    "tcp_nodelay": "1",
    "topic": "/fz/topic",
    "type": "std_msgs/String",
}
_SERVICE = {
    "callerid": "/fuzzer/call",
    "md5sum": "6a2e34150c00229791cc89ff309fff21",
    "service": "/fz/service",
    "type": "roscpp_tutorials/TwoInts",
}
_KEPT = _SERVICE | {"persistent": "1"}
_WORDS = ("", "*", "/", "1", "0", "true", "/fz/topic", "/fz/none", "é", "\udcff", "\0", "a" * 3000)


class TcprosAttack:
    """One connection after the other to the port of a node."""

    def __init__(self, random: Random, port: int, batches: deque[bytes]) -> None:
        self._random = random
        self._port = port
        self._batches = batches  # what was sent last
        self.sent = self.answered = self.faults = self.refused = self.connections = 0

    async def run(self, budget: list[int]) -> None:
        """Send headers and requests while ``budget``, which is shared, has some left."""
        ways = (self._noise, self._header, self._header, self._topic, self._service, self._service)
        while budget[0] > 0:
            reader, writer = await asyncio.open_connection("127.0.0.1", self._port)
            self.connections += 1
            before = self.sent
            try:
                await self._random.choice(ways)(reader, writer)
            except ConnectionError:
                pass  # the node has had enough
            finally:
                writer.transport.abort()
            budget[0] -= self.sent - before
            await asyncio.sleep(0)

    def _send(self, writer: asyncio.StreamWriter, data: bytes) -> None:
        self._batches.append(data)
        self.sent += 1
        writer.write(data)

    # the ways

    async def _noise(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        random = self._random
        size = random.choice((0, 1, 4, 100, MAX_HEADER, MAX_HEADER + 1, 1 << 31, (1 << 32) - 1))
        prefix = random.choice((b"", struct.pack("<I", size)))
        self._send(writer, prefix + random.randbytes(random.choice((1, 4, 50, 500))))
        await self._leave(reader, writer)

    async def _header(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        random = self._random
        fields = dict(random.choice((_TOPIC, _SERVICE, _SERVICE | {"probe": "1"})))
        for _ in range(random.choice((0, 1, 1, 3))):
            name = random.choice((*fields, "error", "persistent", "probe", "x" * 300, "é"))
            if random.random() < 0.3:
                fields.pop(name, None)
            else:
                fields[name] = random.choice(_WORDS)
        if random.random() < 0.05:
            fields |= {f"field{number}": "" for number in range(random.choice((30, 300)))}
        data = bytearray(encode_header(fields))
        if random.random() < 0.5:
            for _ in range(random.choice((1, 1, 4))):
                at = random.randrange(len(data))
                data[at : at + random.choice((0, 1, 1, 9))] = random.choice(
                    (b"", b"\xff", b"\0", b"=", b"\xff\xff\xff\x7f", random.randbytes(3))
                )
        self._send(writer, bytes(data))
        await self._leave(reader, writer)

    async def _topic(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        """A subscriber that should not say a word, and does."""
        self._send(writer, encode_header(_TOPIC))
        async with asyncio.timeout(_PATIENCE):
            fields = await _read_header(reader)
        assert fields is not None, "a subscriber without an answer"
        assert fields["type"] == "std_msgs/String", fields
        self.answered += 1
        if self._random.random() < 0.7:
            self._send(writer, self._random.randbytes(self._random.choice((1, 100, 3000))))
        await self._leave(reader, writer, begun=True)

    async def _service(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        """A caller, first a good one."""
        random = self._random
        persistent = random.random() < 0.8
        self._send(writer, encode_header(_KEPT if persistent else _SERVICE))
        async with asyncio.timeout(_PATIENCE):
            fields = await _read_header(reader)
            assert fields is not None, "a caller without an answer"
            assert "error" not in fields, fields
            for _ in range(random.choice((1, 4, 20)) if persistent else 1):
                pairs = [
                    (random.randrange(-(1 << 40), 1 << 40), random.randrange(1 << 40))
                    for _ in range(random.choice((1, 1, 5)) if persistent else 1)
                ]
                data = b"".join(struct.pack("<Iqq", 16, a, b) for a, b in pairs)
                self.sent += len(pairs) - 1
                at = random.randrange(len(data)) if random.random() < 0.1 else len(data)
                self._send(writer, data[:at])
                await asyncio.sleep(0)
                writer.write(data[at:])
                for a, b in pairs:
                    answer = await _read_answer(reader)
                    assert answer == (1, struct.pack("<q", a + b)), f"{a} + {b} is {answer}"
                    self.answered += 1
            if persistent and random.random() < 0.5:
                # Not a request, or beyond the limit: refused, and that is the end.
                size = random.choice((0, 1, 15, MAX_FRAME + 1, (1 << 32) - 1))
                body = random.randbytes(min(size, 40))
                self._send(writer, struct.pack("<I", size) + body)
                answer = await _read_answer(reader)
                assert answer is not None, "no answer to what is no request"
                assert answer[0] == 0, answer
                assert answer[1], "no word of why it is refused"
                assert await reader.read() == b"", "more, behind a refusal"
                self.refused += 1
                return
        if persistent and random.random() < 0.7:
            size = random.choice((0, 16, 16, 17, MAX_FRAME))
            self._send(
                writer, struct.pack("<I", size) + random.randbytes(random.choice((0, 16, 40)))
            )
        await self._leave(reader, writer, begun=None)

    async def _leave(
        self,
        reader: asyncio.StreamReader,
        writer: asyncio.StreamWriter,
        begun: bool | None = False,
    ) -> None:
        """Look at what comes, if anything does; ``begun`` says whether frames are due, and
        is None where answers are."""
        if self._random.random() < 0.3:
            return
        if self._random.random() < 0.5 and not writer.is_closing():
            writer.write_eof()
        try:
            async with asyncio.timeout(_GLANCE):
                fields = {} if begun is not False else await _read_header(reader)
                if fields is None:
                    return
                if "error" in fields:
                    self.refused += 1
                    assert fields["error"].strip()
                    assert await reader.read() == b"", "more, behind an error"
                elif begun is None or "response_type" in fields:
                    while (answer := await _read_answer(reader)) is not None:
                        assert answer[0] == 0 or len(answer[1]) == 8, answer
                else:
                    while (body := await _read_frame(reader)) is not None:
                        assert body == b"\2\0\0\0fz", body
        except TimeoutError:
            pass


# What comes, read in the most obvious way. Half of anything is a mistake of the node, but
# where it has closed the connection at once.


async def _read_header(reader: asyncio.StreamReader) -> dict[str, str] | None:
    body = await _read_frame(reader)
    if body is None:
        return None
    return decode_header(body)


async def _read_frame(reader: asyncio.StreamReader) -> bytes | None:
    try:
        (size,) = struct.unpack("<I", await reader.readexactly(4))
        assert size <= 1 << 20, f"a frame of {size} bytes"
        return await reader.readexactly(size)
    except asyncio.IncompleteReadError as error:
        assert not error.partial, f"half a frame: {error.partial!r}"
        return None


async def _read_answer(reader: asyncio.StreamReader) -> tuple[int, bytes] | None:
    first = await reader.read(1)
    if not first:
        return None
    assert first in (b"\0", b"\1"), first
    body = await _read_frame(reader)
    assert body is not None, "half an answer"
    return first[0], body
