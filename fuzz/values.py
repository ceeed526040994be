"""Values of every kind in the fields of messages: octets, or an error with the field's path.

An input is a byte that picks the type and then choices: what each field holds. Values that
fit come with the octets that they should become; of those that do not fit, the first in
the order of the fields is the one that the error has to name. Of a third kind, objects
that are out to make trouble, no more is asked than that it is one or the other.
"""

from __future__ import annotations

import re
import struct
from array import array
from collections.abc import Callable, Iterator, Sequence
from decimal import Decimal
from fractions import Fraction
from random import Random
from typing import Any

from aioros1.errors import DeserializationError, SerializationError
from aioros1.idl import Message
from aioros1.idl.builtin_types import BUILTINS, Builtin
from aioros1.idl.spec import Field
from aioros1.time import Duration, Time
from fuzz.catalogue import CLASSES, store
from fuzz.odd import WILD, Index, Items, Stamp, Text, np

__all__ = ["check", "seeds"]

TOKENS: list[bytes] = []
MAX_LEN = 512
SHARE = 15

_PATH = re.compile(r"([^\W\d]\w*)((?:\[\d+\]|\.\w+)*): ")
_SIZES = (0, 1, 1, 2, 3, 5)
_U32 = struct.Struct("<I").pack


class Choices:
    """An input read as choices; when it is used up, each is the first there is."""

    def __init__(self, data: bytes) -> None:
        self.data = data
        self.pos = 0

    def below(self, limit: int) -> int:
        self.pos += 1
        return self.data[self.pos - 1] % limit if self.pos <= len(self.data) else 0

    def pick(self, options: Sequence[Any]) -> Any:
        return options[self.below(len(options))]

    def octets(self, size: int) -> bytes:
        part = self.data[self.pos : self.pos + size]
        self.pos += size
        return part.ljust(size, b"\0")


# -- filling a message ----------------------------------------------------------------

_FOREIGN = {cls._type: store().load_msg(cls._type) for cls in CLASSES}


class Filled:
    """What is known of the octets of what was filled in.

    ``wrong`` is the path of the first value that does not fit; ``sure`` is False once
    there is a value of which nobody says what should become of it.
    """

    def __init__(self, choices: Choices) -> None:
        self.choices = choices
        self.parts: list[bytes] = []
        self.wrong: str | None = None
        self.sure = True

    def message(self, cls: type[Message], path: str = "") -> Any:
        # A class of the same definition from another store is as good.
        made = cls if self.choices.below(16) != 15 else _FOREIGN.get(cls._type, cls)
        message = made()
        for field in cls._fields:
            place = f"{path}.{field.name}" if path else field.name
            setattr(message, field.name, self.field(cls, field, place))
        return message

    def field(self, cls: type[Message], field: Field, path: str) -> Any:
        mode = self.choices.below(32)
        builtin = BUILTINS.get(field.base_type)
        nested = cls._nested.get(field.base_type)
        if mode == 31:
            self.sure = False
            return self.choices.pick(WILD)()
        if mode == 30:
            return self.spoilt(field, builtin, path)
        if not field.is_array:
            return self.one(builtin, nested, path)
        return self.array(field, builtin, nested, path)

    def blame(self, path: str) -> None:
        if self.wrong is None and self.sure:
            self.wrong = path

    def one(self, builtin: Builtin | None, nested: type[Message] | None, path: str) -> Any:
        if builtin is None:
            assert nested is not None
            return self.message(nested, path)
        value, octets = good(builtin, self.choices)
        self.parts.append(octets)
        return value

    def spoilt(self, field: Field, builtin: Builtin | None, path: str) -> Any:
        """A value that cannot be taken for one of the field's type."""
        value = self.choices.pick(_bad(field, builtin))
        self.blame(path)
        return value

    def array(
        self, field: Field, builtin: Builtin | None, nested: type[Message] | None, path: str
    ) -> Any:
        count = field.array_len if field.array_len is not None else self.choices.pick(_SIZES)
        if field.array_len is None:
            self.parts.append(_U32(count))
        else:
            off = self.choices.below(64)
            if off >= 62:
                # One too few or too many: found only when all there are have been seen.
                count += 1 if off == 63 or not count else -1
        octets = builtin is not None and builtin.kind in ("int", "float")
        if octets and self.choices.below(2):
            assert builtin is not None
            raw = self.choices.octets(builtin.size * count)
            if builtin.name == "float32":
                # No signalling NaN: as a double it would be a quiet one.
                raw = struct.pack(f"<{count}f", *struct.unpack(f"<{count}f", raw))
            value = self.choices.pick(_BUFFERS)(builtin, raw)
            self.parts.append(raw)
        else:
            items = []
            for index in range(count):
                place = f"{path}[{index}]"
                if builtin is not None and self.choices.below(64) == 63:
                    items.append(self.choices.pick(_BAD[builtin.name]))
                    self.blame(place)
                else:
                    items.append(self.one(builtin, nested, place))
            value = self.choices.pick((list, list, tuple, Items))(items)
        if field.array_len not in (None, count):
            self.blame(path)
        return value


