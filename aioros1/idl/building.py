"""Classes of messages, services and actions, with the classes that they contain."""

# ruff: noqa: A001 - `type` is what ROS calls the name of a type

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Final, TypeAlias

from aioros1.errors import MessageSpecError
from aioros1.idl import digest
from aioros1.idl.factory import make_message_class, specs_of
from aioros1.idl.message import AnyMessage
from aioros1.idl.paths import Kind
from aioros1.idl.service import AnyAction, AnyService, make_action_class, make_service_class
from aioros1.idl.spec import ActionSpec, MessageSpec, ServiceSpec

__all__ = [
    "ACTION_SUFFIXES",
    "ActionClass",
    "Chain",
    "Load",
    "MessageClass",
    "ServiceClass",
    "build_action",
    "build_message",
    "build_service",
    "join_action",
    "join_service",
    "needed_by",
]

_MAX_DEPTH = 100

ACTION_SUFFIXES: Final = (
    "ActionGoal",
    "ActionResult",
    "ActionFeedback",
    "Action",
    "Goal",
    "Result",
    "Feedback",
)
"""What follows the name of an action in those of its seven messages."""

_WRITTEN: Final = ("Goal", "Result", "Feedback")
"""The messages that an action's definition has sections for."""

# By other names, as `type` is a parameter in much of this module and of the store.
MessageClass: TypeAlias = type[AnyMessage]
ServiceClass: TypeAlias = type[AnyService]
ActionClass: TypeAlias = type[AnyAction]

Chain: TypeAlias = tuple[str, ...]
"""The types that are being made, each for the one before it."""

Load: TypeAlias = Callable[[str, Chain], MessageClass]
"""What gives the class of a type that is inside those of a chain."""


def needed_by(chain: Chain) -> str:
    """The end of a sentence that says what a missing type is needed for."""
    return f", needed by {' -> '.join(chain)}" if chain else ""


def _module(kind: Kind, type: str) -> str:
    return f"aioros1.{kind}.{type.partition('/')[0]}"


def build_message(
    spec: MessageSpec, load: Load, chain: Chain = (), *, kind: Kind = "msg"
) -> MessageClass:
    """Make the class of a message, with ``load`` for the types of its fields.

    Raises :class:`MessageSpecError` for a type that contains itself.
    """
    chain = (*chain, spec.type)
    if len(chain) > _MAX_DEPTH:
        raise MessageSpecError(f"types nested over {_MAX_DEPTH} deep", path=chain[0])
    nested = {}
    for name in spec.dependencies:
        if name in chain:
            circle = " -> ".join((*chain[chain.index(name) :], name))
            raise MessageSpecError(f"a type that contains itself: {circle}", path=spec.type)
        nested[name] = load(name, chain)
    specs = {name: cls._spec for name, cls in nested.items()}
    sums = {name: cls._md5sum for name, cls in nested.items()}
    return make_message_class(
        spec,
        nested,
        md5sum=digest.md5sum(spec, specs.__getitem__, sums),
        module=_module(kind, spec.type),
    )


def build_service(spec: ServiceSpec, load: Load) -> ServiceClass:
    """Make the class of a service and those of its two messages."""
    request = build_message(spec.request, load, (spec.type,), kind="srv")
    response = build_message(spec.response, load, (spec.type,), kind="srv")
    return _service(spec, request, response)


def join_service(type: str, request: MessageClass, response: MessageClass) -> ServiceClass:
    """Make the class of a service from its two messages, as there is no other definition."""
    text = f"{request._spec.text}---\n{response._spec.text}"
    return _service(ServiceSpec(type, request._spec, response._spec, text), request, response)


def _service(spec: ServiceSpec, request: MessageClass, response: MessageClass) -> ServiceClass:
    lookup = specs_of([request, response]).__getitem__
    return make_service_class(
        spec,
        request,
        response,
        md5sum=digest.md5sum(spec, lookup),
        full_text=digest.full_text(spec, lookup),
        module=_module("srv", spec.type),
    )


def build_action(spec: ActionSpec, messages: Mapping[str, MessageClass]) -> ActionClass:
    """Make the class of an action from those of its seven messages, by their suffixes."""
    return make_action_class(spec, messages, module=_module("action", spec.type))


def join_action(message: MessageClass) -> ActionClass:
    """Make the class of an action from its message ``TypeAction``, which holds all others.

    Raises :class:`MessageSpecError` if it does not.
    """
    type = message._type.removesuffix("Action")
    messages: dict[str, Any] = {"Action": message}
    try:
        for part in _WRITTEN:
            stamped = messages[f"Action{part}"] = message._nested[f"{type}Action{part}"]
            messages[part] = stamped._nested[f"{type}{part}"]
    except KeyError as exc:
        raise MessageSpecError(
            f"expected the message of an action, but nothing in it is a {exc.args[0]}",
            path=message._type,
        ) from None
    text = "---\n".join(messages[part]._spec.text for part in _WRITTEN)
    specs = {suffix: messages[suffix]._spec for suffix in ACTION_SUFFIXES}
    return build_action(ActionSpec(type, specs, text), messages)
