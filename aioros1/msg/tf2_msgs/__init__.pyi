# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.actionlib_msgs as _msg_actionlib_msgs
import aioros1.msg.geometry_msgs as _msg_geometry_msgs
import aioros1.msg.std_msgs as _msg_std_msgs
import aioros1.msg.tf2_msgs as _msg_tf2_msgs

class LookupTransformAction(_t.Message):
    action_goal: _msg_tf2_msgs.LookupTransformActionGoal
    action_result: _msg_tf2_msgs.LookupTransformActionResult
    action_feedback: _msg_tf2_msgs.LookupTransformActionFeedback
    @_ty.overload
    def __init__(
        self,
        *,
        action_goal: _msg_tf2_msgs.LookupTransformActionGoal = ...,
        action_result: _msg_tf2_msgs.LookupTransformActionResult = ...,
        action_feedback: _msg_tf2_msgs.LookupTransformActionFeedback = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        action_goal: _msg_tf2_msgs.LookupTransformActionGoal,
        action_result: _msg_tf2_msgs.LookupTransformActionResult,
        action_feedback: _msg_tf2_msgs.LookupTransformActionFeedback,
        /,
    ) -> None: ...

class LookupTransformActionFeedback(_t.Message):
    header: _msg_std_msgs.Header
    status: _msg_actionlib_msgs.GoalStatus
    feedback: _msg_tf2_msgs.LookupTransformFeedback
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        status: _msg_actionlib_msgs.GoalStatus = ...,
        feedback: _msg_tf2_msgs.LookupTransformFeedback = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        status: _msg_actionlib_msgs.GoalStatus,
        feedback: _msg_tf2_msgs.LookupTransformFeedback,
        /,
    ) -> None: ...

class LookupTransformActionGoal(_t.Message):
    header: _msg_std_msgs.Header
    goal_id: _msg_actionlib_msgs.GoalID
    goal: _msg_tf2_msgs.LookupTransformGoal
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        goal_id: _msg_actionlib_msgs.GoalID = ...,
        goal: _msg_tf2_msgs.LookupTransformGoal = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        goal_id: _msg_actionlib_msgs.GoalID,
        goal: _msg_tf2_msgs.LookupTransformGoal,
        /,
    ) -> None: ...

class LookupTransformActionResult(_t.Message):
    header: _msg_std_msgs.Header
    status: _msg_actionlib_msgs.GoalStatus
    result: _msg_tf2_msgs.LookupTransformResult
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        status: _msg_actionlib_msgs.GoalStatus = ...,
        result: _msg_tf2_msgs.LookupTransformResult = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        status: _msg_actionlib_msgs.GoalStatus,
        result: _msg_tf2_msgs.LookupTransformResult,
        /,
    ) -> None: ...

class LookupTransformFeedback(_t.Message):
    def __init__(self) -> None: ...

class LookupTransformGoal(_t.Message):
    target_frame: _b.str
    source_frame: _b.str
    source_time: _t.Time
    timeout: _t.Duration
    target_time: _t.Time
    fixed_frame: _b.str
    advanced: _b.bool
    @_ty.overload
    def __init__(
        self,
        *,
        target_frame: _t.Text = ...,
        source_frame: _t.Text = ...,
        source_time: _t.Time = ...,
        timeout: _t.Duration = ...,
        target_time: _t.Time = ...,
        fixed_frame: _t.Text = ...,
        advanced: _t.Bool = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        target_frame: _t.Text,
        source_frame: _t.Text,
        source_time: _t.Time,
        timeout: _t.Duration,
        target_time: _t.Time,
        fixed_frame: _t.Text,
        advanced: _t.Bool,
        /,
    ) -> None: ...

class LookupTransformResult(_t.Message):
    transform: _msg_geometry_msgs.TransformStamped
    error: _msg_tf2_msgs.TF2Error
    @_ty.overload
    def __init__(
        self,
        *,
        transform: _msg_geometry_msgs.TransformStamped = ...,
        error: _msg_tf2_msgs.TF2Error = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        transform: _msg_geometry_msgs.TransformStamped,
        error: _msg_tf2_msgs.TF2Error,
        /,
    ) -> None: ...

class TF2Error(_t.Message):
    NO_ERROR: _ty.Final = 0
    LOOKUP_ERROR: _ty.Final = 1
    CONNECTIVITY_ERROR: _ty.Final = 2
    EXTRAPOLATION_ERROR: _ty.Final = 3
    INVALID_ARGUMENT_ERROR: _ty.Final = 4
    TIMEOUT_ERROR: _ty.Final = 5
    TRANSFORM_ERROR: _ty.Final = 6
    error: _b.int
    error_string: _b.str
    @_ty.overload
    def __init__(self, *, error: _t.Int = ..., error_string: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, error: _t.Int, error_string: _t.Text, /) -> None: ...

class TFMessage(_t.Message):
    transforms: _t.ItemList[_msg_geometry_msgs.TransformStamped]
    @_ty.overload
    def __init__(
        self,
        *,
        transforms: _t.Items[_msg_geometry_msgs.TransformStamped] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, transforms: _t.Items[_msg_geometry_msgs.TransformStamped], /) -> None: ...
