"""Converts messages to and from dicts, other classes of the same type, and NumPy arrays."""

from __future__ import annotations

import re
import struct
import sys
from array import array
from base64 import b64decode, b64encode
from collections.abc import Mapping, Sequence
from math import inf, isfinite, nan
from typing import Any, NoReturn, TypeVar

from aioros1._public import public
from aioros1.errors import SerializationError
from aioros1.idl import values
from aioros1.idl.builtin_types import BUILTINS, Builtin
from aioros1.idl.check import describe
from aioros1.idl.spec import Field
from aioros1.idl.structure import Structure
from aioros1.time import Duration, Time, raw_duration, raw_time

__all__ = ["arrays_to_numpy", "convert", "from_dict", "to_dict", "values_equal"]

_M = TypeVar("_M", bound=Structure)

_SECONDS: dict[str, type[Time] | type[Duration]] = {"time": Time, "duration": Duration}


@public("aioros1.idl")
def convert(cls: type[_M], value: Any) -> Any:
    """Make of a value what can be encoded as ``cls``.

    An instance of ``cls`` is returned as it is, and so is one of another class with the
    same MD5 sum, such as genpy's. A mapping is read as :meth:`Message.from_dict` does.
    Raises :class:`SerializationError` for anything else.
    """
    kind = value.__class__
    if kind is cls or getattr(kind, "_md5sum", None) == cls._md5sum:
        return value
    if isinstance(value, Mapping):
        return from_dict(cls, value)
    if isinstance(value, cls):
        return value
    other = getattr(kind, "_type", None)
    if isinstance(other, str):
        what = f"a {other}"
        if other == cls._type:
            what += f" of another definition (MD5 sum {getattr(kind, '_md5sum', '?')})"
    else:
        what = f"{describe(value)}: {_how_to_give(cls, value)}"
    raise SerializationError(f"expected a {cls._type}, got {what}")


def _how_to_give(cls: type[Structure], value: Any) -> str:
    """What to write in place of a value that is no message."""
    if isinstance(value, type):
        return "make a message of the class first"
    if hasattr(value, "__await__"):
        return "await it first"
    names = [field.name for field in cls._fields]
    if not names:
        return "it has no fields, give nothing"
    if len(names) == 1:
        return f"give its field by name, as in {names[0]}={describe(value)}"
    return f"give its fields by name, as in {', '.join(f'{name}=...' for name in names)}"


# -- to dicts ------------------------------------------------------------------------


@public("aioros1.idl")
def to_dict(message: Any, *, json: bool = False) -> dict[str, Any]:
    """:meth:`Message.to_dict`, for genpy's messages too."""
    return {
        name: _plain_field(getattr(message, name), type_, json)
        for name, type_ in zip(message.__slots__, message._slot_types, strict=True)
    }


def _plain_field(value: Any, type_: str, json: bool) -> Any:
    base, bracket, _ = type_.partition("[")
    builtin = BUILTINS.get(base)
    if not bracket:
        return _plain(value, builtin, json)
    try:
        if builtin is not None and builtin.octets:
            octets = bytes(values.as_octets(value))
            return b64encode(octets).decode() if json else octets
        if builtin is not None and builtin.kind in ("int", "float"):
            # Buffers of the other byte order have no tolist(), or one that fails.
            if not isinstance(value, (list, tuple)):
                wire = memoryview(values.as_numbers(builtin.code)(value))
                numbers = values.load_array(builtin.code, wire.tobytes()).tolist()
                finite = not json or builtin.kind == "int"
                return numbers if finite else [_float_to_json(number) for number in numbers]
        else:
            value = values.as_list(value)
    except Exception:
        # Left as it is: the encoder finds and names what does not fit.
        return value
    return [_plain(item, builtin, json) for item in value]


