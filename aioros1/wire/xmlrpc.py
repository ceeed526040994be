"""XML-RPC documents to Python values and back, without any I/O.

The value types, and how each is written:

================  =======================================================
``bool``          ``<boolean>``
``int``           ``<int>``, 32 bits signed: XML-RPC knows no more
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
to entity bombs and external files), nesting is bounded and read without recursion.
"""

from __future__ import annotations

import re
from binascii import Error as Base64Error
from binascii import a2b_base64, b2a_base64
from collections.abc import Callable, Sequence
from datetime import datetime
from typing import Any, NoReturn
from xml.parsers import expat

__all__ = [
    "MAX_DEPTH",
    "XmlRpcError",
    "XmlRpcFault",
    "decode_call",
    "decode_response",
    "encode_call",
    "encode_fault",
    "encode_response",
]

MAX_DEPTH = 100
"""Arrays and structs inside one another, unless the caller says otherwise."""

_INT_MIN, _INT_MAX = -(1 << 31), (1 << 31) - 1


class XmlRpcError(ValueError):
    """What came in is not an XML-RPC document, or not one we accept."""


class XmlRpcFault(Exception):
    """The other side answered with a fault: ``code`` and ``text`` are its own."""

    def __init__(self, code: int, text: str) -> None:
        super().__init__(code, text)
        self.code = code
        self.text = text

    def __str__(self) -> str:
        return f"{self.text} (fault {self.code})"


# ---------------------------------------------------------------------------- encoding

_Write = Callable[[str], None]

# Everything that needs attention in a string; most strings hold none of it.
_SPECIAL = re.compile("[\x00-\x08\x0b-\x1f&<>\ud800-\udfff\ufffe\uffff]")
_ILLEGAL = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")


