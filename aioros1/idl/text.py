"""Shows messages: their ``repr``, and the YAML-like text that rostopic prints."""

from __future__ import annotations

import re
from typing import Any

from aioros1.idl.structure import Structure
from aioros1.time import Duration, Time

__all__ = ["message_repr", "message_text", "quote"]

_ESCAPES = {
    "\0": "\\0",
    "\a": "\\a",
    "\b": "\\b",
    "\t": "\\t",
    "\n": "\\n",
    "\v": "\\v",
    "\f": "\\f",
    "\r": "\\r",
    "\x1b": "\\e",
    '"': '\\"',
    "\\": "\\\\",
    "\x85": "\\N",
    "\xa0": "\\_",
    "\u2028": "\\L",
    "\u2029": "\\P",
}
_UNSAFE = re.compile(r'[^ -~]|["\\]')
# Strings that need no quotes in YAML; not all of them, but most names.
_PLAIN = re.compile(r"[A-Za-z_/](?:(?!: |:\Z| #)[ -~])*(?<! )\Z")
_WORDS = frozenset({"yes", "no", "true", "false", "on", "off", "null"})


def message_repr(message: Structure) -> str:
    """``Type(field=value, ...)``."""
    fields = []
    for name in message.__slots__:
        value = getattr(message, name, "<unset>")
        text = repr(value.tolist()) if isinstance(value, memoryview) else repr(value)
        fields.append(f"{name}={text}")
    return f"{type(message).__name__}({', '.join(fields)})"


def message_text(message: Any, indent: str = "") -> str:
    """One line for each field, as genpy prints messages; nested messages are indented."""
    lines = [
        f"{indent}{name}: {_text(getattr(message, name, None), indent + '  ')}"
        for name in message.__slots__
    ]
    text = "\n".join(lines)
    return f"\n{text}" if indent else text


def quote(text: str) -> str:
    """A string in double quotes, for YAML."""
    return f'"{_UNSAFE.sub(_escape, text)}"'


def _escape(match: re.Match[str]) -> str:
    char = match[0]
    if char in _ESCAPES:
        return _ESCAPES[char]
    number = ord(char)
    if number <= 0xFF:
        return f"\\x{number:02X}"
    return f"\\u{number:04X}" if number <= 0xFFFF else f"\\U{number:08X}"


def _text(value: Any, indent: str) -> str:
    if isinstance(value, str):
        return quote(value) if value else "''"
    if isinstance(value, (bool, int, float)):
        return str(value)
    if isinstance(value, (Time, Duration)) or (hasattr(value, "nsecs") and hasattr(value, "secs")):
        return f"\n{indent}secs: {value.secs}\n{indent}nsecs: {value.nsecs:9d}"
    if hasattr(value, "tolist"):
        value = value.tolist()
    elif isinstance(value, (bytes, bytearray)):
        value = list(value)
    if isinstance(value, (list, tuple)):
        return _list(value, indent)
    if hasattr(type(value), "_slot_types"):
        return message_text(value, indent)
    return str(value)


def _list(values: list[Any] | tuple[Any, ...], indent: str) -> str:
    if not values:
        return "[]"
    if isinstance(values[0], str):
        return "\n" + "\n".join(f"{indent}- {_item(value)}" for value in values)
    if isinstance(values[0], (bool, int, float)):
        return str(list(values))
    return "\n" + "\n".join(f"{indent}- {_text(value, indent + '  ')}" for value in values)


def _item(value: Any) -> str:
    """A string in a list, without quotes if it needs none."""
    if not isinstance(value, str):
        return str(value)
    if _PLAIN.match(value) and value.lower() not in _WORDS:
        return value
    if _UNSAFE.search(value.replace('"', "").replace("\\", "")):
        return quote(value)
    return "'" + value.replace("'", "''") + "'"
