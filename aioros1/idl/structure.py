"""What a message class knows of its definition, and nothing that it can do.

The modules that do something with messages (write codecs for them, check, convert or
print them) need to know no more of a class than this. :class:`~.message.Message` stands
above them, and has a method for each of these things.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from aioros1.idl.spec import Constant, Field, MessageSpec

__all__ = ["Structure"]


class Structure:
    """The base of all message classes: the attributes that :mod:`.factory` fills in."""

    __slots__: ClassVar[tuple[str, ...]] = ()

    # The names that genpy gives to these.
    _type: ClassVar[str]
    _md5sum: ClassVar[str]
    _full_text: ClassVar[str]
    _has_header: ClassVar[bool]
    _slot_types: ClassVar[list[str]]
    _connection_header: ClassVar[Mapping[str, str] | None] = None

    # Our own.
    _spec: ClassVar[MessageSpec]
    _fields: ClassVar[tuple[Field, ...]]
    _constants: ClassVar[tuple[Constant, ...]]
    _nested: ClassVar[dict[str, type[Structure]]]
    """The classes of the message types that fields have, by type."""
    _fixed_size: ClassVar[int | None]
    """The size on the wire in bytes, if all messages of the type have the same."""
    _min_size: ClassVar[int]
    """The size on the wire in bytes when all strings and arrays are empty."""
    _leaves: ClassVar[int]
    """How many fields there are, those of nested messages included."""
    _loops: ClassVar[int]
    """How deep arrays of messages are nested."""
    _hollow: ClassVar[int]
    """How many messages of zero bytes the fixed arrays of a message hold."""
    _has_bulk: ClassVar[bool]
    """Whether there is an array of numbers that may be worth sending without a copy."""

    # A stand-in for the generated constructor, so that type checkers know of one.
    def __init__(self, *args: Any, **fields: Any) -> None:
        raise TypeError(
            f"{type(self).__name__} is a base class; messages are made by the class of a type"
        )
