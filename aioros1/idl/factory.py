"""Makes message classes from specs."""

from __future__ import annotations

from array import array
from collections.abc import Callable, Iterable, Mapping
from keyword import iskeyword
from typing import Any, cast

from aioros1.errors import MessageSpecError
from aioros1.idl.builtin_types import BUILTINS
from aioros1.idl.digest import full_text
from aioros1.idl.message import AnyMessage, Message
from aioros1.idl.spec import Field, MessageSpec
from aioros1.idl.structure import Structure
from aioros1.time import Duration, Time

__all__ = ["make_message_class", "specs_of"]

_MAX_SIZE = 1 << 31
_MAX_LEAVES = 20_000
_MAX_LOOPS = 12

_ZERO = {
    "int": 0,
    "float": 0.0,
    "bool": False,
    "string": "",
    "time": Time(),
    "duration": Duration(),
}


class _Unset:
    """Stands for a default that is made anew for each message."""

    def __repr__(self) -> str:
        return "<default>"


_UNSET = _Unset()


def make_message_class(
    spec: MessageSpec,
    nested: Mapping[str, type[Message]],
    *,
    md5sum: str,
    module: str,
) -> type[AnyMessage]:
    """Make the class of a message type.

    ``nested`` has the classes of the message types of its fields, by type. Raises
    :class:`MessageSpecError` for a definition that is far too large: definitions come from
    peers too, and a codec is as long as the flattened definition.
    """
    for field in spec.fields:
        if field.array_len is not None and field.array_len >= _MAX_SIZE:
            raise MessageSpecError(f"{field.name}: an array of over 2 GiB", path=spec.type)
    leaves = _leaves(spec, nested)
    loops = _loops(spec, nested)
    min_size, fixed = _size(spec, nested)
    if leaves > _MAX_LEAVES:
        raise MessageSpecError(f"more than {_MAX_LEAVES} fields, with nested ones", path=spec.type)
    if loops > _MAX_LOOPS:
        raise MessageSpecError(f"arrays nested more than {_MAX_LOOPS} deep", path=spec.type)
    if min_size >= _MAX_SIZE:
        raise MessageSpecError("a message of over 2 GiB", path=spec.type)

    slots = tuple(field.name for field in spec.fields)
    namespace: dict[str, Any] = {
        "__slots__": slots,
        "__module__": module,
        "__doc__": f"The message type {spec.type}.",
        "_type": spec.type,
        "_md5sum": md5sum,
        "_full_text": _FullText(),
        "_has_header": spec.has_header,
        "_slot_types": [field.type for field in spec.fields],
        "_spec": spec,
        "_fields": spec.fields,
        "_constants": spec.constants,
        "_nested": dict(nested),
        "_fixed_size": min_size if fixed else None,
        "_min_size": min_size,
        "_has_bulk": _has_bulk(spec, nested),
        "_leaves": leaves,
        "_loops": loops,
        "_hollow": _hollow(spec, nested),
        "__init__": _constructor(spec, nested),
    }
    for constant in spec.constants:
        # genmsg does not check the names of constants at all. Leave out those that are
        # hidden by a field, and those that would break the class.
        name = constant.name
        taken = name in slots or name.startswith("_") or hasattr(Message, name)
        if name.isidentifier() and not taken:
            namespace[name] = constant.value
    made: Any = type(spec.type.partition("/")[2], (Message,), namespace)
    return cast("type[AnyMessage]", made)


class _FullText:
    """``_full_text``, which is put together when it is first read.

    A definition from a peer may have hundreds of types, and the full text of each holds
    the texts of all types inside it.
    """

    def __set_name__(self, owner: type[Message], name: str) -> None:
        self._class = owner

    def __get__(self, instance: object, owner: object) -> str:
        cls = self._class
        text = cls._full_text = full_text(cls._spec, specs_of(cls._nested.values()).__getitem__)
        return text


def specs_of(classes: Iterable[type[Structure]]) -> dict[str, MessageSpec]:
    """The specs of the classes and of all classes inside them, by type."""
    found: dict[str, MessageSpec] = {}
    waiting = list(classes)
    while waiting:
        cls = waiting.pop()
        if cls._type not in found:
            found[cls._type] = cls._spec
            waiting += cls._nested.values()
    return found


def _leaves(spec: MessageSpec, nested: Mapping[str, Any]) -> int:
    """How many fields there are, nested ones included: the length of the codecs."""
    return sum(1 if f.is_builtin else 1 + nested[f.base_type]._leaves for f in spec.fields)


