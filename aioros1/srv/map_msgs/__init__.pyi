# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.map_msgs as _msg_map_msgs
import aioros1.msg.nav_msgs as _msg_nav_msgs
import aioros1.msg.sensor_msgs as _msg_sensor_msgs
import aioros1.msg.std_msgs as _msg_std_msgs

class GetMapROIRequest(_t.Message):
    x: _b.float
    y: _b.float
    l_x: _b.float
    l_y: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        x: _t.Float = ...,
        y: _t.Float = ...,
        l_x: _t.Float = ...,
        l_y: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, x: _t.Float, y: _t.Float, l_x: _t.Float, l_y: _t.Float, /) -> None: ...

class GetMapROIResponse(_t.Message):
    sub_map: _msg_nav_msgs.OccupancyGrid
    @_ty.overload
    def __init__(self, *, sub_map: _msg_nav_msgs.OccupancyGrid = ...) -> None: ...
    @_ty.overload
    def __init__(self, sub_map: _msg_nav_msgs.OccupancyGrid, /) -> None: ...

class GetMapROI(_t.Service[GetMapROIRequest, GetMapROIResponse]):
    Request: _ty.TypeAlias = GetMapROIRequest
    Response: _ty.TypeAlias = GetMapROIResponse

class GetPointMapRequest(_t.Message):
    def __init__(self) -> None: ...

class GetPointMapResponse(_t.Message):
    map: _msg_sensor_msgs.PointCloud2
    @_ty.overload
    def __init__(self, *, map: _msg_sensor_msgs.PointCloud2 = ...) -> None: ...
    @_ty.overload
    def __init__(self, map: _msg_sensor_msgs.PointCloud2, /) -> None: ...

class GetPointMap(_t.Service[GetPointMapRequest, GetPointMapResponse]):
    Request: _ty.TypeAlias = GetPointMapRequest
    Response: _ty.TypeAlias = GetPointMapResponse

class GetPointMapROIRequest(_t.Message):
    x: _b.float
    y: _b.float
    z: _b.float
    r: _b.float
    l_x: _b.float
    l_y: _b.float
    l_z: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        x: _t.Float = ...,
        y: _t.Float = ...,
        z: _t.Float = ...,
        r: _t.Float = ...,
        l_x: _t.Float = ...,
        l_y: _t.Float = ...,
        l_z: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        x: _t.Float,
        y: _t.Float,
        z: _t.Float,
        r: _t.Float,
        l_x: _t.Float,
        l_y: _t.Float,
        l_z: _t.Float,
        /,
    ) -> None: ...

class GetPointMapROIResponse(_t.Message):
    sub_map: _msg_sensor_msgs.PointCloud2
    @_ty.overload
    def __init__(self, *, sub_map: _msg_sensor_msgs.PointCloud2 = ...) -> None: ...
    @_ty.overload
    def __init__(self, sub_map: _msg_sensor_msgs.PointCloud2, /) -> None: ...

class GetPointMapROI(_t.Service[GetPointMapROIRequest, GetPointMapROIResponse]):
    Request: _ty.TypeAlias = GetPointMapROIRequest
    Response: _ty.TypeAlias = GetPointMapROIResponse

class ProjectedMapsInfoRequest(_t.Message):
    projected_maps_info: _t.ItemList[_msg_map_msgs.ProjectedMapInfo]
    @_ty.overload
    def __init__(
        self,
        *,
        projected_maps_info: _t.Items[_msg_map_msgs.ProjectedMapInfo] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        projected_maps_info: _t.Items[_msg_map_msgs.ProjectedMapInfo],
        /,
    ) -> None: ...

class ProjectedMapsInfoResponse(_t.Message):
    def __init__(self) -> None: ...

class ProjectedMapsInfo(_t.Service[ProjectedMapsInfoRequest, ProjectedMapsInfoResponse]):
    Request: _ty.TypeAlias = ProjectedMapsInfoRequest
    Response: _ty.TypeAlias = ProjectedMapsInfoResponse

class SaveMapRequest(_t.Message):
    filename: _msg_std_msgs.String
    @_ty.overload
    def __init__(self, *, filename: _msg_std_msgs.String = ...) -> None: ...
    @_ty.overload
    def __init__(self, filename: _msg_std_msgs.String, /) -> None: ...

class SaveMapResponse(_t.Message):
    def __init__(self) -> None: ...

class SaveMap(_t.Service[SaveMapRequest, SaveMapResponse]):
    Request: _ty.TypeAlias = SaveMapRequest
    Response: _ty.TypeAlias = SaveMapResponse

class SetMapProjectionsRequest(_t.Message):
    def __init__(self) -> None: ...

class SetMapProjectionsResponse(_t.Message):
    projected_maps_info: _t.ItemList[_msg_map_msgs.ProjectedMapInfo]
    @_ty.overload
    def __init__(
        self,
        *,
        projected_maps_info: _t.Items[_msg_map_msgs.ProjectedMapInfo] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        projected_maps_info: _t.Items[_msg_map_msgs.ProjectedMapInfo],
        /,
    ) -> None: ...

class SetMapProjections(_t.Service[SetMapProjectionsRequest, SetMapProjectionsResponse]):
    Request: _ty.TypeAlias = SetMapProjectionsRequest
    Response: _ty.TypeAlias = SetMapProjectionsResponse
