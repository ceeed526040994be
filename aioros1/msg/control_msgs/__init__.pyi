# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.actionlib_msgs as _msg_actionlib_msgs
import aioros1.msg.control_msgs as _msg_control_msgs
import aioros1.msg.geometry_msgs as _msg_geometry_msgs
import aioros1.msg.std_msgs as _msg_std_msgs
import aioros1.msg.trajectory_msgs as _msg_trajectory_msgs

class FollowJointTrajectoryAction(_t.Message):
    action_goal: _msg_control_msgs.FollowJointTrajectoryActionGoal
    action_result: _msg_control_msgs.FollowJointTrajectoryActionResult
    action_feedback: _msg_control_msgs.FollowJointTrajectoryActionFeedback
    @_ty.overload
    def __init__(
        self,
        *,
        action_goal: _msg_control_msgs.FollowJointTrajectoryActionGoal = ...,
        action_result: _msg_control_msgs.FollowJointTrajectoryActionResult = ...,
        action_feedback: _msg_control_msgs.FollowJointTrajectoryActionFeedback = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        action_goal: _msg_control_msgs.FollowJointTrajectoryActionGoal,
        action_result: _msg_control_msgs.FollowJointTrajectoryActionResult,
        action_feedback: _msg_control_msgs.FollowJointTrajectoryActionFeedback,
        /,
    ) -> None: ...

class FollowJointTrajectoryActionFeedback(_t.Message):
    header: _msg_std_msgs.Header
    status: _msg_actionlib_msgs.GoalStatus
    feedback: _msg_control_msgs.FollowJointTrajectoryFeedback
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        status: _msg_actionlib_msgs.GoalStatus = ...,
        feedback: _msg_control_msgs.FollowJointTrajectoryFeedback = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        status: _msg_actionlib_msgs.GoalStatus,
        feedback: _msg_control_msgs.FollowJointTrajectoryFeedback,
        /,
    ) -> None: ...

class FollowJointTrajectoryActionGoal(_t.Message):
    header: _msg_std_msgs.Header
    goal_id: _msg_actionlib_msgs.GoalID
    goal: _msg_control_msgs.FollowJointTrajectoryGoal
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        goal_id: _msg_actionlib_msgs.GoalID = ...,
        goal: _msg_control_msgs.FollowJointTrajectoryGoal = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        goal_id: _msg_actionlib_msgs.GoalID,
        goal: _msg_control_msgs.FollowJointTrajectoryGoal,
        /,
    ) -> None: ...

class FollowJointTrajectoryActionResult(_t.Message):
    header: _msg_std_msgs.Header
    status: _msg_actionlib_msgs.GoalStatus
    result: _msg_control_msgs.FollowJointTrajectoryResult
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        status: _msg_actionlib_msgs.GoalStatus = ...,
        result: _msg_control_msgs.FollowJointTrajectoryResult = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        status: _msg_actionlib_msgs.GoalStatus,
        result: _msg_control_msgs.FollowJointTrajectoryResult,
        /,
    ) -> None: ...

class FollowJointTrajectoryFeedback(_t.Message):
    header: _msg_std_msgs.Header
    joint_names: _t.TextList
    desired: _msg_trajectory_msgs.JointTrajectoryPoint
    actual: _msg_trajectory_msgs.JointTrajectoryPoint
    error: _msg_trajectory_msgs.JointTrajectoryPoint
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        joint_names: _t.Texts = ...,
        desired: _msg_trajectory_msgs.JointTrajectoryPoint = ...,
        actual: _msg_trajectory_msgs.JointTrajectoryPoint = ...,
        error: _msg_trajectory_msgs.JointTrajectoryPoint = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        joint_names: _t.Texts,
        desired: _msg_trajectory_msgs.JointTrajectoryPoint,
        actual: _msg_trajectory_msgs.JointTrajectoryPoint,
        error: _msg_trajectory_msgs.JointTrajectoryPoint,
        /,
    ) -> None: ...

