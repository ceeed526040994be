"""Writes encoders: straight-line Python made from a message class.

The fields of a type and those of the messages inside it are flattened. Neighbours of
fixed size share one :class:`struct.Struct` (a *run*), which ends with the length of the
string or array behind it::

    def encode(m0):
        try:
            m1 = m0.header
            t2 = m1.stamp
            if t2.__class__ is not Time: t2 = as_time(t2)
            s3 = m1.frame_id
            s3 = s3.encode() if s3.__class__ is str else as_text(s3)
            n4 = len(s3)
            total = 16 + n4
            return p5(total, m1.seq, t2._secs, t2._nsecs, n4) + s3
        except Exception as exc:
            return slow(m0, exc)

Encoders do not check values, beyond what packing checks anyway. After a failure
:mod:`.check` finds the field that is to blame. :mod:`.codegen_decode` writes decoders.
"""

from __future__ import annotations

import struct
from array import array
from collections.abc import Callable
from functools import partial
from keyword import iskeyword
from typing import Any

from aioros1.idl import values
from aioros1.idl.builtin_types import BUILTINS
from aioros1.idl.spec import Field
from aioros1.idl.structure import Structure
from aioros1.time import Duration, Time

__all__ = ["Source", "encoder_source", "make_encoder"]

_TIME_HELPERS = {
    "time": ("Time", "as_time", "pack_times"),
    "duration": ("Duration", "as_duration", "pack_durations"),
}


class Source:
    """The lines of a function that is being written, and the globals it will need."""

    def __init__(self, function: str, parameters: str) -> None:
        self.lines: list[str] = [f"def {function}({parameters}):"]
        self.depth = 1
        self.function = function
        self.globals: dict[str, Any] = {
            "Duration": Duration,
            "Time": Time,
            "array": array,
            "join": b"".join,
            "struct_error": struct.error,
        }
        self._bound: dict[Any, str] = {}
        self._count = 0

    def line(self, text: str) -> None:
        self.lines.append("    " * self.depth + text)

    def fresh(self, prefix: str) -> str:
        """A local name that is not used yet."""
        self._count += 1
        return f"{prefix}{self._count}"

    def bind(self, prefix: str, value: Any, key: Any) -> str:
        """The global name of an object; the same name for the same key."""
        if key not in self._bound:
            self._bound[key] = name = self.fresh(prefix)
            self.globals[name] = value
        return self._bound[key]

    def new(self, cls: type) -> str:
        """The expression that makes an instance of a class without its constructor.

        Calling a partial object is quicker than the same call written out, by a tenth to
        a fifth.
        """
        return self.bind("new", partial(object.__new__, cls), ("new", cls)) + "()"

    def use(self, name: str) -> str:
        """Make a function of :mod:`.values` known to the code; gives its name."""
        self.globals[name] = getattr(values, name)
        return name

    def structure(self, codes: list[str]) -> tuple[str, struct.Struct]:
        packer = struct.Struct("<" + "".join(codes))
        return packer.format, packer

    def compile(self, type_name: str) -> Callable[..., Any]:
        code = compile("\n".join(self.lines), f"<codec of {type_name}>", "exec")
        exec(code, self.globals)
        function: Callable[..., Any] = self.globals[self.function]
        return function


def attribute(owner: str, name: str) -> str:
    """The expression that reads a field; its name may be a keyword of Python."""
    return f"getattr({owner}, {name!r})" if iskeyword(name) else f"{owner}.{name}"


