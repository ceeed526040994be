"""Octets to messages: every decoder of a type, on frames one behind the other.

An input is a byte that picks the type, then frames with ``SEPARATOR`` between them. All
of them are decoded by the same class, as the frames of a connection are, so that whatever
a decoder remembers of one is there when it reads the next; what should come out is read
by :mod:`fuzz.reference`, which remembers nothing.
"""

from __future__ import annotations

import re
import tracemalloc
from array import array
from collections.abc import Callable, Iterator
from functools import partial
from random import Random
from typing import Any
from zlib import crc32

from aioros1.errors import DeserializationError
from aioros1.idl import Message
from fuzz.catalogue import CLASSES
from fuzz.reference import MAX_EMPTY, Malformed, Reading, read, sample, tree

__all__ = ["SEPARATOR", "check", "check_frames", "seeds"]

SEPARATOR = b"\xf7\xf8\xf9"
TOKENS = [SEPARATOR, b"\xff\xff\xff\xff", b"\x01\0\0\0", b"\x02\0\0\0", b"\xff\xff\xff\x7f"]
MAX_LEN = 600
SHARE = 24

_MAX_FRAMES = 5
_KINDS = ("_decode", "from_bytes", "_decode_view", "_decode_views")
_ERROR = re.compile(r"(?P<type>\w+/\w+)(?:\.(?P<path>\S+))?: .+ at offset (?P<offset>\d+)", re.S)


def check(data: bytes) -> None:
    if len(data) < 2:
        return
    cls = CLASSES[data[0] % len(CLASSES)]
    if crc32(data) % 128 == 0:
        forget(cls)
    frames = data[2:].split(SEPARATOR, _MAX_FRAMES)[:_MAX_FRAMES]
    # One kind of decoder at a time is twice as many inputs in the same time.
    kind = data[1] % (len(_KINDS) + 1)
    check_frames(cls, frames, _KINDS[kind : kind + 1] or _KINDS)
    if crc32(data) % 128 == 1:
        check_memory(cls, data[2:])


def check_frames(cls: type[Message], frames: list[bytes], kinds: tuple[str, ...] = _KINDS) -> None:
    """Decode the frames, each in every way; AssertionError if one is not as it should be."""
    # As frames arrive: in memory that they share. What copies them gets some that changes.
    batch = b"\xaa\xbb" + b"".join(frames) + b"\x01\0\0\0\xcc"
    memory = bytearray(batch)
    sources = {"_decode": batch, "_decode_view": memoryview(memory)}
    sources["_decode_views"] = memoryview(batch)
    kept: list[tuple[Any, Reading]] = []
    start = 2
    for number, frame in enumerate(frames):
        stop = start + len(frame)
        right: Reading | Malformed
        try:
            right = read(cls, frame)
        except Malformed as error:
            right = error
        messages = []
        for kind in kinds:
            if kind == "from_bytes":
                left = len(frame) - right.used if isinstance(right, Reading) else 0
                # By way of the base class: a field may have the name of a method.
                decode = partial(Message.from_bytes.__func__, cls, frame)  # type: ignore[attr-defined]
                message = _decoded(cls, decode, len(frame), right, left)
            else:
                decode = partial(getattr(cls, kind), sources[kind], start, stop)
                message = _decoded(cls, decode, len(frame), right)
            if message is not None:
                messages.append(message)
        if isinstance(right, Reading) and messages:
            if len(kinds) > 1:
                _check_encoders(cls, messages[0], right.octets)
            if len(messages) > 1 or number % 2 == 0:
                spoil(messages.pop(0))
            kept += [(message, right) for message in messages]
        start = stop
    memory[:] = bytes(len(memory))
    for message, right in kept:
        # Unharmed by what was decoded later, and by changes to what was.
        assert cls._encode(message) == right.octets, "a message changed behind its owner's back"


