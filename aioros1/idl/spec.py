"""Definitions as data, which the parser makes of texts."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from aioros1._public import public
from aioros1.idl.builtin_types import HEADER_TYPE, is_builtin

__all__ = ["ActionSpec", "Constant", "ConstantValue", "Field", "MessageSpec", "ServiceSpec"]

ConstantValue: TypeAlias = int | float | bool | str


@public("aioros1.idl")
@dataclass(frozen=True, slots=True)
class Field:
    """One field.

    ``type`` is as written, but with its package (``geometry_msgs/Point[]``,
    ``float64[36]``); ``base_type`` is the same without brackets. ``array_len`` is the
    length of a fixed array, and None for any other field.
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


@public("aioros1.idl")
@dataclass(frozen=True, slots=True)
class Constant:
    """One constant. ``text`` is the value as it is hashed for the MD5 sum."""

    name: str
    type: str
    value: ConstantValue
    text: str


@public("aioros1.idl")
@dataclass(frozen=True, slots=True)
class MessageSpec:
    """The definition of a message; ``text`` is the text that it was read from."""

    type: str
    fields: tuple[Field, ...]
    constants: tuple[Constant, ...]
    text: str

    @property
    def package(self) -> str:
        """The package of the type: what is before the slash."""
        return self.type.partition("/")[0]

    @property
    def has_header(self) -> bool:
        """Whether the first field is ``Header header``."""
        first = self.fields[0] if self.fields else None
        return first is not None and first.name == "header" and first.type == HEADER_TYPE

    @property
    def dependencies(self) -> tuple[str, ...]:
        """The message types of the fields, in order and without repetition."""
        return tuple(dict.fromkeys(f.base_type for f in self.fields if not f.is_builtin))


@public("aioros1.idl")
@dataclass(frozen=True, slots=True)
class ServiceSpec:
    """The definition of a service, which has two messages."""

    type: str
    request: MessageSpec
    response: MessageSpec
    text: str


@public("aioros1.idl")
@dataclass(frozen=True, slots=True)
class ActionSpec:
    """The definition of an action, of which actionlib makes seven messages.

    ``messages`` has them by their suffixes: ``Action``, ``ActionGoal``,
    ``ActionResult``, ``ActionFeedback``, ``Goal``, ``Result``, ``Feedback``.
    """

    type: str
    messages: dict[str, MessageSpec]
    text: str
