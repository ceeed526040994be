"""The messages of the codec benchmark: a few variants of each, as a robot would send them.

A stream of messages is not the same message again and again: numbers, stamps and sequence
numbers differ from one to the next, and names stay. That is ``stream``. ``varied`` changes
the length of every string, and the number of elements of most arrays, each time: the worst
case for a codec that learns from what it saw.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from typing import Any

__all__ = ["TYPES", "make_messages"]

VARIANTS = 8
VARIED = 200
"""Variants of small messages with ``varied``: more than anything could be learned of."""

TYPES = {
    "String": "std_msgs/String",
    "Twist": "geometry_msgs/Twist",
    "TransformStamped": "geometry_msgs/TransformStamped",
    "Odometry": "nav_msgs/Odometry",
    "JointState": "sensor_msgs/JointState",
    "Imu": "sensor_msgs/Imu",
    "LaserScan": "sensor_msgs/LaserScan",
    "TFMessage x20": "tf2_msgs/TFMessage",
    "MarkerArray x50": "visualization_msgs/MarkerArray",
    "DiagnosticArray": "diagnostic_msgs/DiagnosticArray",
    "PointCloud2 1 MB": "sensor_msgs/PointCloud2",
    "Image 6.2 MB": "sensor_msgs/Image",
}


def make_messages(row: str, *, varied: bool) -> list[dict[str, Any]]:
    """The variants of one row of :data:`TYPES`, as ``from_dict`` takes them."""
    world = _World(varied)
    make: Callable[[], dict[str, Any]] = {
        "String": world.string,
        "Twist": world.twist,
        "TransformStamped": lambda: world.transform("odom", "base_link"),
        "Odometry": world.odometry,
        "JointState": world.joint_state,
        "Imu": world.imu,
        "LaserScan": world.laser_scan,
        "TFMessage x20": world.tf,
        "MarkerArray x50": world.markers,
        "DiagnosticArray": world.diagnostics,
        "PointCloud2 1 MB": world.point_cloud,
        "Image 6.2 MB": world.image,
    }[row]
    number = VARIED if varied and "MB" not in row else VARIANTS
    return [make() for _ in range(number)]


class _World:
    """Makes up messages; each call gives the next one of the stream."""

    def __init__(self, varied: bool) -> None:
        self.varied = varied
        self.random = random.Random(1)
        self.seq = 1000

    def name(self, text: str) -> str:
        return text + "_" * self.random.randrange(20) if self.varied else text

    def count(self, number: int) -> int:
        return self.random.randrange(number // 2, number * 3 // 2) if self.varied else number

    def floats(self, number: int) -> list[float]:
        return [self.random.uniform(-10, 10) for _ in range(number)]

    def stamp(self) -> dict[str, int]:
        return {"secs": 1_700_000_000 + self.seq // 100, "nsecs": self.random.randrange(10**9)}

    def header(self, frame: str) -> dict[str, Any]:
        self.seq += 1
        return {"seq": self.seq, "stamp": self.stamp(), "frame_id": self.name(frame)}

    def vector(self) -> dict[str, float]:
        return dict(zip("xyz", self.floats(3), strict=True))

    def quaternion(self) -> dict[str, float]:
        return dict(zip("xyzw", self.floats(4), strict=True))

    def pose(self) -> dict[str, Any]:
        return {"position": self.vector(), "orientation": self.quaternion()}

    def twist(self) -> dict[str, Any]:
        return {"linear": self.vector(), "angular": self.vector()}

    def string(self) -> dict[str, Any]:
        self.seq += 1
        return {"data": self.name(f"hello world, this is no. {self.seq:06}")}

    def transform(self, parent: str, child: str) -> dict[str, Any]:
        return {
            "header": self.header(parent),
            "child_frame_id": self.name(child),
            "transform": {"translation": self.vector(), "rotation": self.quaternion()},
        }

    def odometry(self) -> dict[str, Any]:
        return {
            "header": self.header("odom"),
            "child_frame_id": self.name("base_link"),
            "pose": {"pose": self.pose(), "covariance": self.floats(36)},
            "twist": {"twist": self.twist(), "covariance": self.floats(36)},
        }

    def joint_state(self) -> dict[str, Any]:
        number = self.count(6)
        return {
            "header": self.header("base_link"),
            "name": [self.name(f"arm_joint_{i}") for i in range(number)],
            "position": self.floats(number),
            "velocity": self.floats(number),
            "effort": self.floats(number),
        }

    def imu(self) -> dict[str, Any]:
        return {
            "header": self.header("imu_link"),
            "orientation": self.quaternion(),
            "orientation_covariance": self.floats(9),
            "angular_velocity": self.vector(),
            "angular_velocity_covariance": self.floats(9),
            "linear_acceleration": self.vector(),
            "linear_acceleration_covariance": self.floats(9),
        }

    def laser_scan(self) -> dict[str, Any]:
        number = self.count(1080)
        return {
            "header": self.header("laser"),
            "angle_min": -2.35,
            "angle_max": 2.35,
            "angle_increment": 0.00436,
            "range_max": 30.0,
            "ranges": self.floats(number),
            "intensities": self.floats(number),
        }

    def tf(self) -> dict[str, Any]:
        count = self.count(20)
        return {"transforms": [self.transform("base_link", f"link_{i}") for i in range(count)]}

    def marker(self, number: int) -> dict[str, Any]:
        return {
            "header": self.header("map"),
            "ns": self.name("obstacles"),
            "id": number,
            "type": 2,
            "pose": self.pose(),
            "scale": self.vector(),
            "color": {"r": 1.0, "g": 0.5, "b": 0.25, "a": 1.0},
            "lifetime": {"secs": 1, "nsecs": 0},
            "points": [self.vector() for _ in range(4)],
            "text": self.name(f"obstacle {number}"),
        }

    def markers(self) -> dict[str, Any]:
        return {"markers": [self.marker(i) for i in range(self.count(50))]}

    def diagnostics(self) -> dict[str, Any]:
        return {
            "header": self.header(""),
            "status": [
                {
                    "level": 0,
                    "name": self.name(f"motor driver {i}"),
                    "message": self.name("running"),
                    "hardware_id": self.name(f"driver-{i:03}"),
                    "values": [
                        {"key": self.name(key), "value": self.name(f"{value:.3f}")}
                        for key, value in zip(
                            ("temperature", "voltage", "current", "velocity"),
                            self.floats(4),
                            strict=True,
                        )
                    ],
                }
                for i in range(self.count(10))
            ],
        }

    def point_cloud(self) -> dict[str, Any]:
        points = self.count(65536)
        return {
            "header": self.header("lidar"),
            "height": 1,
            "width": points,
            "fields": [
                {"name": name, "offset": 4 * i, "datatype": 7, "count": 1}
                for i, name in enumerate(("x", "y", "z", "intensity"))
            ],
            "point_step": 16,
            "row_step": 16 * points,
            "data": self.random.randbytes(16 * points),
            "is_dense": True,
        }

    def image(self) -> dict[str, Any]:
        height = self.count(1080)
        return {
            "header": self.header("camera"),
            "height": height,
            "width": 1920,
            "encoding": self.name("bgr8"),
            "step": 5760,
            "data": self.random.randbytes(5760) * height,
        }
