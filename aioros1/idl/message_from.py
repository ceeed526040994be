"""One message from what a user passes to ``publish``, ``call`` or ``reply``.

All of them take a message as it is, a dict of its fields, or its fields as keyword
arguments. :func:`message_from` makes one message of any of these, or says what is wrong.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from aioros1.idl.convert import convert, from_dict
from aioros1.idl.message import Message

__all__ = ["message_from"]


def message_from(
    cls: type[Message], message: Any, fields: Mapping[str, Any], keyword: str = ""
) -> Any:
    """The message that ``publish(message)`` or ``publish(**fields)`` means.

    ``message`` is a message, a mapping of fields or None, ``fields`` the keyword
    arguments. ``keyword`` is the name by which ``message`` itself can be given as a
    keyword argument; a field of that name, such as ``msg`` of ``rosgraph_msgs/Log``,
    goes first.

    Returns an instance of ``cls``, or ``message`` itself if its class is another one of
    the same definition. Raises :class:`TypeError` for both a message and fields and for
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
    """Whether the value of a field is a mapping of fields itself, or a list of those."""
    if isinstance(value, (list, tuple)):
        return bool(value) and isinstance(value[0], Mapping)
    return isinstance(value, Mapping)
