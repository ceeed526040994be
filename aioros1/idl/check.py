"""Finds the value that does not fit its field, after an encoder has failed.

The walk makes a clean copy as it goes. An encoder may fail for a value that is fine but of
an unusual class; the copy then holds one of the usual class, and is encoded instead.

Values come from applications and may be of any class. If one raises an exception when it
is looked at, whichever it is, then the value does not fit.
"""

from __future__ import annotations

import operator
from collections.abc import Callable
from keyword import iskeyword
from typing import Any, NoReturn

from aioros1.errors import SerializationError
from aioros1.idl import values
from aioros1.idl.builtin_types import BUILTINS, Builtin
from aioros1.idl.spec import Field
from aioros1.idl.structure import Structure

__all__ = ["describe", "normalise"]

_CONVERT: dict[str, Callable[[Any], Any]] = {
    "string": values.as_text_escaped,
    "time": values.as_time,
    "duration": values.as_duration,
    "bool": values.as_bool,
}


def describe(value: Any) -> str:
    """A value as it is shown in an error: short, and never an exception."""
    try:
        return _describe(value)
    except Exception:
        # Not even all integers can be printed.
        return f"a value of type {type(value).__name__}"


def _describe(value: Any) -> str:
    kind = type(value)
    code = getattr(value, "typecode", None) or getattr(value, "dtype", None)
    if code is not None and hasattr(value, "__len__"):
        return f"{kind.__name__} of {str(code)!r}"
    if isinstance(value, memoryview):
        return f"memoryview of {value.format!r}"
    message_type = getattr(kind, "_type", None)
    if isinstance(message_type, str):
        return f"a {message_type}"
    text = repr(value[:80] if isinstance(value, (str, bytes, list, tuple)) else value)
    return text if len(text) <= 80 else f"{text[:77]}..."


def normalise(cls: type[Structure], message: Any) -> Structure:
    """A copy of the message in which each field has a value of the usual class.

    Raises :class:`SerializationError` with the path of the first field whose value is
    missing or does not fit.
    """
    return _message(cls, message, "")


def _wrong(path: str, expected: str, value: Any, why: str = "") -> NoReturn:
    reason = f" ({why})" if why else ""
    raise SerializationError(f"{path}: expected {expected}, got {describe(value)}{reason}")


def _message(cls: type[Structure], message: Any, path: str) -> Structure:
    result: Structure = object.__new__(cls)
    for field in cls._fields:
        place = f"{path}.{field.name}" if path else field.name
        try:
            value = getattr(message, field.name)
        except Exception:
            # genpy appends an underscore to what Python would not take for a name.
            try:
                value = getattr(message, f"{field.name}_" if iskeyword(field.name) else "")
            except Exception:
                if not path and isinstance(message, cls):
                    raise SerializationError(f"{place}: has no value") from None
                _wrong(path or cls._type, cls._type, message, f"has no {field.name!r}")
        try:
            setattr(result, field.name, _field(cls, field, value, place))
        except SerializationError:
            raise
        except Exception as exc:
            _wrong(place, field.type, value, type(exc).__name__)
    if not cls._fields and not hasattr(type(message), "_md5sum"):
        _wrong(path or cls._type, cls._type, message)
    return result


def _field(cls: type[Structure], field: Field, value: Any, path: str) -> Any:
    builtin = BUILTINS.get(field.base_type)
    if not field.is_array:
        if builtin is not None:
            return _scalar(builtin, value, path)
        return _message(cls._nested[field.base_type], value, path)
    if builtin is not None and builtin.kind in ("int", "float"):
        result = _numbers(builtin, field, value, path)
    else:
        try:
            items = values.as_list(value)
        except Exception:
            _wrong(path, field.type, value)
        if builtin is not None:
            result = [_scalar(builtin, v, f"{path}[{i}]") for i, v in enumerate(items)]
        else:
            nested = cls._nested[field.base_type]
            result = [_message(nested, v, f"{path}[{i}]") for i, v in enumerate(items)]
    if field.array_len is not None and len(result) != field.array_len:
        _wrong(path, f"{field.array_len} elements", value, f"{len(result)} elements")
    return result


def _numbers(builtin: Builtin, field: Field, value: Any, path: str) -> Any:
    convert: Any = values.as_octets if builtin.octets else values.as_numbers(builtin.code)
    try:
        result = convert(value)
    except Exception as exc:
        # An element, perhaps; a buffer is right or wrong as a whole.
        if not isinstance(value, (list, tuple)):
            _wrong(path, field.type, value, str(exc))
        for index, item in enumerate(value):
            _scalar(builtin, item, f"{path}[{index}]")
        _wrong(path, field.type, value, str(exc))
    if builtin.octets:
        return bytes(result)
    # The bytes are little-endian by now, but the encoder expects a native array.
    return values.load_array(builtin.code, memoryview(result).tobytes())


def _scalar(builtin: Builtin, value: Any, path: str) -> Any:
    if builtin.kind == "int":
        try:
            number = operator.index(value)
        except Exception:
            _wrong(path, builtin.name, value)
        if not builtin.low <= number <= builtin.high:
            _wrong(path, f"{builtin.name} ({builtin.low} to {builtin.high})", value)
        return number
    if builtin.kind == "float":
        try:
            # float() itself would read any kind of text.
            real = float(value) if hasattr(value, "__float__") else float(operator.index(value))
            values.as_numbers(builtin.code)([real])
        except OverflowError:
            _wrong(path, builtin.name, value, "out of range")
        except Exception:
            _wrong(path, builtin.name, value)
        return real
    try:
        result = _CONVERT[builtin.kind](value)
    except Exception as exc:
        why = str(exc) if isinstance(exc, UnicodeError) else ""
        _wrong(path, builtin.name, value, why)
    if builtin.kind in ("time", "duration"):
        low, high = (0, 0xFFFFFFFF) if builtin.kind == "time" else (-(1 << 31), (1 << 31) - 1)
        if not (low <= result.secs <= high and low <= result.nsecs <= high):
            _wrong(path, builtin.name, value, "out of the range of the wire")
    return result
