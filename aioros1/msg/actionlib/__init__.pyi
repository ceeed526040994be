# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.actionlib as _msg_actionlib
import aioros1.msg.actionlib_msgs as _msg_actionlib_msgs
import aioros1.msg.std_msgs as _msg_std_msgs

class TestAction(_t.Message):
    action_goal: _msg_actionlib.TestActionGoal
    action_result: _msg_actionlib.TestActionResult
    action_feedback: _msg_actionlib.TestActionFeedback
    @_ty.overload
    def __init__(
        self,
        *,
        action_goal: _msg_actionlib.TestActionGoal = ...,
        action_result: _msg_actionlib.TestActionResult = ...,
        action_feedback: _msg_actionlib.TestActionFeedback = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        action_goal: _msg_actionlib.TestActionGoal,
        action_result: _msg_actionlib.TestActionResult,
        action_feedback: _msg_actionlib.TestActionFeedback,
        /,
    ) -> None: ...

class TestActionFeedback(_t.Message):
    header: _msg_std_msgs.Header
    status: _msg_actionlib_msgs.GoalStatus
    feedback: _msg_actionlib.TestFeedback
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        status: _msg_actionlib_msgs.GoalStatus = ...,
        feedback: _msg_actionlib.TestFeedback = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        status: _msg_actionlib_msgs.GoalStatus,
        feedback: _msg_actionlib.TestFeedback,
        /,
    ) -> None: ...

class TestActionGoal(_t.Message):
    header: _msg_std_msgs.Header
    goal_id: _msg_actionlib_msgs.GoalID
    goal: _msg_actionlib.TestGoal
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        goal_id: _msg_actionlib_msgs.GoalID = ...,
        goal: _msg_actionlib.TestGoal = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        goal_id: _msg_actionlib_msgs.GoalID,
        goal: _msg_actionlib.TestGoal,
        /,
    ) -> None: ...

class TestActionResult(_t.Message):
    header: _msg_std_msgs.Header
    status: _msg_actionlib_msgs.GoalStatus
    result: _msg_actionlib.TestResult
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        status: _msg_actionlib_msgs.GoalStatus = ...,
        result: _msg_actionlib.TestResult = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        status: _msg_actionlib_msgs.GoalStatus,
        result: _msg_actionlib.TestResult,
        /,
    ) -> None: ...

class TestFeedback(_t.Message):
    feedback: _b.int
    @_ty.overload
    def __init__(self, *, feedback: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, feedback: _t.Int, /) -> None: ...

class TestGoal(_t.Message):
    goal: _b.int
    @_ty.overload
    def __init__(self, *, goal: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, goal: _t.Int, /) -> None: ...

class TestRequestAction(_t.Message):
    action_goal: _msg_actionlib.TestRequestActionGoal
    action_result: _msg_actionlib.TestRequestActionResult
    action_feedback: _msg_actionlib.TestRequestActionFeedback
    @_ty.overload
    def __init__(
        self,
        *,
        action_goal: _msg_actionlib.TestRequestActionGoal = ...,
        action_result: _msg_actionlib.TestRequestActionResult = ...,
        action_feedback: _msg_actionlib.TestRequestActionFeedback = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        action_goal: _msg_actionlib.TestRequestActionGoal,
        action_result: _msg_actionlib.TestRequestActionResult,
        action_feedback: _msg_actionlib.TestRequestActionFeedback,
        /,
    ) -> None: ...

class TestRequestActionFeedback(_t.Message):
    header: _msg_std_msgs.Header
    status: _msg_actionlib_msgs.GoalStatus
    feedback: _msg_actionlib.TestRequestFeedback
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        status: _msg_actionlib_msgs.GoalStatus = ...,
        feedback: _msg_actionlib.TestRequestFeedback = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        status: _msg_actionlib_msgs.GoalStatus,
        feedback: _msg_actionlib.TestRequestFeedback,
        /,
    ) -> None: ...

class TestRequestActionGoal(_t.Message):
    header: _msg_std_msgs.Header
    goal_id: _msg_actionlib_msgs.GoalID
    goal: _msg_actionlib.TestRequestGoal
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        goal_id: _msg_actionlib_msgs.GoalID = ...,
        goal: _msg_actionlib.TestRequestGoal = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        goal_id: _msg_actionlib_msgs.GoalID,
        goal: _msg_actionlib.TestRequestGoal,
        /,
    ) -> None: ...

class TestRequestActionResult(_t.Message):
    header: _msg_std_msgs.Header
    status: _msg_actionlib_msgs.GoalStatus
    result: _msg_actionlib.TestRequestResult
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        status: _msg_actionlib_msgs.GoalStatus = ...,
        result: _msg_actionlib.TestRequestResult = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        status: _msg_actionlib_msgs.GoalStatus,
        result: _msg_actionlib.TestRequestResult,
        /,
    ) -> None: ...