class FollowJointTrajectoryGoal(_t.Message):
    trajectory: _msg_trajectory_msgs.JointTrajectory
    path_tolerance: _t.ItemList[_msg_control_msgs.JointTolerance]
    goal_tolerance: _t.ItemList[_msg_control_msgs.JointTolerance]
    goal_time_tolerance: _t.Duration
    @_ty.overload
    def __init__(
        self,
        *,
        trajectory: _msg_trajectory_msgs.JointTrajectory = ...,
        path_tolerance: _t.Items[_msg_control_msgs.JointTolerance] = ...,
        goal_tolerance: _t.Items[_msg_control_msgs.JointTolerance] = ...,
        goal_time_tolerance: _t.Duration = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        trajectory: _msg_trajectory_msgs.JointTrajectory,
        path_tolerance: _t.Items[_msg_control_msgs.JointTolerance],
        goal_tolerance: _t.Items[_msg_control_msgs.JointTolerance],
        goal_time_tolerance: _t.Duration,
        /,
    ) -> None: ...

class FollowJointTrajectoryResult(_t.Message):
    SUCCESSFUL: _ty.Final = 0
    INVALID_GOAL: _ty.Final = -1
    INVALID_JOINTS: _ty.Final = -2
    OLD_HEADER_TIMESTAMP: _ty.Final = -3
    PATH_TOLERANCE_VIOLATED: _ty.Final = -4
    GOAL_TOLERANCE_VIOLATED: _ty.Final = -5
    error_code: _b.int
    error_string: _b.str
    @_ty.overload
    def __init__(self, *, error_code: _t.Int = ..., error_string: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, error_code: _t.Int, error_string: _t.Text, /) -> None: ...

class GripperCommand(_t.Message):
    position: _b.float
    max_effort: _b.float
    @_ty.overload
    def __init__(self, *, position: _t.Float = ..., max_effort: _t.Float = ...) -> None: ...
    @_ty.overload
    def __init__(self, position: _t.Float, max_effort: _t.Float, /) -> None: ...

class GripperCommandAction(_t.Message):
    action_goal: _msg_control_msgs.GripperCommandActionGoal
    action_result: _msg_control_msgs.GripperCommandActionResult
    action_feedback: _msg_control_msgs.GripperCommandActionFeedback
    @_ty.overload
    def __init__(
        self,
        *,
        action_goal: _msg_control_msgs.GripperCommandActionGoal = ...,
        action_result: _msg_control_msgs.GripperCommandActionResult = ...,
        action_feedback: _msg_control_msgs.GripperCommandActionFeedback = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        action_goal: _msg_control_msgs.GripperCommandActionGoal,
        action_result: _msg_control_msgs.GripperCommandActionResult,
        action_feedback: _msg_control_msgs.GripperCommandActionFeedback,
        /,
    ) -> None: ...

class GripperCommandActionFeedback(_t.Message):
    header: _msg_std_msgs.Header
    status: _msg_actionlib_msgs.GoalStatus
    feedback: _msg_control_msgs.GripperCommandFeedback
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        status: _msg_actionlib_msgs.GoalStatus = ...,
        feedback: _msg_control_msgs.GripperCommandFeedback = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        status: _msg_actionlib_msgs.GoalStatus,
        feedback: _msg_control_msgs.GripperCommandFeedback,
        /,
    ) -> None: ...

class GripperCommandActionGoal(_t.Message):
    header: _msg_std_msgs.Header
    goal_id: _msg_actionlib_msgs.GoalID
    goal: _msg_control_msgs.GripperCommandGoal
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        goal_id: _msg_actionlib_msgs.GoalID = ...,
        goal: _msg_control_msgs.GripperCommandGoal = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        goal_id: _msg_actionlib_msgs.GoalID,
        goal: _msg_control_msgs.GripperCommandGoal,
        /,
    ) -> None: ...

