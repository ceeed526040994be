# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.nav_msgs as _msg_nav_msgs
import aioros1.msg.sensor_msgs as _msg_sensor_msgs
import aioros1.msg.std_msgs as _msg_std_msgs

class OccupancyGridUpdate(_t.Message):
    header: _msg_std_msgs.Header
    x: _b.int
    y: _b.int
    width: _b.int
    height: _b.int
    data: _t.IntArray
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        x: _t.Int = ...,
        y: _t.Int = ...,
        width: _t.Int = ...,
        height: _t.Int = ...,
        data: _t.Ints = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        x: _t.Int,
        y: _t.Int,
        width: _t.Int,
        height: _t.Int,
        data: _t.Ints,
        /,
    ) -> None: ...

class PointCloud2Update(_t.Message):
    ADD: _ty.Final = 0
    DELETE: _ty.Final = 1
    header: _msg_std_msgs.Header
    type: _b.int
    points: _msg_sensor_msgs.PointCloud2
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        type: _t.Int = ...,
        points: _msg_sensor_msgs.PointCloud2 = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        type: _t.Int,
        points: _msg_sensor_msgs.PointCloud2,
        /,
    ) -> None: ...

class ProjectedMap(_t.Message):
    map: _msg_nav_msgs.OccupancyGrid
    min_z: _b.float
    max_z: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        map: _msg_nav_msgs.OccupancyGrid = ...,
        min_z: _t.Float = ...,
        max_z: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        map: _msg_nav_msgs.OccupancyGrid,
        min_z: _t.Float,
        max_z: _t.Float,
        /,
    ) -> None: ...

class ProjectedMapInfo(_t.Message):
    frame_id: _b.str
    x: _b.float
    y: _b.float
    width: _b.float
    height: _b.float
    min_z: _b.float
    max_z: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        frame_id: _t.Text = ...,
        x: _t.Float = ...,
        y: _t.Float = ...,
        width: _t.Float = ...,
        height: _t.Float = ...,
        min_z: _t.Float = ...,
        max_z: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        frame_id: _t.Text,
        x: _t.Float,
        y: _t.Float,
        width: _t.Float,
        height: _t.Float,
        min_z: _t.Float,
        max_z: _t.Float,
        /,
    ) -> None: ...
