"""Random definitions, random values, random octets."""

from __future__ import annotations

import struct
import sys
from array import array
from pathlib import Path
from random import Random
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from aioros1.errors import DeserializationError, SerializationError
from aioros1.idl import Message, MessageStore
from aioros1.idl.builtin_types import BUILTINS
from aioros1.time import Duration, Time

sys.path.append(str(Path(__file__).parents[2]))

from fuzz.decode import check_frames
from fuzz.reference import read, sample, tree
from fuzz.values import check_message

LIMITS = settings(
    max_examples=100,
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
)


brackets = st.sampled_from(["", "", "", "[]", "[]", "[0]", "[1]", "[3]"])


@st.composite
def definitions(draw: st.DrawFn) -> MessageStore:
    """A store with four types, each of which may contain the ones before it."""
    store = MessageStore(parent=None)
    for number, name in enumerate(["A", "B", "C", "Root"]):
        allowed = [*BUILTINS, *["A", "B", "C"][:number]]
        fields = draw(st.lists(st.tuples(st.sampled_from(allowed), brackets), max_size=6))
        names = ["x", "from", "Y", "data", "None", "self"]
        text = "\n".join(f"{t}{b} {n}" for (t, b), n in zip(fields, names, strict=False))
        store.add_text(f"p/{name}", text)
    return store


@st.composite
def scalars(draw: st.DrawFn, type_: str) -> Any:
    builtin = BUILTINS[type_]
    if builtin.kind == "int":
        return draw(st.integers(builtin.low, builtin.high))
    if builtin.kind == "float":
        # Any bit pattern: infinities, denormals and NaNs with a payload.
        return (
            struct.unpack("<f", draw(st.binary(min_size=4, max_size=4)))[0]
            if (builtin.size == 4)
            else struct.unpack("<d", draw(st.binary(min_size=8, max_size=8)))[0]
        )
    if builtin.kind == "bool":
        return draw(st.booleans())
    if builtin.kind == "string":
        # Any octets, as a decoder shows them.
        return draw(st.binary(max_size=8) | st.text(max_size=8).map(str.encode)).decode(
            "utf-8", "surrogateescape"
        )
    kind, low = (Time, 0) if builtin.kind == "time" else (Duration, -(1 << 31))
    part = st.integers(low, low + 0xFFFFFFFF)
    return kind._raw(draw(part), draw(part))


@st.composite
def messages(draw: st.DrawFn, cls: type[Message]) -> Message:
    message = cls()
    for field in cls._fields:
        if field.is_builtin:
            one = scalars(field.base_type)
        else:
            one = messages(cls._nested[field.base_type])
        if not field.is_array:
            value = draw(one)
        else:
            length = field.array_len
            sizes = (0, 4) if length is None else (length, length)
            value = draw(st.lists(one, min_size=sizes[0], max_size=sizes[1]))
            builtin = BUILTINS.get(field.base_type)
            if builtin is not None and builtin.octets:
                value = bytes(value)
            elif builtin is not None and builtin.kind in ("int", "float"):
                value = draw(st.sampled_from([list, tuple, lambda v, c=builtin.code: array(c, v)]))(
                    value
                )
        setattr(message, field.name, value)
    return message


@given(st.data())
@LIMITS
def test_round_trip(data: st.DataObject) -> None:
    cls = data.draw(definitions()).load_msg("p/Root")
    message = data.draw(messages(cls))
    octets = message.to_bytes()
    # Octets are compared, as not every NaN equals itself.
    assert cls.from_bytes(octets).to_bytes() == octets
    frame = struct.pack("<I", len(octets)) + octets
    assert cls._frame(message) == frame
    assert b"".join(cls._frame_parts(message)) == frame
    assert cls._min_size <= len(octets)
    assert cls._fixed_size in (None, len(octets))

    around = b"before" + octets + b"behind, and more than that"
    end = 6 + len(octets)
    assert cls._decode(around, 6, end).to_bytes() == octets
    view = memoryview(bytearray(around))
    copied, shown = cls._decode_view(view, 6, end), cls._decode_views(view, 6, end)
    assert shown.to_bytes() == octets
    view[:] = bytes(len(around))
    assert copied.to_bytes() == octets


@given(st.data())
@LIMITS
def test_shortened_octets_are_refused(data: st.DataObject) -> None:
    cls = data.draw(definitions()).load_msg("p/Root")
    octets = data.draw(messages(cls)).to_bytes()
    if not octets:
        return
    cut = data.draw(st.integers(0, len(octets) - 1))
    with pytest.raises(DeserializationError, match="p/Root"):
        cls.from_bytes(octets[:cut])
    with pytest.raises(DeserializationError):
        cls.from_bytes(octets + b"\0")
    for decode, whole in (
        (cls._decode, octets),
        (cls._decode_view, memoryview(octets)),
        (cls._decode_views, memoryview(octets)),
    ):
        # The rest is there, but it is not this message's.
        with pytest.raises(DeserializationError):
            decode(whole, 0, cut)


