# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t

class TwoIntsRequest(_t.Message):
    a: _b.int
    b: _b.int
    @_ty.overload
    def __init__(self, *, a: _t.Int = ..., b: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, a: _t.Int, b: _t.Int, /) -> None: ...

class TwoIntsResponse(_t.Message):
    sum: _b.int
    @_ty.overload
    def __init__(self, *, sum: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, sum: _t.Int, /) -> None: ...

class TwoInts(_t.Service[TwoIntsRequest, TwoIntsResponse]):
    Request: _ty.TypeAlias = TwoIntsRequest
    Response: _ty.TypeAlias = TwoIntsResponse
