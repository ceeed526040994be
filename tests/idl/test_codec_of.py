"""The codec of a class as other packages are handed it."""

from __future__ import annotations

from typing import Any

import pytest

import aioros1
from aioros1.idl import MessageStore, load_action, load_msg, load_srv, spec_of
from aioros1.idl.codec import GENPY_NAMES, codec_of

SCAN = "string frame\nfloat32[] ranges\n"


@pytest.fixture
def scan() -> type[Any]:
    store = MessageStore()
    store.add_text("p/Scan", SCAN)
    return store.load_msg("p/Scan")


def test_encoders(scan: type[Any]) -> None:
    codec = codec_of(scan)
    message = scan(frame="laser", ranges=[1.0, 2.0])
    octets = message.to_bytes()
    frame = len(octets).to_bytes(4, "little") + octets
    assert codec.encode(message) == octets
    assert codec.frame(message) == frame
    assert b"".join(codec.frame_parts(message)) == frame
    with pytest.raises(aioros1.SerializationError, match=r"^frame: expected string"):
        codec.frame(scan(frame=5))


def test_decoders(scan: type[Any]) -> None:
    codec = codec_of(scan)
    message = scan(frame="laser", ranges=[1.0, 2.0])
    octets = message.to_bytes()
    around = b"before" + octets + b"behind"
    view = memoryview(around)
    stop = 6 + len(octets)
    assert codec.decode(around, 6, stop) == message
    assert codec.decode_view(view, 6, stop) == message
    shown = codec.decode_views(view, 6, stop)
    assert shown == message
    assert isinstance(shown.ranges, memoryview)
    with pytest.raises(aioros1.DeserializationError, match=r"p/Scan\.ranges"):
        codec.decode(around, 6, stop - 1)


@pytest.mark.parametrize(
    "name", ["encode", "frame", "frame_parts", "decode", "decode_view", "decode_views"]
)
def test_what_was_handed_out_is_what_stays(scan: type[Any], name: str) -> None:
    """A role keeps the compiled function: nothing quicker takes its place later on."""
    function = getattr(codec_of(scan), name)
    message = scan(frame="laser")
    for _ in range(3):
        scan.from_bytes(message.to_bytes())
    assert getattr(codec_of(scan), name) is function
    assert function.__code__.co_filename == "<codec of p/Scan>"


def test_bulk() -> None:
    assert codec_of(load_msg("sensor_msgs/Image")).has_bulk
    assert not codec_of(load_msg("geometry_msgs/Twist")).has_bulk
    assert repr(codec_of(load_msg("std_msgs/String"))) == "<codec of std_msgs/String>"


def test_specs() -> None:
    assert [field.name for field in spec_of(load_msg("std_msgs/String")).fields] == ["data"]
    assert spec_of(load_srv("std_srvs/SetBool")).request.fields[0].type == "bool"
    assert set(spec_of(load_action("actionlib_tutorials/Fibonacci")).messages) >= {"Goal"}


def test_the_names_of_genpy_are_there() -> None:
    message, service = load_msg("std_msgs/Header"), load_srv("std_srvs/SetBool")
    for name in GENPY_NAMES:
        assert hasattr(service if name.endswith("_class") else message, name)


class TestDerivedClasses:
    """Classes that users derive from message classes."""

    @pytest.mark.parametrize("is_used", [False, True], ids=["unused", "used"])
    def test_they_have_a_codec_of_their_own(self, scan: type[Any], is_used: bool) -> None:
        octets = scan(frame="laser").to_bytes() if is_used else b"\5\0\0\0laser\0\0\0\0"
        if is_used:
            scan.from_bytes(octets)
            codec_of(scan).decode(octets, 0, len(octets))

        class MyScan(scan):  # type: ignore[misc]
            def doubled(self) -> str:
                return str(self.frame * 2)

        message = MyScan(frame="laser")
        assert message.to_bytes() == codec_of(MyScan).frame(message)[4:] == octets
        assert codec_of(scan).frame(message)[4:] == octets
        decoded = (
            MyScan.from_bytes(octets),
            MyScan.from_bytes(octets, views=True),
            codec_of(MyScan).decode(octets, 0, len(octets)),
            MyScan().deserialize(octets),
        )
        for one in decoded:
            assert (type(one), one.doubled()) == (MyScan, "laserlaser")
        assert type(scan.from_bytes(octets)) is scan
        assert type(codec_of(scan).decode(octets, 0, len(octets))) is scan
        assert message == scan(frame="laser")
        assert repr(message).startswith("MyScan(frame='laser', ")

    @pytest.mark.parametrize("slots", [(), ("extra",), "extra"])
    def test_slots_of_their_own_are_no_fields(self, scan: type[Any], slots: Any) -> None:
        class MyScan(scan):  # type: ignore[misc]
            __slots__ = slots

        message = MyScan(frame="laser")
        if slots:
            message.extra = 5
        assert message != scan(frame="other")
        assert message == scan(frame="laser") == scan.from_bytes(message.to_bytes())
        assert MyScan.from_dict(message.to_dict()) == message.replace(frame="laser") == message
        assert repr(message).startswith("MyScan(frame='laser', ")

    def test_they_may_override_methods(self, scan: type[Any]) -> None:
        scan.from_bytes(scan(frame="x").to_bytes())

        class Loud(scan):  # type: ignore[misc]
            def to_bytes(self) -> bytes:
                self.frame = self.frame.upper()
                return bytes(super().to_bytes())

            @classmethod
            def from_bytes(cls, buffer: Any, *, views: bool = False) -> Any:
                message = super().from_bytes(buffer, views=views)
                message.frame += "!"
                return message

        class Louder(Loud):
            pass

        for cls in (Loud, Louder):
            for _ in range(2):
                message = cls.from_bytes(cls(frame="x").to_bytes())
                assert (type(message), message.frame) == (cls, "X!")