def _decoded(
    cls: type[Message],
    decode: Callable[[], Any],
    size: int,
    right: Reading | Malformed,
    left: int = 0,
) -> Any:
    """The message, if it should be one; ``left`` octets too many make it an error."""
    try:
        message = decode()
    except DeserializationError as error:
        assert left or isinstance(right, Malformed), f"refused: {error}"
        _check_error(cls, str(error), right, size)
        return None
    assert isinstance(right, Reading), f"accepted what is malformed: {right}"
    assert not left, f"accepted {left} octets too many"
    assert tree(cls, message) == right.tree, f"{message!r} instead of {right.tree}"
    return message


def _check_error(cls: type[Message], text: str, right: Reading | Malformed, size: int) -> None:
    """An error names type, field and offset; the field is the one, or has it inside."""
    match = _ERROR.fullmatch(text)
    assert match is not None, f"neither type nor offset: {text}"
    assert match["type"] == cls._type, text
    assert "unknown" not in text, text
    offset = int(match["offset"])
    if isinstance(right, Reading):
        assert f"{cls._type}: {size - right.used} bytes too many" in text, text
        assert offset == right.used, text
        return
    path = match["path"]
    assert path, f"{text}, where it is {right}"
    assert re.match(rf"{re.escape(path)}(?![^.\[])", right.path), f"{text}, where it is {right}"
    assert offset <= right.offset <= size, f"{text}, where it is {right}"


def _check_encoders(cls: type[Message], message: Any, octets: bytes) -> None:
    assert cls._encode(message) == octets
    frame = len(octets).to_bytes(4, "little") + octets
    assert cls._frame(message) == frame
    assert b"".join(cls._frame_parts(message)) == frame


def spoil(message: Any) -> None:
    """Change everything in a message that can be changed, as its owner may."""
    for field in message._fields:
        value = getattr(message, field.name)
        nested = message._nested.get(field.base_type)
        if nested is not None and nested._fields:
            for item in value if field.is_array else [value]:
                spoil(item)
        if type(value) is list:
            value.reverse()
            value.append(None)
        elif type(value) is array:
            value.append(1)
        setattr(message, field.name, None)


def forget(cls: type[Message]) -> None:
    """Let go of the decoders of a class: new ones remember nothing."""
    for name in (*_KINDS, "_from_bytes"):
        if name in cls.__dict__:
            delattr(cls, name)


def check_memory(cls: type[Message], data: bytes) -> None:
    """No decoder takes memory but for octets that are there."""
    limit = 100_000 + 400 * len(data) + 200 * MAX_EMPTY * _has_hollows(cls)
    view = memoryview(data)
    for decode, source in (
        (cls._decode, data),
        (cls._decode_view, view),
        (cls._decode_views, view),
    ):
        # Once before, as decoders are made when they are needed.
        for traced in (False, True):
            if traced:
                tracemalloc.start()
            try:
                decode(source, 0, len(data))
            except DeserializationError:
                pass
            finally:
                _, peak = tracemalloc.get_traced_memory()
                tracemalloc.stop()
        assert peak < limit, f"{peak} bytes of memory for {len(data)} octets"


def _has_hollows(cls: type[Message]) -> bool:
    return any(
        (field.is_array and nested._fixed_size == 0) or _has_hollows(nested)
        for field in cls._fields
        if (nested := cls._nested.get(field.base_type)) is not None
    )


def seeds() -> Iterator[bytes]:
    """Frames of each type: alike, of other lengths, cut short, with something behind."""
    for number, cls in enumerate(CLASSES):
        for shape in range(4):
            values = Random(number)
            alike = [sample(cls, values, Random(shape)) for _ in range(3)]
            others = [sample(cls, values, Random(other)) for other in range(100, 200)]
            # One of the same size if there is any: with other lengths inside.
            other = next((o for o in others if len(o) == len(alike[0])), others[0])
            frames = [*alike[:2], other, alike[2], alike[1][:-1]]
            for kind in range(len(_KINDS)):
                for few in (frames, [alike[0], *frames[3:5]], alike[:2], alike[:1]):
                    whole = bytes([number, kind]) + SEPARATOR.join(few)
                    if len(whole) <= MAX_LEN or len(few) == 1:
                        yield whole
                        break
