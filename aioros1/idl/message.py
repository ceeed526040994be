"""The base class of all message classes, and the loader of their codecs."""

from __future__ import annotations

import copy
import struct
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, ClassVar, NoReturn, Protocol, TypeVar

from aioros1.errors import SerializationError
from aioros1.idl.spec import Constant, Field, MessageSpec
from aioros1.idl.values import own_memory

__all__ = ["AnyMessage", "Message", "MessageType", "Writable"]

_M = TypeVar("_M", bound="Message")
_new = object.__new__
_pack_length = struct.Struct("<I").pack


class Writable(Protocol):
    """What :meth:`Message.serialize` writes to, such as :class:`io.BytesIO`."""

    def write(self, data: bytes, /) -> object: ...


class MessageType(type):
    """The class of message classes: compiles a codec when it is first asked for.

    Loading a type must not cost more than reading its definition, and few of the types
    that are loaded travel in both directions. An attribute that is missing in the class
    ends up here; once made, it is found without this detour.
    """

    def _make_codec(cls, name: str) -> Any:
        make = _CODECS.get(name)
        if make is None or "_type" not in cls.__dict__:
            raise AttributeError(f"type object {cls.__name__!r} has no attribute {name!r}")
        function = make(cls)
        setattr(cls, name, staticmethod(function))
        return function

    if not TYPE_CHECKING:  # checkers would take it that a class has any attribute
        __getattr__ = _make_codec


