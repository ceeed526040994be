"""A service connection: its header, and the frames behind it, however they come and are taken.

:class:`.ServiceLink` is driven by hand, with a transport and a clock that are not there:
bytes come in pieces, the role asks for a frame now and then, half a frame takes too long,
the other side takes nothing of what is written. What the role gets must be what a reader
that has the whole stream before it would get.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Coroutine, Iterator
from typing import Any

from aioros1.errors import HandshakeError
from aioros1.net import service_link
from aioros1.net.service_link import ServiceLink
from aioros1.wire.handshake import Server, ServiceClient, ServiceOffer
from aioros1.wire.service import (
    ANSWER_HEAD,
    REQUEST_HEAD,
    SUCCESS,
    ServiceFrameError,
    encode_failure,
)

__all__ = ["check", "seeds"]

TOKENS = [
    *(b"\0\0\0\0", b"\1\0\0\0", b"\5\0\0\0", b"\x90\1\0\0", b"\x91\1\0\0", b"\xff\xff\xff\xff"),
    *(b"\1\0\0\0\0", b"\0\2\0\0\0no", b"service=/s", b"md5sum=abc", b"callerid=/a", b"error=no"),
]
MAX_LEN = 700
SHARE = 5

_MAX_BYTES = 400
_AHEAD = 64
"""In place of the real figure, so that inputs of a few hundred octets exceed it."""
_OFFER = ServiceOffer("/s", "p/S", "abc")
_LIMITS: Any = {"max_bytes": 300, "max_fields": 8}
_PATIENCE = 7.0
_SCRIPT = 63


class _Loop:
    """As much of an event loop as a link needs: futures, and one timer at a time."""

    def __init__(self) -> None:
        self.timers: list[_Timer] = []

    def get_debug(self) -> bool:
        return False

    def create_future(self) -> asyncio.Future[Any]:
        return asyncio.Future(loop=self)  # type: ignore[arg-type]

    def call_later(self, seconds: float, function: Callable[..., None], *args: Any) -> _Timer:
        assert seconds == _PATIENCE
        self.timers = [timer for timer in self.timers if not timer.is_over]
        assert not self.timers, "two clocks for one frame"
        self.timers.append(_Timer(function, args))
        return self.timers[-1]

    def call_exception_handler(self, context: dict[str, Any]) -> None:
        raise AssertionError(context["message"])

    @property
    def timer(self) -> _Timer | None:
        return next((timer for timer in self.timers if not timer.is_over), None)


class _Timer:
    def __init__(self, function: Callable[..., None], args: tuple[Any, ...]) -> None:
        self._function, self._args = function, args
        self.is_over = False

    def cancel(self) -> None:
        self.is_over = True

    def fire(self) -> None:
        self.is_over = True
        self._function(*self._args)


class _Transport(asyncio.Transport):
    def __init__(self) -> None:
        super().__init__()
        self.is_paused = False
        self._is_closed = False

    def pause_reading(self) -> None:
        self.is_paused = True

    def resume_reading(self) -> None:
        self.is_paused = False

    def is_closing(self) -> bool:
        return self._is_closed

    def abort(self) -> None:
        self._is_closed = True


class _Stream:
    peer = "peer"

    def __init__(self) -> None:
        self.transport = _Transport()


class _Role:
    """Takes the frames of a link, one after the other, when it is told to."""

    def __init__(self, link: ServiceLink) -> None:
        self._link = link
        self._receiving: Coroutine[Any, Any, Any] | None = None
        self._future: Any = None
        self.frames: list[bytes] = []
        self.end: object = ...  # None, or the error that ended it

    @property
    def is_over(self) -> bool:
        return self.end is not ...

    @property
    def has_asked(self) -> bool:
        """Whether it has asked for a frame, and not yet taken it."""
        return self._receiving is not None

    @property
    def waits(self) -> bool:
        """Whether it waits for what has not come."""
        return self._receiving is not None and not self._future.done()

    def turn(self) -> None:
        """Ask for a frame, or take the one that was asked for."""
        if self.is_over or self.waits:
            return
        if self._receiving is None:
            self._receiving = self._link.receive(patience=None)
        try:
            self._future = self._receiving.send(None)
        except StopIteration as done:
            self._receiving = None
            if done.value is None:
                self.end = None
            else:
                self.frames.append(done.value)
        except (OSError, ServiceFrameError) as error:
            self._receiving = None
            self.end = error
        else:
            self._future._asyncio_future_blocking = False

    def leave(self) -> None:
        if self._receiving is not None:
            self._receiving.close()


def check(data: bytes) -> None:
    """What comes, an octet; how much of a script, an octet; the script; the stream.

    An octet of the script is bytes that come, a turn of the role, or a mishap.
    """
    if len(data) < 2:
        return
    how, length = data[0], data[1] & _SCRIPT
    script, stream = data[2 : 2 + length], data[2 + length :]
    if how & 2:
        rest = _behind_header(stream, server=how & 1 == 0, piece=data[1] or 1)
        if rest is None:
            return
        stream = rest
    loop = _Loop()
    ahead, service_link._AHEAD = service_link._AHEAD, _AHEAD
    asyncio._set_running_loop(loop)  # type: ignore[arg-type]
    try:
        _check_link(loop, how, script, stream)
    finally:
        asyncio._set_running_loop(None)
        service_link._AHEAD = ahead


def _behind_header(stream: bytes, *, server: bool, piece: int) -> bytes | None:
    """What is left of the stream for the link, as connections read it: not a byte too much."""
    side: Any = Server("peer", **_LIMITS)
    if not server:
        side = ServiceClient("peer", "/me", _OFFER, **_LIMITS)
    position = 0
    while position < len(stream):
        count = min(side.missing, piece)
        assert count > 0
        came = stream[position : position + count]
        position += len(came)
        try:
            if side.receive_data(came):
                break
        except HandshakeError as error:
            assert str(error).strip(), "an error without a word"
            return None
    else:
        return None
    assert position == 4 + int.from_bytes(stream[:4], "little")
    return stream[position:]


def _expected(stream: bytes, head: int) -> tuple[list[bytes], bytes, bool]:
    """The frames with their heads, what is left, and whether that is beyond the limit."""
    frames: list[bytes] = []
    while len(stream) >= head:
        size = int.from_bytes(stream[head - 4 : head], "little")
        if size > _MAX_BYTES:
            return frames, stream, True
        if len(stream) < head + size:
            break
        frames.append(stream[: head + size])
        stream = stream[head + size :]
    return frames, stream, False


def _check_link(loop: _Loop, how: int, script: bytes, stream: bytes) -> None:
    head = ANSWER_HEAD if how & 1 else REQUEST_HEAD
    source = _Stream()
    transport = source.transport
    link = ServiceLink(
        source,  # type: ignore[arg-type]
        head=head,
        max_bytes=_MAX_BYTES,
        patience=_PATIENCE,
        stall=_PATIENCE,
    )
    role = _Role(link)
    is_full = False

    def at_once(frame: bytes) -> bytes | None:
        assert not is_full, "answered at once to one that takes nothing"
        assert role.waits, "handed over what nobody asked for"
        if len(frame) % 2:
            return frame
        role.frames.append(frame)
        return None

    if how & 4:
        link.at_once = at_once
    position, step, expired = 0, 0, False
    largest = 0
    while position < len(stream) and not role.is_over and not expired:
        # Behind the script a turn and a piece of the stream, one after the other.
        action = script[step] if step < len(script) else (5, 0xF8)[step % 2]
        step += 1
        kind, amount = action & 7, action >> 3
        if kind == 5:
            role.turn()
        elif kind == 6:
            (link.resume_writing if is_full else link.pause_writing)()
            is_full = not is_full
            assert link.is_full is is_full
        elif kind == 7:
            timer = loop.timer
            if timer is not None:
                expired = role.waits  # else it comes too late to matter
                timer.fire()
        elif transport.is_paused:
            assert not role.waits, "waits for what it does not read"
            role.turn()
        else:
            wanted = role.has_asked or len(link._buffer) <= max(_AHEAD, largest)
            assert wanted, "reads on, though nobody wants it"
            count = 8 * amount + 8 if kind == 4 else amount + 1
            piece = stream[position : position + count]
            position += len(piece)
            largest = max(largest, len(piece))
            link.data_received(piece)
        _check_state(loop, link, role, stream[:position], head, largest)
    came = stream[:position]
    frames, rest, broken = _expected(came, head)
    if expired:
        assert rest, "impatient, where no frame is incomplete"
        role.turn()
        assert isinstance(role.end, TimeoutError), role.end
        assert role.frames == frames
    else:
        failure = _finish(link, how)
        while not role.is_over:
            assert not role.waits, "waits beyond the end"
            role.turn()
        assert role.frames == frames, "other frames than those that came"
        if broken:
            assert isinstance(role.end, ServiceFrameError), role.end
        else:
            assert role.end is failure, role.end
    role.leave()
    assert loop.timer is None, "a clock that goes on"
    for frame in frames if head == ANSWER_HEAD else []:
        if frame[:1] != SUCCESS:
            text = frame[ANSWER_HEAD:].decode("utf-8", "surrogateescape")
            assert encode_failure(text)[1:] == frame[1:]


def _finish(link: ServiceLink, how: int) -> OSError | None:
    """The end of a connection, in one of four ways; the error that it should be."""
    way = how >> 4 & 3
    if way == 0:
        link.eof_received()
    elif way == 1:
        link.stop_reading()
    else:
        failure = ConnectionResetError("reset") if way == 2 else None
        link.connection_lost(failure)
        return failure
    return None


def _check_state(
    loop: _Loop, link: ServiceLink, role: _Role, came: bytes, head: int, largest: int
) -> None:
    """What must hold at any time; ``came`` is all that has come."""
    held = len(link._buffer)
    assert held <= max(_AHEAD, head + _MAX_BYTES) + largest, f"{held} bytes in memory"
    if role.is_over:
        return
    left = len(came) - sum(map(len, role.frames))
    if role.waits:
        assert not _expected(came, head)[2], "waits behind a frame beyond the limit"
        assert (loop.timer is not None) is (left > 0), "a clock without half a frame, or none with"
        assert held == left
    else:
        assert held <= left
        assert link.is_fresh is (held == 0)


def seeds() -> Iterator[bytes]:
    def requests(*sizes: int) -> bytes:
        return b"".join(size.to_bytes(4, "little") + bytes(size) for size in sizes)

    def answers(*sizes: int) -> bytes:
        return b"".join(bytes([size % 2]) + requests(size) for size in sizes)

    server = Server("peer", **_LIMITS)
    client = ServiceClient("peer", "/me", _OFFER, persistent=True).data_to_send()
    server.receive_data(client)
    headers = (client, server.accept_service("/me", _OFFER))
    scripts = (b"", b"\5", b"\5\0", b"\5\xfc", b"\0\0\5", b"\5\6\x1b\6\x1b", b"\5\1\7", b"\x7c" * 3)
    for side, frames in enumerate((requests, answers)):
        streams = [frames(0, 1, 5), frames(300, 2, 70), frames(70)[:-1], frames(1, 401, 2)]
        streams += [frames(400, 0), frames(*range(20)), frames(3) + b"\xff" * 5]
        for number, stream in enumerate(streams):
            for script in scripts:
                how = side | 4 * (number % 2) | 16 * (number % 4)
                yield bytes([how, len(script)]) + script + stream
        header = headers[side]
        for piece in (b"\0", b"\1", b"\5"):
            for stream in (header, header + streams[0], header[:-2], header + streams[3]):
                script = b"\5\xfc\0\0\0"[: piece[0]]
                yield bytes([side | 2]) + piece + script + stream
