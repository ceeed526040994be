"""HTTP answers in all the shapes that XML-RPC servers give them."""

from __future__ import annotations

import contextlib
import itertools

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from aioros1.wire.http import MAX_HEAD, AnswerReader, HttpError

OK = b"HTTP/1.1 200 OK\r\n"


def read(*pieces: bytes, max_bytes: int = 1000) -> AnswerReader:
    """What a reader has made of ``pieces``; it has to be complete with the last."""
    reader = AnswerReader(max_bytes=max_bytes)
    for piece in pieces[:-1]:
        assert not reader.receive_data(piece)
    assert reader.receive_data(pieces[-1])
    return reader


# where an answer ends


@pytest.mark.parametrize(
    "head",
    [
        b"HTTP/1.1 200 OK\r\nServer: XMLRPC++ 0.7\r\nContent-Type: text/xml\r\nContent-length: 5",
        b"HTTP/1.1 200 OK\r\nCONTENT-LENGTH:5\r\nContent-Type: text/xml",
        b"HTTP/1.1 200\r\nContent-Length:    5   ",
        b"HTTP/1.1 200 OK\r\nContent-Length: 5\r\nX: a\r\n  b\r\nContent-Length: 5",
        b"HTTP/1.1 200 OK\r\nTransfer-Encoding: identity\r\nContent-Length: 5",
    ],
)
def test_announced_length(head: bytes) -> None:
    answer = read(head + b"\r\n\r\nhello")
    assert (answer.status, answer.body, answer.keeps_alive) == (200, b"hello", True)
    assert read(head.replace(b"\r\n", b"\n") + b"\n\nhello").body == b"hello"


@pytest.mark.parametrize(
    "chunks",
    [
        b"5\r\nhello\r\n0\r\n\r\n",
        b"2\r\nhe\r\n3;x=y\r\nllo\r\n00\r\nTrailer: x\r\nOther: y\r\n\r\n",
        b"1\nh\n4 \nello\n0\n\n",
    ],
)
def test_chunks(chunks: bytes) -> None:
    head = OK + b"Transfer-Encoding: Chunked\r\nContent-Length: 9\r\n\r\n"
    answer = read(head + chunks)
    assert (answer.body, answer.keeps_alive) == (b"hello", True)


def test_end_of_the_connection() -> None:
    for head in (b"HTTP/1.0 200 OK\r\n\r\n", OK + b"\r\n"):
        reader = AnswerReader(max_bytes=1000)
        assert not reader.receive_data(head + b"hel")
        assert not reader.receive_data(b"lo")
        assert reader.receive_eof()
        assert (reader.body, reader.keeps_alive) == (b"hello", False)


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"HTTP/1.1 20",
        OK + b"Content-Length: 5\r\n\r\nhell",
        OK + b"Transfer-Encoding: chunked\r\n\r\n5\r\nhello\r\n",
    ],
)
def test_end_of_the_connection_before_the_end_of_the_answer(data: bytes) -> None:
    reader = AnswerReader(max_bytes=1000)
    assert not reader.has_begun
    if data:
        assert not reader.receive_data(data)
        assert reader.has_begun
    assert not reader.receive_eof()


def test_interim_answers_are_skipped() -> None:
    interim = b"HTTP/1.1 100 Continue\r\n\r\nHTTP/1.1 103 Early Hints\r\nContent-Length: 3\r\n\r\n"
    assert read(interim + OK + b"Content-Length: 2\r\n\r\nhi").body == b"hi"
    assert read(interim, OK + b"Content-Length: 2\r\n\r\nhi").body == b"hi"


def test_whether_the_connection_is_kept() -> None:
    for line, fields, keeps in (
        ("HTTP/1.1", "", True),
        ("HTTP/1.1", "Connection: keep-alive\r\n", True),
        ("HTTP/1.1", "Connection: Close\r\n", False),
        ("HTTP/1.1", "Connection: te, close\r\nConnection: keep-alive\r\n", False),
        ("HTTP/1.0", "", False),
        ("HTTP/1.0", "Connection: Keep-Alive\r\n", True),
    ):
        assert (
            read(f"{line} 200 OK\r\n{fields}Content-Length: 0\r\n\r\n".encode()).keeps_alive
            is keeps
        )
    # What else came cannot be told from the next answer.
    assert not read(OK + b"Content-Length: 1\r\n\r\nab").keeps_alive
    chunked = OK + b"Transfer-Encoding: chunked\r\n\r\n0\r\n\r\n"
    assert not read(chunked + b"x").keeps_alive


def test_other_statuses_are_complete_with_their_head() -> None:
    answer = read(b"HTTP/1.1 404 Not here\r\nContent-Length: 1000000\r\n\r\n")
    assert (answer.status, answer.reason, answer.keeps_alive) == (404, "Not here", False)
    assert read(b"HTTP/1.1 101 Switching Protocols\r\n\r\n").status == 101


# nonsense, and too much


@pytest.mark.parametrize(
    "data",
    [
        b"SSH-2.0-OpenSSH_9",
        b"\r\n",
        b"HTTP/2 200 OK\r\n\r\n",
        b"HTTP/1.1 OK\r\n\r\n",
        b"HTTP/1.1 2000 OK\r\n\r\n",
        OK + b"no field\r\n\r\n",
        OK + b"Content-Length: -1\r\n\r\n",
        OK + b"Content-Length: 1_0\r\n\r\n",
        OK + b"Content-Length: " + b"9" * 5000 + b"\r\n\r\n",
        OK + b"Content-Length: 1\r\nContent-Length: 2\r\n\r\n",
        OK + b"Transfer-Encoding: gzip, chunked\r\n\r\n",
        OK + b"Transfer-Encoding: chunked\r\n\r\n-1\r\n",
        OK + b"Transfer-Encoding: chunked\r\n\r\n0x5\r\n",
        OK + b"Transfer-Encoding: chunked\r\n\r\n\r\n",
        OK + b"Transfer-Encoding: chunked\r\n\r\n1\r\nab\r\n",
    ],
)
def test_what_is_no_answer(data: bytes) -> None:
    with pytest.raises(HttpError, match="not an HTTP answer: '"):
        AnswerReader(max_bytes=1000).receive_data(data)


