"""Values of messages in a form that is neither genpy's nor ours, made at random or shown.

A message is a dict; an integer, a boolean and a string are themselves; a float is its
hexadecimal text, or the bits of a NaN; octets are hexadecimal, too; a time has ``secs``
and ``nsecs``. All of this goes through JSON unharmed. Both sides run this module, each
with its own classes: ``class_of`` gives the class of a type by its name.
"""

import math
import random
import struct

BITS = {
    "int8": -8, "byte": -8, "uint8": 8, "char": 8, "int16": -16, "uint16": 16,
    "int32": -32, "uint32": 32, "int64": -64, "uint64": 64,
}  # fmt: skip
FLOATS = {"float32": "<f", "float64": "<d"}
OCTETS = ("uint8", "char")

# In each of the two sizes: denormals, the limits, quiet NaNs of either sign with a
# payload. genpy's struct turns a signalling NaN of 32 bits into a quiet one.
ODD_FLOATS = {
    "float32": [
        *(0.0, -0.0, math.inf, -math.inf, 0.1),
        *(0x00000001, 0x807FFFFF, 0x00800000, 0x7F7FFFFF, 0xFF7FFFFF),
        *(0x7FC00000, 0xFFC00000, 0x7FC12345, 0xFFFFFFFF),
    ],
    "float64": [
        *(0.0, -0.0, math.inf, -math.inf, 0.1, math.pi),
        *(1, 0x800FFFFFFFFFFFFF, 0x0010000000000000, 0x7FEFFFFFFFFFFFFF, 0xFFEFFFFFFFFFFFFF),
        *(0x7FF8000000000000, 0xFFF8000000000000, 0x7FF8123456789ABC, 0xFFFFFFFFFFFFFFFF),
    ],
}
STRINGS = [
    "",
    "base_link",
    "gr\xfc\xdfe \u4e16\u754c \U0001f916",
    "a\0b\x7f\x85\u2028\ufeff",
    "'\"\\\r\n\t #: - {}",
    "x" * 5000,
]


def parts(type_):
    """``(base, is_array, length)`` of the type of a field."""
    base, bracket, length = type_.partition("[")
    return base, bool(bracket), int(length[:-1]) if len(length) > 1 else None


# -- at random -------------------------------------------------------------------------


def random_message(class_of, type_, seed):
    """A neutral message; a seed begins with its style: ``low``, ``high``, ``odd`` or ``random``."""
    return _random_message(class_of, type_, random.Random(f"{type_} {seed}"), seed.split()[0], 0)


def _random_message(class_of, type_, dice, style, depth):
    cls = class_of(type_)
    return {
        name: _random_field(class_of, slot_type, dice, style, depth)
        for name, slot_type in zip(cls.__slots__, cls._slot_types, strict=True)
    }


def _random_field(class_of, type_, dice, style, depth):
    base, is_array, length = parts(type_)
    if not is_array:
        return _random_one(class_of, base, dice, style, depth)
    if length is None:
        # Arrays of messages inside of arrays of messages multiply.
        few = depth > 1 and "/" in base
        length = {"low": 0, "high": 1, "odd": 2 if few else 3}.get(
            style, dice.choice((0, 1) if few else (0, 1, 2, 5))
        )
        if style == "high" and not depth and "/" not in base:
            length = 300
    if base in OCTETS:
        return bytes(dice.randrange(256) for _ in range(length)).hex()
    return [_random_one(class_of, base, dice, style, depth + 1) for _ in range(length)]


def _random_one(class_of, base, dice, style, depth):
    if base in BITS:
        bits = BITS[base]
        low, high = (0, (1 << bits) - 1) if bits > 0 else (-(1 << -bits - 1), (1 << -bits - 1) - 1)
        return {"low": low, "high": high}.get(
            style, dice.choice((low, high, 0, 1, _within(dice, low, high)))
        )
    if base in FLOATS:
        return _random_float(base, dice, style)
    if base == "bool":
        return dice.random() < 0.5
    if base == "string":
        text = "".join(
            chr(dice.choice((dice.randrange(0x80), dice.randrange(0xD800)))) for _ in range(7)
        )
        return {"low": "", "odd": dice.choice(STRINGS)}.get(
            style, dice.choice([text, *STRINGS[:-1]])
        )
    if base in ("time", "duration"):
        low, high = (0, (1 << 32) - 1) if base == "time" else (-(1 << 31), (1 << 31) - 1)
        secs = {"low": low, "high": high}.get(style, _within(dice, low, high))
        nsecs = {"low": 0, "high": 999_999_999}.get(style, dice.randrange(10**9))
        return {"secs": secs, "nsecs": nsecs}
    return _random_message(class_of, base, dice, style, depth)


