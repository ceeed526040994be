"""Definitions as rosmsg and rossrv show them."""

from __future__ import annotations

from collections.abc import Iterator

from aioros1._public import public
from aioros1.idl.digest import Lookup
from aioros1.idl.spec import ActionSpec, MessageSpec, ServiceSpec

__all__ = ["outline"]

_SEPARATOR = "---\n"


@public("aioros1.idl")
def outline(spec: MessageSpec | ServiceSpec | ActionSpec, lookup: Lookup) -> str:
    """One line for each constant and field; the fields of a nested message are indented.

    A line of three dashes separates the parts of a service or an action. ``lookup`` gives
    the spec of a message inside, by its type.
    """
    return _SEPARATOR.join("".join(_lines(part, lookup, "")) for part in _parts(spec))


def _parts(spec: MessageSpec | ServiceSpec | ActionSpec) -> tuple[MessageSpec, ...]:
    if isinstance(spec, ServiceSpec):
        return spec.request, spec.response
    if isinstance(spec, ActionSpec):
        return spec.messages["Goal"], spec.messages["Result"], spec.messages["Feedback"]
    return (spec,)


def _lines(spec: MessageSpec, lookup: Lookup, indent: str) -> Iterator[str]:
    for constant in spec.constants:
        yield f"{indent}{constant.type} {constant.name}={constant.text}\n"
    for field in spec.fields:
        yield f"{indent}{field.type} {field.name}\n"
        if not field.is_builtin:
            yield from _lines(lookup(field.base_type), lookup, f"{indent}  ")
