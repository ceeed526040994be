"""XML-RPC calls of both APIs, right and wrong ones, for :mod:`fuzz.live`.

Whoever listens may do as a call says: so all names are below ``/fz``, and every URI is one
where nobody listens. ``shutdown`` is only called with the wrong number of parameters.
"""

from __future__ import annotations

import base64
import re
from collections.abc import Callable
from random import Random
from typing import Any

__all__ = ["MASTER", "SLAVE", "Documents"]

DEAD = "http://127.0.0.1:1/"

SLAVE = {
    **dict.fromkeys(("getBusStats", "getBusInfo", "getMasterUri", "getName", "getUri"), ("me",)),
    **dict.fromkeys(("getPid", "getSubscriptions", "getPublications"), ("me",)),
    "paramUpdate": ("me", "key", "value"),
    "publisherUpdate": ("me", "topic", "uris"),
    "requestTopic": ("me", "topic", "protocols"),
    "shutdown": (),
}
"""The slave API: what each method takes."""

MASTER = {
    **dict.fromkeys(("getSystemState", "getTopicTypes", "getUri", "getPid"), ("me",)),
    **dict.fromkeys(("registerPublisher", "registerSubscriber"), ("me", "topic", "type", "uri")),
    **dict.fromkeys(("unregisterPublisher", "unregisterSubscriber"), ("me", "topic", "uri")),
    "registerService": ("me", "topic", "rosrpc", "uri"),
    "unregisterService": ("me", "topic", "rosrpc"),
    "lookupService": ("me", "topic"),
    "lookupNode": ("me", "me"),
    "getPublishedTopics": ("me", "subgraph"),
    "setParam": ("me", "key", "value"),
    **dict.fromkeys(("getParam", "deleteParam", "hasParam"), ("me", "key")),
    "searchParam": ("me", "key"),
    "getParamNames": ("me",),
    **dict.fromkeys(("subscribeParam", "unsubscribeParam"), ("me", "uri", "key")),
    "shutdown": (),
}
"""The Master and Parameter Server API."""

_NAMES = ("/fz/topic", "/fz/sub", "/fz/service", "/fz/param", "/fz/a", "/fz/a/b", "/fz/a//b/")
_KINDS: dict[str, tuple[Any, ...]] = {
    "me": ("/fuzzer/a", "/fuzzer/b", "/fuzzer/c", "/fuzzer/d"),
    "topic": _NAMES,
    "key": _NAMES,
    "subgraph": ("", "/fz", "/fz/a/", "/nothing"),
    "type": ("std_msgs/String", "*", "fz/Unknown", "a/b/c", ""),
    "uri": (DEAD, DEAD, DEAD + "x?y#z", "http://", "http://[::1", "http://[]/", "ftp://a/"),
    "rosrpc": ("rosrpc://127.0.0.1:1", "rosrpc://", DEAD),
    "value": (0, -1, True, 1.5, "", "text", b"\0\xff", [], {}, [1, [2]], {"a": {"b": [True]}}),
    "uris": ([], [DEAD], [DEAD, DEAD + "b"], ["http://"], ["http://[::1"], [5], DEAD),
    "protocols": ([["TCPROS"]], [["UDPROS", b"", "a", 1, 2]], [], [[]], [["TCPROS", {}], 5]),
}


class _Raw(str):
    """XML as it is."""


