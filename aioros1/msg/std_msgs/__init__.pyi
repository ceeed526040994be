# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.std_msgs as _msg_std_msgs

class Bool(_t.Message):
    data: _b.bool
    @_ty.overload
    def __init__(self, *, data: _t.Bool = ...) -> None: ...
    @_ty.overload
    def __init__(self, data: _t.Bool, /) -> None: ...

class Byte(_t.Message):
    data: _b.int
    @_ty.overload
    def __init__(self, *, data: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, data: _t.Int, /) -> None: ...

class ByteMultiArray(_t.Message):
    layout: _msg_std_msgs.MultiArrayLayout
    data: _t.IntArray
    @_ty.overload
    def __init__(
        self,
        *,
        layout: _msg_std_msgs.MultiArrayLayout = ...,
        data: _t.Ints = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, layout: _msg_std_msgs.MultiArrayLayout, data: _t.Ints, /) -> None: ...

class Char(_t.Message):
    data: _b.int
    @_ty.overload
    def __init__(self, *, data: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, data: _t.Int, /) -> None: ...

class ColorRGBA(_t.Message):
    r: _b.float
    g: _b.float
    b: _b.float
    a: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        r: _t.Float = ...,
        g: _t.Float = ...,
        b: _t.Float = ...,
        a: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, r: _t.Float, g: _t.Float, b: _t.Float, a: _t.Float, /) -> None: ...

class Duration(_t.Message):
    data: _t.Duration
    @_ty.overload
    def __init__(self, *, data: _t.Duration = ...) -> None: ...
    @_ty.overload
    def __init__(self, data: _t.Duration, /) -> None: ...

class Empty(_t.Message):
    def __init__(self) -> None: ...

class Float32(_t.Message):
    data: _b.float
    @_ty.overload
    def __init__(self, *, data: _t.Float = ...) -> None: ...
    @_ty.overload
    def __init__(self, data: _t.Float, /) -> None: ...

class Float32MultiArray(_t.Message):
    layout: _msg_std_msgs.MultiArrayLayout
    data: _t.FloatArray
    @_ty.overload
    def __init__(
        self,
        *,
        layout: _msg_std_msgs.MultiArrayLayout = ...,
        data: _t.Floats = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, layout: _msg_std_msgs.MultiArrayLayout, data: _t.Floats, /) -> None: ...

class Float64(_t.Message):
    data: _b.float
    @_ty.overload
    def __init__(self, *, data: _t.Float = ...) -> None: ...
    @_ty.overload
    def __init__(self, data: _t.Float, /) -> None: ...

class Float64MultiArray(_t.Message):
    layout: _msg_std_msgs.MultiArrayLayout
    data: _t.FloatArray
    @_ty.overload
    def __init__(
        self,
        *,
        layout: _msg_std_msgs.MultiArrayLayout = ...,
        data: _t.Floats = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, layout: _msg_std_msgs.MultiArrayLayout, data: _t.Floats, /) -> None: ...

class Header(_t.Message):
    seq: _b.int
    stamp: _t.Time
    frame_id: _b.str
    @_ty.overload
    def __init__(
        self,
        *,
        seq: _t.Int = ...,
        stamp: _t.Time = ...,
        frame_id: _t.Text = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, seq: _t.Int, stamp: _t.Time, frame_id: _t.Text, /) -> None: ...

class Int16(_t.Message):
    data: _b.int
    @_ty.overload
    def __init__(self, *, data: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, data: _t.Int, /) -> None: ...

class Int16MultiArray(_t.Message):
    layout: _msg_std_msgs.MultiArrayLayout
    data: _t.IntArray
    @_ty.overload
    def __init__(
        self,
        *,
        layout: _msg_std_msgs.MultiArrayLayout = ...,
        data: _t.Ints = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, layout: _msg_std_msgs.MultiArrayLayout, data: _t.Ints, /) -> None: ...

class Int32(_t.Message):
    data: _b.int
    @_ty.overload
    def __init__(self, *, data: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, data: _t.Int, /) -> None: ...

class Int32MultiArray(_t.Message):
    layout: _msg_std_msgs.MultiArrayLayout
    data: _t.IntArray
    @_ty.overload
    def __init__(
        self,
        *,
        layout: _msg_std_msgs.MultiArrayLayout = ...,
        data: _t.Ints = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, layout: _msg_std_msgs.MultiArrayLayout, data: _t.Ints, /) -> None: ...

