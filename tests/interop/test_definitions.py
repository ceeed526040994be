"""Definitions as Debian's tools print them, and as the package path finds them."""

from __future__ import annotations

from pathlib import Path

import pytest

import aioros1
from aioros1.idl.paths import bundle

from . import debian
from .world import World

SHARE = Path("/usr/share")
ON_DISK = ("sensor_msgs/JointState", "sensor_msgs/CameraInfo", "geometry_msgs/TwistStamped")


@pytest.mark.parametrize(
    ("tool", "name"),
    [
        ("rosmsg", "sensor_msgs/JointState"),
        ("rosmsg", "geometry_msgs/PoseWithCovarianceStamped"),
        ("rossrv", "std_srvs/SetBool"),
        ("rossrv", "sensor_msgs/SetCameraInfo"),
    ],
)
async def test_the_md5_that_the_tools_print(under_rosmaster: World, tool: str, name: str) -> None:
    load = aioros1.load_msg if tool == "rosmsg" else aioros1.load_srv
    result = await under_rosmaster.run(tool, "md5", name)
    assert result.stdout.strip() == load(name)._md5sum


def test_definitions_of_the_package_path_go_first(monkeypatch: pytest.MonkeyPatch) -> None:
    """With ROS_PACKAGE_PATH set as on a ROS system, its files make the same types."""
    debian.require("/usr/share/sensor_msgs/msg/JointState.msg")
    own = aioros1.MessageStore([bundle()], parent=None)
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(SHARE))
    store = aioros1.MessageStore()
    assert store.find("sensor_msgs/JointState") == SHARE / "sensor_msgs/msg/JointState.msg"
    assert {name: store.load_msg(name)._md5sum for name in ON_DISK} == {
        name: own.load_msg(name)._md5sum for name in ON_DISK
    }
