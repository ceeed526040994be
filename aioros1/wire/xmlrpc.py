"""Converts XML-RPC documents to Python values and back, without any I/O.

The value types, and how each is written:

================  =======================================================
``bool``          ``<boolean>``
``int``           ``<int>``, 32 bits signed: XML-RPC knows no more. The extensions
                  that Python's parser reads (``<i8>``, ``<ex:i2>``) are read, too
``float``         ``<double>`` with all its digits, and ``nan``, ``inf``, ``-inf``
                  as the programs of ROS 1 write them
``str``           ``<string>``; what XML cannot carry is refused
``bytes``         ``<base64>``
``datetime``      ``<dateTime.iso8601>``: naive, whole seconds
``list, tuple``   ``<array>``, always read as a list
``dict``          ``<struct>``, the keys strings
================  =======================================================

``None`` is refused on the way out, for most peers have no idea of ``<nil/>``; a nil that
comes in is read as ``None``, because the master has to answer it politely.

Nothing here trusts its input: document type declarations are refused (they are the way
to entity bombs and external files), nesting is bounded and read without recursion, and
so is the number of values, each of which costs much more time than its few octets show.
"""

from __future__ import annotations

import re
from binascii import b2a_base64
from collections.abc import Callable, Sequence
from datetime import datetime
from typing import Any

from aioros1.wire.xmlrpc_plain import read_plain
from aioros1.wire.xmlrpc_reader import UNSET, read_document
from aioros1.wire.xmlrpc_scalars import INT_MAX, INT_MIN, XmlRpcError, brief

__all__ = [
    "MAX_DEPTH",
    "MAX_VALUES",
    "XmlRpcError",
    "XmlRpcFault",
    "carriable",
    "decode_call",
    "decode_response",
    "encode_call",
    "encode_fault",
    "encode_response",
]

MAX_DEPTH = 100
"""How deeply arrays and structs may be nested, by default."""

MAX_VALUES = 250_000
"""How many values a document may have, by default."""


class XmlRpcFault(Exception):
    """The other side answered with a fault, which has a ``code`` and a ``text``."""

    def __init__(self, code: int, text: str) -> None:
        super().__init__(code, text)
        self.code = code
        self.text = text

    def __str__(self) -> str:
        return f"{self.text} (fault {self.code})"


# ---------------------------------------------------------------------------- encoding

_Write = Callable[[str], None]

# Characters that cannot be written as they are. Most strings have none.
_SPECIAL = re.compile("[\x00-\x08\x0b-\x1f&<>\ud800-\udfff\ufffe\uffff]")
_ILLEGAL = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")


def encode_call(method: str, params: Sequence[Any], *, max_depth: int = MAX_DEPTH) -> bytes:
    """Make a ``<methodCall>`` document.

    Raises :class:`TypeError` for a value of a type XML-RPC does not have,
    :class:`OverflowError` for an int of more than 32 bits and :class:`ValueError` for a
    string XML cannot carry and for too deep nesting. The text begins with the place:
    ``params[2]['gains'][0]: ...``.
    """
    out = [
        "<?xml version='1.0'?><methodCall><methodName>",
        _escape(method),
        "</methodName><params>",
    ]
    write = out.append
    for index, value in enumerate(params):
        write("<param>")
        _encode_root(value, write, f"params[{index}]", max_depth)
        write("</param>")
    write("</params></methodCall>")
    return "".join(out).encode()


def encode_response(value: Any, *, what: str = "result", max_depth: int = MAX_DEPTH) -> bytes:
    """Make a ``<methodResponse>`` document with ``value``, which errors call ``what``.
    Raises as :func:`encode_call` does."""
    out = ["<?xml version='1.0'?><methodResponse><params><param>"]
    _encode_root(value, out.append, what, max_depth)
    out.append("</param></params></methodResponse>")
    return "".join(out).encode()


def encode_fault(code: int, text: str) -> bytes:
    """Make a ``<methodResponse>`` document with a fault. It never fails: characters that XML
    cannot carry become ``?``."""
    out = ["<?xml version='1.0'?><methodResponse><fault>"]
    fault = {"faultCode": code, "faultString": carriable(text)}
    _encode_root(fault, out.append, "fault", MAX_DEPTH)
    out.append("</fault></methodResponse>")
    return "".join(out).encode()


class _UnencodableError(Exception):
    """Carries an error of a value up to where its full path is known."""

    def __init__(self, kind: type[Exception], text: str) -> None:
        self.kind = kind
        self.text = text
        self.place: list[str] = []


def _encode_root(value: Any, write: _Write, root: str, max_depth: int) -> None:
    try:
        _encode(value, write, max_depth)
    except _UnencodableError as bad:
        place = root + "".join(reversed(bad.place))
        raise bad.kind(f"{place}: {bad.text}") from None


def _encode(value: Any, write: _Write, depth: int) -> None:
    encoder = _ENCODERS.get(type(value))
    if encoder is None:
        for base in _BASES:
            if isinstance(value, base):
                encoder = _ENCODERS[base]
                break
        else:
            what = "None" if value is None else f"a {type(value).__name__}"
            raise _UnencodableError(TypeError, f"XML-RPC has no type for {what}: {brief(value)}")
    encoder(value, write, depth)