@pytest.mark.parametrize(
    "pieces",
    [
        [OK + b"Content-Length: 1001\r\n\r\n"],
        [OK + b"Transfer-Encoding: chunked\r\n\r\n3e9\r\n"],
        [OK + b"Transfer-Encoding: chunked\r\n\r\n3e8\r\n" + b"x" * 1000 + b"\r\n1\r\n"],
        [OK + b"\r\n" + b"x" * 1000, b"x"],
    ],
)
def test_a_body_is_bounded_before_it_has_come(pieces: list[bytes]) -> None:
    reader = AnswerReader(max_bytes=1000)
    for piece in pieces[:-1]:
        assert not reader.receive_data(piece)
    with pytest.raises(HttpError, match="an answer of more than 1000 bytes"):
        reader.receive_data(pieces[-1])


@pytest.mark.parametrize(
    ("begin", "text"),
    [
        (OK + b"X: ", "a head of more than"),
        (OK + b"Transfer-Encoding: chunked\r\n\r\n", "a line of more than"),
        (OK + b"Transfer-Encoding: chunked\r\n\r\n1;", "a line of more than"),
        (OK + b"Transfer-Encoding: chunked\r\n\r\n0\r\nX: y\r\n", "a (line|trailer) of more than"),
    ],
)
def test_heads_and_lines_are_bounded(begin: bytes, text: str) -> None:
    reader = AnswerReader(max_bytes=1 << 30)
    assert not reader.receive_data(begin)
    with pytest.raises(HttpError, match=text):
        for _ in range(20):
            reader.receive_data(b"1" * 1000)
    # Complete, but in one piece.
    with pytest.raises(HttpError, match=text):
        AnswerReader(max_bytes=1 << 30).receive_data(begin + b"1" * MAX_HEAD + b"\r\n\r\n")


@pytest.mark.parametrize("size", [1, 1000, 1 << 20])
def test_a_trailer_is_bounded_whatever_its_pieces(size: int) -> None:
    """A line of it that has not ended yet counts as well."""
    trailer = b"A: 1\r\n" + b"x" * (MAX_HEAD - 4)
    stream = OK + b"Transfer-Encoding: chunked\r\n\r\n0\r\n" + trailer
    reader = AnswerReader(max_bytes=100)
    with pytest.raises(HttpError, match="a trailer of more than"):
        for begin in range(0, len(stream), size):
            reader.receive_data(stream[begin : begin + size])


def test_a_trailer_is_bounded() -> None:
    reader = AnswerReader(max_bytes=1000)
    assert not reader.receive_data(OK + b"Transfer-Encoding: chunked\r\n\r\n0\r\n")
    with pytest.raises(HttpError, match="a trailer of more than"):
        for _ in range(20):
            reader.receive_data(b"X: y\r\n" * 250)


# pieces

ANSWERS = st.sampled_from(
    [
        OK + b"Content-Length: 7\r\n\r\nabcdefg",
        OK + b"Transfer-Encoding: chunked\r\n\r\n3;x\r\nabc\r\n4\r\ndefg\r\n0\r\nT: x\r\n\r\n",
        b"HTTP/1.1 100 Continue\r\n\r\n" + OK + b"A: b\n c\nContent-Length: 7\n\nabcdefg",
        b"HTTP/1.0 200 OK\r\n\r\nabcdefg",
    ]
)


@settings(deadline=None)
@given(ANSWERS, st.lists(st.integers(0, 120)))
@example(OK + b"Content-Length: 7\r\n\r\nabcdefg", list(range(60)))
def test_any_pieces_make_the_same_answer(answer: bytes, cuts: list[int]) -> None:
    reader = AnswerReader(max_bytes=7)
    edges = sorted({0, len(answer), *(cut for cut in cuts if cut < len(answer))})
    pieces = [answer[begin:end] for begin, end in itertools.pairwise(edges)]
    complete = [reader.receive_data(piece) for piece in pieces]
    if not complete[-1]:
        assert reader.receive_eof()
    assert not any(complete[:-1])
    assert (reader.status, reader.reason, reader.body) == (200, "OK", b"abcdefg")


TOKENS = [
    *(b"HTTP/1.1 ", b"200", b" OK", b"\r\n", b"\n", b":", b"0", b"5", b"a", b";", b" ", b"close"),
    *(b"Content-Length: ", b"Transfer-Encoding: chunked", b"Connection: ", b"\r\n\r\n", b"\xff"),
]


@settings(deadline=None)
@given(
    st.lists(st.lists(st.sampled_from(TOKENS) | st.binary(max_size=4), min_size=1).map(b"".join))
)
def test_whatever_comes_is_an_answer_or_the_documented_error(pieces: list[bytes]) -> None:
    reader = AnswerReader(max_bytes=100)
    with contextlib.suppress(HttpError):
        for piece in [OK, *pieces]:
            if piece and reader.receive_data(piece):
                break
        reader.receive_eof()
    assert len(reader.body) <= 100
