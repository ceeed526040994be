# Made by aioros1 from message definitions. Change those, and have it made anew.
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.geometry_msgs as _msg_geometry_msgs
import aioros1.msg.std_msgs as _msg_std_msgs
import aioros1.msg.trajectory_msgs as _msg_trajectory_msgs

class JointTrajectory(_t.Message):
    header: _msg_std_msgs.Header
    joint_names: _t.TextList
    points: _t.ItemList[_msg_trajectory_msgs.JointTrajectoryPoint]
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        joint_names: _t.Texts = ...,
        points: _t.Items[_msg_trajectory_msgs.JointTrajectoryPoint] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        joint_names: _t.Texts,
        points: _t.Items[_msg_trajectory_msgs.JointTrajectoryPoint],
        /,
    ) -> None: ...

class JointTrajectoryPoint(_t.Message):
    positions: _t.FloatArray
    velocities: _t.FloatArray
    accelerations: _t.FloatArray
    effort: _t.FloatArray
    time_from_start: _t.Duration
    @_ty.overload
    def __init__(
        self,
        *,
        positions: _t.Floats = ...,
        velocities: _t.Floats = ...,
        accelerations: _t.Floats = ...,
        effort: _t.Floats = ...,
        time_from_start: _t.Duration = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        positions: _t.Floats,
        velocities: _t.Floats,
        accelerations: _t.Floats,
        effort: _t.Floats,
        time_from_start: _t.Duration,
        /,
    ) -> None: ...

class MultiDOFJointTrajectory(_t.Message):
    header: _msg_std_msgs.Header
    joint_names: _t.TextList
    points: _t.ItemList[_msg_trajectory_msgs.MultiDOFJointTrajectoryPoint]
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        joint_names: _t.Texts = ...,
        points: _t.Items[_msg_trajectory_msgs.MultiDOFJointTrajectoryPoint] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        joint_names: _t.Texts,
        points: _t.Items[_msg_trajectory_msgs.MultiDOFJointTrajectoryPoint],
        /,
    ) -> None: ...

class MultiDOFJointTrajectoryPoint(_t.Message):
    transforms: _t.ItemList[_msg_geometry_msgs.Transform]
    velocities: _t.ItemList[_msg_geometry_msgs.Twist]
    accelerations: _t.ItemList[_msg_geometry_msgs.Twist]
    time_from_start: _t.Duration
    @_ty.overload
    def __init__(
        self,
        *,
        transforms: _t.Items[_msg_geometry_msgs.Transform] = ...,
        velocities: _t.Items[_msg_geometry_msgs.Twist] = ...,
        accelerations: _t.Items[_msg_geometry_msgs.Twist] = ...,
        time_from_start: _t.Duration = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        transforms: _t.Items[_msg_geometry_msgs.Transform],
        velocities: _t.Items[_msg_geometry_msgs.Twist],
        accelerations: _t.Items[_msg_geometry_msgs.Twist],
        time_from_start: _t.Duration,
        /,
    ) -> None: ...
