"""Message definitions: text to spec to MD5 sum to class with a compiled codec.

Pure: nothing here does any networking or needs an event loop.
"""

from __future__ import annotations

import aioros1.idl.pickling  # noqa: F401 - attaches itself to Message
from aioros1.idl.convert import convert, from_dict, to_dict
from aioros1.idl.digest import full_text, md5_text, md5sum
from aioros1.idl.message import AnyMessage, Message
from aioros1.idl.parser import parse_action, parse_message, parse_service
from aioros1.idl.service import Action, Service, spec_of
from aioros1.idl.spec import ActionSpec, Constant, Field, MessageSpec, ServiceSpec
from aioros1.idl.store import MessageStore, default_store, load_action, load_msg, load_srv

__all__ = [
    "Action",
    "ActionSpec",
    "AnyMessage",
    "Constant",
    "Field",
    "Message",
    "MessageSpec",
    "MessageStore",
    "Service",
    "ServiceSpec",
    "convert",
    "default_store",
    "from_dict",
    "full_text",
    "load_action",
    "load_msg",
    "load_srv",
    "md5_text",
    "md5sum",
    "parse_action",
    "parse_message",
    "parse_service",
    "spec_of",
    "to_dict",
]