class GripperCommandActionResult(_t.Message):
    header: _msg_std_msgs.Header
    status: _msg_actionlib_msgs.GoalStatus
    result: _msg_control_msgs.GripperCommandResult
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        status: _msg_actionlib_msgs.GoalStatus = ...,
        result: _msg_control_msgs.GripperCommandResult = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        status: _msg_actionlib_msgs.GoalStatus,
        result: _msg_control_msgs.GripperCommandResult,
        /,
    ) -> None: ...

class GripperCommandFeedback(_t.Message):
    position: _b.float
    effort: _b.float
    stalled: _b.bool
    reached_goal: _b.bool
    @_ty.overload
    def __init__(
        self,
        *,
        position: _t.Float = ...,
        effort: _t.Float = ...,
        stalled: _t.Bool = ...,
        reached_goal: _t.Bool = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        position: _t.Float,
        effort: _t.Float,
        stalled: _t.Bool,
        reached_goal: _t.Bool,
        /,
    ) -> None: ...

class GripperCommandGoal(_t.Message):
    command: _msg_control_msgs.GripperCommand
    @_ty.overload
    def __init__(self, *, command: _msg_control_msgs.GripperCommand = ...) -> None: ...
    @_ty.overload
    def __init__(self, command: _msg_control_msgs.GripperCommand, /) -> None: ...

class GripperCommandResult(_t.Message):
    position: _b.float
    effort: _b.float
    stalled: _b.bool
    reached_goal: _b.bool
    @_ty.overload
    def __init__(
        self,
        *,
        position: _t.Float = ...,
        effort: _t.Float = ...,
        stalled: _t.Bool = ...,
        reached_goal: _t.Bool = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        position: _t.Float,
        effort: _t.Float,
        stalled: _t.Bool,
        reached_goal: _t.Bool,
        /,
    ) -> None: ...

class JointControllerState(_t.Message):
    header: _msg_std_msgs.Header
    set_point: _b.float
    process_value: _b.float
    process_value_dot: _b.float
    error: _b.float
    time_step: _b.float
    command: _b.float
    p: _b.float
    i: _b.float
    d: _b.float
    i_clamp: _b.float
    antiwindup: _b.bool
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        set_point: _t.Float = ...,
        process_value: _t.Float = ...,
        process_value_dot: _t.Float = ...,
        error: _t.Float = ...,
        time_step: _t.Float = ...,
        command: _t.Float = ...,
        p: _t.Float = ...,
        i: _t.Float = ...,
        d: _t.Float = ...,
        i_clamp: _t.Float = ...,
        antiwindup: _t.Bool = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        set_point: _t.Float,
        process_value: _t.Float,
        process_value_dot: _t.Float,
        error: _t.Float,
        time_step: _t.Float,
        command: _t.Float,
        p: _t.Float,
        i: _t.Float,
        d: _t.Float,
        i_clamp: _t.Float,
        antiwindup: _t.Bool,
        /,
    ) -> None: ...

class JointJog(_t.Message):
    header: _msg_std_msgs.Header
    joint_names: _t.TextList
    displacements: _t.FloatArray
    velocities: _t.FloatArray
    duration: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        joint_names: _t.Texts = ...,
        displacements: _t.Floats = ...,
        velocities: _t.Floats = ...,
        duration: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        joint_names: _t.Texts,
        displacements: _t.Floats,
        velocities: _t.Floats,
        duration: _t.Float,
        /,
    ) -> None: ...

class JointTolerance(_t.Message):
    name: _b.str
    position: _b.float
    velocity: _b.float
    acceleration: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        name: _t.Text = ...,
        position: _t.Float = ...,
        velocity: _t.Float = ...,
        acceleration: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        name: _t.Text,
        position: _t.Float,
        velocity: _t.Float,
        acceleration: _t.Float,
        /,
    ) -> None: ...

