# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.geometry_msgs as _msg_geometry_msgs
import aioros1.msg.shape_msgs as _msg_shape_msgs

class Mesh(_t.Message):
    triangles: _t.ItemList[_msg_shape_msgs.MeshTriangle]
    vertices: _t.ItemList[_msg_geometry_msgs.Point]
    @_ty.overload
    def __init__(
        self,
        *,
        triangles: _t.Items[_msg_shape_msgs.MeshTriangle] = ...,
        vertices: _t.Items[_msg_geometry_msgs.Point] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        triangles: _t.Items[_msg_shape_msgs.MeshTriangle],
        vertices: _t.Items[_msg_geometry_msgs.Point],
        /,
    ) -> None: ...

class MeshTriangle(_t.Message):
    vertex_indices: _t.IntArray
    @_ty.overload
    def __init__(self, *, vertex_indices: _t.Ints = ...) -> None: ...
    @_ty.overload
    def __init__(self, vertex_indices: _t.Ints, /) -> None: ...

class Plane(_t.Message):
    coef: _t.FloatArray
    @_ty.overload
    def __init__(self, *, coef: _t.Floats = ...) -> None: ...
    @_ty.overload
    def __init__(self, coef: _t.Floats, /) -> None: ...

class SolidPrimitive(_t.Message):
    BOX: _ty.Final = 1
    SPHERE: _ty.Final = 2
    CYLINDER: _ty.Final = 3
    CONE: _ty.Final = 4
    BOX_X: _ty.Final = 0
    BOX_Y: _ty.Final = 1
    BOX_Z: _ty.Final = 2
    SPHERE_RADIUS: _ty.Final = 0
    CYLINDER_HEIGHT: _ty.Final = 0
    CYLINDER_RADIUS: _ty.Final = 1
    CONE_HEIGHT: _ty.Final = 0
    CONE_RADIUS: _ty.Final = 1
    type: _b.int
    dimensions: _t.FloatArray
    @_ty.overload
    def __init__(self, *, type: _t.Int = ..., dimensions: _t.Floats = ...) -> None: ...
    @_ty.overload
    def __init__(self, type: _t.Int, dimensions: _t.Floats, /) -> None: ...