@given(st.data(), st.binary(max_size=60))
@LIMITS
def test_any_octets_are_a_message_or_an_error(data: st.DataObject, octets: bytes) -> None:
    cls = data.draw(definitions()).load_msg("p/Root")
    try:
        message = cls.from_bytes(octets)
    except DeserializationError:
        pass
    else:
        # Equal but for booleans, of which there are 255 ways to say yes.
        assert len(message.to_bytes()) == len(octets)
    try:
        message = cls._decode_views(memoryview(octets), 0, len(octets))
    except DeserializationError:
        pass
    else:
        assert len(message.to_bytes()) <= len(octets)


@given(st.data())
@LIMITS
def test_messages_are_what_the_definition_says(data: st.DataObject) -> None:
    cls = data.draw(definitions()).load_msg("p/Root")
    octets = data.draw(messages(cls)).to_bytes()
    right = read(cls, octets)
    assert (right.octets, right.used) == (octets, len(octets))
    assert tree(cls, cls.from_bytes(octets)) == right.tree


# How one message of a connection differs from another: in its values alone, in the lengths
# in it as well, or by octets that are missing, too many or changed.
streams = st.lists(
    st.tuples(
        st.integers(0, 3),
        st.sampled_from([0, 0, 0, 1, 2]),
        st.sampled_from(["", "", "", "", "cut", "more", "changed"]),
        st.integers(0, 1 << 16),
    ),
    min_size=2,
    max_size=8,
)


@given(definitions(), streams)
@LIMITS
def test_each_message_of_a_stream_is_decoded_for_itself(
    store: MessageStore, stream: list[tuple[int, int, str, int]]
) -> None:
    cls = store.load_msg("p/Root")
    frames = []
    for values, shape, change, where in stream:
        frame = bytearray(sample(cls, Random(values), Random(shape)))
        if change == "cut":
            del frame[where % (len(frame) + 1) :]
        elif change == "more":
            frame += bytes(1 + where % 9)
        elif change == "changed" and frame:
            frame[where % len(frame)] ^= 1 + where % 255
        frames.append(bytes(frame))
    check_frames(cls, frames)


NESTED = {"None": "", "Pair": "int8 x\nint16[2] y", "Leaf": "string x", "Only": "Leaf[2] x"}


@pytest.mark.parametrize("bracket", ["", "[]", "[0]", "[1]", "[3]"])
@pytest.mark.parametrize("base", ["int8", "uint8", "float64", "bool", "string", "time", *NESTED])
def test_the_smallest_definitions(base: str, bracket: str) -> None:
    store = MessageStore(parent=None)
    for name, text in NESTED.items():
        store.add_text(f"p/{name}", text)
    for before in ("", "int8 before\n", "string before\n"):
        for behind in ("", "\nint8 behind", "\nstring behind"):
            store.add_text("p/Root", f"{before}{base}{bracket} field{behind}")
            cls = store.load_msg("p/Root")
            shapes = [0, 0, 0, 1, 0, 2, 2, 1]
            frames = [sample(cls, Random(n), Random(shape)) for n, shape in enumerate(shapes)]
            check_frames(cls, [*frames, frames[0][:-1], frames[1] + b"\0", frames[2]])


@given(definitions(), st.lists(st.binary(max_size=60), max_size=4))
@LIMITS
def test_all_decoders_agree_on_any_octets(store: MessageStore, frames: list[bytes]) -> None:
    check_frames(store.load_msg("p/Root"), frames)


@given(definitions(), st.binary(max_size=200))
@LIMITS
def test_any_values_become_octets_or_an_error_with_a_path(
    store: MessageStore, choices: bytes
) -> None:
    check_message(store.load_msg("p/Root"), choices)


@given(st.data())
@LIMITS
def test_the_value_that_does_not_fit_is_named(data: st.DataObject) -> None:
    cls = data.draw(definitions()).load_msg("p/Root")
    message = data.draw(messages(cls))
    path = ""
    owner: Any = message
    while owner._fields:
        field = data.draw(st.sampled_from(owner._fields))
        path += f".{field.name}"
        value = getattr(owner, field.name)
        inner = [value]
        if field.is_array and not field.is_builtin and value:
            index = data.draw(st.integers(0, len(value) - 1))
            path += f"[{index}]"
            inner = value[index : index + 1]
        if field.is_builtin or not isinstance(inner[0], Message) or not inner[0]._fields:
            path = path.rpartition("[")[0] if inner[0] is not value else path
            setattr(owner, field.name, object())
            break
        owner = inner[0]
    else:
        return
    for encode in (cls._encode, cls._frame, cls._frame_parts):
        with pytest.raises(SerializationError) as caught:
            encode(message)
        assert str(caught.value).startswith(f"{path[1:]}: expected ")


@given(st.data())
@LIMITS
def test_dicts_and_copies_are_equal(data: st.DataObject) -> None:
    cls = data.draw(definitions()).load_msg("p/Root")
    message = data.draw(messages(cls))
    octets = message.to_bytes()
    assert cls.from_dict(message.to_dict()).to_bytes() == octets
    assert message.replace().to_bytes() == octets
    assert repr(message).startswith("Root(")
    assert isinstance(str(message), str)
