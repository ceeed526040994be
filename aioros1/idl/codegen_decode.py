"""Writes decoders; :mod:`.codegen` explains what encoders and decoders share.

::

    def decode(data, pos, end):
        try:
            m1 = new2()
            m3 = new4()
            m1.header = m3
            t5 = new6()
            m3.stamp = t5
            m3.seq, t5._secs, t5._nsecs, n7 = u8(data, pos)
            i9 = pos + 16
            j10 = i9 + n7
            if j10 > end: raise ValueError
            m3.frame_id = data[i9:j10].decode()
            return m1
        except UnicodeDecodeError: ...

A decoder cannot read outside of ``data``: slices stop at its end, and struct raises. So one
comparison at the very end would do. But behind ``end`` there may be many other messages,
and a peer could have them copied with each of its own messages. That is why each length is
compared with ``end`` before it is used, unless the message is alone in ``data``.

:mod:`.codegen_learned` writes a quicker way for messages of a layout that came before, and
:mod:`.decoders` makes functions of both.
"""

from __future__ import annotations

from itertools import starmap
from keyword import iskeyword
from typing import Literal, TypeAlias

from aioros1.idl import values
from aioros1.idl.builtin_types import BUILTINS
from aioros1.idl.codegen import Source
from aioros1.idl.spec import Field
from aioros1.idl.structure import Structure
from aioros1.time import Duration, Time, raw_duration, raw_time

__all__ = ["MAX_EMPTY", "Decoder", "Mode", "write_decoder"]

MAX_EMPTY = 65536
"""How many messages of zero bytes one message may hold in its arrays. The size of the
frame does not limit their number; no type in use has any."""

Mode: TypeAlias = Literal["bytes", "escape", "view", "views"]
"""What ``data`` is, and what becomes of payloads. ``bytes``: a bytes object. ``escape``: the
same, for text that is not UTF-8. ``view``: a memoryview, whose payloads are copied.
``views``: a memoryview, whose payloads are not copied."""


