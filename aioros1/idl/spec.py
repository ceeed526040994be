"""Definitions as data, which the parser makes of texts."""

from __future__ import annotations

from typing import NamedTuple, TypeAlias

from aioros1._public import public
from aioros1.idl.builtin_types import HEADER_TYPE, is_builtin

__all__ = ["ActionSpec", "Constant", "ConstantValue", "Field", "MessageSpec", "ServiceSpec"]

ConstantValue: TypeAlias = int | float | bool | str


@public("aioros1.idl")
class Field(NamedTuple):
    """One field of a message."""

    name: str
    """The name."""
    type: str
    """As written, but with its package: ``geometry_msgs/Point[]``, ``float64[36]``."""
    base_type: str
    """The same without brackets."""
    is_array: bool = False
    """Whether there are brackets behind the type."""
    array_len: int | None = None
    """The length of a fixed array; None for any other field."""

    @property
    def is_builtin(self) -> bool:
        """Whether the (element) type is a built-in one."""
        return is_builtin(self.base_type)


@public("aioros1.idl")
class Constant(NamedTuple):
    """One constant of a message."""

    name: str
    """The name."""
    type: str
    """The built-in type."""
    value: ConstantValue
    """The value, as an attribute of the class has it."""
    text: str
    """The value as it is hashed for the MD5 sum."""


@public("aioros1.idl")
class MessageSpec(NamedTuple):
    """The definition of a message."""

    type: str
    """``pkg/Type``."""
    fields: tuple[Field, ...]
    """The fields, in order."""
    constants: tuple[Constant, ...]
    """The constants, in order."""
    text: str
    """The text that it was read from."""

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
class ServiceSpec(NamedTuple):
    """The definition of a service, which has two messages."""

    type: str
    """``pkg/Type``."""
    request: MessageSpec
    """The definition of the request, ``pkg/TypeRequest``."""
    response: MessageSpec
    """The definition of the response, ``pkg/TypeResponse``."""
    text: str
    """The text that it was read from."""


@public("aioros1.idl")
class ActionSpec(NamedTuple):
    """The definition of an action, of which actionlib makes seven messages."""

    type: str
    """``pkg/Type``."""
    messages: dict[str, MessageSpec]
    """The seven by their suffixes: ``Action``, ``ActionGoal``, ``ActionResult``,
    ``ActionFeedback``, ``Goal``, ``Result``, ``Feedback``."""
    text: str
    """The text that it was read from."""