class JointTrajectoryAction(_t.Message):
    action_goal: _msg_control_msgs.JointTrajectoryActionGoal
    action_result: _msg_control_msgs.JointTrajectoryActionResult
    action_feedback: _msg_control_msgs.JointTrajectoryActionFeedback
    @_ty.overload
    def __init__(
        self,
        *,
        action_goal: _msg_control_msgs.JointTrajectoryActionGoal = ...,
        action_result: _msg_control_msgs.JointTrajectoryActionResult = ...,
        action_feedback: _msg_control_msgs.JointTrajectoryActionFeedback = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        action_goal: _msg_control_msgs.JointTrajectoryActionGoal,
        action_result: _msg_control_msgs.JointTrajectoryActionResult,
        action_feedback: _msg_control_msgs.JointTrajectoryActionFeedback,
        /,
    ) -> None: ...

class JointTrajectoryActionFeedback(_t.Message):
    header: _msg_std_msgs.Header
    status: _msg_actionlib_msgs.GoalStatus
    feedback: _msg_control_msgs.JointTrajectoryFeedback
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        status: _msg_actionlib_msgs.GoalStatus = ...,
        feedback: _msg_control_msgs.JointTrajectoryFeedback = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        status: _msg_actionlib_msgs.GoalStatus,
        feedback: _msg_control_msgs.JointTrajectoryFeedback,
        /,
    ) -> None: ...

class JointTrajectoryActionGoal(_t.Message):
    header: _msg_std_msgs.Header
    goal_id: _msg_actionlib_msgs.GoalID
    goal: _msg_control_msgs.JointTrajectoryGoal
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        goal_id: _msg_actionlib_msgs.GoalID = ...,
        goal: _msg_control_msgs.JointTrajectoryGoal = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        goal_id: _msg_actionlib_msgs.GoalID,
        goal: _msg_control_msgs.JointTrajectoryGoal,
        /,
    ) -> None: ...

class JointTrajectoryActionResult(_t.Message):
    header: _msg_std_msgs.Header
    status: _msg_actionlib_msgs.GoalStatus
    result: _msg_control_msgs.JointTrajectoryResult
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        status: _msg_actionlib_msgs.GoalStatus = ...,
        result: _msg_control_msgs.JointTrajectoryResult = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        status: _msg_actionlib_msgs.GoalStatus,
        result: _msg_control_msgs.JointTrajectoryResult,
        /,
    ) -> None: ...

class JointTrajectoryControllerState(_t.Message):
    header: _msg_std_msgs.Header
    joint_names: _t.TextList
    desired: _msg_trajectory_msgs.JointTrajectoryPoint
    actual: _msg_trajectory_msgs.JointTrajectoryPoint
    error: _msg_trajectory_msgs.JointTrajectoryPoint
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        joint_names: _t.Texts = ...,
        desired: _msg_trajectory_msgs.JointTrajectoryPoint = ...,
        actual: _msg_trajectory_msgs.JointTrajectoryPoint = ...,
        error: _msg_trajectory_msgs.JointTrajectoryPoint = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        joint_names: _t.Texts,
        desired: _msg_trajectory_msgs.JointTrajectoryPoint,
        actual: _msg_trajectory_msgs.JointTrajectoryPoint,
        error: _msg_trajectory_msgs.JointTrajectoryPoint,
        /,
    ) -> None: ...

class JointTrajectoryFeedback(_t.Message):
    def __init__(self) -> None: ...

class JointTrajectoryGoal(_t.Message):
    trajectory: _msg_trajectory_msgs.JointTrajectory
    @_ty.overload
    def __init__(self, *, trajectory: _msg_trajectory_msgs.JointTrajectory = ...) -> None: ...
    @_ty.overload
    def __init__(self, trajectory: _msg_trajectory_msgs.JointTrajectory, /) -> None: ...

class JointTrajectoryResult(_t.Message):
    def __init__(self) -> None: ...

