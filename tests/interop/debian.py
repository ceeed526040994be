"""Which Debian package brings which program, and what to do when it is not there."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest

__all__ = [
    "PYTHON",
    "ROS_ENVIRONMENT",
    "environment",
    "require",
    "require_definitions",
    "require_python",
]

PYTHON = "/usr/bin/python3"
"""The interpreter that Debian's rospy belongs to."""

PYTHON_PACKAGES = Path("/usr/lib/python3/dist-packages")

PACKAGES = {
    "rosmaster": "python3-rosmaster",
    "roslaunch": "python3-roslaunch",
    "rostopic": "python3-rostopic",
    "rosnode": "python3-rosnode",
    "rosservice": "python3-rosservice",
    "rosparam": "python3-rosparam",
    "rosmsg": "python3-rosmsg",
    "rossrv": "python3-rosmsg",
    "rosbag": "python3-rosbag",
    "roswtf": "python3-roswtf",
    "/usr/share/sensor_msgs/msg/JointState.msg": "ros-sensor-msgs",
    "/usr/lib/rosout/rosout": "rosout",
    "/usr/lib/topic_tools/relay": "topic-tools",
    "/usr/lib/topic_tools/throttle": "topic-tools",
    "g++": "g++",
    PYTHON: "python3",
    "/usr/include/ros/ros.h": "libroscpp-dev",
    "/usr/include/std_msgs/String.h": "libstd-msgs-dev",
    "/usr/include/std_srvs/SetBool.h": "libstd-srvs-dev",
    "/usr/include/sensor_msgs/Image.h": "libsensor-msgs-dev",
    "/usr/include/geometry_msgs/Pose.h": "libgeometry-msgs-dev",
    "/usr/include/nav_msgs/Path.h": "libnav-msgs-dev",
}

PYTHON_MODULES = {
    "rospy": "python3-rospy",
    "std_msgs": "python3-std-msgs",
    "std_srvs": "python3-std-srvs",
    "sensor_msgs": "python3-sensor-msgs",
    "geometry_msgs": "python3-geometry-msgs",
    "nav_msgs": "python3-nav-msgs",
    "roscpp": "python3-roscpp-msg",
}

ROS_ENVIRONMENT = {
    "ROS_HOSTNAME": "localhost",
    "ROS_PACKAGE_PATH": "/usr/share",
    "ROS_ROOT": "/usr/share/ros",
    "ROS_DISTRO": "noetic",
}


def _missing(package: str, what: str) -> None:
    reason = f"{what} is not installed: apt-get install {package}"
    if os.environ.get("AIOROS1_REQUIRE_INTEROP") == "1":
        pytest.fail(reason)
    pytest.skip(reason)


def _system_path() -> str:
    # The programs start whatever `python3` they find first.
    return os.pathsep.join(["/usr/bin", "/bin", os.environ.get("PATH", "")])


def require(*programs: str) -> None:
    """Skip the test, or fail it where everything has to be installed."""
    for program in programs:
        if program.startswith("/"):
            found = Path(program).exists()
        else:
            found = shutil.which(program, path=_system_path()) is not None
        if not found:
            _missing(PACKAGES.get(program, "ros-core"), program)


def require_python(*modules: str) -> None:
    """As :func:`require`, for modules of Debian's own Python."""
    require(PYTHON)
    for module in modules:
        if not (PYTHON_PACKAGES / module).is_dir():
            _missing(PYTHON_MODULES.get(module, f"python3-{module.replace('_', '-')}"), module)


def require_definitions(package: str, debian_package: str) -> None:
    """As :func:`require`, for the definition files of a ROS package."""
    folder = Path("/usr/share") / package
    if not any((folder / kind).is_dir() for kind in ("msg", "srv", "action")):
        _missing(debian_package, f"the definitions of {package}")


def environment(master_uri: str, home: Path) -> dict[str, str]:
    """An environment in which only what is said here is known of ROS."""
    env = {
        key: value
        for key, value in os.environ.items()
        if not key.startswith(("ROS_", "PYTHON", "COV", "CMAKE_PREFIX"))
    }
    env.update(ROS_ENVIRONMENT)
    env["ROS_MASTER_URI"] = master_uri
    env["ROS_HOME"] = str(home)
    env["PATH"] = _system_path()
    env["PYTHONUNBUFFERED"] = "1"
    env["PYTHONDONTWRITEBYTECODE"] = "1"
    env["LC_ALL"] = "C.UTF-8"
    return env
