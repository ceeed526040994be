# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.geometry_msgs as _msg_geometry_msgs
import aioros1.msg.nav_msgs as _msg_nav_msgs

class GetMapRequest(_t.Message):
    def __init__(self) -> None: ...

class GetMapResponse(_t.Message):
    map: _msg_nav_msgs.OccupancyGrid
    @_ty.overload
    def __init__(self, *, map: _msg_nav_msgs.OccupancyGrid = ...) -> None: ...
    @_ty.overload
    def __init__(self, map: _msg_nav_msgs.OccupancyGrid, /) -> None: ...

class GetMap(_t.Service[GetMapRequest, GetMapResponse]):
    Request: _ty.TypeAlias = GetMapRequest
    Response: _ty.TypeAlias = GetMapResponse

class GetPlanRequest(_t.Message):
    start: _msg_geometry_msgs.PoseStamped
    goal: _msg_geometry_msgs.PoseStamped
    tolerance: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        start: _msg_geometry_msgs.PoseStamped = ...,
        goal: _msg_geometry_msgs.PoseStamped = ...,
        tolerance: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        start: _msg_geometry_msgs.PoseStamped,
        goal: _msg_geometry_msgs.PoseStamped,
        tolerance: _t.Float,
        /,
    ) -> None: ...

class GetPlanResponse(_t.Message):
    plan: _msg_nav_msgs.Path
    @_ty.overload
    def __init__(self, *, plan: _msg_nav_msgs.Path = ...) -> None: ...
    @_ty.overload
    def __init__(self, plan: _msg_nav_msgs.Path, /) -> None: ...

class GetPlan(_t.Service[GetPlanRequest, GetPlanResponse]):
    Request: _ty.TypeAlias = GetPlanRequest
    Response: _ty.TypeAlias = GetPlanResponse

class LoadMapRequest(_t.Message):
    map_url: _b.str
    @_ty.overload
    def __init__(self, *, map_url: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, map_url: _t.Text, /) -> None: ...

class LoadMapResponse(_t.Message):
    RESULT_SUCCESS: _ty.Final = 0
    RESULT_MAP_DOES_NOT_EXIST: _ty.Final = 1
    RESULT_INVALID_MAP_DATA: _ty.Final = 2
    RESULT_INVALID_MAP_METADATA: _ty.Final = 3
    RESULT_UNDEFINED_FAILURE: _ty.Final = 255
    map: _msg_nav_msgs.OccupancyGrid
    result: _b.int
    @_ty.overload
    def __init__(self, *, map: _msg_nav_msgs.OccupancyGrid = ..., result: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, map: _msg_nav_msgs.OccupancyGrid, result: _t.Int, /) -> None: ...

class LoadMap(_t.Service[LoadMapRequest, LoadMapResponse]):
    Request: _ty.TypeAlias = LoadMapRequest
    Response: _ty.TypeAlias = LoadMapResponse

class SetMapRequest(_t.Message):
    map: _msg_nav_msgs.OccupancyGrid
    initial_pose: _msg_geometry_msgs.PoseWithCovarianceStamped
    @_ty.overload
    def __init__(
        self,
        *,
        map: _msg_nav_msgs.OccupancyGrid = ...,
        initial_pose: _msg_geometry_msgs.PoseWithCovarianceStamped = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        map: _msg_nav_msgs.OccupancyGrid,
        initial_pose: _msg_geometry_msgs.PoseWithCovarianceStamped,
        /,
    ) -> None: ...

class SetMapResponse(_t.Message):
    success: _b.bool
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, /) -> None: ...

class SetMap(_t.Service[SetMapRequest, SetMapResponse]):
    Request: _ty.TypeAlias = SetMapRequest
    Response: _ty.TypeAlias = SetMapResponse
