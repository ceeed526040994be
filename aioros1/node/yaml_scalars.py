"""Single values in YAML 1.1, for installations without PyYAML.

Every ROS 1 program reads ``_rate:=10`` as YAML, in the version of 2005: ``yes`` and ``on`` are
true, ``010`` is 8, ``1:30`` is 90, and ``1e5`` is text, because a float has a point. One value
on one line is read here the way PyYAML reads it. Anything else needs PyYAML.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from datetime import date, datetime
from typing import Any

__all__ = ["NeedsYamlError", "read_scalar"]


class NeedsYamlError(Exception):
    """The text is, or may be, more than one plain or quoted value."""


def read_scalar(text: str) -> Any:
    """Read one value. Raises :class:`NeedsYamlError`, and :class:`ValueError` for what is no
    YAML."""
    unprintable = _UNPRINTABLE.search(text)
    if unprintable is not None:
        raise ValueError(f"the character {unprintable[0]!r} is not allowed")
    if _LINE_END.search(text) or text.startswith("\ufeff"):
        raise NeedsYamlError
    text = text.strip(" ")
    first = text[:1]
    if first == "'":
        return _quoted(text, _SINGLE, lambda inner: inner.replace("''", "'"))
    if first == '"':
        return _quoted(text, _DOUBLE, lambda inner: _ESCAPE.sub(_unescape, inner))
    return _plain(text)


_UNPRINTABLE = re.compile("[^\t\n\r -~\x85\xa0-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_LINE_END = re.compile("[\n\r\x85\u2028\u2029]")

# ---------------------------------------------------------------------------- quoted

_SINGLE = re.compile("'((?:[^']|'')*)'")
_DOUBLE = re.compile(r'"((?:[^"\\]|\\.)*)"')
_ESCAPE = re.compile(r"\\(?:x([0-9A-Fa-f]{2})|u([0-9A-Fa-f]{4})|U([0-9A-Fa-f]{8})|(.))")
_ESCAPED = {
    "0": "\0",
    "a": "\a",
    "b": "\b",
    "t": "\t",
    "\t": "\t",
    "n": "\n",
    "v": "\v",
    "f": "\f",
    "r": "\r",
    "e": "\x1b",
    " ": " ",
    '"': '"',
    "/": "/",
    "\\": "\\",
    "N": "\x85",
    "_": "\xa0",
    "L": "\u2028",
    "P": "\u2029",
}


def _quoted(text: str, pattern: re.Pattern[str], unquote: Callable[[str], str]) -> str:
    match = pattern.match(text)
    if match is None:
        raise ValueError("the closing quote is missing")
    rest = text[match.end() :].lstrip(" ")
    if _KEY.match(rest):
        raise NeedsYamlError
    if rest and not rest.startswith("#"):
        raise ValueError("there is something behind the closing quote")
    return unquote(match[1])


def _unescape(match: re.Match[str]) -> str:
    code = match[1] or match[2] or match[3]
    if code:
        return chr(int(code, 16))
    if match[4] not in _ESCAPED:
        raise ValueError(f"unknown escape {match[0]!r}")
    return _ESCAPED[match[4]]


# ---------------------------------------------------------------------------- plain

# Collections, anchors, tags, blocks of text, keys, and the beginning and end of documents.
_MORE = re.compile(r"[\[{&*!|>]|[-?:](?= |\t|$)|(?:---|\.\.\.)(?= |\t|$)")
_KEY = re.compile(r":(?= |\t|$)")
_COMMENT = re.compile(r"(?:^| )#")

_WORDS: dict[str, Any] = {"~": None}
for _word, _value in {
    "null": None,
    "true": True,
    "false": False,
    "yes": True,
    "no": False,
    "on": True,
    "off": False,
}.items():
    _WORDS |= dict.fromkeys((_word, _word.capitalize(), _word.upper()), _value)

_SEXAGESIMAL = r"(?::[0-5]?[0-9])+"
_INT = re.compile(
    r"[-+]?(?:0b[01_]+|0x[0-9a-fA-F_]+|0[0-7_]+|0|[1-9][0-9_]*" + f"(?:{_SEXAGESIMAL})?)"
)
_FLOAT = re.compile(
    r"[-+]?[0-9][0-9_]*\.[0-9_]*(?:[eE][-+][0-9]+)?"
    r"|\.[0-9][0-9_]*(?:[eE][-+][0-9]+)?"
    rf"|[-+]?[0-9][0-9_]*{_SEXAGESIMAL}\.[0-9_]*"
    r"|[-+]?\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN)"
)
_DATE = re.compile(r"([0-9]{4})-([0-9]{2})-([0-9]{2})")
_TIME = re.compile(
    r"([0-9]{4})-([0-9]{1,2})-([0-9]{1,2})(?:[Tt]|[ \t]+)"
    r"([0-9]{1,2}):([0-9]{2}):([0-9]{2})(?:\.([0-9]*))?"
    r"(?:[ \t]*(Z|[-+][0-9]{1,2}(?::[0-9]{2})?))?"
)


def _plain(text: str) -> Any:
    comment = _COMMENT.search(text)
    if comment is not None:
        text = text[: comment.start()].rstrip(" ")
    if _MORE.match(text):
        raise NeedsYamlError
    if text[:1] in tuple(",]}%@`"):
        raise ValueError(f"no value begins with {text[0]!r}")
    if _KEY.search(text):
        raise NeedsYamlError
    if "\t" in text:
        raise ValueError("a tab is allowed in quotes only")
    if text in ("=", "<<"):
        raise ValueError(f"{text!r} has a meaning of its own, and has to be in quotes")
    if not text:
        return None
    if text in _WORDS:
        return _WORDS[text]
    if _FLOAT.fullmatch(text):
        return _to_float(text.replace("_", "").lower())
    if _INT.fullmatch(text):
        return _to_int(text.replace("_", ""))
    if match := _DATE.fullmatch(text):
        return date(*map(int, match.groups()))
    if match := _TIME.fullmatch(text):
        return _to_time(match)
    return text


def _to_int(text: str) -> int:
    sign = -1 if text[0] == "-" else 1
    text = text.lstrip("+-")
    if ":" in text:
        return sign * int(_sexagesimal(text, int))
    for prefix, base in (("0b", 2), ("0x", 16), ("0", 8)):
        if text.startswith(prefix) and text != "0":
            return sign * int(text[len(prefix) :], base)
    return sign * int(text)


def _to_float(text: str) -> float:
    sign = -1.0 if text[0] == "-" else 1.0
    text = text.lstrip("+-")
    if ":" in text:
        return sign * _sexagesimal(text, float)
    return sign * float(text.lstrip(".") if text in (".inf", ".nan") else text)


def _sexagesimal(text: str, convert: Callable[[str], float]) -> float:
    value: float = 0
    for digits in text.split(":"):
        value = value * 60 + convert(digits)
    return value


def _to_time(match: re.Match[str]) -> datetime:
    year, month, day, hour, minute, second = map(int, match.groups()[:6])
    fraction, zone = match.groups()[6:]
    if zone is not None:
        raise ValueError("a parameter has no time zone")
    microsecond = int((fraction or "")[:6].ljust(6, "0"))
    return datetime(year, month, day, hour, minute, second, microsecond)
