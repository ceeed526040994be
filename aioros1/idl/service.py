"""Classes of services and actions: nothing but names for their messages."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, ClassVar, Generic, TypeVar

from aioros1.idl.message import AnyMessage, Message
from aioros1.idl.spec import ActionSpec, ServiceSpec

__all__ = [
    "Action",
    "AnyAction",
    "AnyService",
    "Service",
    "make_action_class",
    "make_service_class",
]

Q = TypeVar("Q", bound=Message)
A = TypeVar("A", bound=Message)
Goal = TypeVar("Goal", bound=Message)
Result = TypeVar("Result", bound=Message)
Feedback = TypeVar("Feedback", bound=Message)


class Service(Generic[Q, A]):
    """The type of a service; subclasses are made by a :class:`MessageStore`.

    Their ``Request`` and ``Response`` are the classes of the two messages. Checkers read
    of these in the stub of each service, as a class variable cannot be generic.
    """

    __slots__ = ()

    _type: ClassVar[str]
    _md5sum: ClassVar[str]
    _full_text: ClassVar[str]
    _spec: ClassVar[ServiceSpec]
    _request_class: ClassVar[type[Message]]
    _response_class: ClassVar[type[Message]]


class Action(Generic[Goal, Result, Feedback]):
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


if TYPE_CHECKING:

    class AnyService(Service[AnyMessage, AnyMessage]):
        """A service whose type is known at run time only."""

        Request: ClassVar[type[AnyMessage]]
        Response: ClassVar[type[AnyMessage]]

    class AnyAction(Action[AnyMessage, AnyMessage, AnyMessage]):
        """An action whose type is known at run time only."""

        Action: ClassVar[type[AnyMessage]]
        ActionGoal: ClassVar[type[AnyMessage]]
        ActionResult: ClassVar[type[AnyMessage]]
        ActionFeedback: ClassVar[type[AnyMessage]]
        Goal: ClassVar[type[AnyMessage]]
        Result: ClassVar[type[AnyMessage]]
        Feedback: ClassVar[type[AnyMessage]]

else:
    AnyService = Service
    AnyAction = Action


def make_service_class(
    spec: ServiceSpec,
    request: type[Message],
    response: type[Message],
    *,
    md5sum: str,
    full_text: str,
    module: str,
) -> type[AnyService]:
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
    return type(spec.type.partition("/")[2], (AnyService,), namespace)


def make_action_class(
    spec: ActionSpec, messages: Mapping[str, type[Message]], *, module: str
) -> type[AnyAction]:
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
    return type(spec.type.partition("/")[2], (AnyAction,), namespace)