class _Encoder:
    """Walks a class and writes the body of its encoder.

    ``parts`` are the expressions for the bytes, in order. ``constant`` and ``sizes`` add
    up to the length. ``codes`` and ``arguments`` are the current run.
    """

    def __init__(self, out: Source, *, escape: bool) -> None:
        self.out = out
        self.escape = escape
        self.parts: list[str] = []
        self.constant = 0
        self.sizes: list[str] = []
        self.codes: list[str] = []
        self.arguments: list[str] = []

    # -- runs -------------------------------------------------------------------------

    def put(self, code: str, *arguments: str) -> None:
        self.codes.append(code)
        self.arguments += arguments

    def flush(self) -> None:
        if not self.codes:
            return
        key, packer = self.out.structure(self.codes)
        self.constant += packer.size
        if packer.size:
            name = self.out.bind("p", packer.pack, ("pack", key))
            self.parts.append(f"{name}({', '.join(self.arguments)})")
        self.codes, self.arguments = [], []

    def payload(self, name: str, size: str) -> None:
        """Add bytes whose length is not known beforehand."""
        self.flush()
        self.parts.append(name)
        self.sizes.append(size)

    # -- fields -----------------------------------------------------------------------

    def message(self, cls: type[Structure], name: str) -> None:
        """All fields of the message in the local variable ``name``."""
        for field in cls._fields:
            value = attribute(name, field.name)
            if field.is_array:
                self.array(cls, field, value)
            elif field.is_builtin:
                self.scalar(field, value)
            else:
                nested = cls._nested[field.base_type]
                inner = self.local("m", value)
                if not nested._fields:
                    expected = self.out.bind("C", nested, nested)
                    self.out.line(
                        f"if {inner}.__class__ is not {expected}: "
                        f"{self.out.use('as_message')}({inner})"
                    )
                self.message(nested, inner)

    def local(self, prefix: str, value: str) -> str:
        name = self.out.fresh(prefix)
        self.out.line(f"{name} = {value}")
        return name

    def scalar(self, field: Field, value: str) -> None:
        builtin = BUILTINS[field.base_type]
        if builtin.kind in ("int", "float"):
            self.put(builtin.code, value)
        elif builtin.kind == "bool":
            name = self.local("b", value)
            # struct would take anything that has a truth value.
            self.out.line(
                f"if {name} is not True and {name} is not False: "
                f"{name} = {self.out.use('as_bool')}({name})"
            )
            self.put("?", name)
        elif builtin.kind == "string":
            name = self.local("s", value)
            if self.escape:
                self.out.line(f"{name} = {self.out.use('as_text_escaped')}({name})")
            else:
                self.out.line(
                    f"{name} = {name}.encode() if {name}.__class__ is str "
                    f"else {self.out.use('as_text')}({name})"
                )
            size = self.local("n", f"len({name})")
            self.put("I", size)
            self.payload(name, size)
        else:
            class_, convert, _ = _TIME_HELPERS[builtin.kind]
            name = self.local("t", value)
            self.out.line(
                f"if {name}.__class__ is not {class_}: {name} = {self.out.use(convert)}({name})"
            )
            self.put(builtin.code, f"{name}._secs", f"{name}._nsecs")

    def array(self, cls: type[Structure], field: Field, value: str) -> None:
        name = self.local("v", value)
        builtin = BUILTINS.get(field.base_type)
        if builtin is None:
            self.out.line(
                f"if {name}.__class__ is not list: {name} = {self.out.use('as_list')}({name})"
            )
            self.messages(cls._nested[field.base_type], field, name)
        elif builtin.octets:
            self.out.line(
                f"if {name}.__class__ is not bytes: {name} = {self.out.use('as_octets')}({name})"
            )
            self.octets(field, name, len_name=name, item_size=1)
        elif builtin.kind in ("int", "float"):
            self.numbers(field, name, builtin.code, builtin.size)
        elif builtin.kind == "bool":
            self.out.line(f"{name} = {self.out.use('as_bools')}({name})")
            self.octets(field, name, len_name=name, item_size=1)
        else:
            self.out.line(
                f"if {name}.__class__ is not list: {name} = {self.out.use('as_list')}({name})"
            )
            if builtin.kind != "string":
                helper = self.out.use(_TIME_HELPERS[builtin.kind][2])
            elif self.escape:
                helper = self.out.use("pack_strings_escaped")
            else:
                helper = self.out.bind("strings", values.string_packer(), object())
            octets = self.local("o", f"{helper}({name})")
            self.blob(field, name, octets, 8 if builtin.kind != "string" else None)

    def numbers(self, field: Field, name: str, code: str, size: int) -> None:
        convert = self.out.bind("as_numbers", values.as_numbers(code), ("numbers", code))
        if values.LITTLE:
            self.out.line(
                f"if {name}.__class__ is not array or {name}.typecode != {code!r}: "
                f"{name} = {convert}({name})"
            )
        else:
            self.out.line(f"{name} = {convert}({name})")
        self.octets(field, name, len_name=name, item_size=size)

    def octets(self, field: Field, name: str, *, len_name: str, item_size: int) -> None:
        """An array that is in a buffer: behind its count, or within the run if it is fixed."""
        if field.array_len is None:
            count = self.local("n", f"len({len_name})")
            self.put("I", count)
            self.payload(name, count if item_size == 1 else f"{item_size} * {count}")
            return
        self.out.line(f"if len({len_name}) != {field.array_len}: raise ValueError")
        # struct wants bytes. Within the run they need no part of their own.
        as_bytes = f"{name}.tobytes()" if item_size > 1 else f"bytes({name})"
        self.put(f"{field.array_len * item_size}s", as_bytes)

    def blob(self, field: Field, items: str, octets: str, item_size: int | None) -> None:
        """An array whose elements are packed already; ``octets`` names their bytes."""
        if field.array_len is None:
            self.put("I", f"len({items})")
        else:
            self.out.line(f"if len({items}) != {field.array_len}: raise ValueError")
            if item_size is not None:
                self.put(f"{field.array_len * item_size}s", octets)
                return
        self.payload(octets, f"len({octets})")

    def messages(self, nested: type[Structure], field: Field, items: str) -> None:
        """An array of messages: a loop whose results are joined."""
        element = self.out.fresh("e")
        inner = _Encoder(self.out, escape=self.escape)
        packed = self.out.fresh("l")
        mark = len(self.out.lines)
        self.out.depth += 1
        inner.message(nested, element)
        inner.flush()
        self.out.depth -= 1
        body = self.out.lines[mark:]
        del self.out.lines[mark:]
        octets = self.out.fresh("o")
        if not body and len(inner.parts) == 1:
            # Only fields of fixed size, all in the element itself: an expression is enough.
            self.out.line(f"{octets} = join([{inner.parts[0]} for {element} in {items}])")
        else:
            if not nested._fields:
                expected = self.out.bind("C", nested, nested)
                body.append(
                    "    " * (self.out.depth + 1) + f"if {element}.__class__ is not {expected}: "
                    f"{self.out.use('as_message')}({element})"
                )
            self.out.line(f"{packed} = []")
            self.out.line(f"for {element} in {items}:")
            self.out.lines += body
            self.out.depth += 1
            if len(inner.parts) == 1:
                self.out.line(f"{packed}.append({inner.parts[0]})")
            elif inner.parts:
                self.out.line(f"{packed} += ({', '.join(inner.parts)})")
            self.out.depth -= 1
            self.out.line(f"{octets} = join({packed})")
        self.blob(field, items, octets, nested._fixed_size)


