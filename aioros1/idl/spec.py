"""Definitions as data: what the parser makes of a text."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from aioros1.idl.builtin_types import HEADER_TYPE, is_builtin

__all__ = ["ActionSpec", "Constant", "ConstantValue", "Field", "MessageSpec", "ServiceSpec"]

ConstantValue: TypeAlias = int | float | bool | str


@dataclass(frozen=True, slots=True)
class Field:
    """One field.

    ``type`` is resolved but as written otherwise (``geometry_msgs/Point[]``,
    ``float64[36]``), ``base_type`` the same without the brackets. ``array_len`` is the
    length of a fixed array, None for a variable one and for no array.
    """

    name: str
    type: str
    base_type: str
    is_array: bool = False
    array_len: int | None = None

    @property
    def is_builtin(self) -> bool:
        """Whether the (element) type is a built-in one."""
        return is_builtin(self.base_type)


@dataclass(frozen=True, slots=True)
class Constant:
    """One constant. ``text`` is the value as it enters the MD5 sum."""

    name: str
    type: str
    value: ConstantValue
    text: str


@dataclass(frozen=True, slots=True)
class MessageSpec:
    """The definition of a message type; ``text`` is the source it was read from."""

    type: str
    fields: tuple[Field, ...]
    constants: tuple[Constant, ...]
    text: str

    @property
    def package(self) -> str:
        """The part of the type's name before the slash."""
        return self.type.partition("/")[0]

    @property
    def has_header(self) -> bool:
        """Whether the first field is ``Header header``."""
        first = self.fields[0] if self.fields else None
        return first is not None and first.name == "header" and first.type == HEADER_TYPE

    @property
    def dependencies(self) -> tuple[str, ...]:
        """The message types that fields have, in order, each named once."""
        return tuple(dict.fromkeys(f.base_type for f in self.fields if not f.is_builtin))


@dataclass(frozen=True, slots=True)
class ServiceSpec:
    """The definition of a service: two messages."""

    type: str
    request: MessageSpec
    response: MessageSpec
    text: str


@dataclass(frozen=True, slots=True)
class ActionSpec:
    """The definition of an action: the seven messages that actionlib makes of it.

    ``messages`` has them by what follows the action's name: ``Action``, ``ActionGoal``,
    ``ActionResult``, ``ActionFeedback``, ``Goal``, ``Result``, ``Feedback``.
    """

    type: str
    messages: dict[str, MessageSpec]
    text: str
