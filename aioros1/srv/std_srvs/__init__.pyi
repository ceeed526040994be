# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t

class EmptyRequest(_t.Message):
    def __init__(self) -> None: ...

class EmptyResponse(_t.Message):
    def __init__(self) -> None: ...

class Empty(_t.Service[EmptyRequest, EmptyResponse]):
    Request: _ty.TypeAlias = EmptyRequest
    Response: _ty.TypeAlias = EmptyResponse

class SetBoolRequest(_t.Message):
    data: _b.bool
    @_ty.overload
    def __init__(self, *, data: _t.Bool = ...) -> None: ...
    @_ty.overload
    def __init__(self, data: _t.Bool, /) -> None: ...

class SetBoolResponse(_t.Message):
    success: _b.bool
    message: _b.str
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., message: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, message: _t.Text, /) -> None: ...

class SetBool(_t.Service[SetBoolRequest, SetBoolResponse]):
    Request: _ty.TypeAlias = SetBoolRequest
    Response: _ty.TypeAlias = SetBoolResponse

class TriggerRequest(_t.Message):
    def __init__(self) -> None: ...

class TriggerResponse(_t.Message):
    success: _b.bool
    message: _b.str
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., message: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, message: _t.Text, /) -> None: ...

class Trigger(_t.Service[TriggerRequest, TriggerResponse]):
    Request: _ty.TypeAlias = TriggerRequest
    Response: _ty.TypeAlias = TriggerResponse
