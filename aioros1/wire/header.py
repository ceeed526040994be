"""Connection headers: the ``name=value`` fields both sides of a TCPROS connection send first.

On the wire a header is a 32-bit length and then its fields, each a 32-bit length
and ``name=value``; all lengths are little-endian
(https://wiki.ros.org/ROS/Connection%20Header). ROS treats values as bytes. Here they
are text; bytes that are not UTF-8 are kept by ``surrogateescape``.
"""

from __future__ import annotations

import struct
from collections.abc import Mapping

__all__ = ["HeaderError", "HeaderParser", "decode_header", "encode_header"]

_U32 = struct.Struct("<I")


class HeaderError(ValueError):
    """These bytes are not a connection header, or not one within the limits."""


def encode_header(fields: Mapping[str, str]) -> bytes:
    """Encode a header, with its length in front.

    Raises :class:`ValueError` for a name that is empty or holds ``=``, which the
    other side could not tell from the value.
    """
    parts = []
    for name, value in fields.items():
        if not name or "=" in name:
            raise ValueError(f"connection header field {name!r}: the name must not hold '='")
        field = f"{name}={value}".encode("utf-8", "surrogateescape")
        parts.append(_U32.pack(len(field)))
        parts.append(field)
    body = b"".join(parts)
    return _U32.pack(len(body)) + body


def decode_header(body: bytes, *, max_fields: int = 256) -> dict[str, str]:
    """Decode the fields of a header, given the bytes after its length.

    If a name occurs twice, its last value counts. The value is everything after the first
    ``=``. White space around a name does not count. rospy and roscpp do the same. A field
    with an empty name says nothing and is left out.
    """
    fields: dict[str, str] = {}
    position, end = 0, len(body)
    count = 0
    while position < end:
        if end - position < 4:
            raise HeaderError(f"{end - position} stray bytes at the end of the header")
        (length,) = _U32.unpack_from(body, position)
        start = position + 4
        position = start + length
        if position > end:
            raise HeaderError(
                f"a field of {length} bytes at offset {start - 4} passes the end of the "
                f"header of {end} bytes"
            )
        count += 1
        if count > max_fields:
            raise HeaderError(f"more than {max_fields} fields")
        name, separator, value = body[start:position].partition(b"=")
        if not separator:
            raise HeaderError(f"field {body[start:position][:80]!r} is not name=value")
        if name := name.strip():
            text = value.decode("utf-8", "surrogateescape")
            fields[name.decode("utf-8", "surrogateescape")] = text
    return fields


class HeaderParser:
    """Takes bytes as they arrive, and returns the header once it is complete.

    Memory grows with the bytes received, not with the length announced. A header that
    announces more than ``max_bytes`` is refused at once.
    """

    __slots__ = ("_buffer", "_max_bytes", "_max_fields")

    def __init__(self, *, max_bytes: int = 1 << 20, max_fields: int = 256) -> None:
        self._buffer = bytearray()
        self._max_bytes = max_bytes
        self._max_fields = max_fields

    def __repr__(self) -> str:
        return f"<HeaderParser, {len(self._buffer)} bytes waiting>"

    def feed(self, data: bytes) -> dict[str, str] | None:
        """Add ``data``, and return the fields, or None while bytes are missing.

        Raises :class:`HeaderError`. Bytes after the header are in :attr:`rest`.
        """
        self._buffer += data
        wanted = self.missing()
        if wanted:
            return None
        (length,) = _U32.unpack_from(self._buffer)
        body = bytes(self._buffer[4 : 4 + length])
        del self._buffer[: 4 + length]
        return decode_header(body, max_fields=self._max_fields)

    def missing(self) -> int:
        """Return how many bytes are certainly missing: first of the length, then of the body."""
        have = len(self._buffer)
        if have < 4:
            return 4 - have
        (length,) = _U32.unpack_from(self._buffer)
        if not length:
            raise HeaderError("an empty header")
        if length > self._max_bytes:
            raise HeaderError(f"a header of {length} bytes, more than {self._max_bytes}")
        return max(0, 4 + int(length) - have)

    @property
    def rest(self) -> bytes:
        """Bytes fed beyond the end of the header."""
        return bytes(self._buffer)
