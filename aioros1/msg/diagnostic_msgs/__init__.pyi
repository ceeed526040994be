# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.diagnostic_msgs as _msg_diagnostic_msgs
import aioros1.msg.std_msgs as _msg_std_msgs

class DiagnosticArray(_t.Message):
    header: _msg_std_msgs.Header
    status: _t.ItemList[_msg_diagnostic_msgs.DiagnosticStatus]
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        status: _t.Items[_msg_diagnostic_msgs.DiagnosticStatus] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        status: _t.Items[_msg_diagnostic_msgs.DiagnosticStatus],
        /,
    ) -> None: ...

class DiagnosticStatus(_t.Message):
    OK: _ty.Final = 0
    WARN: _ty.Final = 1
    ERROR: _ty.Final = 2
    STALE: _ty.Final = 3
    level: _b.int
    name: _b.str
    message: _b.str
    hardware_id: _b.str
    values: _t.ItemList[_msg_diagnostic_msgs.KeyValue]
    @_ty.overload
    def __init__(
        self,
        *,
        level: _t.Int = ...,
        name: _t.Text = ...,
        message: _t.Text = ...,
        hardware_id: _t.Text = ...,
        values: _t.Items[_msg_diagnostic_msgs.KeyValue] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        level: _t.Int,
        name: _t.Text,
        message: _t.Text,
        hardware_id: _t.Text,
        values: _t.Items[_msg_diagnostic_msgs.KeyValue],
        /,
    ) -> None: ...

class KeyValue(_t.Message):
    key: _b.str
    value: _b.str
    @_ty.overload
    def __init__(self, *, key: _t.Text = ..., value: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, key: _t.Text, value: _t.Text, /) -> None: ...