def _plain(value: Any, builtin: Builtin | None, json: bool) -> Any:
    """One value as an instance of a built-in class: YAML does not know subclasses."""
    kind = type(value)
    if kind is float:
        return _float_to_json(value) if json else value
    if kind is str or kind is int or kind is bool:
        return value
    if builtin is None:
        return to_dict(value, json=json) if hasattr(kind, "_slot_types") else value
    if builtin.kind in _SECONDS:
        return {"secs": value.secs, "nsecs": value.nsecs} if hasattr(value, "nsecs") else value
    if isinstance(value, str):
        return str.__str__(value)
    if isinstance(value, (bytes, bytearray)):
        return value.decode("utf-8", "surrogateescape")
    if hasattr(kind, "tolist"):
        return _plain(value.tolist(), builtin, json)
    if hasattr(kind, "__index__"):
        return value.__index__()
    return _plain(float(value), builtin, json) if hasattr(kind, "__float__") else value


# JSON has no such numbers; protobuf gives them the same names.
_NON_FINITE = {"NaN": nan, "Infinity": inf, "-Infinity": -inf}
_NAN_BITS = re.compile(r"NaN:([0-9a-f]{16})\Z")
_USUAL_NAN = struct.pack(">d", nan)


def _float_to_json(value: float) -> float | str:
    if isfinite(value):
        return value
    if value == value:
        return "Infinity" if value > 0 else "-Infinity"
    bits = struct.pack(">d", value)
    return "NaN" if bits == _USUAL_NAN else f"NaN:{bits.hex()}"


def _float_from_json(text: str) -> float:
    match = _NAN_BITS.match(text)
    if match is None:
        return _NON_FINITE[text]
    (value,) = struct.unpack(">d", bytes.fromhex(match[1]))
    if value == value:
        raise ValueError("not the bits of a NaN")
    return float(value)


# -- from dicts ----------------------------------------------------------------------


@public("aioros1.idl")
def from_dict(cls: type[_M], source: Mapping[str, Any], path: str = "") -> _M:
    """:meth:`Message.from_dict`; ``path`` is put before the names in errors."""
    if not isinstance(source, Mapping):
        raise SerializationError(f"{path or cls._type}: expected a mapping, got {describe(source)}")
    fields = {field.name: field for field in cls._fields}
    changes = {}
    for name, value in source.items():
        place = f"{path}.{name}" if path else str(name)
        if name not in fields:
            known = ", ".join(fields) or "none"
            raise SerializationError(f"{place}: not a field of {cls._type}; its fields: {known}")
        changes[name] = _from_plain(cls, fields[name], value, place)
    return cls(**changes)


def _from_plain(cls: type[Structure], field: Field, value: Any, path: str) -> Any:
    if not field.is_array:
        return _item(cls, field, value, path)
    builtin = BUILTINS.get(field.base_type)
    if builtin is not None and builtin.octets and isinstance(value, str):
        try:
            return b64decode(value, validate=True)
        except ValueError as exc:
            _wrong(path, f"{field.type} in base64", value, f" ({exc})")
    if builtin is not None and builtin.kind in ("int", "float"):
        # A buffer stays as it is: the encoder checks it.
        return _numbers(cls, field, value, path) if isinstance(value, (list, tuple)) else value
    try:
        items = values.as_list(value)
    except TypeError:
        _wrong(path, field.type, value)
    return [_item(cls, field, item, f"{path}[{index}]") for index, item in enumerate(items)]


def _numbers(
    cls: type[Structure], field: Field, items: Sequence[Any], path: str
) -> bytes | array[Any]:
    builtin = BUILTINS[field.base_type]

    def numbers(items: Sequence[Any]) -> bytes | array[Any]:
        return bytes(items) if builtin.octets else values.number_array(builtin.code, items)

    if id(_yaml_nan()) not in map(id, items):
        try:
            return numbers(items)
        except Exception:
            # There are strings for numbers, as in JSON, or there is an error to locate.
            pass
    items = [_item(cls, field, item, f"{path}[{i}]") for i, item in enumerate(items)]
    for index, item in enumerate(items):
        try:
            numbers([item])
        except Exception as exc:
            _wrong(f"{path}[{index}]", field.base_type, item, f" ({exc})")
    return numbers(items)


