# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.actionlib_msgs as _msg_actionlib_msgs
import aioros1.msg.std_msgs as _msg_std_msgs

class GoalID(_t.Message):
    stamp: _t.Time
    id: _b.str
    @_ty.overload
    def __init__(self, *, stamp: _t.Time = ..., id: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, stamp: _t.Time, id: _t.Text, /) -> None: ...

class GoalStatus(_t.Message):
    PENDING: _ty.Final = 0
    ACTIVE: _ty.Final = 1
    PREEMPTED: _ty.Final = 2
    SUCCEEDED: _ty.Final = 3
    ABORTED: _ty.Final = 4
    REJECTED: _ty.Final = 5
    PREEMPTING: _ty.Final = 6
    RECALLING: _ty.Final = 7
    RECALLED: _ty.Final = 8
    LOST: _ty.Final = 9
    goal_id: _msg_actionlib_msgs.GoalID
    status: _b.int
    text: _b.str
    @_ty.overload
    def __init__(
        self,
        *,
        goal_id: _msg_actionlib_msgs.GoalID = ...,
        status: _t.Int = ...,
        text: _t.Text = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        goal_id: _msg_actionlib_msgs.GoalID,
        status: _t.Int,
        text: _t.Text,
        /,
    ) -> None: ...

class GoalStatusArray(_t.Message):
    header: _msg_std_msgs.Header
    status_list: _t.ItemList[_msg_actionlib_msgs.GoalStatus]
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        status_list: _t.Items[_msg_actionlib_msgs.GoalStatus] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        status_list: _t.Items[_msg_actionlib_msgs.GoalStatus],
        /,
    ) -> None: ...