def good(builtin: Builtin, choices: Choices) -> tuple[Any, bytes]:
    """A value that fits, in one of the forms that are taken, and its octets."""
    kind = builtin.kind
    raw = choices.octets(builtin.size)
    if kind == "int":
        (number,) = struct.unpack(f"<{builtin.code}", raw)
        forms: list[Callable[[Any], Any]] = [int, int, Index]
        if np is not None:
            forms.append(np.int64 if number < 1 << 63 else np.uint64)
        return choices.pick(forms)(number), raw
    if kind == "float":
        (number,) = struct.unpack(f"<{builtin.code}", raw)
        form = choices.below(6)
        if form == 1:
            number = struct.unpack("<b", raw[:1])[0]
        elif form == 2:
            number = Index(raw[0])
        elif form == 3:
            number = Fraction(raw[0], 4)
        elif form == 4 and np is not None:
            number = np.float64(number)
        elif form == 5:
            number = Decimal(raw[0])
        plain = number.number if isinstance(number, Index) else number
        return number, struct.pack(f"<{builtin.code}", plain)
    if kind == "bool":
        truth = raw[0] & 1
        forms = [bool, bool, int, Index] + ([np.bool_] if np is not None else [])
        return choices.pick(forms)(truth), bytes([truth])
    if kind == "string":
        data = choices.octets(choices.pick((0, 1, 3, 9)))
        text = data.decode("utf-8", "surrogateescape")
        forms = [str, str, Text, lambda _: data, lambda _: bytearray(data)]
        if np is not None:
            # Not with zeros at the end, which to NumPy are not there.
            forms.append(lambda text: np.str_(text) if "\0" not in text else text)
        return choices.pick(forms)(text), _U32(len(data)) + data
    secs, nsecs = struct.unpack(f"<{builtin.code}", raw)
    own = Time if kind == "time" else Duration
    return choices.pick((own._raw, own._raw, Stamp))(secs, nsecs), raw


def _as_array(builtin: Builtin, raw: bytes) -> Any:
    return array(builtin.code, raw)


def _as_bytes(builtin: Builtin, raw: bytes) -> Any:
    return raw if builtin.octets else _as_array(builtin, raw)


def _as_view(builtin: Builtin, raw: bytes) -> Any:
    return memoryview(_as_array(builtin, raw))


def _as_bytearray(builtin: Builtin, raw: bytes) -> Any:
    return bytearray(raw) if builtin.octets else _as_view(builtin, raw)


def _as_every_other(builtin: Builtin, raw: bytes) -> Any:
    doubled = array(builtin.code)
    for item in array(builtin.code, raw):
        doubled.extend((item, item))
    return memoryview(doubled)[::2]


def _as_numpy(builtin: Builtin, raw: bytes) -> Any:
    return _as_view(builtin, raw) if np is None else np.frombuffer(raw, f"<{builtin.code}")


def _as_swapped(builtin: Builtin, raw: bytes) -> Any:
    made = _as_numpy(builtin, raw)
    return made if np is None else made.astype(made.dtype.newbyteorder(">"))


_BUFFERS = (
    _as_bytes,
    _as_array,
    _as_view,
    _as_bytearray,
    _as_every_other,
    _as_numpy,
    _as_swapped,
)

_NEVER = [None, object(), 1j, {}, {1}, Time, Ellipsis]


