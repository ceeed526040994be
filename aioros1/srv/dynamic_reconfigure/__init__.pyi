# Made by aioros1 from message definitions. Change those, and have it made anew.
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.dynamic_reconfigure as _msg_dynamic_reconfigure

class ReconfigureRequest(_t.Message):
    config: _msg_dynamic_reconfigure.Config
    @_ty.overload
    def __init__(self, *, config: _msg_dynamic_reconfigure.Config = ...) -> None: ...
    @_ty.overload
    def __init__(self, config: _msg_dynamic_reconfigure.Config, /) -> None: ...

class ReconfigureResponse(_t.Message):
    config: _msg_dynamic_reconfigure.Config
    @_ty.overload
    def __init__(self, *, config: _msg_dynamic_reconfigure.Config = ...) -> None: ...
    @_ty.overload
    def __init__(self, config: _msg_dynamic_reconfigure.Config, /) -> None: ...

class Reconfigure(_t.Service[ReconfigureRequest, ReconfigureResponse]):
    Request: _ty.TypeAlias = ReconfigureRequest
    Response: _ty.TypeAlias = ReconfigureResponse
