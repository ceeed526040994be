"""Message definitions, for tools: text to spec to MD5 sum to class with a compiled codec.

What programs need of this, such as ``MessageStore`` and ``load_msg``, is in :mod:`aioros1`.
Pure: nothing here does any networking or needs an event loop.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import aioros1.idl.pickling  # noqa: F401 - attaches itself to Message

# For the other parts of the library; users find these in aioros1.
from aioros1.idl.codec import GENPY_NAMES as GENPY_NAMES
from aioros1.idl.codec import Codec as Codec
from aioros1.idl.codec import codec_of as codec_of
from aioros1.idl.convert import convert, from_dict, to_dict
from aioros1.idl.digest import full_text, md5_text, md5sum
from aioros1.idl.message import AnyMessage as AnyMessage
from aioros1.idl.message import Message as Message
from aioros1.idl.modules import types_of
from aioros1.idl.parser import parse_action, parse_message, parse_service
from aioros1.idl.paths import Kind
from aioros1.idl.service import Action as Action
from aioros1.idl.service import Service as Service
from aioros1.idl.service import spec_of
from aioros1.idl.show import outline
from aioros1.idl.spec import ActionSpec, Constant, Field, MessageSpec, ServiceSpec
from aioros1.idl.store import MessageStore as MessageStore
from aioros1.idl.store import default_store, standard_store
from aioros1.idl.store import load_action as load_action
from aioros1.idl.store import load_msg as load_msg
from aioros1.idl.store import load_srv as load_srv

if TYPE_CHECKING:
    from aioros1.idl.stubs import write_package_stubs

__all__ = [
    "ActionSpec",
    "Constant",
    "Field",
    "Kind",
    "MessageSpec",
    "ServiceSpec",
    "convert",
    "default_store",
    "from_dict",
    "full_text",
    "md5_text",
    "md5sum",
    "outline",
    "parse_action",
    "parse_message",
    "parse_service",
    "spec_of",
    "standard_store",
    "to_dict",
    "types_of",
    "write_package_stubs",
]


def __getattr__(name: str) -> Any:
    if name != "write_package_stubs":  # of interest to few, and the largest module here
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from aioros1.idl.stubs import write_package_stubs

    return write_package_stubs
