"""Values that fit although they do not look like it, and objects that make trouble."""

from __future__ import annotations

from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from types import SimpleNamespace
from typing import Any
from unittest.mock import Mock

from aioros1.idl import Message
from aioros1.time import Time

try:
    import numpy as np
except ImportError:  # without it there are only fewer kinds of values
    np = None  # type: ignore[assignment]

__all__ = ["WILD", "Hostile", "Index", "Items", "Stamp", "Text", "np"]

# -- values of an unusual kind that fit all the same -----------------------------------


class Index:
    """A whole number by its ``__index__`` alone."""

    def __init__(self, number: int) -> None:
        self.number = number

    def __index__(self) -> int:
        return self.number


class Text(str):
    __slots__ = ()


class Items(list):  # type: ignore[type-arg]
    pass


class Stamp:
    """A time of another library."""

    def __init__(self, secs: int, nsecs: int) -> None:
        self.secs, self.nsecs = secs, nsecs


# -- objects that are out to make trouble ----------------------------------------------


class Hostile:
    """Every protocol that an encoder may use, each ending in an exception of its own."""

    def __index__(self) -> int:
        raise ZeroDivisionError

    def __float__(self) -> float:
        raise KeyError("float")

    def __len__(self) -> int:
        raise RuntimeError("len")

    def __iter__(self) -> Any:
        raise AssertionError("iter")

    def __getitem__(self, item: Any) -> Any:
        raise OSError("getitem")

    def __repr__(self) -> str:
        raise ValueError("repr")

    def __eq__(self, other: object) -> bool:
        raise ArithmeticError("eq")

    def __bytes__(self) -> bytes:
        raise LookupError("bytes")

    __hash__ = None  # type: ignore[assignment]

    def tolist(self) -> Any:
        raise NotImplementedError("tolist")

    @property
    def secs(self) -> int:
        raise RuntimeError("secs")

    @property
    def typecode(self) -> str:
        raise RuntimeError("typecode")


class Liar:
    """Numbers and sizes that are no numbers, or not true."""

    secs = "1"
    nsecs = None

    def __index__(self) -> Any:
        return "one"

    def __float__(self) -> Any:
        return "one"

    def tolist(self) -> Any:
        return 5


class LongList(list):  # type: ignore[type-arg]
    def __len__(self) -> int:
        return 1 << 40


def _released() -> memoryview:
    view = memoryview(b"abc")
    view.release()
    return view


def _circular() -> list[Any]:
    items: list[Any] = []
    items.append(items)
    return items


def _nested_lists() -> list[Any]:
    items: list[Any] = []
    for _ in range(3000):
        items = [items]
    return items


WILD: list[Callable[[], Any]] = [
    Hostile,
    Liar,
    _released,
    _circular,
    _nested_lists,
    object,
    lambda: Message,
    lambda: Hostile,
    lambda: [Hostile()],
    lambda: (Liar(), 1),
    lambda: LongList([1, 2]),
    lambda: range(10**18),
    lambda: range(10**30),
    lambda: iter([1]),
    lambda: (x for x in [1]),
    lambda: Mock(spec=str),
    lambda: Mock(spec=bytes),
    lambda: Mock(spec=list),
    lambda: Mock(spec=Time),
    lambda: SimpleNamespace(secs=1 << 40, nsecs=1),
    lambda: SimpleNamespace(secs=1.5, nsecs=1),
    lambda: memoryview(bytes(6)).cast("B", (2, 3)),
    lambda: memoryview(b"abc").cast("c"),
    lambda: memoryview(b"ab").cast("?"),
    lambda: 10**5000,
    lambda: "\ud800" * 200,
    lambda: [10**5000],
    lambda: complex(1, 2),
    lambda: Decimal("sNaN"),
    lambda: Decimal(5),
    lambda: Fraction(1, 3),
    lambda: NotImplemented,
    lambda: bytearray(3),
    lambda: {1: 2}.keys(),
    lambda: float("nan"),
]
if np is not None:
    WILD += [
        lambda: np.zeros((2, 2)),
        lambda: np.array(1),
        lambda: np.array([1, "a"], object),
        lambda: np.array([Hostile()], object),
        lambda: np.ma.masked,
        lambda: np.ma.masked_array([1, 2], [0, 1]),
        lambda: np.zeros(2, "M8[s]"),
        lambda: np.zeros(2, [("a", "i4")]),
        lambda: np.array(["a", "b"]),
        lambda: np.array([b"a"]),
        lambda: np.float16(1),
        lambda: np.zeros(3, np.float16),
        lambda: np.zeros(2, bool),
    ]