def _encode_bool(value: bool, write: _Write, depth: int) -> None:
    write("<value><boolean>1</boolean></value>" if value else "<value><boolean>0</boolean></value>")


def _encode_int(value: int, write: _Write, depth: int) -> None:
    if not INT_MIN <= value <= INT_MAX:
        raise _UnencodableError(OverflowError, f"an XML-RPC int has 32 bits: {brief(value)}")
    write(f"<value><int>{int(value)}</int></value>")


def _encode_float(value: float, write: _Write, depth: int) -> None:
    write(f"<value><double>{float.__repr__(value)}</double></value>")


def _encode_str(value: str, write: _Write, depth: int) -> None:
    write("<value><string>")
    write(_escape(value))
    write("</string></value>")


def _encode_bytes(value: bytes, write: _Write, depth: int) -> None:
    write(f"<value><base64>{b2a_base64(value, newline=False).decode()}</base64></value>")


def _encode_datetime(value: datetime, write: _Write, depth: int) -> None:
    if value.tzinfo is not None:
        raise _UnencodableError(ValueError, f"XML-RPC has no time zones: {value!r}")
    text = value.isoformat("T", "seconds").replace("-", "")
    write(f"<value><dateTime.iso8601>{text}</dateTime.iso8601></value>")


def _encode_list(value: Sequence[Any], write: _Write, depth: int) -> None:
    _go_deeper(depth)
    write("<value><array><data>")
    index = 0
    try:
        for item in value:
            _encode(item, write, depth - 1)
            index += 1
    except _UnencodableError as bad:
        bad.place.append(f"[{index}]")
        raise
    write("</data></array></value>")


def _encode_dict(value: dict[str, Any], write: _Write, depth: int) -> None:
    _go_deeper(depth)
    write("<value><struct>")
    for key, item in value.items():
        if not isinstance(key, str):
            raise _UnencodableError(TypeError, f"the keys of a struct are strings: {brief(key)}")
        try:
            write(f"<member><name>{_escape(str.__str__(key))}</name>")
            _encode(item, write, depth - 1)
        except _UnencodableError as bad:
            bad.place.append(f"[{key!r}]")
            raise
        write("</member>")
    write("</struct></value>")


def _go_deeper(depth: int) -> None:
    if depth <= 0:
        raise _UnencodableError(ValueError, "too many arrays and structs inside one another")


def carriable(text: str) -> str:
    """Replace each character that XML cannot carry by ``?``."""
    return _ILLEGAL.sub("?", text)


def _escape(text: str) -> str:
    if _SPECIAL.search(text) is None:
        return text
    bad = _ILLEGAL.search(text)
    if bad is not None:
        raise _UnencodableError(
            ValueError, f"XML cannot carry the character {bad[0]!r}: {brief(text)}"
        )
    # XML parsers turn a bare carriage return into a line feed, but not a reference to one.
    return (
        text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;").replace("\r", "&#13;")
    )


_ENCODERS: dict[type, Callable[[Any, _Write, int], None]] = {
    str: _encode_str,
    int: _encode_int,
    bool: _encode_bool,
    float: _encode_float,
    list: _encode_list,
    tuple: _encode_list,
    dict: _encode_dict,
    bytes: _encode_bytes,
    bytearray: _encode_bytes,
    memoryview: _encode_bytes,
    datetime: _encode_datetime,
}
# For subclasses (an IntEnum, a NamedTuple, ...).
_BASES = (str, int, float, list, tuple, dict, bytes, bytearray, datetime)


# ---------------------------------------------------------------------------- decoding


def decode_call(
    data: bytes, *, max_depth: int = MAX_DEPTH, max_values: int = MAX_VALUES
) -> tuple[str, tuple[Any, ...]]:
    """Read the method and the parameters of a ``<methodCall>`` document.

    Raises :class:`XmlRpcError`, and nothing else, for anything that is not one.
    """
    plain = read_plain(data, "methodCall", max_depth, max_values)
    if plain is not None and plain[0] is not None:
        return plain[0], tuple(plain[1])
    document = read_document(data, "methodCall", max_depth, max_values)
    if document.method is None:
        raise XmlRpcError("the call has no methodName")
    return document.method, tuple(document.params)


def decode_response(
    data: bytes, *, max_depth: int = MAX_DEPTH, max_values: int = MAX_VALUES
) -> Any:
    """Read the value of a ``<methodResponse>`` document.

    Ints of more than 32 bits are taken. So is an answer with several parameters, which are
    returned as a list: alpyro answers three instead of one array.

    Raises :class:`XmlRpcFault` if it carries a fault, :class:`XmlRpcError` if it is not
    such a document. An empty one is what a roscpp node answers to a request it
    cannot read.
    """
    plain = read_plain(data, "methodResponse", max_depth, max_values)
    if plain is not None and plain[0] is None and len(plain[1]) == 1:
        return plain[1][0]
    document = read_document(data, "methodResponse", max_depth, max_values, wide=True)
    fault = document.fault
    if fault is not UNSET:
        if not isinstance(fault, dict):
            raise XmlRpcError(f"fault: expected a struct, got {brief(fault)}")
        code = fault.get("faultCode", 0)
        raise XmlRpcFault(code if isinstance(code, int) else 0, str(fault.get("faultString", "")))
    if not document.params:
        raise XmlRpcError("expected a value in the response, got none")
    return document.params[0] if len(document.params) == 1 else document.params
