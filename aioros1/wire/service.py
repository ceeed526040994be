"""The frames of a service connection, after the headers.

A request is a frame. An answer is one byte, 1 for success and 0 for failure, and a
frame: the response, or the text of the error
(https://wiki.ros.org/ROS/TCPROS, "Service client").
"""

from __future__ import annotations

import struct

__all__ = [
    "ANSWER_HEAD",
    "FAILURE",
    "REQUEST_HEAD",
    "SUCCESS",
    "ServiceFrameError",
    "encode_failure",
    "frame_length",
]

REQUEST_HEAD = 4
"""Bytes before a request: its length."""
ANSWER_HEAD = 5
"""Bytes before a response, or the text of an error: success or failure, and the length."""

SUCCESS = b"\x01"
FAILURE = b"\x00"

_U32 = struct.Struct("<I")


class ServiceFrameError(ValueError):
    """A request or an answer beyond the limit."""


def frame_length(prefix: bytes | bytearray, max_bytes: int) -> int:
    """Return the length in the four bytes ``prefix``.

    Raises :class:`ServiceFrameError` if it is more than ``max_bytes``.
    """
    (length,) = _U32.unpack(prefix)
    if length > max_bytes:
        raise ServiceFrameError(f"a frame of {length} bytes, more than {max_bytes}")
    return int(length)


def encode_failure(text: str) -> bytes:
    """Make the answer that carries an error instead of a response."""
    try:
        data = text.encode("utf-8", "surrogateescape")
    except UnicodeEncodeError:  # surrogates that stand for no byte
        data = text.encode("utf-8", "backslashreplace")
    return FAILURE + _U32.pack(len(data)) + data
