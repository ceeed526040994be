"""Pickles messages, whose classes are made at run time."""

from __future__ import annotations

import sys
from typing import Any

from aioros1.idl.message import Message
from aioros1.idl.store import MessageStore
from aioros1.idl.values import own_memory

__all__ = ["reduce_message"]

_store = MessageStore()
"""A store for this alone: a load by name must not find what was unpickled here."""


def reduce_message(message: Message) -> tuple[Any, ...]:
    """Pickle by the name of the class if an import finds it, otherwise by its definition."""
    cls = type(message)
    values = tuple(
        own_memory(value) if isinstance(value, memoryview) else value
        for value in (getattr(message, name) for name in message.__slots__)
    )
    module = sys.modules.get(cls.__module__)
    if module is not None and getattr(module, cls.__name__, None) is cls:
        return _restore, (cls, values)
    return _restore_defined, (cls._type, cls._md5sum, cls._full_text, values)


def _restore(cls: type[Message], values: tuple[Any, ...]) -> Message:
    message: Message = object.__new__(cls)
    for name, value in zip(cls.__slots__, values, strict=True):
        setattr(message, name, value)
    return message


def _restore_defined(type: str, md5sum: str, full_text: str, values: tuple[Any, ...]) -> Message:
    cls = _store.add_definition(type, full_text)
    if cls._md5sum != md5sum:
        raise TypeError(
            f"the pickled definition of {type} has md5sum {cls._md5sum}, expected {md5sum}"
        )
    return _restore(cls, values)


Message._reduce = staticmethod(reduce_message)