def encoder_source(
    cls: type[Structure], *, frame: bool = False, split: bool = False, escape: bool = False
) -> Source:
    """The source of an encoder.

    ``frame`` puts the length in front. ``split`` returns parts instead of one bytes
    object. ``escape`` is for strings with surrogates; if that fails, nothing else is tried.
    """
    out = Source("encode", "m0")
    encoder = _Encoder(out, escape=escape)
    if not escape:
        out.line("try:")
        out.depth += 1
    if frame:
        encoder.put("I", "total")
    encoder.message(cls, "m0")
    encoder.flush()
    if frame:
        # A long chain of additions is nested too deep for the compiler.
        sizes = encoder.sizes
        total = " + ".join(sizes) if len(sizes) <= 50 else f"sum(({', '.join(sizes)}))"
        out.line(f"total = {encoder.constant - 4}" + (f" + {total}" if total else ""))
    if split:
        parts = "".join(f"{part}, " for part in encoder.parts)
        out.globals["BULK"] = values.BULK
        out.line(f"if total < BULK: return [join(({parts}))]  # nothing in it is large")
        out.line(f"return {out.use('collect')}(({parts}))")
    elif not encoder.parts:
        out.line("return b''")
    elif len(encoder.parts) == 1:
        out.line(f"return {encoder.parts[0]}")
    elif len(encoder.parts) == 2 and encoder.parts[1].startswith("s"):
        # The string is bytes by now. This is quicker than join: for std_msgs/String by a third.
        out.line(f"return {encoder.parts[0]} + {encoder.parts[1]}")
    else:
        out.line(f"return join(({', '.join(encoder.parts)}))")
    if not escape:
        out.depth -= 1
        out.line("except Exception as exc:")
        out.depth += 1
        out.line("return slow(m0, exc)")
    return out


def make_encoder(
    cls: type[Structure],
    slow: Callable[[Any, Exception], Any] | None = None,
    *,
    frame: bool = False,
    split: bool = False,
) -> Callable[[Any], Any]:
    """Compile an encoder; when it fails, it returns what ``slow`` returns.

    Without ``slow`` you get the encoder that takes strings with surrogates; it raises.
    """
    source = encoder_source(cls, frame=frame, split=split, escape=slow is None)
    source.globals["slow"] = slow
    return source.compile(cls._type)
