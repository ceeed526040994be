"""The two ways to give a message: as one, or as its fields."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from aioros1.idl import Message, convert, from_dict

__all__ = ["message_from"]


def message_from(
    cls: type[Message], message: Any, fields: Mapping[str, Any], keyword: str = ""
) -> Any:
    """The message that ``publish(message)`` or ``publish(**fields)`` means.

    ``keyword`` is the name by which the message itself may be given, where the type has
    no field of that name, as rosgraph_msgs/Log has its ``msg``.

    The result is a ``cls`` or, for a message of another class with the same
    definition, that message itself. Raises :class:`TypeError` for both at once and for
    unknown fields, :class:`~aioros1.SerializationError` for a message of another type.
    """
    if message is None and keyword in fields and keyword not in cls.__slots__:
        message = fields[keyword]
        fields = {name: value for name, value in fields.items() if name != keyword}
    if message is None:
        if any(map(_holds_dicts, fields.values())):
            return from_dict(cls, fields)
        return cls(**fields)
    if fields:
        raise TypeError(
            f"{cls._type}: expected a message or fields, got both: {type(message).__name__} "
            f"and {', '.join(fields)}"
        )
    return convert(cls, message)


def _holds_dicts(value: object) -> bool:
    """Whether a field's value is given by fields itself, or a list of such."""
    if isinstance(value, (list, tuple)):
        return bool(value) and isinstance(value[0], Mapping)
    return isinstance(value, Mapping)
