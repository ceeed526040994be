"""The base class of all message classes, and what messages can do.

Codecs and the text of ``repr`` are imported when they are first used: a program that only
reads definitions needs neither.
"""

from __future__ import annotations

import copy
from collections.abc import Callable, Mapping
from typing import IO, TYPE_CHECKING, Any, ClassVar, NoReturn, TypeAlias, TypeVar

from aioros1._public import public
from aioros1.idl.compiled import CODEC, compiled
from aioros1.idl.convert import arrays_to_numpy, from_dict, to_dict, values_equal
from aioros1.idl.structure import Structure
from aioros1.idl.values import own_memory

__all__ = ["AnyMessage", "Message"]

if TYPE_CHECKING:
    from _typeshed import SupportsWrite

    Writable: TypeAlias = SupportsWrite[bytes]
else:
    Writable = IO[bytes]

_M = TypeVar("_M", bound="Message")
_new = object.__new__


@public
class Message(Structure):
    """The base class of all messages.

    The class of a type is made from its definition: by an import from
    :mod:`aioros1.msg`, by :func:`aioros1.load_msg` or by a :class:`~aioros1.MessageStore`.
    It has one attribute for each field, and one for each constant of the definition.

    ``Cls(**fields)`` sets some fields and leaves the others at their defaults;
    ``Cls(*values)`` takes one value for each field. Attributes are not checked when they
    are assigned, but when the message is serialized. Two messages of one type are equal
    if all of their fields are. Messages can be copied and pickled, but not hashed.

    The class attributes that genpy's messages have are here too: ``_type``
    (``"pkg/Type"``), ``_md5sum``, ``_full_text``, ``_slot_types``, ``_has_header``, and
    ``__slots__``, the names of the fields.
    """

    __slots__: ClassVar[tuple[str, ...]] = ()

    # The codec; what other packages use of it is in :mod:`.codec`.
    _encode: ClassVar[Callable[[Any], bytes]] = compiled("_encode")
    """The bytes of a message."""
    _frame: ClassVar[Callable[[Any], bytes]] = compiled("_frame")
    """The bytes of a message behind their number, as TCPROS sends them."""
    _frame_parts: ClassVar[Callable[[Any], list[bytes | memoryview]]] = compiled("_frame_parts")
    """The same in parts, without a copy of large payloads of bytes."""
    _decode: ClassVar[Callable[[bytes, int, int], Any]] = compiled("_decode")
    """A message from bytes, a position and an end; bytes may be left over.

    The end must lie within the bytes."""
    _decode_view: ClassVar[Callable[[memoryview, int, int], Any]] = compiled("_decode_view")
    """The same from a memoryview, with one copy of each payload."""
    _decode_views: ClassVar[Callable[[memoryview, int, int], Any]] = compiled("_decode_views")
    """The same with memoryviews in place of arrays of numbers, without any copy."""
    _from_bytes: ClassVar[Callable[..., Any]] = compiled("_from_bytes")
    """A message from any buffer, all of it; ``views`` as in :meth:`from_bytes`."""

    _reduce: ClassVar[Callable[[Message], tuple[Any, ...]]]
    """How a message is pickled. :mod:`.pickling` sets it, which stands above the store,
    and so above this."""

    __hash__ = None  # type: ignore[assignment]

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        if "_type" not in cls.__dict__ and hasattr(cls, "_type"):
            _separate(cls)

    # -- bytes ------------------------------------------------------------------------

    def to_bytes(self) -> bytes:
        """Serialize the message: its bytes on the wire, without their number in front.

        Raises :class:`~aioros1.SerializationError` for a value that does not fit its
        field; the text begins with the path of that field.
        """
        cls = type(self)
        _take_place(cls, "to_bytes", cls._encode)
        return cls._encode(self)

    @classmethod
    def from_bytes(
        cls: type[_M], buffer: bytes | bytearray | memoryview, *, views: bool = False
    ) -> _M:
        """Deserialize a message: ``buffer`` has to be the whole of it.

        With ``views`` the arrays of numbers are memoryviews into ``buffer``, so that a
        large image is not copied. Do not change ``buffer`` then as long as you use them.

        Raises :class:`~aioros1.DeserializationError` for too few or too many bytes.
        """
        if not cls.__subclasses__():
            _take_place(cls, "from_bytes", staticmethod(cls._from_bytes))
        message: _M = cls._from_bytes(buffer, views=views)
        return message

    def serialize(self, buff: Writable) -> None:
        """genpy's :meth:`to_bytes`: write the bytes to a file-like object."""
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
        self.deserialize(data)
        arrays_to_numpy(self, numpy)
        return self

    # -- values -----------------------------------------------------------------------

    def to_dict(self, *, json: bool = False) -> dict[str, Any]:
        """The fields as plain values: dicts, lists, numbers, strings.

        Times become ``{"secs": ..., "nsecs": ...}`` and arrays become lists; ``uint8[]``
        and ``char[]`` become bytes. PyYAML writes and reads all of it, except that it
        knows only one kind of NaN.

        With ``json`` the values are those that every JSON parser takes, and nothing is
        lost on the way there and back. Bytes are in base64, as rosbridge sends them. What
        JSON has no number for is a string: ``"NaN"``, ``"Infinity"``, ``"-Infinity"``,
        and ``"NaN:fff8000000000000"`` for a NaN of other bits. Strings that are not UTF-8
        have lone surrogates, which :func:`json.dumps` writes as ``\\udc80`` to
        ``\\udcff`` unless ``ensure_ascii`` is turned off.
        """
        return to_dict(self, json=json)

    @classmethod
    def from_dict(cls: type[_M], values: Mapping[str, Any]) -> _M:
        """The reverse of both kinds of :meth:`to_dict`; missing fields keep their defaults.

        You can also give times as numbers of seconds, and arrays of numbers as buffers,
        which are not copied. Raises :class:`~aioros1.SerializationError` for unknown
        fields and values of the wrong shape; all else is checked when the message is
        serialized.
        """
        return from_dict(cls, values)

    def replace(self: _M, **changes: Any) -> _M:
        """A shallow copy with some fields changed.

        Raises :class:`AttributeError` for a name that is not a field.
        """
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
        return Message._reduce(self)

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

    class _AnyMessageType(type):
        def __getattr__(cls, name: str) -> Any: ...

    class AnyMessage(Message, metaclass=_AnyMessageType):
        """A message whose type is known at run time only; checkers let it have any field."""

        def __getattr__(self, name: str) -> Any: ...
        def __setattr__(self, name: str, value: Any) -> None: ...

