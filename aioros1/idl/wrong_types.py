"""What to say about a type that does not exist, or that is no type."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from difflib import SequenceMatcher
from types import ModuleType
from typing import Any, Final

from aioros1.idl.check import describe
from aioros1.idl.paths import KINDS, Kind
from aioros1.idl.service import AnyAction

__all__ = ["near_types", "not_a_type", "of_another_kind"]

# How alike, from 0 to 1, packages and types at least are if one is taken for the other.
_PACKAGE_LIKENESS, _TYPE_LIKENESS = 0.5, 0.7
_MOST_PACKAGES = 20
_MOST_SUGGESTIONS = 3

_USUAL_PACKAGES = ("std_msgs", "geometry_msgs", "sensor_msgs", "nav_msgs", "std_srvs")

_A: Final[dict[Kind, str]] = {"msg": "a message", "srv": "a service", "action": "an action"}

_USE: Final[dict[Kind, str]] = {
    "msg": "messages go to advertise() and subscribe()",
    "srv": "services go to advertise_service() and service_caller()",
    "action": "the messages of an action have types of their own, such as {}ActionGoal",
}
"""What a type of each kind is for."""

_STANDARD: Final[dict[object, str]] = {
    str: "std_msgs/String",
    int: "std_msgs/Int64",
    float: "std_msgs/Float64",
    bool: "std_msgs/Bool",
    bytes: "std_msgs/UInt8MultiArray",
}


def not_a_type(kind: Kind, value: Any) -> TypeError:
    """The error for what is not the type of a message, service or action."""
    name = getattr(value, "_type", None)
    if not isinstance(name, str):
        got = _what_it_is(value)
    elif not isinstance(value, type):
        got = f"a message of {name}: hand over its class"
    elif issubclass(value, AnyAction):
        got = f"the action class {name}: {_USE['action'].format(name)}"
    elif getattr(value, "_request_class", None) is not None:
        got = f"the service class {name}: {_USE['srv']}"
    else:
        got = f"the message class {name}"
        service = re.fullmatch(r"(.+)(?:Request|Response)", name)
        if kind == "srv" and service is not None:
            got += f": hand over the class of the service, {service[1]}"
        elif kind == "srv":
            got += f": {_USE['msg']}"
    return TypeError(f"expected {_A[kind]} class or 'package/Type', got {got}")


def _what_it_is(value: Any) -> str:
    """A value in place of a type, and what may have been meant."""
    if isinstance(value, type) and value in _STANDARD:
        return f"Python's {value.__name__}: messages have types of ROS, such as {_STANDARD[value]}"
    if isinstance(value, ModuleType):
        return f"the module {value.__name__}: hand over one of the classes in it"
    if callable(value) and not isinstance(value, type):
        return f"the function {describe(value)}: a callback or handler comes after the type"
    return describe(value)


def of_another_kind(expected: Kind, got: Kind, type: str) -> str:
    return (
        f"expected the type of {_A[expected]}, got that of {_A[got]}, {type}: "
        f"{_USE[got].format(type)}"
    )


def near_types(
    wrong: str,
    kind: Kind,
    packages: Iterable[str],
    given: Iterable[str],
    types: Callable[[str], Iterable[str]],
    has: Callable[[str, str], bool],
) -> list[str]:
    """The few types that a wrong name resembles, the likest first.

    A name may lack its package, and the ways of other languages to write one
    (``pkg::Type``, ``pkg.msg.Type``, ``pkg/msg/Type``) are understood. ``packages`` are the
    packages there may be, ``given`` those among them that users added; ``types(package)``
    lists the types of one as ``pkg/Type``, and ``has(package, name)`` tells whether there is
    such a type.

    A name may come from elsewhere, through the application, so only the packages most like
    it are listed: listing all of an installed ROS takes a tenth of a second. Without a package
    in the name, these are the usual ones and those given.
    """
    if len(wrong) > 200:
        return []  # no file has such a name
    words = [word for word in re.split(r"\W+", wrong) if word and word not in KINDS]
    if len(words) > 1 and words[0] == "aioros1":
        del words[0]
    if not words:
        return []
    name = words[-1]
    known = list(packages)
    looked_at = {package for package in known if has(package, name)}
    if len(words) == 1:
        if looked_at:
            found = sorted(looked_at, key=lambda each: (each not in _USUAL_PACKAGES, each))
            return [f"{package}/{name}" for package in found[:_MOST_SUGGESTIONS]]
        likeness = dict.fromkeys((*_USUAL_PACKAGES, *sorted(given)), 1.0)
    else:
        likeness = {package: _likeness(words[0], package) for package in known}
    nearest = sorted(likeness, key=lambda package: -likeness[package])[:_MOST_PACKAGES]
    looked_at.update(package for package in nearest if likeness[package] >= _PACKAGE_LIKENESS)
    scored = []
    for package in looked_at:
        for candidate in types(package):
            score = _likeness(name, candidate.partition("/")[2])
            if score >= _TYPE_LIKENESS and likeness[package] >= _PACKAGE_LIKENESS:
                scored.append((-score - likeness[package], candidate))
    return [candidate for _, candidate in sorted(scored)[:_MOST_SUGGESTIONS]]


def _likeness(first: str, second: str) -> float:
    return SequenceMatcher(None, first.lower(), second.lower()).ratio()
