"""HTTP requests around XML-RPC documents, from well-formed to noise, for :mod:`fuzz.live`."""

from __future__ import annotations

import gzip
from collections.abc import Callable
from random import Random
from typing import NamedTuple

from fuzz.documents import Documents

__all__ = ["MAX_BODY", "Request", "Requests"]

MAX_BODY = 64 << 10
"""What the servers under attack accept."""


class Request(NamedTuple):
    """Some octets, and what has to come of them."""

    octets: bytes
    statuses: tuple[int, ...]
    """One of these must be the status of an answer; empty: anything may happen."""
    is_last: bool
    """Whether the connection may be closed behind it."""
    has_body: bool = True
    """Whether the answer has a body: to HEAD it has none."""


class Requests:
    """Makes one request after the other, as ``random`` chooses."""

    def __init__(self, random: Random, api: dict[str, tuple[str, ...]]) -> None:
        self._random = random
        self._documents = Documents(random)
        self._api = api
        self._odd: tuple[Callable[[bytes], Request], ...] = (
            *(self._chunked, self._gzip, self._expect, self._old, self._closing, self._dressed),
            *(self._elsewhere, self._get, self._head, self._unsized, self._huge, self._coding),
            self._of_a_page,
        )
        self._broken: tuple[Callable[[bytes], bytes], ...] = (
            *(self._changed, self._changed, self._cut, self._lying, self._bad_field),
            *(self._bad_chunks, self._bad_line, self._noise, self._long, self._not_gzip),
        )

    def next(self) -> Request:
        # Of many calls in one, it may be more than is accepted.
        document = self._documents.call(self._api)[:MAX_BODY]
        roll = self._random.random()
        if roll < 0.80:
            return Request(_post(document), (200,), False)
        if roll < 0.95:
            return self._random.choice(self._odd)(document)
        return Request(self._random.choice(self._broken)(document), (), True)

    # well-formed

    def _chunked(self, document: bytes) -> Request:
        head = b"POST / HTTP/1.1\r\nHost: a\r\nTransfer-Encoding: chunked\r\n\r\n"
        return Request(head + self._chunks(document), (200,), False)

    def _chunks(self, document: bytes) -> bytes:
        parts: list[bytes] = []
        end = self._random.choice((b"", b";a=b"))
        while document:
            size = self._random.choice((1, 10, 100, 1000, len(document)))
            piece, document = document[:size], document[size:]
            if len(parts) > 200:
                piece, document = piece + document, b""
            parts.append(b"%x%b\r\n%b\r\n" % (len(piece), end, piece))
        trailer = self._random.choice((b"", b"", b"A: b\r\n"))
        return b"".join(parts) + b"0\r\n" + trailer + b"\r\n"

    def _gzip(self, document: bytes) -> Request:
        packed = gzip.compress(document, 1)
        return Request(_post(packed, b"Content-Encoding: gzip\r\n"), (200,), False)

    def _expect(self, document: bytes) -> Request:
        return Request(_post(document, b"Expect: 100-continue\r\n"), (200,), False)

    def _old(self, document: bytes) -> Request:
        data = _post(document).replace(b"HTTP/1.1", b"HTTP/1.0", 1)
        return Request(data, (200,), True)

    def _closing(self, document: bytes) -> Request:
        return Request(_post(document, b"Connection: close\r\n"), (200,), True)

    def _dressed(self, document: bytes) -> Request:
        fields = b"X-A: \xc3\xa9\r\nx-a: b\r\nCookie: a=b; c\r\n" * self._random.choice((1, 5))
        fields += b"cOnTeNt-TyPe: text/html\r\n"
        return Request(_post(document, fields), (200,), False)

    def _elsewhere(self, document: bytes) -> Request:
        path = self._random.choice((b"/x", b"/RPC2/", b"/RPC3", b"/%00", b"/\xc3\xa9"))
        return Request(_post(document).replace(b"/RPC2", path, 1), (200, 400), True)

    def _get(self, document: bytes) -> Request:
        method = self._random.choice((b"GET", b"PUT", b"DELETE", b"OPTIONS", b"BREW"))
        return Request(method + b" / HTTP/1.1\r\nHost: a\r\n\r\n", (405, 400), True)

    def _head(self, document: bytes) -> Request:
        return Request(b"HEAD / HTTP/1.1\r\nHost: a\r\n\r\n", (405,), True, has_body=False)

    def _unsized(self, document: bytes) -> Request:
        return Request(b"POST / HTTP/1.1\r\nHost: a\r\n\r\n", (411,), True)

    def _huge(self, document: bytes) -> Request:
        length = self._random.choice((MAX_BODY + 1, 1 << 31, 1 << 40, 10**18))
        return Request(
            b"POST / HTTP/1.1\r\nHost: a\r\nContent-Length: %d\r\n\r\n" % length, (413, 400), True
        )

    def _of_a_page(self, document: bytes) -> Request:
        return Request(_post(document, b"Origin: http://a\r\n"), (403,), True)

    def _coding(self, document: bytes) -> Request:
        return Request(_post(document, b"Content-Encoding: br\r\n"), (415, 400), True)

    # broken

    def _changed(self, document: bytes) -> bytes:
        head, _, body = _post(document).partition(b"\r\n\r\n")
        data = bytearray(head + b"\r\n\r\n")
        for _ in range(self._random.choice((1, 1, 2, 5))):
            at = self._random.randrange(len(data))
            data[at : at + self._random.choice((0, 0, 1, 3))] = self._random.choice(
                (
                    b"",
                    b"\r",
                    b"\n",
                    b"\0",
                    b":",
                    b" ",
                    b"\t",
                    b"\xff",
                    b"-",
                    b"9",
                    b"HTTP/1.1",
                    b";",
                )
            )
        return bytes(data) + body

    def _cut(self, document: bytes) -> bytes:
        data = _post(document)
        return data[: self._random.randrange(1, len(data))]

    def _lying(self, document: bytes) -> bytes:
        wrong = self._random.choice((-10, -1, 1, 10, 1000))
        length = max(0, len(document) + wrong)
        return b"POST /RPC2 HTTP/1.1\r\nHost: a\r\nContent-Length: %d\r\n\r\n%b" % (
            length,
            document,
        )

    def _bad_field(self, document: bytes) -> bytes:
        fields = (
            *(
                b"Content-Length: -1",
                b"Content-Length: 5 5",
                b"Content-Length:",
                b"Content-Length: x",
            ),
            *(b"Content-Length: " + b"9" * 30, b"Content-Length: \xd9\xa3", b"Content-Length : 5"),
            *(b"Transfer-Encoding: chunked", b"Transfer-Encoding: x", b"no colon", b": empty"),
            *(b" folded: line", b"A\0B: c", b"Upgrade: websocket\r\nConnection: Upgrade", b"\r"),
            *(b"Content-Encoding: gzip", b"Content-Encoding: deflate", b"Expect: nothing"),
            *(b"Upgrade: h2c\r\nConnection: Upgrade, HTTP2-Settings", b"Host: a\r\nHost: b"),
        )
        return _post(document, self._random.choice(fields) + b"\r\n")

    def _bad_chunks(self, document: bytes) -> bytes:
        head = b"POST / HTTP/1.1\r\nHost: a\r\nTransfer-Encoding: chunked\r\n\r\n"
        data = bytearray(self._chunks(document))
        at = self._random.randrange(len(data))
        data[at : at + self._random.choice((0, 1, 5))] = self._random.choice(
            (b"", b"\r\n", b"-", b"fffffffffffffffff", b"g", b";", b"\0", b"0\r\n\r\n", b"\n")
        )
        return head + data

    def _bad_line(self, document: bytes) -> bytes:
        line = self._random.choice(
            (
                *(b"POST", b"POST /", b"POST / HTTP/0.9", b"POST / HTTP/9.9", b"POST / HTTP/1.1 x"),
                *(b"post / HTTP/1.1", b"P\xffST / HTTP/1.1", b"POST http://a:x/ HTTP/1.1"),
                *(b"POST * HTTP/1.1", b"POST // HTTP/1.1", b"POST /a\0b HTTP/1.1", b"\r\n\r\n\r\n"),
                *(b"CONNECT a:80 HTTP/1.1", b"CONNECT / HTTP/1.1", b"PRI * HTTP/2.0\r\n\r\nSM\r\n"),
                *(b"\x16\x03\x01\x02\0\x01\0\x01\xfc\x03\x03", b"POST http://[::1/ HTTP/1.1"),
                *(
                    b"POST /" + b"%41" * 3000 + b" HTTP/1.1",
                    b"POST /?" + b"a=b&" * 400 + b" HTTP/1.1",
                ),
            )
        )
        return _post(document).replace(b"POST /RPC2 HTTP/1.1", line, 1)

    def _noise(self, document: bytes) -> bytes:
        return self._random.randbytes(self._random.choice((1, 3, 20, 200, 5000)))

    def _long(self, document: bytes) -> bytes:
        field = self._random.choice((b"A: " + b"b" * 9000, b"a" * 9000 + b": b", b"A: b\r\n" * 999))
        return _post(document, field.rstrip() + b"\r\n")

    def _not_gzip(self, document: bytes) -> bytes:
        bombs = (b"\0" * (20 * MAX_BODY), document * 2)
        packed = bytearray(gzip.compress(self._random.choice(bombs), 1))
        if self._random.random() < 0.7:
            packed[self._random.randrange(len(packed))] ^= 0x55
        return _post(bytes(packed), b"Content-Encoding: gzip\r\n")


def _post(document: bytes, fields: bytes = b"") -> bytes:
    return b"POST /RPC2 HTTP/1.1\r\nHost: a\r\n%bContent-Length: %d\r\n\r\n%b" % (
        *(fields, len(document), document),
    )