def _hostile() -> list[Any]:
    deep = [_nested("<array><data><value>", "</value></data></array>", n) for n in (9, 19, 21, 150)]
    member = "<member><name>a</name><value>"
    structs = [_nested(f"<struct>{member}", "</value></member></struct>", n) for n in (9, 21, 150)]
    return [
        *(2**31 - 1, -(2**31), 1e308, "", " ", "é\U0001f600\ufffe", "a" * 2000, "&<>]]>", b"", {}),
        *([[]] * 9, [0] * 500, {"": 0, " ": 1}, {str(number): number for number in range(200)}),
        *("/", "~a", "a b", "/fz/ü", "//", "/fz/\t", "http://127.0.0.1:1/\r\n", "\x7f"),
        *deep,
        *structs,
        *(
            _Raw(text)
            for text in (
                *("<int>2147483648</int>", "<int>-99999999999999999999</int>", "<i8>1e9</i8>"),
                *("<int></int>", "<int>1 2</int>", "<int>٣</int>", "<i4>+1</i4>", "<i8>-1</i8>"),
                *(
                    "<int>" + "9" * 5000 + "</int>",
                    "<boolean>2</boolean>",
                    "<boolean>true</boolean>",
                ),
                *("<double>nan</double>", "<double>-inf</double>", "<double>1e999</double>"),
                *("<double>0x1p3</double>", "<double>1_0</double>", "<double></double>", "<nil/>"),
                *("<base64>%%%</base64>", "<base64>YQ</base64>", "<base64>Y Q = =</base64>"),
                *("<string>&#0;</string>", "<string>&#xD800;</string>", "<string>&a;</string>"),
                *(
                    "<string><![CDATA[<a>]]></string>",
                    "<string/>",
                    "<unknown/>",
                    "<value>1</value>",
                ),
                *("<dateTime.iso8601>19980717T14:08:55</dateTime.iso8601>", "text", "\x01", "\x00"),
                *(
                    "<dateTime.iso8601>99999999T99:99:99</dateTime.iso8601>",
                    "<array/>",
                    "<struct/>",
                ),
                *(
                    "<array><data/></array>",
                    "<array><data><value/></data></array>",
                    "<array>1</array>",
                ),
                f"<struct>{member}1</value></member>{member}2</value></member></struct>",
                "<struct><member><value>1</value></member></struct>",
                "<struct><member><name>a</name></member></struct>",
                "<array><data><value><nil/></value></data></array>",
            )
        ),
    ]


def _nested(begin: str, end: str, depth: int) -> _Raw:
    return _Raw(begin * depth + end * depth)


def xml(value: Any) -> str:
    """A value as XML-RPC has it, without a look at what it is allowed to be."""
    if isinstance(value, _Raw):
        return str(value)
    if isinstance(value, str):
        text = value.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
        return f"<string>{text}</string>"
    if isinstance(value, bool):
        return f"<boolean>{value:d}</boolean>"
    if isinstance(value, int):
        return f"<int>{value}</int>"
    if isinstance(value, float):
        return f"<double>{value!r}</double>"
    if isinstance(value, bytes):
        return f"<base64>{base64.b64encode(value).decode()}</base64>"
    if isinstance(value, dict):
        members = (
            f"<member><name>{name}</name><value>{xml(item)}</value></member>"
            for name, item in value.items()
        )
        return f"<struct>{''.join(members)}</struct>"
    items = "".join(f"<value>{xml(item)}</value>" for item in value)
    return f"<array><data>{items}</data></array>"


_PROLOGUES = (
    *("<?xml version='1.0'?>",) * 90,
    *("", "\ufeff", "<?xml version='1.0' encoding='utf-8'?>\n", "<?xml version='1.1'?>", " "),
    *("<?xml version='1.0' encoding='latin-1'?>", "<?xml version='1.0' encoding='x'?>", "<!-- -->"),
    "<!DOCTYPE a [<!ENTITY a 'b'>]>",
    "<!DOCTYPE a [<!ENTITY a 'aaaa'><!ENTITY b '&a;&a;&a;&a;'>]>",
    "<!DOCTYPE a SYSTEM 'file:///etc/hostname'>",
)
_TOKENS = (
    *(
        b"<value>",
        b"</value>",
        b"<param>",
        b"</params>",
        b"<int>",
        b"<array>",
        b"<data>",
        b"<nil/>",
    ),
    *(
        b"<struct>",
        b"<member>",
        b"<name>",
        b"&amp;",
        b"&#1;",
        b"]]>",
        b"<!--",
        b"<?",
        b"\0",
        b"\xff",
    ),
    *(b"\xc3\xa9", b"\xed\xa0\x80", b"99999999999", b"-", b"'", b'"', b"<base64>", b"<methodCall>"),
)

