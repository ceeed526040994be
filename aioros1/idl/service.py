"""The classes of services and actions, which hold the classes of their messages."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar, Generic, TypeVar, overload

from aioros1._public import public
from aioros1.idl.message import AnyMessage, Message
from aioros1.idl.spec import ActionSpec, MessageSpec, ServiceSpec

__all__ = [
    "Action",
    "AnyAction",
    "AnyService",
    "Service",
    "make_action_class",
    "make_service_class",
    "spec_of",
]

Q = TypeVar("Q", bound=Message)
A = TypeVar("A", bound=Message)
Goal = TypeVar("Goal", bound=Message)
Result = TypeVar("Result", bound=Message)
Feedback = TypeVar("Feedback", bound=Message)


@public
class Service(Generic[Q, A]):
    """The base class of all service types.

    The class of a service is made from its definition: by an import from
    :mod:`aioros1.srv`, by :func:`aioros1.load_srv` or by a :class:`~aioros1.MessageStore`.
    ``SetBool.Request`` and ``SetBool.Response`` are the classes of its two messages. A
    service class has no instances of its own.

    The class attributes that genpy's services have are here too: ``_type``
    (``"pkg/Type"``), ``_md5sum``, ``_full_text``, ``_request_class`` and
    ``_response_class``.
    """

    # `Request` and `Response` are in the stub of each service: a class variable cannot be
    # generic.

    __slots__ = ()

    _type: ClassVar[str]
    _md5sum: ClassVar[str]
    _full_text: ClassVar[str]
    _spec: ClassVar[ServiceSpec]
    _request_class: ClassVar[type[Message]]
    _response_class: ClassVar[type[Message]]


@public
class Action(Generic[Goal, Result, Feedback]):
    """The base class of all action types.

    The class of an action is made from its definition: by an import from
    :mod:`aioros1.action`, by :func:`aioros1.load_action` or by a
    :class:`~aioros1.MessageStore`. It has seven message classes as its attributes:
    ``Goal``, ``Result`` and ``Feedback`` are what the definition says; ``ActionGoal``,
    ``ActionResult`` and ``ActionFeedback`` are what travels on the topics; ``Action`` has
    these three as its fields.

    ``_type`` is ``"pkg/Type"``, ``_md5sum`` that of ``Action``, ``_full_text`` the text
    of the definition.
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


@overload
def spec_of(cls: type[Message]) -> MessageSpec: ...
@overload
def spec_of(cls: type[Service[Any, Any]]) -> ServiceSpec: ...
@overload
def spec_of(cls: type[Action[Any, Any, Any]]) -> ActionSpec: ...
@public("aioros1.idl")
def spec_of(
    cls: type[Message] | type[Service[Any, Any]] | type[Action[Any, Any, Any]],
) -> MessageSpec | ServiceSpec | ActionSpec:
    """The definition from which a class was made, as data."""
    return cls._spec
