"""Reading the XML-RPC documents of every day, without an XML parser.

Nearly all that a master and its nodes say to each other is short, ASCII, without character
references, and holds scalars and lists. One regular expression tells such a document from
others and another one takes it apart, in a quarter of the time that a parser needs, whose
events are calls into Python. Whatever is not recognised is left to
:mod:`~aioros1.wire.xmlrpc_reader`, and whatever is, it would read the same.
"""

from __future__ import annotations

import re
from typing import Any

from aioros1.wire.xmlrpc_scalars import SCALARS

__all__ = ["read_plain"]

# A bound to the memory for what the second expression finds.
_MAX_BYTES = 64 << 10

# No document of that size has more values.
_MOST_VALUES = _MAX_BYTES // len("<value></value>")

# Lists inside lists inside a parameter: as many as the slave API has.
_DEPTH = 2

_KINDS = ("string", "int", "i4", "boolean", "double")
_TO_VALUE = {kind: SCALARS[kind] for kind in _KINDS} | {"value": str}


def _document() -> str:
    gap = r"[ \t\r\n]*+"
    # Without what XML would change or refuse: a carriage return, "]]>", control characters.
    text = r"[^<>&\x00-\x08\x0b-\x1f]*+"
    kind = f"(?:{'|'.join(_KINDS)})"
    value = scalar = f"<value>(?:<{kind}>{text}</{kind}>|{text})</value>"
    for _ in range(_DEPTH):
        data = f"<data>{gap}(?:{value}{gap})*+</data>"
        value = f"(?:{scalar}|<value>{gap}<array>{gap}{data}{gap}</array>{gap}</value>)"
    return (
        rf"""(?:<\?xml version=(?:"1\.0"|'1\.0')\?>)?{gap}<(methodCall|methodResponse)>{gap}"""
        rf"(?:<methodName>([A-Za-z0-9_.]++)</methodName>{gap})?"
        rf"<params>{gap}(?:<param>{gap}{value}{gap}</param>{gap})*+</params>{gap}</\1>{gap}"
    )


_DOCUMENT = re.compile(_document())
_PARTS = re.compile(rf"<({'|'.join(_TO_VALUE)})>([^<]*)</([a-z0-9]+)>|<(/?)array>")


def read_plain(
    data: bytes, root: str, max_depth: int, max_values: int
) -> tuple[str | None, list[Any]] | None:
    """The method and the parameters in ``<root>``; None for what only the general reader
    can read, or refuse."""
    if len(data) > _MAX_BYTES or max_depth < _DEPTH or max_values < _MOST_VALUES:
        return None
    if not data.isascii():
        return None
    text = data.decode("ascii")
    found = _DOCUMENT.fullmatch(text)
    if found is None or found[1] != root:
        return None
    values: list[Any] = []
    outside: list[list[Any]] = []
    try:
        for begin, inner, end, closes in _PARTS.findall(text):
            if begin != end:
                return None
            if begin:
                values.append(_TO_VALUE[begin](inner))
            elif closes:
                values = outside.pop()
            else:
                outside.append(values)
                values = []
                outside[-1].append(values)
    except ValueError:
        return None
    return found[2], values
