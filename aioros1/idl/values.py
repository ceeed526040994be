"""What generated code calls for values that are not of the usual class.

Generated encoders handle the usual class of a field inline, and call these functions for
all others. Each returns what can be packed or joined, and raises some exception for what
does not fit. Which exception does not matter: :mod:`.check` then finds the cause.
"""

from __future__ import annotations

import struct
import sys
from array import array
from collections.abc import Callable, Sequence
from collections.abc import Set as AbstractSet
from math import inf, isinf
from typing import Any, Final

from aioros1.time import Duration, Time, raw_duration, raw_time

__all__ = [
    "as_bool",
    "as_bools",
    "as_duration",
    "as_list",
    "as_message",
    "as_numbers",
    "as_octets",
    "as_text",
    "as_text_escaped",
    "as_time",
    "collect",
    "load_array",
    "made_later",
    "number_array",
    "own_memory",
    "pack_durations",
    "pack_strings",
    "pack_strings_escaped",
    "pack_times",
    "string_packer",
    "string_reader",
]

LITTLE: Final = sys.byteorder == "little"
BULK: Final = 16384
"""Payloads of at least this many bytes get a part of their own. Copying 16 KiB takes about
half a microsecond, and so does one more buffer in a vectored write."""

_REMEMBERED: Final = 4096
"""Lists of strings of up to this many bytes are kept, to be compared with the next list."""

_unpack_length = struct.Struct("<I").unpack_from
_pack_length = struct.Struct("<I").pack
_pack_time = struct.Struct("<II").pack
_pack_duration = struct.Struct("<ii").pack
_BOOLS = b"\0\1"


def as_time(value: Any) -> Time:
    """Takes anything with integers ``secs`` and ``nsecs``, such as genpy's."""
    if isinstance(value, Duration):
        raise TypeError("a duration is not a time")
    return raw_time(value.secs.__index__(), value.nsecs.__index__())


def as_duration(value: Any) -> Duration:
    """Takes anything with integers ``secs`` and ``nsecs``, such as genpy's."""
    if isinstance(value, Time):
        raise TypeError("a time is not a duration")
    return raw_duration(value.secs.__index__(), value.nsecs.__index__())


def as_bool(value: Any) -> bool:
    """Takes True, False, 0, 1 and NumPy's booleans."""
    if type(value).__module__ == "numpy" and hasattr(value, "item"):
        value = value.item()
    if value is True or value is False:
        return bool(value)
    number = value.__index__()
    if number not in (0, 1):
        raise ValueError("neither 0 nor 1")
    return bool(number)


def as_text(value: Any) -> bytes:
    """Takes subclasses of str, and bytes, which are sent as they are."""
    if isinstance(value, str):
        return str.encode(value)  # not the method of the value, which may do anything
    if isinstance(value, (bytes, bytearray)):
        return bytes(value)
    raise TypeError("neither str nor bytes")


def as_text_escaped(value: Any) -> bytes:
    """As :func:`as_text`, for strings that were not UTF-8 when they were received."""
    if isinstance(value, str):
        return str.encode(value, "utf-8", "surrogateescape")
    return as_text(value)


def as_list(value: Any) -> Sequence[Any]:
    """Takes any sequence, such as a list, tuple, range or NumPy array, but no string."""
    if isinstance(value, (list, tuple)):
        return value
    if isinstance(value, (str, bytes, bytearray, AbstractSet, dict)):
        raise TypeError("not a list")
    if hasattr(value, "tolist"):
        value = value.tolist()
        if not isinstance(value, list):
            raise TypeError("not a list")
        return value
    if isinstance(value, Sequence):
        return list(value)
    raise TypeError("not a list")


def as_message(value: Any) -> Any:
    """Takes any message, for a type without fields: none can be missing."""
    if not hasattr(type(value), "_md5sum"):
        raise TypeError("not a message")
    return value