else:
    AnyMessage = Message


def _unknown_field(cls: type[Message], name: str) -> NoReturn:
    known = ", ".join(cls.__slots__) or "none"
    raise AttributeError(f"{cls._type} has no field {name!r}; its fields: {known}")


def _take_place(cls: type[Message], name: str, function: Any) -> None:
    """Put a compiled function in the place of the base class's method that only calls it.

    Going through the method is a third of what it takes to encode a small message.
    """
    if name not in cls.__dict__ and "_type" in cls.__dict__:
        plain = getattr(function, "__func__", function)
        plain.__doc__ = getattr(Message, name).__doc__
        setattr(cls, name, function)


def _separate(cls: type[Message]) -> None:
    """Give a class that a user has derived from a message class a codec of its own.

    It decodes to itself then, and not to the class that it is derived from. Its fields are
    those of that class: ``__slots__`` names them, and not what the user puts beside them.
    """
    if "__slots__" in cls.__dict__:
        origin: Any = next(base for base in cls.__mro__ if "_type" in base.__dict__)
        cls.__slots__ = origin.__slots__
    for name in CODEC:
        setattr(cls, name, compiled(name))
    for base in cls.__mro__:
        if "_type" in base.__dict__ and "from_bytes" in base.__dict__:
            del base.from_bytes  # type: ignore[attr-defined]
