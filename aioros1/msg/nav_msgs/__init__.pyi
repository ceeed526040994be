# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.actionlib_msgs as _msg_actionlib_msgs
import aioros1.msg.geometry_msgs as _msg_geometry_msgs
import aioros1.msg.nav_msgs as _msg_nav_msgs
import aioros1.msg.std_msgs as _msg_std_msgs

class GetMapAction(_t.Message):
    action_goal: _msg_nav_msgs.GetMapActionGoal
    action_result: _msg_nav_msgs.GetMapActionResult
    action_feedback: _msg_nav_msgs.GetMapActionFeedback
    @_ty.overload
    def __init__(
        self,
        *,
        action_goal: _msg_nav_msgs.GetMapActionGoal = ...,
        action_result: _msg_nav_msgs.GetMapActionResult = ...,
        action_feedback: _msg_nav_msgs.GetMapActionFeedback = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        action_goal: _msg_nav_msgs.GetMapActionGoal,
        action_result: _msg_nav_msgs.GetMapActionResult,
        action_feedback: _msg_nav_msgs.GetMapActionFeedback,
        /,
    ) -> None: ...

class GetMapActionFeedback(_t.Message):
    header: _msg_std_msgs.Header
    status: _msg_actionlib_msgs.GoalStatus
    feedback: _msg_nav_msgs.GetMapFeedback
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        status: _msg_actionlib_msgs.GoalStatus = ...,
        feedback: _msg_nav_msgs.GetMapFeedback = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        status: _msg_actionlib_msgs.GoalStatus,
        feedback: _msg_nav_msgs.GetMapFeedback,
        /,
    ) -> None: ...

class GetMapActionGoal(_t.Message):
    header: _msg_std_msgs.Header
    goal_id: _msg_actionlib_msgs.GoalID
    goal: _msg_nav_msgs.GetMapGoal
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        goal_id: _msg_actionlib_msgs.GoalID = ...,
        goal: _msg_nav_msgs.GetMapGoal = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        goal_id: _msg_actionlib_msgs.GoalID,
        goal: _msg_nav_msgs.GetMapGoal,
        /,
    ) -> None: ...

class GetMapActionResult(_t.Message):
    header: _msg_std_msgs.Header
    status: _msg_actionlib_msgs.GoalStatus
    result: _msg_nav_msgs.GetMapResult
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        status: _msg_actionlib_msgs.GoalStatus = ...,
        result: _msg_nav_msgs.GetMapResult = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        status: _msg_actionlib_msgs.GoalStatus,
        result: _msg_nav_msgs.GetMapResult,
        /,
    ) -> None: ...

class GetMapFeedback(_t.Message):
    def __init__(self) -> None: ...

class GetMapGoal(_t.Message):
    def __init__(self) -> None: ...

class GetMapResult(_t.Message):
    map: _msg_nav_msgs.OccupancyGrid
    @_ty.overload
    def __init__(self, *, map: _msg_nav_msgs.OccupancyGrid = ...) -> None: ...
    @_ty.overload
    def __init__(self, map: _msg_nav_msgs.OccupancyGrid, /) -> None: ...

class GridCells(_t.Message):
    header: _msg_std_msgs.Header
    cell_width: _b.float
    cell_height: _b.float
    cells: _t.ItemList[_msg_geometry_msgs.Point]
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        cell_width: _t.Float = ...,
        cell_height: _t.Float = ...,
        cells: _t.Items[_msg_geometry_msgs.Point] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        cell_width: _t.Float,
        cell_height: _t.Float,
        cells: _t.Items[_msg_geometry_msgs.Point],
        /,
    ) -> None: ...

class MapMetaData(_t.Message):
    map_load_time: _t.Time
    resolution: _b.float
    width: _b.int
    height: _b.int
    origin: _msg_geometry_msgs.Pose
    @_ty.overload
    def __init__(
        self,
        *,
        map_load_time: _t.Time = ...,
        resolution: _t.Float = ...,
        width: _t.Int = ...,
        height: _t.Int = ...,
        origin: _msg_geometry_msgs.Pose = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        map_load_time: _t.Time,
        resolution: _t.Float,
        width: _t.Int,
        height: _t.Int,
        origin: _msg_geometry_msgs.Pose,
        /,
    ) -> None: ...

class OccupancyGrid(_t.Message):
    header: _msg_std_msgs.Header
    info: _msg_nav_msgs.MapMetaData
    data: _t.IntArray
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        info: _msg_nav_msgs.MapMetaData = ...,
        data: _t.Ints = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        info: _msg_nav_msgs.MapMetaData,
        data: _t.Ints,
        /,
    ) -> None: ...

class Odometry(_t.Message):
    header: _msg_std_msgs.Header
    child_frame_id: _b.str
    pose: _msg_geometry_msgs.PoseWithCovariance
    twist: _msg_geometry_msgs.TwistWithCovariance
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        child_frame_id: _t.Text = ...,
        pose: _msg_geometry_msgs.PoseWithCovariance = ...,
        twist: _msg_geometry_msgs.TwistWithCovariance = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        child_frame_id: _t.Text,
        pose: _msg_geometry_msgs.PoseWithCovariance,
        twist: _msg_geometry_msgs.TwistWithCovariance,
        /,
    ) -> None: ...

class Path(_t.Message):
    header: _msg_std_msgs.Header
    poses: _t.ItemList[_msg_geometry_msgs.PoseStamped]
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        poses: _t.Items[_msg_geometry_msgs.PoseStamped] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        poses: _t.Items[_msg_geometry_msgs.PoseStamped],
        /,
    ) -> None: ...
