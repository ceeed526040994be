# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.std_msgs as _msg_std_msgs

class Constants(_t.Message):
    DEAD_PUBLISH_PERIOD: _ty.Final[_b.float] = 0.05
    DEFAULT_CONNECT_TIMEOUT: _ty.Final[_b.float] = 10.0
    DEFAULT_HEARTBEAT_TIMEOUT: _ty.Final[_b.float] = 4.0
    DEFAULT_DISCONNECT_TIMEOUT: _ty.Final[_b.float] = 2.0
    DEFAULT_HEARTBEAT_PERIOD: _ty.Final[_b.float] = 1.0
    DISABLE_HEARTBEAT_TIMEOUT_PARAM: _ty.Final = "/bond_disable_heartbeat_timeout"
    def __init__(self) -> None: ...

class Status(_t.Message):
    header: _msg_std_msgs.Header
    id: _b.str
    instance_id: _b.str
    active: _b.bool
    heartbeat_timeout: _b.float
    heartbeat_period: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        id: _t.Text = ...,
        instance_id: _t.Text = ...,
        active: _t.Bool = ...,
        heartbeat_timeout: _t.Float = ...,
        heartbeat_period: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        id: _t.Text,
        instance_id: _t.Text,
        active: _t.Bool,
        heartbeat_timeout: _t.Float,
        heartbeat_period: _t.Float,
        /,
    ) -> None: ...