class PidState(_t.Message):
    header: _msg_std_msgs.Header
    timestep: _t.Duration
    error: _b.float
    error_dot: _b.float
    p_error: _b.float
    i_error: _b.float
    d_error: _b.float
    p_term: _b.float
    i_term: _b.float
    d_term: _b.float
    i_max: _b.float
    i_min: _b.float
    output: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        timestep: _t.Duration = ...,
        error: _t.Float = ...,
        error_dot: _t.Float = ...,
        p_error: _t.Float = ...,
        i_error: _t.Float = ...,
        d_error: _t.Float = ...,
        p_term: _t.Float = ...,
        i_term: _t.Float = ...,
        d_term: _t.Float = ...,
        i_max: _t.Float = ...,
        i_min: _t.Float = ...,
        output: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        timestep: _t.Duration,
        error: _t.Float,
        error_dot: _t.Float,
        p_error: _t.Float,
        i_error: _t.Float,
        d_error: _t.Float,
        p_term: _t.Float,
        i_term: _t.Float,
        d_term: _t.Float,
        i_max: _t.Float,
        i_min: _t.Float,
        output: _t.Float,
        /,
    ) -> None: ...

class PointHeadAction(_t.Message):
    action_goal: _msg_control_msgs.PointHeadActionGoal
    action_result: _msg_control_msgs.PointHeadActionResult
    action_feedback: _msg_control_msgs.PointHeadActionFeedback
    @_ty.overload
    def __init__(
        self,
        *,
        action_goal: _msg_control_msgs.PointHeadActionGoal = ...,
        action_result: _msg_control_msgs.PointHeadActionResult = ...,
        action_feedback: _msg_control_msgs.PointHeadActionFeedback = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        action_goal: _msg_control_msgs.PointHeadActionGoal,
        action_result: _msg_control_msgs.PointHeadActionResult,
        action_feedback: _msg_control_msgs.PointHeadActionFeedback,
        /,
    ) -> None: ...

class PointHeadActionFeedback(_t.Message):
    header: _msg_std_msgs.Header
    status: _msg_actionlib_msgs.GoalStatus
    feedback: _msg_control_msgs.PointHeadFeedback
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        status: _msg_actionlib_msgs.GoalStatus = ...,
        feedback: _msg_control_msgs.PointHeadFeedback = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        status: _msg_actionlib_msgs.GoalStatus,
        feedback: _msg_control_msgs.PointHeadFeedback,
        /,
    ) -> None: ...

class PointHeadActionGoal(_t.Message):
    header: _msg_std_msgs.Header
    goal_id: _msg_actionlib_msgs.GoalID
    goal: _msg_control_msgs.PointHeadGoal
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        goal_id: _msg_actionlib_msgs.GoalID = ...,
        goal: _msg_control_msgs.PointHeadGoal = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        goal_id: _msg_actionlib_msgs.GoalID,
        goal: _msg_control_msgs.PointHeadGoal,
        /,
    ) -> None: ...

class PointHeadActionResult(_t.Message):
    header: _msg_std_msgs.Header
    status: _msg_actionlib_msgs.GoalStatus
    result: _msg_control_msgs.PointHeadResult
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        status: _msg_actionlib_msgs.GoalStatus = ...,
        result: _msg_control_msgs.PointHeadResult = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        status: _msg_actionlib_msgs.GoalStatus,
        result: _msg_control_msgs.PointHeadResult,
        /,
    ) -> None: ...

class PointHeadFeedback(_t.Message):
    pointing_angle_error: _b.float
    @_ty.overload
    def __init__(self, *, pointing_angle_error: _t.Float = ...) -> None: ...
    @_ty.overload
    def __init__(self, pointing_angle_error: _t.Float, /) -> None: ...

