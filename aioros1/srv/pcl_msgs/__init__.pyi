# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t

class UpdateFilenameRequest(_t.Message):
    filename: _b.str
    @_ty.overload
    def __init__(self, *, filename: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, filename: _t.Text, /) -> None: ...

class UpdateFilenameResponse(_t.Message):
    success: _b.bool
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, /) -> None: ...

class UpdateFilename(_t.Service[UpdateFilenameRequest, UpdateFilenameResponse]):
    Request: _ty.TypeAlias = UpdateFilenameRequest
    Response: _ty.TypeAlias = UpdateFilenameResponse
