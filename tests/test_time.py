"""Time and Duration."""

from __future__ import annotations

import copy
import decimal
import pickle
import re
import time
from datetime import UTC, date, datetime, timedelta, timezone
from fractions import Fraction
from typing import Any
from zoneinfo import ZoneInfo

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from aioros1.errors import SerializationError
from aioros1.idl import load_msg
from aioros1.time import Duration, Time

NANO = 1_000_000_000

times = st.integers(0, (1 << 32) * NANO - 1).map(Time.from_nsec)
durations = st.integers(-(1 << 31) * NANO, (1 << 31) * NANO - 1).map(Duration.from_nsec)


class TestConstruction:
    @pytest.mark.parametrize(
        ("arguments", "parts"),
        [
            ((), (0, 0)),
            ((5,), (5, 0)),
            ((1, 2), (1, 2)),
            ((1, NANO), (2, 0)),
            ((1, 2 * NANO + 3), (3, 3)),
            ((2, -1), (1, NANO - 1)),
            ((1.5,), (1, NANO // 2)),
            ((1.2,), (1, 200_000_000)),
            ((True,), (1, 0)),
            ((np.int32(3), np.uint8(4)), (3, 4)),
            ((np.float32(0.5),), (0, NANO // 2)),
        ],
    )
    @pytest.mark.parametrize("kind", [Time, Duration])
    def test_is_normalised(self, kind: Any, arguments: Any, parts: tuple[int, int]) -> None:
        value = kind(*arguments)
        assert (value.secs, value.nsecs) == parts

    @pytest.mark.parametrize(
        ("value", "parts"),
        [
            (Duration(-1), (-1, 0)),
            (Duration(0, -1), (-1, NANO - 1)),
            (Duration(-1.5), (-2, NANO // 2)),
            (Duration.from_sec(-0.25), (-1, 750_000_000)),
            (Duration.from_nsec(-NANO - 1), (-2, NANO - 1)),
        ],
    )
    def test_negative_durations(self, value: Duration, parts: tuple[int, int]) -> None:
        assert (value.secs, value.nsecs) == parts

    @pytest.mark.parametrize(
        "make",
        [
            lambda: Time(-1),
            lambda: Time(0, -1),
            lambda: Time.from_sec(-0.1),
            lambda: Time(1) - Duration(2),
            lambda: Time(1) + Duration(-2),
        ],
    )
    def test_there_is_no_time_before_the_epoch(self, make: Any) -> None:
        with pytest.raises(ValueError, match="before the epoch"):
            make()

    def test_bad_arguments(self) -> None:
        with pytest.raises(ValueError, match="nsecs cannot be given"):
            Time(1.5, 5)
        for bad in ("1", None, "x"):
            with pytest.raises(TypeError):
                Time(bad)  # type: ignore[arg-type]
        for bad_float in (float("nan"), float("inf")):
            with pytest.raises((ValueError, OverflowError)):
                Time(bad_float)
        with pytest.raises(TypeError):
            Time(1, 2.5)  # type: ignore[arg-type]

    def test_now(self) -> None:
        before = time.time_ns()
        now = Time.now()
        assert before <= now.to_nsec() <= time.time_ns()

    @given(st.integers(0, 10**19))
    def test_from_nsec_is_exact(self, nsec: int) -> None:
        assert Time.from_nsec(nsec).to_nsec() == nsec
        assert Duration.from_nsec(-nsec).to_nsec() == -nsec

    @given(times)
    def test_to_sec_and_back(self, value: Time) -> None:
        assert abs(Time.from_sec(value.to_sec()).to_nsec() - value.to_nsec()) < 500
        assert value.to_time() == value.to_sec()


class TestValues:
    @pytest.mark.parametrize("value", [Time(1, 2), Duration(-1, 2)])
    def test_cannot_be_changed(self, value: Any) -> None:
        for name in ("secs", "nsecs", "other"):
            with pytest.raises(AttributeError):
                setattr(value, name, 5)

    @pytest.mark.parametrize(
        "value", [Time(1, 2), Duration(-1, 2), Time._raw(1, 3 * NANO), Duration._raw(-1, -5)]
    )
    def test_survive_copying_and_pickling(self, value: Any) -> None:
        others = [copy.copy(value), copy.deepcopy(value)]
        others += [pickle.loads(pickle.dumps(value, p)) for p in range(pickle.HIGHEST_PROTOCOL + 1)]
        for other in others:
            assert type(other) is type(value)
            assert (other.secs, other.nsecs) == (value.secs, value.nsecs)

    def test_zero(self) -> None:
        for kind in (Time, Duration):
            assert kind().is_zero()
            assert not kind()
            assert kind(0, 1)
            assert not kind(1).is_zero()

    def test_texts(self) -> None:
        assert repr(Time(1, 2)) == "Time(secs=1, nsecs=2)"
        assert repr(Duration(-1.5)) == "Duration(secs=-2, nsecs=500000000)"
        assert eval(repr(Duration(-1.5))) == Duration(-1.5)
        assert str(Time(1, 2)) == "1.000000002"
        assert str(Duration(-1.5)) == "-1.500000000"
        assert str(Duration(0, -1)) == "-0.000000001"


class TestComparison:
    def test_a_time_is_no_duration(self) -> None:
        assert Time(1) != Duration(1)
        assert Duration(1) != Time(1)
        for compare in ("__lt__", "__le__", "__gt__", "__ge__"):
            assert getattr(Time(1), compare)(Duration(1)) is NotImplemented
            assert getattr(Duration(1), compare)(Time(1)) is NotImplemented
        with pytest.raises(TypeError):
            _ = Time(1) < Duration(1)  # type: ignore[operator]
        assert Time(1) != 1
        assert Time(1) != (1, 0)

    def test_is_of_the_whole(self) -> None:
        assert Time._raw(1, NANO) == Time(2)
        assert hash(Time._raw(1, NANO)) == hash(Time(2))
        assert Duration._raw(0, -1) == Duration(-1, NANO - 1)
        assert len({Time(1), Time(1.0), Time(0, NANO)}) == 1

    @pytest.mark.parametrize("values", [times, durations])
    def test_is_that_of_nanoseconds(self, values: Any) -> None:
        @given(values, values)
        def check(a: Any, b: Any) -> None:
            x, y = a.to_nsec(), b.to_nsec()
            assert (a < b, a <= b, a > b, a >= b, a == b, a != b) == (
                x < y, x <= y, x > y, x >= y, x == y, x != y,
            )  # fmt: skip

        check()


class TestArithmetic:
    @given(times, durations)
    def test_time_and_duration(self, t: Time, d: Duration) -> None:
        if t.to_nsec() + d.to_nsec() >= 0:
            later = t + d
            assert type(later) is Time
            assert later.to_nsec() == t.to_nsec() + d.to_nsec()
            assert d + t == later
            assert later - d == t
            assert later - t == d

    @given(durations, durations)
    def test_durations(self, a: Duration, b: Duration) -> None:
        assert (a + b).to_nsec() == a.to_nsec() + b.to_nsec()
        assert (a - b).to_nsec() == a.to_nsec() - b.to_nsec()
        assert (-a).to_nsec() == -a.to_nsec()
        assert +a is a
        assert abs(a).to_nsec() == abs(a.to_nsec())
        if b:
            assert a // b == a.to_nsec() // b.to_nsec()
            assert a / b == pytest.approx(a.to_nsec() / b.to_nsec())
            assert (a % b).to_nsec() == a.to_nsec() % b.to_nsec()
            assert divmod(a, b) == (a // b, a % b)

    @given(durations, st.integers(-1000, 1000))
    def test_whole_numbers_are_exact(self, d: Duration, n: int) -> None:
        assert (d * n).to_nsec() == (n * d).to_nsec() == d.to_nsec() * n
        if n:
            assert abs((d / n).to_nsec() * n - d.to_nsec()) * 2 <= abs(n)

    def test_numbers(self) -> None:
        assert Duration(1) * 1.5 == Duration(1, NANO // 2)
        assert 0.5 * Duration(1) == Duration(0, NANO // 2)
        assert Duration(1) * np.float64(2) == Duration(2)
        assert Duration(3) / 2 == Duration(1, NANO // 2)
        assert Duration(3) / 1.5 == Duration(2)
        # To whole seconds, as in rospy.
        assert Duration(7.5) // 2 == Duration(3)
        assert Duration(-7.5) // 2 == Duration(-4)
        assert Duration(10) // 2.5 == Duration(4)

    @pytest.mark.parametrize(
        "do",
        [
            lambda: Time(1) + Time(1),
            lambda: Time(1) + 1,
            lambda: 1 + Time(1),
            lambda: Time(1) - 1,
            lambda: Time(1) * 2,
            lambda: Duration(1) - Time(1),
            lambda: Duration(1) + 1,
            lambda: Duration(1) - 1,
            lambda: Duration(1) * Duration(1),
            lambda: Duration(1) * "2",
            lambda: Duration(1) / "2",
            lambda: Duration(1) // "2",
            lambda: Duration(1) % 2,
            lambda: divmod(Duration(1), 2),
        ],
    )
    def test_what_makes_no_sense(self, do: Any) -> None:
        with pytest.raises(TypeError):
            do()

    def test_division_by_zero(self) -> None:
        for zero in (0, 0.0, Duration()):
            with pytest.raises(ZeroDivisionError):
                Duration(1) / zero
            with pytest.raises(ZeroDivisionError):
                Duration(1) // zero


class TestExactness:
    """Against fractions, which round nothing."""

    @given(st.floats(0, 2**32, exclude_max=True))
    def test_from_sec_is_the_nearest_nanosecond(self, secs: float) -> None:
        for value in (Time.from_sec(secs), Duration.from_sec(-secs), Time(secs)):
            error = abs(Fraction(value.to_nsec(), NANO)) - Fraction(secs)
            assert abs(error) * NANO <= Fraction(1, 2) + Fraction(1, 10**6)

    @given(st.integers(0, 2**32 - 1))
    def test_from_sec_of_whole_seconds(self, secs: int) -> None:
        assert Time.from_sec(secs).to_nsec() == Time.from_sec(float(secs)).to_nsec() == secs * NANO

    def test_from_sec_of_short_floats(self) -> None:
        tenth = np.float32(0.1)
        assert Duration.from_sec(tenth) == Duration(tenth) == Duration(0, 100_000_001)

    @given(durations, st.floats(-1e6, 1e6))
    def test_times_and_by_a_float(self, d: Duration, number: float) -> None:
        assert (d * number).to_nsec() == round(d.to_nsec() * Fraction(number))
        if number and abs(number) > 1e-6:
            assert (d / number).to_nsec() == round(d.to_nsec() / Fraction(number))
            assert (d // number).to_nsec() == d.to_nsec() // (Fraction(number) * NANO) * NANO

    @given(durations)
    def test_one_changes_nothing(self, d: Duration) -> None:
        for one in (1, 1.0, True, np.int64(1), np.float64(1), Fraction(1)):
            assert d * one == d / one == d

    @given(durations, st.integers(-(2**31), 2**31 - 1))
    def test_numbers_of_numpy_do_not_overflow(self, d: Duration, n: int) -> None:
        assert d * np.int64(n) == d * np.int32(n) == d * n
        if n:
            assert d / np.int32(n) == d / n
            assert d // np.int32(n) == d // n

    @pytest.mark.parametrize("bad", [float("nan"), float("inf")])
    def test_numbers_that_are_none(self, bad: float) -> None:
        with pytest.raises((ValueError, OverflowError)):
            Duration(1) * bad
        with pytest.raises((ValueError, OverflowError)):
            Duration(1) / bad

    @given(times, durations)
    def test_equal_ones_have_one_hash(self, t: Time, d: Duration) -> None:
        assert hash(Time(t.secs, t.nsecs)) == hash(t)
        assert hash(Duration(d.secs + 1, d.nsecs - NANO)) == hash(d)
        assert 0 <= d.nsecs < NANO
        assert d.secs * NANO + d.nsecs == d.to_nsec()

    @pytest.mark.parametrize(
        "value", [Time(2**32), Duration(2**31), Duration(-(2**31)) - Duration(0, 1)]
    )
    def test_what_has_no_form_on_the_wire_is_refused_there(self, value: Any) -> None:
        cls = load_msg(f"std_msgs/{type(value).__name__}")
        with pytest.raises(SerializationError, match="data"):
            cls(data=value).to_bytes()

    @given(times, durations)
    def test_what_has_one_survives_it(self, t: Time, d: Duration) -> None:
        for value in (t, d):
            cls = load_msg(f"std_msgs/{type(value).__name__}")
            assert cls.from_bytes(cls(data=value).to_bytes()).data == value


# Thousands of a second in powers of two: floats that are exactly whole nanoseconds.
exact = st.integers(-(2**40), 2**40).map(lambda n: n * 1_953_125)
specs = st.builds(
    "{}{}{}{}{}".format,
    st.sampled_from(["", "<", ">", "^", "=", "*<", "->", ",^", "0=", "\n>", "é<"]),
    st.sampled_from(["", "+", "-", " "]),
    st.sampled_from(["", "0", "5", "012", "30"]),
    st.sampled_from(["", ",", "_"]),
    st.sampled_from([".0f", ".1f", ".2f", ".9f", ".12F", "f", ".1%", "%", ".3e", ".4g", ".3"]),
)


class TestFormat:
    @given(exact, specs)
    def test_as_floats_are_formatted(self, nsecs: int, spec: str) -> None:
        value = Duration.from_nsec(nsecs)
        assert format(value, spec) == format(nsecs / NANO, spec)
        if nsecs >= 0:
            assert format(Time.from_nsec(nsecs), spec) == format(value, spec)

    @given(times, durations, st.sampled_from(["", ".9f", ".12f", ">40", "*=+40,.9f"]))
    def test_to_the_nanosecond(self, t: Time, d: Duration, spec: str) -> None:
        for value in (t, d):
            text = format(value, spec).strip().replace("*", "").replace(",", "")
            assert Fraction(text) == Fraction(value.to_nsec(), NANO)

    @given(times, st.integers(0, 9))
    def test_to_the_nearest_of_what_is_shown(self, t: Time, digits: int) -> None:
        shown = Fraction(f"{t:.{digits}f}")
        assert shown == round(Fraction(t.to_nsec(), NANO), digits)

    def test_examples(self) -> None:
        t = Time(1_700_000_000, 123_456_789)
        assert f"{t}" == str(t) == f"{t:>}" == "1700000000.123456789"
        assert f"{t:.2f}" == "1700000000.12"
        assert f"{t:,.0f} s" == "1,700,000,000 s"
        assert f"{Duration(-0.004):+08.2f}" == "-0000.00"
        d = Duration(1.5)
        assert f"{d:>6.1f}|{d:e}|{d:g}" == "   1.5|1.500000e+00|1.5"

    @pytest.mark.parametrize("spec", ["d", "s", "x", "%H:%M", "..2f", ".f", "5.5.5f", "💥💥"])
    def test_what_floats_refuse(self, spec: str) -> None:
        with pytest.raises(ValueError, match="ormat") as wrong:
            format(1.0, spec)
        with pytest.raises(ValueError, match=re.escape(str(wrong.value))):
            format(Time(1), spec)

    def test_the_callers_decimal_context_makes_no_difference(self) -> None:
        with decimal.localcontext(decimal.Context(prec=3, rounding=decimal.ROUND_UP)):
            assert f"{Time(12345, 123456789):.2f}" == "12345.12"


zones = st.sampled_from([UTC, timezone(timedelta(hours=-9, minutes=-30)), ZoneInfo("Europe/Rome")])
moments = st.datetimes(datetime(1970, 1, 2), datetime(9999, 12, 30), timezones=zones)
deltas = st.timedeltas()


class TestDatetime:
    @given(moments)
    def test_a_datetime_survives(self, moment: datetime) -> None:
        t = Time.from_datetime(moment)
        assert t.to_datetime() == moment.astimezone(UTC)
        assert t.to_datetime().tzinfo is UTC
        assert t.nsecs % 1000 == 0
        assert abs(t.to_sec() - moment.timestamp()) < 1e-4

    @given(times)
    def test_a_time_is_rounded_to_the_nearest_microsecond(self, t: Time) -> None:
        moment = t.to_datetime()
        assert moment.utcoffset() == timedelta(0)
        back = Time.from_datetime(moment)
        assert abs((back - t).to_nsec()) <= 500
        assert Time.from_datetime(back.to_datetime()) == back

    @given(deltas)
    def test_a_timedelta_survives(self, delta: timedelta) -> None:
        assert Duration.from_timedelta(delta).to_timedelta() == delta

    @given(durations)
    def test_a_duration_is_rounded_to_the_nearest_microsecond(self, d: Duration) -> None:
        back = Duration.from_timedelta(d.to_timedelta())
        assert abs((back - d).to_nsec()) <= 500
        assert (-d).to_timedelta() == -d.to_timedelta()

    def test_differences_agree(self) -> None:
        first, second = datetime(2026, 3, 29, 1, tzinfo=UTC), datetime(2026, 3, 30, tzinfo=UTC)
        difference = Time.from_datetime(second) - Time.from_datetime(first)
        assert difference.to_timedelta() == second - first

    def test_an_hour_that_comes_twice(self) -> None:
        rome = ZoneInfo("Europe/Rome")
        first, second = (datetime(2026, 10, 25, 2, 30, tzinfo=rome, fold=fold) for fold in (0, 1))
        assert Time.from_datetime(second) - Time.from_datetime(first) == Duration(3600)

    def test_what_is_refused(self) -> None:
        with pytest.raises(ValueError, match=r"expected a datetime with a time zone, got datetime"):
            Time.from_datetime(datetime(2026, 1, 1))
        with pytest.raises(ValueError, match="before the epoch"):
            Time.from_datetime(datetime(1969, 12, 31, tzinfo=UTC))
        with pytest.raises(OverflowError):
            Time(1 << 50).to_datetime()
        with pytest.raises(OverflowError):
            Duration(1 << 60).to_timedelta()
        for wrong in (1.5, date(2026, 1, 1), None, "2026-01-01", Time(1)):
            with pytest.raises(TypeError, match="expected a datetime, got"):
                Time.from_datetime(wrong)  # type: ignore[arg-type]
            with pytest.raises(TypeError, match="expected a timedelta, got"):
                Duration.from_timedelta(wrong)  # type: ignore[arg-type]
