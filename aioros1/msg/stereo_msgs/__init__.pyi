# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.sensor_msgs as _msg_sensor_msgs
import aioros1.msg.std_msgs as _msg_std_msgs

class DisparityImage(_t.Message):
    header: _msg_std_msgs.Header
    image: _msg_sensor_msgs.Image
    f: _b.float
    T: _b.float
    valid_window: _msg_sensor_msgs.RegionOfInterest
    min_disparity: _b.float
    max_disparity: _b.float
    delta_d: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        image: _msg_sensor_msgs.Image = ...,
        f: _t.Float = ...,
        T: _t.Float = ...,
        valid_window: _msg_sensor_msgs.RegionOfInterest = ...,
        min_disparity: _t.Float = ...,
        max_disparity: _t.Float = ...,
        delta_d: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        image: _msg_sensor_msgs.Image,
        f: _t.Float,
        T: _t.Float,
        valid_window: _msg_sensor_msgs.RegionOfInterest,
        min_disparity: _t.Float,
        max_disparity: _t.Float,
        delta_d: _t.Float,
        /,
    ) -> None: ...