class Decoder:
    """Walks a class and writes the body of its decoder.

    The next byte to read is at ``base`` (a local variable) plus the size of the run.
    ``codes`` and ``targets`` are the current run; ``after`` holds the lines that need its
    values.
    """

    def __init__(
        self, out: Source, mode: Mode, base: str, *, alone: bool, row: str | None = None
    ) -> None:
        self.out = out
        self.mode: Mode = mode
        self.base = base
        self.alone = alone  # whether `data` ends at `end`
        self.bounded = ""  # the base that was compared with `end`
        self.row = row  # an unpacked row to take the run from, in place of `data`
        self.deferred = row is not None  # whether all values come before they are used
        self.codes: list[str] = []
        self.targets: list[str] = []
        self.after: list[str] = []

    # -- runs -------------------------------------------------------------------------

    def take(self, code: str, *targets: str) -> None:
        self.codes.append(code)
        self.targets += targets

    def flush(self) -> None:
        """Write what reads the run, and move ``base`` behind it."""
        if not self.codes:
            return
        key, packer = self.out.structure(self.codes)
        if self.targets:
            targets = ", ".join(self.targets) + ("," if len(self.targets) == 1 else "")
            if self.row is not None:
                self.out.line(f"{targets} = {self.row}")
            else:
                unpack = self.out.bind("u", packer.unpack_from, ("unpack", key))
                self.out.line(f"{targets} = {unpack}(data, {self.base})")
        for line in self.after:
            self.out.line(line)
        if packer.size and self.row is None:
            self.base = self.behind(packer.size)
        self.codes, self.targets, self.after = [], [], []

    def local(self, prefix: str, value: str) -> str:
        name = self.out.fresh(prefix)
        self.out.line(f"{name} = {value}")
        return name

    def behind(self, size: int) -> str:
        """The position ``size`` bytes behind ``base``."""
        if self.base.isdecimal():
            return str(int(self.base) + size)
        return self.local("i", f"{self.base} + {size}")

    def count(self) -> str:
        """Write what reads a length, which ends the run."""
        name = self.out.fresh("n")
        self.take("I", name)
        self.flush()
        return name

    # -- where values go --------------------------------------------------------------

    def store(self, owner: str, field: Field, value: str) -> None:
        if iskeyword(field.name):
            self.out.line(f"setattr({owner}, {field.name!r}, {value})")
        else:
            self.out.line(f"{owner}.{field.name} = {value}")

    def target(self, owner: str, field: Field) -> str:
        """What an unpacked value is assigned to: the attribute itself where possible."""
        if not iskeyword(field.name):
            return f"{owner}.{field.name}"
        name = self.out.fresh("x")
        self.after.append(f"setattr({owner}, {field.name!r}, {name})")
        return name

    def create(self, owner: str, field: Field, prefix: str, cls: type) -> str:
        """Make an object and put it in its field; its own fields are filled in later."""
        name = self.local(prefix, self.out.new(cls))
        self.store(owner, field, name)
        return name

    # -- fields -----------------------------------------------------------------------

    def message(self, cls: type[Structure], owner: str) -> None:
        for field in cls._fields:
            if field.is_array:
                self.array(cls, field, owner)
            elif field.is_builtin:
                self.scalar(field, owner)
            else:
                nested = cls._nested[field.base_type]
                name = self.create(owner, field, "m", nested)
                self.message(nested, name)

    def scalar(self, field: Field, owner: str) -> None:
        builtin = BUILTINS[field.base_type]
        if builtin.kind in ("int", "float", "bool"):
            self.take(builtin.code, self.target(owner, field))
        elif builtin.kind == "string":
            start, stop = self.extent(1)
            self.store(owner, field, self.text(start, stop))
        else:
            name = self.create(owner, field, "t", Time if builtin.kind == "time" else Duration)
            self.take(builtin.code, f"{name}._secs", f"{name}._nsecs")

    def extent(self, item_size: int) -> tuple[str, str]:
        """Read a count and step over that many items; gives their start and stop."""
        count = self.count()
        start = self.base
        times = count if item_size == 1 else f"{item_size} * {count}"
        self.base = self.local("j", f"{start} + {times}")
        if not self.alone:
            self.out.line(f"if {self.base} > end: raise ValueError")
            self.bounded = self.base
        return start, self.base

    def text(self, start: str, stop: str) -> str:
        if self.mode == "bytes":
            return f"data[{start}:{stop}].decode()"
        if self.mode == "escape":
            return f"data[{start}:{stop}].decode('utf-8', 'surrogateescape')"
        return f"str(data[{start}:{stop}], 'utf-8', 'surrogateescape')"

    def octets(self, start: str, stop: str) -> str:
        part = f"data[{start}:{stop}]"
        return f"{part}.tobytes()" if self.mode == "view" else part

    def numbers(self, code: str, octets: str) -> str:
        if not values.LITTLE:
            return f"{self.out.use('load_array')}({code!r}, {octets})"
        if self.mode == "views":
            return f"{octets}.cast({code!r})"
        return f"array({code!r}, {octets})"

    def array(self, cls: type[Structure], field: Field, owner: str) -> None:
        builtin = BUILTINS.get(field.base_type)
        if field.array_len == 0 and (builtin is None or builtin.kind == "string"):
            # It has a fixed size even if its elements have none, and so can be in a row.
            self.store(owner, field, "[]")
        elif builtin is None:
            self.messages(cls._nested[field.base_type], field, owner)
        elif builtin.kind == "string":
            self.strings(field, owner)
        elif field.array_len is not None:
            self.fixed(field, owner, field.array_len)
        elif builtin.kind in ("int", "float"):
            start, stop = self.extent(builtin.size)
            if builtin.octets:
                self.store(owner, field, self.octets(start, stop))
            elif self.mode == "view" and values.LITTLE:
                # array(code, memoryview) would take each byte for a number.
                name = self.local("a", f"array({builtin.code!r})")
                self.out.line(f"{name}.frombytes(data[{start}:{stop}])")
                self.store(owner, field, name)
            else:
                self.store(owner, field, self.numbers(builtin.code, f"data[{start}:{stop}]"))
        else:
            start, stop = self.extent(builtin.size)
            self.store(owner, field, self.listed(builtin.kind, f"data[{start}:{stop}]"))

    def listed(self, kind: str, octets: str) -> str:
        """A list of booleans or times."""
        if kind == "bool":
            return f"list(map(bool, {octets}))"
        codes = ["II"] if kind == "time" else ["ii"]
        key, packer = self.out.structure(codes)
        rows = self.out.bind("r", packer.iter_unpack, ("rows", key))
        self.out.globals["raw_" + kind] = raw_time if kind == "time" else raw_duration
        self.out.globals["starmap"] = starmap
        # Not a comprehension: each is a scope of its own, and slow to compile.
        return f"list(starmap(raw_{kind}, {rows}({octets})))"

    def fixed(self, field: Field, owner: str, length: int) -> None:
        """A fixed array of a built-in type other than string: part of the run."""
        builtin = BUILTINS[field.base_type]
        size = length * builtin.size
        if self.mode == "views" and builtin.kind in ("int", "float") and self.row is None:
            # There is no value to unpack, only a place to point at.
            _, before = self.out.structure(self.codes)
            start, stop = before.size, before.size + size
            self.take(f"{size}x")
            part = f"data[{self.base} + {start}:{self.base} + {stop}]"
            value = part if builtin.octets else self.numbers(builtin.code, part)
            self.assign_after(owner, field, value)
        elif builtin.octets:
            self.take(f"{size}s", self.target(owner, field))
        else:
            name = self.out.fresh("x")
            self.take(f"{size}s", name)
            if builtin.kind in ("int", "float"):
                value = (
                    f"array({builtin.code!r}, {name})"
                    if values.LITTLE
                    else f"{self.out.use('load_array')}({builtin.code!r}, {name})"
                )
            else:
                value = self.listed(builtin.kind, name)
            self.assign_after(owner, field, value)

    def assign_after(self, owner: str, field: Field, value: str) -> None:
        if iskeyword(field.name):
            self.after.append(f"setattr({owner}, {field.name!r}, {value})")
        else:
            self.after.append(f"{owner}.{field.name} = {value}")

    def length(self, field: Field) -> str:
        """The number of elements of a list, read or fixed; it ends the run."""
        if field.array_len is None:
            return self.count()
        self.flush()
        return str(field.array_len)

    def strings(self, field: Field, owner: str) -> None:
        count = self.length(field)
        self.check_count(count, 4)
        if self.mode in ("bytes", "escape"):
            reader = values.string_reader(self.mode == "escape")
            read = self.out.bind("strings", reader, object())
            items, position = self.out.fresh("l"), self.out.fresh("k")
            self.out.line(f"{items}, {position} = {read}(data, {self.base}, end, {count})")
            self.base = position
            self.store(owner, field, items)
            return
        items = self.local("l", "[]")
        size = self.out.fresh("n")
        position = self.local("k", self.base)
        start = self.out.fresh("i")
        key, packer = self.out.structure(["I"])
        unpack = self.out.bind("u", packer.unpack_from, ("unpack", key))
        self.out.line(f"for _ in range({count}):")
        self.out.depth += 1
        self.out.line(f"{size}, = {unpack}(data, {position})")
        self.out.line(f"{start} = {position} + 4")
        self.out.line(f"{position} = {start} + {size}")
        self.out.line(f"if {position} > end: raise ValueError")
        self.out.line(f"{items}.append({self.text(start, position)})")
        self.out.depth -= 1
        self.base = position
        self.store(owner, field, items)

    def check_count(self, count: str, item_size: int) -> None:
        """Refuse a count that the bytes left cannot hold, before anything is made."""
        if item_size:
            self.out.line(f"if {item_size} * {count} > end - {self.base}: raise ValueError")
        else:
            self.out.line(f"empty += {count}")
            self.out.line(f"if empty > {MAX_EMPTY}: raise ValueError")

    def messages(self, nested: type[Structure], field: Field, owner: str) -> None:
        size = nested._fixed_size
        if size and self.row is not None:
            # Inside a row the bytes of these elements are one of its values.
            octets = self.out.fresh("x")
            assert field.array_len is not None
            self.take(f"{size * field.array_len}s", octets)
            self.rows(nested, field, owner, octets)
        elif size:
            count = self.length(field)
            self.check_count(count, size)
            stop = self.local("j", f"{self.base} + {size} * {count}")
            octets = f"data[{self.base}:{stop}]"
            self.base = stop
            self.rows(nested, field, owner, octets)
        elif size == 0:
            count = self.length(field) if self.row is None else str(field.array_len)
            weight = nested._hollow + 1
            self.check_count(count if weight == 1 else f"{weight} * {count}", 0)
            self.out.line("# no bytes on the wire, and no values that could differ")
            self.store(owner, field, f"[{self.empty(nested)} for _ in range({count})]")
        else:
            self.varying(nested, field, owner)

    def empty(self, nested: type[Structure]) -> str:
        return f"{self.out.bind('C', nested, nested)}()"

    def rows(self, nested: type[Structure], field: Field, owner: str, octets: str) -> None:
        """Elements of one fixed size, which are unpacked row by row."""
        items = self.out.fresh("l")
        row = self.out.fresh("r")
        element = self.out.fresh("e")
        inner = Decoder(self.out, self.mode, "", alone=self.alone, row=row)
        mark = len(self.out.lines)
        self.out.depth += 1
        self.out.line(f"{element} = {self.out.new(nested)}")
        inner.message(nested, element)
        key, packer = self.out.structure(inner.codes)
        inner.flush()
        self.out.line(f"{items}.append({element})")
        self.out.depth -= 1
        body = self.out.lines[mark:]
        del self.out.lines[mark:]
        rows = self.out.bind("r", packer.iter_unpack, ("rows", key))
        head = [f"{items} = []", f"for {row} in {rows}({octets}):"]
        self._emit_or_defer(head, body, owner, field, items)

    def _emit_or_defer(
        self, head: list[str], body: list[str], owner: str, field: Field, items: str
    ) -> None:
        pad = "    " * self.out.depth
        if not self.deferred:
            for text in head:
                self.out.line(text)
            self.out.lines += body
            self.store(owner, field, items)
        else:
            # The bytes are known only when the row around them is unpacked.
            self.after += head
            self.after += [text.removeprefix(pad) for text in body]
            self.assign_after(owner, field, items)

    def varying(self, nested: type[Structure], field: Field, owner: str) -> None:
        """Elements of any size, which are read one after the other."""
        count = self.length(field)
        self.check_count(count, nested._min_size)
        items = self.local("l", "[]")
        position = self.local("k", self.base)
        element = self.out.fresh("e")
        self.out.line(f"for _ in range({count}):")
        self.out.depth += 1
        self.out.line(f"{element} = {self.out.new(nested)}")
        inner = Decoder(self.out, self.mode, position, alone=self.alone)
        inner.message(nested, element)
        inner.flush()
        self.out.line(f"{position} = {inner.base}")
        self.out.line(f"{items}.append({element})")
        self.out.depth -= 1
        self.base = position
        self.store(owner, field, items)


def write_decoder(out: Source, cls: type[Structure], mode: Mode, base: str, *, exact: bool) -> str:
    """Write the body of a decoder to ``out``; gives the name of the message it makes.

    The message begins at ``base``. With ``exact`` it has to be all of ``data``, and bytes
    that are left over are refused.
    """
    mark = len(out.lines)
    decoder = Decoder(out, mode, base, alone=exact)
    root = decoder.local("m", out.new(cls))
    decoder.message(cls, root)
    decoder.flush()
    if exact:
        out.line(f"if {decoder.base} != end: raise ValueError")
    elif decoder.bounded != decoder.base:
        out.line(f"if {decoder.base} > end: raise ValueError")
    if any("empty +=" in line for line in out.lines[mark:]):
        out.lines.insert(mark, "    " * out.depth + "empty = 0")
    return root