def _within(dice, low, high):
    return dice.randint(low, high)


def _random_float(base, dice, style):
    size, letters = struct.calcsize(FLOATS[base]), {4: "<I", 8: "<Q"}
    value = dice.choice(ODD_FLOATS[base])
    if style == "random" and dice.random() < 0.5:
        value = dice.getrandbits(8 * size)
        if value & 0x7F800000 == 0x7F800000:
            value |= 0x00400000  # no signalling NaN, see above
    if isinstance(value, int):
        (value,) = struct.unpack(FLOATS[base], struct.pack(letters[size], value))
    elif base == "float32":
        (value,) = struct.unpack("<f", struct.pack("<f", value))
    return show_float(value)


# -- to and from messages --------------------------------------------------------------


def show_float(value):
    return value.hex() if value == value else "nan " + struct.pack(">d", value).hex()


def read_float(text):
    if text.startswith("nan "):
        return struct.unpack(">d", bytes.fromhex(text[4:]))[0]
    return float.fromhex(text)


def show(message, type_=None):
    """A message in neutral form; what is of an unexpected class says so in place of a value."""
    if not hasattr(message, "_slot_types"):
        return f"<{type(message).__name__} in place of a {type_}>"
    return {
        name: _show_field(getattr(message, name), slot_type)
        for name, slot_type in zip(message.__slots__, message._slot_types, strict=True)
    }


def _show_field(value, type_):
    base, is_array, _ = parts(type_)
    if not is_array:
        return _show_one(value, base)
    if base in OCTETS:
        return value.hex() if isinstance(value, bytes) else f"<{type(value).__name__}>"
    return [_show_one(item, base) for item in value]


def _show_one(value, base):
    if base in ("time", "duration"):
        if base != type(value).__name__.lower():
            return f"<{type(value).__name__} in place of a {base}>"
        return {"secs": value.secs, "nsecs": value.nsecs}
    kind = (
        int
        if base in BITS
        else float
        if base in FLOATS
        else {"bool": bool, "string": str}.get(base)
    )
    if kind is None:
        return show(value, base)
    if type(value) is not kind:
        return f"<{type(value).__name__} {value!r}>"
    return show_float(value) if kind is float else value


def build(class_of, type_, neutral):
    """The message of a neutral one; ``class_of`` knows ``time`` and ``duration``, too."""
    cls = class_of(type_)
    fields = zip(cls.__slots__, cls._slot_types, strict=True)
    return cls(*(_build_field(class_of, slot_type, neutral[name]) for name, slot_type in fields))


def _build_field(class_of, type_, neutral):
    base, is_array, _ = parts(type_)
    if not is_array:
        return _build_one(class_of, base, neutral)
    if base in OCTETS:
        return bytes.fromhex(neutral)
    return [_build_one(class_of, base, item) for item in neutral]


def _build_one(class_of, base, neutral):
    if base in FLOATS:
        return read_float(neutral)
    if base in ("time", "duration"):
        return class_of(base)(neutral["secs"], neutral["nsecs"])
    return build(class_of, base, neutral) if "/" in base else neutral


def difference(first, second, path=""):
    """Path and values of the first difference of two neutral values; empty if there is none."""
    if isinstance(first, dict) and isinstance(second, dict) and list(first) == list(second):
        pairs = [(f"{path}.{key}" if path else key, first[key], second[key]) for key in first]
    elif isinstance(first, list) and isinstance(second, list) and len(first) == len(second):
        pairs = [(f"{path}[{i}]", a, b) for i, (a, b) in enumerate(zip(first, second, strict=True))]
    else:
        same = type(first) is type(second) and first == second
        return "" if same else f"{path or 'the message'}: {first!r:.300} != {second!r:.300}"
    return next(filter(None, (difference(a, b, place) for place, a, b in pairs)), "")
