# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.std_msgs as _msg_std_msgs

class Clock(_t.Message):
    clock: _t.Time
    @_ty.overload
    def __init__(self, *, clock: _t.Time = ...) -> None: ...
    @_ty.overload
    def __init__(self, clock: _t.Time, /) -> None: ...

class Log(_t.Message):
    DEBUG: _ty.Final = 1
    INFO: _ty.Final = 2
    WARN: _ty.Final = 4
    ERROR: _ty.Final = 8
    FATAL: _ty.Final = 16
    header: _msg_std_msgs.Header
    level: _b.int
    name: _b.str
    msg: _b.str
    file: _b.str
    function: _b.str
    line: _b.int
    topics: _t.TextList
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        level: _t.Int = ...,
        name: _t.Text = ...,
        msg: _t.Text = ...,
        file: _t.Text = ...,
        function: _t.Text = ...,
        line: _t.Int = ...,
        topics: _t.Texts = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        level: _t.Int,
        name: _t.Text,
        msg: _t.Text,
        file: _t.Text,
        function: _t.Text,
        line: _t.Int,
        topics: _t.Texts,
        /,
    ) -> None: ...

class TopicStatistics(_t.Message):
    topic: _b.str
    node_pub: _b.str
    node_sub: _b.str
    window_start: _t.Time
    window_stop: _t.Time
    delivered_msgs: _b.int
    dropped_msgs: _b.int
    traffic: _b.int
    period_mean: _t.Duration
    period_stddev: _t.Duration
    period_max: _t.Duration
    stamp_age_mean: _t.Duration
    stamp_age_stddev: _t.Duration
    stamp_age_max: _t.Duration
    @_ty.overload
    def __init__(
        self,
        *,
        topic: _t.Text = ...,
        node_pub: _t.Text = ...,
        node_sub: _t.Text = ...,
        window_start: _t.Time = ...,
        window_stop: _t.Time = ...,
        delivered_msgs: _t.Int = ...,
        dropped_msgs: _t.Int = ...,
        traffic: _t.Int = ...,
        period_mean: _t.Duration = ...,
        period_stddev: _t.Duration = ...,
        period_max: _t.Duration = ...,
        stamp_age_mean: _t.Duration = ...,
        stamp_age_stddev: _t.Duration = ...,
        stamp_age_max: _t.Duration = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        topic: _t.Text,
        node_pub: _t.Text,
        node_sub: _t.Text,
        window_start: _t.Time,
        window_stop: _t.Time,
        delivered_msgs: _t.Int,
        dropped_msgs: _t.Int,
        traffic: _t.Int,
        period_mean: _t.Duration,
        period_stddev: _t.Duration,
        period_max: _t.Duration,
        stamp_age_mean: _t.Duration,
        stamp_age_stddev: _t.Duration,
        stamp_age_max: _t.Duration,
        /,
    ) -> None: ...
