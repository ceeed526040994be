"""Converts XML-RPC documents to Python values and back, without any I/O.

The value types, and how each is written:

================  =======================================================
``bool``          ``<boolean>``
``int``           ``<int>``, 32 bits signed: XML-RPC knows no more. The extensions
                  that Python's parser reads (``<i8>``, ``<ex:i2>``) are read, too
``float``         ``<double>`` with all its digits, and ``nan``, ``inf``, ``-inf``
                  as the programs of ROS 1 write them
``str``           ``<string>``; what XML cannot carry is refused, and carriage
                  returns are written as they are
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
from collections.abc import Callable, Generator, Iterator, Sequence
from datetime import datetime
from typing import Any, TypeVar

from aioros1.wire.xmlrpc_plain import read_plain
from aioros1.wire.xmlrpc_reader import PIECE, UNSET, Document, reading_document
from aioros1.wire.xmlrpc_scalars import INT_MAX, INT_MIN, XmlRpcError, brief

__all__ = [
    "MAX_DEPTH",
    "MAX_VALUES",
    "PIECE",
    "XmlRpcError",
    "XmlRpcFault",
    "call_pieces",
    "carriable",
    "decode_call",
    "decode_response",
    "decoding_call",
    "decoding_response",
    "encode_call",
    "encode_fault",
    "encode_response",
    "response_pieces",
]

T = TypeVar("T")

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

# Writes a value into a list of strings. If it is a container, or long, it does so step by
# step, and yields whenever the list is worth emptying.
_Encoder = Callable[[Any, list[str], int], Iterator[None] | None]

_MANY = 4096
"""Strings in the list that are worth emptying: 2 ms of work."""

_LONG = 512
"""Characters of a text that is worth a step of its own."""

_CHUNK = 48 << 10
"""Characters or bytes converted in one step; a multiple of three, for base64."""

# Characters that cannot be written as they are. Most strings have none.
_SPECIAL = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f&<>\ud800-\udfff\ufffe\uffff]")
_ILLEGAL = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")


def encode_call(method: str, params: Sequence[Any], *, max_depth: int = MAX_DEPTH) -> bytes:
    """Make a ``<methodCall>`` document.

    Raises :class:`TypeError` for a value of a type XML-RPC does not have,
    :class:`OverflowError` for an int of more than 32 bits and :class:`ValueError` for a
    string XML cannot carry and for too deep nesting. The text begins with the place:
    ``params[2]['gains'][0]: ...``.
    """
    return b"".join(call_pieces(method, params, max_depth=max_depth))


def call_pieces(
    method: str, params: Sequence[Any], *, max_depth: int = MAX_DEPTH
) -> Iterator[bytes]:
    """The document of :func:`encode_call` in pieces, each of which takes some 2 ms to make.
    Most documents are one piece."""
    out = [
        "<?xml version='1.0'?><methodCall><methodName>",
        _escape(method),
        "</methodName><params>",
    ]
    for index, value in enumerate(params):
        out.append("<param>")
        for _ in _encode_root(value, out, f"params[{index}]", max_depth):
            yield "".join(out).encode()
            out.clear()
        out.append("</param>")
    out.append("</params></methodCall>")
    yield "".join(out).encode()


def encode_response(value: Any, *, what: str = "result", max_depth: int = MAX_DEPTH) -> bytes:
    """Make a ``<methodResponse>`` document with ``value``, which errors call ``what``.
    Raises as :func:`encode_call` does."""
    return b"".join(response_pieces(value, what=what, max_depth=max_depth))


def response_pieces(
    value: Any, *, what: str = "result", max_depth: int = MAX_DEPTH
) -> Iterator[bytes]:
    """The document of :func:`encode_response` in pieces, as :func:`call_pieces` makes them."""
    out = ["<?xml version='1.0'?><methodResponse><params><param>"]
    for _ in _encode_root(value, out, what, max_depth):
        yield "".join(out).encode()
        out.clear()
    out.append("</param></params></methodResponse>")
    yield "".join(out).encode()


def encode_fault(code: int, text: str) -> bytes:
    """Make a ``<methodResponse>`` document with a fault. It never fails: characters that XML
    cannot carry become ``?``."""
    out = ["<?xml version='1.0'?><methodResponse><fault>"]
    fault = {"faultCode": code, "faultString": carriable(text)}
    for _ in _encode_root(fault, out, "fault", MAX_DEPTH):
        pass
    out.append("</fault></methodResponse>")
    return "".join(out).encode()


class _UnencodableError(Exception):
    """Carries an error of a value up to where its full path is known."""

    def __init__(self, kind: type[Exception], text: str) -> None:
        self.kind = kind
        self.text = text
        self.place: list[str] = []


def _encode_root(value: Any, out: list[str], root: str, max_depth: int) -> Iterator[None]:
    """Write a value of a document, or return the steps that do."""
    try:
        more = _encode(value, out, max_depth)
    except _UnencodableError as bad:
        raise _placed(bad, root) from None
    return _NO_STEPS if more is None else _steps(more, root)


_NO_STEPS: Iterator[None] = iter(())


def _steps(more: Iterator[None], root: str) -> Iterator[None]:
    try:
        yield from more
    except _UnencodableError as bad:
        raise _placed(bad, root) from None


def _placed(bad: _UnencodableError, root: str) -> Exception:
    return bad.kind(f"{root}{''.join(reversed(bad.place))}: {bad.text}")


def _encode(value: Any, out: list[str], depth: int) -> Iterator[None] | None:
    encoder = _ENCODERS.get(type(value))
    if encoder is None:
        for base in _BASES:
            if isinstance(value, base):
                encoder = _ENCODERS[base]
                break
        else:
            what = "None" if value is None else f"a {type(value).__name__}"
            raise _UnencodableError(TypeError, f"XML-RPC has no type for {what}: {brief(value)}")
    return encoder(value, out, depth)


def _encode_bool(value: bool, out: list[str], depth: int) -> None:
    out.append(f"<value><boolean>{1 if value else 0}</boolean></value>")


def _encode_int(value: int, out: list[str], depth: int) -> None:
    if not INT_MIN <= value <= INT_MAX:
        raise _UnencodableError(OverflowError, f"an XML-RPC int has 32 bits: {brief(value)}")
    out.append(f"<value><int>{int(value)}</int></value>")


def _encode_float(value: float, out: list[str], depth: int) -> None:
    out.append(f"<value><double>{float.__repr__(value)}</double></value>")


def _encode_str(value: str, out: list[str], depth: int) -> Iterator[None] | None:
    if len(value) > _LONG:
        return _encode_long("string", value, _escape, out)
    out += ("<value><string>", _escape(value), "</string></value>")
    return None


def _encode_bytes(value: bytes, out: list[str], depth: int) -> Iterator[None]:
    return _encode_long("base64", memoryview(value).cast("B"), _to_base64, out)


def _encode_long(
    tag: str, value: Any, convert: Callable[[Any], str], out: list[str]
) -> Iterator[None]:
    """Write a text or bytes in chunks."""
    out.append(f"<value><{tag}>")
    yield from _convert_long(value, convert, out)
    out.append(f"</{tag}></value>")


def _convert_long(value: Any, convert: Callable[[Any], str], out: list[str]) -> Iterator[None]:
    for begin in range(0, len(value), _CHUNK):
        try:
            out.append(convert(value[begin : begin + _CHUNK]))
        except _UnencodableError as bad:
            bad.text = f"{bad.text.rpartition(': ')[0]}: {brief(value)}"  # of the whole value
            raise
        if len(value) > _CHUNK or len(out) > _MANY // 4:
            yield


def _to_base64(value: memoryview) -> str:
    return b2a_base64(value, newline=False).decode()


def _encode_datetime(value: datetime, out: list[str], depth: int) -> None:
    if value.tzinfo is not None:
        raise _UnencodableError(ValueError, f"XML-RPC has no time zones: {value!r}")
    text = value.isoformat("T", "seconds").replace("-", "")
    out.append(f"<value><dateTime.iso8601>{text}</dateTime.iso8601></value>")


def _encode_list(value: Sequence[Any], out: list[str], depth: int) -> Iterator[None]:
    _go_deeper(depth)
    out.append("<value><array><data>")
    index = 0
    try:
        for item in value:
            more = _encode(item, out, depth - 1)
            if more is not None:
                yield from more
            elif len(out) > _MANY:
                yield
            index += 1
    except _UnencodableError as bad:
        bad.place.append(f"[{index}]")
        raise
    out.append("</data></array></value>")


def _encode_dict(value: dict[str, Any], out: list[str], depth: int) -> Iterator[None]:
    _go_deeper(depth)
    out.append("<value><struct>")
    for key, item in value.items():
        if not isinstance(key, str):
            raise _UnencodableError(TypeError, f"the keys of a struct are strings: {brief(key)}")
        try:
            if len(key) > _LONG:
                out.append("<member><name>")
                yield from _convert_long(key, _escape, out)
                out.append("</name>")
            else:
                out.append(f"<member><name>{_escape_name(str.__str__(key))}</name>")
            more = _encode(item, out, depth - 1)
            if more is not None:
                yield from more
            elif len(out) > _MANY:
                yield
        except _UnencodableError as bad:
            bad.place.append(f"[{brief(key)}]")
            raise
        out.append("</member>")
    out.append("</struct></value>")


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
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def _escape_name(name: str) -> str:
    """roscpp decodes no names, so they are written as they are as far as XML allows it."""
    if _SPECIAL.search(name) is None:
        return name
    return _escape(name).replace("&gt;", ">").replace("]]>", "]]&gt;")


_ENCODERS: dict[type, _Encoder] = {
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
    return _finish(decoding_call((data,), max_depth=max_depth, max_values=max_values))


def decoding_call(
    chunks: Sequence[bytes], *, max_depth: int = MAX_DEPTH, max_values: int = MAX_VALUES
) -> Generator[None, None, tuple[str, tuple[Any, ...]]]:
    """Read a document that came in ``chunks`` as :func:`decode_call` does, in steps of
    ``PIECE`` bytes, and return the same."""
    document = yield from reading_document(chunks, "methodCall", max_depth, max_values)
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
    return _finish(decoding_response((data,), max_depth=max_depth, max_values=max_values))


def decoding_response(
    chunks: Sequence[bytes], *, max_depth: int = MAX_DEPTH, max_values: int = MAX_VALUES
) -> Generator[None, None, Any]:
    """Read a document that came in ``chunks`` as :func:`decode_response` does, in steps of
    ``PIECE`` bytes, and return the same."""
    document = yield from reading_document(
        chunks, "methodResponse", max_depth, max_values, wide=True
    )
    return _value_of(document)


def _finish(steps: Generator[None, None, T]) -> T:
    while True:
        try:
            next(steps)
        except StopIteration as end:
            result: T = end.value
            return result


def _value_of(document: Document) -> Any:
    fault = document.fault
    if fault is not UNSET:
        if not isinstance(fault, dict):
            raise XmlRpcError(f"fault: expected a struct, got {brief(fault)}")
        code = fault.get("faultCode", 0)
        raise XmlRpcFault(code if isinstance(code, int) else 0, str(fault.get("faultString", "")))
    if not document.params:
        raise XmlRpcError("expected a value in the response, got none")
    return document.params[0] if len(document.params) == 1 else document.params
