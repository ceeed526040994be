"""Transforms and poses as matrices."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from aioros1.contrib.numpy import transform_to_matrix
from aioros1.msg.geometry_msgs import (
    Point,
    Pose,
    PoseStamped,
    PoseWithCovariance,
    PoseWithCovarianceStamped,
    Quaternion,
    Transform,
    TransformStamped,
    Twist,
    Vector3,
)
from aioros1.msg.nav_msgs import Odometry

ORIGIN = {"x": 1.0, "y": 2.0, "z": 3.0}
TURN = {"z": math.sqrt(0.5), "w": math.sqrt(0.5)}  # a quarter to the left
TRANSFORM = Transform(translation=Vector3(**ORIGIN), rotation=Quaternion(**TURN))
POSE = Pose(position=Point(**ORIGIN), orientation=Quaternion(**TURN))

numbers = st.floats(-1e6, 1e6)


def rotated(quaternion, point):
    """A point turned by quaternion multiplication, q p q*."""

    def times(a, b):
        (ax, ay, az, aw), (bx, by, bz, bw) = a, b
        return (
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
            aw * bw - ax * bx - ay * by - az * bz,
        )

    x, y, z, w = quaternion
    return times(times(quaternion, (*point, 0)), (-x, -y, -z, w))[:3]


@pytest.mark.parametrize(
    "message",
    [
        TRANSFORM,
        TransformStamped(transform=TRANSFORM),
        POSE,
        PoseStamped(pose=POSE),
        PoseWithCovariance(pose=POSE),
        PoseWithCovarianceStamped(pose=PoseWithCovariance(pose=POSE)),
        Odometry(pose=PoseWithCovariance(pose=POSE)),
    ],
    ids=lambda message: type(message).__name__,
)
def test_every_message_with_a_transform_or_a_pose(message):
    expected = [[0, -1, 0, 1], [1, 0, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]]
    for each in (message, type(message).from_bytes(message.to_bytes())):
        matrix = transform_to_matrix(each)
        assert matrix.dtype == np.float64
        np.testing.assert_allclose(matrix, expected, atol=1e-12)


@given(st.tuples(numbers, numbers, numbers, numbers), st.tuples(numbers, numbers, numbers),
       st.tuples(numbers, numbers, numbers))  # fmt: skip
def test_a_point_is_turned_and_moved(quaternion, origin, point):
    length = math.hypot(*quaternion)
    assume(length > 1e-3)
    matrix = transform_to_matrix(
        Transform(translation=Vector3(*origin), rotation=Quaternion(*quaternion))
    )
    moved = matrix @ (*point, 1)
    turned = rotated([part / length for part in quaternion], point)
    np.testing.assert_allclose(moved[:3], np.add(turned, origin), rtol=1e-6, atol=1e-4)
    np.testing.assert_allclose(matrix[:3, :3] @ matrix[:3, :3].T, np.identity(3), atol=1e-9)
    assert np.linalg.det(matrix[:3, :3]) > 0


@pytest.mark.parametrize("scale", [5e-324, 1e-200, 1e-9, 3.0, 1e200, 1e308])
def test_a_quaternion_of_any_length_will_do(scale):
    message = Transform(rotation=Quaternion(z=scale, w=scale))
    turn = Transform(rotation=Quaternion(**TURN))
    np.testing.assert_allclose(transform_to_matrix(message), transform_to_matrix(turn), atol=1e-12)


@pytest.mark.parametrize(
    ("message", "place"),
    [
        (Pose(), "orientation: expected a quaternion that is a rotation"),
        (Odometry(), r"pose\.pose\.orientation: expected a quaternion that is a rotation"),
        (TransformStamped(), r"transform\.rotation: expected a quaternion"),
        (Transform(rotation=Quaternion(x=math.nan)), "rotation: expected finite numbers"),
        (Transform(rotation=Quaternion(x=math.inf)), "rotation: expected finite numbers"),
        (Pose(orientation=Quaternion(w=1.0), position=Point(y=math.nan)),
         r"position: expected finite numbers, got \(0\.0, nan, 0\.0\)"),
    ],
)  # fmt: skip
def test_what_is_no_transform(message, place):
    with pytest.raises(ValueError, match=place):
        transform_to_matrix(message)


@pytest.mark.parametrize("value", [Twist(), Quaternion(w=1.0), np.identity(4), None, Pose])
def test_messages_without_one(value):
    with pytest.raises(TypeError, match=r"expected a geometry_msgs/Transform or .*, got"):
        transform_to_matrix(value)
