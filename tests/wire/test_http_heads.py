"""Heads of requests, put into order."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from aioros1.wire.http_heads import MAX_HEAD, Heads

PLAIN = b"POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 5\r\n\r\n"
ODD = b"POST / HTTP/1.1\nHost: x\n y\nContent-Length :\n\t5\n\n"
ORDERED = b"POST / HTTP/1.1\r\nHost: x y\r\nContent-Length: 5\r\n\r\n"
BODY = b"a\n\nb\n"


def fed(*pieces: bytes) -> tuple[bytes, Heads]:
    heads = Heads()
    return b"".join(map(heads.feed, pieces)), heads


def test_a_connection_whose_first_head_is_in_order_is_left_alone() -> None:
    data = PLAIN + BODY + ODD
    out, heads = fed(data)
    assert (out, heads.is_plain) == (data, True)
    assert heads.feed(b"\n\n \nanything") == b"\n\n \nanything"


def test_odd_heads_are_put_into_order_and_bodies_are_not() -> None:
    out, heads = fed((ODD + BODY) * 3 + PLAIN + BODY)
    assert (out, heads.is_plain) == ((ORDERED + BODY) * 3 + PLAIN + BODY, False)


@given(st.lists(st.integers(1, 40), max_size=60), st.booleans())
def test_it_does_not_matter_in_which_pieces_they_come(sizes: list[int], odd: bool) -> None:
    data = (ODD + BODY) * 3 if odd else (PLAIN + BODY) * 3
    pieces, position = [], 0
    for size in sizes:
        pieces.append(data[position : position + size])
        position += size
    out, _ = fed(*pieces, data[position:])
    assert out == ((ORDERED if odd else PLAIN) + BODY) * 3


@pytest.mark.parametrize(
    "data",
    [
        b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03",
        b"nothing of the kind",
        b"no lines",
        b"GET / HTTP/1.1\r\nX: " + b"y" * MAX_HEAD,
    ],
)
def test_what_is_no_head_is_left_to_the_parser(data: bytes) -> None:
    out, heads = fed(data)
    assert (out, heads.is_plain) == (data, True)


def test_a_body_in_chunks_is_left_to_the_parser() -> None:
    out, heads = fed(b"POST / HTTP/1.1\nHost: x\nTransfer-Encoding: chunked\n\n1\r\nx\r\n0\r\n\r\n")
    head = b"POST / HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\n"
    assert out == head + b"1\r\nx\r\n0\r\n\r\n"
    assert heads.is_plain


def test_a_length_that_is_none_is_left_to_the_parser() -> None:
    out, _ = fed(b"POST / HTTP/1.1\nHost: x\nContent-Length: -5\n\n")
    assert out == b"POST / HTTP/1.1\r\nHost: x\r\nContent-Length: -5\r\n\r\n"


def test_what_is_missing_is_added_and_what_is_not_ascii_is_quoted() -> None:
    out, _ = fed("POST /ü HTTP/1.0\r\n\r\n".encode())
    assert out == b"POST /%C3%BC HTTP/1.0\r\nHost: unknown\r\n\r\n"


def test_repr_says_how_far_it_is() -> None:
    assert repr(fed(b"POST")[1]) == "<Heads: undecided, 4 bytes waiting>"
    assert repr(fed(PLAIN)[1]) == "<Heads: plain, 0 bytes waiting>"
    assert repr(fed(ODD)[1]) == "<Heads: odd, 0 bytes waiting>"
