"""ROS's two time values: a point in time and a signed length of time.

Both are immutable, hashable and exact to the nanosecond. Seconds and nanoseconds are
whole numbers, as on the wire: a ``time`` is two unsigned 32-bit numbers, a ``duration``
two signed ones.
"""

from __future__ import annotations

import re
from datetime import UTC, datetime, timedelta
from operator import index
from time import time_ns
from typing import Any, ClassVar, Final, TypeVar, overload

from aioros1._public import public

__all__ = ["Duration", "Time", "raw_duration", "raw_time"]

_SECOND: Final = 1_000_000_000
_EPOCH: Final = datetime(1970, 1, 1, tzinfo=UTC)
_MICROSECOND: Final = timedelta(microseconds=1)
_new = object.__new__

_V = TypeVar("_V", bound="_TimeValue")


def _float_to_nsec(secs: float) -> int:
    """Seconds as a float, rounded to the nearest nanosecond."""
    whole = int(secs)
    return whole * _SECOND + round((secs - whole) * _SECOND)


def _ratio(value: Any) -> tuple[int, int] | None:
    """A number as the fraction that it is exactly; None if it is none.

    Also of those that are no subclasses of Python's own: NumPy's, whose whole numbers
    overflow in silence, and fractions.
    """
    if (whole := getattr(value, "__index__", None)) is not None:
        return whole(), 1
    if not hasattr(value, "__float__"):
        return None
    numerator, denominator = (
        value if hasattr(value, "as_integer_ratio") else float(value)
    ).as_integer_ratio()
    return int(numerator), int(denominator)


def _divide(numerator: int, denominator: int) -> int:
    """The nearest whole number, the even one of two that are as near."""
    if denominator < 0:
        numerator, denominator = -numerator, -denominator
    quotient, rest = divmod(numerator, denominator)
    return quotient + (2 * rest + (quotient & 1) > denominator)


# Fill and alignment, sign, width and thousands; precision; type: what Decimal formats like float.
_FIXED: Final = re.compile(
    r"((?:(?:[^0]?[<>=^])?[-+ ]?(?:[1-9]\d*)?|[-+ ]?0\d+),?)(\.\d+)?([fF%]?)", re.DOTALL
)


def _format(nsecs: int, spec: str) -> str:
    """Seconds as a float is formatted, but exact to the nanosecond in a fixed notation."""
    match = _FIXED.fullmatch(spec)
    if match is None or (match[2] and not match[3]):
        return format(nsecs / _SECOND, spec)  # significant digits, or an error
    # Imported here because few programs format times.
    from decimal import Context, Decimal, localcontext

    before, precision, kind = match.groups("")
    digits = precision or (".6" if kind else ".9")
    with localcontext(Context()):  # the caller's may round otherwise
        return format(Decimal(f"{nsecs}e-9"), f"{before}{digits}{kind or 'f'}")


class _TimeValue:
    """What the two have in common.

    The parts sit in slots of other names, behind read-only properties: with that,
    making one takes two plain stores (the decoder does it inline), where a
    ``__setattr__`` that refuses would have to be gone around at each store, and a
    tuple would be iterable, indexable and treated as an argument list by ``%``.
    """

    __slots__ = ("_nsecs", "_secs")
    _secs: int
    _nsecs: int
    _slot_types: ClassVar[list[str]] = ["int32", "int32"]

    def __init__(self, secs: int | float = 0, nsecs: int = 0) -> None:
        # Anything with __index__ is a whole number: NumPy's integers too.
        whole = getattr(secs, "__index__", None)
        if whole is not None:
            total = whole() * _SECOND + index(nsecs)
        elif nsecs:
            raise ValueError("nsecs cannot be given with a fraction of seconds")
        else:
            total = _float_to_nsec(float(secs + 0.0))  # float() alone would read strings
        self._secs, self._nsecs = divmod(total, _SECOND)

    @classmethod
    def _raw(cls: type[_V], secs: int, nsecs: int) -> _V:
        """The two numbers as they stand, not normalised: what a peer sent."""
        value = _new(cls)
        value._secs = secs
        value._nsecs = nsecs
        return value

    @classmethod
    def from_sec(cls: type[_V], secs: float) -> _V:
        """The value for a number of seconds, rounded to the nearest nanosecond."""
        return cls(secs)

    @classmethod
    def from_nsec(cls: type[_V], nsecs: int) -> _V:
        """The value for a whole number of nanoseconds."""
        return cls(0, nsecs)

    @property
    def secs(self) -> int:
        """The whole seconds."""
        return self._secs

    @property
    def nsecs(self) -> int:
        """The nanoseconds beyond :attr:`secs`.

        0 to 999,999,999, except in a value that a peer sent otherwise.
        """
        return self._nsecs

    def to_sec(self) -> float:
        """Seconds as a float (good to about 200 ns for present-day times)."""
        return self._secs + self._nsecs / 1e9

    def to_nsec(self) -> int:
        """All of it in nanoseconds, exactly."""
        return self._secs * _SECOND + self._nsecs

    def is_zero(self) -> bool:
        """Whether both parts are zero."""
        return self._secs == 0 and self._nsecs == 0

    def __bool__(self) -> bool:
        return self._secs != 0 or self._nsecs != 0

    def __repr__(self) -> str:
        return f"{type(self).__name__}(secs={self._secs}, nsecs={self._nsecs})"

    def __str__(self) -> str:
        total = self.to_nsec()
        secs, nsecs = divmod(abs(total), _SECOND)
        return f"{'-' if total < 0 else ''}{secs}.{nsecs:09d}"

    def __format__(self, spec: str) -> str:
        """Format the seconds like a float: ``f"{time:.2f}"``.

        The types ``f`` and ``%`` are exact to the nanosecond. Without a type and a precision,
        all nine decimals are shown, as in :func:`str`.
        """
        return _format(self.to_nsec(), spec) if spec else str(self)

    # Pickling and copying keep the parts as they stand, normalised or not.
    def __reduce__(self) -> tuple[Any, ...]:
        return _raw_value, (type(self), self._secs, self._nsecs)

    def __copy__(self: _V) -> _V:
        return self

    def __deepcopy__(self: _V, memo: dict[int, Any]) -> _V:
        return self