def _bad_scalars() -> dict[str, list[Any]]:
    pools: dict[str, list[Any]] = {}
    for name, builtin in BUILTINS.items():
        if builtin.kind == "int":
            extra: list[Any] = [builtin.low - 1, builtin.high + 1, 10**30, 1.0, "1", b"1", [1]]
            extra.append(Decimal(1))
        elif builtin.kind == "float":
            extra = [
                *("1", b"1", bytearray(b"1"), memoryview(b"1"), array("B", b"1"), [1.0]),
                *(10**400, Time(1)),
                *([1e39, -1e300] if name[-1] == "2" else []),
            ]
        elif builtin.kind == "bool":
            extra = [2, -1, 10**30, "", "True", [], 1.0, b"\1"]
        elif builtin.kind == "string":
            extra = [5, 1.5, ["a"], ("a",), "\ud800", "a\udfff", array("B", b"a"), memoryview(b"a")]
        elif builtin.kind == "time":
            extra = [1.5, 1, "1", Duration(1), Time(1 << 32), Stamp(-1, 0), Stamp(0, 1 << 32)]
        else:
            extra = [1.5, 1, "1", Time(1), Duration(1 << 31), Stamp(0, -(1 << 31) - 1)]
        pools[name] = _NEVER + extra
    return pools


_BAD = _bad_scalars()
_BAD_ARRAYS = [*_NEVER, 5, "ab", "", {1: 2}, Time(1)]


def _bad(field: Field, builtin: Builtin | None) -> list[Any]:
    if not field.is_array:
        return _BAD[builtin.name] if builtin is not None else [*_NEVER, 5, "ab", [], Time(1)]
    pool = list(_BAD_ARRAYS)
    if builtin is None or builtin.kind not in ("int", "float"):
        return [*pool, b"ab", b"", bytearray(2)]
    return [*pool, array("d" if builtin.kind == "int" else "b", [1])]


# -- the check -------------------------------------------------------------------------


class _Output:
    def __init__(self) -> None:
        self.parts: list[bytes] = []

    def write(self, data: bytes) -> None:
        self.parts.append(data)


def check(data: bytes) -> None:
    if not data:
        return
    check_message(CLASSES[data[0] % len(CLASSES)], data[1:])


def check_message(cls: type[Message], data: bytes) -> None:
    """Fill in a message as ``data`` chooses, and encode it in every way."""
    filled = Filled(Choices(data))
    message: Any = cls()
    for field in cls._fields:
        setattr(message, field.name, filled.field(cls, field, field.name))
    if cls._fields and filled.choices.below(64) == 63:
        name = filled.choices.pick(cls._fields).name
        delattr(message, name)
        filled.sure, filled.wrong = False, None
    before = [getattr(message, name, None) for name in cls.__slots__]
    output = _Output()
    results = []
    for encode in (cls._encode, cls._frame, _joined_parts, lambda m: m.serialize(output)):
        try:
            results.append(encode(message))
        except SerializationError as error:
            results.append(error)
    after = [getattr(message, name, None) for name in cls.__slots__]
    assert all(a is b for a, b in zip(before, after, strict=True)), "fields changed by encoding"
    body, frame, parts, _ = results
    if isinstance(body, SerializationError):
        assert filled.wrong is not None or not filled.sure, f"refused: {body}"
        _check_error(cls, str(body), filled.wrong)
        assert [str(result) for result in results] == [str(body)] * 4
        assert output.parts == [], "half-written"
        return
    assert filled.wrong is None, f"{filled.wrong} accepted: {message!r}"
    assert output.parts == [body]
    assert frame == parts == len(body).to_bytes(4, "little") + body
    if filled.sure:
        assert body == b"".join(filled.parts), f"{message!r} is {body!r}"
    try:
        back = cls.from_bytes(body)
    except DeserializationError as error:
        raise AssertionError(f"{message!r} cannot be read: {error}") from error
    assert cls._encode(back) == body


def _joined_parts(message: Any) -> bytes:
    return b"".join(type(message)._frame_parts(message))


def _check_error(cls: type[Message], text: str, wrong: str | None) -> None:
    if wrong is not None:
        assert text.startswith(f"{wrong}: "), f"{text}, where {wrong} is wrong"
        return
    match = _PATH.match(text)
    assert match is not None, f"no path: {text}"
    fields = {field.name: field for field in cls._fields}
    assert match[1] in fields, f"no field of {cls._type}: {text}"


def seeds() -> Iterator[bytes]:
    random = Random(0)
    for number in range(len(CLASSES)):
        yield bytes([number])
        for size in (20, 100, 300):
            yield bytes([number]) + random.randbytes(size)
            # Mostly values that fit.
            yield bytes([number]) + bytes(random.randrange(30) for _ in range(size))
