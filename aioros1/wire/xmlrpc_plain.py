"""Reads simple XML-RPC documents, without an XML parser.

Nearly all documents that a master and its nodes exchange are short and ASCII, without
character references, and hold scalars and lists. One regular expression recognises such a
document and another one splits it, in a quarter of the time that a parser needs, whose events
are calls into Python. Other documents are left to :mod:`~aioros1.wire.xmlrpc_reader`, which
would read these the same way.
"""

from __future__ import annotations

import re
from typing import Any

from aioros1.wire.xmlrpc_scalars import SCALARS

__all__ = ["read_plain"]

# Limits the memory for the matches of the second expression.
_MAX_BYTES = 64 << 10

# A document of that size cannot have more values.
_MOST_VALUES = _MAX_BYTES // len("<value></value>")

# Levels of lists inside a parameter: as many as the slave API has.
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
    """Read the method and the parameters in ``<root>``; None if the document needs the general
    reader, which reads or refuses it."""
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
