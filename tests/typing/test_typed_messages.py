"""What type checkers know of messages. This file is checked, and run as well."""
# pyright: strict

from __future__ import annotations

from array import array
from typing import Literal, TypeAlias, assert_type

import numpy as np

import aioros1
import aioros1.msg.sensor_msgs
from aioros1 import Duration, Time
from aioros1.action.actionlib_tutorials import Fibonacci
from aioros1.idl import Message
from aioros1.msg.actionlib_tutorials import FibonacciAction, FibonacciActionGoal, FibonacciGoal
from aioros1.msg.geometry_msgs import Point, Point32, Polygon, PoseWithCovariance, Twist, Vector3
from aioros1.msg.sensor_msgs import Image, JointState, LaserScan
from aioros1.msg.shape_msgs import SolidPrimitive
from aioros1.msg.std_msgs import Bool, Empty, Float64, Header, Int32, String
from aioros1.msg.std_msgs import Duration as DurationMessage
from aioros1.msg.std_msgs import Time as TimeMessage
from aioros1.msg.trajectory_msgs import JointTrajectoryPoint
from aioros1.srv.std_srvs import SetBool, SetBoolRequest, SetBoolResponse

Floats: TypeAlias = "array[float]"  # a class without brackets when it is run, before 3.12
Ints: TypeAlias = "array[int]"


def test_scalars() -> None:
    assert_type(String(data="x").data, str)
    assert_type(Int32(data=1).data, int)
    assert_type(Float64(data=1.5).data, float)
    assert_type(Bool(data=True).data, bool)
    assert_type(TimeMessage(data=Time(1)).data, Time)
    assert_type(DurationMessage(data=Duration(1)).data, Duration)
    text = String()
    text.data = "y"
    assert text.to_bytes() == String("y").to_bytes() == String(b"y").to_bytes()
    # A whole number stands for a float, and what has `__index__` or `__float__` will do.
    assert Float64(data=2) == Float64(np.float32(2.0))
    assert Int32(data=np.int16(3)).to_bytes() == Int32(3).to_bytes()
    assert Bool(data=1).to_bytes() == Bool(data=np.True_).to_bytes()
    Empty()


def test_nested_messages() -> None:
    twist = Twist(linear=Vector3(x=1.0))
    assert_type(twist.linear, Vector3)
    assert_type(twist.linear.x, float)
    twist.angular = Vector3(0, 0, 1)
    header = Header(1, Time(2), "map")
    assert_type(header.stamp, Time)
    assert_type(header.stamp.secs, int)
    assert_type(LaserScan(header=header).header.frame_id, str)


def test_arrays() -> None:
    scan = LaserScan(ranges=[1, 2.0], intensities=(3.0,))
    scan = LaserScan.from_bytes(scan.to_bytes())
    assert_type(scan.ranges, Floats)
    assert_type(scan.ranges[0], float)
    scan.ranges.append(4.0)
    scan.ranges = [1.0]
    scan.ranges = array("f", [1.0])
    scan.ranges = np.zeros(3, np.float32)
    scan.ranges = range(3)
    assert len(LaserScan.from_bytes(scan.to_bytes()).ranges) == 3

    pose = PoseWithCovariance(covariance=[0.0] * 36)
    assert_type(pose.covariance, Floats)

    image = Image(data=b"\1\2")
    assert_type(image.data, bytes)
    for octets in (bytearray(2), memoryview(b"12"), [1, 2], array("B", [1, 2])):
        image.data = octets
        assert len(Image.from_bytes(image.to_bytes()).data) == 2
    image.data = np.zeros(2, np.uint8)

    joints = JointState(name=["a", b"b"], position=[0.5])
    assert_type(joints.name, list[str])
    joints.name = ("a",)
    joints.name = ["c"]
    joints.name.append("d")

    polygon = Polygon(points=[Point32(x=1.0)])
    assert_type(polygon.points, list[Point32])
    polygon.points = (Point32(),)
    polygon.points = [*polygon.points, Point32()]
    polygon.points.append(Point32())
    assert_type(polygon.points[0].x, float)

    assert_type(JointTrajectoryPoint(time_from_start=Duration(1.5)).time_from_start, Duration)
    assert_type(aioros1.msg.sensor_msgs.PointField.FLOAT32, Literal[7])


def test_constants() -> None:
    assert_type(SolidPrimitive.SPHERE, Literal[2])
    assert_type(SolidPrimitive().BOX, Literal[1])
    shape: int = SolidPrimitive(type=SolidPrimitive.CONE).type
    assert shape == 4


def test_what_all_messages_can_do() -> None:
    point = Point(1, 2, 3)
    assert_type(point.to_bytes(), bytes)
    assert_type(Point.from_bytes(b"\0" * 24), Point)
    assert_type(Point.from_dict({"x": 1.0}), Point)
    assert_type(point.replace(x=2.0), Point)
    assert_type(point._type, str)  # pyright: ignore[reportPrivateUsage]
    assert_type(Point._md5sum, str)  # pyright: ignore[reportPrivateUsage]
    some: Message = point
    assert some.to_dict() == {"x": 1.0, "y": 2.0, "z": 3.0}


def test_services() -> None:
    assert_type(SetBool.Request(data=True), SetBoolRequest)
    assert_type(SetBool.Response(success=True, message="ok"), SetBoolResponse)

    def flip(request: SetBool.Request) -> SetBool.Response:
        assert_type(request.data, bool)
        return SetBool.Response(success=not request.data)

    assert flip(SetBoolRequest(True)) == SetBoolResponse(False, "")


def test_actions() -> None:
    goal = Fibonacci.Goal(order=3)
    assert_type(goal, FibonacciGoal)
    assert_type(Fibonacci.Feedback([1]).sequence, Ints)
    whole = FibonacciAction(action_goal=Fibonacci.ActionGoal(goal=goal))
    assert_type(whole.action_goal, FibonacciActionGoal)
    assert_type(whole.action_goal.goal.order, int)
    assert_type(whole.action_goal.goal_id.stamp, Time)


def test_types_that_are_known_at_run_time_only() -> None:
    made = aioros1.load_msg("geometry_msgs/Point")
    point = made(x=1.0)
    point.y = 2.0
    x: float = point.x
    assert_type(point.to_bytes(), bytes)
    assert x == 1.0
    call = aioros1.load_srv("std_srvs/SetBool").Request(data=True)
    assert call.data
    goal = aioros1.load_action("actionlib_tutorials/Fibonacci").Goal(order=1)
    assert goal.order == 1
    number: int = aioros1.load_msg("sensor_msgs/PointField").FLOAT32
    assert number == 7