def _item(cls: type[Structure], field: Field, value: Any, path: str) -> Any:
    builtin = BUILTINS.get(field.base_type)
    if builtin is None:
        if isinstance(value, Mapping):
            return from_dict(cls._nested[field.base_type], value, path)
        return value
    try:
        if builtin.kind == "float":
            if isinstance(value, str):
                return _float_from_json(value)
            return nan if value is _yaml_nan() else value
        kind = _SECONDS.get(builtin.kind)
        if kind is None:
            return value
        if isinstance(value, Mapping):
            if not value.keys() <= {"secs", "nsecs"}:
                raise ValueError
            # As they stand: what a peer sent need not be normalized.
            secs, nsecs = value.get("secs", 0), value.get("nsecs", 0)
            raw = raw_time if kind is Time else raw_duration
            return raw(secs.__index__(), nsecs.__index__())
        if isinstance(value, (int, float)):
            return kind(value)
    except (AttributeError, LookupError, ValueError, OverflowError):
        _wrong(path, field.base_type, value)
    return value


def _yaml_nan() -> Any:
    """What PyYAML makes of ``.nan``: always the same object, with a sign by accident.

    It stands for the usual NaN. Without PyYAML this is an object that nobody else has.
    """
    constructor = getattr(sys.modules.get("yaml.constructor"), "SafeConstructor", None)
    return getattr(constructor, "nan_value", _NO_PYYAML)


_NO_PYYAML = object()


def _wrong(path: str, expected: str, value: Any, why: str = "") -> NoReturn:
    raise SerializationError(f"{path}: expected {expected}, got {describe(value)}{why}") from None


# -- equality ------------------------------------------------------------------------


def values_equal(a: Any, b: Any) -> bool:
    """Whether two values of a field are equal; sequences may be of different classes."""
    if a is b:
        return True
    if type(a) is type(b) and not hasattr(a, "__array__"):
        if isinstance(a, (list, tuple)):
            return len(a) == len(b) and all(map(values_equal, a, b))
        return bool(a == b)
    if isinstance(a, (str, int, float)) or isinstance(b, (str, int, float)):
        return bool(a == b)
    if hasattr(a, "nsecs") and hasattr(b, "nsecs"):
        # Times may be genpy's; a time never equals a duration.
        return (a.secs, a.nsecs) == (b.secs, b.nsecs) and _is_time(a) == _is_time(b)
    if _is_sequence(a) and _is_sequence(b):
        first, second = _sequence(a), _sequence(b)
        return len(first) == len(second) and all(map(values_equal, first, second))
    return bool(a == b)


def _is_time(value: Any) -> bool:
    return any(kind.__name__ == "Time" for kind in type(value).__mro__)


def _is_sequence(value: Any) -> bool:
    if isinstance(value, (list, tuple)) or hasattr(value, "__array__"):
        return True
    try:
        memoryview(value)
    except TypeError:
        return False
    return True


def _sequence(value: Any) -> Any:
    if isinstance(value, (list, tuple)):
        return value
    if hasattr(value, "__array__"):
        return value.tolist()
    view = memoryview(value)
    try:
        return view.tolist()
    except NotImplementedError:
        # Formats of ctypes and of the other byte order are not implemented there.
        return struct.unpack(f"{view.format[0]}{len(view)}{view.format[1:]}", view.tobytes())


# -- NumPy ---------------------------------------------------------------------------


def arrays_to_numpy(message: Any, numpy: Any) -> None:
    """Replace arrays of numbers by NumPy arrays, in nested messages too."""
    for field in message._fields:
        value = getattr(message, field.name)
        builtin = BUILTINS.get(field.base_type)
        if builtin is None:
            for item in value if field.is_array else [value]:
                arrays_to_numpy(item, numpy)
        elif field.is_array and builtin.kind in ("int", "float") and not builtin.octets:
            setattr(message, field.name, numpy.array(value, dtype=builtin.code))
