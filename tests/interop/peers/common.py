"""What the rospy peers share: one JSON object a line, and messages as plain values."""

import json
import sys
import zlib

import genpy
import roslib.message


def say(**values):
    sys.stdout.write(json.dumps(values) + "\n")
    sys.stdout.flush()


def plain(value):
    """A message as JSON can hold it; bytes by length and checksum."""
    if isinstance(value, genpy.Message):
        return {name: plain(getattr(value, name)) for name in value.__slots__}
    if isinstance(value, (genpy.Time, genpy.Duration)):
        return [value.secs, value.nsecs]
    if isinstance(value, bytes):
        return {"length": len(value), "crc": zlib.crc32(value)}
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    return value


def message_class(name):
    found = roslib.message.get_message_class(name)
    assert found is not None, name
    return found


def service_class(name):
    found = roslib.message.get_service_class(name)
    assert found is not None, name
    return found
