# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.sensor_msgs as _msg_sensor_msgs

class SetCameraInfoRequest(_t.Message):
    camera_info: _msg_sensor_msgs.CameraInfo
    @_ty.overload
    def __init__(self, *, camera_info: _msg_sensor_msgs.CameraInfo = ...) -> None: ...
    @_ty.overload
    def __init__(self, camera_info: _msg_sensor_msgs.CameraInfo, /) -> None: ...

class SetCameraInfoResponse(_t.Message):
    success: _b.bool
    status_message: _b.str
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., status_message: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, status_message: _t.Text, /) -> None: ...

class SetCameraInfo(_t.Service[SetCameraInfoRequest, SetCameraInfoResponse]):
    Request: _ty.TypeAlias = SetCameraInfoRequest
    Response: _ty.TypeAlias = SetCameraInfoResponse
