"""XML-RPC documents: a value or the documented error, and the same value when sent again."""

from __future__ import annotations

import math
from collections.abc import Iterator
from datetime import datetime
from typing import Any

from aioros1.wire.xmlrpc import (
    XmlRpcError,
    XmlRpcFault,
    decode_call,
    decode_response,
    encode_call,
    encode_fault,
    encode_response,
)

__all__ = ["check", "seeds"]

_TAGS = (
    *("methodCall", "methodResponse", "methodName", "params", "param", "fault", "value"),
    *("array", "data", "struct", "member", "name", "int", "i4", "i8", "boolean", "double"),
    *("string", "base64", "dateTime.iso8601", "nil"),
)
TOKENS = [
    *(f"<{tag}>".encode() for tag in _TAGS),
    *(f"</{tag}>".encode() for tag in _TAGS),
    *(b"<value/>", b"<nil/>", b"&amp;", b"&#13;", b"<![CDATA[", b"]]>", b"<!--", b"-->"),
    *(b"<?xml version='1.0' encoding='utf-16'?>", b"encoding='iso-8859-1'", b"<!DOCTYPE a>"),
    *(b"19980717T14:08:55", b"-2147483648", b"nan", b"1e999", b"YWI=", b"faultCode"),
]
MAX_LEN = 1024
SHARE = 12

_DEPTH = 6


def check(data: bytes) -> None:
    """The first octet says whether the others are a call or a response, and how written."""
    if not data:
        return
    root = "methodResponse" if data[0] % 2 else "methodCall"
    document = _well_formed(root, data[1:]) if data[0] & 2 else data[1:]
    if data[0] % 2:
        try:
            value = decode_response(document, max_depth=_DEPTH)
        except XmlRpcError as error:
            assert str(error), "an error without a word"
        except XmlRpcFault as fault:
            _check_fault(fault)
        else:
            _check_value(value)
        return
    try:
        method, params = decode_call(document, max_depth=_DEPTH)
    except XmlRpcError as error:
        assert str(error), "an error without a word"
        return
    for value in params:
        _check_value(value)
    if not _has_nil(params):
        again = decode_call(encode_call(method, params), max_depth=_DEPTH)
        assert again[0] == method
        assert _same(again[1], params), f"{again[1]!r} instead of {params!r}"


_TEXTS = (
    *("", "0", "1", "-1", "2147483648", "nan", "-1.5e3", "YWI=", "a", " ", "\n", "&#13;"),
    *("faultCode", "faultString", "19980717T14:08:55", "&#x1F600;"),
)


def _well_formed(root: str, choices: bytes) -> bytes:
    """XML, if nothing else: an octet opens an element, closes one, or is some text."""
    parts, open_tags = [f"<{root}>"], [root]
    for choice in choices:
        if choice < 160:
            tag = _TAGS[choice % len(_TAGS)]
            parts.append(f"<{tag}>")
            open_tags.append(tag)
        elif choice < 208:
            if len(open_tags) > 1:
                parts.append(f"</{open_tags.pop()}>")
        else:
            parts.append(_TEXTS[choice % len(_TEXTS)])
    parts += [f"</{tag}>" for tag in reversed(open_tags)]
    return "".join(parts).encode()


def _choices(words: str) -> bytes:
    """The choices that make these elements and texts; ``/`` closes an element."""
    return bytes(
        160 if word == "/" else _TAGS.index(word) if word in _TAGS else 208 + _TEXTS.index(word)
        for word in words.split()
    )


def _check_value(value: Any) -> None:
    if _has_nil(value):
        return
    document = encode_response(value)
    again = decode_response(document, max_depth=_DEPTH)
    assert _same(again, value), f"{again!r} instead of {value!r}"
    assert encode_response(again) == document


def _check_fault(fault: XmlRpcFault) -> None:
    if not -(1 << 31) <= fault.code < 1 << 31:
        return
    try:
        decode_response(encode_fault(fault.code, fault.text))
    except XmlRpcFault as again:
        assert (again.code, again.text) == (fault.code, fault.text)


def _has_nil(value: Any) -> bool:
    if isinstance(value, (list, tuple)):
        return any(map(_has_nil, value))
    if isinstance(value, dict):
        return any(map(_has_nil, value.values()))
    return value is None


def _same(a: Any, b: Any) -> bool:
    if type(a) is not type(b):
        return False
    if isinstance(a, (list, tuple)):
        return len(a) == len(b) and all(map(_same, a, b))
    if isinstance(a, dict):
        return list(a) == list(b) and all(_same(a[key], b[key]) for key in a)
    if isinstance(a, float) and math.isnan(a):
        return math.isnan(b)
    return bool(a == b)


def seeds() -> Iterator[bytes]:
    """Documents as they are sent, and elements as they are nested."""
    values: list[Any] = [
        *(0, -(1 << 31), True, 1.5, math.inf, math.nan, "", " a<&>\r\n\té", b"", b"\0\xff"),
        *([], {}, [1, ["a", {}]], {"a": {"b": [True]}, "": ""}, datetime(1998, 7, 17, 14, 8, 55)),
    ]
    yield b"\0" + encode_call("getPid", ["/me"])
    yield b"\0" + encode_call("registerPublisher", ["/me", "/chatter", "std_msgs/String", "http:"])
    for value in values:
        yield b"\0" + encode_call("m", [value, value])
        yield b"\1" + encode_response([1, "ok", value])
    yield b"\1" + encode_fault(-3, "why")
    latin = "<?xml version='1.0' encoding='iso-8859-1'?><methodCall><methodName>é</methodName>"
    yield b"\0" + f"{latin}</methodCall>".encode("latin-1")
    yield b"\0" + encode_call("m", ["ü"]).decode().replace("1.0'", "1.0' encoding='utf-16'").encode(
        "utf-16"
    )
    yield b"\0<methodCall><methodName>m</methodName><params><param><value><nil/></value></param>"
    yield b"\1<methodResponse><params><param><value>a</value></param></params></methodResponse>"
    yield b"\1<!DOCTYPE a [<!ENTITY b 'c'>]><methodResponse/>"
    values_as_words = [
        *("int -1", "i4 1", "i8 0", "boolean 1", "double nan", "string a", "base64 YWI=", "nil"),
        *("dateTime.iso8601 19980717T14:08:55", "array data", "array data / data", "struct"),
        "array data value int 1 / / value string a / /",
        "struct member name a / value array data value a / / / /",
    ]
    for words in values_as_words:
        yield b"\2" + _choices(f"methodName a / params param value {words}")
        yield b"\3" + _choices(f"params param value {words}")
    member = "member name {} / value {} / / /"
    code, text = member.format("faultCode", "int 1"), member.format("faultString", "string a")
    yield b"\3" + _choices(f"fault value struct {code} {text}")
