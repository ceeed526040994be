# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.roscpp as _msg_roscpp

class EmptyRequest(_t.Message):
    def __init__(self) -> None: ...

class EmptyResponse(_t.Message):
    def __init__(self) -> None: ...

class Empty(_t.Service[EmptyRequest, EmptyResponse]):
    Request: _ty.TypeAlias = EmptyRequest
    Response: _ty.TypeAlias = EmptyResponse

class GetLoggersRequest(_t.Message):
    def __init__(self) -> None: ...

class GetLoggersResponse(_t.Message):
    loggers: _t.ItemList[_msg_roscpp.Logger]
    @_ty.overload
    def __init__(self, *, loggers: _t.Items[_msg_roscpp.Logger] = ...) -> None: ...
    @_ty.overload
    def __init__(self, loggers: _t.Items[_msg_roscpp.Logger], /) -> None: ...

class GetLoggers(_t.Service[GetLoggersRequest, GetLoggersResponse]):
    Request: _ty.TypeAlias = GetLoggersRequest
    Response: _ty.TypeAlias = GetLoggersResponse

class SetLoggerLevelRequest(_t.Message):
    logger: _b.str
    level: _b.str
    @_ty.overload
    def __init__(self, *, logger: _t.Text = ..., level: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, logger: _t.Text, level: _t.Text, /) -> None: ...

class SetLoggerLevelResponse(_t.Message):
    def __init__(self) -> None: ...

class SetLoggerLevel(_t.Service[SetLoggerLevelRequest, SetLoggerLevelResponse]):
    Request: _ty.TypeAlias = SetLoggerLevelRequest
    Response: _ty.TypeAlias = SetLoggerLevelResponse