class Message(metaclass=MessageType):
    """A message; subclasses are made from definitions by a :class:`MessageStore`.

    ``Cls(**fields)`` leaves the other fields at their defaults, ``Cls(*values)`` takes
    one value for each field. Attributes are not checked when they are assigned, but when
    the message is serialised.
    """

    __slots__: ClassVar[tuple[str, ...]] = ()

    _type: ClassVar[str]
    _md5sum: ClassVar[str]
    _full_text: ClassVar[str]
    _has_header: ClassVar[bool]
    _slot_types: ClassVar[list[str]]
    _connection_header: ClassVar[Mapping[str, str] | None] = None

    # Not genpy's:
    _spec: ClassVar[MessageSpec]
    _fields: ClassVar[tuple[Field, ...]]
    _constants: ClassVar[tuple[Constant, ...]]
    _nested: ClassVar[dict[str, type[Message]]]
    """The classes of the message types that fields have, by type."""
    _fixed_size: ClassVar[int | None]
    """The size on the wire, where all messages of the type have the same."""
    _min_size: ClassVar[int]
    _leaves: ClassVar[int]
    _loops: ClassVar[int]
    _hollow: ClassVar[int]
    _has_bulk: ClassVar[bool]
    """Whether there is an array of numbers that may be worth sending without a copy."""

    _encode: ClassVar[Callable[[Any], bytes]]
    """The octets of a message."""
    _frame: ClassVar[Callable[[Any], bytes]]
    """The octets of a message behind their number, as TCPROS sends them."""
    _frame_parts: ClassVar[Callable[[Any], list[bytes | memoryview]]]
    """The same in parts, in which large payloads of bytes are not copied."""
    _decode: ClassVar[Callable[[bytes, int, int], Any]]
    """A message from bytes, a position and an end; octets may be left over.

    The end must lie within the bytes."""
    _decode_view: ClassVar[Callable[[memoryview, int, int], Any]]
    """The same from a memoryview, with one copy of each payload."""
    _decode_views: ClassVar[Callable[[memoryview, int, int], Any]]
    """The same with memoryviews in place of arrays of numbers, without any copy."""
    _from_bytes: ClassVar[Callable[..., Any]]
    """A message from any buffer, all of it; ``views`` as in :meth:`from_bytes`."""

    __hash__ = None  # type: ignore[assignment]

    # A stand-in for the generated constructor, so that checkers know of one.
    def __init__(self, *args: Any, **fields: Any) -> None:
        raise TypeError(f"{type(self).__name__} is not the class of a message type")

    # -- octets -----------------------------------------------------------------------

    def to_bytes(self) -> bytes:
        """The message as on the wire, without its length in front.

        Raises :class:`SerializationError`, whose text begins with the path of the field
        that holds a value which does not fit.
        """
        cls = type(self)
        _take_place(cls, "to_bytes", cls._encode)
        return cls._encode(self)

    @classmethod
    def from_bytes(
        cls: type[_M], buffer: bytes | bytearray | memoryview, *, views: bool = False
    ) -> _M:
        """The message that these octets are, all of them.

        With ``views`` the arrays of numbers are memoryviews into ``buffer``, which nobody
        may change then: a large image costs nothing.

        Raises :class:`DeserializationError` when the octets are too few or too many.
        """
        _take_place(cls, "from_bytes", staticmethod(cls._from_bytes))
        message: _M = cls._from_bytes(buffer, views=views)
        return message

    def serialize(self, buff: Writable) -> None:
        """genpy's :meth:`to_bytes`: write the octets to a file-like object."""
        buff.write(type(self)._encode(self))

    def deserialize(self: _M, data: bytes) -> _M:
        """genpy's :meth:`from_bytes`: fill this message, and return it."""
        message = type(self).from_bytes(data)
        for name in self.__slots__:
            setattr(self, name, getattr(message, name))
        return self

    def serialize_numpy(self, buff: Writable, numpy: Any) -> None:
        """genpy's variant for NumPy arrays, which :meth:`serialize` takes anyway."""
        buff.write(type(self)._encode(self))

    def deserialize_numpy(self: _M, data: bytes, numpy: Any) -> _M:
        """As :meth:`deserialize`, with NumPy arrays for arrays of numbers."""
        from aioros1.idl.convert import arrays_to_numpy

        self.deserialize(data)
        arrays_to_numpy(self, numpy)
        return self

    # -- values -----------------------------------------------------------------------

    def to_dict(self, *, json: bool = False) -> dict[str, Any]:
        """The fields as plain values: dicts, lists, numbers, strings.

        Times become ``{"secs": ..., "nsecs": ...}``, arrays lists; ``uint8[]`` and
        ``char[]`` are bytes. PyYAML writes and reads all of it, but of NaNs it knows one.

        With ``json`` the values are those that every JSON parser takes, and nothing is
        lost on the way there and back: bytes are in base64, as rosbridge sends them, and
        what JSON has no number for is a string: ``"NaN"``, ``"Infinity"``,
        ``"-Infinity"``, and ``"NaN:fff8000000000000"`` for a NaN of other bits. Strings
        that are not UTF-8 have lone surrogates, which :func:`json.dumps` writes as
        ``\\udc80`` to ``\\udcff`` unless ``ensure_ascii`` is turned off.
        """
        from aioros1.idl.convert import to_dict

        return to_dict(self, json=json)

    @classmethod
    def from_dict(cls: type[_M], values: Mapping[str, Any]) -> _M:
        """The reverse of both kinds of :meth:`to_dict`; missing fields keep their defaults.

        Times may be given as numbers of seconds too, and arrays of numbers as buffers,
        which are not copied. Raises :class:`SerializationError` for unknown fields and
        values of the wrong shape; what is left is checked when the message is serialised.
        """
        from aioros1.idl.convert import from_dict

        return from_dict(cls, values)

    def replace(self: _M, **changes: Any) -> _M:
        """A shallow copy with some fields changed."""
        result = copy.copy(self)
        for name, value in changes.items():
            if name not in self.__slots__:
                _unknown_field(type(self), name)
            setattr(result, name, value)
        return result

    def _get_types(self) -> list[str]:
        return self._slot_types

    def __eq__(self, other: object) -> bool:
        if other is self:
            return True
        cls, kind = type(self), type(other)
        if kind is not cls and (
            getattr(kind, "_md5sum", None) != cls._md5sum
            or getattr(kind, "_type", None) != cls._type
        ):
            return NotImplemented
        from aioros1.idl.convert import values_equal

        return all(
            values_equal(getattr(self, name, None), getattr(other, name, None))
            for name in cls.__slots__
        )

    def __repr__(self) -> str:
        from aioros1.idl.text import message_repr

        return message_repr(self)

    def __str__(self) -> str:
        from aioros1.idl.text import message_text

        return message_text(self)

    def __copy__(self: _M) -> _M:
        result = _new(type(self))
        for name in self.__slots__:
            setattr(result, name, getattr(self, name))
        return result

    def __deepcopy__(self: _M, memo: dict[int, Any]) -> _M:
        result = _new(type(self))
        memo[id(self)] = result
        for name in self.__slots__:
            value = getattr(self, name)
            if isinstance(value, memoryview):
                # A view cannot be copied; what it shows can.
                value = own_memory(value)
            setattr(result, name, copy.deepcopy(value, memo))
        return result

    def __reduce_ex__(self, protocol: Any) -> tuple[Any, ...]:
        from aioros1.idl.pickling import reduce_message

        return reduce_message(self)

    # -- called by the generated constructors -----------------------------------------

    def _set_positional(self, values: tuple[Any, ...], others: bool) -> None:
        names = self.__slots__
        cls = type(self)
        if others:
            raise TypeError(f"{cls._type}: fields are given either by position or by name")
        if len(values) != len(names):
            raise TypeError(
                f"{cls._type} has {len(names)} fields ({', '.join(names)}), "
                f"got {len(values)} values"
            )
        for name, value in zip(names, values, strict=True):
            setattr(self, name, value)

    def _set_unusual(self, values: dict[str, Any]) -> None:
        """Fields that are keywords of Python, as no parameter can have their names."""
        for name, value in values.items():
            if name not in self.__slots__:
                _unknown_field(type(self), name)
            setattr(self, name, value)