class PointHeadGoal(_t.Message):
    target: _msg_geometry_msgs.PointStamped
    pointing_axis: _msg_geometry_msgs.Vector3
    pointing_frame: _b.str
    min_duration: _t.Duration
    max_velocity: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        target: _msg_geometry_msgs.PointStamped = ...,
        pointing_axis: _msg_geometry_msgs.Vector3 = ...,
        pointing_frame: _t.Text = ...,
        min_duration: _t.Duration = ...,
        max_velocity: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        target: _msg_geometry_msgs.PointStamped,
        pointing_axis: _msg_geometry_msgs.Vector3,
        pointing_frame: _t.Text,
        min_duration: _t.Duration,
        max_velocity: _t.Float,
        /,
    ) -> None: ...

class PointHeadResult(_t.Message):
    def __init__(self) -> None: ...

class SingleJointPositionAction(_t.Message):
    action_goal: _msg_control_msgs.SingleJointPositionActionGoal
    action_result: _msg_control_msgs.SingleJointPositionActionResult
    action_feedback: _msg_control_msgs.SingleJointPositionActionFeedback
    @_ty.overload
    def __init__(
        self,
        *,
        action_goal: _msg_control_msgs.SingleJointPositionActionGoal = ...,
        action_result: _msg_control_msgs.SingleJointPositionActionResult = ...,
        action_feedback: _msg_control_msgs.SingleJointPositionActionFeedback = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        action_goal: _msg_control_msgs.SingleJointPositionActionGoal,
        action_result: _msg_control_msgs.SingleJointPositionActionResult,
        action_feedback: _msg_control_msgs.SingleJointPositionActionFeedback,
        /,
    ) -> None: ...

class SingleJointPositionActionFeedback(_t.Message):
    header: _msg_std_msgs.Header
    status: _msg_actionlib_msgs.GoalStatus
    feedback: _msg_control_msgs.SingleJointPositionFeedback
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        status: _msg_actionlib_msgs.GoalStatus = ...,
        feedback: _msg_control_msgs.SingleJointPositionFeedback = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        status: _msg_actionlib_msgs.GoalStatus,
        feedback: _msg_control_msgs.SingleJointPositionFeedback,
        /,
    ) -> None: ...

class SingleJointPositionActionGoal(_t.Message):
    header: _msg_std_msgs.Header
    goal_id: _msg_actionlib_msgs.GoalID
    goal: _msg_control_msgs.SingleJointPositionGoal
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        goal_id: _msg_actionlib_msgs.GoalID = ...,
        goal: _msg_control_msgs.SingleJointPositionGoal = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        goal_id: _msg_actionlib_msgs.GoalID,
        goal: _msg_control_msgs.SingleJointPositionGoal,
        /,
    ) -> None: ...

class SingleJointPositionActionResult(_t.Message):
    header: _msg_std_msgs.Header
    status: _msg_actionlib_msgs.GoalStatus
    result: _msg_control_msgs.SingleJointPositionResult
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        status: _msg_actionlib_msgs.GoalStatus = ...,
        result: _msg_control_msgs.SingleJointPositionResult = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        status: _msg_actionlib_msgs.GoalStatus,
        result: _msg_control_msgs.SingleJointPositionResult,
        /,
    ) -> None: ...

class SingleJointPositionFeedback(_t.Message):
    header: _msg_std_msgs.Header
    position: _b.float
    velocity: _b.float
    error: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        position: _t.Float = ...,
        velocity: _t.Float = ...,
        error: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        position: _t.Float,
        velocity: _t.Float,
        error: _t.Float,
        /,
    ) -> None: ...

class SingleJointPositionGoal(_t.Message):
    position: _b.float
    min_duration: _t.Duration
    max_velocity: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        position: _t.Float = ...,
        min_duration: _t.Duration = ...,
        max_velocity: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        position: _t.Float,
        min_duration: _t.Duration,
        max_velocity: _t.Float,
        /,
    ) -> None: ...

class SingleJointPositionResult(_t.Message):
    def __init__(self) -> None: ...
