"""Beside genpy, in one process: its classes, instances and octets.

The scripts run in the system's Python, which has genpy, with this library on its path.
"""

from __future__ import annotations

from pathlib import Path

import pytest

import aioros1.idl

ROOT = Path(aioros1.idl.__file__).parent.parent.parent

PRELUDE = f"""
import io, sys, types
sys.path.insert(0, {str(ROOT)!r})
package = types.ModuleType("aioros1")  # its own __init__ needs more than is installed here
package.__path__ = [{str(ROOT / "aioros1")!r}]
sys.modules["aioros1"] = package
import genpy
from aioros1.idl import MessageStore, convert, load_msg, load_srv
import geometry_msgs.msg, sensor_msgs.msg, std_msgs.msg, std_srvs.srv, rosgraph_msgs.msg
import trajectory_msgs.msg, roscpp.msg, roscpp.srv, sensor_msgs.srv

def octets(message):
    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()

def classes():
    for module in (geometry_msgs.msg, sensor_msgs.msg, std_msgs.msg, rosgraph_msgs.msg,
                   trajectory_msgs.msg, roscpp.msg, roscpp.srv, std_srvs.srv, sensor_msgs.srv):
        for name in dir(module):
            cls = getattr(module, name)
            if isinstance(cls, type) and issubclass(cls, genpy.Message):
                yield cls
"""

RANDOM = """
import math, random
from aioros1.idl.builtin_types import BUILTINS

def one(base, dice):
    if base not in BUILTINS:
        package, name = base.split("/")
        return fill(getattr(__import__(package + ".msg").msg, name)(), dice)
    kind = BUILTINS[base]
    if kind.kind == "int":
        return dice.choice([kind.low, kind.high, 1])
    if kind.kind == "float":
        return dice.choice([0.0, -0.0, math.inf, -1.5])
    if kind.kind == "bool":
        return dice.random() < 0.5
    if kind.kind == "string":
        return dice.choice(["", "abc", "h\\xe9llo", "a\\0b", 'q"uo\\\\te'])
    if kind.kind == "time":
        return genpy.Time(dice.choice([0, 2**32 - 1]), dice.randrange(10**9))
    return genpy.Duration(dice.choice([-2**31, 2**31 - 1]), dice.randrange(10**9))

def fill(message, dice):
    for name, type_ in zip(message.__slots__, message._slot_types):
        base, bracket, length = type_.partition("[")
        if not bracket:
            value = one(base, dice)
        else:
            count = int(length[:-1]) if length != "]" else dice.choice([0, 1, 3])
            value = [one(base, dice) for _ in range(count)]
            if base in ("uint8", "char"):
                value = bytes(value)
        setattr(message, name, value)
    return message
"""


def check(system_python, script: str) -> None:
    assert system_python(PRELUDE + script + "\nprint('done')").strip() == "done"


pytestmark = pytest.mark.interop


def test_definitions_defaults_and_texts(system_python) -> None:
    check(
        system_python,
        """
count = 0
for cls in classes():
    ours = MessageStore().add_definition(cls._type, cls._full_text)
    assert (ours._type, ours._md5sum, ours._full_text) == (cls._type, cls._md5sum, cls._full_text)
    assert list(ours.__slots__) == list(cls.__slots__), cls
    assert ours._slot_types == list(cls._slot_types), cls
    assert ours._has_header == cls._has_header
    assert ours().to_bytes() == octets(cls()), cls
    assert str(ours()) == str(cls()), cls
    count += 1
assert count > 100
""",
    )


def test_octets_and_texts_of_random_messages(system_python) -> None:
    check(
        system_python,
        RANDOM
        + """
dice = random.Random(1)
for cls in classes():
    ours = MessageStore().resolve_msg(cls)
    for _ in range(3):
        theirs = fill(cls(), dice)
        wire = octets(theirs)
        assert ours._encode(theirs) == wire, cls  # an instance of theirs
        assert b"".join(ours._frame_parts(theirs))[4:] == wire
        back = ours.from_bytes(wire)
        assert back.to_bytes() == wire
        assert back == theirs == cls().deserialize(back.to_bytes())
        assert str(back) == str(cls().deserialize(wire)), (str(back), str(theirs))
""",
    )


def test_classes_and_instances_are_taken_for_ours(system_python) -> None:
    check(
        system_python,
        """
store = MessageStore()
String = store.resolve_msg(std_msgs.msg.String)
assert String is load_msg("std_msgs/String")
theirs = std_msgs.msg.String("hi")
assert convert(String, theirs) is theirs
Header = load_msg("std_msgs/Header")
assert Header(1, genpy.Time(2, 3), "f").to_bytes() == octets(
    std_msgs.msg.Header(1, genpy.Time(2, 3), "f"))
assert store.resolve_srv(std_srvs.srv.SetBool) is load_srv("std_srvs/SetBool")
Loggers = MessageStore(parent=None).resolve_srv(roscpp.srv.GetLoggers)
assert Loggers._md5sum == roscpp.srv.GetLoggers._md5sum
""",
    )


def test_our_messages_are_taken_by_their_methods(system_python) -> None:
    check(
        system_python,
        """
Pose = load_msg("geometry_msgs/Pose")
theirs = geometry_msgs.msg.PoseStamped()
theirs.pose = Pose()
theirs.pose.position.x = 2.5
assert load_msg("geometry_msgs/PoseStamped").from_bytes(octets(theirs)).pose.position.x == 2.5
""",
    )
