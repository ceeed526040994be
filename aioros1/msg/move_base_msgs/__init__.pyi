# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.actionlib_msgs as _msg_actionlib_msgs
import aioros1.msg.geometry_msgs as _msg_geometry_msgs
import aioros1.msg.move_base_msgs as _msg_move_base_msgs
import aioros1.msg.std_msgs as _msg_std_msgs

class MoveBaseAction(_t.Message):
    action_goal: _msg_move_base_msgs.MoveBaseActionGoal
    action_result: _msg_move_base_msgs.MoveBaseActionResult
    action_feedback: _msg_move_base_msgs.MoveBaseActionFeedback
    @_ty.overload
    def __init__(
        self,
        *,
        action_goal: _msg_move_base_msgs.MoveBaseActionGoal = ...,
        action_result: _msg_move_base_msgs.MoveBaseActionResult = ...,
        action_feedback: _msg_move_base_msgs.MoveBaseActionFeedback = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        action_goal: _msg_move_base_msgs.MoveBaseActionGoal,
        action_result: _msg_move_base_msgs.MoveBaseActionResult,
        action_feedback: _msg_move_base_msgs.MoveBaseActionFeedback,
        /,
    ) -> None: ...

class MoveBaseActionFeedback(_t.Message):
    header: _msg_std_msgs.Header
    status: _msg_actionlib_msgs.GoalStatus
    feedback: _msg_move_base_msgs.MoveBaseFeedback
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        status: _msg_actionlib_msgs.GoalStatus = ...,
        feedback: _msg_move_base_msgs.MoveBaseFeedback = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        status: _msg_actionlib_msgs.GoalStatus,
        feedback: _msg_move_base_msgs.MoveBaseFeedback,
        /,
    ) -> None: ...

class MoveBaseActionGoal(_t.Message):
    header: _msg_std_msgs.Header
    goal_id: _msg_actionlib_msgs.GoalID
    goal: _msg_move_base_msgs.MoveBaseGoal
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        goal_id: _msg_actionlib_msgs.GoalID = ...,
        goal: _msg_move_base_msgs.MoveBaseGoal = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        goal_id: _msg_actionlib_msgs.GoalID,
        goal: _msg_move_base_msgs.MoveBaseGoal,
        /,
    ) -> None: ...

class MoveBaseActionResult(_t.Message):
    header: _msg_std_msgs.Header
    status: _msg_actionlib_msgs.GoalStatus
    result: _msg_move_base_msgs.MoveBaseResult
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        status: _msg_actionlib_msgs.GoalStatus = ...,
        result: _msg_move_base_msgs.MoveBaseResult = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        status: _msg_actionlib_msgs.GoalStatus,
        result: _msg_move_base_msgs.MoveBaseResult,
        /,
    ) -> None: ...

class MoveBaseFeedback(_t.Message):
    base_position: _msg_geometry_msgs.PoseStamped
    @_ty.overload
    def __init__(self, *, base_position: _msg_geometry_msgs.PoseStamped = ...) -> None: ...
    @_ty.overload
    def __init__(self, base_position: _msg_geometry_msgs.PoseStamped, /) -> None: ...

class MoveBaseGoal(_t.Message):
    target_pose: _msg_geometry_msgs.PoseStamped
    @_ty.overload
    def __init__(self, *, target_pose: _msg_geometry_msgs.PoseStamped = ...) -> None: ...
    @_ty.overload
    def __init__(self, target_pose: _msg_geometry_msgs.PoseStamped, /) -> None: ...

class MoveBaseResult(_t.Message):
    def __init__(self) -> None: ...

class RecoveryStatus(_t.Message):
    pose_stamped: _msg_geometry_msgs.PoseStamped
    current_recovery_number: _b.int
    total_number_of_recoveries: _b.int
    recovery_behavior_name: _b.str
    @_ty.overload
    def __init__(
        self,
        *,
        pose_stamped: _msg_geometry_msgs.PoseStamped = ...,
        current_recovery_number: _t.Int = ...,
        total_number_of_recoveries: _t.Int = ...,
        recovery_behavior_name: _t.Text = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        pose_stamped: _msg_geometry_msgs.PoseStamped,
        current_recovery_number: _t.Int,
        total_number_of_recoveries: _t.Int,
        recovery_behavior_name: _t.Text,
        /,
    ) -> None: ...
