"""Connection headers, byte by byte."""

from __future__ import annotations

import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from aioros1.wire.header import HeaderError, HeaderParser, decode_header, encode_header


def u32(number: int) -> bytes:
    return struct.pack("<I", number)


def field(data: bytes) -> bytes:
    return u32(len(data)) + data


def header(*fields: bytes) -> bytes:
    body = b"".join(map(field, fields))
    return u32(len(body)) + body


def parse(data: bytes, **limits: int) -> dict[str, str] | None:
    return HeaderParser(**limits).feed(data)


# what is sent


def test_encoding_is_length_then_fields_each_with_its_length():
    assert encode_header({"topic": "/chatter", "type": "std_msgs/String"}) == (
        b"\x2a\x00\x00\x00"  # 42 bytes: two lengths and two fields
        b"\x0e\x00\x00\x00topic=/chatter"
        b"\x14\x00\x00\x00type=std_msgs/String"
    )


def test_encoding_keeps_the_order_of_the_fields():
    names = [str(number) for number in range(20, 0, -1)]
    assert list(decode_header(encode_header(dict.fromkeys(names, "v"))[4:])) == names


def test_encoding_counts_bytes_and_not_characters():
    assert encode_header({"ü": "€"}) == u32(4 + 6) + u32(6) + b"\xc3\xbc=\xe2\x82\xac"


@pytest.mark.parametrize("name", ["", "a=b", "="])
def test_encoding_refuses_names_that_could_not_be_told_from_the_value(name):
    with pytest.raises(ValueError, match="the name must not hold '='"):
        encode_header({name: "value"})


# what is understood


def test_a_value_may_hold_equals_signs():
    assert parse(header(b"a=b=c==")) == {"a": "b=c=="}


def test_unknown_fields_and_empty_values_are_kept():
    assert parse(header(b"no_such_field=1", b"empty=")) == {"no_such_field": "1", "empty": ""}


def test_the_last_of_repeated_fields_counts():
    assert parse(header(b"a=first", b"b=x", b"a=last")) == {"a": "last", "b": "x"}


@pytest.mark.parametrize("bad", [b"", b"no separator"])
def test_a_field_without_an_equals_sign_is_refused(bad):
    with pytest.raises(HeaderError, match="is not name=value"):
        parse(header(b"a=b", bad, b"c=d"))


def test_a_field_without_a_name_says_nothing():
    assert parse(header(b"=x", b"a=b", b"  =y", b"=")) == {"a": "b"}


def test_white_space_around_a_name_does_not_count():
    assert parse(header(b" topic =/chatter ", b"\tmd5sum=*")) == {
        "topic": "/chatter ",
        "md5sum": "*",
    }


@pytest.mark.parametrize("value", [b"\xff\xfe", b"caf\xe9", b"\x80", b"\xed\xa0\x80"])
def test_a_value_that_is_not_utf8_survives(value):
    fields = parse(header(b"a=" + value))
    assert fields is not None
    assert fields["a"].encode("utf-8", "surrogateescape") == value
    assert encode_header(fields) == header(b"a=" + value)


def test_a_name_that_is_not_utf8_survives():
    fields = parse(header(b"\xff=v"))
    assert fields is not None
    assert encode_header(fields) == header(b"\xff=v")


@pytest.mark.parametrize("length", [0xFFFF_FFFF, 900_000_000, 1025])
def test_a_header_beyond_the_limit_is_refused_by_its_length_alone(length):
    parser = HeaderParser(max_bytes=1024)
    with pytest.raises(HeaderError, match=f"a header of {length} bytes, more than 1024"):
        parser.feed(u32(length))


def test_a_header_of_exactly_the_limit_is_accepted():
    data = header(b"a=" + b"x" * 1018)
    assert len(data) == 4 + 1024
    assert parse(data, max_bytes=1024) == {"a": "x" * 1018}


def test_an_empty_header_is_refused():
    with pytest.raises(HeaderError, match="an empty header"):
        parse(u32(0))


@pytest.mark.parametrize("length", [0xFFFF_FFFF, 4, 900_000_000])
def test_a_field_past_the_end_is_refused(length):
    body = field(b"a=b") + u32(length) + b"c=d"
    with pytest.raises(HeaderError, match=rf"a field of {length} bytes at offset 7 passes the end"):
        parse(u32(len(body)) + body)


@pytest.mark.parametrize("stray", [1, 2, 3])
def test_bytes_too_few_for_a_field_length_are_refused(stray):
    body = field(b"a=b") + bytes(stray)
    with pytest.raises(HeaderError, match=f"{stray} stray bytes"):
        parse(u32(len(body)) + body)


def test_the_number_of_fields_is_limited_however_short_they_are():
    fields = [b"a=b"] * 9
    assert parse(header(*fields[:8]), max_fields=8) == {"a": "b"}
    with pytest.raises(HeaderError, match="more than 8 fields"):
        parse(header(*fields), max_fields=8)


# how it comes


def test_a_header_is_read_one_byte_at_a_time():
    data = header(b"topic=/chatter", b"md5sum=*")
    parser = HeaderParser()
    for index in range(len(data) - 1):
        assert parser.missing() == (4 - index if index < 4 else len(data) - index)
        assert parser.feed(data[index : index + 1]) is None
    assert parser.feed(data[-1:]) == {"topic": "/chatter", "md5sum": "*"}
    assert parser.rest == b""


def test_what_comes_behind_a_header_is_the_rest():
    parser = HeaderParser()
    assert parser.feed(header(b"a=b") + b"first messages") == {"a": "b"}
    assert parser.rest == b"first messages"


def test_reading_no_more_than_is_missing_leaves_no_rest():
    stream = header(b"a=b", b"c=d") + b"messages"
    parser = HeaderParser()
    position = 0
    fields = None
    while fields is None:
        step = parser.missing()
        fields = parser.feed(stream[position : position + step])
        position += step
    assert fields == {"a": "b", "c": "d"}
    assert parser.rest == b""
    assert stream[position:] == b"messages"


texts = st.binary().map(lambda data: data.decode("utf-8", "surrogateescape"))


@given(
    st.dictionaries(st.from_regex(r"[a-z_0-9]+", fullmatch=True), texts, min_size=1, max_size=8),
    st.data(),
)
def test_any_fields_come_back_however_they_are_cut(fields, data):
    stream = encode_header(fields) + b"rest"
    cuts = sorted(data.draw(st.lists(st.integers(0, len(stream)), max_size=8)))
    parser = HeaderParser()
    found = None
    for begin, end in zip([0, *cuts], [*cuts, len(stream)], strict=True):
        if found is not None:
            break
        found = parser.feed(stream[begin:end])
        position = end
    assert found == fields
    assert parser.rest + stream[position:] == b"rest"


@given(st.binary(max_size=200))
def test_no_bytes_at_all_raise_anything_but_a_header_error(body):
    try:
        fields = decode_header(body)
    except HeaderError:
        return
    assert all(name for name in fields)
