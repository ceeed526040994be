"""What flows on a service connection behind the headers."""

from __future__ import annotations

import struct

import pytest

from aioros1.wire.service import (
    FAILURE,
    SUCCESS,
    ServiceFrameError,
    encode_failure,
    frame_length,
)


def test_success_and_failure_are_one_byte():
    assert (SUCCESS, FAILURE) == (b"\x01", b"\x00")


def test_a_failure_has_the_length_of_its_text_before_it():
    assert encode_failure("no way") == b"\x00" + b"\x06\x00\x00\x00" + b"no way"


def test_a_failure_without_a_text_has_a_length_all_the_same():
    assert encode_failure("") == b"\x00" + b"\x00\x00\x00\x00"


def test_a_failure_counts_bytes_and_not_characters():
    assert encode_failure("€") == b"\x00" + b"\x03\x00\x00\x00" + "€".encode()


def test_a_text_that_was_never_utf8_goes_out_as_it_came_in():
    text = b"\xff\x00".decode("utf-8", "surrogateescape")
    assert encode_failure(text) == b"\x00" + b"\x02\x00\x00\x00" + b"\xff\x00"


@pytest.mark.parametrize("length", [0, 1, 1024])
def test_a_length_within_the_limit(length):
    assert frame_length(struct.pack("<I", length), 1024) == length


@pytest.mark.parametrize("length", [1025, 900_000_000, 0xFFFF_FFFF])
def test_a_length_beyond_the_limit_is_refused(length):
    with pytest.raises(ServiceFrameError, match=f"a frame of {length} bytes, more than 1024"):
        frame_length(struct.pack("<I", length), 1024)
