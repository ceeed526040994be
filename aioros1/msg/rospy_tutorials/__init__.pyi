# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.std_msgs as _msg_std_msgs

class Floats(_t.Message):
    data: _t.FloatArray
    @_ty.overload
    def __init__(self, *, data: _t.Floats = ...) -> None: ...
    @_ty.overload
    def __init__(self, data: _t.Floats, /) -> None: ...

class HeaderString(_t.Message):
    header: _msg_std_msgs.Header
    data: _b.str
    @_ty.overload
    def __init__(self, *, header: _msg_std_msgs.Header = ..., data: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, header: _msg_std_msgs.Header, data: _t.Text, /) -> None: ...
