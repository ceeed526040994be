"""Layouts of messages that were decoded before: where in the bytes everything is.

Messages of one stream mostly have the same layout: the same names in the same order and
the same number of joints, only other numbers. If all lengths are known beforehand, one
:class:`struct.Struct` reads the message from one end to the other. So a decoder assumes
the lengths of the last message of the same size, compares them with those that it reads,
and decodes the usual way when they differ.

A :class:`Plan` says of which stretches the messages of a type consist; it is made along
with the decoder (:mod:`.codegen_learned`). :class:`Layouts` is what a decoder remembers,
bounded in number and size.

Threads share the layouts of a decoder. A layout never changes, and is looked up and
replaced in one step; two threads that learn at the same time at worst learn once more.
"""

from __future__ import annotations

import struct
from functools import lru_cache
from typing import Any, Literal, NamedTuple, TypeAlias

__all__ = ["Differs", "Layout", "Layouts", "Loop", "Plan", "Step", "Stretch"]

MAX_LAYOUTS = 64
"""How many layouts a decoder keeps, each for another size of message."""
MAX_MISTAKES = 8
"""How many wrong layouts a size may have before it is given up."""
MAX_PARTS = 256
"""How many elements of arrays of messages a layout may have."""
MAX_STRINGS = 4096
"""How many bytes of lists of strings a layout may hold."""

Layout: TypeAlias = tuple[Any, ...]

_length = struct.Struct("<I").unpack_from

# Most elements of an array have one of a few layouts, and share these.
_struct = lru_cache(1024)(struct.Struct)


class Differs(Exception):
    """The message does not have the assumed layout."""


class Step(NamedTuple):
    """Something of any length, and ``fixed``, the number of bytes in front of it.

    ``sized``: a count, and that many items of one size. ``strings``: a list of strings,
    behind a count unless ``number`` says how many. ``count``: a count alone, of what comes
    in the next part.
    """

    kind: Literal["sized", "strings", "count"]
    fixed: int
    item_size: int = 1
    number: int | None = None


class Stretch(NamedTuple):
    """What is read at once; ``template`` is its format without the lengths of the steps."""

    template: str
    steps: tuple[Step, ...]


class Loop(NamedTuple):
    """The elements of an array of messages, each with a layout of its own."""

    plan: Plan
    number: int | None
    """How many there are; None if the stretch before ends with their count."""


Plan: TypeAlias = list[Stretch | Loop]


class _Survey:
    """Walks through the bytes of a message to find its layout.

    The message has just been decoded, so nothing needs to be checked.
    """

    __slots__ = ("data", "octets", "parts", "pos")

    def __init__(self, data: bytes, pos: int) -> None:
        self.data = data
        self.pos = pos
        self.parts = 0  # elements of arrays of messages
        self.octets = 0  # bytes of lists of strings

    def layout(self, plan: Plan) -> Layout:
        """The values that the decoder unpacks, of one part after the other."""
        values: list[Any] = []
        for part in plan:
            if isinstance(part, Stretch):
                values += self.stretch(part)
            else:
                count = values[-1] if part.number is None else part.number
                self.parts += count
                if self.parts > MAX_PARTS:
                    raise _TooLarge
                values.append([self.layout(part.plan) for _ in range(count)])
        return tuple(values)

    def stretch(self, stretch: Stretch) -> list[Any]:
        start = self.pos
        sizes: list[int] = []
        known: list[Any] = []
        for step in stretch.steps:
            self.pos += step.fixed
            if step.number is None:
                (count,) = _length(self.data, self.pos)
                self.pos += 4
                known.append(count)
            else:
                count = step.number
            if step.kind == "sized":
                sizes.append(count * step.item_size)
                self.pos += sizes[-1]
            elif step.kind == "strings":
                block, texts = self.strings(count)
                sizes.append(len(block))
                known += (block, texts)
        packer = _struct(stretch.template.format(*sizes))
        self.pos = start + packer.size
        return [packer.unpack_from, packer.size, *known]

    def strings(self, count: int) -> tuple[bytes, list[str]]:
        start = self.pos
        texts: list[str] = []
        for _ in range(count):
            (size,) = _length(self.data, self.pos)
            self.pos += 4 + size
            self.octets += 4 + size
            if self.octets > MAX_STRINGS:
                raise _TooLarge
            texts.append(self.data[self.pos - size : self.pos].decode())
        return self.data[start : self.pos], texts


class _TooLarge(Exception):
    """The layout is not worth remembering."""


class Layouts:
    """The layouts that one decoder has seen, by the size of the message.

    The decoder looks into ``known``. A size that has to be learned is missing there, or
    has None; a size that was given up has ``()``.
    """

    def __init__(self, plan: Plan) -> None:
        self.known: dict[int, Layout | None] = {}
        self._plan = plan
        self._mistakes: dict[int, int] = {}

    def learn(self, data: bytes, pos: int, end: int) -> None:
        """Remember the layout of the message between ``pos`` and ``end``."""
        size = end - pos
        if len(self.known) >= MAX_LAYOUTS and size not in self.known:
            return
        survey = _Survey(data, pos)
        try:
            layout = survey.layout(self._plan)
        except (_TooLarge, UnicodeDecodeError):
            layout = ()
        # A message with bytes left over has no layout.
        self.known[size] = layout if survey.pos == end else ()

    def mistaken(self, size: int) -> Layout | None:
        """Forget a layout that was wrong; gives None if the size is to be learned anew."""
        mistakes = self._mistakes[size] = self._mistakes.get(size, 0) + 1
        # The size keeps its place, so that no more sizes than there are places are ever
        # learned.
        layout = self.known[size] = () if mistakes >= MAX_MISTAKES else None
        return layout
