# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.ackermann_msgs as _msg_ackermann_msgs
import aioros1.msg.std_msgs as _msg_std_msgs

class AckermannDrive(_t.Message):
    steering_angle: _b.float
    steering_angle_velocity: _b.float
    speed: _b.float
    acceleration: _b.float
    jerk: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        steering_angle: _t.Float = ...,
        steering_angle_velocity: _t.Float = ...,
        speed: _t.Float = ...,
        acceleration: _t.Float = ...,
        jerk: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        steering_angle: _t.Float,
        steering_angle_velocity: _t.Float,
        speed: _t.Float,
        acceleration: _t.Float,
        jerk: _t.Float,
        /,
    ) -> None: ...

class AckermannDriveStamped(_t.Message):
    header: _msg_std_msgs.Header
    drive: _msg_ackermann_msgs.AckermannDrive
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        drive: _msg_ackermann_msgs.AckermannDrive = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        drive: _msg_ackermann_msgs.AckermannDrive,
        /,
    ) -> None: ...
