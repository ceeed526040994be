# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.diagnostic_msgs as _msg_diagnostic_msgs

class AddDiagnosticsRequest(_t.Message):
    load_namespace: _b.str
    @_ty.overload
    def __init__(self, *, load_namespace: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, load_namespace: _t.Text, /) -> None: ...

class AddDiagnosticsResponse(_t.Message):
    success: _b.bool
    message: _b.str
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., message: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, message: _t.Text, /) -> None: ...

class AddDiagnostics(_t.Service[AddDiagnosticsRequest, AddDiagnosticsResponse]):
    Request: _ty.TypeAlias = AddDiagnosticsRequest
    Response: _ty.TypeAlias = AddDiagnosticsResponse

class SelfTestRequest(_t.Message):
    def __init__(self) -> None: ...

class SelfTestResponse(_t.Message):
    id: _b.str
    passed: _b.int
    status: _t.ItemList[_msg_diagnostic_msgs.DiagnosticStatus]
    @_ty.overload
    def __init__(
        self,
        *,
        id: _t.Text = ...,
        passed: _t.Int = ...,
        status: _t.Items[_msg_diagnostic_msgs.DiagnosticStatus] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        id: _t.Text,
        passed: _t.Int,
        status: _t.Items[_msg_diagnostic_msgs.DiagnosticStatus],
        /,
    ) -> None: ...

class SelfTest(_t.Service[SelfTestRequest, SelfTestResponse]):
    Request: _ty.TypeAlias = SelfTestRequest
    Response: _ty.TypeAlias = SelfTestResponse
