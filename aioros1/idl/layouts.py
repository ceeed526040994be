"""The layouts of messages that were decoded before: where in the octets everything is.

Messages of one stream mostly have the same layout: the same names in the same order, the
same number of joints, only other numbers. Where all lengths are known beforehand, one
:class:`struct.Struct` reads from one end of the message to the other. A decoder takes the
lengths of the last message of the same size for granted, compares them with those that it
then reads, and goes the usual way when they differ.

A :class:`Plan` says which stretches the messages of a type consist of; it is written down
along with the decoder (:mod:`.codegen_learned`). :class:`Layouts` is what is remembered,
bounded in number and size, whatever comes.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Literal, NamedTuple, TypeAlias

__all__ = ["Differs", "Layout", "Layouts", "Loop", "Plan", "Step", "Stretch"]

MAX_LAYOUTS = 64
"""Layouts kept for one decoder; each has another size."""
MAX_MISTAKES = 8
"""How often a size may turn out to have another layout before it is given up."""
MAX_PARTS = 256
"""Elements of arrays of messages in a layout."""
MAX_STRINGS = 4096
"""Octets of lists of strings in a layout, all told."""

Layout: TypeAlias = tuple[Any, ...]

_length = struct.Struct("<I").unpack_from

# The elements of an array mostly are of few layouts, and share what they have in common.
_struct = lru_cache(1024)(struct.Struct)


class Differs(Exception):
    """The octets are not in the layout that was expected."""


class Step(NamedTuple):
    """Something of a length that has to be known, and the octets before it that are fixed.

    ``sized`` is a count and as many items of one size; ``strings`` a list of strings, with
    a count in front or (``number``) without; ``count`` a count of what is not in the same
    stretch.
    """

    kind: Literal["sized", "strings", "count"]
    fixed: int
    item_size: int = 1
    number: int | None = None


class Stretch(NamedTuple):
    """Neighbours that are read at once; ``template`` lacks the lengths of the steps."""

    template: str
    steps: tuple[Step, ...]


class Loop(NamedTuple):
    """The elements of an array of messages, each of them in a layout of its own."""

    plan: Plan
    number: int | None
    """How many there are, unless the count at the end of the stretch before says it."""


Plan: TypeAlias = list[Stretch | Loop]


@dataclass(slots=True)
class _Survey:
    """Walks through the octets of a message to find its layout.

    The message was decoded before: nothing needs to be checked.
    """

    data: bytes
    pos: int
    parts: int = 0
    octets: int = 0  # of lists of strings

    def layout(self, plan: Plan) -> Layout:
        """The values that the decoder unpacks: those of the parts, one after the other."""
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

    ``known`` is what the decoder looks into: nothing is there, or None, as long as a size
    has to be learned, and ``()`` once it was given up.
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
        # Octets that were left over belong to no layout.
        self.known[size] = layout if survey.pos == end else ()

    def mistaken(self, size: int) -> Layout | None:
        """Forget a layout that turned out to be another; gives None to learn it anew."""
        mistakes = self._mistakes[size] = self._mistakes.get(size, 0) + 1
        # Its place is kept: the sizes that were ever learned are no more than there are
        # places, whatever comes.
        layout = self.known[size] = () if mistakes >= MAX_MISTAKES else None
        return layout
