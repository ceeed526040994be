"""Texts of definitions: whatever they say, a spec and classes, or an error that is ours."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from aioros1.errors import MessageError
from aioros1.idl import Message, MessageStore
from aioros1.idl.builtin_types import BUILTINS
from fuzz.catalogue import BUNDLE, DEFINITIONS
from fuzz.decode import check_frames
from fuzz.reference import MAX_EMPTY

__all__ = ["check", "check_class", "seeds", "text_of"]

TOKENS = [
    *(name.encode() for name in BUILTINS),
    *(b"Header", b"Header header", b"A", b"p/A", b"std_msgs/Header", b"[]", b"[3]", b"[0]"),
    *(b"---", b"\n---\n", b"=", b"#", b"True", b"string S=", b"p/Root", b"Root", b"\t", b"\r"),
]
MAX_LEN = 512
SHARE = 7

_CODEC_LIMIT = 60
_ZERO_LIMIT = 20_000


def _base() -> MessageStore:
    made = MessageStore(parent=None)
    made.add_text("std_msgs/Header", "uint32 seq\ntime stamp\nstring frame_id")
    made.add_text("std_msgs/Empty", "")
    made.add_text("actionlib_msgs/GoalID", "time stamp\nstring id")
    made.add_text("actionlib_msgs/GoalStatus", "GoalID goal_id\nuint8 status\nstring text")
    made.add_text("p/A", "int8 x\nstring y")
    made.add_text("p/B", "A[] a\nint16[3] z")
    return made


_BASE = _base()


def text_of(data: bytes) -> str:
    """Text as it comes out of a file or a connection header."""
    return data.decode("utf-8", "surrogateescape")


def check(data: bytes) -> None:
    store = MessageStore(parent=_BASE)
    text = text_of(data)
    separators = min(sum(line.startswith("---") for line in text.split("\n")), 2)
    try:
        store.add_text("p/Root", text)
        classes: list[Any]
        if separators == 0:
            classes = [store.load_msg("p/Root")]
        elif separators == 1:
            service = store.load_srv("p/Root")
            assert len(service._md5sum) == 32
            classes = [service.Request, service.Response]
        else:
            store.load_action("p/Root")
            classes = [store.load_msg(f"p/Root{part}") for part in ("Goal", "ActionResult")]
    except MessageError as error:
        assert str(error), "an error without a word"
        return
    for cls in classes:
        check_class(cls)


def check_class(cls: type[Message]) -> None:
    """The full text says it all; and what the codecs make of nothing is a message."""
    alone = MessageStore(parent=None)
    again = alone.add_definition(cls._type, cls._full_text)
    assert again._md5sum == cls._md5sum, f"{again._md5sum} from the full text of {cls._md5sum}"
    assert again._slot_types == cls._slot_types
    assert alone.add_definition(cls._type, cls._full_text) is again
    if again._leaves > _CODEC_LIMIT or _weight(cls) > _ZERO_LIMIT:
        return
    zero = cls()
    # By way of the base class: a field may have the name of a method.
    octets = Message.to_bytes(zero)
    assert len(octets) == cls._min_size
    check_frames(cls, [octets, octets[:-1]])
    assert Message.__eq__(Message.from_bytes.__func__(cls, octets), zero)  # type: ignore[attr-defined]
    assert Message.__eq__(Message.from_dict.__func__(cls, Message.to_dict(zero)), zero)  # type: ignore[attr-defined]
    assert isinstance(Message.__repr__(zero), str)
    assert isinstance(Message.__str__(zero), str)


def _weight(cls: type[Message]) -> int:
    """How many values a fresh message is made of."""
    total = 0
    for field in cls._fields:
        nested = cls._nested.get(field.base_type)
        each = 1 if nested is None else 1 + _weight(nested)
        count = 1 if not field.is_array else field.array_len or 0
        total += count * each
    return total


def seeds() -> Iterator[bytes]:
    """The bundled texts, and those of the other targets."""
    for path in sorted(BUNDLE.rglob("*.*")):
        text = path.read_bytes()
        if path.suffix in (".msg", ".srv", ".action") and len(text) <= MAX_LEN:
            yield text
    yield from (text.encode() for text in DEFINITIONS.values())
    yield b"int32 X=-3\nstring S= a # b \nbool B=True\nfloat64 F=1e3\nB b\np/A[2] from"
    yield b"A a\n---\nB[] b\nstring message\n"
    yield b"int8 goal\n---\nbool done\n---\nHeader h\nstd_msgs/Empty[3] e\n"


assert MAX_EMPTY > _ZERO_LIMIT  # or a fresh message might be one that is refused