def encode_call(method: str, params: Sequence[Any], *, max_depth: int = MAX_DEPTH) -> bytes:
    """A ``<methodCall>`` document.

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


def encode_response(value: Any, *, max_depth: int = MAX_DEPTH) -> bytes:
    """A ``<methodResponse>`` document that carries ``value``; raises as `encode_call`."""
    out = ["<?xml version='1.0'?><methodResponse><params><param>"]
    _encode_root(value, out.append, "result", max_depth)
    out.append("</param></params></methodResponse>")
    return "".join(out).encode()


def encode_fault(code: int, text: str) -> bytes:
    """A ``<methodResponse>`` that says why there is no value. It never fails:
    characters XML cannot carry become ``?``."""
    out = ["<?xml version='1.0'?><methodResponse><fault>"]
    fault = {"faultCode": code, "faultString": _ILLEGAL.sub("?", text)}
    _encode_root(fault, out.append, "fault", MAX_DEPTH)
    out.append("</fault></methodResponse>")
    return "".join(out).encode()


class _UnencodableError(Exception):
    """Carries what is wrong with a value up to where its whole place is known."""

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
            raise _UnencodableError(TypeError, f"XML-RPC has no type for {what}: {_brief(value)}")
    encoder(value, write, depth)


def _encode_bool(value: bool, write: _Write, depth: int) -> None:
    write("<value><boolean>1</boolean></value>" if value else "<value><boolean>0</boolean></value>")


def _encode_int(value: int, write: _Write, depth: int) -> None:
    if not _INT_MIN <= value <= _INT_MAX:
        raise _UnencodableError(OverflowError, f"an XML-RPC int has 32 bits: {_brief(value)}")
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
            raise _UnencodableError(TypeError, f"the keys of a struct are strings: {_brief(key)}")
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


def _escape(text: str) -> str:
    if _SPECIAL.search(text) is None:
        return text
    bad = _ILLEGAL.search(text)
    if bad is not None:
        raise _UnencodableError(
            ValueError, f"XML cannot carry the character {bad[0]!r}: {_brief(text)}"
        )
    # A bare carriage return would be read as a line feed; as a reference it survives.
    return (
        text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;").replace("\r", "&#13;")
    )


def _brief(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."


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


def decode_call(data: bytes, *, max_depth: int = MAX_DEPTH) -> tuple[str, tuple[Any, ...]]:
    """The method and the parameters of a ``<methodCall>`` document.

    Raises :class:`XmlRpcError`, and nothing else, for whatever is not one.
    """
    decoder = _decode(data, "methodCall", max_depth)
    if decoder.method is None:
        raise XmlRpcError("the call has no methodName")
    return decoder.method, tuple(decoder.params)


def decode_response(data: bytes, *, max_depth: int = MAX_DEPTH) -> Any:
    """The value in a ``<methodResponse>`` document.

    Raises :class:`XmlRpcFault` when it carries a fault, :class:`XmlRpcError` when it is
    not such a document. An empty one is what a roscpp node answers to a request it
    cannot read.
    """
    decoder = _decode(data, "methodResponse", max_depth)
    fault = decoder.fault
    if fault is not _UNSET:
        if not isinstance(fault, dict):
            raise XmlRpcError(f"fault: expected a struct, got {_brief(fault)}")
        code = fault.get("faultCode", 0)
        raise XmlRpcFault(code if isinstance(code, int) else 0, str(fault.get("faultString", "")))
    if len(decoder.params) != 1:
        raise XmlRpcError(f"expected one value in the response, got {len(decoder.params)}")
    return decoder.params[0]


def _decode(data: bytes, root: str, max_depth: int) -> _Decoder:
    if not data:
        raise XmlRpcError("the document is empty")
    decoder = _Decoder(root, max_depth)
    parser = expat.ParserCreate()
    parser.buffer_text = True
    parser.StartElementHandler = decoder.start
    parser.EndElementHandler = decoder.end
    parser.CharacterDataHandler = decoder.text_append
    parser.StartDoctypeDeclHandler = _refuse_doctype
    parser.XmlDeclHandler = _refuse_encoding
    try:
        parser.Parse(data, True)
    except XmlRpcError:
        raise
    except (expat.ExpatError, ValueError) as error:
        raise XmlRpcError(f"not XML: {error}") from None
    return decoder


def _refuse_doctype(*_: object) -> NoReturn:
    raise XmlRpcError("document type declarations are refused")


# Those that expat knows. For any other it would ask Python, which imports a module by that
# name, and never forgets a name that somebody came up with.
_ENCODINGS = frozenset({"utf-8", "utf-16", "utf-16be", "utf-16le", "iso-8859-1", "us-ascii"})


def _refuse_encoding(version: str, encoding: str | None, standalone: int) -> None:
    if encoding is not None and encoding.lower() not in _ENCODINGS:
        raise XmlRpcError(f"not an encoding for XML-RPC: {_brief(encoding)}")


_UNSET: Any = object()
_PENDING: Any = object()

_BLANK = " \t\r\n"
_INTEGER = re.compile(r"[+-]?[0-9]+")
_DATETIME = re.compile(r"([0-9]{4})-?([0-9]{2})-?([0-9]{2})T([0-9]{2}):([0-9]{2}):([0-9]{2})")


def _to_int(text: str) -> int:
    text = text.strip(_BLANK)
    if _INTEGER.fullmatch(text) is None:
        raise ValueError(f"not an int: {_brief(text)}")
    value = int(text) if len(text) < 1000 else _INT_MAX + 1
    if not _INT_MIN <= value <= _INT_MAX:
        raise ValueError(f"an XML-RPC int has 32 bits: {_brief(text)}")
    return value


def _to_long(text: str) -> NoReturn:
    # Python's own servers store an i8 and can never hand it out again.
    raise ValueError(f"64-bit ints are not part of XML-RPC: {_brief(text)}")


def _to_bool(text: str) -> bool:
    text = text.strip(_BLANK)
    if text not in ("0", "1"):
        raise ValueError(f"not a boolean (0 or 1): {_brief(text)}")
    return text == "1"


def _to_float(text: str) -> float:
    try:
        if "_" not in text:
            return float(text)
    except ValueError:
        pass
    raise ValueError(f"not a double: {_brief(text)}")


def _to_bytes(text: str) -> bytes:
    try:
        return a2b_base64("".join(text.split()), strict_mode=True)
    except (Base64Error, ValueError):
        raise ValueError(f"not base64: {_brief(text)}") from None


def _to_datetime(text: str) -> datetime:
    match = _DATETIME.fullmatch(text.strip(_BLANK))
    try:
        if match is not None:
            year, month, day, hour, minute, second = map(int, match.groups())
            return datetime(year, month, day, hour, minute, second)
    except ValueError:
        pass
    raise ValueError(f"not a dateTime (19980717T14:08:55): {_brief(text)}")


def _to_nil(text: str) -> None:
    if text.strip(_BLANK):
        raise ValueError(f"nil has no value: {_brief(text)}")


_SCALARS: dict[str, Callable[[str], Any]] = {
    "int": _to_int,
    "i4": _to_int,
    "i8": _to_long,
    "boolean": _to_bool,
    "double": _to_float,
    "string": str,
    "base64": _to_bytes,
    "dateTime.iso8601": _to_datetime,
    "nil": _to_nil,
}

# Which elements may be in which.
_CHILDREN: dict[str, frozenset[str]] = {
    "methodCall": frozenset({"methodName", "params"}),
    "methodResponse": frozenset({"params", "fault"}),
    "params": frozenset({"param"}),
    "param": frozenset({"value"}),
    "fault": frozenset({"value"}),
    "value": frozenset({*_SCALARS, "array", "struct"}),
    "array": frozenset({"data"}),
    "data": frozenset({"value"}),
    "struct": frozenset({"member"}),
    "member": frozenset({"name", "value"}),
}
_NOTHING: frozenset[str] = frozenset()


class _Decoder:
    """Takes expat's events and builds values, with stacks of its own for the nesting."""

    def __init__(self, root: str, max_depth: int) -> None:
        self.method: str | None = None
        self.params: list[Any] = []
        self.fault: Any = _UNSET
        self._root = root
        self._max_depth = max_depth
        self._tags: list[str] = []
        self._sections: set[str] = set()
        self._closed_params = 0
        self._text: list[str] = []
        self.text_append = self._text.append
        # One entry for each open <value>: what it holds so far.
        self._values: list[Any] = []
        # One for each open <data> or <struct>: the list or dict it fills.
        self._containers: list[Any] = []
        # One [name, value] for each open <member>.
        self._members: list[list[Any]] = []

    def start(self, tag: str, attributes: dict[str, str]) -> None:
        tags = self._tags
        if not tags:
            if tag != self._root:
                raise XmlRpcError(f"expected a {self._root}, got a <{tag[:40]}>")
        else:
            parent = tags[-1]
            if tag not in _CHILDREN.get(parent, _NOTHING):
                self._fail(f"<{tag[:40]}> inside <{parent}>")
            if tag == "value":
                self._values.append(_UNSET)
            elif parent == "value":
                if self._values[-1] is not _UNSET or "".join(self._text).strip(_BLANK):
                    self._fail(f"<{tag}> beside another value")
                if tag == "array":
                    self._values[-1] = _PENDING
                elif tag == "struct":
                    self._open({})
            elif tag == "member":
                self._members.append([_UNSET, _UNSET])
            elif tag == "data":
                if self._values[-1] is not _PENDING:
                    self._fail("an array with two data elements")
                self._open([])
            elif parent == self._root:
                if tag in self._sections:
                    self._fail(f"two {tag} elements")
                self._sections.add(tag)
        tags.append(tag)
        self._text.clear()

    def end(self, tag: str) -> None:
        self._tags.pop()
        if tag == "value":
            value = self._values.pop()
            if value is _UNSET:
                value = "".join(self._text)
            elif self._text and "".join(self._text).strip(_BLANK):
                self._fail("text beside a value")
            self._put(value)
        elif (convert := _SCALARS.get(tag)) is not None:
            try:
                self._values[-1] = convert("".join(self._text))
            except ValueError as error:
                self._fail(str(error))
        elif tag == "name":
            if self._members[-1][0] is not _UNSET:
                self._fail("a member with two names")
            self._members[-1][0] = "".join(self._text)
        elif tag == "member":
            name, value = self._members[-1]
            if name is _UNSET or value is _UNSET:
                self._fail("a member without a " + ("name" if name is _UNSET else "value"))
            self._members.pop()
            self._containers[-1][name] = value
        elif tag in ("data", "struct"):
            self._containers.pop()
        elif tag == "array":
            if self._values[-1] is _PENDING:
                self._fail("an array without a data element")
        elif tag == "param":
            self._closed_params += 1
            if len(self.params) != self._closed_params:
                raise XmlRpcError(f"params[{self._closed_params - 1}]: a param has one value")
        elif tag == "methodName":
            self.method = "".join(self._text).strip(_BLANK)
        self._text.clear()

    def _open(self, container: list[Any] | dict[str, Any]) -> None:
        if len(self._containers) >= self._max_depth:
            self._fail(f"more than {self._max_depth} arrays and structs inside one another")
        self._values[-1] = container
        self._containers.append(container)

    def _put(self, value: Any) -> None:
        parent = self._tags[-1]
        if parent == "data":
            self._containers[-1].append(value)
        elif parent == "member":
            if self._members[-1][1] is not _UNSET:
                self._fail("a member with two values")
            self._members[-1][1] = value
        elif parent == "param":
            self.params.append(value)
        elif self.fault is _UNSET:
            self.fault = value
        else:
            raise XmlRpcError("a fault with two values")

    def _fail(self, text: str) -> NoReturn:
        raise XmlRpcError(f"{self._place()}: {text}")

    def _place(self) -> str:
        if len(self._tags) < 3:
            return self._root
        if self._tags[1] == "fault":
            place = "fault"
        else:
            place = f"params[{self._closed_params}]" if self._root == "methodCall" else "result"
        members = iter(self._members)
        for container in self._containers:
            if isinstance(container, list):
                place += f"[{len(container)}]"
            elif (member := next(members, None)) is not None and member[0] is not _UNSET:
                place += f"[{_brief(member[0])}]"
        return place