if TYPE_CHECKING:

    class _AnyMessageType(MessageType):
        def __getattr__(cls, name: str) -> Any: ...

    class AnyMessage(Message, metaclass=_AnyMessageType):
        """A message of a type that is known at run time only; for checkers it has any field."""

        def __getattr__(self, name: str) -> Any: ...
        def __setattr__(self, name: str, value: Any) -> None: ...

else:
    AnyMessage = Message


def _unknown_field(cls: type[Message], name: str) -> NoReturn:
    known = ", ".join(cls.__slots__) or "none"
    raise AttributeError(f"{cls._type} has no field {name!r}; its fields: {known}")


# -- the codecs ----------------------------------------------------------------------


def _slow_path(cls: type[Message]) -> Callable[[Any, Exception], bytes]:
    """What encodes when the fast encoder could not: with every value looked at."""
    from aioros1.idl.codegen import make_encoder

    encoders: list[Callable[[Any], bytes]] = []

    def encode(message: Any, failure: Exception) -> bytes:
        from aioros1.idl.check import normalise

        if not encoders:
            encoders.append(make_encoder(cls))
        if isinstance(failure, UnicodeEncodeError):
            # Text that was not UTF-8 when it came, most likely.
            try:
                return encoders[0](message)
            except Exception:
                pass
        clean = normalise(cls, message)
        try:
            return encoders[0](clean)
        except Exception as exc:
            raise SerializationError(f"{cls._type}: {exc}") from exc

    return encode


def _make_encode(cls: type[Message]) -> Callable[..., Any]:
    from aioros1.idl.codegen import make_encoder

    return make_encoder(cls, _slow_path(cls))


def _make_frame(cls: type[Message]) -> Callable[..., Any]:
    from aioros1.idl.codegen import make_encoder

    slow = _slow_path(cls)

    def slow_frame(message: Any, failure: Exception) -> bytes:
        body = slow(message, failure)
        return _pack_length(len(body)) + body

    return make_encoder(cls, slow_frame, frame=True)


def _make_frame_parts(cls: type[Message]) -> Callable[..., Any]:
    from aioros1.idl.codegen import make_encoder

    slow = _slow_path(cls)

    def slow_parts(message: Any, failure: Exception) -> list[bytes | memoryview]:
        body = slow(message, failure)
        return [_pack_length(len(body)), body]

    return make_encoder(cls, slow_parts, frame=True, split=True)


def _make_decoder(mode: Any) -> Callable[[type[Message]], Callable[..., Any]]:
    def make(cls: type[Message]) -> Callable[..., Any]:
        from aioros1.idl.decoders import make_decoder

        return make_decoder(cls, mode)

    return make


def _make_from_bytes(cls: type[Message]) -> Callable[..., Any]:
    from aioros1.idl.decoders import make_whole_decoder

    return make_whole_decoder(cls)


_CODECS: dict[str, Callable[[Any], Any]] = {
    "_encode": _make_encode,
    "_frame": _make_frame,
    "_frame_parts": _make_frame_parts,
    "_from_bytes": _make_from_bytes,
    "_decode": _make_decoder("bytes"),
    "_decode_view": _make_decoder("view"),
    "_decode_views": _make_decoder("views"),
}


def _take_place(cls: type[Message], name: str, function: Any) -> None:
    """Put a compiled function in the place of the base class's method that only calls it.

    Going through the method is a third of what it takes to encode a small message.
    """
    owner = next(base for base in cls.__mro__ if "_type" in base.__dict__)
    if name not in owner.__dict__:
        plain = getattr(function, "__func__", function)
        plain.__doc__ = getattr(Message, name).__doc__
        setattr(owner, name, function)
