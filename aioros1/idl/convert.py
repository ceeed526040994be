"""Messages to and from other forms: dicts, other classes of the same type, NumPy."""

from __future__ import annotations

from array import array
from collections.abc import Mapping
from typing import Any, TypeVar

from aioros1.errors import SerializationError
from aioros1.idl import values
from aioros1.idl.builtin_types import BUILTINS
from aioros1.idl.check import describe
from aioros1.idl.message import Message
from aioros1.idl.spec import Field
from aioros1.time import Duration, Time

__all__ = ["arrays_to_numpy", "convert", "from_dict", "to_dict", "values_equal"]

_M = TypeVar("_M", bound=Message)

_SECONDS: dict[str, type[Time] | type[Duration]] = {"time": Time, "duration": Duration}


def convert(cls: type[_M], value: Any) -> Any:
    """What can be encoded as ``cls``: an instance of it, or one that looks the same.

    An instance is returned as it is, and so is one of another class with the same MD5
    sum: genpy's, or one from another store. A mapping is read by
    :meth:`Message.from_dict`. Raises :class:`SerializationError` for anything else.
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
        what = describe(value)
    raise SerializationError(f"expected a {cls._type}, got {what}")


# -- dicts ---------------------------------------------------------------------------


def to_dict(message: Any) -> dict[str, Any]:
    """:meth:`Message.to_dict`, for genpy's messages too."""
    return {name: _plain(getattr(message, name)) for name in message.__slots__}


def _plain(value: Any) -> Any:
    if isinstance(value, (str, int, float, bytes)):
        return value
    if hasattr(type(value), "_slot_types") and not hasattr(value, "nsecs"):
        return to_dict(value)
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    if isinstance(value, bytearray) or (
        isinstance(value, (memoryview, array)) and _item_code(value) == "B"
    ):
        return bytes(value)
    if isinstance(value, (memoryview, array)) or hasattr(value, "tolist"):
        return value.tolist()
    if hasattr(value, "nsecs"):
        return {"secs": value.secs, "nsecs": value.nsecs}
    return value


def _item_code(value: memoryview | array[Any]) -> str:
    return value.format if isinstance(value, memoryview) else value.typecode


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


def _from_plain(cls: type[Message], field: Field, value: Any, path: str) -> Any:
    builtin = BUILTINS.get(field.base_type)
    if not field.is_array:
        return _item(cls, field, value, path)
    if builtin is not None and builtin.kind in ("int", "float"):
        if not isinstance(value, (list, tuple)):
            return value
        try:
            if builtin.octets:
                return bytes(value)
            return array(builtin.code, value)
        except Exception as exc:
            raise SerializationError(
                f"{path}: expected {field.type}, got {describe(value)} ({exc})"
            ) from None
    try:
        items = values.as_list(value)
    except TypeError:
        raise SerializationError(f"{path}: expected {field.type}, got {describe(value)}") from None
    return [_item(cls, field, item, f"{path}[{index}]") for index, item in enumerate(items)]


def _item(cls: type[Message], field: Field, value: Any, path: str) -> Any:
    nested = cls._nested.get(field.base_type)
    if nested is not None:
        return from_dict(nested, value, path) if isinstance(value, Mapping) else value
    kind = _SECONDS.get(field.base_type)
    if kind is None:
        return value
    try:
        if isinstance(value, Mapping):
            if not value.keys() <= {"secs", "nsecs"}:
                raise ValueError
            # As it stands: what a peer sent may not be normalised.
            secs, nsecs = value.get("secs", 0), value.get("nsecs", 0)
            return kind._raw(secs.__index__(), nsecs.__index__())
        if isinstance(value, (int, float)):
            return kind(value)
    except (AttributeError, ValueError, OverflowError):
        raise SerializationError(
            f"{path}: expected {field.base_type}, got {describe(value)}"
        ) from None
    return value


# -- equality ------------------------------------------------------------------------


def values_equal(a: Any, b: Any) -> bool:
    """Whether two values of a field are the same, whatever kinds of sequence they are."""
    if a is b:
        return True
    if type(a) is type(b) and not hasattr(a, "__array__"):
        if isinstance(a, (list, tuple)):
            return len(a) == len(b) and all(map(values_equal, a, b))
        return bool(a == b)
    if isinstance(a, (str, int, float)) or isinstance(b, (str, int, float)):
        return bool(a == b)
    if hasattr(a, "nsecs") and hasattr(b, "nsecs"):
        # genpy's times; a Time is no Duration, whoever made them.
        return (a.secs, a.nsecs) == (b.secs, b.nsecs) and _is_time(a) == _is_time(b)
    if _is_sequence(a) and _is_sequence(b):
        first, second = _sequence(a), _sequence(b)
        return len(first) == len(second) and all(map(values_equal, first, second))
    return bool(a == b)


def _is_time(value: Any) -> bool:
    return any(kind.__name__ == "Time" for kind in type(value).__mro__)


def _is_sequence(value: Any) -> bool:
    return isinstance(value, (list, tuple, bytes, bytearray, array, memoryview)) or hasattr(
        value, "__array__"
    )


def _sequence(value: Any) -> Any:
    return value.tolist() if hasattr(value, "tolist") else value


# -- NumPy ---------------------------------------------------------------------------


def arrays_to_numpy(message: Any, numpy: Any) -> None:
    """Put NumPy arrays in place of the arrays of numbers, in nested messages too."""
    for field in message._fields:
        value = getattr(message, field.name)
        builtin = BUILTINS.get(field.base_type)
        if builtin is None:
            for item in value if field.is_array else [value]:
                arrays_to_numpy(item, numpy)
        elif field.is_array and builtin.kind in ("int", "float") and not builtin.octets:
            setattr(message, field.name, numpy.array(value, dtype=builtin.code))
