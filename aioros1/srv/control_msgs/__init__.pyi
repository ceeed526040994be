# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t

class QueryCalibrationStateRequest(_t.Message):
    def __init__(self) -> None: ...

class QueryCalibrationStateResponse(_t.Message):
    is_calibrated: _b.bool
    @_ty.overload
    def __init__(self, *, is_calibrated: _t.Bool = ...) -> None: ...
    @_ty.overload
    def __init__(self, is_calibrated: _t.Bool, /) -> None: ...

class QueryCalibrationState(_t.Service[QueryCalibrationStateRequest, QueryCalibrationStateResponse]):
    Request: _ty.TypeAlias = QueryCalibrationStateRequest
    Response: _ty.TypeAlias = QueryCalibrationStateResponse

class QueryTrajectoryStateRequest(_t.Message):
    time: _t.Time
    @_ty.overload
    def __init__(self, *, time: _t.Time = ...) -> None: ...
    @_ty.overload
    def __init__(self, time: _t.Time, /) -> None: ...

class QueryTrajectoryStateResponse(_t.Message):
    name: _t.TextList
    position: _t.FloatArray
    velocity: _t.FloatArray
    acceleration: _t.FloatArray
    @_ty.overload
    def __init__(
        self,
        *,
        name: _t.Texts = ...,
        position: _t.Floats = ...,
        velocity: _t.Floats = ...,
        acceleration: _t.Floats = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        name: _t.Texts,
        position: _t.Floats,
        velocity: _t.Floats,
        acceleration: _t.Floats,
        /,
    ) -> None: ...

class QueryTrajectoryState(_t.Service[QueryTrajectoryStateRequest, QueryTrajectoryStateResponse]):
    Request: _ty.TypeAlias = QueryTrajectoryStateRequest
    Response: _ty.TypeAlias = QueryTrajectoryStateResponse
