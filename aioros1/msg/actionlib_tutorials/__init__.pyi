# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.actionlib_msgs as _msg_actionlib_msgs
import aioros1.msg.actionlib_tutorials as _msg_actionlib_tutorials
import aioros1.msg.std_msgs as _msg_std_msgs

class AveragingAction(_t.Message):
    action_goal: _msg_actionlib_tutorials.AveragingActionGoal
    action_result: _msg_actionlib_tutorials.AveragingActionResult
    action_feedback: _msg_actionlib_tutorials.AveragingActionFeedback
    @_ty.overload
    def __init__(
        self,
        *,
        action_goal: _msg_actionlib_tutorials.AveragingActionGoal = ...,
        action_result: _msg_actionlib_tutorials.AveragingActionResult = ...,
        action_feedback: _msg_actionlib_tutorials.AveragingActionFeedback = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        action_goal: _msg_actionlib_tutorials.AveragingActionGoal,
        action_result: _msg_actionlib_tutorials.AveragingActionResult,
        action_feedback: _msg_actionlib_tutorials.AveragingActionFeedback,
        /,
    ) -> None: ...

class AveragingActionFeedback(_t.Message):
    header: _msg_std_msgs.Header
    status: _msg_actionlib_msgs.GoalStatus
    feedback: _msg_actionlib_tutorials.AveragingFeedback
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        status: _msg_actionlib_msgs.GoalStatus = ...,
        feedback: _msg_actionlib_tutorials.AveragingFeedback = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        status: _msg_actionlib_msgs.GoalStatus,
        feedback: _msg_actionlib_tutorials.AveragingFeedback,
        /,
    ) -> None: ...

class AveragingActionGoal(_t.Message):
    header: _msg_std_msgs.Header
    goal_id: _msg_actionlib_msgs.GoalID
    goal: _msg_actionlib_tutorials.AveragingGoal
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        goal_id: _msg_actionlib_msgs.GoalID = ...,
        goal: _msg_actionlib_tutorials.AveragingGoal = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        goal_id: _msg_actionlib_msgs.GoalID,
        goal: _msg_actionlib_tutorials.AveragingGoal,
        /,
    ) -> None: ...

class AveragingActionResult(_t.Message):
    header: _msg_std_msgs.Header
    status: _msg_actionlib_msgs.GoalStatus
    result: _msg_actionlib_tutorials.AveragingResult
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        status: _msg_actionlib_msgs.GoalStatus = ...,
        result: _msg_actionlib_tutorials.AveragingResult = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        status: _msg_actionlib_msgs.GoalStatus,
        result: _msg_actionlib_tutorials.AveragingResult,
        /,
    ) -> None: ...

class AveragingFeedback(_t.Message):
    sample: _b.int
    data: _b.float
    mean: _b.float
    std_dev: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        sample: _t.Int = ...,
        data: _t.Float = ...,
        mean: _t.Float = ...,
        std_dev: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        sample: _t.Int,
        data: _t.Float,
        mean: _t.Float,
        std_dev: _t.Float,
        /,
    ) -> None: ...

class AveragingGoal(_t.Message):
    samples: _b.int
    @_ty.overload
    def __init__(self, *, samples: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, samples: _t.Int, /) -> None: ...

class AveragingResult(_t.Message):
    mean: _b.float
    std_dev: _b.float
    @_ty.overload
    def __init__(self, *, mean: _t.Float = ..., std_dev: _t.Float = ...) -> None: ...
    @_ty.overload
    def __init__(self, mean: _t.Float, std_dev: _t.Float, /) -> None: ...

class FibonacciAction(_t.Message):
    action_goal: _msg_actionlib_tutorials.FibonacciActionGoal
    action_result: _msg_actionlib_tutorials.FibonacciActionResult
    action_feedback: _msg_actionlib_tutorials.FibonacciActionFeedback
    @_ty.overload
    def __init__(
        self,
        *,
        action_goal: _msg_actionlib_tutorials.FibonacciActionGoal = ...,
        action_result: _msg_actionlib_tutorials.FibonacciActionResult = ...,
        action_feedback: _msg_actionlib_tutorials.FibonacciActionFeedback = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        action_goal: _msg_actionlib_tutorials.FibonacciActionGoal,
        action_result: _msg_actionlib_tutorials.FibonacciActionResult,
        action_feedback: _msg_actionlib_tutorials.FibonacciActionFeedback,
        /,
    ) -> None: ...

class FibonacciActionFeedback(_t.Message):
    header: _msg_std_msgs.Header
    status: _msg_actionlib_msgs.GoalStatus
    feedback: _msg_actionlib_tutorials.FibonacciFeedback
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        status: _msg_actionlib_msgs.GoalStatus = ...,
        feedback: _msg_actionlib_tutorials.FibonacciFeedback = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        status: _msg_actionlib_msgs.GoalStatus,
        feedback: _msg_actionlib_tutorials.FibonacciFeedback,
        /,
    ) -> None: ...

class FibonacciActionGoal(_t.Message):
    header: _msg_std_msgs.Header
    goal_id: _msg_actionlib_msgs.GoalID
    goal: _msg_actionlib_tutorials.FibonacciGoal
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        goal_id: _msg_actionlib_msgs.GoalID = ...,
        goal: _msg_actionlib_tutorials.FibonacciGoal = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        goal_id: _msg_actionlib_msgs.GoalID,
        goal: _msg_actionlib_tutorials.FibonacciGoal,
        /,
    ) -> None: ...

class FibonacciActionResult(_t.Message):
    header: _msg_std_msgs.Header
    status: _msg_actionlib_msgs.GoalStatus
    result: _msg_actionlib_tutorials.FibonacciResult
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        status: _msg_actionlib_msgs.GoalStatus = ...,
        result: _msg_actionlib_tutorials.FibonacciResult = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        status: _msg_actionlib_msgs.GoalStatus,
        result: _msg_actionlib_tutorials.FibonacciResult,
        /,
    ) -> None: ...

class FibonacciFeedback(_t.Message):
    sequence: _t.IntArray
    @_ty.overload
    def __init__(self, *, sequence: _t.Ints = ...) -> None: ...
    @_ty.overload
    def __init__(self, sequence: _t.Ints, /) -> None: ...

class FibonacciGoal(_t.Message):
    order: _b.int
    @_ty.overload
    def __init__(self, *, order: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, order: _t.Int, /) -> None: ...

class FibonacciResult(_t.Message):
    sequence: _t.IntArray
    @_ty.overload
    def __init__(self, *, sequence: _t.Ints = ...) -> None: ...
    @_ty.overload
    def __init__(self, sequence: _t.Ints, /) -> None: ...