# What a mutated call may not do to others: reach another host, or another's parameters.
_FOREIGN = re.compile(rb"(?:http|rosrpc)(?!://(?:127\.0\.0\.1:1\b|\[|<|$))")
_CAUTIOUS = (b"setParam", b"deleteParam")


class Documents:
    """Makes one document after the other, as ``random`` chooses."""

    def __init__(self, random: Random) -> None:
        self._random = random
        self._hostile = _hostile()

    def call(self, api: dict[str, tuple[str, ...]]) -> bytes:
        """A call, most likely of a method of ``api``, and about as likely right as wrong."""
        random = self._random
        roll = random.random()
        if roll < 0.03:
            return random.randbytes(random.randrange(80))
        if roll < 0.08:
            count = random.choice((0, 1, 3, 40))
            entries = [self._entry(api) for _ in range(count)]
            return self._document("system.multicall", [entries]).encode("utf-8", "replace")
        name, params = self._method(api)
        text = self._document(name, params)
        if roll < 0.10:
            return text.encode(random.choice(("utf-16", "latin-1", "utf-7")), "replace")
        document = text.encode("utf-8", "surrogatepass")
        if roll < 0.30 and name != "shutdown":
            changed = self._changed(document)
            if not _FOREIGN.search(changed) and (
                not any(word in changed for word in _CAUTIOUS) or b">/fz/" in changed
            ):
                return changed
        return document

    def _method(self, api: dict[str, tuple[str, ...]]) -> tuple[str, list[Any]]:
        random = self._random
        if random.random() < 0.03:
            api = random.choice((SLAVE, MASTER, {"": ("me",), "__init__": (), "a" * 999: ("me",)}))
        name = random.choice(list(api))
        if name == "shutdown":
            return name, random.choice(([], ["/fuzzer/a", "no", "no", "no"]))
        params = [random.choice(_KINDS[kind]) for kind in api[name]]
        roll = random.random()
        if roll < 0.25 and params:
            at = random.randrange(len(params))
            # A namespace that is replaced takes with it what others have below it.
            if name not in ("setParam", "deleteParam") or api[name][at] == "value":
                params[at] = random.choice(self._hostile)
        elif roll < 0.30 and params:
            del params[random.randrange(len(params))]
        elif roll < 0.35:
            params += random.choice(([0], [[]], ["x"] * 50))
        return name, params

    def _entry(self, api: dict[str, tuple[str, ...]]) -> Any:
        roll = self._random.random()
        if roll < 0.05:
            return {"methodName": "system.multicall", "params": [[]]}
        if roll < 0.1:
            return self._random.choice(self._hostile)
        name, params = self._method(api)
        if roll < 0.15:
            return {"methodName": name}
        return {"methodName": name, "params": params}

    def _document(self, name: str, params: list[Any]) -> str:
        values = "".join(f"<param><value>{xml(value)}</value></param>" for value in params)
        prologue = self._random.choice(_PROLOGUES)
        return (
            f"{prologue}<methodCall><methodName>{name}</methodName>"
            f"<params>{values}</params></methodCall>"
        )

    def _changed(self, document: bytes) -> bytes:
        changes: tuple[Callable[[bytearray, int, int], None], ...] = (
            self._flip,
            self._cut,
            self._repeat,
            self._insert,
            self._insert,
            self._end,
        )
        data = bytearray(document)
        for _ in range(self._random.choice((1, 1, 1, 2, 4))):
            if not data:
                break
            start = self._random.randrange(len(data))
            self._random.choice(changes)(data, start, start + self._random.randrange(1, 40))
        return bytes(data)

    def _flip(self, data: bytearray, start: int, stop: int) -> None:
        data[start] ^= 1 << self._random.randrange(8)

    def _cut(self, data: bytearray, start: int, stop: int) -> None:
        del data[start:stop]

    def _repeat(self, data: bytearray, start: int, stop: int) -> None:
        data[start:start] = data[start:stop]

    def _insert(self, data: bytearray, start: int, stop: int) -> None:
        data[start:start] = self._random.choice(_TOKENS)

    def _end(self, data: bytearray, start: int, stop: int) -> None:
        del data[start:]
