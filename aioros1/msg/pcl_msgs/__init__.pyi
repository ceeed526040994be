# Made by aioros1 from message definitions. Change those, and have it made anew.
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.pcl_msgs as _msg_pcl_msgs
import aioros1.msg.sensor_msgs as _msg_sensor_msgs
import aioros1.msg.std_msgs as _msg_std_msgs

class ModelCoefficients(_t.Message):
    header: _msg_std_msgs.Header
    values: _t.FloatArray
    @_ty.overload
    def __init__(self, *, header: _msg_std_msgs.Header = ..., values: _t.Floats = ...) -> None: ...
    @_ty.overload
    def __init__(self, header: _msg_std_msgs.Header, values: _t.Floats, /) -> None: ...

class PointIndices(_t.Message):
    header: _msg_std_msgs.Header
    indices: _t.IntArray
    @_ty.overload
    def __init__(self, *, header: _msg_std_msgs.Header = ..., indices: _t.Ints = ...) -> None: ...
    @_ty.overload
    def __init__(self, header: _msg_std_msgs.Header, indices: _t.Ints, /) -> None: ...

class PolygonMesh(_t.Message):
    header: _msg_std_msgs.Header
    cloud: _msg_sensor_msgs.PointCloud2
    polygons: _t.ItemList[_msg_pcl_msgs.Vertices]
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        cloud: _msg_sensor_msgs.PointCloud2 = ...,
        polygons: _t.Items[_msg_pcl_msgs.Vertices] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        cloud: _msg_sensor_msgs.PointCloud2,
        polygons: _t.Items[_msg_pcl_msgs.Vertices],
        /,
    ) -> None: ...

class Vertices(_t.Message):
    vertices: _t.IntArray
    @_ty.overload
    def __init__(self, *, vertices: _t.Ints = ...) -> None: ...
    @_ty.overload
    def __init__(self, vertices: _t.Ints, /) -> None: ...
