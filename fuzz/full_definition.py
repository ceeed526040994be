"""Definitions from connection headers, and frames of the types that they define.

An input is a full text, a zero octet, and frames as in :mod:`fuzz.decode`: any definition
with any octets, each class with codecs of its own.
"""

from __future__ import annotations

from collections.abc import Iterator
from random import Random

from aioros1.errors import InvalidNameError, MessageError
from aioros1.idl import MessageStore
from fuzz.catalogue import CLASSES
from fuzz.decode import SEPARATOR, check_frames
from fuzz.definition import TOKENS as WORDS
from fuzz.definition import check_class, text_of
from fuzz.reference import sample

__all__ = ["check", "seeds"]

_RULE = b"=" * 80
TOKENS = [*WORDS, b"\0", SEPARATOR, b"\n" + _RULE + b"\nMSG: p/A\n", b"=====\nMSG: "]
MAX_LEN = 2048
SHARE = 4

_CODEC_LIMIT = 60


def check(data: bytes) -> None:
    text, _, octets = data.partition(b"\0")
    store = MessageStore(parent=None)
    try:
        cls = store.add_definition("p/Root", text_of(text))
    except (MessageError, InvalidNameError) as error:
        assert str(error), "an error without a word"
        return
    check_class(cls)
    if octets and cls._leaves <= _CODEC_LIMIT:
        check_frames(cls, octets.split(SEPARATOR, 4)[:4])


def seeds() -> Iterator[bytes]:
    for number, cls in enumerate(CLASSES):
        text = cls._full_text.replace(cls._type, "p/Root").encode()
        values = Random(number)
        frames = [sample(cls, values, Random(shape)) for shape in (0, 0, 1)]
        whole = text + b"\0" + SEPARATOR.join(frames)
        if len(whole) <= MAX_LEN:
            yield whole