def as_octets(value: Any) -> bytes | bytearray | memoryview:
    """Takes the value of a ``uint8[]``: bytes-like, or a sequence of 0 to 255."""
    if isinstance(value, (bytes, bytearray)):
        return value
    if isinstance(value, (list, tuple)):
        return bytes(value)
    try:
        view = memoryview(value)
    except TypeError:
        return bytes(as_list(value))
    if view.ndim != 1 or view.format.lstrip("@=<>|") != "B":
        raise TypeError("not a one-dimensional buffer of uint8")
    return view if view.c_contiguous else view.tobytes()


def as_bools(value: Any) -> bytes:
    """The bytes of a ``bool[]``."""
    if isinstance(value, (list, tuple)):
        try:
            octets = bytes(value)
        except TypeError:
            pass
        else:
            if octets.translate(None, _BOOLS):
                raise ValueError("neither 0 nor 1")
            return octets
    return bytes([as_bool(item) for item in as_list(value)])


def pack_strings(values: Any) -> bytes:
    """The bytes of the elements of a ``string[]``."""
    parts: list[bytes] = []
    add = parts.append
    for value in values:
        text = value.encode() if value.__class__ is str else as_text(value)
        add(_pack_length(len(text)))
        add(text)
    return b"".join(parts)


def string_packer() -> Callable[[Any], bytes]:
    """Make a :func:`pack_strings` for one field, which remembers what it packed last.

    Lists of names are mostly the same from one message to the next, and comparing two
    lists of the same strings takes a tenth of the time of packing one.
    """
    # Threads share this: it is read once, and replaced as a whole.
    last: tuple[list[str], bytes] = ([], b"")

    def pack(values: Any) -> bytes:
        nonlocal last
        known, octets = last
        if values == known:
            return octets
        # A copy is packed, so that what is remembered is what was packed even if another
        # thread changes the list meanwhile.
        items = list(values)
        octets = pack_strings(items)
        # Only strings: objects of other classes may be equal and yet packed differently.
        if len(octets) <= _REMEMBERED and {str}.issuperset(map(type, items)):
            last = items, octets
        return octets

    return pack


def string_reader(escape: bool) -> Callable[[bytes, int, int, int], tuple[list[str], int]]:
    """Make a function that reads the strings of one field, and remembers what it read last.

    The function takes the data, the position, the end and the number of strings, and gives
    the list and the position behind it. It raises some exception if there is too little
    data.
    """
    # Threads share this: it is read once, and replaced as a whole.
    last: tuple[int, bytes, list[str]] = (0, b"", [])

    def read(data: bytes, pos: int, end: int, count: int) -> tuple[list[str], int]:
        nonlocal last
        number, block, known = last
        if count == number and data.startswith(block, pos, end):
            return known.copy(), pos + len(block)
        texts: list[str] = []
        add = texts.append
        start = pos
        for _ in range(count):
            (size,) = _unpack_length(data, pos)
            first = pos + 4
            pos = first + size
            if pos > end:
                raise ValueError
            if escape:
                add(data[first:pos].decode("utf-8", "surrogateescape"))
            else:
                add(data[first:pos].decode())
        if start < pos <= start + _REMEMBERED:
            last = count, data[start:pos], texts.copy()
        return texts, pos

    return read


def pack_strings_escaped(values: Any) -> bytes:
    """As :func:`pack_strings`, for strings that were not UTF-8 when they were received."""
    parts: list[bytes] = []
    for value in values:
        text = as_text_escaped(value)
        parts += (_pack_length(len(text)), text)
    return b"".join(parts)


def pack_times(values: Any) -> bytes:
    """The bytes of the elements of a ``time[]``."""
    parts = []
    for value in values:
        time = value if value.__class__ is Time else as_time(value)
        parts.append(_pack_time(time.secs, time.nsecs))
    return b"".join(parts)


def pack_durations(values: Any) -> bytes:
    """The bytes of the elements of a ``duration[]``."""
    parts = []
    for value in values:
        duration = value if value.__class__ is Duration else as_duration(value)
        parts.append(_pack_duration(duration.secs, duration.nsecs))
    return b"".join(parts)


