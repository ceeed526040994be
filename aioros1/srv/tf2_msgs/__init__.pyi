# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t

class FrameGraphRequest(_t.Message):
    def __init__(self) -> None: ...

class FrameGraphResponse(_t.Message):
    frame_yaml: _b.str
    @_ty.overload
    def __init__(self, *, frame_yaml: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, frame_yaml: _t.Text, /) -> None: ...

class FrameGraph(_t.Service[FrameGraphRequest, FrameGraphResponse]):
    Request: _ty.TypeAlias = FrameGraphRequest
    Response: _ty.TypeAlias = FrameGraphResponse