def _loops(spec: MessageSpec, nested: Mapping[str, Any]) -> int:
    """How deep arrays of messages are nested; Python allows for 20 nested blocks."""
    return max(
        (nested[f.base_type]._loops + f.is_array for f in spec.fields if not f.is_builtin),
        default=0,
    )


def _size(spec: MessageSpec, nested: Mapping[str, type[Message]]) -> tuple[int, bool]:
    """The smallest size on the wire in bytes, and whether it is the only one."""
    total, fixed = 0, True
    for field in spec.fields:
        builtin = BUILTINS.get(field.base_type)
        if builtin is None:
            size = nested[field.base_type]._min_size
            item_fixed = nested[field.base_type]._fixed_size is not None
        else:
            size, item_fixed = builtin.size, builtin.kind != "string"
        if field.is_array and field.array_len is None:
            size, item_fixed = 4, False
        elif field.array_len is not None:
            size *= field.array_len
            item_fixed = item_fixed or field.array_len == 0
        total += size
        fixed = fixed and item_fixed
    return total, fixed


def _hollow(spec: MessageSpec, nested: Mapping[str, type[Message]]) -> int:
    """How many messages of zero bytes the fixed arrays of a message hold."""
    total = 0
    for field in spec.fields:
        cls = nested.get(field.base_type)
        if cls is None:
            continue
        if not field.is_array:
            total += cls._hollow
        elif field.array_len is not None:
            total += field.array_len * (cls._hollow + (cls._fixed_size == 0))
    return total


def _has_bulk(spec: MessageSpec, nested: Mapping[str, type[Message]]) -> bool:
    for field in spec.fields:
        builtin = BUILTINS.get(field.base_type)
        if builtin is None:
            if not field.is_array and nested[field.base_type]._has_bulk:
                return True
        elif field.is_array and field.array_len is None and builtin.kind in ("int", "float"):
            return True
    return False


def _constructor(spec: MessageSpec, nested: Mapping[str, type[Message]]) -> Callable[..., None]:
    """Write ``__init__``; plain parameters with plain defaults are the quickest.

    All other names in the code begin with an underscore, as no field does: a field may
    have the name of a builtin.
    """
    names: dict[str, Any] = {
        "_unset": _UNSET,
        "_array": array,
        "_bool": bool,
        "_bytes": bytes,
        "_range": range,
        "_setattr": setattr,
    }
    parameters, body, given = [], [], []
    for number, field in enumerate(spec.fields):
        default, made = _default(field, nested, names, number)
        if iskeyword(field.name):
            body.append(f"    _setattr(_self, {field.name!r}, {made or default})")
        elif made is not None:
            parameters.append(f"{field.name}=_unset")
            body.append(
                f"    _self.{field.name} = {made} if {field.name} is _unset else {field.name}"
            )
            given.append(f"{field.name} is not _unset")
        else:
            parameters.append(f"{field.name}={default}")
            body.append(f"    _self.{field.name} = {field.name}")
            given.append(f"{field.name} is not {default}")
    signature = ", ".join(["_self", "*_values", *parameters, "**_others"])
    lines = [
        f"def __init__({signature}):",
        "    if _values:",
        f"        return _self._set_positional(_values, _bool({' or '.join([*given, '_others'])}))",
        *body,
        "    if _others: _self._set_unusual(_others)",
    ]
    exec(compile("\n".join(lines), f"<constructor of {spec.type}>", "exec"), names)
    function: Callable[..., None] = names["__init__"]
    function.__qualname__ = f"{spec.type.partition('/')[2]}.__init__"
    return function


def _default(
    field: Field, nested: Mapping[str, type[Message]], names: dict[str, Any], number: int
) -> tuple[str, str | None]:
    """An expression for a default that messages share, or one that makes a new default."""
    builtin = BUILTINS.get(field.base_type)
    constant = f"_d{number}"
    length = field.array_len
    if not field.is_array:
        if builtin is None:
            names[f"_C{number}"] = nested[field.base_type]
            return "", f"_C{number}()"
        names[constant] = _ZERO[builtin.kind]
        return constant, None
    if builtin is None:
        names[f"_C{number}"] = nested[field.base_type]
        return "", "[]" if length is None else f"[_C{number}() for _ in _range({length})]"
    if builtin.octets:
        # A large default is made when it is used: nobody may ever use it.
        if length is None or length <= 4096:
            names[constant] = bytes(length or 0)
            return constant, None
        return "", f"_bytes({length})"
    if builtin.kind in ("int", "float"):
        octets = "" if length is None else f", _bytes({length * builtin.size})"
        return "", f"_array({builtin.code!r}{octets})"
    if length is None:
        return "", "[]"
    names[constant] = _ZERO[builtin.kind]
    return "", f"[{constant}] * {length}"