class TestRequestFeedback(_t.Message):
    def __init__(self) -> None: ...

class TestRequestGoal(_t.Message):
    TERMINATE_SUCCESS: _ty.Final = 0
    TERMINATE_ABORTED: _ty.Final = 1
    TERMINATE_REJECTED: _ty.Final = 2
    TERMINATE_LOSE: _ty.Final = 3
    TERMINATE_DROP: _ty.Final = 4
    TERMINATE_EXCEPTION: _ty.Final = 5
    terminate_status: _b.int
    ignore_cancel: _b.bool
    result_text: _b.str
    the_result: _b.int
    is_simple_client: _b.bool
    delay_accept: _t.Duration
    delay_terminate: _t.Duration
    pause_status: _t.Duration
    @_ty.overload
    def __init__(
        self,
        *,
        terminate_status: _t.Int = ...,
        ignore_cancel: _t.Bool = ...,
        result_text: _t.Text = ...,
        the_result: _t.Int = ...,
        is_simple_client: _t.Bool = ...,
        delay_accept: _t.Duration = ...,
        delay_terminate: _t.Duration = ...,
        pause_status: _t.Duration = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        terminate_status: _t.Int,
        ignore_cancel: _t.Bool,
        result_text: _t.Text,
        the_result: _t.Int,
        is_simple_client: _t.Bool,
        delay_accept: _t.Duration,
        delay_terminate: _t.Duration,
        pause_status: _t.Duration,
        /,
    ) -> None: ...

class TestRequestResult(_t.Message):
    the_result: _b.int
    is_simple_server: _b.bool
    @_ty.overload
    def __init__(self, *, the_result: _t.Int = ..., is_simple_server: _t.Bool = ...) -> None: ...
    @_ty.overload
    def __init__(self, the_result: _t.Int, is_simple_server: _t.Bool, /) -> None: ...

class TestResult(_t.Message):
    result: _b.int
    @_ty.overload
    def __init__(self, *, result: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, result: _t.Int, /) -> None: ...

class TwoIntsAction(_t.Message):
    action_goal: _msg_actionlib.TwoIntsActionGoal
    action_result: _msg_actionlib.TwoIntsActionResult
    action_feedback: _msg_actionlib.TwoIntsActionFeedback
    @_ty.overload
    def __init__(
        self,
        *,
        action_goal: _msg_actionlib.TwoIntsActionGoal = ...,
        action_result: _msg_actionlib.TwoIntsActionResult = ...,
        action_feedback: _msg_actionlib.TwoIntsActionFeedback = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        action_goal: _msg_actionlib.TwoIntsActionGoal,
        action_result: _msg_actionlib.TwoIntsActionResult,
        action_feedback: _msg_actionlib.TwoIntsActionFeedback,
        /,
    ) -> None: ...

class TwoIntsActionFeedback(_t.Message):
    header: _msg_std_msgs.Header
    status: _msg_actionlib_msgs.GoalStatus
    feedback: _msg_actionlib.TwoIntsFeedback
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        status: _msg_actionlib_msgs.GoalStatus = ...,
        feedback: _msg_actionlib.TwoIntsFeedback = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        status: _msg_actionlib_msgs.GoalStatus,
        feedback: _msg_actionlib.TwoIntsFeedback,
        /,
    ) -> None: ...

class TwoIntsActionGoal(_t.Message):
    header: _msg_std_msgs.Header
    goal_id: _msg_actionlib_msgs.GoalID
    goal: _msg_actionlib.TwoIntsGoal
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        goal_id: _msg_actionlib_msgs.GoalID = ...,
        goal: _msg_actionlib.TwoIntsGoal = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        goal_id: _msg_actionlib_msgs.GoalID,
        goal: _msg_actionlib.TwoIntsGoal,
        /,
    ) -> None: ...

class TwoIntsActionResult(_t.Message):
    header: _msg_std_msgs.Header
    status: _msg_actionlib_msgs.GoalStatus
    result: _msg_actionlib.TwoIntsResult
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        status: _msg_actionlib_msgs.GoalStatus = ...,
        result: _msg_actionlib.TwoIntsResult = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        status: _msg_actionlib_msgs.GoalStatus,
        result: _msg_actionlib.TwoIntsResult,
        /,
    ) -> None: ...

class TwoIntsFeedback(_t.Message):
    def __init__(self) -> None: ...

class TwoIntsGoal(_t.Message):
    a: _b.int
    b: _b.int
    @_ty.overload
    def __init__(self, *, a: _t.Int = ..., b: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, a: _t.Int, b: _t.Int, /) -> None: ...

class TwoIntsResult(_t.Message):
    sum: _b.int
    @_ty.overload
    def __init__(self, *, sum: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, sum: _t.Int, /) -> None: ...
