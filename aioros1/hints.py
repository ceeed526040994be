"""What to say where people slip: arguments, callbacks, and habits from other libraries."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from functools import wraps
from typing import Any, Final, ParamSpec, TypeVar, get_args

__all__ = [
    "MODULE_HABITS",
    "NODE_HABITS",
    "RATE_HABITS",
    "check_coroutine",
    "check_kinds",
    "check_takes",
    "explained",
    "explained_attributes",
    "methods_of",
    "no_attribute",
]

P = ParamSpec("P")
R = TypeVar("R")
C = TypeVar("C", bound=type)

_NODES = "await node.advertise(topic, type)", "await node.subscribe(topic, type)"
_SERVICES = "await node.advertise_service(name, type, handler)", "await node.call(name, type)"

MODULE_HABITS: Final[Mapping[str, str]] = {
    "init_node": "async with aioros1.Node(name), or aioros1.run(main, name) in a script",
    "spin": "await node.wait_closed(), or aioros1.run(main, name) in a script",
    "spin_once": "nothing: the event loop runs the node",
    "ok": "node.is_open",
    "is_shutdown": "node.is_open",
    "signal_shutdown": "await node.close()",
    "shutdown": "await node.close()",
    "init": "async with aioros1.Node(name)",
    "Service": "await node.advertise_service(name, type, handler)",
    "ServiceProxy": "await node.service_caller(name, type)",
    "wait_for_service": "await node.wait_for_service(name)",
    "wait_for_message": "await node.wait_for_message(topic, type)",
    "get_param": "await node.get_param(key)",
    "set_param": "await node.set_param(key, value)",
    "has_param": "await node.has_param(key)",
    "get_time": "node.now().to_sec()",
    "get_rostime": "node.now()",
    "sleep": "await node.sleep(seconds)",
    "create_node": "async with aioros1.Node(name)",
    "NodeHandle": "async with aioros1.Node(name)",
    **{f"log{level}": f"node.log.{level}(text)" for level in ("debug", "info", "warning")},
    "logwarn": "node.log.warning(text)",
    "logerr": "node.log.error(text)",
    "logfatal": "node.log.critical(text)",
}
"""Functions of rospy and rclpy, and what stands for them here."""

NODE_HABITS: Final[Mapping[str, str]] = {
    **{name: MODULE_HABITS[name] for name in MODULE_HABITS if name.startswith("log")},
    "publish": "pub = await node.advertise(topic, type), then pub.publish()",
    "Publisher": _NODES[0],
    "Subscriber": _NODES[1],
    "Service": _SERVICES[0],
    "ServiceProxy": "await node.service_caller(name, type)",
    "create_publisher": _NODES[0],
    "create_subscription": _NODES[1],
    "create_service": _SERVICES[0],
    "create_client": "await node.service_caller(name, type)",
    "create_timer": "node.timer(period, callback)",
    "create_rate": "node.rate(hz)",
    "destroy_node": "await node.close()",
    "shutdown": "await node.close()",
    "stop": "await node.close()",
    "spin": "await node.wait_closed()",
    "is_shutdown": "node.is_open",
    "ok": "node.is_open",
    "get_logger": "node.log",
    "get_clock": "node.now()",
    "get_time": "node.now().to_sec()",
    "get_name": "node.name",
    "get_namespace": "node.namespace",
    "get_parameter": "await node.get_param(key)",
    "declare_parameter": "await node.get_param(key, default)",
    "get_topic_names_and_types": "await node.master.get_topic_types()",
    "call_service": _SERVICES[1],
    "unsubscribe": "await sub.close()",
    "unadvertise": "await pub.close()",
}
"""Methods of nodes elsewhere."""

RATE_HABITS: Final[Mapping[str, str]] = {"sleep": "async for now in node.rate(hz)"}
"""Methods of rates elsewhere."""


def no_attribute(what: str, name: str, habits: Mapping[str, str]) -> AttributeError:
    """The error for an attribute that ``what`` does not have, but something elsewhere has."""
    hint = f"; here it is: {habits[name]}" if name in habits else ""
    return AttributeError(f"{what} has no attribute {name!r}{hint}")


def explained_attributes(habits: Mapping[str, str]) -> Callable[[Any, str], Any]:
    """Make a ``__getattr__`` that knows attributes of other libraries.

    It slows down every look-up of an attribute in Python 3.11: no class on the way of a
    message has one.
    """

    def __getattr__(self: Any, name: str) -> Any:  # noqa: N807
        if name in habits:
            raise no_attribute(f"{type(self).__name__!r} object", name, habits)
        # Again, for the error that it raised: it may come from within a property.
        return object.__getattribute__(self, name)

    return __getattr__


_KEYWORD_HABITS: Final[Mapping[str, str]] = {
    "data_class": "type",
    "service_class": "type",
    "msg_type": "type",
    "srv_type": "type",
    "cb": "callback",
    "qos_profile": "queue_size",
    "latched": "latch",
    "default_val": "default",
    "callback_args": "functools.partial for the callback",
    "subscriber_listener": "await pub.wait_for_subscribers()",
}


def explained(method: Callable[P, R]) -> Callable[P, R]:
    """Decorate a method so that an error in how it is called shows its signature.

    Only calls that do not fit the signature get a longer text; what the method raises passes
    unchanged.
    """

    @wraps(method)
    def call(*args: P.args, **kwargs: P.kwargs) -> R:
        try:
            return method(*args, **kwargs)
        except TypeError as error:
            traceback = error.__traceback__
            if traceback is not None and traceback.tb_next is not None:
                raise  # from inside the method
            raise TypeError(f"{_readable(method, error)}{_meant(method, kwargs, error)}") from None

    return call


def _readable(method: Callable[..., Any], error: TypeError) -> str:
    return str(error).replace(f"{method.__qualname__}()", f"{method.__name__}()")


def _meant(method: Callable[..., Any], kwargs: Mapping[str, Any], error: TypeError) -> str:
    from difflib import get_close_matches  # for errors only

    signature = inspect.signature(method)
    known = [name for name in signature.parameters if name != "self"]
    for name in kwargs:
        if name not in known:
            close = get_close_matches(name, known, 1)
            meant = _KEYWORD_HABITS.get(name) or (close[0] if close else "")
            break
    else:
        meant = ""
    question = f"; did you mean {meant}?" if meant else ""
    if "Did you mean" in str(error):
        question = ""  # Python 3.13 asks by itself
    shown = [
        each.replace(annotation=each.empty)
        for name, each in signature.parameters.items()
        if name != "self"
    ]
    signature = signature.replace(parameters=shown, return_annotation=signature.empty)
    return f"{question}; the signature is {method.__name__}{signature}"


def methods_of(owner: str) -> Callable[[C], C]:
    """Decorate a base class that only splits up the class ``owner``, which is what users know.

    Python names a function by its ``__qualname__`` when a call does not fit.
    """

    def rename(part: C) -> C:
        for name, value in vars(part).items():
            if inspect.isfunction(value):
                value.__qualname__ = f"{owner}.{name}"
        return part

    return rename


def check_takes(function: object, what: str, argument: str) -> None:
    """Raise :class:`TypeError` unless ``function`` can be called with one argument.

    ``what`` begins the text, ``argument`` says what the function is called with.
    """
    if inspect.iscoroutine(function):
        function.close()  # Python warns if it is never awaited
        raise TypeError(
            f"{what}: hand over the function itself, and not what it returns: "
            f"got a coroutine of {function.__qualname__}()"
        )
    if not callable(function):
        raise TypeError(f"{what} is a function, got {function!r:.200}")
    try:
        signature = inspect.signature(function)
    except Exception:  # of the user's callable, too
        return  # not every function of C has one
    try:
        signature.bind(object())
    except TypeError as error:
        name = getattr(function, "__qualname__", None) or repr(function)
        raise TypeError(
            f"{what} is called with {argument}, but {name}{signature} does not fit: {error}"
        ) from None


def check_coroutine(coro: object, what: str) -> None:
    """Raise :class:`TypeError` unless ``coro`` is a coroutine, for ``what`` that takes one."""
    if not inspect.iscoroutine(coro):
        hint = f": call it, as in {coro.__name__}()" if inspect.isroutine(coro) else ""
        raise TypeError(f"{what} takes a coroutine, got {coro!r:.200}{hint}")


def check_kinds(values: object, kinds: Mapping[str, tuple[Any, str]]) -> None:
    """Raise :class:`TypeError` for attributes that are not of the kinds they should be.

    ``kinds`` has the classes of each, and how to name them. True and False are no numbers.
    """
    for name, (kind, expected) in kinds.items():
        value = getattr(values, name)
        is_flag = isinstance(value, bool) and bool not in (get_args(kind) or (kind,))
        if is_flag or not isinstance(value, kind):
            raise TypeError(f"{name} must be {expected}, got {value!r:.200}")
