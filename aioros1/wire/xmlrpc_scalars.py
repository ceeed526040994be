"""What both readers of XML-RPC documents share: scalars, and the error."""

from __future__ import annotations

import re
from binascii import Error as Base64Error
from binascii import a2b_base64
from collections.abc import Callable
from datetime import datetime, timedelta
from typing import Any

from aioros1._public import public

__all__ = ["BLANK", "INT_MAX", "INT_MIN", "SCALARS", "WIDE_SCALARS", "XmlRpcError", "brief"]

INT_MIN, INT_MAX = -(1 << 31), (1 << 31) - 1

BLANK = " \t\r\n"
"""White space in XML."""


@public("aioros1.wire.xmlrpc")
class XmlRpcError(ValueError):
    """The received bytes are not an XML-RPC document, or not an acceptable one."""


def brief(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."


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
        if "_" not in text:
            return float(text)
    except ValueError:
        pass
    raise ValueError(f"not a double: {brief(text)}")


def _to_bytes(text: str) -> bytes:
    try:
        return a2b_base64("".join(text.split()), strict_mode=True)
    except (Base64Error, ValueError):
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
