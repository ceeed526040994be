"""The definitions that come with the library."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from aioros1.idl import MessageStore
from aioros1.idl.paths import bundle

PACKAGES = [
    "actionlib_msgs",
    "geometry_msgs",
    "roscpp",
    "roscpp_tutorials",
    "rosgraph_msgs",
    "sensor_msgs",
    "std_msgs",
    "std_srvs",
    "trajectory_msgs",
]

# MD5 sums that every ROS 1 program sends.
KNOWN = {
    "actionlib_msgs/GoalStatusArray": "8b2b82f13216d0a8ea88bd3af735e619",
    "geometry_msgs/TransformStamped": "b5764a33bfeb3588febc2682852579b0",
    "geometry_msgs/Twist": "9f195f881246fdfa2798d1d3eebca84a",
    "rosgraph_msgs/Clock": "a9c97c1d230cfc112e270351a944ee47",
    "rosgraph_msgs/Log": "acffd30cd6b6de30f120938c17c593fb",
    "rosgraph_msgs/TopicStatistics": "10152ed868c5097a5e2e4a89d7daa710",
    "sensor_msgs/Image": "060021388200f6f0f447d0fcd9c64743",
    "sensor_msgs/JointState": "3066dcd76a6cfaef579bd0f34173e9fd",
    "sensor_msgs/LaserScan": "90c7ef2dc6895d81024acba2ac42f369",
    "sensor_msgs/PointCloud2": "1158d486dd51d683ce2f1be655c3c181",
    "std_msgs/Header": "2176decaecbce78abc3b96ef049fabed",
    "std_msgs/String": "992ce8a1687cec8c8bd883ec73ca41d1",
    "trajectory_msgs/JointTrajectory": "65b4f94a94d1ed67169da35a02f33d3f",
}
KNOWN_SERVICES = {
    "roscpp/GetLoggers": "32e97e85527d4678a8f9279894bb64b0",
    "roscpp/SetLoggerLevel": "51da076440d78ca1684d36c868df61ea",
    "roscpp_tutorials/TwoInts": "6a2e34150c00229791cc89ff309fff21",
    "std_srvs/Empty": "d41d8cd98f00b204e9800998ecf8427e",
    "std_srvs/SetBool": "09fb03525b03e7ea1fd3992bafd87e16",
    "std_srvs/Trigger": "937c9679a518e3a18d831e57125ea522",
}


@pytest.fixture(scope="module")
def store() -> MessageStore:
    return MessageStore([bundle()], parent=None)


def test_packages(store: MessageStore) -> None:
    assert store.packages() == PACKAGES


@pytest.mark.parametrize(("type_", "md5sum"), KNOWN.items())
def test_messages_have_the_sums_that_everybody_has(store, type_: str, md5sum: str) -> None:
    assert store.load_msg(type_)._md5sum == md5sum


@pytest.mark.parametrize(("type_", "md5sum"), KNOWN_SERVICES.items())
def test_services_have_the_sums_that_everybody_has(store, type_: str, md5sum: str) -> None:
    assert store.load_srv(type_)._md5sum == md5sum


def test_all_can_be_loaded_and_sent(store: MessageStore) -> None:
    classes = [store.load_msg(name) for pkg in PACKAGES for name in store.types(pkg)]
    for pkg in PACKAGES:
        for name in store.types(pkg, "srv"):
            service = store.load_srv(name)
            classes += [service.Request, service.Response]
    assert len(classes) > 100
    for cls in classes:
        octets = cls().to_bytes()
        assert cls.from_bytes(octets) == cls()
        assert len(octets) == cls._min_size


def test_files_hold_facts_and_no_comments() -> None:
    for path in Path(bundle()).rglob("*.*"):
        assert "#" not in path.read_text(), path


@pytest.mark.interop
def test_sums_and_constants_are_those_of_genpy(store: MessageStore, system_python) -> None:
    names = [name for pkg in PACKAGES for name in store.types(pkg)]
    script = """
import importlib, json, sys
answers = {}
for name in json.load(sys.stdin):
    package, _, short = name.partition("/")
    try:
        cls = getattr(importlib.import_module(package + ".msg"), short)
    except (ImportError, AttributeError):
        continue
    plain = {k: v for k, v in vars(cls).items() if k[0] != "_"}
    constants = {k: v for k, v in plain.items() if isinstance(v, (int, str, float))}
    answers[name] = [cls._md5sum, list(cls.__slots__), list(cls._slot_types), constants]
json.dump(answers, sys.stdout)
"""
    answers = json.loads(system_python(script, json.dumps(names)))
    assert len(answers) > 50
    for name, answer in answers.items():
        cls = store.load_msg(name)
        constants = {constant.name: constant.value for constant in cls._constants}
        assert [cls._md5sum, list(cls.__slots__), cls._slot_types, constants] == answer