def _raw_value(cls: type[_V], secs: int, nsecs: int) -> _V:
    return cls._raw(secs, nsecs)


@public
class Time(_TimeValue):
    """A point in time: seconds and nanoseconds since the epoch (1970, UTC).

    ``Time(secs=0, nsecs=0)`` carries surplus nanoseconds over; ``secs`` may be a float
    when ``nsecs`` is not given. A time before the epoch is a :class:`ValueError`. A time
    after 2106 can be computed with, but has no form on the wire.
    """

    __slots__ = ()

    def __init__(self, secs: int | float = 0, nsecs: int = 0) -> None:
        super().__init__(secs, nsecs)
        if self._secs < 0:
            raise ValueError(f"a time before the epoch: {secs} s, {nsecs} ns")

    @classmethod
    def now(cls) -> Time:
        """This machine's time of day."""
        return cls(0, time_ns())

    @classmethod
    def from_datetime(cls, moment: datetime) -> Time:
        """The time of a :class:`~datetime.datetime`, exactly.

        It has to be aware of its time zone: :class:`ValueError` for a naive one, and for one
        before 1970.
        """
        if not isinstance(moment, datetime):
            raise TypeError(f"expected a datetime, got {moment!r:.200}")
        if moment.utcoffset() is None:
            raise ValueError(
                f"expected a datetime with a time zone, got {moment!r}: use "
                "datetime.now(timezone.utc), or moment.astimezone() if it is local time"
            )
        return cls(0, (moment - _EPOCH) // _MICROSECOND * 1000)

    def to_datetime(self) -> datetime:
        """The time as an aware :class:`~datetime.datetime` in UTC, to the nearest microsecond.

        Raises :class:`OverflowError` for a time after the year 9999.
        """
        return _EPOCH + timedelta(microseconds=_divide(self.to_nsec(), 1000))

    def to_time(self) -> float:
        """The same as :meth:`to_sec`: what :func:`time.time` would say."""
        return self.to_sec()

    def __add__(self, other: Duration) -> Time:
        if isinstance(other, Duration):
            return Time(0, self.to_nsec() + other.to_nsec())
        return NotImplemented

    __radd__ = __add__

    @overload
    def __sub__(self, other: Time) -> Duration: ...
    @overload
    def __sub__(self, other: Duration) -> Time: ...
    def __sub__(self, other: Time | Duration) -> Time | Duration:
        if isinstance(other, Time):
            return Duration(0, self.to_nsec() - other.to_nsec())
        if isinstance(other, Duration):
            return Time(0, self.to_nsec() - other.to_nsec())
        return NotImplemented

    def __eq__(self, other: object) -> bool:
        if isinstance(other, Time):
            return self.to_nsec() == other.to_nsec()
        return NotImplemented

    def __hash__(self) -> int:
        return hash(self.to_nsec())

    def __lt__(self, other: Time) -> bool:
        if isinstance(other, Time):
            return self.to_nsec() < other.to_nsec()
        return NotImplemented

    def __le__(self, other: Time) -> bool:
        if isinstance(other, Time):
            return self.to_nsec() <= other.to_nsec()
        return NotImplemented

    def __gt__(self, other: Time) -> bool:
        if isinstance(other, Time):
            return self.to_nsec() > other.to_nsec()
        return NotImplemented

    def __ge__(self, other: Time) -> bool:
        if isinstance(other, Time):
            return self.to_nsec() >= other.to_nsec()
        return NotImplemented


@public
class Duration(_TimeValue):
    """A signed length of time.

    ``Duration(secs=0, nsecs=0)`` carries surplus nanoseconds over, so that -1.5 s is
    ``secs=-2, nsecs=500000000``; ``secs`` may be a float when ``nsecs`` is not given.
    """

    __slots__ = ()

    @classmethod
    def from_timedelta(cls, delta: timedelta) -> Duration:
        """The duration of a :class:`~datetime.timedelta`, exactly."""
        if not isinstance(delta, timedelta):
            raise TypeError(f"expected a timedelta, got {delta!r:.200}")
        return cls(0, delta // _MICROSECOND * 1000)

    def to_timedelta(self) -> timedelta:
        """The duration as a :class:`~datetime.timedelta`, to the nearest microsecond.

        Raises :class:`OverflowError` for more than 999,999,999 days.
        """
        return timedelta(microseconds=_divide(self.to_nsec(), 1000))

    def __add__(self, other: Duration) -> Duration:
        if isinstance(other, Duration):
            return Duration(0, self.to_nsec() + other.to_nsec())
        return NotImplemented

    def __sub__(self, other: Duration) -> Duration:
        if isinstance(other, Duration):
            return Duration(0, self.to_nsec() - other.to_nsec())
        return NotImplemented

    def __neg__(self) -> Duration:
        return Duration(0, -self.to_nsec())

    def __pos__(self) -> Duration:
        return self

    def __abs__(self) -> Duration:
        return Duration(0, abs(self.to_nsec()))

    def __mul__(self, factor: float) -> Duration:
        """By a number: a duration, to the nearest nanosecond."""
        if (ratio := _ratio(factor)) is None:
            return NotImplemented
        return Duration(0, _divide(self.to_nsec() * ratio[0], ratio[1]))

    __rmul__ = __mul__

    @overload
    def __truediv__(self, other: Duration) -> float: ...
    @overload
    def __truediv__(self, other: float) -> Duration: ...
    def __truediv__(self, other: float | Duration) -> float | Duration:
        """By a number: a duration, to the nearest nanosecond. By a duration: the ratio."""
        if isinstance(other, Duration):
            return self.to_nsec() / other.to_nsec()
        if (ratio := _ratio(other)) is None:
            return NotImplemented
        return Duration(0, _divide(self.to_nsec() * ratio[1], ratio[0]))

    @overload
    def __floordiv__(self, other: Duration) -> int: ...
    @overload
    def __floordiv__(self, other: float) -> Duration: ...
    def __floordiv__(self, other: float | Duration) -> int | Duration:
        """By a number: a duration of whole seconds, as in rospy. By a duration: how often."""
        if isinstance(other, Duration):
            return self.to_nsec() // other.to_nsec()
        if (ratio := _ratio(other)) is None:
            return NotImplemented
        return Duration(self.to_nsec() * ratio[1] // (ratio[0] * _SECOND))

    def __mod__(self, other: Duration) -> Duration:
        if isinstance(other, Duration):
            return Duration(0, self.to_nsec() % other.to_nsec())
        return NotImplemented

    def __divmod__(self, other: Duration) -> tuple[int, Duration]:
        if isinstance(other, Duration):
            quotient, rest = divmod(self.to_nsec(), other.to_nsec())
            return quotient, Duration(0, rest)
        return NotImplemented

    def __eq__(self, other: object) -> bool:
        if isinstance(other, Duration):
            return self.to_nsec() == other.to_nsec()
        return NotImplemented

    def __hash__(self) -> int:
        return hash(self.to_nsec())

    def __lt__(self, other: Duration) -> bool:
        if isinstance(other, Duration):
            return self.to_nsec() < other.to_nsec()
        return NotImplemented

    def __le__(self, other: Duration) -> bool:
        if isinstance(other, Duration):
            return self.to_nsec() <= other.to_nsec()
        return NotImplemented

    def __gt__(self, other: Duration) -> bool:
        if isinstance(other, Duration):
            return self.to_nsec() > other.to_nsec()
        return NotImplemented

    def __ge__(self, other: Duration) -> bool:
        if isinstance(other, Duration):
            return self.to_nsec() >= other.to_nsec()
        return NotImplemented


# The two numbers as they stand: what a peer sent need not be normalised.
raw_time = Time._raw
raw_duration = Duration._raw
