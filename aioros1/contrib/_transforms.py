"""Transforms and poses as matrices."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from aioros1 import AnyMessage, GenpyMessage
from aioros1._public import public
from aioros1.contrib._buffers import check_message
from aioros1.msg.geometry_msgs import (
    Pose,
    PoseStamped,
    PoseWithCovariance,
    PoseWithCovarianceStamped,
    Transform,
    TransformStamped,
)
from aioros1.msg.nav_msgs import Odometry

__all__ = ["transform_to_matrix"]

_TYPES = (
    "geometry_msgs/Transform",
    "geometry_msgs/TransformStamped",
    "geometry_msgs/Pose",
    "geometry_msgs/PoseStamped",
    "geometry_msgs/PoseWithCovariance",
    "geometry_msgs/PoseWithCovarianceStamped",
    "nav_msgs/Odometry",
)


@public("aioros1.contrib.numpy")
def transform_to_matrix(
    transform: (
        Transform
        | TransformStamped
        | Pose
        | PoseStamped
        | PoseWithCovariance
        | PoseWithCovarianceStamped
        | Odometry
        | AnyMessage
        | GenpyMessage
    ),
) -> NDArray[np.float64]:
    """Make the homogeneous matrix, of shape ``(4, 4)``, of a transform or a pose.

    ``matrix @ (x, y, z, 1)`` takes a point from the child frame to the frame of the header; a
    pose is the transform from its own frame. Takes a ``Transform``, a ``Pose``, those that are
    stamped or have a covariance, and ``nav_msgs/Odometry``.

    The quaternion is normalised. Raises :class:`ValueError` if it is zero, as in a default
    ``Pose()``, and for numbers that are not finite, and :class:`TypeError` for anything else.
    """
    message: Any = check_message(transform, *_TYPES)
    place = ""
    while not hasattr(message, "orientation") and not hasattr(message, "rotation"):
        name = "transform" if hasattr(message, "transform") else "pose"
        place += f"{name}."
        message = getattr(message, name)
    names = ("position", "orientation") if hasattr(message, "orientation") else _PARTS
    x, y, z, w = _unit(getattr(message, names[1]), f"{place}{names[1]}")
    origin = getattr(message, names[0])
    matrix = np.identity(4)
    matrix[:3, 3] = _finite((origin.x, origin.y, origin.z), f"{place}{names[0]}")
    matrix[:3, :3] = (
        (1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
        (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
        (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)),
    )
    return matrix


_PARTS = ("translation", "rotation")


def _unit(quaternion: Any, place: str) -> NDArray[np.float64]:
    """The four numbers of a quaternion, at length one."""
    parts = (quaternion.x, quaternion.y, quaternion.z, quaternion.w)
    numbers = _finite(parts, place)
    largest = np.abs(numbers).max()
    if not largest:
        raise ValueError(f"{place}: expected a quaternion that is a rotation, got {parts}")
    numbers = numbers / largest  # squares of very small or large numbers are lost
    unit: NDArray[np.float64] = numbers / np.sqrt(numbers @ numbers)
    return unit


def _finite(parts: tuple[float, ...], place: str) -> NDArray[np.float64]:
    numbers = np.array(parts, np.float64)
    if not np.isfinite(numbers).all():
        raise ValueError(f"{place}: expected finite numbers, got {parts}")
    return numbers
