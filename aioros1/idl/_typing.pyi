"""What the stubs of messages are written with; for checkers only, there is no such module."""

from array import array
from collections.abc import Iterator, Sequence
from typing import Any, Generic, Literal, Protocol, Self, TypeAlias, TypeVar, overload
from typing import SupportsFloat as _SupportsFloat
from typing import SupportsIndex as _SupportsIndex

from typing_extensions import Buffer

from aioros1.idl.message import Message as Message
from aioros1.idl.service import Action as Action
from aioros1.idl.service import Service as Service
from aioros1.time import Duration as Duration
from aioros1.time import Time as Time

_T = TypeVar("_T")
_T_co = TypeVar("_T_co", covariant=True)
_Got = TypeVar("_Got", covariant=True)
_Given = TypeVar("_Given", contravariant=True)

# -- what is accepted as the value of a field ------------------------------------------

class _NumPyBool(Protocol):
    def item(self) -> bool: ...

class _Listable(Protocol):
    """What becomes a list by itself: NumPy's arrays, which have no other name here."""
    def tolist(self) -> Any: ...

class _NoText(Protocol[_T_co]):
    """A sequence, but not a string: what strings contain are strings."""
    def __contains__(self, item: object, /) -> bool: ...
    def __iter__(self) -> Iterator[_T_co]: ...
    def __len__(self) -> int: ...
    @overload
    def __getitem__(self, index: _SupportsIndex, /) -> _T_co: ...
    @overload
    def __getitem__(self, index: slice, /) -> Sequence[_T_co]: ...

Int: TypeAlias = _SupportsIndex
Float: TypeAlias = _SupportsFloat | _SupportsIndex
Bool: TypeAlias = bool | Literal[0, 1] | _NumPyBool
Text: TypeAlias = str | bytes | bytearray

Octets: TypeAlias = Buffer | Sequence[Int] | _Listable
Ints: TypeAlias = Sequence[Int] | Buffer | _Listable
Floats: TypeAlias = Sequence[Float] | Buffer | _Listable
Bools: TypeAlias = Sequence[Bool] | _Listable
Texts: TypeAlias = _NoText[Text] | _Listable
Items: TypeAlias = Sequence[_T]

# -- attributes: one type is read, all that is accepted can be assigned ----------------

class _Attribute(Generic[_Got, _Given]):
    @overload
    def __get__(self, instance: None, owner: type, /) -> Self: ...
    @overload
    def __get__(self, instance: object, owner: type, /) -> _Got: ...
    def __set__(self, instance: object, value: _Given, /) -> None: ...

OctetArray: TypeAlias = _Attribute[bytes, Octets]
IntArray: TypeAlias = _Attribute[array[int], Ints]
FloatArray: TypeAlias = _Attribute[array[float], Floats]
BoolList: TypeAlias = _Attribute[list[bool], Bools]
TextList: TypeAlias = _Attribute[list[str], Texts]
ItemList: TypeAlias = _Attribute[list[_T], Items[_T]]