class Int64(_t.Message):
    data: _b.int
    @_ty.overload
    def __init__(self, *, data: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, data: _t.Int, /) -> None: ...

class Int64MultiArray(_t.Message):
    layout: _msg_std_msgs.MultiArrayLayout
    data: _t.IntArray
    @_ty.overload
    def __init__(
        self,
        *,
        layout: _msg_std_msgs.MultiArrayLayout = ...,
        data: _t.Ints = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, layout: _msg_std_msgs.MultiArrayLayout, data: _t.Ints, /) -> None: ...

class Int8(_t.Message):
    data: _b.int
    @_ty.overload
    def __init__(self, *, data: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, data: _t.Int, /) -> None: ...

class Int8MultiArray(_t.Message):
    layout: _msg_std_msgs.MultiArrayLayout
    data: _t.IntArray
    @_ty.overload
    def __init__(
        self,
        *,
        layout: _msg_std_msgs.MultiArrayLayout = ...,
        data: _t.Ints = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, layout: _msg_std_msgs.MultiArrayLayout, data: _t.Ints, /) -> None: ...

class MultiArrayDimension(_t.Message):
    label: _b.str
    size: _b.int
    stride: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        label: _t.Text = ...,
        size: _t.Int = ...,
        stride: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, label: _t.Text, size: _t.Int, stride: _t.Int, /) -> None: ...

class MultiArrayLayout(_t.Message):
    dim: _t.ItemList[_msg_std_msgs.MultiArrayDimension]
    data_offset: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        dim: _t.Items[_msg_std_msgs.MultiArrayDimension] = ...,
        data_offset: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        dim: _t.Items[_msg_std_msgs.MultiArrayDimension],
        data_offset: _t.Int,
        /,
    ) -> None: ...

class String(_t.Message):
    data: _b.str
    @_ty.overload
    def __init__(self, *, data: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, data: _t.Text, /) -> None: ...

class Time(_t.Message):
    data: _t.Time
    @_ty.overload
    def __init__(self, *, data: _t.Time = ...) -> None: ...
    @_ty.overload
    def __init__(self, data: _t.Time, /) -> None: ...

class UInt16(_t.Message):
    data: _b.int
    @_ty.overload
    def __init__(self, *, data: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, data: _t.Int, /) -> None: ...

class UInt16MultiArray(_t.Message):
    layout: _msg_std_msgs.MultiArrayLayout
    data: _t.IntArray
    @_ty.overload
    def __init__(
        self,
        *,
        layout: _msg_std_msgs.MultiArrayLayout = ...,
        data: _t.Ints = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, layout: _msg_std_msgs.MultiArrayLayout, data: _t.Ints, /) -> None: ...

class UInt32(_t.Message):
    data: _b.int
    @_ty.overload
    def __init__(self, *, data: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, data: _t.Int, /) -> None: ...

class UInt32MultiArray(_t.Message):
    layout: _msg_std_msgs.MultiArrayLayout
    data: _t.IntArray
    @_ty.overload
    def __init__(
        self,
        *,
        layout: _msg_std_msgs.MultiArrayLayout = ...,
        data: _t.Ints = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, layout: _msg_std_msgs.MultiArrayLayout, data: _t.Ints, /) -> None: ...

class UInt64(_t.Message):
    data: _b.int
    @_ty.overload
    def __init__(self, *, data: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, data: _t.Int, /) -> None: ...

class UInt64MultiArray(_t.Message):
    layout: _msg_std_msgs.MultiArrayLayout
    data: _t.IntArray
    @_ty.overload
    def __init__(
        self,
        *,
        layout: _msg_std_msgs.MultiArrayLayout = ...,
        data: _t.Ints = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, layout: _msg_std_msgs.MultiArrayLayout, data: _t.Ints, /) -> None: ...

class UInt8(_t.Message):
    data: _b.int
    @_ty.overload
    def __init__(self, *, data: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, data: _t.Int, /) -> None: ...

class UInt8MultiArray(_t.Message):
    layout: _msg_std_msgs.MultiArrayLayout
    data: _t.OctetArray
    @_ty.overload
    def __init__(
        self,
        *,
        layout: _msg_std_msgs.MultiArrayLayout = ...,
        data: _t.Octets = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, layout: _msg_std_msgs.MultiArrayLayout, data: _t.Octets, /) -> None: ...
