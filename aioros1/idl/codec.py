"""What the other packages use of message classes: their codecs, and genpy's names.

A role asks for the functions that it needs once, when it is made, and calls them as they
are from then on::

    codec = codec_of(String)
    frame = codec.frame
    frame(String(data="hello"))  # b"\\t\\0\\0\\0\\5\\0\\0\\0hello"

A function is compiled when it is asked for. It never changes afterwards: what a decoder
learns of the layout of messages is inside of it. So whoever keeps one has the quickest
way there is, and those who share a class share what has been learned.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final, Generic, TypeVar

from aioros1.idl.message import Message

__all__ = ["GENPY_NAMES", "Codec", "codec_of"]

M = TypeVar("M", bound=Message)

GENPY_NAMES: Final = frozenset(
    {
        "_connection_header",
        "_full_text",
        "_get_types",
        "_has_header",
        "_md5sum",
        "_request_class",
        "_response_class",
        "_slot_types",
        "_type",
    }
)
"""Attributes of message and service classes that any package may use, though they begin
with an underscore: genpy named them so, and programs for rospy rely on them. Beside these
there is ``__slots__``, the names of a message's fields."""


class Codec(Generic[M]):
    """The functions that encode and decode messages of one class.

    None of them takes keywords. Encoders take a message of the class, or one that looks
    the same, and raise :class:`~aioros1.SerializationError`. Decoders take a buffer, the
    position at which the message begins and the one at which it ends, which has to lie
    within the buffer. They raise :class:`~aioros1.DeserializationError` for too few bytes;
    bytes of the message that are left over are ignored.
    """

    __slots__ = ("message_class",)

    def __init__(self, message_class: type[M]) -> None:
        self.message_class = message_class

    def __repr__(self) -> str:
        return f"<codec of {self.message_class._type}>"

    @property
    def has_bulk(self) -> bool:
        """Whether messages may hold so much that :attr:`frame_parts` pays: an array of
        numbers of any length."""
        return self.message_class._has_bulk

    @property
    def encode(self) -> Callable[[Any], bytes]:
        """The bytes of a message."""
        return self.message_class._encode

    @property
    def frame(self) -> Callable[[Any], bytes]:
        """The bytes of a message behind their number, as they are sent over TCPROS."""
        return self.message_class._frame

    @property
    def frame_parts(self) -> Callable[[Any], list[bytes | memoryview]]:
        """The same in one or more parts, so that large payloads of bytes are not copied."""
        return self.message_class._frame_parts

    @property
    def decode(self) -> Callable[[bytes, int, int], M]:
        """A message from a :class:`bytes` object."""
        return self.message_class._decode

    @property
    def decode_view(self) -> Callable[[memoryview, int, int], M]:
        """A message from a :class:`memoryview`; each payload is copied once."""
        return self.message_class._decode_view

    @property
    def decode_views(self) -> Callable[[memoryview, int, int], M]:
        """A message from a :class:`memoryview`, with views into it in place of arrays of
        numbers."""
        return self.message_class._decode_views


def codec_of(message_class: type[M]) -> Codec[M]:
    """The codec of a message class of ours."""
    return Codec(message_class)
