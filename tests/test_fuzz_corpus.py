"""The inputs that fuzzing has left: checked again, without the fuzzer."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import pytest

sys.path.append(str(Path(__file__).parents[1]))

from fuzz import catalogue, decode, http, pack, service, values


def check_all(target: str, inputs: Iterable[bytes]) -> int:
    check = importlib.import_module(f"fuzz.{target}").check
    count = 0
    for data in inputs:
        try:
            check(data)
        except Exception as error:
            error.add_note(f"input: {data!r}")
            raise
        count += 1
    return count


@pytest.mark.parametrize("target", pack.TARGETS)
def test_the_kept_inputs_are_well(target: str) -> None:
    assert check_all(target, pack.load(target)) > 10


@pytest.mark.parametrize("target", pack.TARGETS)
def test_the_seeds_are_well(target: str) -> None:
    assert check_all(target, importlib.import_module(f"fuzz.{target}").seeds()) > 10


def test_an_archive_gives_back_what_was_put_in(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pack, "CORPUS", tmp_path / "corpus")
    assert pack.load("decode") == []
    first = pack.save("decode", [b"bb", b"", b"a", b"bb"]).read_bytes()
    assert pack.load("decode") == [b"", b"a", b"bb"]
    assert pack.save("decode", [b"a", b"bb", b""]).read_bytes() == first


# What is the use of checks that cannot fail?


@pytest.fixture
def names() -> Any:
    """A fresh class of string[]: nobody else has its codecs."""
    own = catalogue.store()
    own.add_text("fz/Names", "string[] names\nint32 n")
    return own.load_msg("fz/Names")


def octets(cls: Any, *names: str, n: int = 0) -> bytes:
    return bytes(cls(list(names), n).to_bytes())


def test_a_decoder_that_mixes_up_messages_of_one_size_is_noticed(names: Any) -> None:
    right = names._decode
    seen: dict[int, Any] = {}

    def wrong(data: bytes, pos: int, end: int) -> Any:
        return seen.setdefault(end - pos, right(data, pos, end))

    frames = [octets(names, "a", "bcd"), octets(names, "abc", "d")]
    decode.check_frames(names, frames, ("_decode",))
    names._decode = wrong
    with pytest.raises(AssertionError):
        decode.check_frames(names, frames, ("_decode",))


def test_a_decoder_that_shares_a_list_is_noticed(names: Any) -> None:
    right = names._decode
    shared: list[str] = ["a"]

    def wrong(data: bytes, pos: int, end: int) -> Any:
        message = right(data, pos, end)
        message.names = shared
        return message

    names._decode = wrong
    with pytest.raises(AssertionError):
        decode.check_frames(names, [octets(names, "a")] * 2, ("_decode",))


def test_a_copy_that_is_a_view_is_noticed(names: Any) -> None:
    own = catalogue.store()
    own.add_text("fz/Octets", "uint8[] data")
    cls: Any = own.load_msg("fz/Octets")
    frame = cls(b"abc").to_bytes()
    decode.check_frames(cls, [frame] * 2)
    cls._decode_view = cls._decode_views
    with pytest.raises(AssertionError, match="behind its owner's back"):
        decode.check_frames(cls, [frame] * 2)


@pytest.mark.parametrize("cut", [0, 3, 5])
def test_a_decoder_that_takes_too_little_or_too_much_is_noticed(names: Any, cut: int) -> None:
    right = names._decode
    frame = octets(names, "a")
    names._decode = lambda data, pos, end: right(data, pos, len(data))
    with pytest.raises(AssertionError):
        decode.check_frames(names, [frame[:cut], frame], ("_decode",))

    def wrong(data: bytes, pos: int, end: int) -> Any:
        raise decode.DeserializationError("fz/Names.n: 4 bytes expected at offset 9")

    names._decode = wrong
    with pytest.raises(AssertionError, match="refused"):
        decode.check_frames(names, [frame], ("_decode",))


@pytest.mark.parametrize(
    "text",
    [
        "not a message",
        "fz/Names: 4 bytes expected, 0 left at offset 9",
        "fz/Names.names: 4 bytes expected, 0 left at offset 99",
        "fz/Names.name: 4 bytes expected, 0 left at offset 9",
        "fz/Names.n: for a reason unknown at offset 9",
        "fz/Other.n: 4 bytes expected, 0 left at offset 9",
    ],
)
def test_an_error_that_says_something_else_is_noticed(names: Any, text: str) -> None:
    frame = octets(names, "a")[:-4]
    decode.check_frames(names, [frame])

    def wrong(data: bytes, pos: int, end: int) -> Any:
        raise decode.DeserializationError(text)

    names._decode = wrong
    with pytest.raises(AssertionError):
        decode.check_frames(names, [frame], ("_decode",))


def test_an_encoder_that_is_wrong_is_noticed(names: Any) -> None:
    right = names._encode
    for data in (b"", bytes(range(30)), b"\1\3\2"):
        values.check_message(names, data)
    names._encode = lambda message: right(message)[:-1] + b"x"
    with pytest.raises(AssertionError):
        values.check_message(names, b"")

    def unnamed(message: Any) -> bytes:
        raise values.SerializationError("expected int32, got None")

    names._encode = names._frame = unnamed
    with pytest.raises(AssertionError):
        values.check_message(names, b"")


def found(target: Any) -> int:
    """How many of a target's seeds something is found with."""
    count = 0
    for data in target.seeds():
        try:
            target.check(data)
        except AssertionError:
            count += 1
    return count


LINK = service.ServiceLink
READER = http.AnswerReader
next_, size_of, take_body = LINK._next, LINK._size_of, READER._take_body
take_chunks, fields = READER._take_chunks, READER._fields


@pytest.mark.parametrize(
    ("owner", "name", "wrong"),
    [
        (LINK, "_next", lambda self: None if len(self._buffer) % 3 else next_(self)),
        (LINK, "_size_of", lambda self, data: min(size_of(self, data), 300)),
        (LINK, "_set_timer", lambda self, seconds: None),
        (LINK, "_end", lambda self: None),
        (LINK, "resume_writing", lambda self: None),
        # One that reads on, whoever wants it.
        (service._Transport, "pause_reading", lambda self: None),
    ],
)
def test_a_link_that_loses_or_keeps_something_is_noticed(
    monkeypatch: pytest.MonkeyPatch, owner: Any, name: str, wrong: Any
) -> None:
    assert found(service) == 0
    monkeypatch.setattr(owner, name, wrong)
    assert found(service) > 0


@pytest.mark.parametrize(
    ("name", "wrong"),
    [
        ("_take_body", lambda self, data, at: take_body(self, data, max(at - 1, 0))),
        ("_take_chunks", lambda self, data, at: take_chunks(self, data + b"\r\n", at)),
        ("_fields", lambda self, lines, keeps_alive: fields(self, lines, True)),
        ("_within_limit", lambda self, more: more),
        ("receive_eof", lambda self: False),
    ],
)
def test_a_reader_of_answers_that_is_wrong_is_noticed(
    monkeypatch: pytest.MonkeyPatch, name: str, wrong: Any
) -> None:
    assert found(http) == 0
    monkeypatch.setattr(READER, name, wrong)
    assert found(http) > 0
