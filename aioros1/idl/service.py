"""Classes of services and actions: nothing but names for their messages."""

from __future__ import annotations

from typing import ClassVar

from aioros1.idl.message import Message
from aioros1.idl.spec import ActionSpec, ServiceSpec

__all__ = ["Action", "Service", "make_action_class", "make_service_class"]


class Service:
    """The type of a service; subclasses are made by a :class:`MessageStore`."""

    __slots__ = ()

    _type: ClassVar[str]
    _md5sum: ClassVar[str]
    _full_text: ClassVar[str]
    _spec: ClassVar[ServiceSpec]
    _request_class: ClassVar[type[Message]]
    _response_class: ClassVar[type[Message]]
    Request: ClassVar[type[Message]]
    Response: ClassVar[type[Message]]


class Action:
    """The type of an action; subclasses are made by a :class:`MessageStore`.

    ``Goal``, ``Result`` and ``Feedback`` are what was written in the definition;
    ``ActionGoal``, ``ActionResult`` and ``ActionFeedback`` travel on the topics, and
    ``Action`` is the message that has these three as its fields.
    """

    __slots__ = ()

    _type: ClassVar[str]
    _md5sum: ClassVar[str]
    _full_text: ClassVar[str]
    _spec: ClassVar[ActionSpec]
    Action: ClassVar[type[Message]]
    ActionGoal: ClassVar[type[Message]]
    ActionResult: ClassVar[type[Message]]
    ActionFeedback: ClassVar[type[Message]]
    Goal: ClassVar[type[Message]]
    Result: ClassVar[type[Message]]
    Feedback: ClassVar[type[Message]]


def make_service_class(
    spec: ServiceSpec,
    request: type[Message],
    response: type[Message],
    *,
    md5sum: str,
    full_text: str,
    module: str,
) -> type[Service]:
    """Make the class of a service from those of its two messages."""
    namespace = {
        "__slots__": (),
        "__module__": module,
        "__doc__": f"The service type {spec.type}.",
        "_type": spec.type,
        "_md5sum": md5sum,
        "_full_text": full_text,
        "_spec": spec,
        "_request_class": request,
        "_response_class": response,
        "Request": request,
        "Response": response,
    }
    return type(spec.type.partition("/")[2], (Service,), namespace)


def make_action_class(
    spec: ActionSpec, messages: dict[str, type[Message]], *, module: str
) -> type[Action]:
    """Make the class of an action from those of its seven messages."""
    namespace = {
        "__slots__": (),
        "__module__": module,
        "__doc__": f"The action type {spec.type}.",
        "_type": spec.type,
        "_md5sum": messages["Action"]._md5sum,
        "_full_text": spec.text,
        "_spec": spec,
        **messages,
    }
    return type(spec.type.partition("/")[2], (Action,), namespace)
