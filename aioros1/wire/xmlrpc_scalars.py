"""What both readers of XML-RPC documents share: scalars, and the error."""

from __future__ import annotations

import re
import reprlib
from binascii import Error as Base64Error
from binascii import a2b_base64
from collections.abc import Callable
from datetime import datetime, timedelta
from itertools import islice
from typing import Any

from aioros1._public import public

__all__ = [
    "BLANK",
    "INT_MAX",
    "INT_MIN",
    "SCALARS",
    "WIDE_SCALARS",
    "XmlRpcError",
    "brief",
    "to_bytes_so_far",
]

INT_MIN, INT_MAX = -(1 << 31), (1 << 31) - 1

BLANK = " \t\r\n"
"""White space in XML."""


@public("aioros1.wire.xmlrpc")
class XmlRpcError(ValueError):
    """The received bytes are not an XML-RPC document, or not an acceptable one."""


def brief(value: object) -> str:
    """The beginning of ``repr(value)``, however large the value is."""
    text = _BRIEF.repr(value)
    return text if len(text) <= 60 else text[:57] + "..."


class _Brief(reprlib.Repr):
    def repr_bytes(self, x: bytes, level: int) -> str:
        return repr(x[:60])

    repr_bytearray = repr_bytes

    def repr_str(self, x: str, level: int) -> str:
        return repr(x[:60])

    def repr_dict(self, x: dict[Any, Any], level: int) -> str:
        if level <= 0:
            return "{...}"
        items = islice(x.items(), 20)
        texts = (f"{brief(key)}: {self.repr1(item, level - 1)}" for key, item in items)
        return f"{{{', '.join(texts)}}}"


_BRIEF = _Brief()
_BRIEF.maxlist = _BRIEF.maxtuple = 30


_LONGEST_DOUBLE = 10_000  # characters; exact ones have up to 800
_WHITE = b" \t\n\r\x0b\x0c"

_INTEGER = re.compile(r"[+-]?[0-9]+")
_DATETIME = re.compile(
    r"([0-9]{4})-?([0-9]{2})-?([0-9]{2})T([0-9]{2}):?([0-9]{2}):?([0-9]{2})(?:[.,][0-9]+)?"
    r"(?:Z|([+-][0-9]{2}):?([0-9]{2})?)?"
)


def _to_wide(text: str) -> int:
    text = text.strip(BLANK)
    if _INTEGER.fullmatch(text) is None or len(text) > 1000:
        raise ValueError(f"not an int: {brief(text)}")
    return int(text)


def _to_int(text: str) -> int:
    value = _to_wide(text)
    # Python's own servers accept more, but can never send it back.
    if not INT_MIN <= value <= INT_MAX:
        raise ValueError(f"an XML-RPC int has 32 bits: {brief(value)}")
    return value


def _to_bool(text: str) -> bool:
    text = text.strip(BLANK)
    if text not in ("0", "1"):
        raise ValueError(f"not a boolean (0 or 1): {brief(text)}")
    return text == "1"


def _to_float(text: str) -> float:
    try:
        if "_" not in text and len(text) <= _LONGEST_DOUBLE:
            return float(text)
    except ValueError:
        pass
    raise ValueError(f"not a double: {brief(text)}")


def _to_bytes(text: str) -> bytes:
    try:
        return a2b_base64(text.encode("ascii").translate(None, _WHITE), strict_mode=True)
    except (Base64Error, ValueError):
        raise ValueError(f"not base64: {brief(text)}") from None


def to_bytes_so_far(text: str) -> tuple[bytes, str]:
    """Convert the beginning of a base64 text; returns the bytes and the rest of the text.

    Nothing is converted once the end of the text is in sight. Raises :class:`ValueError`.
    """
    if "=" in text:
        return b"", text
    data = text.encode("ascii").translate(None, _WHITE)
    whole = len(data) & ~3
    try:
        return a2b_base64(data[:whole], strict_mode=True), data[whole:].decode()
    except Base64Error:
        raise ValueError(f"not base64: {brief(text)}") from None


def _to_datetime(text: str) -> datetime:
    match = _DATETIME.fullmatch(text.strip(BLANK))
    try:
        if match is not None:
            year, month, day, hour, minute, second = map(int, match.groups()[:6])
            hours, minutes = match[7] or "0", match[8] or "0"
            offset = timedelta(hours=int(hours), minutes=int(hours[:1] + minutes))
            # XML-RPC knows no time zones, so that this is the time in UTC.
            return datetime(year, month, day, hour, minute, second) - offset
    except (ValueError, OverflowError):
        pass
    raise ValueError(f"not a dateTime (19980717T14:08:55): {brief(text)}")


def _to_nil(text: str) -> None:
    if text.strip(BLANK):
        raise ValueError(f"nil has no value: {brief(text)}")


SCALARS: dict[str, Callable[[str], Any]] = {
    **dict.fromkeys(("int", "i4", "i1", "i2", "i8", "biginteger"), _to_int),
    "boolean": _to_bool,
    **dict.fromkeys(("double", "float", "bigdecimal"), _to_float),
    "string": str,
    "base64": _to_bytes,
    **dict.fromkeys(("dateTime.iso8601", "dateTime"), _to_datetime),
    "nil": _to_nil,
}
"""The function for each element that converts its text. All raise :class:`ValueError`.

Those beside the standard's are extensions of Apache's that Python's parser reads as well.
"""

WIDE_SCALARS = SCALARS | dict.fromkeys(
    (name for name, convert in SCALARS.items() if convert is _to_int), _to_wide
)
"""The same, for ints of any size. Some nodes number their connections with 63 bits."""