def _shape(code: str) -> tuple[str, int]:
    """Kind and size of the items of a buffer; what a letter means depends on the platform."""
    if code in ("f", "d"):
        kind = "float"
    elif code in ("b", "h", "i", "l", "q", "n"):
        kind = "int"
    elif code in ("B", "H", "I", "L", "Q", "N"):
        kind = "unsigned"
    else:
        return "", 0
    return kind, struct.calcsize(code)


def as_numbers(code: str) -> Callable[[Any], array[Any] | memoryview]:
    """The function that makes buffers as on the wire for arrays of one numeric type.

    A buffer is little-endian, and its length is the number of elements.
    """
    shape = _shape(code)

    def convert(value: Any) -> array[Any] | memoryview:
        if isinstance(value, (list, tuple)):
            return to_wire(number_array(code, value))
        try:
            view = memoryview(value)
        except TypeError:
            return to_wire(number_array(code, as_list(value)))
        order = view.format[:1] if view.format[:1] in "@=<>!" else ""
        letter = view.format[len(order) :]
        if view.ndim != 1:
            raise TypeError("not one-dimensional")
        # `<l` has the standard size of the letter, `l` the size on this platform.
        size = struct.calcsize(order + letter) if _shape(letter)[1] else 0
        if (_shape(letter)[0], size) != shape:
            raise TypeError(f"a buffer of other items: {view.format!r}")
        swapped = order in (">", "!") if LITTLE else order == "<"
        if LITTLE and not swapped and view.c_contiguous:
            return view
        numbers: array[Any] = array(code)
        numbers.frombytes(view.tobytes())
        if swapped:
            numbers.byteswap()
        return to_wire(numbers)

    return convert


def to_wire(numbers: array[Any]) -> array[Any]:
    """Swap the bytes of a new array if the machine is not little-endian."""
    if not LITTLE:
        numbers.byteswap()
    return numbers


def load_array(code: str, octets: Any) -> array[Any]:
    """The array of the numbers in these little-endian bytes."""
    numbers: array[Any] = array(code)
    numbers.frombytes(octets)
    return to_wire(numbers)


def number_array(code: str, items: Sequence[Any]) -> array[Any]:
    """A native array of these numbers; raises some exception if one does not fit."""
    numbers: array[Any] = array(code, items)
    # array() makes infinity of what is too large for a float32; struct refuses it.
    if code == "f" and (inf in numbers or -inf in numbers):
        for item, number in zip(items, numbers, strict=True):
            if isinf(number) and not isinf(item):
                raise OverflowError("out of the range of float32")
    return numbers


def own_memory(view: memoryview) -> bytes | array[Any]:
    """A copy of a view, as a decoder that copies makes it."""
    if view.format == "B":
        return view.tobytes()
    numbers: array[Any] = array(view.format)
    numbers.frombytes(view.tobytes())
    return numbers


def collect(parts: Sequence[Any]) -> list[bytes | memoryview]:
    """The same bytes in fewer parts: small parts are joined, large ones stand alone.

    Large parts that are immutable are not copied; what could still change is copied once.
    """
    result: list[bytes | memoryview] = []
    small: list[Any] = []
    for part in parts:
        if part.__class__ is bytes:
            if len(part) < BULK:
                small.append(part)
                continue
        else:
            view = memoryview(part)
            if view.nbytes < BULK:
                small.append(part)
                continue
            # Only the memory of a bytes object never changes.
            part = view.cast("B") if view.obj.__class__ is bytes else view.tobytes()
        if small:
            result.append(b"".join(small))
            small = []
        result.append(part)
    if small:
        result.append(b"".join(small))
    return result


def made_later(make: Callable[[], Callable[..., Any]]) -> Callable[..., Any]:
    """A function that stands for what ``make`` returns, and calls ``make`` when called.

    Two threads that call it for the first time may both have it made; either is whole.
    """
    made: Callable[..., Any] | None = None

    def call(*arguments: Any) -> Any:
        nonlocal made
        function = made
        if function is None:
            made = function = make()
        return function(*arguments)

    return call
